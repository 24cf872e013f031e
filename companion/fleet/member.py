"""One companion among several: tells the others what it flies, ten times a second, and listens to them."""

from zlib import crc32

from companion.fleet.exchange import Shared, pack
from companion.fleet.others import Others
from companion.hooks import Pose
from companion.mission import Mission
from companion.seam import FloatArray, Flown, Note, Vector
from companion.seeing.tracks import Tracks
from wire.datagram import Datagram

FLEET_LINK = "fleet"
"""Where the others' words arrive; "fleet0", "fleet1" ... call one of them each. Without any, ours go out by "fleet"."""
TELL_US = 100_000
LOOK_US = 40_000


class Member:
    """Our part of the exchange.

    Parameters
    ----------
    number : ours; the lower has the right of way.
    mission : what we fly, and in which frame: missions of one name and one world's bounds are in one.
    tracks : where others are put.
    calls : how many links call the others.

    Attributes
    ----------
    others : whom we have heard of.
    """

    def __init__(self, number: int, mission: Mission, tracks: Tracks, calls: int = 0) -> None:
        self._number, self._radius = number, mission.vehicle.radius
        self._frame = frame_of(mission)
        self._origin = mission.geodetic_origin()
        self.others = Others(number, self._frame, self._origin)
        self._tracks = tracks
        self._links = tuple(f"{FLEET_LINK}{k}" for k in range(calls)) or (FLEET_LINK,)
        self._sequence = 0
        self._tell_us = self._look_us = 0

    def take(self, now_us: int, datagram: Datagram) -> None:
        """What came on the fleet's link."""
        self.others.take(now_us, datagram.data)

    def step(
        self, now_us: int, pose: Pose, flown: Flown | None, *, airborne: bool, yields: bool
    ) -> list[Datagram | Note]:
        """Once a tick.

        Parameters
        ----------
        pose : where we are; its time is that of `flown`.
        flown : what we fly, if it is a trajectory.
        airborne : else the others need not know of us.
        yields : we fly round others now.
        """
        out: list[Datagram | Note] = []
        if now_us >= self._look_us:
            self._look_us = now_us + LOOK_US
            self.others.step(now_us, pose.flight_us, pose.position_m, self._tracks)
        if airborne and now_us >= self._tell_us:
            self._tell_us = now_us + TELL_US
            self._sequence += 1
            moved = None
            if flown is not None:
                moved = Flown(flown.trajectory, flown.start_us + now_us - pose.flight_us, flown.to_goal)
            shared = Shared(
                sender=self._number,
                sequence=self._sequence,
                stamp_us=now_us,
                position_m=_vector(pose.position_m),
                velocity=_vector(pose.velocity_m),
                radius=self._radius,
                yields=yields,
                flown=moved,
                frame=self._frame,
                origin=self._origin,
            )
            data = pack(shared)
            out.extend(Datagram(link, data) for link in self._links)
        out.extend(self.others.take_said())
        return out


def frame_of(mission: Mission) -> int:
    """A number that missions of one name, bounds and origin share: their coordinates mean the same places."""
    bounds = mission.world.bounds
    parts = (mission.name, *(f"{b.low:g} {b.high:g}" for b in (bounds.north, bounds.east, bounds.altitude)))
    return crc32("|".join((*parts, repr(mission.geodetic_origin()))).encode())


def _vector(values: FloatArray) -> Vector:
    return (float(values[0]), float(values[1]), float(values[2]))
