"""The fields of frequent messages, by the dialect's own struct, without a message object in between.

`mavlink.MAVLink.decode` costs about 6 us a message; these kinds come 50 times a second each and are read here at under
1 us. The order is the wire's (by size of type), which `tests/unit/test_companion_telemetry.py` holds against `decode`.
"""

from typing import Any

from wire.dialect import mavlink

_LOCAL_POSITION = mavlink.MAVLink_local_position_ned_message.unpacker
_ATTITUDE = mavlink.MAVLink_attitude_message.unpacker
_TRUTH = mavlink.MAVLink_hil_state_quaternion_message.unpacker


def local_position_ned(payload: bytes) -> tuple[float, float, float, float, float, float]:
    """x, y, z [m], vx, vy, vz [m/s] of a LOCAL_POSITION_NED."""
    _, x, y, z, vx, vy, vz = _unpacked(_LOCAL_POSITION, payload)
    return x, y, z, vx, vy, vz


def attitude(payload: bytes) -> tuple[float, float, float]:
    """Roll, pitch, yaw [rad] of an ATTITUDE."""
    _, roll, pitch, yaw = _unpacked(_ATTITUDE, payload)[:4]
    return roll, pitch, yaw


def boot_ms(payload: bytes) -> int:
    """The time since boot [ms] with which a LOCAL_POSITION_NED or an ATTITUDE begins."""
    return int.from_bytes(payload[:4], "little")


def truth_position(payload: bytes) -> tuple[int, int, int]:
    """Latitude and longitude [deg * 1e7], altitude [mm] of a HIL_STATE_QUATERNION."""
    lat, lon, alt = _unpacked(_TRUTH, payload)[8:11]
    return lat, lon, alt


def _unpacked(struct: Any, payload: bytes) -> Any:
    """MAVLink 2 cuts zeros off a payload's end: put them back; what a newer dialect appends is left off."""
    return struct.unpack(payload[: struct.size].ljust(struct.size, b"\0"))
