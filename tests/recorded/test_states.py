"""What real autopilots said, second by second, and what the companion makes of it.

The seconds are those of the recordings; each row is one thing that a reading of the protocol alone gets wrong.
"""

import pytest

from companion.core import Companion, CompanionConfig
from companion.drivers.planning import InlinePlanning
from companion.missionfile import load_mission
from companion.phases import Phase
from companion.seam import PlanWanted
from companion.vehiclelink import VEHICLE_LINK
from tests.recorded.streams import DATA, Listener, packets
from wire.datagram import Datagram
from wire.dialect import mavlink

PX4, ARDUPILOT = mavlink.MAV_AUTOPILOT_PX4, mavlink.MAV_AUTOPILOT_ARDUPILOTMEGA
CIRCLE = "arducopter-guided-circle-streams.tlog.gz"
SERVICES = "arducopter-services-streams.tlog.gz"
OFFBOARD = "px4-offboard-streams.tlog.gz"
MISSION = load_mission("missions/l_shape.yaml")


@pytest.mark.parametrize(
    ("second", "reason"),
    [
        (1.02, "booting"),
        (6.2, "pre-arm checks fail"),
        (23.7, "no local position"),  # pre-arm checks pass in STABILIZE 18 s before there is a position
        (41.60, "estimator not converged"),
        (42.1, "armed already"),
    ],
)
def test_an_arducopter_is_not_ready(second, reason):
    assert reason in Listener(CIRCLE, ARDUPILOT).until(second).not_ready


def test_an_arducopter_is_ready_once_position_estimator_and_checks_are_good():
    listener = Listener(CIRCLE, ARDUPILOT)
    assert listener.until(41.60).not_ready
    assert not listener.until(41.70).not_ready


@pytest.mark.parametrize(
    ("second", "reason"),
    [
        (0.5, "no local position"),
        (2.5, "estimator not converged"),  # a local position comes from the first second on
        (3.99, "pre-arm checks fail"),
        (10.9, "pre-arm checks fail"),
        (14.0, "armed already"),
    ],
)
def test_a_px4_is_not_ready(second, reason):
    assert reason in Listener(OFFBOARD, PX4).until(second).not_ready


def test_a_px4_is_ready_although_its_estimator_says_constant_position_and_its_check_is_not_marked_as_present():
    assert not Listener(OFFBOARD, PX4).until(4.05).not_ready


def test_a_px4_in_offboard_without_a_stream_fails_its_own_check_and_is_ready_all_the_same():
    listener = Listener(OFFBOARD, PX4).until(8.2)
    assert listener.in_control
    assert not listener.telemetry.prearm_ok
    assert not listener.not_ready


def test_a_mode_that_an_arducopter_shows_and_acknowledges_while_it_boots_does_not_count():
    listener = Listener(SERVICES, ARDUPILOT).until(0.36)
    assert listener.acks[-1][1:] == (mavlink.MAV_CMD_DO_SET_MODE, mavlink.MAV_RESULT_ACCEPTED)
    assert listener.telemetry.custom_mode == 4
    assert not listener.in_control
    assert listener.until(1.5).telemetry.custom_mode == 0  # lost when the boot ends


@pytest.mark.parametrize(
    ("name", "number", "before", "acknowledged", "shown"),
    [
        (CIRCLE, ARDUPILOT, 41.69, 41.706, 42.05),
        (SERVICES, ARDUPILOT, 141.2, 141.249, 142.04),
        (OFFBOARD, PX4, 12.1, 12.187, 13.3),
    ],
)
def test_arming_is_what_heartbeat_says_up_to_a_second_after_the_answer(name, number, before, acknowledged, shown):
    listener = Listener(name, number)
    assert not listener.until(before).telemetry.armed
    assert (mavlink.MAV_CMD_COMPONENT_ARM_DISARM, 0) in [ack[1:] for ack in listener.until(acknowledged).acks]
    assert not listener.telemetry.armed
    assert listener.until(shown).telemetry.armed


@pytest.mark.parametrize(("name", "climbs", "flies"), [(CIRCLE, (45.2, 49.4), 49.6), (SERVICES, (146.0, 150.1), 150.2)])
def test_an_arducopter_that_still_climbs_takes_no_setpoints_yet(name, climbs, flies):
    listener = Listener(name, ARDUPILOT)
    for second in climbs:
        assert listener.until(second).telemetry.landed_state == mavlink.MAV_LANDED_STATE_TAKEOFF
        assert not listener.autopilot.airborne(listener.telemetry)
    assert listener.autopilot.airborne(listener.until(flies).telemetry)


def test_a_px4_shows_its_mode_in_current_mode_before_heartbeat_does():
    listener = Listener(OFFBOARD, PX4)
    assert not listener.until(16.72).in_control
    assert listener.until(16.83).in_control  # HEARTBEAT says so at 17.21


def test_a_px4_that_refuses_offboard_while_armed_without_a_stream_asks_to_be_asked_again():
    listener = Listener(OFFBOARD, PX4).until(14.2)
    assert listener.acks[-1][1:] == (mavlink.MAV_CMD_DO_SET_MODE, mavlink.MAV_RESULT_TEMPORARILY_REJECTED)


def test_an_arducopter_whose_stream_stops_stays_in_guided():
    listener = Listener(CIRCLE, ARDUPILOT)  # no setpoint from 69.4 to 77.45
    for second in range(69, 78):
        assert listener.until(second).in_control


def test_a_px4_that_lost_our_stream_is_told_apart_from_a_pilot_who_chose_hold():
    listener = Listener(OFFBOARD, PX4)
    listener.until(10.9)  # a client chose Hold
    assert listener.autopilot.mode_name(listener.telemetry) == "Hold"
    assert not listener.autopilot.lost_our_stream(listener.telemetry)
    for second in (62.57, 62.8, 69.5):
        assert listener.autopilot.lost_our_stream(listener.until(second).telemetry), second
    assert listener.until(69.6).in_control


