"""MAVSDK (PyPI, its current synchronous API) loads and flies a mission, loads a fence, and flies by attitude."""

import math
import time
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from vehicle_process import VehicleProcess, free_port

mavsdk = pytest.importorskip("mavsdk")

from mavsdk import ComponentType, Configuration, Mavsdk  # noqa: E402  (after the skip)
from mavsdk.plugins.action import Action  # noqa: E402
from mavsdk.plugins.geofence import FenceType, Geofence, GeofenceData, Point, Polygon  # noqa: E402
from mavsdk.plugins.mission import Mission, MissionItem, MissionPlan  # noqa: E402
from mavsdk.plugins.offboard import Attitude, AttitudeRate, Offboard  # noqa: E402
from mavsdk.plugins.telemetry import FlightMode, Telemetry  # noqa: E402

pytestmark = pytest.mark.udp

LATITUDE, LONGITUDE = 47.397742, 8.545594
NORTH, EAST = 1.0 / 111_180.0, 1.0 / 75_500.0
"""A metre in degrees there."""
NAN = math.nan


@pytest.fixture
def system() -> Iterator[Any]:
    """MAVSDK's view of a vehicle that calls it, four times as fast as life."""
    port = free_port()
    with VehicleProcess("--connect", f"udpout:127.0.0.1:{port}", "--seed", "6", "--speed", "4") as vehicle:
        client = Mavsdk(Configuration.create_with_component_type(ComponentType.GROUND_STATION))
        try:
            client.add_any_connection(f"udpin://127.0.0.1:{port}")
            found = client.first_autopilot(20.0)
            assert found is not None, vehicle.log
            yield found
        finally:
            client.destroy()


def until(condition: Callable[[], bool], seconds: float, what: str) -> None:
    deadline = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < deadline, f"{what}: not within {seconds} s"
        time.sleep(0.02)


def place(north: float, east: float, up: float, *, through: bool, stay: float = NAN) -> MissionItem:
    camera = MissionItem.CameraAction.NONE
    nothing = MissionItem.VehicleAction.NONE
    return MissionItem(
        LATITUDE + north * NORTH,
        LONGITUDE + east * EAST,
        up,
        5.0,
        through,
        NAN,
        NAN,
        camera,
        stay,
        NAN,
        NAN,
        NAN,
        NAN,
        nothing,
    )


def test_a_mission_is_loaded_read_back_flown_paused_and_returned_from(system: Any) -> None:
    action, telemetry, mission = Action(system), Telemetry(system), Mission(system)
    until(telemetry.health_all_ok, 20, "health")
    plan = MissionPlan(
        [
            place(6.0, 0.0, 4.0, through=True),
            place(6.0, 8.0, 5.0, through=False, stay=2.0),
            place(0.0, 8.0, 4.0, through=True),
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
    telemetry, fence = Telemetry(system), Geofence(system)
    until(telemetry.health_all_ok, 20, "health")
    corners = [Point(LATITUDE + n * NORTH, LONGITUDE + e * EAST) for n, e in ((-9, -9), (9, -9), (9, 9), (-9, 9))]
    fence.upload_geofence(GeofenceData([Polygon(corners, FenceType.INCLUSION)], []))
    (polygon,) = fence.download_geofence().polygons
    assert [p.latitude_deg for p in polygon.points] == pytest.approx([p.latitude_deg for p in corners])
    fence.clear_geofence()


def test_attitudes_and_body_rates_are_flown(system: Any) -> None:
    action, telemetry, offboard = Action(system), Telemetry(system), Offboard(system)
    until(telemetry.health_all_ok, 20, "health")
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
