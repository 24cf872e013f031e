"""What the companion reads is what the dialect says, whatever MAVLink 2 cut off the end."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from companion import fields
from companion.autopilots.px4 import Px4
from companion.telemetry import Telemetry
from wire.dialect import mavlink
from wire.framing import Framer

floats = st.floats(width=32, allow_nan=False)
ints = st.integers(-(2**31), 2**31 - 1)
MAV = mavlink.MAVLink(None, srcSystem=1, srcComponent=1)


def packet(message):
    (found,) = Framer().packets(bytes(message.pack(MAV)))
    return found, MAV.decode(bytearray(found.raw))


@given(st.lists(floats, min_size=6, max_size=6))
def test_a_local_position_is_what_decode_reads(values):
    found, m = packet(mavlink.MAVLink_local_position_ned_message(7, *values))
    assert fields.local_position_ned(found.payload) == (m.x, m.y, m.z, m.vx, m.vy, m.vz)


@given(st.lists(floats, min_size=6, max_size=6))
def test_an_attitude_is_what_decode_reads(values):
    found, m = packet(mavlink.MAVLink_attitude_message(7, *values))
    assert fields.attitude(found.payload) == (m.roll, m.pitch, m.yaw)


@given(st.integers(0, 2**32 - 1))
def test_the_time_since_boot_is_what_decode_reads(boot_ms):
    for message in (
        mavlink.MAVLink_attitude_message(boot_ms, *[0] * 6),
        mavlink.MAVLink_local_position_ned_message(boot_ms, *[0] * 6),
    ):
        found, m = packet(message)
        assert fields.boot_ms(found.payload) == m.time_boot_ms


@given(ints, ints, ints)
def test_a_truth_is_what_decode_reads(lat, lon, alt):
    message = mavlink.MAVLink_hil_state_quaternion_message(
        2**40, [1.0, 0.5, 0.25, 0.125], 1, 2, 3, lat, lon, alt, 4, 5, 6, 7, 8, 9, 10, 11
    )
    found, m = packet(message)
    assert fields.truth_position(found.payload) == (m.lat, m.lon, m.alt) == (lat, lon, alt)


def take(telemetry, *messages):
    for message in messages:
        telemetry.take(1_000, packet(message)[0], MAV)


def test_a_statustext_in_chunks_is_put_together():
    telemetry = Telemetry()
    take(telemetry, mavlink.MAVLink_statustext_message(2, b"Arming denied: Resolve system health failures firs", 9, 0))
    assert not telemetry.texts
    take(telemetry, mavlink.MAVLink_statustext_message(2, b"t", 9, 1))
    assert telemetry.texts == [(2, "Arming denied: Resolve system health failures first")]


def test_a_position_that_is_not_finite_is_no_position():
    telemetry = Telemetry()
    take(telemetry, mavlink.MAVLink_local_position_ned_message(7, float("nan"), 0, 0, 0, 0, 0))
    assert telemetry.position_us is None
    np.testing.assert_array_equal(telemetry.position_n, 0)


@pytest.mark.parametrize(("value", "warns"), [(0, True), (3, True), (4, False), (5, False), (-1, True)])
def test_px4_is_warned_about_when_losing_the_stream_would_end_in_neither_hold_nor_land(value, warns):
    telemetry = Telemetry(parameters={"COM_OBL_RC_ACT": b""})
    bytewise = np.array(value, dtype="<i4").view("<f4").item()  # PX4 puts an INT32's bytes into the float
    take(telemetry, mavlink.MAVLink_param_value_message(b"COM_OBL_RC_ACT", bytewise, 6, 1, 0))
    assert bool(Px4().warnings(telemetry)) is warns


def test_a_parameter_nobody_asked_for_is_not_kept():
    telemetry = Telemetry()
    take(telemetry, mavlink.MAVLink_param_value_message(b"OTHER", 1.0, 9, 1, 0))
    assert not telemetry.parameters


def test_what_keeps_a_px4_from_flying_is_told_in_words_that_do_not_change_with_every_sample():
    telemetry, seen = Telemetry(), set()
    for ratio in (1.2, 14.4, 3.0):
        take(telemetry, mavlink.MAVLink_estimator_status_message(0, 0x3F, 0.1, ratio, 0.1, 0.1, 0, 0, 0, 0))
        take(telemetry, mavlink.MAVLink_extended_sys_state_message(0, mavlink.MAV_LANDED_STATE_IN_AIR))
        take(telemetry, mavlink.MAVLink_heartbeat_message(2, 12, 0x81, 0x3040000, 4, 3))
        seen.add(tuple(Px4().not_ready(1_000, telemetry)))
    (reasons,) = seen
    assert {"armed already", "not on the ground", "estimator rejects horizontal position"} <= set(reasons)


def heard_position(telemetry, boot_ms, x):
    take(telemetry, mavlink.MAVLink_local_position_ned_message(boot_ms, x, 0, 0, 0, 0, 0))


def test_a_position_that_comes_late_or_twice_is_not_taken():
    telemetry = Telemetry()
    for boot_ms, x in ((1000, 1.0), (1040, 2.0), (1020, 9.0), (1040, 9.0), (1060, 3.0), (800, 9.0)):
        heard_position(telemetry, boot_ms, x)
    assert telemetry.position_n[0] == 3.0
    assert telemetry.boots == 1


def test_a_time_since_boot_that_goes_back_three_times_in_a_row_is_another_boot_and_nothing_before_it_counts():
    telemetry = Telemetry()
    heard_position(telemetry, 60_000, 1.0)
    take(telemetry, mavlink.MAVLink_extended_sys_state_message(0, mavlink.MAV_LANDED_STATE_IN_AIR))
    heard_position(telemetry, 500, 2.0)  # one may have been on its way for long
    heard_position(telemetry, 60_020, 1.0)
    assert telemetry.boots == 1
    for boot_ms in (500, 520, 540, 560):
        heard_position(telemetry, boot_ms, 2.0)
    assert telemetry.boots == 2
    assert telemetry.position_n[0] == 2.0
    assert telemetry.landed_state == 0


def test_the_count_since_boot_may_wrap():
    telemetry = Telemetry()
    heard_position(telemetry, 2**32 - 10, 1.0)
    heard_position(telemetry, 10, 2.0)
    assert telemetry.position_n[0] == 2.0
    assert telemetry.boots == 1


def test_a_mode_is_sure_when_nothing_else_was_said_for_a_while():
    telemetry = Telemetry()

    def beat(now_us, mode, base=1):
        m = mavlink.MAVLink_heartbeat_message(2, 12, base, mode, 4, 3)
        telemetry.take(now_us, packet(m)[0], MAV)

    beat(0, 5)
    assert telemetry.mode_is_sure
    beat(1_000_000, 6)  # a second after the other: not an old one
    assert telemetry.mode_is_sure
    beat(1_200_000, 5)  # perhaps an old one
    assert not telemetry.mode_is_sure
    beat(2_000_000, 6, base=129)
    assert telemetry.mode_is_sure
    assert telemetry.arming_is_sure
    beat(2_100_000, 6, base=1)
    assert not telemetry.arming_is_sure
