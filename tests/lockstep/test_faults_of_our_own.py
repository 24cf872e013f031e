"""Exceptions of ours in flight: what only looks on is left out, and a core that has failed leaves a landing behind."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

import companion.drivers.flight as flight
from companion.cli.vehicle import LINK, build_vehicle
from companion.core import Companion, CompanionConfig
from companion.drivers.lockstep import Pair
from companion.drivers.planning import InlinePlanning
from companion.drivers.realtime import Pace
from companion.drivers.recording import RecordingTap, header
from companion.drivers.rerun import rerun
from companion.drivers.tick import Tap, Tick
from companion.lastresort import LastResort
from companion.missionfile import parse_mission
from companion.phases import Phase
from companion.vehiclelink import VEHICLE_LINK
from companion.verdict import FlightMeter, judge
from fakevehicle.config import Autopilot
from logs.reader import Recording
from logs.recorder import Recorder
from tests.conftest import HOP
from wire.datagram import Datagram
from wire.dialect import mavlink

LONG = HOP.replace("  - land", "  - hold: {seconds: 30}\n  - land")
BOTH = pytest.mark.parametrize("autopilot", ["px4", "ardupilot"])


class Bench:
    """A flight by `fly_guarded` whose sockets and clock are a lockstep with the bundled vehicle."""

    def __init__(self, autopilot: Autopilot, monkeypatch: pytest.MonkeyPatch) -> None:
        self.mission = parse_mission(LONG.encode(), "long.yaml")
        self.companion = Companion(self.mission, CompanionConfig(seed=1, ground_links=("out0",)))
        self.vehicle = build_vehicle(self.mission, 1, autopilot)
        self.told: list[tuple[str, str]] = []
        self.ticks: list[Tick] = []
        self.now_us = 0
        self.asked_down = False
        monkeypatch.setattr(flight, "fly_realtime", self._drive)

    def _drive(
        self, core: Any, links: Mapping[str, Any], planning: Any, taps: Sequence[Tap], *, stop: Any, **rest: Any
    ) -> Pace:
        pair = Pair(core, self.vehicle, LINK, planning, taps)
        ticks = 0
        while not core.over and not stop() and self.now_us < 120e6:
            now_us, self.now_us = self.now_us, self.now_us + core.TICK_US
            pair.tick(now_us, self.heard(now_us))
            ticks += 1
        return Pace(ticks, 0, 0)

    def heard(self, now_us: int) -> list[Datagram]:
        return []

    def fly(self, *taps: Tap) -> None:
        flight.fly_guarded(
            self.companion,
            {},
            InlinePlanning(self.mission.planner_world()),
            [self.ticks.append, *taps],
            operator=lambda now_us: None,
            stop=lambda: False,
            told=lambda text, trace: self.told.append((text, trace)),
        )

    def fall(self, phase: Phase, after_s: float = 0.5) -> None:
        """Make the core's step fail once and for all, some time after a phase has begun."""
        step, since = self.companion.step, SimpleNamespace(us=None)

        def falling(now_us: int, inputs: Any) -> Any:
            if self.companion.phase is phase:
                since.us = now_us if since.us is None else since.us
            if since.us is not None and now_us - since.us >= after_s * 1e6:
                raise ZeroDivisionError("of ours")
            return step(now_us, inputs)

        self.companion.step = falling  # type: ignore[method-assign]

    def sent_after(self, us: int) -> list[Any]:
        mav = mavlink.MAVLink(None)
        data = [
            o.data
            for tick in self.ticks
            if tick.now_us > us
            for o in tick.outputs
            if isinstance(o, Datagram) and o.link == VEHICLE_LINK
        ]
        return [mav.decode(bytearray(d)) for d in data]


@BOTH
@pytest.mark.parametrize("phase", [Phase.TAKING_OFF, Phase.FLYING])
def test_a_fault_of_our_own_in_the_air_is_told_with_its_traceback_and_the_vehicle_is_landed(
    autopilot: Autopilot, phase: Phase, monkeypatch: pytest.MonkeyPatch
) -> None:
    bench = Bench(autopilot, monkeypatch)
    meter = FlightMeter(bench.companion)
    bench.fall(phase, 3.0 if phase is Phase.FLYING else 1.0)
    bench.fly(meter)
    assert bench.companion.over
    assert bench.companion.failure.startswith("a fault of the companion's own: ZeroDivisionError: of ours; the vehicle")
    assert bench.companion.failure.endswith("it is down and disarmed")
    ((text, trace),) = bench.told
    assert "of ours" in text
    assert "in falling" in trace
    assert not bench.vehicle.flying.armed
    assert abs(bench.vehicle.truth.position_n[2]) < 0.2
    verdict = judge(bench.companion, meter)
    assert not verdict.ok
    assert verdict.failure == bench.companion.failure


