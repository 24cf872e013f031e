"""What the vehicle answers and refuses: a reader should learn the protocol from here.

The flight stack is replaced by a point that follows its setpoint (`flight_double`): these tests are about words.
"""

import math
import struct
import zlib
from typing import Any

import numpy as np
import pytest
from flight_double import PointMass
from vehicle_pilot import (
    ACCEPTED,
    DENIED,
    FAILED,
    HOLD,
    LAND,
    NAN,
    OFFBOARD,
    REJECTED,
    RTL,
    TAKEOFF,
    UNSUPPORTED,
    Pilot,
    position,
)

import fakevehicle.vehicle
from fakevehicle.config import LinkConfig, VehicleConfig
from fakevehicle.vehicle import Vehicle
from wire.dialect import mavlink

m = mavlink


@pytest.fixture
def pilot(monkeypatch: pytest.MonkeyPatch) -> Pilot:
    """A pilot on the onboard link of a vehicle that knows where it is and stands disarmed."""
    pilot = fresh(monkeypatch)
    pilot.run(1.0)
    return pilot


def fresh(monkeypatch: pytest.MonkeyPatch, **parameters: float) -> Pilot:
    monkeypatch.setattr(fakevehicle.vehicle, "FlightStack", PointMass)
    return Pilot(Vehicle(VehicleConfig(), parameters))


def point(pilot: Pilot) -> PointMass:
    stack = pilot.vehicle._stack
    assert isinstance(stack, PointMass)
    return stack


def airborne(pilot: Pilot) -> Pilot:
    """Armed, taken off, holding at 2.5 m."""
    assert pilot.command(400, 1) == ACCEPTED
    assert pilot.command(22, NAN, NAN, NAN, NAN, NAN, NAN, NAN) == ACCEPTED
    pilot.until(lambda: pilot.mode == HOLD, 10)
    return pilot


# Telemetry


def test_heartbeat_names_a_px4_quadrotor_once_a_second(pilot: Pilot) -> None:
    pilot.heard.clear()
    pilot.run(10.0)
    beats = pilot.of("HEARTBEAT")
    assert len(beats) == 10
    assert {(b.autopilot, b.type, b.get_srcSystem(), b.get_srcComponent()) for b in beats} == {(12, 2, 1, 1)}
    assert beats[-1].base_mode == 29  # custom, stabilized, guided, auto: what PX4 shows in Hold
    assert beats[-1].system_status == m.MAV_STATE_STANDBY


ONBOARD = {
    "ATTITUDE": 100,
    "ATTITUDE_QUATERNION": 50,
    "LOCAL_POSITION_NED": 50,
    "GLOBAL_POSITION_INT": 50,
    "ODOMETRY": 30,
    "HIGHRES_IMU": 50,
    "SYS_STATUS": 5,
    "EXTENDED_SYS_STATE": 5,
    "BATTERY_STATUS": 0.5,
    "HOME_POSITION": 0.5,
    "VFR_HUD": 10,
    "ALTITUDE": 10,
    "GPS_RAW_INT": 5,
    "SYSTEM_TIME": 1,
    "ESTIMATOR_STATUS": 1,
    "HIL_STATE_QUATERNION": 50,
}
GCS = {
    "ATTITUDE": 15,
    "ATTITUDE_QUATERNION": 10,
    "LOCAL_POSITION_NED": 1,
    "GLOBAL_POSITION_INT": 5,
    "ODOMETRY": 0,
    "HIGHRES_IMU": 0,
    "SYS_STATUS": 1,
    "EXTENDED_SYS_STATE": 1,
    "BATTERY_STATUS": 0.5,
    "HOME_POSITION": 0.5,
    "VFR_HUD": 4,
    "ALTITUDE": 1,
    "GPS_RAW_INT": 5,
    "SYSTEM_TIME": 1,
    "HIL_STATE_QUATERNION": 0,
}


@pytest.mark.parametrize(("link", "rates"), [("onboard", ONBOARD), ("gcs", GCS)])
def test_each_profile_streams_at_its_rates(pilot: Pilot, link: str, rates: dict[str, float]) -> None:
    pilot.heard.clear()
    pilot.run(20.0)
    for kind, rate in rates.items():
        count = sum(1 for _, name, _, message in pilot.heard if name == link and message.get_type() == kind)
        assert abs(count - 20 * rate) <= 1, kind


def test_telemetry_goes_to_every_peer_one_packet_a_datagram_numbered_without_gaps(pilot: Pilot) -> None:
    assert all(peer is None for _, _, peer, _ in pilot.heard)
    for link in ("gcs", "onboard"):
        numbers = [message.get_seq() for _, name, _, message in pilot.heard if name == link]
        assert numbers == [i % 256 for i in range(len(numbers))]


def test_nothing_is_claimed_before_it_is_known(monkeypatch: pytest.MonkeyPatch) -> None:
    pilot = fresh(monkeypatch)
    pilot.run(0.3)
    kinds = {message.get_type() for _, _, _, message in pilot.heard}
    assert not kinds & {"ATTITUDE", "LOCAL_POSITION_NED", "GLOBAL_POSITION_INT", "HOME_POSITION", "GPS_RAW_INT"}
    assert not pilot.last("SYS_STATUS").onboard_control_sensors_health & m.MAV_SYS_STATUS_PREARM_CHECK
    assert pilot.last("HEARTBEAT").system_status == m.MAV_STATE_UNINIT
    pilot.run(1.0)
    assert pilot.last("SYS_STATUS").onboard_control_sensors_health & m.MAV_SYS_STATUS_PREARM_CHECK
    assert pilot.last("ESTIMATOR_STATUS").flags & 0x3F == 0x3F or pilot.run(1.0)
    assert pilot.last("ESTIMATOR_STATUS").flags == 1 | 2 | 4 | 8 | 16 | 32 | 256 | 512


