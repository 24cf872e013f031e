"""MAVSDK's asyncio API flies the vehicle's process: what a user of `System()` does, from connecting to landing."""

import asyncio
import json
import math
from pathlib import Path
from typing import Any

import pytest
from vehicle_process import VehicleProcess

pytest.importorskip("mavsdk_grpc")

from mavsdk_client import first, fly, last, listed, ready, until
from mavsdk_grpc.action import ActionError
from mavsdk_grpc.component_metadata import MetadataType
from mavsdk_grpc.ftp import FtpError
from mavsdk_grpc.geofence import Circle, FenceType, GeofenceData, Point, Polygon
from mavsdk_grpc.mission import MissionItem, MissionPlan
from mavsdk_grpc.offboard import (
    Attitude,
    AttitudeRate,
    OffboardError,
    PositionNedYaw,
    VelocityBodyYawspeed,
    VelocityNedYaw,
)
from mavsdk_grpc.param import ParamError
from mavsdk_grpc.telemetry import FlightMode, LandedState
from pymavlink.mavftp import MAVFTP

from logs.container import bare_tail

pytestmark = pytest.mark.udp


def test_version_and_identity() -> None:
    async def story(system: Any, _vehicle: VehicleProcess) -> None:
        version = await system.info.get_version()
        assert (version.flight_sw_major, version.flight_sw_minor) == (1, 16)
        identity = await system.info.get_identification()
        assert identity.legacy_uid or identity.hardware_uid

    fly(story)


def test_parameters_by_name_and_all_at_once() -> None:
    async def story(system: Any, _vehicle: VehicleProcess) -> None:
        param = system.param
        everything = await param.get_all_params()
        ints = {p.name: p.value for p in everything.int_params}
        floats = {p.name: p.value for p in everything.float_params}
        assert ints["COM_OBL_RC_ACT"] == 5
        assert floats["MPC_LAND_SPEED"] == pytest.approx(0.7)
        await param.set_param_float("MPC_LAND_SPEED", 0.9)
        await param.set_param_int("COM_OBL_RC_ACT", 4)
        assert await param.get_param_float("MPC_LAND_SPEED") == pytest.approx(0.9)
        assert await param.get_param_int("COM_OBL_RC_ACT") == 4
        with pytest.raises(ParamError):
            await asyncio.wait_for(param.get_param_float("NO_SUCH_NAME"), 3)
        with pytest.raises(ParamError):
            await asyncio.wait_for(param.set_param_float("MPC_LAND_SPEED", 1e6), 3)
        await system.action.reboot()  # what was set outlives it
        assert await param.get_param_float("MPC_LAND_SPEED") == pytest.approx(0.9)
        with pytest.raises(ActionError):
            await system.action.shutdown()

    fly(story)


def test_files_are_listed_fetched_and_compared(tmp_path: Path) -> None:
    async def story(system: Any, _vehicle: VehicleProcess) -> None:
        ftp = system.ftp
        assert await listed(system, "/") == ["@PARAM", "etc", "fs", "log"]
        for burst in (False, True):
            folder = tmp_path / str(burst)
            folder.mkdir()
            for name in ("@PARAM/param.pck", "etc/extras/parameters.json"):
                await last(ftp.download(name, str(folder), burst))
        assert (tmp_path / "True/parameters.json").read_bytes() == (tmp_path / "False/parameters.json").read_bytes()
        assert await ftp.are_files_identical(str(tmp_path / "True/parameters.json"), "etc/extras/parameters.json")
        packed = MAVFTP.ftp_param_decode((tmp_path / "True/param.pck").read_bytes())
        values = {name.decode(): value for name, value, _ in packed.params}
        assert values["MPC_LAND_SPEED"] == pytest.approx(0.7)
        with pytest.raises(FtpError):
            await last(ftp.download("log/none.mcap", str(tmp_path), False), 5)
        with pytest.raises(FtpError):
            await last(ftp.upload(str(tmp_path / "True/parameters.json"), "/log"), 5)

    fly(story)