@pytest.mark.parametrize(
    ("name", "number", "landing", "landed", "disarmed"),
    [(CIRCLE, ARDUPILOT, 77.6, 89.6, 90.1), (OFFBOARD, PX4, 78.2, 88.2, 90.3)],
)
def test_a_landing_is_followed_to_the_disarming(name, number, landing, landed, disarmed):
    listener = Listener(name, number)
    assert listener.autopilot.comes_down(listener.until(landing).telemetry)
    assert listener.telemetry.landed_state == mavlink.MAV_LANDED_STATE_LANDING
    assert listener.until(landed).telemetry.landed_state == mavlink.MAV_LANDED_STATE_ON_GROUND
    assert listener.telemetry.armed
    assert not listener.until(disarmed).telemetry.armed


def test_home_moves_and_the_local_origin_does_not():
    listener, homes, origins = Listener(OFFBOARD, PX4), set(), set()
    for second in range(3, 100):
        t = listener.until(second).telemetry
        homes.add(t.home_e7)
        origins.add(t.origin_e7)
    assert len(homes) > 2
    assert len(origins) == 1


def test_nothing_in_a_recording_looks_like_another_boot():
    for name, number in ((CIRCLE, ARDUPILOT), (SERVICES, ARDUPILOT), (OFFBOARD, PX4)):
        assert Listener(name, number).until(1e4).telemetry.boots == 1


class Ride:
    """A companion that believes to fly the recorded vehicle; its plans are never answered."""

    def __init__(self, name, number, start_s):
        listener = Listener(name, number).until(start_s)
        self.companion = Companion(MISSION, CompanionConfig())
        self.companion.telemetry, self.companion.link = listener.telemetry, listener.link
        self.companion.autopilot = listener.autopilot
        self.companion.phase = Phase.FLYING
        self.companion.origin_n = listener.telemetry.position_n - self.companion.itinerary.reference(0).position_m
        self.out = []
        recorded = list(packets(DATA / name))
        self._packets = [(t - recorded[0][0], data) for t, data in recorded if t - recorded[0][0] > start_s * 1e6]
        self._now_us = round(start_s * 1e6)

    def until(self, second):
        """Step through the recording at 50 Hz."""
        while self._now_us < second * 1e6:
            self._now_us += 20_000
            inputs = []
            while self._packets and self._packets[0][0] <= self._now_us:
                inputs.append(Datagram(VEHICLE_LINK, self._packets.pop(0)[1], ("vehicle", 1)))
            self.out.extend(self.companion.step(self._now_us, inputs))
        return self.companion


def test_an_rtl_by_the_fence_is_handed_over_with_what_the_vehicle_said():
    ride = Ride(SERVICES, ARDUPILOT, 258.0)
    assert ride.until(261.5).phase in (Phase.FLYING, Phase.REJOINING)
    assert ride.until(263.5).phase is Phase.HANDED_OVER
    assert ride.companion.failure.startswith("the vehicle is in RTL now (Polygon fence breached)")


def test_an_estimator_failsafe_is_handed_over_by_its_name():
    ride = Ride(SERVICES, ARDUPILOT, 369.0)
    ride.until(373.0)
    assert ride.companion.phase is Phase.HANDED_OVER
    assert ride.companion.failure.startswith("ArduPilot's failsafe chose LAND (EKF Failsafe: changed to LAND Mode)")


def test_a_px4_that_lost_our_stream_is_not_handed_over_and_a_landing_by_somebody_else_is():
    ride = Ride(OFFBOARD, PX4, 60.0)
    for second in (62.6, 63.0, 66.0, 69.4, 70.0):
        assert ride.until(second).phase in (Phase.FLYING, Phase.REJOINING), second
    assert not ride.companion.failure
    assert any(isinstance(o, PlanWanted) for o in ride.out)  # a way back was asked for
    ride = Ride(OFFBOARD, PX4, 76.5)
    assert ride.until(79.0).phase is Phase.HANDED_OVER
    assert ride.companion.failure.startswith("the vehicle is in Land now")


def test_a_companion_that_rides_along_is_ready_plans_arms_and_takes_off_when_the_arducopter_does():
    companion, changes = Companion(MISSION, CompanionConfig()), {}
    planning = InlinePlanning(MISSION.planner_world())
    recorded = list(packets(DATA / CIRCLE))
    first, waiting = recorded[0][0], list(reversed(recorded))
    answer = mavlink.MAVLink_command_ack_message(mavlink.MAV_CMD_SET_MESSAGE_INTERVAL, mavlink.MAV_RESULT_ACCEPTED)
    answer = Datagram(VEHICLE_LINK, bytes(answer.pack(mavlink.MAVLink(None, 1, 1))), ("vehicle", 1))
    for now_us in range(0, 50_000_000, 20_000):
        inputs = [*planning.ready(), *([answer] if companion.phase is Phase.PREPARING else [])]
        while waiting and waiting[-1][0] - first <= now_us:
            inputs.append(Datagram(VEHICLE_LINK, waiting.pop()[1], ("vehicle", 1)))
        for output in companion.step(now_us, inputs):
            if isinstance(output, PlanWanted):
                planning.submit(output)
        changes.setdefault(companion.phase, now_us / 1e6)
    assert 41.65 < changes[Phase.PLANNING] < 41.75
    assert changes[Phase.ARMING] == pytest.approx(changes[Phase.PLANNING] + 0.05, abs=0.05)  # it is in GUIDED already
    assert 42.04 < changes[Phase.TAKING_OFF] < 42.08
    assert 49.49 < changes[Phase.FLYING] < 49.53
