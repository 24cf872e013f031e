"""What can go wrong, and by how much.

    PlannerError
      KnotError             a knot vector is not one
      InfeasibleLimits      a limit that no vehicle has (also a ValueError)
      WorldFileError        a world, grid or cloud in a file that is none
      StateBeyondLimits     a velocity or acceleration at an end beyond the limit on it (also a ValueError)
      EndpointError
        StartInCollision    GoalInCollision       closer to an obstacle than the radius
        ViaInCollision                            `index` tells which of the via points
        StartOutOfBounds    GoalOutOfBounds       closer to a wall of the map than the radius, or beyond it
        ViaOutOfBounds
      NoPathFound           there is no way (proved), or the search ended without a certified trajectory (not proved)
        NoTimingFound       curves there are, but none that can be flown from the state at the start
        BlockedByMovers     trajectories there are, but none that was proved to miss what moves

Every number in a message is also an attribute. All of them survive pickling, since plans are made in worker processes:
the constructor's arguments are exactly `Exception.args`, and the sentence is built when it is read.
"""

import math

Point = tuple[float, float, float]
AXES = "xyz"


def _point(p: Point) -> str:
    return "(" + ", ".join(f"{v:.2f}" for v in p) + ")"


def _lack(metres: float) -> str:
    """Something missing, never shown as nothing: millimetres as a rule, two digits when it is less than one."""
    return f"{metres:.3f} m" if metres >= 1e-3 or metres <= 0.0 else f"{metres:.1e} m"


class PlannerError(Exception):
    """Root of everything this package raises on purpose, misuse of a constructor (ValueError) apart."""


class KnotError(PlannerError):
    """A knot vector has the wrong length, decreases, is not clamped, or repeats a knot too often."""


class WorldFileError(PlannerError):
    """A file of a world, of voxels or of a cloud cannot be read or does not say what it must."""

    def __init__(self, file: str, where: str, found: str, expected: str) -> None:
        super().__init__(file, where, found, expected)
        self.file, self.where, self.found, self.expected = file, where, found, expected

    def __str__(self) -> str:
        return f"{self.file}: {self.where}: found {self.found}, expected {self.expected}"


class InfeasibleLimits(PlannerError, ValueError):
    """A limit that is not a number of `least` to `most`; `name` says which."""

    def __init__(self, name: str, value: float, least: float, most: float) -> None:
        super().__init__(name, value, least, most)
        self.name, self.value, self.least, self.most = name, value, least, most

    def __str__(self) -> str:
        return f"limit {self.name}: expected a number from {self.least:g} to {self.most:g}, found {self.value:g}"


class StateBeyondLimits(PlannerError, ValueError):
    """What is asked of an end, `name`, has the norm `value`, more than `limit` (SI units)."""

    def __init__(self, name: str, value: float, limit: float) -> None:
        super().__init__(name, value, limit)
        self.name, self.value, self.limit = name, value, limit

    @property
    def excess(self) -> float:
        """By how much it is beyond."""
        return self.value - self.limit

    def __str__(self) -> str:
        unit = "m/s^2" if "acceleration" in self.name else "m/s"
        return (
            f"{self.name.replace('_', ' ')} of {self.value:.6g} {unit} is {self.excess:.3g} {unit} beyond "
            f"the limit of {self.limit:g} {unit}"
        )


class EndpointError(PlannerError):
    """The start or the goal is a place where the vehicle cannot be.

    `shortfall` [m] is what `distance` lacks of `radius + margin`; the margin is what the proof takes for rounding.
    """

    which: str
    distance: float
    radius: float
    margin: float

    @property
    def shortfall(self) -> float:
        return self.radius + self.margin - self.distance

    def _asked(self) -> str:
        if self.distance < self.radius:
            return f"the radius asks for {self.radius:.3f} m, {_lack(self.shortfall)} more"
        return f"the radius of {self.radius:.3f} m is kept, but proving so takes {_lack(self.shortfall)} more"


class _InCollision(EndpointError):
    def __init__(
        self, point: Point, obstacle: int, kind: str, distance: float, radius: float, margin: float = 0.0
    ) -> None:
        super().__init__(point, obstacle, kind, distance, radius, margin)
        self.point, self.obstacle, self.kind = point, obstacle, kind
        self.distance, self.radius, self.margin = distance, radius, margin

    def __str__(self) -> str:
        where = f"{self.distance:.3f} m from" if self.distance >= 0 else f"{-self.distance:.3f} m inside"
        return f"{self.which} {_point(self.point)} is {where} obstacle {self.obstacle} ({self.kind}); {self._asked()}"


class StartInCollision(_InCollision):
    """The start is closer than `radius` to obstacle number `obstacle`; `distance` is negative inside it [m]."""

    which = "start"


class GoalInCollision(_InCollision):
    """The goal is closer than `radius` to obstacle number `obstacle`; `distance` is negative inside it [m]."""

    which = "goal"


class _OutOfBounds(EndpointError):
    def __init__(
        self, point: Point, axis: int, side: str, bound: float, distance: float, radius: float, margin: float = 0.0
    ) -> None:
        super().__init__(point, axis, side, bound, distance, radius, margin)
        self.point, self.axis, self.side, self.bound = point, axis, side, bound
        self.distance, self.radius, self.margin = distance, radius, margin

    def __str__(self) -> str:
        wall = f"the {self.side} {AXES[self.axis]} bound {self.bound:g} m"
        where = f"{self.distance:.3f} m inside" if self.distance >= 0 else f"{-self.distance:.3f} m beyond"
        return f"{self.which} {_point(self.point)} is {where} {wall}; {self._asked()}"


