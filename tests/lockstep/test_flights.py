"""Whole flights in memory: the real companion, planner and vehicle, no socket, no clock."""

import re
from pathlib import Path

import numpy as np
import pytest

from companion.phases import Phase
from companion.seam import Order, Reference
from tests.conftest import HOP
from wire.datagram import Datagram
from wire.dialect import mavlink
from wire.framing import Framer


def sent(flight, message_id):
    """(time [s], packet) of everything of one kind that the companion sent."""
    framer = Framer()
    return [
        (tick.now_us / 1e6, packet)
        for tick in flight.ticks
        for output in tick.outputs
        if isinstance(output, Datagram)
        for packet in framer.packets(output.data)
        if packet.message_id == message_id
    ]


def test_the_l_shaped_wall_is_flown_round_as_the_mission_expects(fly):
    flight = fly(Path("missions/l_shape.yaml").read_text())
    verdict = flight.verdict
    assert verdict.ok, (verdict.failure, verdict.failed_expectations)
    assert verdict.tracking_error_source == "truth"
    assert verdict.tracking_error_p95_m < 0.35
    assert verdict.min_clearance_m > 0.1
    assert 18.5 < verdict.path_length_m < 26


def test_from_the_first_setpoint_to_the_landing_one_leaves_every_20_ms(fly):
    times = np.array([t for t, _ in sent(fly(), mavlink.MAVLINK_MSG_ID_SET_POSITION_TARGET_LOCAL_NED)])
    np.testing.assert_allclose(np.diff(times), 0.02, atol=1e-9)


def test_setpoints_stream_before_offboard_is_asked_for_and_arming_waits_until_the_mode_is_confirmed(fly):
    flight = fly()
    first_setpoint = sent(flight, mavlink.MAVLINK_MSG_ID_SET_POSITION_TARGET_LOCAL_NED)[0][0]
    mav = mavlink.MAVLink(None)
    commands = [
        (t, mav.decode(bytearray(packet.raw))) for t, packet in sent(flight, mavlink.MAVLINK_MSG_ID_COMMAND_LONG)
    ]
    offboard = next(t for t, c in commands if c.command == mavlink.MAV_CMD_DO_SET_MODE and c.param2 == 6)
    arm = next(t for t, c in commands if c.command == mavlink.MAV_CMD_COMPONENT_ARM_DISARM)
    assert first_setpoint + 0.4 < offboard < arm
    confirmed = next(t.now_us / 1e6 for t in flight.ticks if flight.companion.phase and "arming" in str(t.outputs))
    assert offboard < confirmed <= arm


def test_heartbeats_leave_once_a_second_as_an_onboard_controller(fly):
    beats = sent(fly(), mavlink.MAVLINK_MSG_ID_HEARTBEAT)
    np.testing.assert_allclose(np.diff([t for t, _ in beats]), 1.0, atol=1e-9)
    beat = mavlink.MAVLink(None).decode(bytearray(beats[0][1].raw))
    assert (beat.get_srcSystem(), beat.get_srcComponent()) == (1, 191)
    assert (beat.type, beat.autopilot) == (mavlink.MAV_TYPE_ONBOARD_CONTROLLER, mavlink.MAV_AUTOPILOT_INVALID)
    assert not beat.base_mode & mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED


def test_the_reference_has_no_jump_in_position_velocity_or_acceleration(fly):
    flight = fly()
    references = [o for tick in flight.ticks for o in tick.outputs if isinstance(o, Reference)]
    position, velocity, acceleration = (
        np.array([getattr(r, name) for r in references]) for name in ("position_m", "velocity_m", "acceleration_m")
    )
    limits, dt = flight.companion.mission.limits, 0.02
    assert np.linalg.norm(np.diff(position, axis=0), axis=1).max() <= limits.speed * dt * 1.001
    assert np.linalg.norm(np.diff(velocity, axis=0), axis=1).max() <= limits.acceleration * dt * 1.001
    assert np.linalg.norm(np.diff(acceleration, axis=0), axis=1).max() <= limits.jerk * dt * 1.001


def test_an_operator_who_asks_for_land_in_flight_gets_a_landing_and_a_failed_verdict(fly):
    asked = []

    def operator(companion, now_us):
        if companion.phase is Phase.FLYING and companion.itinerary.step.kind == "goto" and not asked:
            asked.append(now_us)
            return Order("land")
        return None

    flight = fly(operator=operator)
    assert flight.companion.phase is Phase.DONE
    assert not flight.verdict.ok
    assert "operator" in flight.verdict.failure


def test_a_mission_without_a_path_is_refused_on_the_ground_with_the_planners_reason(fly):
    walled = HOP.replace("    - cyl", "    - box: {north: [3, 3.5], east: [-1, 11], altitude: [-1, 5]}\n    - cyl")
    flight = fly(walled)
    assert flight.companion.phase is Phase.FAILED
    assert "no plan: step 1: no path found" in flight.verdict.failure
    assert not any("armed" in note for note in flight.notes)
    mav = mavlink.MAVLink(None)
    asked = [mav.decode(bytearray(p.raw)).command for _, p in sent(flight, mavlink.MAVLINK_MSG_ID_COMMAND_LONG)]
    assert set(asked) == {mavlink.MAV_CMD_SET_MESSAGE_INTERVAL}


