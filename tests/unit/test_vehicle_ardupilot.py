"""The ArduPilot flavour as a client sees it: modes, arming, GUIDED, streams on request, parameters, order of answers.

The flight stack is a point that follows its setpoint; what is flown is tested with the recordings in
tests/side_by_side.
"""

import math
import struct
from typing import Any

import pytest
from flight_double import PointMass
from vehicle_pilot import ACCEPTED, DENIED, FAILED, UNSUPPORTED, Pilot

import fakevehicle.vehicle
from fakevehicle.config import VehicleConfig
from fakevehicle.vehicle import Vehicle
from wire.dialect import mavlink

_m = mavlink
STABILIZE, ALT_HOLD, AUTO, GUIDED, LOITER, RTL, LAND, BRAKE = 0, 2, 3, 4, 5, 6, 9, 17
BOOTED_S = 3.5


@pytest.fixture
def pilot(monkeypatch: pytest.MonkeyPatch) -> Pilot:
    """A client of a vehicle that has booted and knows where it is."""
    pilot = booting(monkeypatch)
    pilot.run(BOOTED_S)
    return pilot


def booting(monkeypatch: pytest.MonkeyPatch) -> Pilot:
    monkeypatch.setattr(fakevehicle.vehicle, "FlightStack", PointMass)
    return Pilot(Vehicle(VehicleConfig(autopilot="ardupilot")))


def mode(pilot: Pilot) -> int:
    return int(pilot.last("HEARTBEAT").custom_mode)


def fly(pilot: Pilot, height: float = 5.0) -> None:
    """Up in GUIDED."""
    assert pilot.command(_m.MAV_CMD_DO_SET_MODE, 1, GUIDED) == ACCEPTED
    assert pilot.command(_m.MAV_CMD_COMPONENT_ARM_DISARM, 1) == ACCEPTED
    assert pilot.command(_m.MAV_CMD_NAV_TAKEOFF, 0, 0, 0, 0, 0, 0, height) == ACCEPTED
    pilot.run(10)


def local(mask: int, x: float, y: float, z: float, v: tuple[float, float, float] = (0, 0, 0), frame: int = 1) -> Any:
    return _m.MAVLink_set_position_target_local_ned_message(0, 1, 1, frame, mask, x, y, z, *v, 0, 0, 0, 0, 0)


def kinds(heard: list[Any]) -> list[str]:
    return [m.get_type() for m in heard]


def test_it_says_nothing_but_its_heartbeat_until_it_is_asked(monkeypatch: pytest.MonkeyPatch) -> None:
    pilot = booting(monkeypatch)
    heard = pilot.run(5)
    assert set(kinds(heard)) == {"HEARTBEAT", "STATUSTEXT", "GPS_GLOBAL_ORIGIN", "HOME_POSITION"}
    assert pilot.last("HEARTBEAT").autopilot == _m.MAV_AUTOPILOT_ARDUPILOTMEGA


def test_a_mode_chosen_during_boot_is_lost_at_its_end_and_nothing_arms_before(monkeypatch: pytest.MonkeyPatch) -> None:
    pilot = booting(monkeypatch)
    pilot.run(0.1)
    pilot.send(_m.MAVLink_command_long_message(1, 1, _m.MAV_CMD_COMPONENT_ARM_DISARM, 0, 1, 0, 0, 0, 0, 0, 0))
    assert kinds(pilot.tick())[:2] == ["STATUSTEXT", "COMMAND_ACK"]
    assert pilot.last("COMMAND_ACK").result == FAILED
    assert pilot.texts()[-1] == "Arm: System not initialised"
    assert pilot.command(_m.MAV_CMD_DO_SET_MODE, 1, GUIDED) == ACCEPTED
    assert (mode(pilot), pilot.last("HEARTBEAT").system_status) == (GUIDED, _m.MAV_STATE_BOOT)
    pilot.run(3)
    assert (mode(pilot), pilot.last("HEARTBEAT").system_status) == (STABILIZE, _m.MAV_STATE_STANDBY)
    assert "ArduPilot Ready" in pilot.texts()


def test_a_new_mode_is_acknowledged_and_then_told_at_once(pilot: Pilot) -> None:
    pilot.send(_m.MAVLink_command_long_message(1, 1, _m.MAV_CMD_DO_SET_MODE, 0, 1, GUIDED, 0, 0, 0, 0, 0))
    assert kinds(pilot.tick()) == ["COMMAND_ACK", "HEARTBEAT"]
    assert mode(pilot) == GUIDED


