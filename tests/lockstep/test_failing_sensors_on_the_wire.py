"""What a client hears of failing sensors, resets and obstacles: the real vehicle in memory."""

import numpy as np
import pytest
from vehicle_pilot import ACCEPTED, HOLD, NAN, UNSUPPORTED, Pilot

from fakevehicle.config import LinkConfig, VehicleConfig
from fakevehicle.faults import parse_fault
from fakevehicle.sensors.obstacles import World
from fakevehicle.vehicle import Vehicle
from wire.dialect import mavlink

m = mavlink
HORIZONTAL = m.ESTIMATOR_VELOCITY_HORIZ | m.ESTIMATOR_POS_HORIZ_REL | m.ESTIMATOR_POS_HORIZ_ABS
VERTICAL = m.ESTIMATOR_VELOCITY_VERT | m.ESTIMATOR_POS_VERT_ABS | m.ESTIMATOR_POS_VERT_AGL


def hovering(*faults: str, world: World | None = None) -> Pilot:
    config = VehicleConfig(
        links=(LinkConfig("onboard"),), seed=41, faults=tuple(parse_fault(f) for f in faults), world=world
    )
    pilot = Pilot(Vehicle(config, {"COM_POS_FS_DELAY": 30.0}))
    pilot.until(lambda: pilot.vehicle.flying.why_not_armable(pilot.now_us) is None, 20)
    assert pilot.command(400, 1) == ACCEPTED
    assert pilot.command(22, NAN, NAN, NAN, NAN, NAN, NAN, NAN) == ACCEPTED
    pilot.until(lambda: pilot.mode == HOLD, 15)
    assert pilot.command(511, m.MAVLINK_MSG_ID_ESTIMATOR_STATUS, 20_000) == ACCEPTED
    pilot.run(0.5)
    return pilot


def flags(pilot: Pilot) -> int:
    return int(pilot.last("ESTIMATOR_STATUS").flags)


def healthy(pilot: Pilot) -> int:
    return int(pilot.last("SYS_STATUS").onboard_control_sensors_health)


def test_gps_off_for_twenty_seconds_is_told_within_one_and_its_return_is_a_reset() -> None:
    pilot = hovering()
    assert flags(pilot) & (HORIZONTAL | VERTICAL) == HORIZONTAL | VERTICAL
    assert pilot.last("ODOMETRY").reset_counter == 0
    assert pilot.command(420, m.FAILURE_UNIT_SENSOR_GPS, m.FAILURE_TYPE_OFF, 0) == ACCEPTED
    assert pilot.until(lambda: not flags(pilot) & HORIZONTAL, 1.0) <= 1.0
    assert flags(pilot) & VERTICAL == VERTICAL
    pilot.run(0.5)
    assert not healthy(pilot) & m.MAV_SYS_STATUS_SENSOR_GPS
    assert pilot.last("GPS_RAW_INT").fix_type == 0
    pilot.run(19.0)
    assert pilot.command(420, m.FAILURE_UNIT_SENSOR_GPS, m.FAILURE_TYPE_OK, 0) == ACCEPTED
    pilot.until(lambda: flags(pilot) & HORIZONTAL == HORIZONTAL, 2.0)
    pilot.run(0.5)
    assert pilot.last("ODOMETRY").reset_counter == 1
    assert healthy(pilot) & m.MAV_SYS_STATUS_SENSOR_GPS


@pytest.mark.parametrize(
    ("unit", "bit"),
    [
        (m.FAILURE_UNIT_SENSOR_BARO, m.MAV_SYS_STATUS_SENSOR_ABSOLUTE_PRESSURE),
        (m.FAILURE_UNIT_SENSOR_MAG, m.MAV_SYS_STATUS_SENSOR_3D_MAG),
    ],
)
def test_a_silent_sensor_loses_its_health_and_the_vehicle_keeps_its_place(unit: int, bit: int) -> None:
    pilot = hovering()
    assert healthy(pilot) & bit
    assert pilot.command(420, unit, m.FAILURE_TYPE_OFF, 0) == ACCEPTED
    pilot.run(5.0)
    assert not healthy(pilot) & bit
    assert flags(pilot) & (HORIZONTAL | VERTICAL) == HORIZONTAL | VERTICAL
    assert pilot.mode == HOLD


