"""How much is run: the whole, or quickly. Both run everything; only the counts differ."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Sizes:
    """One column of the table of sizes.

    Attributes
    ----------
    name : what it is called.
    families : of worlds.
    worlds : of each family; every one is planned and flown by every method.
    repeats : how often each plan is made; its CPU time is the median's.
    searches : runs of each algorithm on each function.
    iterations : of each of them.
    holds : flights in a steady wind for each set of gains, each with a seed of its own.
    hold_s : how long each holds its place [s].
    laws_budget : evaluations that tune each control law.
    eight_s, step_m : the courses of a tuning, a figure of eight for so long [s] and a step so far [m]; 0: no step.
    train : seeds that a cost is made of.
    unseen : others, on which each tuned law is judged, in calm and in gusts.
    optimisers_budget : evaluations of each optimiser.
    optimiser_seeds : how often each optimiser is run.
    """

    name: str
    families: tuple[str, ...]
    worlds: int
    repeats: int
    searches: int
    iterations: int
    holds: int
    hold_s: float
    laws_budget: int
    eight_s: float
    step_m: float
    train: int
    unseen: int
    optimisers_budget: int
    optimiser_seeds: int


FULL = Sizes(
    name="full",
    families=("L", "H", "U", "Omega"),
    worlds=30,
    repeats=5,
    searches=20,
    iterations=1000,
    holds=10,
    hold_s=60.0,
    laws_budget=300,
    eight_s=12.0,
    step_m=3.0,
    train=2,
    unseen=50,
    optimisers_budget=80,
    optimiser_seeds=5,
)
QUICK = Sizes(
    name="quick",
    families=("L", "H", "U", "Omega"),
    worlds=2,
    repeats=3,
    searches=5,
    iterations=200,
    holds=2,
    hold_s=20.0,
    laws_budget=20,
    eight_s=6.0,
    step_m=3.0,
    train=1,
    unseen=4,
    optimisers_budget=20,
    optimiser_seeds=2,
)
