"""MAVSDK (PyPI, its current synchronous API) flies the vehicle's process: connect, arm, take off, offboard, land."""

import math
import time
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from vehicle_process import VehicleProcess, free_port

mavsdk = pytest.importorskip("mavsdk")

from mavsdk import ComponentType, Configuration, Mavsdk  # noqa: E402  (after the skip)
from mavsdk.plugins.action import Action, ActionError  # noqa: E402
from mavsdk.plugins.info import Info  # noqa: E402
from mavsdk.plugins.offboard import Offboard, OffboardError, PositionNedYaw  # noqa: E402
from mavsdk.plugins.param import Param  # noqa: E402
from mavsdk.plugins.telemetry import FlightMode, LandedState, Telemetry  # noqa: E402

pytestmark = pytest.mark.udp


@pytest.fixture
def system() -> Iterator[Any]:
    """MAVSDK's view of a vehicle that calls it."""
    port = free_port()
    with VehicleProcess("--connect", f"udpout:127.0.0.1:{port}", "--seed", "5") as vehicle:
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
        time.sleep(0.05)


def test_arm_take_off_fly_offboard_to_a_point_and_land(system: Any) -> None:
    action, telemetry, offboard = Action(system), Telemetry(system), Offboard(system)
    until(telemetry.health_all_ok, 20, "health")
    with pytest.raises(OffboardError):
        offboard.start()  # no setpoint has been set
    action.set_takeoff_altitude(2.0)
    assert action.get_takeoff_altitude() == 2.0
    action.arm()
    until(telemetry.armed, 2, "arming")  # the ACK ends arm(), the HEARTBEAT that shows it comes right behind
    action.takeoff()
    until(lambda: telemetry.flight_mode() == FlightMode.HOLD and telemetry.in_air(), 15, "takeoff")
    with pytest.raises(ActionError):
        action.disarm()  # it flies
    offboard.set_position_ned(PositionNedYaw(2.0, 1.0, -3.0, 45.0))
    offboard.start()

    def away() -> float:
        p = telemetry.position_velocity_ned().position
        return math.dist((p.north_m, p.east_m, p.down_m), (2.0, 1.0, -3.0))

    until(lambda: away() < 0.4, 15, "offboard")
    assert telemetry.flight_mode() == FlightMode.OFFBOARD
    offboard.stop()
    until(lambda: telemetry.flight_mode() == FlightMode.HOLD, 3, "hold")
    action.land()
    until(lambda: telemetry.landed_state() == LandedState.ON_GROUND, 20, "landing")
    until(lambda: not telemetry.armed(), 5, "disarming")


def test_version_and_parameters(system: Any) -> None:
    info, param = Info(system), Param(system)
    until(lambda: _answers(info.get_version), 5, "version")
    assert param.get_param_int("COM_OBL_RC_ACT") == 5
    param.set_param_int("COM_OBL_RC_ACT", 4)
    assert param.get_param_int("COM_OBL_RC_ACT") == 4
    assert param.get_param_float("MPC_LAND_SPEED") == pytest.approx(0.7)


def _answers(call: Callable[[], Any]) -> bool:
    """MAVSDK raises until its first answer is in."""
    try:
        call()
    except Exception:
        return False
    return True