def test_positions_agree_between_frames(pilot: Pilot) -> None:
    airborne(pilot)
    pilot.run(2.0)
    local, globe, home = (pilot.last(k) for k in ("LOCAL_POSITION_NED", "GLOBAL_POSITION_INT", "HOME_POSITION"))
    assert globe.relative_alt == pytest.approx(-local.z * 1000, abs=2)
    assert globe.alt - home.altitude == pytest.approx(2500, abs=20)
    assert home.latitude == 473977420
    assert home.longitude == 85455940
    assert home.altitude == 488000


def test_timesync_and_ping_are_answered_to_the_asker(pilot: Pilot) -> None:
    pilot.send(m.MAVLink_timesync_message(0, 123_456_789), m.MAVLink_ping_message(77, 5, 0, 0))
    now_us = pilot.now_us
    pilot.tick()
    assert (pilot.last("TIMESYNC").tc1, pilot.last("TIMESYNC").ts1) == (now_us * 1000, 123_456_789)
    ping = pilot.last("PING")
    assert (ping.time_usec, ping.seq, ping.target_system, ping.target_component) == (77, 5, 255, 190)
    assert {peer for _, _, peer, g in pilot.heard if g.get_type() in ("PING", "TIMESYNC")} == {pilot.peer}


# Streams on request


def test_set_message_interval_changes_that_link_only(pilot: Pilot) -> None:
    assert pilot.command(511, m.MAVLINK_MSG_ID_ATTITUDE, 500_000) == ACCEPTED
    pilot.heard.clear()
    pilot.run(10.0)
    assert len(pilot.of("ATTITUDE")) == 20
    assert sum(1 for _, link, _, g in pilot.heard if link == "gcs" and g.get_type() == "ATTITUDE") == 150
    assert pilot.command(511, m.MAVLINK_MSG_ID_ATTITUDE, -1) == ACCEPTED
    pilot.heard.clear()
    pilot.run(2.0)
    assert not pilot.of("ATTITUDE")
    assert pilot.command(511, m.MAVLINK_MSG_ID_ATTITUDE, 0) == ACCEPTED
    pilot.heard.clear()
    pilot.run(2.0)
    assert len(pilot.of("ATTITUDE")) == 200


def test_get_message_interval_tells_rate_off_and_unknown(pilot: Pilot) -> None:
    for number, expected in ((m.MAVLINK_MSG_ID_ODOMETRY, 33333), (m.MAVLINK_MSG_ID_AUTOPILOT_VERSION, -1), (9999, 0)):
        assert pilot.command(510, number) == ACCEPTED
        assert pilot.last("MESSAGE_INTERVAL").interval_us == expected


def test_an_unknown_stream_fails_and_says_so(pilot: Pilot) -> None:
    assert pilot.command(511, 22222, 1_000_000) == FAILED
    assert "22222" in pilot.texts()[-1]


def test_a_requested_message_comes_before_its_ack(pilot: Pilot) -> None:
    pilot.send(m.MAVLink_command_long_message(1, 1, 512, 0, 148, 0, 0, 0, 0, 0, 0))
    kinds = [g.get_type() for g in pilot.tick() if g.get_type() in ("AUTOPILOT_VERSION", "COMMAND_ACK")]
    assert kinds == ["AUTOPILOT_VERSION", "COMMAND_ACK"]
    capabilities = pilot.last("AUTOPILOT_VERSION").capabilities
    assert capabilities & m.MAV_PROTOCOL_CAPABILITY_PARAM_ENCODE_BYTEWISE
    assert capabilities & m.MAV_PROTOCOL_CAPABILITY_FTP
    assert capabilities & m.MAV_PROTOCOL_CAPABILITY_MISSION_INT
    assert capabilities & m.MAV_PROTOCOL_CAPABILITY_MISSION_FENCE
    assert not capabilities & m.MAV_PROTOCOL_CAPABILITY_TERRAIN
    assert pilot.command(512, 9999) == DENIED


# Arming, modes, flying


def test_arming_is_denied_with_its_reason_until_the_estimate_is_good(monkeypatch: pytest.MonkeyPatch) -> None:
    pilot = fresh(monkeypatch)
    pilot.run(0.1)
    assert pilot.command(400, 1) == REJECTED
    assert pilot.texts()[-1] == "Arming denied: attitude not known yet"
    assert not pilot.armed
    pilot.run(1.0)
    assert pilot.command(400, 1) == ACCEPTED
    assert pilot.armed
    assert pilot.texts()[-1] == "Armed by external command"


def test_arming_twice_and_disarming_twice_is_accepted(pilot: Pilot) -> None:
    assert [pilot.command(400, 1), pilot.command(400, 1), pilot.command(400, 0), pilot.command(400, 0)] == [0] * 4
    assert not pilot.armed