class Silent:
    """A vehicle that vanishes at a given time."""

    def __init__(self, vehicle, after_us):
        self.vehicle, self.after_us, self.TICK_US = vehicle, after_us, vehicle.TICK_US

    def step(self, now_us, inputs):
        return self.vehicle.step(now_us, inputs) if now_us < self.after_us else []


def test_a_vehicle_that_vanishes_in_flight_is_spoken_to_for_a_minute_and_given_up_in_one_line(fly):
    flight = fly(between=lambda vehicle: Silent(vehicle, 10_000_000))
    assert flight.companion.phase is Phase.FAILED
    assert flight.verdict.failure == "nothing heard from the vehicle for 60 s"
    assert flight.ticks[-1].now_us == pytest.approx(70_000_000, abs=100_000)
    lost = next(t.now_us for t in flight.ticks if any("-> link lost" in str(o) for o in t.outputs))
    assert lost == pytest.approx(13_000_000, abs=100_000)
    setpoints = [t for t, _ in sent(flight, mavlink.MAVLINK_MSG_ID_SET_POSITION_TARGET_LOCAL_NED)]
    assert setpoints[-1] == pytest.approx(70.0, abs=0.1)


def test_a_vehicle_that_never_answers_is_given_up_after_the_time_to_wait(fly):
    flight = fly(between=lambda vehicle: Silent(vehicle, 0))
    assert flight.verdict.failure == "no HEARTBEAT from a vehicle in 60 s"
    assert not [o for tick in flight.ticks for o in tick.outputs if isinstance(o, Datagram)]


def test_a_pilot_who_takes_the_mode_is_not_fought(fly):
    class Pilot:
        """Asks the vehicle for Hold at 12 s, from a ground station's address."""

        def __init__(self, vehicle):
            self.vehicle, self.TICK_US = vehicle, vehicle.TICK_US
            mav = mavlink.MAVLink(None, srcSystem=255, srcComponent=190)
            hold = mavlink.MAVLink_command_long_message(1, 1, mavlink.MAV_CMD_DO_SET_MODE, 0, 1, 4, 3, 0, 0, 0, 0)
            self.hold = Datagram("onboard", bytes(hold.pack(mav)), ("pilot", 1))

        def step(self, now_us, inputs):
            takes = [self.hold] if now_us == 12_000_000 else []
            return [d for d in self.vehicle.step(now_us, [*inputs, *takes]) if d.peer != ("pilot", 1)]

    flight = fly(between=Pilot)
    assert flight.companion.phase is Phase.HANDED_OVER
    after = [t for t, _ in sent(flight, mavlink.MAVLINK_MSG_ID_COMMAND_LONG) if t > 12.0]
    assert not after


class Drifting:
    """A vehicle whose position begins to run away at 8 s."""

    def __init__(self, vehicle):
        self.vehicle, self.TICK_US = vehicle, vehicle.TICK_US
        self.mav = mavlink.MAVLink(None, srcSystem=1, srcComponent=1)

    def step(self, now_us, inputs):
        out = self.vehicle.step(now_us, inputs)
        for k, datagram in enumerate(out):
            if now_us > 8_000_000 and datagram.data[7:10] == bytes([32, 0, 0]):
                m = mavlink.MAVLink(None).decode(bytearray(datagram.data))
                m.x += 1e-6 * (now_us - 8_000_000)
                out[k] = Datagram(datagram.link, bytes(m.pack(self.mav)), datagram.peer)
        return out


def test_a_vehicle_that_strays_is_led_back_until_there_is_no_way_back_and_then_landed_with_the_reason_told(fly):
    flight = fly(between=Drifting)
    assert flight.companion.phase is Phase.DONE
    assert not flight.verdict.ok
    assert any(re.search(r"the vehicle is 1\.\d m from its reference", note) for note in flight.notes)
    assert re.match(r"no way back to the mission: the start at .* beyond the upper north bound", flight.verdict.failure)


class Deaf:
    """A vehicle that tells no position after 8 s."""

    def __init__(self, vehicle):
        self.vehicle, self.TICK_US = vehicle, vehicle.TICK_US

    def step(self, now_us, inputs):
        out = self.vehicle.step(now_us, inputs)
        return [d for d in out if now_us < 8_000_000 or d.data[7:10] != bytes([32, 0, 0])]


def test_a_flight_without_position_lands(fly):
    flight = fly(between=Deaf)
    assert flight.companion.phase is Phase.DONE
    assert flight.verdict.failure == "no position from the vehicle for 3 s: landing"


def test_land_asked_while_arming_disarms(fly):
    flight = fly(operator=lambda companion, now_us: Order("land") if companion.phase is Phase.ARMING else None)
    assert flight.companion.phase is Phase.FAILED
    mav = mavlink.MAVLink(None)
    last = mav.decode(bytearray(sent(flight, mavlink.MAVLINK_MSG_ID_COMMAND_LONG)[-1][1].raw))
    assert (last.command, last.param1) == (mavlink.MAV_CMD_COMPONENT_ARM_DISARM, 0)


def test_a_mission_that_begins_under_a_roof_is_refused_on_the_ground(fly):
    roof = "    - box: {north: [1, 3], east: [1, 3], altitude: [1.2, 1.4]}\n    - cyl"
    flight = fly(HOP.replace("    - cyl", roof))
    assert flight.companion.phase is Phase.FAILED
    assert "the climb at north 2, east 2, altitude 1.5" in flight.verdict.failure