def test_what_every_parameter_means_is_found_through_component_metadata() -> None:
    async def story(system: Any, _vehicle: VehicleProcess) -> None:
        metadata = system.component_metadata
        await metadata.request_autopilot_component()
        found = await until(metadata.metadata_available(), lambda update: update.type == MetadataType.PARAMETER, 15)
        described = {p["name"]: p for p in json.loads(found.json_metadata)["parameters"]}
        assert described["MPC_LAND_SPEED"]["units"] == "m/s"
        everything = await system.param.get_all_params()
        assert described.keys() == {p.name for p in everything.int_params + everything.float_params}

    fly(story)


def test_the_recording_comes_by_the_log_protocol_and_by_ftp(tmp_path: Path) -> None:
    async def story(system: Any, vehicle: VehicleProcess) -> None:
        await asyncio.sleep(1.0)
        (entry,) = await system.log_files.get_entries()
        target = tmp_path / "by_log.mcap"
        await last(system.log_files.download_log_file(entry, str(target)))
        (name,) = await listed(system, "/log")
        await last(system.ftp.download(f"log/{name}", str(tmp_path), True))
        vehicle.stop()
        whole = (tmp_path / "record" / name).read_bytes()
        by_log, by_ftp = target.read_bytes(), (tmp_path / name).read_bytes()
        assert 0 < len(by_log) == entry.size_bytes <= len(by_ftp) < len(whole)
        for part in (by_log, by_ftp):  # an unfinished file has an end already, which what comes next is written over
            assert whole.startswith(part[: -len(bare_tail(0))])

    fly(story, "--record", str(tmp_path / "record"))


def test_take_off_goto_offboard_in_four_ways_and_return() -> None:
    async def story(system: Any, _vehicle: VehicleProcess) -> None:
        action, telemetry, offboard = system.action, system.telemetry, system.offboard
        await ready(system)
        with pytest.raises(OffboardError):
            await offboard.start()  # no setpoint has been set
        await action.set_takeoff_altitude(3.0)
        await action.arm()
        await action.takeoff()
        await until(telemetry.flight_mode(), lambda mode: mode == FlightMode.HOLD, 15)
        assert await first(telemetry.in_air())
        with pytest.raises(ActionError):
            await action.disarm()
        home = await first(telemetry.home())
        await action.goto_location(home.latitude_deg + 3e-5, home.longitude_deg, home.absolute_altitude_m + 4.0, 0.0)
        await until(telemetry.position(), lambda p: abs(p.latitude_deg - home.latitude_deg - 3e-5) < 4e-6, 15)

        await offboard.set_position_ned(PositionNedYaw(2.0, 1.0, -3.0, 45.0))
        await offboard.start()
        await until(telemetry.position_velocity_ned(), lambda t: away(t, (2.0, 1.0, -3.0)) < 0.4, 15)
        assert await first(telemetry.flight_mode()) == FlightMode.OFFBOARD
        await offboard.set_velocity_ned(VelocityNedYaw(0.0, -1.5, 0.0, 0.0))
        await until(telemetry.velocity_ned(), lambda v: abs(v.east_m_s + 1.5) < 0.2 and abs(v.north_m_s) < 0.2, 8)
        await offboard.set_velocity_body(VelocityBodyYawspeed(1.0, 0.0, 0.0, 30.0))
        await until(telemetry.attitude_euler(), lambda a: 60.0 < a.yaw_deg < 120.0, 8)
        await offboard.set_velocity_ned(VelocityNedYaw(0.0, 0.0, 0.0, 0.0))
        await until(telemetry.velocity_ned(), lambda v: math.hypot(v.east_m_s, v.north_m_s) < 0.2, 8)
        await offboard.stop()
        await until(telemetry.flight_mode(), lambda mode: mode == FlightMode.HOLD, 4)

        await action.set_return_to_launch_altitude(5.0)
        await action.return_to_launch()
        await until(telemetry.flight_mode(), lambda mode: mode == FlightMode.RETURN_TO_LAUNCH, 4)
        await until(telemetry.landed_state(), lambda state: state == LandedState.ON_GROUND, 30)
        await until(telemetry.armed(), lambda armed: not armed, 6)
        assert away(await first(telemetry.position_velocity_ned()), (0.0, 0.0, 0.0)) < 0.8

    fly(story, "--seed", "5", "--speed", "3")