def test_a_vehicle_nobody_flies_disarms_after_ten_seconds(pilot: Pilot) -> None:
    assert pilot.command(400, 1) == ACCEPTED
    assert pilot.until(lambda: not pilot.armed, 11) == pytest.approx(10.0, abs=0.02)
    assert "preflight" in pilot.texts()[-1]


def test_takeoff_climbs_to_the_parameter_and_holds(pilot: Pilot) -> None:
    assert pilot.command(400, 1) == ACCEPTED
    assert pilot.command(22, NAN, NAN, NAN, NAN, NAN, NAN, NAN) == ACCEPTED
    assert pilot.mode == TAKEOFF
    pilot.until(lambda: pilot.landed_state == m.MAV_LANDED_STATE_TAKEOFF, 3)
    pilot.until(lambda: pilot.mode == HOLD, 10)
    assert pilot.landed_state == m.MAV_LANDED_STATE_IN_AIR
    pilot.run(1.0)
    assert pilot.last("LOCAL_POSITION_NED").z == pytest.approx(-2.5, abs=0.05)


def test_takeoff_altitude_is_above_sea_level(pilot: Pilot) -> None:
    assert pilot.command(400, 1) == ACCEPTED
    assert pilot.command(22, 0, 0, 0, NAN, NAN, NAN, 10.0) == REJECTED  # 478 m under ground
    assert "below the vehicle" in pilot.texts()[-1]
    assert pilot.command(22, 0, 0, 0, NAN, NAN, NAN, 488.0 + 6.0) == ACCEPTED
    pilot.until(lambda: pilot.mode == HOLD, 10)
    assert pilot.last("LOCAL_POSITION_NED").z == pytest.approx(-6.0, abs=0.3)


def test_landing_is_told_step_by_step_and_ends_disarmed_in_hold(pilot: Pilot) -> None:
    airborne(pilot)
    assert pilot.command(21, 0, 0, 0, NAN, NAN, NAN, NAN) == ACCEPTED
    assert pilot.mode == LAND
    assert pilot.landed_state == m.MAV_LANDED_STATE_LANDING
    pilot.until(lambda: pilot.landed_state == m.MAV_LANDED_STATE_ON_GROUND, 10)
    assert pilot.until(lambda: not pilot.armed, 3) == pytest.approx(2.0, abs=0.02)  # COM_DISARM_LAND
    assert pilot.mode == HOLD


def test_disarming_in_the_air_is_refused_unless_forced(pilot: Pilot) -> None:
    airborne(pilot)
    assert pilot.command(400, 0) == REJECTED
    assert pilot.texts()[-1] == "Disarming denied: not landed"
    assert pilot.command(400, 0, 21196) == ACCEPTED
    assert not pilot.armed


def test_a_return_climbs_flies_home_and_lands(pilot: Pilot) -> None:
    airborne(pilot)
    pilot.send(position(30, -20, -2.5))
    assert pilot.command(176, 1, 6) == ACCEPTED
    pilot.fly(12.0, position(30, -20, -2.5))
    assert pilot.command(20) == ACCEPTED
    assert pilot.mode == RTL
    pilot.until(lambda: not pilot.armed, 120)
    np.testing.assert_allclose(point(pilot).p, 0.0, atol=0.1)
    assert min(g.z for g in pilot.of("LOCAL_POSITION_NED")) == pytest.approx(-30.0, abs=0.5)


def test_goto_flies_to_a_place_and_keeps_its_yaw(pilot: Pilot) -> None:
    airborne(pilot)
    north = 20.0
    latitude = 473977420 + round(math.degrees(north / 6_378_137.0) * 1e7)  # good to 0.3 % at this latitude
    goto = m.MAVLink_command_int_message(1, 1, 0, 192, 0, 0, -1, 1, 0, NAN, latitude, 85455940, 492.0)
    pilot.send(goto)
    assert Pilot.ack(pilot.tick(), 192) == ACCEPTED
    pilot.run(15.0)
    here = pilot.last("LOCAL_POSITION_NED")
    assert here.x == pytest.approx(north, abs=0.15)
    assert here.z == pytest.approx(-4.0, abs=0.05)
    assert pilot.mode == HOLD


def test_goto_on_the_ground_and_to_the_other_side_of_the_globe_is_refused(pilot: Pilot) -> None:
    assert pilot.command(192, -1, 1, 0, NAN, 47.3978, 8.5456, 495.0) == REJECTED
    assert "not flying" in pilot.texts()[-1]
    airborne(pilot)
    assert pilot.command(192, -1, 1, 0, NAN, -47.0, -170.0, 495.0) == DENIED
    assert "km away" in pilot.texts()[-1]


@pytest.mark.parametrize(("main", "sub"), [(1, 0), (4, 9), (5, 0)])
def test_a_mode_it_does_not_have_is_denied(pilot: Pilot, main: int, sub: int) -> None:
    before = pilot.mode
    assert pilot.command(176, 1, main, sub) == DENIED
    assert f"{main}/{sub}" in pilot.texts()[-1]
    assert pilot.mode == before


def test_set_mode_needs_the_custom_mode_bit_and_the_old_message_works_too(pilot: Pilot) -> None:
    assert pilot.command(176, 0, 4, 3) == DENIED
    pilot.send(m.MAVLink_set_mode_message(1, 157, 3 << 16))
    assert Pilot.ack(pilot.tick(), 176) == ACCEPTED
    assert pilot.mode == (3, 0)


