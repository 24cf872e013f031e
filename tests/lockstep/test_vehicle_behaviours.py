"""What others demand of an autopilot in the air, with their thresholds: whole flights of the real vehicle in memory.

The vehicle flies on its own estimate. Distances are truth's where a vehicle might fool itself (home, drift), and the
estimate's where a place was asked for in its frame.
"""

import math
from typing import Any

import numpy as np
import pytest
from vehicle_pilot import ACCEPTED, HOLD, LAND, NAN, OFFBOARD, RTL, Pilot, position

from fakevehicle.config import LinkConfig, VehicleConfig
from fakevehicle.faults import Fault, FaultKind, Sensor
from fakevehicle.vehicle import TICK_US, Vehicle
from fakevehicle.vocabulary import FloatArray
from wire.dialect import mavlink

m = mavlink
MISSION = (4, 4)
LATITUDE, LONGITUDE = 47.397742, 8.545594
NORTH, EAST = 1.0 / 111_180.0, 1.0 / 75_500.0
"""A metre in degrees at home."""


def ready(seed: int, **parameters: float) -> Pilot:
    """A client of a vehicle that can be armed."""
    pilot = Pilot(Vehicle(VehicleConfig(links=(LinkConfig("onboard", "gcs"),), seed=seed), parameters))
    pilot.until(lambda: pilot.vehicle.flying.why_not_armable(pilot.now_us) is None, 20)
    return pilot


def hovering(seed: int, **parameters: float) -> Pilot:
    """Taken off and holding at MIS_TAKEOFF_ALT."""
    pilot = ready(seed, **parameters)
    assert pilot.command(400, 1) == ACCEPTED
    assert pilot.command(22, NAN, NAN, NAN, NAN, NAN, NAN, NAN) == ACCEPTED
    pilot.until(lambda: pilot.mode == HOLD, 15)
    return pilot


def e7(north: float, east: float) -> tuple[int, int]:
    return round((LATITUDE + north * NORTH) * 1e7), round((LONGITUDE + east * EAST) * 1e7)


def upload(pilot: Pilot, kind: int, *items: tuple[int, int, tuple[float, ...], tuple[int, int], float]) -> None:
    """Each item is (command, frame, the first four parameters, place, altitude)."""
    pilot.send(m.MAVLink_mission_count_message(1, 1, len(items), kind))
    for seq, (command, frame, params, place, up) in enumerate(items):
        pilot.tick()
        assert pilot.last("MISSION_REQUEST_INT").seq == seq
        pilot.send(m.MAVLink_mission_item_int_message(1, 1, seq, frame, command, 0, 1, *params, *place, up, kind))
    pilot.tick()
    assert pilot.last("MISSION_ACK").type == m.MAV_MISSION_ACCEPTED


def there_and_back(pilot: Pilot, away: float = 30.0) -> None:
    """Load and start a mission that takes some half a minute and lands at home."""
    go = (0.0, 0.0, 0.0, NAN)
    upload(
        pilot,
        0,
        (m.MAV_CMD_NAV_TAKEOFF, 6, go, (0, 0), 5.0),
        (m.MAV_CMD_NAV_WAYPOINT, 6, go, e7(away, 0.0), 5.0),
        (m.MAV_CMD_NAV_WAYPOINT, 6, go, e7(0.0, 0.0), 5.0),
        (m.MAV_CMD_NAV_LAND, 6, go, e7(0.0, 0.0), 0.0),
    )
    assert pilot.command(300, 0, 0) == ACCEPTED


def goto(pilot: Pilot, north: float, east: float, up: float) -> None:
    pilot.send(m.MAVLink_command_int_message(1, 1, 6, 192, 0, 0, -1, 1, 0, NAN, *e7(north, east), up))
    assert Pilot.ack(pilot.tick(), 192) == ACCEPTED


def truth_n(pilot: Pilot) -> FloatArray:
    """Where it is, from where it began."""
    return pilot.vehicle.truth.position_n


def here(pilot: Pilot) -> tuple[float, float, float]:
    """Where it believes to be."""
    seen = pilot.vehicle._stack.glance
    return seen.x, seen.y, seen.z