def test_every_unit_can_be_made_to_fail_in_every_way_it_has_and_other_ways_are_refused_with_the_reason() -> None:
    units = [0, 1, 2, 3, 4, 7, 100, 101, 103]  # FAILURE_UNIT: IMU, field, pressure, GPS, range, battery, motor, lidar
    kinds = [1, 2, 3, 4, 6]  # off, stuck, garbage, wrong, delayed
    pilot = Pilot(Vehicle(VehicleConfig(links=(LinkConfig("onboard"),), seed=42)))
    pilot.run(3.0)
    for unit in units:
        for kind in kinds:
            possible = unit != 101 or kind in (1, 4)
            assert pilot.command(420, unit, kind, 0) == (ACCEPTED if possible else UNSUPPORTED)
            pilot.run(0.02)
            assert pilot.command(420, unit, 0, 0) == ACCEPTED
    assert pilot.command(420, 4, 7, 0) == UNSUPPORTED
    assert "param2 is 7" in pilot.texts()[-1]
    pilot.run(2.0)
    assert healthy(pilot) & m.MAV_SYS_STATUS_SENSOR_GPS


def test_a_fault_of_the_configuration_comes_at_its_time() -> None:
    pilot = hovering("battery:off@40", "range:off@40")
    while pilot.now_us < 39_000_000:
        pilot.run(0.5)
    assert pilot.last("SYS_STATUS").voltage_battery > 14_000
    assert flags(pilot) & m.ESTIMATOR_POS_VERT_AGL
    pilot.run(2.0)
    assert pilot.last("SYS_STATUS").voltage_battery == 0xFFFF
    assert not healthy(pilot) & m.MAV_SYS_STATUS_SENSOR_BATTERY
    assert not flags(pilot) & m.ESTIMATOR_POS_VERT_AGL


def test_the_height_above_a_roof_is_told_where_the_altitude_stays() -> None:
    pilot = hovering(world=World(boxes=np.array([[-3.0, -3.0, -1.0, 3.0, 3.0, -0.9]])))  # a roof it took off through
    pilot.run(1.5)
    told = pilot.last("ALTITUDE")
    height = -float(pilot.vehicle.truth.position_n[2])
    assert told.altitude_relative == pytest.approx(height, abs=0.3)
    assert told.bottom_clearance == told.altitude_terrain == pytest.approx(height - 1.0, abs=0.1)
    assert 0.0 <= pilot.last("ESTIMATOR_STATUS").hagl_ratio < 1.0


def test_a_wall_ahead_is_told_ten_times_a_second_and_the_height_above_ground_with_it() -> None:
    pilot = hovering(world=World(boxes=np.array([[6.0, -30.0, -9.0, 7.0, 30.0, 1.0]])))
    before = len(pilot.of("OBSTACLE_DISTANCE"))
    pilot.run(3.0)
    told = pilot.of("OBSTACLE_DISTANCE")[before:]
    assert len(told) == pytest.approx(30, abs=1)
    assert told[-1].distances[0] == pytest.approx(600, abs=60)
    assert told[-1].distances[36] == told[-1].max_distance + 1
    below = pilot.last("DISTANCE_SENSOR").current_distance / 100.0
    assert below == pytest.approx(-float(pilot.vehicle.truth.position_n[2]) + 0.2, abs=0.3)
    assert pilot.command(512, m.MAVLINK_MSG_ID_OBSTACLE_DISTANCE_3D) == ACCEPTED
    assert pilot.last("OBSTACLE_DISTANCE_3D").max_distance == pytest.approx(25.0)
