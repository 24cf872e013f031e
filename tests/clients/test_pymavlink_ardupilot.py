"""pymavlink's mavutil against the ArduPilot flavour, as every script for ArduPilot uses it: it takes the vehicle for
one from the HEARTBEAT, and chooses modes, casts and units accordingly."""

import time
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from pymavlink import mavparm, mavutil
from vehicle_process import VehicleProcess, free_port

pytestmark = pytest.mark.udp


@pytest.fixture(scope="module")
def connection() -> Iterator[Any]:
    """What `mavutil.mavlink_connection` makes of a vehicle that calls it."""
    port = free_port()
    patch = pytest.MonkeyPatch()
    patch.setenv("MAVLINK20", "1")
    mavutil.set_dialect("ardupilotmega")
    flavour = ("--autopilot", "ardupilot", "--param", "RTL_ALT=1000", "--speed", "3")
    with VehicleProcess("--connect", f"udpout:127.0.0.1:{port}", *flavour):
        found = mavutil.mavlink_connection(f"udpin:127.0.0.1:{port}", source_system=255, source_component=190)
        try:
            assert found.wait_heartbeat(timeout=10) is not None
            yield found
        finally:
            found.close()
            patch.undo()


def until(connection: Any, kind: str, holds: Callable[[Any], bool], seconds: float) -> Any:
    """The first message of a kind for which a condition holds."""
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline:
        message = connection.recv_match(type=kind, blocking=True, timeout=1)
        if message is not None and holds(message):
            return message
    raise AssertionError(f"no such {kind} within {seconds} s")


def test_parameters_are_cast_as_ardupilots_are(connection: Any) -> None:
    parameters = mavparm.MAVParmDict()
    assert parameters.mavset(connection, "RTL_ALT", 1200, retries=3)
    connection.param_fetch_one("RTL_ALT")
    assert until(connection, "PARAM_VALUE", lambda m: m.param_id == "RTL_ALT", 3).param_value == 1200.0


def test_a_script_for_ardupilot_flies_it(connection: Any) -> None:
    assert connection.mavlink20()
    connection.mav.request_data_stream_send(1, 1, mavutil.mavlink.MAV_DATA_STREAM_ALL, 10, 1)
    until(connection, "EKF_STATUS_REPORT", lambda m: m.flags & 831 == 831, 20)
    prearm = mavutil.mavlink.MAV_SYS_STATUS_PREARM_CHECK
    until(connection, "SYS_STATUS", lambda m: bool(m.onboard_control_sensors_health & prearm), 5)
    assert {"GUIDED", "RTL", "LAND", "BRAKE"} <= set(connection.mode_mapping())
    connection.set_mode("GUIDED")
    until(connection, "HEARTBEAT", lambda _: connection.flightmode == "GUIDED", 3)
    connection.arducopter_arm()
    until(connection, "HEARTBEAT", lambda _: bool(connection.motors_armed()), 3)
    takeoff = mavutil.mavlink.MAV_CMD_NAV_TAKEOFF
    connection.mav.command_long_send(1, 1, takeoff, 0, 0, 0, 0, 0, 0, 0, 3)
    assert until(connection, "COMMAND_ACK", lambda m: m.command == takeoff, 3).result == 0
    until(connection, "GLOBAL_POSITION_INT", lambda m: m.relative_alt > 2700, 10)
    connection.mav.set_position_target_local_ned_send(0, 1, 1, 1, 0xDF8, 2, 0, -3, *[0] * 8)
    until(connection, "LOCAL_POSITION_NED", lambda m: abs(m.x - 2) < 0.3, 10)
    connection.set_mode("LAND")
    until(connection, "HEARTBEAT", lambda _: not connection.motors_armed(), 20)
    assert connection.flightmode == "LAND"