def test_an_unsupported_command_is_acknowledged_as_such(pilot: Pilot) -> None:
    assert pilot.command(31010) == UNSUPPORTED
    assert "31010" in pilot.texts()[-1]


@pytest.mark.parametrize(
    ("number", "params", "named"),
    [
        (21, (5.0,), "param1"),
        (21, (0, 1.0), "param2"),
        (21, (0, 0, 0, 90.0), "param4"),
        (22, (0, 0, 0, 45.0, NAN, NAN, NAN), "param4"),
        (20, (0, 0, 0, 0, 0, 0, 30.0), "param7"),
        (176, (1, 4, 3, 7), "param4"),
        (400, (1, 2989), "param2"),
        (400, (1, 0, 3), "param3"),
        (510, (30, 1), "param2"),
        *((511, (30, 50_000, *(0,) * (n - 3), 1), f"param{n}") for n in range(3, 8)),
        *((512, (148, *(0,) * (n - 2), 5), f"param{n}") for n in range(2, 8)),
        (512, (148, math.inf), "param2"),
        (192, (400.0, 1, 0, NAN, 47.3977, 8.5456, 492.0), "param1"),
        (192, (-1, 2, 0, NAN, 47.3977, 8.5456, 492.0), "param2"),
        (192, (-1, 1, 30, NAN, 47.3977, 8.5456, 492.0), "param3"),
    ],
)
def test_a_parameter_that_would_change_nothing_is_denied_by_its_number(
    pilot: Pilot, number: int, params: tuple[float, ...], named: str
) -> None:
    airborne(pilot)
    mode, interval = pilot.mode, pilot.vehicle._streams.interval_us("onboard", 30)
    assert pilot.command(number, *params) == DENIED
    assert f" {named} is " in pilot.texts()[-1]
    assert (pilot.mode, pilot.vehicle._streams.interval_us("onboard", 30)) == (mode, interval)
    assert pilot.vehicle.counters.rejected_commands == 1


# What clients were seen to send, or their sources say: MAVSDK leaves NaN, pymavlink's users 0, QGroundControl -1 and 0
@pytest.mark.parametrize("empty", [0.0, NAN])
def test_parameters_left_empty_by_nan_or_zero_are_not_given(pilot: Pilot, empty: float) -> None:
    rest = (empty,) * 7
    assert pilot.command(511, 30, 20_000, *rest[:5]) == ACCEPTED
    assert pilot.command(512, 148, *rest[:6]) == ACCEPTED
    assert pilot.command(510, 30, *rest[:6]) == ACCEPTED
    assert pilot.command(520, 1, *rest[:6]) == ACCEPTED
    assert pilot.command(400, 1, *rest[:6]) == ACCEPTED
    assert pilot.command(22, *rest) == ACCEPTED
    pilot.until(lambda: pilot.mode == HOLD, 10)
    assert pilot.command(192, -1, 1, empty, NAN, 47.397742, 8.545594, 492.0) == ACCEPTED
    assert pilot.command(176, 1, 4, 3, *rest[:4]) == ACCEPTED
    assert pilot.command(20, *rest) == ACCEPTED
    assert pilot.command(21, *rest) == ACCEPTED


def test_takeoff_and_landing_take_the_place_below_the_vehicle_and_no_other(pilot: Pilot) -> None:
    assert pilot.command(400, 1) == ACCEPTED
    assert pilot.command(22, -1, 0, 0, NAN, 47.3990, 8.5456, 494.0) == DENIED  # 140 m north
    assert "140 m away" in pilot.texts()[-1]
    assert pilot.command(22, 0, 0, 0, NAN, math.inf, 8.5456, 494.0) == DENIED
    assert pilot.command(22, -1, 0, 0, NAN, 47.39775, 8.54559, 494.0) == ACCEPTED
    pilot.until(lambda: pilot.mode == HOLD, 10)
    assert pilot.command(21, 0, 0, 0, NAN, 47.3990, 8.5456, 0) == DENIED
    assert pilot.mode == HOLD
    assert pilot.command(21, 0, 0, 0, NAN, 47.39775, 8.54559, 488.0) == ACCEPTED
    assert pilot.mode == LAND


@pytest.mark.parametrize(("target", "links"), [(0, {"onboard"}), (1, {"onboard"}), (2, {"onboard", "gcs"})])
def test_a_requested_message_goes_to_the_asker_or_to_everybody(pilot: Pilot, target: int, links: set[str]) -> None:
    pilot.heard.clear()
    assert pilot.command(512, 148, 0, 0, 0, 0, 0, target) == ACCEPTED
    assert {link for _, link, _, g in pilot.heard if g.get_type() == "AUTOPILOT_VERSION"} == links


# OFFBOARD


def test_offboard_is_accepted_after_one_setpoint(pilot: Pilot) -> None:
    airborne(pilot)
    assert pilot.command(176, 1, 6) == REJECTED
    assert "no setpoints" in pilot.texts()[-1]
    pilot.send(position(0, 0, -2.5))
    assert pilot.command(176, 1, 6) == ACCEPTED
    assert pilot.mode == OFFBOARD