def from_home(pilot: Pilot) -> float:
    return math.hypot(*truth_n(pilot)[:2].tolist())


def fail(pilot: Pilot, sensor: Sensor, kind: FaultKind, seconds: float, *magnitude: float, index: int = 0) -> None:
    """From now on, for so long."""
    end_us = None if math.isinf(seconds) else pilot.now_us + round(seconds * 1e6)
    pilot.vehicle._stack.inject(Fault(sensor, kind, pilot.now_us, end_us, magnitude, index))


def test_offboard_corners_are_reached_within_a_third_of_a_metre_in_ten_seconds_each() -> None:
    pilot = ready(21)
    pilot.send(position(0, 0, -2))
    assert (pilot.command(176, 1, 6), pilot.command(400, 1)) == (ACCEPTED, ACCEPTED)
    for corner in ((0.0, 0.0, -2.0), (0.0, 5.0, -2.0), (5.0, 5.0, -4.0), (5.0, 0.0, -4.0)):
        for _ in range(200):
            pilot.send(position(*corner))
            pilot.run(0.05)
            if math.dist(here(pilot), corner) < 0.3:
                break
        assert math.dist(here(pilot), corner) < 0.3
    assert pilot.mode == OFFBOARD


def test_takeoff_and_landing_stay_within_two_metres_of_home_and_disarm() -> None:
    pilot = hovering(22)
    assert from_home(pilot) < 2.0
    assert pilot.command(21, 0, 0, 0, NAN, NAN, NAN, NAN) == ACCEPTED
    pilot.until(lambda: not pilot.armed, 120)
    assert from_home(pilot) < 2.0


def test_a_mission_that_loses_gps_lands_and_disarms_in_half_a_minute() -> None:
    """GIVEN a mission under way WHEN GPS goes for good THEN it lands where it is, without a position."""
    pilot = ready(23)
    there_and_back(pilot)
    pilot.until(lambda: truth_n(pilot)[0] > 8.0, 30)
    lost_n = truth_n(pilot)
    assert pilot.command(420, m.FAILURE_UNIT_SENSOR_GPS, m.FAILURE_TYPE_OFF, 0) == ACCEPTED
    pilot.until(lambda: not pilot.armed, 30)
    assert np.linalg.norm((truth_n(pilot) - lost_n)[:2]) < 25.0  # of which it flies 15 m before it knows
    assert any("position lost" in text for text in pilot.texts())
    assert abs(truth_n(pilot)[2]) < 0.1


@pytest.mark.parametrize("unit", [m.FAILURE_UNIT_SENSOR_MAG, m.FAILURE_UNIT_SENSOR_BARO])
def test_a_mission_goes_on_without_magnetometer_or_barometer(unit: int) -> None:
    pilot = ready(24)
    there_and_back(pilot)
    pilot.until(lambda: truth_n(pilot)[0] > 5.0, 30)
    assert pilot.command(420, unit, m.FAILURE_TYPE_OFF, 0) == ACCEPTED
    farthest = 0.0
    for _ in range(120):
        pilot.run(0.5)
        farthest = max(farthest, float(truth_n(pilot)[0]))
        if not pilot.armed:
            break
    assert not pilot.armed
    assert farthest == pytest.approx(30.0, abs=2.0)
    assert from_home(pilot) < 2.0
    assert pilot.last("MISSION_CURRENT").mission_state == 5
    assert not any("Failsafe" in text for text in pilot.texts())