def away(told: Any, point: tuple[float, float, float]) -> float:
    p = told.position
    return math.dist((p.north_m, p.east_m, p.down_m), point)


def test_offboard_by_attitude_and_by_body_rates() -> None:
    """A lean of 5 degrees to the right drifts east; 0.6 of its thrust is about what the x500 hovers with."""
    hover = 0.6

    async def story(system: Any, _vehicle: VehicleProcess) -> None:
        action, telemetry, offboard = system.action, system.telemetry, system.offboard
        await ready(system)
        await action.set_takeoff_altitude(6.0)
        await action.arm()
        await action.takeoff()
        await until(telemetry.flight_mode(), lambda mode: mode == FlightMode.HOLD, 20)
        await offboard.set_attitude(Attitude(5.0, 0.0, 0.0, hover))
        await offboard.start()
        await until(telemetry.flight_mode(), lambda mode: mode == FlightMode.OFFBOARD, 3)
        await until(telemetry.attitude_euler(), lambda a: abs(a.roll_deg - 5.0) < 1.5 and abs(a.pitch_deg) < 1.5, 3)
        await until(telemetry.velocity_ned(), lambda v: v.east_m_s > 0.5, 4)
        await offboard.set_attitude_rate(AttitudeRate(0.0, 0.0, 40.0, hover))
        await until(telemetry.attitude_angular_velocity_body(), lambda w: 0.5 < w.yaw_rad_s < 0.9, 3)
        await offboard.stop()
        await until(telemetry.flight_mode(), lambda mode: mode == FlightMode.HOLD, 4)
        await action.land()
        await until(telemetry.armed(), lambda armed: not armed, 60)

    fly(story, "--speed", "2")


def test_a_mission_and_a_fence_are_loaded_and_the_mission_flown() -> None:
    async def story(system: Any, _vehicle: VehicleProcess) -> None:
        await ready(system)
        home = await first(system.telemetry.home())

        def item(north: float, stay: float) -> MissionItem:
            nan = math.nan
            camera, action = MissionItem.CameraAction.NONE, MissionItem.VehicleAction.NONE
            latitude = home.latitude_deg + north / 111_180.0
            place = (latitude, home.longitude_deg, 5.0, 5.0, False, nan, nan)
            return MissionItem(*place, camera, stay, nan, nan, nan, nan, action)

        fence = [(home.latitude_deg + n * 1e-3, home.longitude_deg + e * 1e-3) for n, e in ((1, 1), (1, -1), (-1, 0))]
        area = Polygon([Point(*corner) for corner in fence], FenceType.INCLUSION)
        hole = Circle(Point(home.latitude_deg, home.longitude_deg + 5e-4), 5.0, FenceType.EXCLUSION)
        await system.geofence.upload_geofence(GeofenceData([area], [hole]))
        await system.mission.set_return_to_launch_after_mission(False)
        await system.mission.upload_mission(MissionPlan([item(4.0, 0.5), item(10.0, 0.5)]))
        back = (await system.mission.download_mission()).mission_items
        assert [round((one.latitude_deg - home.latitude_deg) * 111_180.0) for one in back] == [4, 10]
        assert [one.relative_altitude_m for one in back] == [5.0, 5.0]
        await system.action.arm()
        await system.mission.start_mission()
        await until(system.telemetry.flight_mode(), lambda mode: mode == FlightMode.MISSION, 5)
        await until(system.mission.mission_progress(), lambda done: done.current == done.total == 2, 40)
        assert await system.mission.is_mission_finished()
        position = await first(system.telemetry.position())
        assert (position.latitude_deg - home.latitude_deg) * 111_180.0 == pytest.approx(10.0, abs=2.5)
        await system.action.land()
        await until(system.telemetry.armed(), lambda armed: not armed, 30)
        await system.mission.clear_mission()
        await system.geofence.clear_geofence()

    fly(story, "--speed", "3")
