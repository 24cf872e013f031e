"""What a vehicle is made with: its place, its air, its links. Checked once, where it is built."""

from dataclasses import dataclass, field
from typing import Literal, get_args

import numpy as np

from fakevehicle.faults import Fault
from fakevehicle.physics.wind import Gust
from fakevehicle.sensors.obstacles import World
from fakevehicle.vocabulary import FloatArray, Geodetic

Profile = Literal["gcs", "onboard"]
"""Which of PX4's telemetry sets a link carries: "gcs" is the sparse one, "onboard" the fast one for a companion."""

Autopilot = Literal["px4", "ardupilot"]
"""Whose MAVLink behaviour the vehicle shows."""
Gains = Literal["default", "paper", "pid", "tid", "fopid"]
"""Which set of the loops' gains it starts with."""

MAX_LINKS = 16


def still_air() -> FloatArray:
    """A (3,) wind of zero [m/s]."""
    return np.zeros(3)


def zurich() -> Geodetic:
    """Where PX4's simulations start: Irchel Park, Zurich."""
    return Geodetic(latitude=np.radians(47.397742), longitude=np.radians(8.545594), altitude=488.0)


@dataclass(frozen=True, slots=True)
class LinkConfig:
    """One MAVLink link of the vehicle, as the driver and the datagrams name it."""

    name: str
    profile: Profile = "onboard"

    def __post_init__(self) -> None:
        if not self.name:
            raise ValueError("a link needs a name")
        if self.profile not in ("gcs", "onboard"):
            raise ValueError(f"link {self.name!r}: profile {self.profile!r}, expected 'gcs' or 'onboard'")


@dataclass(frozen=True, slots=True)
class VehicleConfig:
    """Everything that is fixed for one vehicle's life.

    Attributes
    ----------
    airframe : name of a shipped airframe, or the path of a YAML file.
    home : where it stands at the start.
    heading : its heading there [rad], clockwise from true north.
    wind_n : (3,) velocity of the air over ground, NED [m/s].
    seed : of every random number the vehicle draws.
    links : at least one; names are unique.
    system_id : MAVLink system, 1..255. The autopilot's component is always 1.
    start_unix_us : Unix time at now_us = 0 [us], for SYSTEM_TIME; 0 says that the vehicle does not know.
    autopilot : whose behaviour it shows on MAVLink.
    instance : number of the vehicle among several in one process, from 0.
    faults : of sensors and motors, on a schedule.
    gusts : of the wind, on a schedule.
    world : what its obstacle sensor and rangefinder see; None: nothing but the ground.
    gains : preset of the loops.

    Raises
    ------
    ValueError : a value cannot be; the message names it.
    """

    airframe: str = "x500"
    home: Geodetic = field(default_factory=zurich)
    heading: float = 0.0
    wind_n: FloatArray = field(default_factory=still_air)
    seed: int = 1
    links: tuple[LinkConfig, ...] = (LinkConfig("gcs", "gcs"), LinkConfig("onboard", "onboard"))
    system_id: int = 1
    start_unix_us: int = 0
    autopilot: Autopilot = "px4"
    instance: int = 0
    faults: tuple[Fault, ...] = ()
    gusts: tuple[Gust, ...] = ()
    world: World | None = None
    gains: Gains = "default"

    def __post_init__(self) -> None:
        if not 1 <= self.system_id <= 255:
            raise ValueError(f"system_id {self.system_id}: expected 1..255")
        if not 1 <= len(self.links) <= MAX_LINKS:
            raise ValueError(f"{len(self.links)} links: expected 1..{MAX_LINKS}")
        names = [link.name for link in self.links]
        if len(set(names)) != len(names):
            raise ValueError(f"link names {names}: expected each once")
        if np.shape(self.wind_n) != (3,) or not np.all(np.isfinite(self.wind_n)):
            raise ValueError(f"wind {self.wind_n}: expected three finite numbers, north, east, down")
        if not abs(self.home.latitude) <= np.pi / 2 or not abs(self.home.longitude) <= np.pi:
            raise ValueError(f"home {self.home}: latitude or longitude outside the globe")
        if self.seed < 0:
            raise ValueError(f"seed {self.seed}: expected 0 or more")
        if self.autopilot not in get_args(Autopilot):
            raise ValueError(f"autopilot {self.autopilot!r}: expected one of {', '.join(get_args(Autopilot))}")
        if self.gains not in get_args(Gains):
            raise ValueError(f"gains {self.gains!r}: expected one of {', '.join(get_args(Gains))}")
        if self.instance < 0:
            raise ValueError(f"instance {self.instance}: expected 0 or more")
