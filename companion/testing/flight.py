"""A scripted flight: companion and bundled vehicle joined in memory as a `FlightSpec` says, flown, judged.

result = fly(FlightSpec(Path("missions/l_shape.yaml"), autopilot="ardupilot", wind=(4, 0, 0)))
assert result.ok, result.cause
"""

import time
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from pathlib import Path

from companion.cli.vehicle import LINK, build_vehicle
from companion.core import Companion, CompanionConfig
from companion.drivers.lockstep import fly_lockstep
from companion.drivers.planning import InlinePlanning
from companion.drivers.provenance import conclude
from companion.drivers.recording import RecordingTap, header
from companion.drivers.tick import Tap
from companion.errors import MissionError
from companion.fleet.missions import has_vehicles
from companion.mission import Mission
from companion.missionfile import parse_mission, read_mission_file
from companion.seam import Order
from companion.testing.spec import FlightResult, FlightSpec
from companion.testing.taps import Innovations, Story, Surroundings, surroundings
from companion.testing.together import fly_together
from companion.testing.wire import FaultyWire
from companion.verdict import FlightMeter, Verdict, judge
from fakevehicle.vehicle import Vehicle
from fakevehicle.vocabulary import Truth
from logs.recorder import Recorder
from wire.datagram import Datagram

BOOT_US = 2_000_000
"""How long a vehicle that restarts is silent."""


class RestartingVehicle:
    """The vehicle, which falls silent at a moment and is a fresh one, where it first stood, two seconds later.

    Parameters
    ----------
    build : makes one.
    reboot_us : when.
    """

    TICK_US = Vehicle.TICK_US

    def __init__(self, build: Callable[[], Vehicle], reboot_us: int) -> None:
        self._build, self._reboot_us = build, reboot_us
        self._vehicle, self._since_us = build(), 0

    @property
    def truth(self) -> Truth:
        """Of the one that is there."""
        return self._vehicle.truth

    def step(self, now_us: int, inputs: Sequence[Datagram]) -> list[Datagram]:
        """As `Vehicle.step`."""
        if self._since_us == 0 and now_us > self._reboot_us:
            if now_us <= self._reboot_us + BOOT_US:
                return []
            self._vehicle, self._since_us = self._build(), now_us - self.TICK_US
        return self._vehicle.step(now_us - self._since_us, inputs)


class Flight:
    """One flight, ready to be flown.

    Parameters
    ----------
    spec : what is flown.

    Raises
    ------
    MissionError : its mission cannot be read or is none.
    ValueError, KeyError, VehicleError : a fault, a parameter, the wind or the airframe cannot be.

    Attributes
    ----------
    mission, companion, vehicle : as they will be flown; look at them and set them up before, look at them after.
    result : what came of it; None before it was flown to its end.
    """

    def __init__(self, spec: FlightSpec) -> None:
        self.spec = spec
        self._data = read_mission_file(spec.mission) if isinstance(spec.mission, Path) else spec.mission
        self.mission: Mission = parse_mission(self._data, spec.file)
        named = 1 if spec.link is not None and spec.link.shouting else None  # among several, ours must be named
        self.companion = Companion(self.mission, CompanionConfig(seed=spec.seed, system_id=named))
        reboot_us = None if spec.reboot_s is None else round(1e6 * spec.reboot_s)
        self.vehicle = self._build() if reboot_us is None else RestartingVehicle(self._build, reboot_us)
        self.result: FlightResult | None = None

    def _build(self) -> Vehicle:
        spec = self.spec
        return build_vehicle(
            self.mission,
            spec.seed,
            spec.autopilot,
            faults=spec.faults,
            gusts=spec.gusts,
            wind=spec.wind,
            parameters=dict(spec.parameters),
            airframe=spec.airframe,
        )

    def fly(
        self,
        orders: Callable[[int], Order | None] = lambda now_us: None,
        until: Callable[[], bool] = lambda: False,
        taps: Sequence[Tap] = (),
    ) -> FlightResult:
        """Fly to the end; once only.

        Parameters
        ----------
        orders : asked once a tick for what a person orders.
        until : asked once a tick; True ends the flight as it is.
        taps : look on.

        Raises
        ------
        ValueError : it was flown before.
        """
        if self.result is not None:
            raise ValueError("this flight was flown before: make another")
        spec, companion = self.spec, self.companion
        meter, story, innovations = FlightMeter(companion), Story(companion), Innovations()
        around = surroundings(companion, self.vehicle)
        every: list[Tap] = [meter, story, innovations, *([] if around is None else [around]), *taps]
        limit_s = spec.limit_s + sum(step.hold.seconds for step in self.mission.steps if step.hold is not None)
        cpu = time.process_time()
        with ExitStack() as stack:
            recorder = None
            if spec.record is not None:
                spec.record.parent.mkdir(parents=True, exist_ok=True)
                recorder = stack.enter_context(Recorder(spec.record, threaded=False, **header(companion, self._data)))
                every.append(RecordingTap(companion, recorder))
            end_us = fly_lockstep(
                companion,
                self.vehicle,
                LINK,
                InlinePlanning(self.mission.planner_world()),
                every,
                limit_s=limit_s,
                operator=orders,
                stop=until,
                wire=None if spec.link is None else FaultyWire(spec.link, LINK),
            )
            if not companion.over and not until():
                companion.failure = companion.failure or f"not over after {limit_s:g} s of simulated time"
            if recorder is not None:
                conclude(recorder, companion, meter, None if around is None else around.least)
        verdict = judge(companion, meter, None if around is None else around.least)
        cause = first_cause(verdict, story, around, innovations)
        self.result = FlightResult(
            spec=spec,
            ok=not cause,
            cause=cause,
            phase=companion.phase.value,
            failure=companion.failure,
            verdict=verdict,
            min_clearance_m=verdict.min_clearance_m,
            innovation=innovations.first,
            notes=tuple(story.notes),
            simulated_s=end_us / 1e6,
            cpu_s=time.process_time() - cpu,
            recording=spec.record,
        )
        return self.result


def fly(spec: FlightSpec) -> FlightResult:
    """Fly a spec to its end, all vehicles of a mission with several; a mission that is none is a result, too."""
    try:
        data = read_mission_file(spec.mission) if isinstance(spec.mission, Path) else spec.mission
        if has_vehicles(data):
            return fly_together(spec, data)
        flight = Flight(spec)
    except MissionError as error:
        return FlightResult(spec, ok=False, cause=f"{error.file}: {error.problems[0]}")
    return flight.fly()


def first_cause(verdict: Verdict, story: Story, around: Surroundings | None, innovations: Innovations) -> str:
    """The first thing that went wrong, in words; empty: nothing did.

    What was touched and what the companion blames, by time; then what the mission expects. An innovation that failed
    before is told along.
    """
    first, when_us = ("", None) if verdict.ok else (verdict.failure, story.blamed_us)
    if (
        around is not None
        and around.touched_us is not None
        and (not first or when_us is None or around.touched_us < when_us)
    ):
        first, when_us = around.touched, around.touched_us
    if not first and verdict.failed_expectations:
        first = verdict.failed_expectations[0]
    if not first and not verdict.ok:
        first = f"ended {verdict.phase}"
    refused_us = innovations.first_us
    before = refused_us is not None and (when_us is None or refused_us <= when_us)
    return f"{first} (first innovation refused: {innovations.first})" if first and before else first