@pytest.mark.parametrize("wind", [0.0, 8.0])
def test_a_mission_flows_through_its_waypoints_within_their_radius_and_stops_where_it_should(wind: float) -> None:
    pilot = ready(33, SIM_WIND_GUST=wind)
    go = (0.0, 0.0, 0.0, NAN)
    corners = ((20.0, 0.0), (20.0, 20.0), (0.0, 20.0))
    upload(
        pilot,
        0,
        (m.MAV_CMD_NAV_TAKEOFF, 6, go, (0, 0), 5.0),
        *((m.MAV_CMD_NAV_WAYPOINT, 6, go, e7(*corner), 5.0) for corner in corners),
        (m.MAV_CMD_NAV_WAYPOINT, 6, (1.0, 0.0, 0.0, NAN), e7(0.0, 0.0), 5.0),
        (m.MAV_CMD_NAV_WAYPOINT, 6, go, e7(0.0, -5.0), 5.0),
    )
    assert pilot.command(300, 0, 0) == ACCEPTED
    way = []
    while pilot.mode != HOLD or not way:
        pilot.tick()
        asked = pilot.vehicle.flying.navigator.course.setpoint(pilot.now_us - TICK_US)
        way.append([*truth_n(pilot), *asked.velocity_n])
        assert pilot.now_us < 90e6
    flown = np.array(way)
    flown = flown[np.argmax(flown[:, 2] < -4.9) :]  # from the top of its takeoff on
    # THEN at each corner it is within a metre (and GPS's error of a few decimetres), and hardly slower than 2 m/s
    for corner in corners:
        away = np.linalg.norm(flown[:, :2] - corner, axis=1)
        assert away.min() < 1.0 + 0.4
        assert np.linalg.norm(flown[away < 3.0, 3:6], axis=1).min() > 1.5
    # AND where it is to wait it stops
    assert np.linalg.norm(flown[np.linalg.norm(flown[:, :2], axis=1) < 1.0, 3:6], axis=1).min() < 1e-6
    # AND the velocity asked for never jumps: MPC_ACC_HOR is 3 m/s^2
    assert np.linalg.norm(np.diff(flown[:, 3:6], axis=0), axis=1).max() <= 3.0 * TICK_US * 1e-6 + 1e-9
    assert np.linalg.norm(flown[:, 3:5], axis=1).max() <= 5.0 + 1e-9
    assert list(dict.fromkeys(reached.seq for reached in pilot.of("MISSION_ITEM_REACHED"))) == [0, 1, 2, 3, 4, 5]


@pytest.mark.parametrize(("seconds", "holds"), [(1.0, True), (10.0, False)])
def test_a_glitch_of_gps_moves_a_holding_vehicle_by_twenty_metres_at_most(seconds: float, holds: bool) -> None:
    """GIVEN a hold WHEN GPS jumps by 100 m THEN a short jump is flown through, and a long one ends in a landing."""
    pilot = hovering(25)
    begin_n = truth_n(pilot)
    fail(pilot, Sensor.GPS, FaultKind.BIAS, seconds, 60.0, -80.0, 0.0, 0.0, 0.0, 0.0)
    away = 0.0
    for _ in range(60):
        pilot.run(0.5)
        away = max(away, float(np.linalg.norm(truth_n(pilot) - begin_n)))
    assert away < 20.0
    assert pilot.armed is holds


@pytest.mark.parametrize("motor", [0, *(pytest.param(i, marks=pytest.mark.slow) for i in (1, 2, 3))])
def test_a_motor_at_two_thirds_is_flown_for_half_a_minute(motor: int) -> None:
    """GIVEN a hover WHEN one motor gives 65 % THEN height stays within 5 m and place within 10 m."""
    pilot = hovering(26, MIS_TAKEOFF_ALT=10.0)
    begin_n = truth_n(pilot)
    fail(pilot, Sensor.MOTOR, FaultKind.BIAS, math.inf, 0.65, index=motor)
    for _ in range(60):
        pilot.run(0.5)
        moved_n = truth_n(pilot) - begin_n
        assert abs(moved_n[2]) < 5.0
        assert math.hypot(moved_n[0], moved_n[1]) < 10.0
    assert pilot.armed


