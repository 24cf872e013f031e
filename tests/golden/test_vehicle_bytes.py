"""Bytes worked by hand from the MAVLink definition (common.xml, minimal.xml), which no encoder of ours has seen.

A MAVLink 2 packet is FD, payload length, incompat flags, compat flags, sequence, system, component, message id (three
bytes, little endian), payload, CRC-16/MCRF4XX (X.25) over all but the FD and then CRC_EXTRA. Fields stand by
size, largest first, otherwise in the order of the definition; trailing zero bytes are cut.
"""

from typing import Any

import pytest
from flight_double import PointMass

import fakevehicle.vehicle
from fakevehicle.config import VehicleConfig
from fakevehicle.vehicle import Vehicle
from wire.datagram import Datagram

PEER = ("127.0.0.1", 14540)


def crc_mcrf4xx(data: bytes) -> int:
    """The checksum as the MAVLink guide writes it down, byte by byte (checksum.h)."""
    crc = 0xFFFF
    for byte in data:
        t = byte ^ (crc & 0xFF)
        t = (t ^ (t << 4)) & 0xFF
        crc = (crc >> 8) ^ (t << 8) ^ (t << 3) ^ (t >> 4)
        crc &= 0xFFFF
    return crc


def packet(head: str, payload: str, crc_extra: int) -> bytes:
    body = bytes.fromhex(head + payload)
    return b"\xfd" + body + crc_mcrf4xx(body + bytes((crc_extra,))).to_bytes(2, "little")


HEARTBEAT = packet(
    "09 00 00 00 01 01 00 00 00",  # 9 bytes, sequence 0, system 1, component 1, message 0
    "00 00 04 03"  # custom_mode: PX4 main 4 (AUTO) << 16 | sub 3 (LOITER) << 24
    "02"  # MAV_TYPE_QUADROTOR
    "0c"  # MAV_AUTOPILOT_PX4
    "1d"  # base_mode: custom 1 + auto 4 + guided 8 + stabilize 16
    "00"  # MAV_STATE_UNINIT: the estimate is not ready
    "03",  # mavlink_version
    50,
)

SET_POSITION_TARGET_LOCAL_NED = packet(
    "35 00 00 00 ff be 54 00 00",  # 53 bytes, sequence 0, system 255, component 190, message 84
    "e8 03 00 00"  # time_boot_ms 1000
    "00 00 80 3f 00 00 00 40 00 00 40 c0"  # x 1, y 2, z -3
    "00 00 00 3f 00 00 80 be 00 00 00 00"  # vx 0.5, vy -0.25, vz 0
    "00 00 c0 3f 00 00 00 00 00 00 00 bf"  # afx 1.5, afy 0, afz -0.5
    "00 00 c0 bf"  # yaw -1.5
    "00 00 00 00"  # yaw_rate, ignored
    "00 08"  # type_mask 0x0800: ignore the yaw rate only
    "01 01"  # target system 1, component 1
    "01",  # MAV_FRAME_LOCAL_NED
    143,
)

ARM = packet(
    "20 00 00 01 ff be 4c 00 00",  # COMMAND_LONG: message 76; param1..7, command, target, confirmation (0, cut)
    "00 00 80 3f" + "00 00 00 00" * 6 + "90 01" + "01 01",  # param1 = 1.0, command 400, system 1, component 1
    152,
)


@pytest.fixture
def vehicle(monkeypatch: pytest.MonkeyPatch) -> Vehicle:
    monkeypatch.setattr(fakevehicle.vehicle, "FlightStack", PointMass)
    return Vehicle(VehicleConfig())


def test_the_checksum_is_the_published_one() -> None:
    assert crc_mcrf4xx(b"123456789") == 0x6F91  # the catalogue's check value of CRC-16/MCRF4XX


def test_the_first_packet_is_this_heartbeat(vehicle: Vehicle) -> None:
    first = next(d for d in vehicle.step(0, []) if d.link == "onboard")
    assert first.data == HEARTBEAT


def test_a_setpoint_in_these_bytes_is_followed_as_it_was_meant(vehicle: Vehicle) -> None:
    stack: Any = vehicle._stack
    for tick in range(250):
        vehicle.step(tick * 4000, [])
    offboard = packet(
        "20 00 00 02 ff be 4c 00 00", "00 00 80 3f 00 00 c0 40" + "00 00 00 00" * 5 + "b0 00" + "01 01", 152
    )
    inputs = [Datagram("onboard", data, PEER) for data in (SET_POSITION_TARGET_LOCAL_NED, ARM, offboard)]
    vehicle.step(250 * 4000, inputs)
    followed = stack.setpoint
    assert followed.position_n.tolist() == [1.0, 2.0, -3.0]
    assert followed.velocity_n.tolist() == [0.5, -0.25, 0.0]
    assert followed.acceleration_n.tolist() == [1.5, 0.0, -0.5]
    assert followed.yaw == -1.5
