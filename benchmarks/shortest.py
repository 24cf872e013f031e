"""The shortest way round obstacles that stand from floor to ceiling: a string pulled taut, exact, in the plane.

Between two ends of one height such a way stays at that height. It is made of straight pieces tangent to circles and of
arcs of them: circles of radius R about the corners of boxes, of r + R about cylinders. So it is a shortest way in the
graph of all free bitangents and arcs, by scipy's Dijkstra. Shares no code with the planner.
"""

import itertools
import math

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import dijkstra

from planner import Box, Cylinder, World

TOUCH = 1e-6
"""By how much [m] a way may come nearer than R: it touches."""
ARC = math.radians(1.0)


class Plan2D:
    """A world from above, and the way through it at distance R from everything."""

    def __init__(self, world: World, radius: float) -> None:
        self.radius = radius
        self.low, self.high = world.walls[0, :2] + radius - TOUCH, world.walls[1, :2] - radius + TOUCH
        self.boxes = np.array([[*o.lower[:2], *o.upper[:2]] for o in world.obstacles if isinstance(o, Box)])
        self.boxes = self.boxes.reshape(-1, 4)
        posts = [(*o.centre, o.radius) for o in world.obstacles if isinstance(o, Cylinder)]
        self.posts = np.array(posts).reshape(-1, 3)
        assert len(self.boxes) + len(self.posts) == len(world.obstacles), "boxes and cylinders only"
        corners = [(x, y, radius) for x0, y0, x1, y1 in self.boxes for x in (x0, x1) for y in (y0, y1)]
        self.circles = np.array(corners + [(x, y, r + radius) for x, y, r in self.posts]).reshape(-1, 3)

    def shortest(self, start: tuple[float, ...], goal: tuple[float, ...]) -> float:
        """Length [m]; inf when there is no way."""
        circles = np.concatenate([self.circles, [[*start[:2], 0.0], [*goal[:2], 0.0]]])
        first, last = len(circles) - 2, len(circles) - 1
        points: list[np.ndarray] = [circles[first, :2], circles[last, :2]]
        edges: list[tuple[int, int, float]] = []
        on: dict[int, list[int]] = {k: [] for k in range(len(circles))}
        on[first], on[last] = [0], [1]
        ends, pairs = [], []
        for i, j in itertools.combinations(range(len(circles)), 2):
            for p, q in bitangents(circles[i], circles[j]):
                ends.append((p, q))
                pairs.append((i, j))
        a, b = np.array([p for p, _ in ends]), np.array([q for _, q in ends])
        for k in np.flatnonzero(self.clear(a, b)):
            nodes = []
            for circle, point in zip(pairs[k], (a[k], b[k]), strict=True):
                if circle in (first, last):
                    nodes.append(0 if circle == first else 1)
                else:
                    nodes.append(len(points))
                    on[circle].append(len(points))
                    points.append(point)
            edges.append((nodes[0], nodes[1], float(np.linalg.norm(b[k] - a[k]))))
        for k, (x, y, r) in enumerate(self.circles):
            edges += self.arcs(x, y, r, on[k], points)
        if not edges:
            return math.inf
        rows, columns, lengths = zip(*edges, strict=True)
        graph = coo_matrix((np.array(lengths) + 1e-15, (rows, columns)), shape=(len(points), len(points))).tocsr()
        return float(dijkstra(graph, directed=False, indices=0)[1])

    def arcs(self, x: float, y: float, r: float, nodes: list[int], points: list[np.ndarray]) -> list:
        """Edges between neighbours on a circle, where the arc is free."""
        if len(nodes) < 2:
            return []
        angles = np.array([math.atan2(points[n][1] - y, points[n][0] - x) for n in nodes])
        order = np.argsort(angles)
        found = []
        for k in range(len(order)):
            i, j = order[k], order[(k + 1) % len(order)]
            turn = (angles[j] - angles[i]) % (2.0 * math.pi)
            along = angles[i] + np.linspace(0.0, turn, max(2, math.ceil(turn / ARC) + 1))
            arc = np.stack([x + r * np.cos(along), y + r * np.sin(along)], axis=1)
            if self.clear(arc, arc).all():
                found.append((nodes[i], nodes[j], r * turn))
        return found

    def clear(self, a: np.ndarray, b: np.ndarray) -> np.ndarray:
        """Whether each segment from a to b (m, 2) keeps R from everything."""
        ok = ((a >= self.low) & (a <= self.high) & (b >= self.low) & (b <= self.high)).all(axis=1)
        for x, y, r in self.posts:
            ok &= to_segment(np.array([x, y]), a, b) >= r + self.radius - TOUCH
        for x0, y0, x1, y1 in self.boxes:
            low, high = np.array([x0, y0]), np.array([x1, y1])
            least = np.minimum(to_box(a, low, high), to_box(b, low, high))
            for x, y in itertools.product((x0, x1), (y0, y1)):
                least = np.minimum(least, to_segment(np.array([x, y]), a, b))
            ok &= (least >= self.radius - TOUCH) & ~crosses(a, b, low, high)
        return ok


def bitangents(first: np.ndarray, second: np.ndarray) -> list[tuple[np.ndarray, np.ndarray]]:
    """Segments that touch two circles (x, y, r), at most four: n . D = s1 r1 - s2 r2, touching at c + s r n."""
    along = second[:2] - first[:2]
    distance = float(np.linalg.norm(along))
    if distance == 0.0:
        return []
    e = along / distance
    across = np.array([-e[1], e[0]])
    found = []
    for s1, s2 in itertools.product((1.0, -1.0), repeat=2):
        if (first[2] == 0.0 and s1 < 0.0) or (second[2] == 0.0 and s2 < 0.0):
            continue
        c = (s1 * first[2] - s2 * second[2]) / distance
        if abs(c) > 1.0:
            continue
        for side in (1.0, -1.0) if (first[2] == 0.0) != (second[2] == 0.0) else (1.0,):
            n = c * e + side * math.sqrt(1.0 - c * c) * across
            found.append((first[:2] + s1 * first[2] * n, second[:2] + s2 * second[2] * n))
    return found


def to_segment(point: np.ndarray, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Distances (m,) from a point to segments."""
    d = b - a
    size = np.maximum((d * d).sum(axis=1), 1e-300)
    t = np.clip(((point - a) * d).sum(axis=1) / size, 0.0, 1.0)
    return np.linalg.norm(a + t[:, None] * d - point, axis=1)


def to_box(points: np.ndarray, low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """Distances (m,) from points to a rectangle, 0 inside."""
    return np.linalg.norm(np.maximum(np.maximum(low - points, points - high), 0.0), axis=1)


def crosses(a: np.ndarray, b: np.ndarray, low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """Whether segments meet a rectangle (slabs)."""
    d = b - a
    d = np.where(d == 0.0, 1e-300, d)
    near, far = (low - a) / d, (high - a) / d
    enter = np.minimum(near, far).max(axis=1)
    leave = np.maximum(near, far).min(axis=1)
    return (enter <= leave) & (leave >= 0.0) & (enter <= 1.0)