def test_a_fence_that_is_crossed_sends_it_home() -> None:
    """GIVEN a fence of 20 m WHEN it is flown over THEN the return begins within 30 s, and ends within 10 m of home."""
    pilot = hovering(27, GF_ACTION=3)
    inclusion, once = m.MAV_CMD_NAV_FENCE_POLYGON_VERTEX_INCLUSION, (4.0, 0.0, 0.0, 0.0)
    corners = ((-20.0, -20.0), (20.0, -20.0), (20.0, 20.0), (-20.0, 20.0))
    upload(pilot, 1, *((inclusion, 5, once, e7(*corner), 0.0) for corner in corners))
    velocity = m.MAVLink_set_position_target_local_ned_message(0, 1, 1, 1, 0x9C7, 0, 0, 0, 4, 0, 0, 0, 0, 0, 0, 0)
    pilot.send(velocity)
    assert pilot.command(176, 1, 6) == ACCEPTED
    for _ in range(60):
        pilot.fly(0.5, velocity)
        if pilot.mode == RTL:
            break
    assert pilot.mode == RTL
    assert truth_n(pilot)[0] < 30.0
    pilot.until(lambda: not pilot.armed, 90)
    assert from_home(pilot) < 10.0


def test_goto_arrives_fifty_metres_away_in_a_minute() -> None:
    pilot = hovering(28)
    goto(pilot, 40.0, 30.0, 6.0)
    pilot.until(lambda: math.dist(truth_n(pilot)[:2], (40.0, 30.0)) < 2.0, 60)
    pilot.run(5.0)
    assert math.dist(truth_n(pilot)[:2], (40.0, 30.0)) < 2.0


def test_a_return_ends_disarmed_within_ten_metres_of_home() -> None:
    pilot = hovering(29)
    goto(pilot, 30.0, -20.0, 6.0)
    pilot.run(14.0)
    assert pilot.command(20) == ACCEPTED
    pilot.until(lambda: not pilot.armed, 120)
    assert from_home(pilot) < 10.0


def test_setpoints_that_stop_are_a_failsafe_without_any_remote_control() -> None:
    """GIVEN COM_OBL_RC_ACT 4 WHEN the companion dies THEN the vehicle lands and disarms by itself."""
    pilot = ready(30, COM_OBL_RC_ACT=4)
    pilot.send(position(0, 0, -3))
    assert (pilot.command(176, 1, 6), pilot.command(400, 1)) == (ACCEPTED, ACCEPTED)
    pilot.fly(5.0, position(0, 0, -3))
    pilot.until(lambda: pilot.mode == LAND, 1.2)
    pilot.until(lambda: not pilot.armed, 30)
    assert from_home(pilot) < 2.0


def test_stale_setpoints_sent_again_do_not_fly_away() -> None:
    """GIVEN a hold WHEN a peer repeats an old setpoint without asking for OFFBOARD THEN nothing moves."""
    pilot = hovering(31)
    begin_n = truth_n(pilot)
    pilot.fly(5.0, position(50, 50, -20))
    assert pilot.mode == HOLD
    np.testing.assert_allclose(truth_n(pilot), begin_n, atol=1.0)


def test_health_is_ok_within_twenty_seconds_of_the_start() -> None:
    def healthy(pilot: Pilot) -> Any:
        status = pilot.last("SYS_STATUS")
        return status.onboard_control_sensors_health & m.MAV_SYS_STATUS_PREARM_CHECK

    pilot = Pilot(Vehicle(VehicleConfig(links=(LinkConfig("onboard", "gcs"),), seed=32)))
    pilot.tick(1)
    pilot.until(lambda: healthy(pilot), 20)


@pytest.mark.parametrize("airframe", ["crazyflie", "iris"])
def test_every_shipped_airframe_takes_off_goes_somewhere_and_knows_that_it_has_landed(airframe: str) -> None:
    pilot = Pilot(Vehicle(VehicleConfig(airframe=airframe, links=(LinkConfig("onboard", "gcs"),), seed=33)))
    pilot.until(lambda: pilot.vehicle.flying.why_not_armable(pilot.now_us) is None, 20)
    assert pilot.command(400, 1) == ACCEPTED
    assert pilot.command(22, NAN, NAN, NAN, NAN, NAN, NAN, NAN) == ACCEPTED
    pilot.until(lambda: pilot.mode == HOLD, 15)
    goto(pilot, 3.0, 2.0, 3.0)
    pilot.run(6.0)
    assert math.dist(truth_n(pilot)[:2], (3.0, 2.0)) < 1.5
    assert pilot.command(21) == ACCEPTED
    pilot.until(lambda: pilot.vehicle.truth.on_ground, 20)
    pilot.until(lambda: not pilot.armed, 5)


