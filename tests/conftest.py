"""Fixtures that fly: whole flights in memory, on the real vehicle and the real planner."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import pytest

from companion.cli.vehicle import LINK, build_vehicle
from companion.core import Companion, CompanionConfig
from companion.drivers.lockstep import VehicleCore, fly_lockstep
from companion.drivers.planning import InlinePlanning
from companion.drivers.recording import RecordingTap, header
from companion.drivers.tick import Tap, Tick
from companion.missionfile import parse_mission
from companion.seam import Note, Order
from companion.verdict import FlightMeter, Verdict, judge
from fakevehicle.config import Autopilot
from logs.recorder import Recorder

HOP = """\
name: hop
vehicle:
  start: {north: 2, east: 2}
world:
  bounds: {north: [0, 10], east: [0, 10], altitude: [0, 4]}
  obstacles:
    - cylinder: {north: 4, east: 4, radius: 0.4, altitude: [0, 4]}
steps:
  - takeoff: {altitude: 1.5}
  - goto: {north: 6, east: 6, altitude: 1.5}
  - land
"""
"""The smallest mission worth flying: about 15 s."""


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Where tests run in several processes: those in real time one after another, a file's others in one process."""
    if not config.pluginmanager.hasplugin("xdist"):
        return
    for item in items:
        in_real_time = item.get_closest_marker("udp") is not None
        folder = item.path.parent.name
        group = "real time" if in_real_time else folder if folder == "pages" else str(item.path)
        item.add_marker(pytest.mark.xdist_group(group))


@dataclass
class Flight:
    """A flight that is over, and everything that crossed the seam in it."""

    companion: Companion
    verdict: Verdict
    ticks: list[Tick]

    @property
    def notes(self) -> list[str]:
        return [o.text for tick in self.ticks for o in tick.outputs if isinstance(o, Note)]


@pytest.fixture
def fly() -> Callable[..., Flight]:
    """Fly a mission (YAML text) in lockstep; see the keyword arguments for what can be put in its way."""

    def _fly(
        mission: str = HOP,
        *,
        seed: int = 1,
        autopilot: Autopilot = "px4",
        record: Path | None = None,
        limit_s: float = 120.0,
        operator: Callable[[Companion, int], Order | None] = lambda companion, now_us: None,
        between: Callable[[VehicleCore], VehicleCore] = lambda vehicle: vehicle,
        taps: Sequence[Tap] = (),
        ground_links: tuple[str, ...] = (),
    ) -> Flight:
        parsed = parse_mission(mission.encode(), "test.yaml")
        companion = Companion(parsed, CompanionConfig(seed=seed, ground_links=ground_links))
        meter, ticks = FlightMeter(companion), []
        recorder = None if record is None else Recorder(record, threaded=False, **header(companion, mission.encode()))
        every: list[Tap] = [meter, ticks.append, *taps]
        if recorder is not None:
            every.append(RecordingTap(companion, recorder))
        fly_lockstep(
            companion,
            between(build_vehicle(parsed, seed, autopilot)),
            LINK,
            InlinePlanning(parsed.planner_world()),
            every,
            limit_s=limit_s,
            operator=lambda now_us: operator(companion, now_us),
        )
        if recorder is not None:
            recorder.close()
        return Flight(companion, judge(companion, meter), ticks)

    return _fly
