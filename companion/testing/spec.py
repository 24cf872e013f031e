"""What a scripted flight is, and what came of it: two values that can be sent to another process and back."""

from dataclasses import dataclass
from pathlib import Path

from companion.seam import Vector
from companion.testing.wire import LinkFaults
from companion.verdict import Verdict
from fakevehicle.config import Autopilot
from fakevehicle.physics.wind import Gust

AIRFRAME = "x500"
LIMIT_S = 600.0
"""Simulated time after which a flight that does not end is ended; the mission's holds are added."""


@dataclass(frozen=True, slots=True)
class FlightSpec:
    """One flight in lockstep: the same spec is the same flight, to the byte.

    Attributes
    ----------
    mission : a mission's file, or the bytes of one.
    autopilot : whose behaviour the vehicle shows.
    seed : of the planner, and of the vehicle's sensors.
    wind : north, east, down [m/s]; None: the mission's.
    gusts, faults : on a schedule; faults as `fakevehicle.faults.parse_fault` reads them ("gps:off@20-40").
    parameters : of the vehicle, (name, value), where they differ from its defaults.
    link : what goes wrong on the link; None: nothing.
    reboot_s : when the vehicle restarts [s]; None: never.
    record : where to keep the recording; None: nowhere.
    limit_s : simulated time after which it is ended, its holds apart.
    airframe : the vehicle's, by the name of a shipped one or the path of a YAML file.
    named : what `mission` is called, where it is bytes; the files that it names are beside this one.
    """

    mission: Path | bytes
    autopilot: Autopilot = "px4"
    seed: int = 1
    wind: Vector | None = None
    gusts: tuple[Gust, ...] = ()
    faults: tuple[str, ...] = ()
    parameters: tuple[tuple[str, float], ...] = ()
    link: LinkFaults | None = None
    reboot_s: float | None = None
    record: Path | None = None
    limit_s: float = LIMIT_S
    airframe: str = AIRFRAME
    named: str = "mission.yaml"

    @property
    def file(self) -> str:
        """The mission's name for people and errors."""
        return str(self.mission) if isinstance(self.mission, Path) else self.named


@dataclass(frozen=True, slots=True)
class FlightResult:
    """What came of it.

    Attributes
    ----------
    spec : what was asked for.
    ok : it ended as the mission expects, and nothing was touched.
    cause : the first thing that went wrong; empty when nothing did.
    phase, failure : how the companion ended, and its reason.
    verdict : the flight in numbers; None when there was none, since the mission is none.
    min_clearance_m : of the hull to anything that was there, what appears and moves included; None: there was nothing.
    innovation : the first innovation that its gate refused, by its name, size and time; empty: none was.
    notes : (time [s], level, text) of everything the companion said.
    simulated_s, cpu_s : how long it was, and what it cost.
    recording : where it is kept; None: nowhere.
    """

    spec: FlightSpec
    ok: bool
    cause: str
    phase: str = ""
    failure: str = ""
    verdict: Verdict | None = None
    min_clearance_m: float | None = None
    innovation: str = ""
    notes: tuple[tuple[float, str, str], ...] = ()
    simulated_s: float = 0.0
    cpu_s: float = 0.0
    recording: Path | None = None

    def said(self, text: str) -> bool:
        """Whether the companion said something with `text` in it."""
        return any(text in said for _, _, said in self.notes)

    @property
    def story(self) -> str:
        """Everything it said, a line each."""
        return "\n".join(f"{at:8.2f} s  {level:7}  {text}" for at, level, text in self.notes)