def test_offboard_while_disarmed_is_accepted_but_arming_waits_for_the_stream(pilot: Pilot) -> None:
    assert pilot.command(176, 1, 6) == ACCEPTED
    assert pilot.command(400, 1) == REJECTED
    assert pilot.texts()[-1] == "Arming denied: no offboard setpoints"
    pilot.send(position(0, 0, 0))
    assert pilot.command(400, 1) == ACCEPTED


def test_a_standing_vehicle_idles_until_a_setpoint_asks_to_climb(pilot: Pilot) -> None:
    pilot.send(position(3, 0, 0))
    assert pilot.command(176, 1, 6) == ACCEPTED
    assert pilot.command(400, 1) == ACCEPTED
    pilot.fly(2.0, position(3, 0, 0))
    np.testing.assert_array_equal(point(pilot).p, 0.0)
    pilot.fly(4.0, position(3, 0, -2))
    np.testing.assert_allclose(point(pilot).p, [3, 0, -2], atol=0.05)
    assert pilot.landed_state == m.MAV_LANDED_STATE_IN_AIR


def test_a_lost_stream_holds_and_its_return_resumes(pilot: Pilot) -> None:
    airborne(pilot)
    pilot.send(position(0, 0, -2.5))
    assert pilot.command(176, 1, 6) == ACCEPTED
    pilot.fly(1.0, position(0, 0, -2.5))
    lost_s = pilot.until(lambda: pilot.mode == HOLD, 2)
    assert lost_s == pytest.approx(0.95, abs=0.01)  # COM_OF_LOSS_T after the last setpoint, 0.05 s ago
    assert pilot.last("HEARTBEAT").system_status == m.MAV_STATE_CRITICAL
    mode = pilot.last("CURRENT_MODE")
    assert (mode.custom_mode, mode.intended_custom_mode) == (0x03040000, 0x00060000)
    assert pilot.texts()[-1].startswith("Failsafe activated")
    pilot.run(5.0)
    pilot.send(position(0, 0, -2.5))
    assert pilot.until(lambda: pilot.mode == OFFBOARD, 1) <= 0.024


@pytest.mark.parametrize(("action", "mode"), [(3, RTL), (4, LAND), (5, HOLD)])
def test_a_lost_stream_follows_the_parameter(pilot: Pilot, action: int, mode: tuple[int, int]) -> None:
    pilot.vehicle.parameters.set("COM_OBL_RC_ACT", action)
    airborne(pilot)
    pilot.send(position(0, 0, -2.5))
    assert pilot.command(176, 1, 6) == ACCEPTED
    pilot.until(lambda: pilot.mode == mode, 1.1)


def test_a_mode_asked_for_in_a_failsafe_ends_it(pilot: Pilot) -> None:
    airborne(pilot)
    pilot.send(position(0, 0, -2.5))
    assert pilot.command(176, 1, 6) == ACCEPTED
    pilot.until(lambda: pilot.mode == HOLD, 2)
    assert pilot.command(176, 1, 4, 3) == ACCEPTED
    pilot.fly(1.0, position(5, 0, -2.5))
    assert pilot.mode == HOLD
    assert pilot.last("HEARTBEAT").system_status == m.MAV_STATE_ACTIVE


def set_target(mask: int, frame: int = 1, **fields: float) -> Any:
    values = {k: fields.get(k, 0.0) for k in ("x", "y", "z", "vx", "vy", "vz", "afx", "afy", "afz", "yaw", "yaw_rate")}
    return m.MAVLink_set_position_target_local_ned_message(0, 1, 1, frame, mask, **values)


@pytest.mark.parametrize(
    ("message", "given"),
    [
        (set_target(0x9F8, x=1, y=2, z=-3, yaw=0.5), {"p": [1, 2, -3], "yaw": 0.5}),
        (set_target(0x9C7, vx=1, vy=2, vz=-3, yaw=0.5), {"v": [1, 2, -3], "yaw": 0.5}),
        (set_target(0x9C0, x=1, y=2, z=-3, vx=4, vy=5, vz=6), {"p": [1, 2, -3], "v": [4, 5, 6], "yaw": 0.0}),
        (
            set_target(0x800, x=1, y=2, z=-3, vx=4, vy=5, vz=6, afx=7, afy=8, afz=9),
            {"p": [1, 2, -3], "v": [4, 5, 6], "a": [7, 8, 9], "yaw": 0.0},
        ),
        (set_target(0xC3F, afx=7, afy=8, afz=9), {"a": [7, 8, 9]}),
        (set_target(0xDC3, z=-3, vx=4, vy=5), {"p": [NAN, NAN, -3], "v": [4, 5, 0]}),
        (set_target(0xDF8, x=1, y=NAN, z=-3), {"p": [1, NAN, -3], "v": [NAN, 0, NAN]}),
        (set_target(0x5C7, vx=1, yaw_rate=0.2), {"v": [1, 0, 0], "rate": 0.2}),
    ],
)
def test_type_mask_bits_and_nan_mean_ignore_axis_by_axis(pilot: Pilot, message: Any, given: dict[str, Any]) -> None:
    """An axis nobody asks for gets velocity zero; everything else is followed as it was sent."""
    airborne(pilot)
    pilot.send(message)
    assert pilot.command(176, 1, 6) == ACCEPTED
    followed = point(pilot).setpoint
    nothing = [NAN] * 3
    np.testing.assert_allclose(followed.position_n, given.get("p", nothing))
    np.testing.assert_allclose(followed.velocity_n, given.get("v", nothing))
    np.testing.assert_allclose(followed.acceleration_n, given.get("a", nothing))
    np.testing.assert_allclose([followed.yaw, followed.yaw_rate], [given.get("yaw", NAN), given.get("rate", NAN)])


