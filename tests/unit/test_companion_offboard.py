"""The setpoint on the wire, against bytes worked by hand from the MAVLink definition."""

import struct

import numpy as np
import pytest

from companion.geofence import Geofence
from companion.offboard import FULL, flaw, setpoint_message, type_mask
from companion.seam import Reference
from wire.dialect import mavlink


def reference(**changes):
    values = {
        "position_m": np.array([1.0, 2.0, -3.0]),
        "velocity_m": np.array([0.5, -0.25, 0.0]),
        "acceleration_m": np.array([0.125, 0.0, -1.0]),
        "yaw": 0.75,
    }
    return Reference(**(values | changes))


@pytest.mark.parametrize(
    ("given", "mask"),
    [
        ({"position"}, 0x9F8 | 0x400),
        ({"position", "yaw"}, 0x9F8),
        ({"velocity", "yaw"}, 0x9C7),
        ({"position", "velocity", "yaw"}, 0x9C0),
        ({"position", "velocity", "acceleration", "yaw"}, 0x800),
        ({"acceleration", "yaw"}, 0x83F),
        ({"acceleration"}, 0xC3F),
    ],
)
def test_the_type_mask_ignores_what_is_not_given_and_never_asks_for_force(given, mask):
    every = {"position", "velocity", "acceleration", "yaw", "yaw_rate"}
    assert type_mask(**{name: name in given for name in every}) == mask
    assert not mask & 0x200


def test_a_setpoint_is_the_bytes_that_the_mavlink_definition_gives():
    mav = mavlink.MAVLink(None, srcSystem=1, srcComponent=191)
    mav.seq = 7
    message = setpoint_message(reference(), np.array([10.0, 0.0, 0.5]), 123_456, target_system=1)
    packed = bytes(message.pack(mav))
    # Fields on the wire run from the widest type to the narrowest: uint32, 11 floats, uint16, three uint8.
    payload = struct.pack(
        "<I11fHBBB", 123_456, 11.0, 2.0, -2.5, 0.5, -0.25, 0.0, 0.125, 0.0, -1.0, 0.75, 0.0, 0x800, 1, 1, 1
    )
    header = struct.pack("<BBBBBBB", 0xFD, len(payload), 0, 0, 7, 1, 191) + (84).to_bytes(3, "little")
    crc = x25(header[1:] + payload + bytes([143]))  # 143: CRC_EXTRA of message 84
    assert packed == header + payload + struct.pack("<H", crc)


@pytest.mark.parametrize("field", ["position_m", "velocity_m", "acceleration_m"])
@pytest.mark.parametrize("bad", [np.nan, np.inf, -1e39])
def test_a_setpoint_that_is_not_finite_or_beyond_reason_is_never_made(field, bad):
    message = setpoint_message(reference(**{field: np.array([0.0, bad, 0.0])}), np.zeros(3), 0, 1)
    assert message is None
    assert setpoint_message(reference(yaw=bad), np.zeros(3), 0, 1) is None


def test_full_is_position_velocity_acceleration_and_yaw():
    assert FULL == 0x800


def x25(data: bytes) -> int:
    """CRC-16/MCRF4XX, bit by bit, as the MAVLink guide describes it."""
    crc = 0xFFFF
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = crc >> 1 ^ (0x8408 if crc & 1 else 0)
    return crc


STILL = np.zeros(3)


@pytest.mark.parametrize(
    ("reference", "found"),
    [
        (Reference(np.array([1.0, 2.0, -3.0]), np.array([3.0, 0.0, 0.0]), STILL, 0.0), ""),
        (Reference(np.array([np.nan, 2.0, -3.0]), STILL, STILL, 0.0), "not a place to fly to"),
        (Reference(np.array([1.0, 2.0, -3.0]), np.array([0.0, np.inf, 0.0]), STILL, 0.0), "not a place to fly to"),
        (Reference(np.array([1.0, 2.0, -3.0]), STILL, STILL, np.nan), "not a place to fly to"),
        (Reference(np.array([1.0, 2.0, -6.0]), STILL, STILL, 0.0), "outside the fence"),
        (Reference(np.array([1.0, 2.0, -3.0]), np.array([3.0, 3.0, 0.0]), STILL, 0.0), "faster than 3 m/s"),
        (
            Reference(np.array([1.0, 2.0, -3.0]), STILL, np.array([0.0, 0.0, 8.0]), 0.0),
            "an acceleration above 6 m/s^2",
        ),
    ],
)
def test_a_reference_that_must_not_be_sent_is_found_and_named(reference, found):
    assert flaw(reference, Geofence(ceiling=5.0), speed=3.0, acceleration=6.0) == found
