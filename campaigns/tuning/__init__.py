"""Gains found by flights: a specification, a search, and what the result is worth on seeds it has not seen.

spec         SPEC.yaml: which parameters, on which courses, in which winds, at what weights
courses      one whole flight, the estimator in the loop
margin       how near the linear model of the loops is to instability
cost         flights and margin become one number
optimisers   HAOAROA, AOA, ROA, differential evolution, CMA-ES behind one front
journal      what has been flown is never flown again
tune         search, then judge before and after; `compare` does so for several laws, or several optimisers
report       tables, plots, and the parameter file that `fakevehicle --params` loads

Ways in: `tune.find`, `compare.compare_controllers`, `compare.compare_optimisers`.
"""
