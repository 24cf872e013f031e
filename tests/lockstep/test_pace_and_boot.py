"""A vehicle whose time runs otherwise than ours, that starts before or after us, or starts again."""

import numpy as np
import pytest

from companion.cli.vehicle import build_vehicle
from companion.missionfile import parse_mission
from companion.phases import Phase
from companion.seam import Reference
from tests.conftest import HOP
from tests.lockstep.test_flights import sent
from wire.dialect import mavlink

FLAVOURS = ("px4", "ardupilot")


class Paced:
    """A vehicle that lives `rate` seconds in one of ours, and was started `late_s` after us or before us (negative)."""

    def __init__(self, vehicle, rate=1.0, late_s=0.0):
        self.vehicle, self.TICK_US, self.rate = vehicle, vehicle.TICK_US, rate
        self.own_us, self.due_us = 0, -late_s * 1e6
        self.heard = []
        while self.due_us > self.TICK_US:
            self.due_us -= self.TICK_US
            self.own_us += self.TICK_US
            vehicle.step(self.own_us, [])

    def step(self, now_us, inputs):
        self.heard += inputs
        self.due_us += self.TICK_US * (self.rate if self.due_us >= 0 else 1.0)
        out = []
        while self.due_us >= self.TICK_US:
            self.due_us -= self.TICK_US
            self.own_us += self.TICK_US
            out += self.vehicle.step(self.own_us, self.heard)
            self.heard = []
        return out


@pytest.mark.parametrize("rate", [0.5, 0.987, 2.0])
@pytest.mark.parametrize("autopilot", FLAVOURS)
def test_the_mission_is_flown_at_the_vehicles_pace_whatever_it_is(fly, autopilot, rate):
    flight = fly(autopilot=autopilot, between=lambda vehicle: Paced(vehicle, rate))
    assert flight.companion.phase is Phase.DONE
    assert not flight.companion.failure
    assert flight.companion.clock.rate == pytest.approx(rate, rel=0.004)
    assert flight.verdict.tracking_error_p95_m <= 0.25
    references = [(t.now_us, o) for t in flight.ticks for o in t.outputs if isinstance(o, Reference)]
    fastest = max(references, key=lambda r: float(np.linalg.norm(r[1].velocity_m)))
    k = references.index(fastest)
    (a_us, a), (b_us, b) = references[k - 2], references[k + 2]
    over_our_time = np.linalg.norm(b.position_m - a.position_m) / ((b_us - a_us) / 1e6)
    assert over_our_time == pytest.approx(rate * np.linalg.norm(fastest[1].velocity_m), rel=0.05)


def test_a_vehicle_in_step_with_us_has_exactly_our_time(fly):
    flight = fly()
    assert flight.companion.clock.rate == 1.0


@pytest.mark.parametrize("late_s", [-30.0, 30.0])
@pytest.mark.parametrize("autopilot", FLAVOURS)
def test_either_side_may_start_half_a_minute_before_the_other(fly, autopilot, late_s):
    flight = fly(autopilot=autopilot, between=lambda vehicle: Paced(vehicle, late_s=late_s))
    assert flight.verdict.ok, flight.verdict.failure


def another(autopilot):
    return build_vehicle(parse_mission(HOP.encode(), "test.yaml"), 2, autopilot)


class Restarted:
    """Another vehicle from `at_s` on, after some seconds of nothing."""

    def __init__(self, first, second, at_s, silent_s=4.0):
        self.vehicle, self.second, self.TICK_US = first, second, first.TICK_US
        self.at_us, self.back_us, self.own_us = at_s * 1e6, (at_s + silent_s) * 1e6, 0

    def step(self, now_us, inputs):
        if now_us < self.at_us:
            return self.vehicle.step(now_us, inputs)
        if now_us < self.back_us:
            return []
        self.own_us += self.TICK_US
        return self.second.step(self.own_us, inputs)


@pytest.mark.parametrize("autopilot", FLAVOURS)
@pytest.mark.parametrize(("at_s", "silent_s"), [(3.0, 5.0), (3.0, 0.1), (5.25, 5.0)])
def test_a_vehicle_that_starts_again_on_the_ground_is_flown(fly, autopilot, at_s, silent_s):
    flight = fly(
        autopilot=autopilot,
        between=lambda vehicle: Restarted(vehicle, another(autopilot), at_s, silent_s),
    )
    assert flight.companion.phase is Phase.DONE, flight.notes
    assert not flight.companion.failure
    asked = [t for t, _ in sent(flight, mavlink.MAVLINK_MSG_ID_COMMAND_LONG) if t > at_s + silent_s]
    assert asked


@pytest.mark.parametrize("autopilot", FLAVOURS)
def test_a_vehicle_that_starts_again_in_the_air_gets_no_more_commands_and_the_reason_is_told(fly, autopilot):
    flight = fly(autopilot=autopilot, between=lambda vehicle: Restarted(vehicle, another(autopilot), 9.0, 1.0))
    assert flight.companion.phase is Phase.FAILED
    assert "booted again" in flight.companion.failure or "disarmed" in flight.companion.failure
    assert not [t for t, _ in sent(flight, mavlink.MAVLINK_MSG_ID_COMMAND_LONG) if t > 9.0]