class StartOutOfBounds(_OutOfBounds):
    """The start is beyond a wall of the map, or nearer to it than `radius`; `distance` is negative beyond it [m]."""

    which = "start"


class GoalOutOfBounds(_OutOfBounds):
    """The goal is beyond a wall of the map, or nearer to it than `radius`; `distance` is negative beyond it [m]."""

    which = "goal"


class ViaInCollision(_InCollision):
    """Via point number `index` is closer than `radius` to obstacle number `obstacle` [m]."""

    def __init__(
        self,
        point: Point,
        obstacle: int,
        kind: str,
        distance: float,
        radius: float,
        margin: float = 0.0,
        index: int = 0,
    ) -> None:
        super().__init__(point, obstacle, kind, distance, radius, margin)
        self.args = (point, obstacle, kind, distance, radius, margin, index)
        self.index, self.which = index, f"via point {index}"


class ViaOutOfBounds(_OutOfBounds):
    """Via point number `index` is beyond a wall of the map, or nearer to it than `radius` [m]."""

    def __init__(
        self,
        point: Point,
        axis: int,
        side: str,
        bound: float,
        distance: float,
        radius: float,
        margin: float = 0.0,
        index: int = 0,
    ) -> None:
        super().__init__(point, axis, side, bound, distance, radius, margin)
        self.args = (point, axis, side, bound, distance, radius, margin, index)
        self.index, self.which = index, f"via point {index}"


class NoPathFound(PlannerError):
    """There is no curve, or none could be proved within the budget; `proved` tells which.

    `proved` True: no curve that keeps the radius leads from start to goal, see `enclosure`. False: "gave up". Then
    `shortfall` [m] is by how much the best curve found misses the radius, `tried` counts the curves that were polished
    and put to the proof, and `way` [m] is the length of the way that the search graph shows, inf when its points,
    `cell` [m] apart at the finest, show none; a slit narrower than that can hide between them.
    """

    def __init__(
        self,
        tried: int,
        evaluations: int,
        shortfall: float,
        radius: float,
        way: float,
        cell: float,
        proved: bool = False,
    ) -> None:
        super().__init__(tried, evaluations, shortfall, radius, way, cell, proved)
        self.tried, self.evaluations, self.shortfall, self.radius = tried, evaluations, shortfall, radius
        self.way, self.cell, self.proved = way, cell, proved

    def __str__(self) -> str:
        if self.proved:
            return (
                "no path found: proved unreachable on the grid: cells that are nearer to obstacles than "
                f"{self.radius:.3f} m all over wall start and goal off from each other"
            )
        cells = f"its cells of {self.cell:.3g} m"
        if math.isinf(self.way):
            graph = f"the search graph shows no way through {cells}"
        else:
            graph = f"the search graph's way of {self.way:.1f} m through {cells} could not be followed"
        if not self.tried:
            return f"no path found: {graph} for a radius of {self.radius:.3f} m; that is no proof"
        return (
            f"no path found: gave up after {self.tried} curves polished with {self.evaluations} evaluations, none "
            f"keeps {self.radius:.3f} m everywhere; the best one lacks {_lack(self.shortfall)}; {graph}"
        )


class NoTimingFound(NoPathFound):
    """`curves` were found that keep the radius, but none could be flown from the given state within the limits.

    The velocity asked at an end is too much for the room there is to brake or to turn: see `speed` and
    `acceleration`, at the start [m/s, m/s^2].
    """

    def __init__(self, curves: int, evaluations: int, speed: float, acceleration: float, radius: float) -> None:
        super().__init__(curves, evaluations, 0.0, radius, math.inf, math.inf)
        self.args = (curves, evaluations, speed, acceleration, radius)
        self.curves, self.speed, self.acceleration = curves, speed, acceleration

    def __str__(self) -> str:
        return (
            f"no timing found: {self.curves} curves keep {self.radius:.3f} m, but from {self.speed:.3g} m/s and "
            f"{self.acceleration:.3g} m/s^2 at the start none of them can be flown within the limits"
        )


class BlockedByMovers(NoPathFound):
    """`curves` keep the radius from what stands still, none was proved to keep it from what moves.

    None of the ways of flying them did that were `tried_too`, besides flying them as they are. `mover` is in the way of
    the best of them at `time` [s].
    """

    def __init__(
        self, curves: int, evaluations: int, mover: int, time: float, radius: float, tried_too: tuple[str, ...] = ()
    ) -> None:
        super().__init__(curves, evaluations, 0.0, radius, math.inf, math.inf)
        self.args = (curves, evaluations, mover, time, radius, tried_too)
        self.curves, self.mover, self.time, self.tried_too = curves, mover, time, tried_too

    def __str__(self) -> str:
        *others, last = self.tried_too or ("",)
        too = f", {', '.join(others)}{' and ' if others else ''}{last} too" if last else ""
        return (
            f"no path found among the movers: {self.curves} curves keep {self.radius:.3f} m from all that stands "
            f"still, but mover {self.mover} is in the way at {self.time:.2f} s{too}"
        )