def test_the_old_message_changes_the_mode_without_an_ack(pilot: Pilot) -> None:
    pilot.send(_m.MAVLink_set_mode_message(1, 1, LOITER))
    assert kinds(pilot.tick()) == ["HEARTBEAT"]
    assert mode(pilot) == LOITER


def test_a_mode_that_does_not_exist_fails_in_words(pilot: Pilot) -> None:
    assert pilot.command(_m.MAV_CMD_DO_SET_MODE, 1, 99) == FAILED
    assert pilot.texts()[-1] == "No such mode 99"
    assert mode(pilot) == STABILIZE


def test_altitude_hold_is_armed_in_and_entered_without_a_position(pilot: Pilot) -> None:
    assert pilot.command(_m.MAV_CMD_DO_SET_MODE, 1, ALT_HOLD) == ACCEPTED
    assert pilot.command(_m.MAV_CMD_COMPONENT_ARM_DISARM, 1) == ACCEPTED
    assert pilot.command(_m.MAV_CMD_COMPONENT_ARM_DISARM, 0) == ACCEPTED
    fly(pilot)
    stack: Any = pilot.vehicle._stack
    stack.position_known = False
    pilot.run(0.1)
    assert pilot.command(_m.MAV_CMD_DO_SET_MODE, 1, LOITER) == FAILED
    assert pilot.texts()[-1].endswith("requires position")
    assert pilot.command(_m.MAV_CMD_DO_SET_MODE, 1, ALT_HOLD) == ACCEPTED
    pilot.run(4.0)
    heartbeat = pilot.last("HEARTBEAT")
    assert heartbeat.custom_mode == ALT_HOLD
    assert not heartbeat.base_mode & _m.MAV_MODE_FLAG_GUIDED_ENABLED
    assert float(pilot.vehicle.truth.position_n[2]) == pytest.approx(-5.0, abs=0.2)


@pytest.mark.parametrize("number", [AUTO, RTL, LAND, BRAKE])
def test_nobody_arms_in_a_mode_that_flies_by_itself(pilot: Pilot, number: int) -> None:
    assert pilot.command(_m.MAV_CMD_DO_SET_MODE, 1, number) == ACCEPTED
    assert pilot.command(_m.MAV_CMD_COMPONENT_ARM_DISARM, 1) == FAILED
    assert pilot.texts()[-1].endswith("mode not armable")


def test_every_reason_against_arming_is_a_text_of_its_own(pilot: Pilot) -> None:
    stack: Any = pilot.vehicle._stack
    stack.position_known = False
    pilot.run(0.1)
    before = len(pilot.texts())
    assert pilot.command(_m.MAV_CMD_COMPONENT_ARM_DISARM, 1) == FAILED
    assert pilot.texts()[before:] == ["Arm: Need Position Estimate"]


def test_arming_sends_no_heartbeat_of_its_own(pilot: Pilot) -> None:
    pilot.send(_m.MAVLink_command_long_message(1, 1, _m.MAV_CMD_COMPONENT_ARM_DISARM, 0, 1, 0, 0, 0, 0, 0, 0))
    heard = kinds(pilot.tick())
    assert heard[0] == "COMMAND_ACK"
    assert "HEARTBEAT" not in heard
    pilot.run(1)
    assert pilot.armed
    assert "Arming motors" in pilot.texts()


def test_takeoff_needs_guided_and_armed_motors_and_its_height_is_above_home(pilot: Pilot) -> None:
    assert pilot.command(_m.MAV_CMD_NAV_TAKEOFF, 0, 0, 0, 0, 0, 0, 4) == FAILED
    fly(pilot, 4.0)
    assert float(pilot.vehicle.truth.position_n[2]) == pytest.approx(-4.0, abs=0.2)
    assert mode(pilot) == GUIDED
    assert pilot.last("HEARTBEAT").system_status == _m.MAV_STATE_ACTIVE
    assert pilot.command(_m.MAV_CMD_NAV_TAKEOFF, 0, 0, 0, 0, 0, 0, 9) == FAILED  # in the air


def test_a_position_is_flown_to_and_never_times_out(pilot: Pilot) -> None:
    fly(pilot)
    pilot.send(local(0xDF8, 3, 4, -6))
    pilot.run(15)
    assert pilot.vehicle.truth.position_n.tolist() == pytest.approx([3, 4, -6], abs=0.1)
    assert mode(pilot) == GUIDED


