"""MAVSDK (PyPI, its current synchronous API) flies the vehicle's process: connect, arm, take off, offboard, land."""

import math
from collections.abc import Iterator
from typing import Any

import pytest

pytest.importorskip("mavsdk")

from mavsdk.plugins.action import Action, ActionError
from mavsdk.plugins.info import Info
from mavsdk.plugins.offboard import Offboard, OffboardError, PositionNedYaw
from mavsdk.plugins.param import Param
from mavsdk.plugins.telemetry import FlightMode, LandedState
from mavsdk_sync import answers, connected, healthy, until

pytestmark = pytest.mark.udp


@pytest.fixture
def system() -> Iterator[Any]:
    """A vehicle as fast as life."""
    with connected("--seed", "5") as found:
        yield found


def test_arm_take_off_fly_offboard_to_a_point_and_land(system: Any) -> None:
    action, telemetry, offboard = Action(system), healthy(system), Offboard(system)
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
    until(lambda: answers(info.get_version), 5, "version")
    assert param.get_param_int("COM_OBL_RC_ACT") == 5
    param.set_param_int("COM_OBL_RC_ACT", 4)
    assert param.get_param_int("COM_OBL_RC_ACT") == 4
    assert param.get_param_float("MPC_LAND_SPEED") == pytest.approx(0.7)