@BOTH
def test_after_a_fault_of_our_own_no_setpoint_leaves_and_a_landing_is_asked_for_until_it_shows(
    autopilot: Autopilot, monkeypatch: pytest.MonkeyPatch
) -> None:
    bench = Bench(autopilot, monkeypatch)
    bench.fall(Phase.FLYING)
    bench.fly()
    fell_us = next(
        t.now_us for t in bench.ticks for o in t.outputs if isinstance(o, Datagram) and b"companion failed" in o.data
    )
    kinds = [m.get_type() for m in bench.sent_after(fell_us - 1)]
    assert set(kinds) == {"STATUSTEXT", "HEARTBEAT", "COMMAND_LONG"}
    assert 1 <= kinds.count("COMMAND_LONG") <= 4
    assert kinds.count("HEARTBEAT") >= 3
    to_ground = [o for t in bench.ticks if t.now_us > fell_us for o in t.outputs if getattr(o, "link", "") == "out0"]
    assert len(to_ground) > 50  # a pilot's ground station goes on seeing the vehicle


@BOTH
def test_a_pilot_who_takes_the_vehicle_after_a_fault_of_our_own_is_left_alone(
    autopilot: Autopilot, monkeypatch: pytest.MonkeyPatch
) -> None:
    bench = Bench(autopilot, monkeypatch)
    bench.fall(Phase.FLYING)
    mode = (1, 3, 0) if autopilot == "px4" else (1, 5, 0)  # Position, LOITER
    pilot = mavlink.MAVLink(None, srcSystem=255, srcComponent=190)

    def heard(now_us: int) -> list[Datagram]:
        if bench.companion.phase is not Phase.FAILED or now_us % 500_000:
            return []
        asked = mavlink.MAVLink_command_long_message(1, 1, mavlink.MAV_CMD_DO_SET_MODE, 0, *mode, 0, 0, 0, 0)
        return [Datagram("out0", bytes(asked.pack(pilot)), ("127.0.0.1", 5))]

    monkeypatch.setattr(bench, "heard", heard)
    bench.fly()
    assert "which is somebody else's" in bench.companion.failure
    assert bench.vehicle.flying.armed


def test_a_fault_of_our_own_on_the_ground_ends_the_flight_and_asks_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    bench = Bench("px4", monkeypatch)
    bench.fall(Phase.PREPARING)
    bench.fly()
    assert bench.companion.failure == "a fault of the companion's own: ZeroDivisionError: of ours"
    assert not any(b"companion failed" in o.data for t in bench.ticks for o in t.outputs if isinstance(o, Datagram))


def test_a_recorder_or_a_page_that_fails_is_left_out_and_the_mission_is_flown_to_its_end(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    bench, looks = Bench("px4", monkeypatch), []

    def page(tick: Tick) -> None:
        looks.append(tick.index)
        if tick.index == 300:
            raise KeyError("no such card")

    bench.fly(page)
    assert bench.companion.phase is Phase.DONE
    assert looks[-1] == 300
    ((text, trace),) = bench.told
    assert "page failed and is left out: KeyError: 'no such card'" in text
    assert "in page" in trace
    assert bench.companion.failure == text


def test_the_recording_of_a_flight_with_a_fault_of_our_own_leads_to_the_tick_that_failed(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    bench, file = Bench("px4", monkeypatch), tmp_path / "fault.mcap"
    bench.fall(Phase.FLYING)
    with Recorder(file, threaded=False, **header(bench.companion, LONG.encode())) as recorder:
        bench.fly(RecordingTap(bench.companion, recorder))
    fatal = next(t for t in bench.ticks if any(b"companion failed" in getattr(o, "data", b"") for o in t.outputs))
    again = rerun(Recording(file))  # there the fault is not: it was put in from outside
    assert again.comparison.first is not None
    assert again.comparison.first.tick == fatal.index - 1
    before = bench.ticks[fatal.index - 1]
    assert (before.index, before.outputs) == (fatal.index - 1, [])
    assert before.inputs
    assert again.ticks == len(bench.ticks)


def test_a_last_resort_gives_up_a_vehicle_that_is_not_heard_for_a_minute() -> None:
    companion = Companion(parse_mission(HOP.encode(), "hop.yaml"), CompanionConfig(system_id=1))
    resort = LastResort(companion.link, companion.autopilot, companion.telemetry)
    now_us = 0
    while not resort.over:
        resort.step(now_us, [Datagram(VEHICLE_LINK, b"\xfd\x00garbage", None)])
        now_us += resort.TICK_US
    assert 60.0 < now_us / 1e6 < 60.1
    assert resort.end == "nothing heard from it for 60 s"
