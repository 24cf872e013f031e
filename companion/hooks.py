"""What `Companion.step` asks of the parts that see, plan again and talk to ground stations; and parts that do nothing.

The core calls each of them at its place in the tick, whether or not there is one; `core.py` has the order. They are
step machines like the core itself: time is handed in, nothing is read or sent, and nothing raises for what a peer said.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

from companion.seam import FloatArray, Note, Order, ReplanReady, ReplanWanted
from wire.datagram import Datagram
from wire.framing import Packet

Obey = Callable[[Order], str]
"""Carries out an order: why it cannot be done, or nothing."""


@dataclass(frozen=True, slots=True)
class Pose:
    """Where the vehicle says it is, in the mission frame (NED)."""

    flight_us: int  # on the flight clock
    position_m: FloatArray  # (3,) [m]
    velocity_m: FloatArray  # (3,) [m/s]
    roll: float  # [rad]
    pitch: float  # [rad]
    yaw: float  # [rad]


class Seeing(Protocol):
    """Obstacles and movers, as sensors tell of them."""

    def streams_hz(self) -> dict[int, float]:
        """Messages it lives by, and how often a second."""
        ...

    def begin(self) -> None:
        """The mission frame is known: places count from now on."""
        ...

    def take(self, packet: Packet, pose: Pose) -> bool:
        """One packet of any component of the vehicle's system, or of a sensors' link; whether it told of something.

        `pose` is what telemetry says when it comes, and has the flight's time.
        """
        ...

    def step(self, flight_us: int) -> None:
        """Once a tick, after all packets of the tick."""
        ...

    def trouble(self, flight_us: int) -> str:
        """Why it cannot be flown by what is seen; or nothing."""
        ...


class Replanning(Protocol):
    """Looks at what is flown, again and again."""

    trouble: str
    """Why there is nothing safe to fly but a stop; empty otherwise."""
    drifts: int
    """How often it began anew where the vehicle was, which is elsewhere than the last setpoint."""

    def take(self, ready: ReplanReady, flight_us: int) -> None:
        """An answer."""
        ...

    def lost(self) -> None:
        """The vehicle stands elsewhere than what is flown says: begin anew from where it is."""
        ...

    def step(self, flight_us: int, pose: Pose) -> list[ReplanWanted]:
        """Once a tick while FLYING; the questions to ask now."""
        ...

    def in_the_way(self, flight_us: int) -> str:
        """What is about to cross the climb, before anything has left the ground; or nothing."""
        ...

    def take_said(self) -> list[Note]:
        """What people should know; each is told once."""
        ...


class Ground(Protocol):
    """Ground stations that speak to the companion itself (component 191) rather than to the vehicle."""

    def take(self, now_us: int, datagram: Datagram, obey: Obey) -> list[Datagram]:
        """A ground station's datagram: what to answer (addressed). What it orders is carried out by `obey`."""
        ...

    def step(self, now_us: int) -> list[Datagram]:
        """Once a tick: repeats and progress."""
        ...


class NothingSeen:
    """There are no sensors."""

    def streams_hz(self) -> dict[int, float]:
        return {}

    def begin(self) -> None:
        pass

    def take(self, packet: Packet, pose: Pose) -> bool:
        return False

    def step(self, flight_us: int) -> None:
        pass

    def trouble(self, flight_us: int) -> str:
        return ""


class NothingReplanned:
    """What was planned on the ground is flown."""

    trouble = ""
    drifts = 0

    def take(self, ready: ReplanReady, flight_us: int) -> None:
        pass

    def lost(self) -> None:
        pass

    def step(self, flight_us: int, pose: Pose) -> list[ReplanWanted]:
        return []

    def in_the_way(self, flight_us: int) -> str:
        return ""

    def take_said(self) -> list[Note]:
        return []


class NobodyAsks:
    """No ground station speaks to the companion."""

    def take(self, now_us: int, datagram: Datagram, obey: Obey) -> list[Datagram]:
        return []

    def step(self, now_us: int) -> list[Datagram]:
        return []
