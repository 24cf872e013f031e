"""MAVSDK (PyPI, its current synchronous API) flies the ArduPilot flavour by the HEARTBEAT's word."""

import math
from typing import Any

import pytest

pytest.importorskip("mavsdk")

from mavsdk.plugins.action import Action, ActionError
from mavsdk.plugins.geofence import FenceType, Geofence, GeofenceData, Point, Polygon
from mavsdk.plugins.info import Info
from mavsdk.plugins.mission import Mission, MissionError, MissionPlan
from mavsdk.plugins.offboard import Offboard, PositionNedYaw
from mavsdk.plugins.param import Param, ParamError
from mavsdk.plugins.telemetry import FlightMode, LandedState, Telemetry
from mavsdk_sync import LATITUDE, LONGITUDE, NORTH, answers, connected, place, until

pytestmark = pytest.mark.udp

RATES = ("health", "gps_info", "position", "position_velocity_ned", "landed_state", "attitude_euler")


def streaming(system: Any) -> Telemetry:
    """Telemetry that is well; ArduPilot sends what is asked for, so it is asked for."""
    telemetry = Telemetry(system)
    for name in RATES:
        getattr(telemetry, f"set_rate_{name}")(10.0)
    until(telemetry.health_all_ok, 20, "health")
    return telemetry


def test_mavsdk_flies_the_ardupilot_flavour() -> None:
    with connected("--autopilot", "ardupilot", "--seed", "5", "--speed", "4") as system:
        telemetry, action, offboard = streaming(system), Action(system), Offboard(system)
        action.set_takeoff_altitude(4.0)
        with pytest.raises(ActionError):
            action.takeoff()  # it is not armed
        action.arm()
        until(telemetry.armed, 2, "arming")
        action.takeoff()
        until(lambda: telemetry.position().relative_altitude_m > 3.7, 10, "takeoff")
        assert telemetry.in_air()
        home = telemetry.home()
        north = home.latitude_deg + 8.0 * NORTH
        action.goto_location(north, home.longitude_deg, home.absolute_altitude_m + 4.0, 0.0)
        until(lambda: abs(telemetry.position().latitude_deg - north) < 0.5 * NORTH, 10, "the place")
        offboard.set_position_ned(PositionNedYaw(2.0, 1.0, -3.0, 0.0))
        offboard.start()

        def away() -> float:
            p = telemetry.position_velocity_ned().position
            return math.dist((p.north_m, p.east_m, p.down_m), (2.0, 1.0, -3.0))

        until(lambda: away() < 0.4, 10, "offboard")
        assert telemetry.flight_mode() == FlightMode.OFFBOARD  # what MAVSDK calls GUIDED
        offboard.stop()
        action.hold()
        until(lambda: telemetry.flight_mode() == FlightMode.HOLD, 3, "hold")
        action.return_to_launch()
        until(lambda: telemetry.flight_mode() == FlightMode.RETURN_TO_LAUNCH, 3, "the return")
        action.land()
        until(lambda: telemetry.flight_mode() == FlightMode.LAND, 3, "land")
        until(lambda: not telemetry.armed(), 20, "disarming")
        until(lambda: telemetry.landed_state() == LandedState.ON_GROUND, 3, "the ground")


def test_mavsdk_flies_a_mission_inside_a_fence_on_the_ardupilot_flavour_and_returns() -> None:
    with connected("--autopilot", "ardupilot", "--seed", "6", "--speed", "4") as system:
        telemetry, action, mission, fence = streaming(system), Action(system), Mission(system), Geofence(system)
        corners = [Point(LATITUDE + n * 1e-3, LONGITUDE + e * 1e-3) for n, e in ((1, 1), (1, -1), (-1, 0))]
        fence.upload_geofence(GeofenceData([Polygon(corners, FenceType.INCLUSION)], []))
        mission.upload_mission(MissionPlan([place(6.0, 0.0, 5.0, through=True), place(6.0, 6.0, 5.0, through=True)]))
        action.arm()
        action.takeoff()
        until(telemetry.in_air, 5, "takeoff")
        mission.start_mission()
        until(lambda: telemetry.flight_mode() == FlightMode.MISSION, 5, "mission mode")
        until(mission.is_mission_finished, 20, "the mission")
        assert mission.mission_progress().total == 2
        assert abs(telemetry.position().latitude_deg - LATITUDE - 6.0 * NORTH) < 1.5 * NORTH
        with pytest.raises(MissionError):
            mission.download_mission()  # item 0 is home, as ArduPilot's is, and MAVSDK does not know its frame
        action.return_to_launch()
        until(lambda: telemetry.flight_mode() == FlightMode.RETURN_TO_LAUNCH, 3, "the return")
        until(lambda: not telemetry.armed(), 40, "landing")
        assert abs(telemetry.position().latitude_deg - telemetry.home().latitude_deg) < 0.6 * NORTH
        mission.clear_mission()
        fence.clear_geofence()


def test_version_and_parameters_of_the_ardupilot_flavour() -> None:
    with connected("--autopilot", "ardupilot") as system:
        info, param = Info(system), Param(system)
        until(lambda: answers(info.get_version), 5, "version")
        assert param.get_param_int("RTL_ALT") == 1500
        param.set_param_int("RTL_ALT", 1200)
        assert param.get_param_int("RTL_ALT") == 1200
        with pytest.raises(ParamError):
            param.get_param_float("NO_SUCH_NAME")
        everything = param.get_all_params()
        assert "LAND_SPEED" in {each.name for each in (*everything.int_params, *everything.float_params)}
