"""What HAOAROA is compared with, by the same call: `plan(..., method="astar")` and so on.

Grid methods, on one grid of cells (`grid`) whose edges are all proved clear:
    astar     A* (`astar`), a polyline with a stop at every corner (`polyline`)
    jps       exact jump point search in space (`jps`), as long as A*'s, a polyline too
    bezier    a composite cubic Bezier curve, twice continuously differentiable, through A*'s pruned corners (`bezier`)
Searches on HAOAROA's own cost, from its own seeds, with the budget of 20 candidates x 100 iterations:
    lbsgf     gradient flow on control points, preconditioned by the inverse discrete Laplacian: our reading (`lbsgf`)
    aoa, roa  the parents alone, without gradient and without polish (`parents`)

Each hands over shapes that are timed, proved and reported like HAOAROA's; what cannot be proved says so.
"""