# Attitude offboard


def tilted(
    roll: float, pitch: float, yaw: float, thrust: float, *, rates: tuple[float, float, float] | None = None
) -> Any:
    """SET_ATTITUDE_TARGET from angles [rad], or from body rates alone [rad/s]."""
    cr, sr = math.cos(roll / 2), math.sin(roll / 2)
    cp, sp = math.cos(pitch / 2), math.sin(pitch / 2)
    cy, sy = math.cos(yaw / 2), math.sin(yaw / 2)
    q = [
        cr * cp * cy + sr * sp * sy,
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
    ]
    mask = 0b111 if rates is None else 0b1000_0000
    return m.MAVLink_set_attitude_target_message(0, 1, 1, mask, q, *(rates or (0.0, 0.0, 0.0)), thrust)


def angles(pilot: Pilot) -> FloatArray:
    """Truth's roll, pitch and yaw [rad]."""
    w, x, y, z = pilot.vehicle.truth.q_nb.tolist()
    roll = math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
    return np.array([roll, math.asin(2 * (w * y - z * x)), math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))])


def test_an_attitude_is_flown_as_it_is_asked_for_and_position_takes_over_again() -> None:
    pilot = hovering(34, MIS_TAKEOFF_ALT=20.0)
    pilot.send(tilted(0.1, -0.15, 0.5, 0.6))
    assert pilot.command(176, 1, 6) == ACCEPTED
    pilot.fly(2.0, tilted(0.1, -0.15, 0.5, 0.6))
    np.testing.assert_allclose(angles(pilot), [0.1, -0.15, 0.5], atol=0.03)
    target = pilot.last("ATTITUDE_TARGET")
    assert target.thrust == pytest.approx(0.6, abs=0.01)
    assert pilot.vehicle.truth.velocity_n[0] > 1.0  # nose down, so forward
    pilot.fly(8.0, position(0, 0, -20))
    assert math.dist(here(pilot), (0.0, 0.0, -20.0)) < 1.0
    assert pilot.mode == OFFBOARD


def test_body_rates_are_flown_as_they_are_asked_for() -> None:
    pilot = hovering(35, MIS_TAKEOFF_ALT=20.0)
    turning = tilted(0, 0, 0, 0.6, rates=(0.0, 0.0, 0.5))
    pilot.send(turning)
    assert pilot.command(176, 1, 6) == ACCEPTED
    pilot.fly(1.0, turning)
    begin = angles(pilot)[2]
    pilot.fly(2.0, turning)
    assert math.remainder(angles(pilot)[2] - begin, 2 * math.pi) == pytest.approx(1.0, abs=0.06)


def test_a_stream_of_attitudes_that_stops_is_held() -> None:
    pilot = hovering(36, MIS_TAKEOFF_ALT=10.0)
    pilot.send(tilted(0, 0, 0, 0.6))
    assert pilot.command(176, 1, 6) == ACCEPTED
    pilot.fly(1.0, tilted(0, -0.1, 0, 0.6))
    pilot.until(lambda: pilot.mode == HOLD, 1.2)
    pilot.run(4.0)
    assert np.linalg.norm(pilot.vehicle.truth.velocity_n) < 0.3


def test_an_attitude_takes_off_and_lands_by_thrust_alone() -> None:
    pilot = ready(37)
    pilot.send(tilted(0, 0, 0, 0.1))
    assert (pilot.command(176, 1, 6), pilot.command(400, 1)) == (ACCEPTED, ACCEPTED)
    pilot.fly(1.5, tilted(0, 0, 0, 0.66))
    assert pilot.vehicle.flying.airborne
    for _ in range(40):
        pilot.fly(0.5, tilted(0, 0, 0, 0.57 if truth_n(pilot)[2] < -1.0 and pilot.vehicle.flying.airborne else 0.45))
        if not pilot.armed:
            break
    assert not pilot.armed
    assert pilot.vehicle.truth.on_ground
