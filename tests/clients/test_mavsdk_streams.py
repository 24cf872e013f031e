"""Every telemetry stream of MAVSDK's two Python APIs says something; docs/vehicle_autopilot.md has the same table."""

import asyncio
import inspect
import math
import re
import threading
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("mavsdk")
pytest.importorskip("mavsdk_grpc")

from mavsdk.plugins.action import Action
from mavsdk.plugins.telemetry import Telemetry
from mavsdk_client import first, fly, ready, until
from mavsdk_grpc.telemetry import FlightMode, VtolState
from mavsdk_sync import connected, healthy
from mavsdk_sync import until as wait_until
from vehicle_process import VehicleProcess

pytestmark = pytest.mark.udp

UNASKED = {
    "position",
    "home",
    "in_air",
    "landed_state",
    "armed",
    "vtol_state",
    "attitude_quaternion",
    "attitude_euler",
    "attitude_angular_velocity_body",
    "velocity_ned",
    "gps_info",
    "raw_gps",
    "battery",
    "flight_mode",
    "health",
    "health_all_ok",
    "rc_status",
    "odometry",
    "position_velocity_ned",
    "ground_truth",
    "fixedwing_metrics",
    "imu",
    "unix_epoch_time",
    "distance_sensor",
    "scaled_pressure",
    "heading",
    "altitude",
}
ON_REQUEST = {"actuator_control_target", "actuator_output_status", "raw_imu", "scaled_imu"}
IN_FLIGHT = {"wind"}
WHEN_IT_HAPPENS = {"status_text"}
EVERY = UNASKED | ON_REQUEST | IN_FLIGHT | WHEN_IT_HAPPENS


def test_the_page_has_every_stream_and_says_when_it_comes() -> None:
    page = (Path(__file__).parents[2] / "docs" / "vehicle_autopilot.md").read_text()
    table = page.split("## Telemetry")[1].split("\n## ")[0]
    told: dict[str, set[str]] = {}
    for names, _message, when in re.findall(r"^\| (`.*?`) \| (.*?) \| (.*?) \|", table, re.MULTILINE):
        told.setdefault(when.split(":")[0], set()).update(re.findall(r"`(\w+)`", names))
    assert told == {
        "always": UNASKED,
        "on request": ON_REQUEST,
        "in flight": IN_FLIGHT,
        "as it happens": WHEN_IT_HAPPENS,
    }


def test_the_asyncio_api_hears_every_stream() -> None:
    async def story(system: Any, _vehicle: VehicleProcess) -> None:
        await ready(system)
        telemetry, action = system.telemetry, system.action
        assert {name for name, _ in inspect.getmembers(type(telemetry), inspect.isasyncgenfunction)} == EVERY
        unasked = sorted(UNASKED)
        heard = await asyncio.gather(*(first(getattr(telemetry, name)()) for name in unasked))
        told = dict(zip(unasked, heard, strict=True))
        assert told["position"].latitude_deg == pytest.approx(47.397742, abs=1e-4)
        assert told["home"].absolute_altitude_m == pytest.approx(488.0, abs=3.0)
        assert abs(told["position_velocity_ned"].position.down_m) < 1.0
        assert told["ground_truth"].latitude_deg == pytest.approx(47.397742, abs=1e-6)
        assert told["imu"].acceleration_frd.down_m_s2 == pytest.approx(-9.8, abs=0.5)
        assert told["flight_mode"] == FlightMode.HOLD
        assert told["vtol_state"] == VtolState.UNDEFINED
        assert told["battery"].remaining_percent > 50
        assert told["scaled_pressure"].absolute_pressure_hpa == pytest.approx(956.0, abs=3.0)  # at 488 m
        assert told["distance_sensor"].maximum_distance_m == pytest.approx(20.0)
        assert not told["rc_status"].is_available  # there are no sticks
        origin = await telemetry.get_gps_global_origin()
        assert origin.longitude_deg == pytest.approx(8.545594, abs=1e-4)

        for name in sorted(ON_REQUEST):
            await getattr(telemetry, f"set_rate_{name}")(20.0)
        scaled, raw = await first(telemetry.scaled_imu()), await first(telemetry.raw_imu())
        assert scaled.acceleration_frd.down_m_s2 == pytest.approx(-9.8, abs=1.5)
        assert raw.acceleration_frd.down_m_s2 == pytest.approx(-1000, abs=150)  # MAVSDK leaves it in milli-g
        assert (await first(telemetry.actuator_output_status())).active == 4

        text = asyncio.ensure_future(first(telemetry.status_text()))
        wind = asyncio.ensure_future(first(telemetry.wind(), 15.0))
        await asyncio.sleep(0.2)
        await action.arm()
        assert "rmed" in (await text).text
        await action.takeoff()
        found = await wind
        assert (
            math.hypot(found.wind_x_ned_m_s - 4.0, found.wind_y_ned_m_s)
            < 3.0 * found.horizontal_wind_speed_accuracy_m_s
        )
        hovering = await until(telemetry.actuator_control_target(), lambda told: told.controls[3] > 0.2, 4)
        assert max(abs(share) for share in hovering.controls[:3]) < 0.2

    fly(story, "--speed", "3", "--wind", "4,0,0")


def test_the_synchronous_api_hears_every_stream() -> None:
    with connected("--speed", "3") as system:
        telemetry, action = healthy(system), Action(system)
        names = {name.removeprefix("subscribe_") for name in dir(Telemetry) if name.startswith("subscribe_")}
        assert names == EVERY
        heard = {name: threading.Event() for name in EVERY}
        for name in EVERY:
            getattr(telemetry, f"subscribe_{name}")(lambda _value, _data, name=name: heard[name].set())
        for name in sorted(ON_REQUEST):
            getattr(telemetry, f"set_rate_{name}")(10.0)
        action.arm()
        action.takeoff()
        wait_until(lambda: all(event.is_set() for event in heard.values()), 15, "every stream")