def test_a_position_that_comes_during_the_takeoff_is_flown_to_after_it(pilot: Pilot) -> None:
    assert pilot.command(_m.MAV_CMD_DO_SET_MODE, 1, GUIDED) == ACCEPTED
    assert pilot.command(_m.MAV_CMD_COMPONENT_ARM_DISARM, 1) == ACCEPTED
    assert pilot.command(_m.MAV_CMD_NAV_TAKEOFF, 0, 0, 0, 0, 0, 0, 5) == ACCEPTED
    pilot.send(local(0xDF8, 7, 7, -5))  # still on the ground: dropped
    pilot.until(lambda: pilot.vehicle.truth.position_n[2] < -2.0, 10)
    pilot.send(local(0xDF8, 3, 0, -4))
    pilot.run(1.0)
    assert abs(float(pilot.vehicle.truth.position_n[0])) < 0.2
    pilot.run(15.0)
    assert pilot.vehicle.truth.position_n.tolist() == pytest.approx([3, 0, -4], abs=0.1)


def test_a_velocity_is_flown_for_three_seconds_and_ends_in_a_stop(pilot: Pilot) -> None:
    fly(pilot)
    pilot.send(local(0xDC7, 0, 0, 0, (1, 0, 0)))
    pilot.run(2.8)
    assert float(pilot.vehicle.truth.velocity_n[0]) == pytest.approx(1.0, abs=0.05)
    pilot.run(2)
    assert float(pilot.vehicle.truth.velocity_n[0]) == pytest.approx(0.0, abs=0.05)
    assert mode(pilot) == GUIDED


def test_what_cannot_be_read_is_a_stop(pilot: Pilot) -> None:
    fly(pilot)
    pilot.send(local(0xDC7, 0, 0, 0, (1, 0, 0)))
    pilot.run(1)
    pilot.send(local(0xFFF, 0, 0, 0))
    pilot.run(1)
    assert float(pilot.vehicle.truth.velocity_n[0]) == pytest.approx(0.0, abs=0.05)


@pytest.mark.parametrize("number", [LOITER, BRAKE])
def test_setpoints_are_flown_in_guided_only_and_a_return_to_it_does_not_bring_old_ones_back(
    pilot: Pilot, number: int
) -> None:
    fly(pilot)
    pilot.send(local(0xDF8, 8, 0, -5))
    pilot.run(1)
    assert pilot.command(_m.MAV_CMD_DO_SET_MODE, 1, number) == ACCEPTED
    pilot.run(3)
    held = pilot.vehicle.truth.position_n.tolist()
    pilot.send(local(0xDF8, -8, 0, -5))
    pilot.run(3)
    assert pilot.vehicle.truth.position_n.tolist() == pytest.approx(held, abs=0.1)
    assert "Setpoint refused: the mode is not GUIDED" in pilot.texts()
    assert pilot.command(_m.MAV_CMD_DO_SET_MODE, 1, GUIDED) == ACCEPTED
    pilot.run(3)
    assert pilot.vehicle.truth.position_n.tolist() == pytest.approx(held, abs=0.2)


def test_after_a_landing_the_mode_stays_land(pilot: Pilot) -> None:
    fly(pilot)
    assert pilot.command(_m.MAV_CMD_NAV_LAND) == ACCEPTED
    pilot.until(lambda: not pilot.vehicle.flying.armed, 40)
    pilot.run(1)
    assert (mode(pilot), pilot.armed) == (LAND, False)
    assert "Disarming motors" in pilot.texts()


def test_disarming_in_the_air_fails_unless_it_is_forced(pilot: Pilot) -> None:
    fly(pilot)
    assert pilot.command(_m.MAV_CMD_COMPONENT_ARM_DISARM, 0) == FAILED
    assert pilot.command(_m.MAV_CMD_COMPONENT_ARM_DISARM, 0, 21196) == ACCEPTED


@pytest.mark.parametrize(("action", "number"), [(1, BRAKE), (2, RTL), (3, LAND)])
def test_the_mode_a_failsafe_takes_is_shown(pilot: Pilot, action: int, number: int) -> None:
    pilot.send(_m.MAVLink_param_set_message(1, 1, b"NAV_DLL_ACT", action, _m.MAV_PARAM_TYPE_INT32))
    pilot.send(_m.MAVLink_heartbeat_message(_m.MAV_TYPE_GCS, _m.MAV_AUTOPILOT_INVALID, 0, 0, 0, 3))
    fly(pilot)
    pilot.until(lambda: mode(pilot) == number, 5)


