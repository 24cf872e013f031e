"""What a scripted flight looks at beside the verdict: what it touched, which innovation failed first, what was said."""

from typing import Protocol

from companion.cli.vehicle import seen_world
from companion.core import Companion
from companion.drivers.tick import Tick
from companion.seam import Note
from companion.vehiclelink import VEHICLE_LINK
from fakevehicle.sensors.obstacles import World
from fakevehicle.vocabulary import Truth
from wire.datagram import Datagram
from wire.dialect import mavlink
from wire.framing import Framer

MOST_NOTES = 10_000


class HasTruth(Protocol):
    """A vehicle whose physics can be asked."""

    @property
    def truth(self) -> Truth: ...


class Surroundings:
    """Distance of the hull (a ball) to what is there now, by truth: solids, what has appeared, what moves.

    Only while the vehicle is armed: what brushes past it on the ground is no fault of the flight.

    Parameters
    ----------
    world : what the vehicle's sensors see.
    radius : of the hull [m].

    Attributes
    ----------
    least : the smallest so far [m]; None: nothing was near enough to exist.
    touched_us, touched : when and what it first touched; None and empty: nothing.
    """

    def __init__(self, companion: Companion, vehicle: HasTruth, world: World, radius: float) -> None:
        self._companion, self._vehicle, self._world, self._radius = companion, vehicle, world, radius
        self._there = [False] * len(world.popups)
        self.least: float | None = None
        self.touched_us: int | None = None
        self.touched = ""

    def __call__(self, tick: Tick) -> None:
        here = self._vehicle.truth.position_n
        things = [("an obstacle", self._world.gap(here))]
        for i, popup in enumerate(self._world.popups):
            self._there[i] = self._there[i] or popup.appears(tick.now_us, here)
            if self._there[i]:
                things.append((f"pop-up {i}", popup.solids.gap(here)))
        if self._world.movers is not None:
            balls = self._world.movers.spheres(tick.now_us)
            gaps = ((balls[:, :3] - here) ** 2).sum(axis=1) ** 0.5 - balls[:, 3]
            nearest = int(gaps.argmin())
            things.append((f"mover {nearest}", float(gaps[nearest])))
        if not self._companion.telemetry.armed:
            return
        what, gap = min(things, key=lambda thing: thing[1])
        gap -= self._radius
        self.least = gap if self.least is None else min(self.least, gap)
        if gap < 0.0 and self.touched_us is None:
            self.touched_us, self.touched = tick.now_us, f"touched {what} at {tick.now_us / 1e6:.2f} s"


def surroundings(companion: Companion, vehicle: HasTruth) -> Surroundings | None:
    """A tap for a mission in which something appears or moves; None: of the rest the verdict knows."""
    mission = companion.mission
    seen = seen_world(mission) if mission.world.popups or mission.world.movers else None
    return None if seen is None else Surroundings(companion, vehicle, seen, mission.vehicle.radius)


_STATUS = {
    mavlink.MAVLINK_MSG_ID_ESTIMATOR_STATUS: (
        ("vel_ratio", "velocity"),
        ("pos_horiz_ratio", "horizontal position"),
        ("pos_vert_ratio", "height"),
        ("mag_ratio", "magnetometer"),
        ("hagl_ratio", "height above ground"),
    ),
    mavlink.MAVLINK_MSG_ID_EKF_STATUS_REPORT: (
        ("velocity_variance", "velocity"),
        ("pos_horiz_variance", "horizontal position"),
        ("pos_vert_variance", "height"),
        ("compass_variance", "magnetometer"),
        ("terrain_alt_variance", "height above ground"),
    ),
}
"""Test ratios by message: 1 is the gate."""
_STATUS_IDS = {number.to_bytes(3, "little") for number in _STATUS}


class Innovations:
    """The first innovation that its gate refused, by what the vehicle tells of its estimator.

    Attributes
    ----------
    first, first_us : its name, ratio and time in words, and the time; empty and None: none yet.
    """

    def __init__(self) -> None:
        self.first = ""
        self.first_us: int | None = None
        self._framer, self._decoder = Framer(), mavlink.MAVLink(None)

    def __call__(self, tick: Tick) -> None:
        if self.first:
            return
        for at_us, item in tick.inputs:
            if isinstance(item, Datagram) and item.link == VEHICLE_LINK and item.data[7:10] in _STATUS_IDS:
                self._look(at_us, item.data)

    def _look(self, at_us: int, data: bytes) -> None:
        for packet in self._framer.packets(data):
            names = _STATUS.get(packet.message_id)
            if names is None or packet.component_id != 1:
                continue
            message = self._decoder.decode(bytearray(packet.raw))
            ratio, name = max((getattr(message, field), name) for field, name in names)
            if ratio > 1.0 and not self.first:
                self.first_us = at_us
                self.first = f"{name} {ratio:.2g} at {at_us / 1e6:.1f} s"


class Story:
    """What the companion said, and when it first had something to blame.

    Attributes
    ----------
    notes : (time [s], level, text).
    blamed_us : first tick at which the companion knew a failure; None: it never did.
    """

    def __init__(self, companion: Companion) -> None:
        self._companion = companion
        self.notes: list[tuple[float, str, str]] = []
        self.blamed_us: int | None = None

    def __call__(self, tick: Tick) -> None:
        if self.blamed_us is None and self._companion.failure:
            self.blamed_us = tick.now_us
        for output in tick.outputs:
            if isinstance(output, Note) and len(self.notes) < MOST_NOTES:
                self.notes.append((tick.now_us / 1e6, output.level.name.lower(), output.text))
