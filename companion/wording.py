"""The planner's refusals in the words of the mission file: north, east, altitude, its keys, and by how much.

The planner's `radius` is `vehicle.radius` and `limits.clearance` together, its limits stand under `limits`.
"""

import math

from planner import (
    BlockedByMovers,
    GoalInCollision,
    GoalOutOfBounds,
    InfeasibleLimits,
    NoPathFound,
    NoTimingFound,
    PlannerError,
    StartInCollision,
    StartOutOfBounds,
    StateBeyondLimits,
    ViaInCollision,
    ViaOutOfBounds,
)

KEPT = "vehicle.radius + limits.clearance"


def in_mission_words(error: PlannerError) -> str:
    """One clause for a person; the planner speaks of x, y and z, which are north, east and down here.

    Files and knots (WorldFileError, KnotError) are told in the planner's own words, which name no axis.
    """
    match error:
        case StartInCollision() | GoalInCollision() | ViaInCollision():
            return _too_near(error, f"obstacle {error.obstacle} ({error.kind})", "from", "inside")
        case StartOutOfBounds() | GoalOutOfBounds() | ViaOutOfBounds():
            down = error.axis == 2
            side = {"lower": "upper", "upper": "lower"}[error.side] if down else error.side
            bound = -error.bound + 0.0 if down else error.bound  # + 0.0: no minus sign before a zero
            wall = f"the {side} {('north', 'east', 'altitude')[error.axis]} bound {bound:g}"
            return _too_near(error, wall, "inside", "beyond")
        case InfeasibleLimits():
            return f"limits.{error.name}: found {error.value:g}, expected {error.least:g} to {error.most:g}"
        case StateBeyondLimits():
            which, _, what = error.name.partition("_")
            key, unit = ("acceleration", "m/s²") if what == "acceleration" else ("speed", "m/s")
            asked = f"the {what} at the {which} is {error.value:.4g} {unit}"
            return f"{asked}, {error.excess:.2g} {unit} beyond limits.{key} of {error.limit:g} {unit}"
        case BlockedByMovers():
            return (
                f"no path found among what moves: {_ways(error)} from all that stands still, but moving obstacle "
                f"{error.mover} is in the way after {error.time:.1f} s, and no other way or time tried avoids it"
            )
        case NoTimingFound():
            return (
                f"no timing found: {_ways(error)}, but from {error.speed:.3g} m/s and {error.acceleration:.3g} m/s² at "
                "the start none can be flown within limits.speed, limits.acceleration and limits.jerk"
            )
        case NoPathFound():
            return _no_path(error)
        case _:
            return str(error)


_InCollision = StartInCollision | GoalInCollision | ViaInCollision
_OutOfBounds = StartOutOfBounds | GoalOutOfBounds | ViaOutOfBounds


def _too_near(error: _InCollision | _OutOfBounds, thing: str, good: str, bad: str) -> str:
    north, east, z = error.point
    place = f"the {error.which} at north {north:g}, east {east:g}, altitude {-z + 0.0:g}"
    where = f"{_metres(abs(error.distance), error.shortfall)} m {good if error.distance >= 0 else bad} {thing}"
    if error.distance < error.radius:
        lack = f"{_metres(error.shortfall, error.shortfall)} m more are needed to keep {error.radius:g} m"
    else:
        lack = f"that keeps {error.radius:g} m, but {error.shortfall:.1g} m more are needed to prove it"
    return f"{place} is {where}; {lack} ({KEPT})"


def _no_path(error: NoPathFound) -> str:
    kept = f"{error.radius:g} m ({KEPT})"
    if error.proved:
        return f"no path found, and it is proved that there is none: start and goal are walled off at {kept}"
    cells = f"on cells of {error.cell:.2g} m"
    way = f"no way is seen {cells}" if math.isinf(error.way) else f"a way of {error.way:.1f} m is seen {cells}"
    if not error.tried:
        return f"no path found that keeps {kept}: {way}; that is no proof that there is none"
    best = f"the best of {error.tried} curves lacks {_metres(error.shortfall, error.shortfall)} m"
    return f"no path found that is proved to keep {kept}: {best}; {way}"


def _ways(error: BlockedByMovers | NoTimingFound) -> str:
    return f"{error.curves} curve{'s keep' if error.curves != 1 else ' keeps'} {error.radius:g} m ({KEPT})"


def _metres(value: float, lack: float) -> str:
    """With as many digits as let `lack` be seen in it: centimetres as a rule."""
    digits = 2 if lack >= 0.02 else min(9, 1 - math.floor(math.log10(lack))) if lack > 0.0 else 3
    return f"{value:.{digits}f}"