def test_a_mode_that_needs_a_position_is_refused_in_the_air_without_one(pilot: Pilot) -> None:
    fly(pilot)
    stack: Any = pilot.vehicle._stack
    stack.position_known = False
    pilot.until(lambda: mode(pilot) == LAND, 10)
    assert "EKF Failsafe: changed to LAND Mode" in pilot.texts()
    assert pilot.command(_m.MAV_CMD_DO_SET_MODE, 1, GUIDED) == FAILED
    assert pilot.texts()[-1] == "Mode change to GUIDED failed: requires position"


def test_a_place_to_go_to_is_taken_as_command_int_only(pilot: Pilot) -> None:
    fly(pilot)
    assert pilot.command(_m.MAV_CMD_DO_REPOSITION, -1, 1, 0, 0, 47.3978, 8.5456, 500) == UNSUPPORTED
    place = (round(47.397742e7) + 900, round(8.545594e7), 6.0)  # 10 m north
    pilot.send(_m.MAVLink_command_int_message(1, 1, 6, _m.MAV_CMD_DO_REPOSITION, 0, 0, -1, 1, 0, float("nan"), *place))
    assert pilot.ack(pilot.tick(), _m.MAV_CMD_DO_REPOSITION) == ACCEPTED
    pilot.run(15)
    assert pilot.vehicle.truth.position_n.tolist() == pytest.approx([10.0, 0.0, -6.0], abs=0.3)


def test_a_place_to_go_to_takes_the_place_of_a_setpoint(pilot: Pilot) -> None:
    fly(pilot)
    pilot.send(local(0xDF8, 0, 3, -5))
    pilot.run(4)
    place = (round(47.397742e7) + 900, round(8.545594e7), 6.0)  # 10 m north
    pilot.send(_m.MAVLink_command_int_message(1, 1, 6, _m.MAV_CMD_DO_REPOSITION, 0, 0, -1, 1, 0, float("nan"), *place))
    pilot.run(15)
    assert pilot.vehicle.truth.position_n.tolist() == pytest.approx([10.0, 0.0, -6.0], abs=0.3)


def test_the_nose_turns_to_where_it_travels_unless_a_yaw_is_asked_for(pilot: Pilot) -> None:
    fly(pilot)
    stack: Any = pilot.vehicle._stack
    pilot.send(local(0xDC7, 0, 0, 0, (0, 2, 0)))
    pilot.run(2.9)
    assert stack.setpoint.yaw == pytest.approx(math.pi / 2, abs=0.02)
    pilot.send(local(0x9C7, 0, 0, 0, (0, 2, 0)))  # yaw 0 is asked for
    pilot.run(0.1)
    assert stack.setpoint.yaw == 0.0


def test_streams_start_by_group_and_stop_by_group(pilot: Pilot) -> None:
    pilot.send(_m.MAVLink_request_data_stream_message(1, 1, _m.MAV_DATA_STREAM_EXTRA1, 10, 1))
    heard = pilot.run(2)
    assert kinds(heard).count("ATTITUDE") == pytest.approx(20, abs=1)
    assert "SYS_STATUS" not in kinds(heard)
    assert "COMMAND_ACK" not in kinds(heard)
    pilot.send(_m.MAVLink_request_data_stream_message(1, 1, _m.MAV_DATA_STREAM_ALL, 4, 1))
    rates = kinds(pilot.run(2))
    assert {"SYS_STATUS", "ATTITUDE", "EKF_STATUS_REPORT", "LOCAL_POSITION_NED", "GPS_RAW_INT"} <= set(rates)
    assert rates.count("ATTITUDE") == pytest.approx(8, abs=1)
    pilot.send(_m.MAVLink_request_data_stream_message(1, 1, _m.MAV_DATA_STREAM_ALL, 4, 0))
    pilot.tick()
    assert set(kinds(pilot.run(2))) == {"HEARTBEAT"}


def test_an_unknown_stream_is_denied_and_an_unknown_message_fails(pilot: Pilot) -> None:
    assert pilot.command(_m.MAV_CMD_SET_MESSAGE_INTERVAL, 9999, 100000) == DENIED
    assert pilot.texts()[-1] == "No ap_message for mavlink id (9999)"
    assert pilot.command(_m.MAV_CMD_REQUEST_MESSAGE, 9999) == FAILED


def test_a_requested_message_comes_after_its_ack(pilot: Pilot) -> None:
    request = (_m.MAV_CMD_REQUEST_MESSAGE, 0, _m.MAVLINK_MSG_ID_AUTOPILOT_VERSION, 0, 0, 0, 0, 0, 0)
    pilot.send(_m.MAVLink_command_long_message(1, 1, *request))
    assert kinds(pilot.tick()) == ["COMMAND_ACK", "AUTOPILOT_VERSION"]
    capabilities = pilot.last("AUTOPILOT_VERSION").capabilities
    assert capabilities & _m.MAV_PROTOCOL_CAPABILITY_PARAM_ENCODE_C_CAST
    assert not capabilities & _m.MAV_PROTOCOL_CAPABILITY_PARAM_ENCODE_BYTEWISE


