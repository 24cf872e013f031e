"""MAVSDK (PyPI, its current synchronous API) flies a mission, by attitude and home, and loads a fence."""

import math
from collections.abc import Iterator
from typing import Any

import pytest

pytest.importorskip("mavsdk")

from mavsdk.plugins.action import Action, OrbitYawBehavior
from mavsdk.plugins.geofence import FenceType, Geofence, GeofenceData, Point, Polygon
from mavsdk.plugins.mission import Mission, MissionPlan
from mavsdk.plugins.offboard import Attitude, AttitudeRate, Offboard
from mavsdk.plugins.telemetry import FlightMode, LandedState
from mavsdk_sync import EAST, LATITUDE, LONGITUDE, NORTH, connected, healthy, place, until

pytestmark = pytest.mark.udp


@pytest.fixture
def system() -> Iterator[Any]:
    """A vehicle four times as fast as life."""
    with connected("--seed", "6", "--speed", "4") as found:
        yield found


def test_a_mission_is_loaded_read_back_flown_paused_and_returned_from(system: Any) -> None:
    action, telemetry, mission = Action(system), healthy(system), Mission(system)
    plan = MissionPlan(
        [
            place(6.0, 0.0, 4.0, through=True),
            place(6.0, 8.0, 5.0, through=False, stay=2.0),
            place(0.0, 8.0, 4.0, through=True, photo=True),
        ]
    )
    mission.set_return_to_launch_after_mission(True)
    mission.upload_mission(plan)
    back = mission.download_mission().mission_items
    assert [(item.relative_altitude_m, item.speed_m_s) for item in back] == [(4.0, 5.0), (5.0, 5.0), (4.0, 5.0)]
    action.arm()
    mission.start_mission()
    until(lambda: telemetry.flight_mode() == FlightMode.MISSION, 5, "mission mode")
    until(lambda: mission.mission_progress().current >= 1, 30, "the first item")
    mission.pause_mission()
    until(lambda: telemetry.flight_mode() == FlightMode.HOLD, 5, "pause")
    mission.start_mission()
    until(mission.is_mission_finished, 60, "the mission")
    until(lambda: telemetry.flight_mode() == FlightMode.RETURN_TO_LAUNCH, 5, "the return")
    until(lambda: not telemetry.armed(), 60, "landing")
    mission.clear_mission()


def test_a_fence_is_loaded_and_cleared(system: Any) -> None:
    healthy(system)
    fence = Geofence(system)
    corners = [Point(LATITUDE + n * NORTH, LONGITUDE + e * EAST) for n, e in ((-9, -9), (9, -9), (9, 9), (-9, 9))]
    fence.upload_geofence(GeofenceData([Polygon(corners, FenceType.INCLUSION)], []))
    (polygon,) = fence.download_geofence().polygons
    assert [p.latitude_deg for p in polygon.points] == pytest.approx([p.latitude_deg for p in corners])
    fence.clear_geofence()


def test_a_return_climbs_comes_home_lands_and_disarms(system: Any) -> None:
    action, telemetry = Action(system), healthy(system)
    home = telemetry.home()
    action.set_takeoff_altitude(4.0)
    action.set_return_to_launch_altitude(8.0)
    assert action.get_return_to_launch_altitude() == 8.0
    action.arm()
    action.takeoff()
    until(lambda: telemetry.flight_mode() == FlightMode.HOLD and telemetry.in_air(), 20, "takeoff")
    latitude, longitude = home.latitude_deg + 20.0 * NORTH, home.longitude_deg - 10.0 * EAST
    action.goto_location(latitude, longitude, home.absolute_altitude_m + 4.0, math.nan)

    def away() -> float:
        position = telemetry.position()
        north = (position.latitude_deg - home.latitude_deg) / NORTH
        return math.hypot(north, (position.longitude_deg - home.longitude_deg) / EAST)

    until(lambda: away() > 21.0, 20, "the place")
    to_centre = OrbitYawBehavior.HOLD_FRONT_TO_CIRCLE_CENTER
    action.do_orbit(4.0, 3.0, to_centre, latitude, longitude, home.absolute_altitude_m + 4.0)
    until(lambda: away() > math.hypot(20.0, 10.0) + 3.0, 20, "the far side of the circle")
    action.return_to_launch()
    until(lambda: telemetry.flight_mode() == FlightMode.RETURN_TO_LAUNCH, 5, "the return")
    heights: list[float] = []

    def over_home() -> bool:
        heights.append(telemetry.position().relative_altitude_m)
        return away() < 1.0

    until(over_home, 30, "home")
    assert max(heights) == pytest.approx(8.0, abs=0.5)
    until(lambda: telemetry.landed_state() == LandedState.ON_GROUND, 40, "landing")
    until(lambda: not telemetry.armed(), 5, "disarming")
    assert away() < 0.6
    assert abs(telemetry.position().relative_altitude_m) < 0.6


def test_attitudes_and_body_rates_are_flown(system: Any) -> None:
    action, telemetry, offboard = Action(system), healthy(system), Offboard(system)
    action.set_takeoff_altitude(15.0)
    action.arm()
    action.takeoff()
    until(lambda: telemetry.flight_mode() == FlightMode.HOLD and telemetry.in_air(), 30, "takeoff")
    offboard.set_attitude(Attitude(5.0, -5.0, 40.0, 0.6))
    offboard.start()

    def off() -> float:
        euler = telemetry.attitude_euler()
        return max(abs(euler.roll_deg - 5.0), abs(euler.pitch_deg + 5.0), abs(euler.yaw_deg - 40.0))

    until(lambda: off() < 2.0, 5, "the attitude")
    assert telemetry.flight_mode() == FlightMode.OFFBOARD
    offboard.set_attitude_rate(AttitudeRate(0.0, 0.0, 30.0, 0.6))
    until(lambda: abs(telemetry.attitude_euler().yaw_deg - 40.0) > 30.0, 5, "the turn")
    offboard.stop()
    action.set_current_speed(3.0)
    action.land()
    until(lambda: not telemetry.armed(), 60, "landing")