@pytest.mark.parametrize(
    ("mask", "attitude", "rates"),
    [
        (0b111, [0.6, 0.0, 0.8, 0.0], [NAN, NAN, NAN]),
        (0b000, [0.6, 0.0, 0.8, 0.0], [0.1, 0.2, 0.3]),
        (0x80, [NAN] * 4, [0.1, 0.2, 0.3]),
        (0x80 | 0b011, [NAN] * 4, [0.0, 0.0, 0.3]),
    ],
)
def test_attitude_setpoints_say_what_to_ignore_too(
    pilot: Pilot, mask: int, attitude: list[float], rates: list[float]
) -> None:
    airborne(pilot)
    asked = m.MAVLink_set_attitude_target_message(0, 1, 1, mask, [1.2, 0.0, 1.6, 0.0], 0.1, 0.2, 0.3, 0.55)
    pilot.send(asked)
    assert pilot.command(176, 1, 6) == ACCEPTED
    flown = point(pilot).setpoint
    np.testing.assert_allclose(flown.attitude_q_nb, attitude, atol=1e-6)
    np.testing.assert_allclose(flown.rate_b, rates, atol=1e-6)
    assert flown.thrust == pytest.approx(0.55)
    assert np.isnan(flown.position_n).all()


def test_body_velocity_is_turned_by_the_heading(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(fakevehicle.vehicle, "FlightStack", PointMass)
    pilot = Pilot(Vehicle(VehicleConfig(heading=math.pi / 2)))
    pilot.run(1.0)
    airborne(pilot)
    pilot.send(set_target(0x5C7, frame=8, vx=2.0, vy=1.0, vz=-0.5))
    assert pilot.command(176, 1, 6) == ACCEPTED
    np.testing.assert_allclose(point(pilot).setpoint.velocity_n, [-1.0, 2.0, -0.5], atol=1e-12)


def test_global_setpoints_are_above_sea_level_or_above_home(pilot: Pilot) -> None:
    airborne(pilot)
    for frame, altitude in ((5, 488.0 + 7.0), (6, 7.0)):
        pilot.send(
            m.MAVLink_set_position_target_global_int_message(
                0, 1, 1, frame, 0x9F8, 473977420, 85455940, altitude, 0, 0, 0, 0, 0, 0, 0, 0
            )
        )
        assert pilot.command(176, 1, 6) == ACCEPTED
        np.testing.assert_allclose(point(pilot).setpoint.position_n, [0, 0, -7], atol=0.01)


@pytest.mark.parametrize(
    ("message", "word"),
    [
        (set_target(0x9F8, frame=7), "frame"),
        (set_target(0xFFF), "nothing"),
        (set_target(0x9F8, x=math.inf), "infinite"),
        (set_target(0xE3F, afx=1.0), "forces"),
        (m.MAVLink_set_attitude_target_message(0, 1, 1, 0, [0, 0, 0, 0], 0, 0, 0, 0.5), "attitude"),
        (m.MAVLink_set_attitude_target_message(0, 1, 1, 0, [1, 0, 0, 0], 99.0, 0, 0, 0.5), "rate"),
        (m.MAVLink_set_attitude_target_message(0, 1, 1, 0, [1, 0, 0, 0], 0, 0, 0, 1.5), "thrust"),
        (m.MAVLink_set_attitude_target_message(0, 1, 1, 0x40, [1, 0, 0, 0], 0, 0, 0, 0.5), "thrust"),
        (m.MAVLink_set_attitude_target_message(0, 1, 1, 0x87, [1, 0, 0, 0], 0, 0, 0, 0.5), "nothing"),
    ],
)
def test_setpoints_that_cannot_be_flown_are_refused_once_a_second(pilot: Pilot, message: Any, word: str) -> None:
    airborne(pilot)
    pilot.fly(1.9, message)
    told = [text for text in pilot.texts() if text.startswith("Setpoint refused")]
    assert len(told) == 2
    assert word in told[0]
    assert pilot.command(176, 1, 6) == REJECTED  # they did not count as a stream
    assert pilot.vehicle.counters.rejected_setpoints == 38


# Parameters


def test_every_parameter_is_listed_once_and_then_the_hash(pilot: Pilot) -> None:
    pilot.send(m.MAVLink_param_request_list_message(1, 1))
    heard = [g for g in pilot.run(1.0) if g.get_type() == "PARAM_VALUE"]
    assert [g.param_index for g in heard] == [*range(len(pilot.vehicle.parameters)), 65535]
    assert {g.param_count for g in heard} == {len(pilot.vehicle.parameters)}
    assert [g.param_id for g in heard[:-1]] == sorted(pilot.vehicle.parameters)
    # param_hash_check of PX4: CRC-32 without inversion, over names and values as they travel
    crc = 0
    for g in heard[:-1]:
        for part in (g.param_id.encode(), struct.pack("<f", g.param_value)):
            crc = zlib.crc32(part, crc ^ 0xFFFFFFFF) ^ 0xFFFFFFFF
    assert heard[-1].param_id == "_HASH_CHECK"
    assert heard[-1].param_value == struct.unpack("<f", struct.pack("<I", crc))[0]


def test_integers_travel_as_their_bytes(pilot: Pilot) -> None:
    pilot.send(m.MAVLink_param_request_read_message(1, 1, b"COM_OBL_RC_ACT", -1))
    pilot.tick()
    value = pilot.last("PARAM_VALUE")
    assert (value.param_type, struct.pack("<f", value.param_value)) == (6, struct.pack("<i", 5))
    four = struct.unpack("<f", struct.pack("<i", 4))[0]
    pilot.send(m.MAVLink_param_set_message(1, 1, b"COM_OBL_RC_ACT", four, 6))
    pilot.tick()
    assert struct.pack("<f", pilot.last("PARAM_VALUE").param_value) == struct.pack("<i", 4)
    assert pilot.vehicle.parameters["COM_OBL_RC_ACT"] == 4


def test_a_parameter_is_read_by_index_too(pilot: Pilot) -> None:
    pilot.send(m.MAVLink_param_request_read_message(1, 1, b"", 3))
    pilot.tick()
    assert pilot.last("PARAM_VALUE").param_id == pilot.vehicle.parameters.name_at(3)


@pytest.mark.parametrize(
    ("request_", "error", "word"),
    [
        (m.MAVLink_param_request_read_message(1, 1, b"NO_SUCH_PARAM", -1), 1, "no such"),
        (m.MAVLink_param_request_read_message(1, 1, b"", 30000), 1, "no such"),
        (m.MAVLink_param_set_message(1, 1, b"NO_SUCH_PARAM", 1.0, 9), 1, "no such"),
        (m.MAVLink_param_set_message(1, 1, b"MPC_TKO_SPEED", 99.0, 9), 2, "outside"),
        (m.MAVLink_param_set_message(1, 1, b"MPC_TKO_SPEED", NAN, 9), 2, "finite"),
        (m.MAVLink_param_set_message(1, 1, b"MPC_TKO_SPEED", 1.0, 6), 2, "type"),
        (m.MAVLink_param_set_message(1, 1, b"MAV_SYS_ID", 2.8e-45, 6), 5, "fixed"),
    ],
)
def test_a_refused_parameter_says_why(pilot: Pilot, request_: Any, error: int, word: str) -> None:
    pilot.send(request_)
    pilot.tick()
    assert pilot.last("PARAM_ERROR").error == error
    assert word in pilot.texts()[-1]
    assert pilot.vehicle.parameters["MPC_TKO_SPEED"] == 1.5


# Services it does not have


@pytest.mark.parametrize(
    ("request_", "words"),
    [
        (m.MAVLink_mission_request_message(1, 1, 3, 0), "Plan refused"),
        (m.MAVLink_mission_request_int_message(1, 1, 3, 0), "Plan refused"),
        (m.MAVLink_mission_set_current_message(1, 1, 3), "Plan refused"),
        (m.MAVLink_mission_item_message(1, 1, 0, 3, 16, 0, 1, 0, 0, 0, 0, 0, 0, 0), "Plan refused"),
        (m.MAVLink_mission_item_int_message(1, 1, 0, 3, 16, 0, 1, 0, 0, 0, 0, 0, 0, 0), "Plan refused"),
        *(
            (m.MAVLink_file_transfer_protocol_message(0, 1, 1, bytes([9, 0, 0, opcode]).ljust(251, b"\0")), "File ")
            for opcode in (4, 5, 6, 14, 15)  # open for reading, read, create, checksum, burst read
        ),
    ],
)
def test_what_is_refused_again_and_again_is_said_in_words_but_not_at_every_attempt(
    pilot: Pilot, request_: Any, words: str
) -> None:
    for _ in range(8):
        pilot.send(request_)
        pilot.run(1.0)
    assert [text.startswith(words) for text in pilot.texts()] == [True]
    pilot.run(3.0)
    pilot.send(request_)
    pilot.tick()
    assert [text.startswith(words) for text in pilot.texts()] == [True, True]


def test_odometry_has_position_and_velocity_in_the_frames_it_names_as_px4_has(pilot: Pilot) -> None:
    point(pilot).q = np.array([math.cos(0.6), 0.0, 0.0, math.sin(0.6)])
    airborne(pilot)
    pilot.send(set_target(0x5C7, vx=3.0, vy=-1.0, vz=0.0))
    assert pilot.command(176, 1, 6) == ACCEPTED
    pilot.fly(2.0, set_target(0x5C7, vx=3.0, vy=-1.0, vz=0.0))
    odometry, local = pilot.last("ODOMETRY"), pilot.last("LOCAL_POSITION_NED")
    assert (odometry.frame_id, odometry.child_frame_id) == (m.MAV_FRAME_LOCAL_NED, m.MAV_FRAME_LOCAL_NED)
    assert (odometry.quality, odometry.estimator_type) == (0, m.MAV_ESTIMATOR_TYPE_AUTOPILOT)
    np.testing.assert_allclose((odometry.vx, odometry.vy, odometry.vz), (3.0, -1.0, 0.0), atol=0.02)
    np.testing.assert_allclose((odometry.vx, odometry.vy), (local.vx, local.vy), atol=0.02)
    variances = [odometry.velocity_covariance[i] for i in (0, 6, 11)]  # the diagonal of an upper triangle
    np.testing.assert_allclose(variances, 0.01, rtol=1e-6)


def test_logs_and_shell_are_answered_with_none_and_files_are_listed(pilot: Pilot) -> None:
    pilot.send(m.MAVLink_log_request_list_message(1, 1, 0, 0xFFFF))
    pilot.send(m.MAVLink_serial_control_message(10, 6, 0, 0, 0, [0] * 70))
    listing = struct.pack("<HBBBBBBI", 41, 0, 3, 1, 0, 0, 0, 0) + b"/"
    pilot.send(m.MAVLink_file_transfer_protocol_message(0, 1, 1, listing.ljust(251, b"\0")))
    pilot.tick()
    assert pilot.last("LOG_ENTRY").num_logs == 0
    assert pilot.last("SERIAL_CONTROL").count == 0
    reply = bytes(pilot.last("FILE_TRANSFER_PROTOCOL").payload)
    sequence, _, opcode, size, asked, _, _, _ = struct.unpack_from("<HBBBBBBI", reply)
    assert (sequence, opcode, asked) == (42, 128, 3)
    assert reply[12 : 12 + size] == b"D@PARAM\0Detc\0Dfs\0Dlog\0"


# Who is obeyed


def test_commands_for_others_are_ignored(pilot: Pilot) -> None:
    for system, component in ((2, 1), (1, 190), (2, 0)):
        pilot.send(m.MAVLink_command_long_message(system, component, 400, 0, 1, 0, 0, 0, 0, 0, 0))
    heard = pilot.tick()
    assert not [g for g in heard if g.get_type() == "COMMAND_ACK"]
    assert not pilot.armed
    assert pilot.vehicle.counters.foreign == 3


@pytest.mark.parametrize(("system", "component"), [(1, 1), (1, 0), (0, 0), (0, 1)])
def test_commands_for_all_are_obeyed(pilot: Pilot, system: int, component: int) -> None:
    pilot.send(m.MAVLink_command_long_message(system, component, 400, 0, 1, 0, 0, 0, 0, 0, 0))
    assert Pilot.ack(pilot.tick(), 400) == ACCEPTED


def test_mavlink1_is_understood_and_answered_in_mavlink2(pilot: Pilot) -> None:
    pilot.send(m.MAVLink_command_long_message(1, 1, 400, 0, 1, 0, 0, 0, 0, 0, 0), mavlink1=True)
    assert Pilot.ack(pilot.tick(), 400) == ACCEPTED
    assert all(g._msgbuf[0] == 0xFD for _, _, _, g in pilot.heard)


def test_each_peer_gets_its_own_answer(pilot: Pilot) -> None:
    other = Pilot(pilot.vehicle, "gcs", ("::1", 14550))
    pilot.send(m.MAVLink_command_long_message(1, 1, 400, 0, 1, 0, 0, 0, 0, 0, 0))
    pilot._waiting += [d for d in _queued(other, m.MAVLink_param_request_read_message(1, 1, b"MIS_TAKEOFF_ALT", -1))]
    pilot.tick()
    answers = [(link, peer, g.get_type()) for _, link, peer, g in pilot.heard if peer is not None]
    assert answers == [
        ("onboard", pilot.peer, "COMMAND_ACK"),
        ("gcs", ("::1", 14550), "PARAM_VALUE"),
    ]


def _queued(pilot: Pilot, message: Any) -> list[Any]:
    pilot.send(message)
    return pilot._waiting


def test_a_flood_is_dropped_and_counted_not_stored(pilot: Pilot) -> None:
    ping = pilot.bytes_of(m.MAVLink_ping_message(1, 1, 0, 0))
    pilot.send_raw(ping * 4000)
    heard = pilot.tick()
    assert len(heard) <= 512
    counters = pilot.vehicle.counters
    assert counters.flooded == 4000 - 2048
    assert counters.dropped > 0


def test_a_link_it_does_not_have_is_ignored(pilot: Pilot) -> None:
    stranger = Pilot(pilot.vehicle, "nowhere")
    pilot._waiting += _queued(stranger, m.MAVLink_ping_message(1, 1, 0, 0))
    pilot.tick()
    assert pilot.vehicle.counters.ignored == 1


# Our own misuse


@pytest.mark.parametrize(
    "make",
    [
        lambda: VehicleConfig(system_id=0),
        lambda: VehicleConfig(links=()),
        lambda: VehicleConfig(links=(LinkConfig("a"), LinkConfig("a"))),
        lambda: VehicleConfig(wind_n=np.array([1.0, 2.0])),
        lambda: VehicleConfig(seed=-1),
        lambda: LinkConfig("a", "fast"),  # type: ignore[arg-type]
    ],
)
def test_a_configuration_that_cannot_be_is_refused_where_it_is_built(make: Any) -> None:
    with pytest.raises(ValueError, match="expected"):
        make()


def test_ticks_cannot_be_skipped_or_repeated(pilot: Pilot) -> None:
    with pytest.raises(ValueError, match="one tick after"):
        pilot.vehicle.step(pilot.now_us + 4000, [])