def test_its_modes_are_listed_one_by_one_and_past_the_end_is_nothing(pilot: Pilot) -> None:
    numbers = []
    for index in range(1, 9):
        assert pilot.command(_m.MAV_CMD_REQUEST_MESSAGE, _m.MAVLINK_MSG_ID_AVAILABLE_MODES, index) == ACCEPTED
        assert pilot.last("AVAILABLE_MODES").mode_index == index
        numbers.append(pilot.last("AVAILABLE_MODES").custom_mode)
    assert sorted(numbers) == [STABILIZE, ALT_HOLD, AUTO, GUIDED, LOITER, RTL, LAND, BRAKE]
    assert pilot.command(_m.MAV_CMD_REQUEST_MESSAGE, _m.MAVLINK_MSG_ID_AVAILABLE_MODES, 200) == ACCEPTED
    assert pilot.last("AVAILABLE_MODES").mode_index == 8


def test_parameters_have_ardupilots_names_units_and_casts(pilot: Pilot) -> None:
    pilot.send(_m.MAVLink_param_request_list_message(1, 1))
    pilot.run(1)
    listed = {m.param_id: m for m in pilot.of("PARAM_VALUE")}
    assert [m.param_index for m in pilot.of("PARAM_VALUE")] == list(range(len(listed)))
    assert listed["RTL_ALT"].param_value == 1500.0
    assert listed["RTL_ALT"].param_type == _m.MAV_PARAM_TYPE_INT32
    assert "RTL_RETURN_ALT" not in listed
    pilot.send(_m.MAVLink_param_set_message(1, 1, b"RTL_ALT", 2000.7, _m.MAV_PARAM_TYPE_REAL32))
    pilot.tick()
    echo = pilot.last("PARAM_VALUE")
    assert (echo.param_id, echo.param_value, echo.param_index) == ("RTL_ALT", 2000.0, 65535)
    assert pilot.vehicle.parameters["RTL_RETURN_ALT"] == 20.0
    assert struct.pack("<f", echo.param_value) != struct.pack("<i", 2000)


def test_a_loiter_by_command_is_the_mode(pilot: Pilot) -> None:
    fly(pilot)
    assert pilot.command(_m.MAV_CMD_NAV_LOITER_UNLIM) == ACCEPTED
    pilot.tick()
    assert mode(pilot) == LOITER


def test_a_mission_is_asked_for_in_the_old_form_and_its_first_item_is_home(pilot: Pilot) -> None:
    pilot.send(_m.MAVLink_mission_count_message(1, 1, 2, 0))
    assert kinds(pilot.tick()) == ["MISSION_REQUEST"]
    place = (round(47.397742e7), round(8.545594e7))
    for seq, command, frame in ((0, 16, 0), (1, 22, 6)):
        item = (seq, frame, command, 0, 1, 0, 0, 0, 0, *place, 5.0, 0)
        pilot.send(_m.MAVLink_mission_item_int_message(1, 1, *item))
        pilot.tick()
    assert pilot.last("MISSION_ACK").type == _m.MAV_MISSION_ACCEPTED
    pilot.send(_m.MAVLink_mission_request_list_message(1, 1, 0))
    pilot.tick()
    assert pilot.last("MISSION_COUNT").count == 2
    for seq, frame in ((0, 0), (1, 3)):
        pilot.send(_m.MAVLink_mission_request_int_message(1, 1, seq, 0))
        pilot.tick()
        assert (pilot.last("MISSION_ITEM_INT").seq, pilot.last("MISSION_ITEM_INT").frame) == (seq, frame)


def test_the_ekf_report_says_what_is_known(pilot: Pilot) -> None:
    assert pilot.command(_m.MAV_CMD_REQUEST_MESSAGE, _m.MAVLINK_MSG_ID_EKF_STATUS_REPORT) == ACCEPTED
    assert pilot.last("EKF_STATUS_REPORT").flags == 831  # what ArduCopter shows when it is ready
    stack: Any = pilot.vehicle._stack
    stack.position_known = False
    pilot.run(0.1)
    pilot.command(_m.MAV_CMD_REQUEST_MESSAGE, _m.MAVLINK_MSG_ID_EKF_STATUS_REPORT)
    assert pilot.last("EKF_STATUS_REPORT").flags == 167  # attitude, velocity, height, constant position
