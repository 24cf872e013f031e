"""When a driver's ticks are due: evenly, and soon after the vehicle's positions."""

import numpy as np
import pytest

from companion.drivers.beat import LEAD_NS, Beat, tells_position
from wire.dialect import mavlink

PERIOD, MS = 20_000_000, 1_000_000


def deadlines(phase_ms: float, every_ms: float = 20.0, jitter_ms: float = 0.0, ticks: int = 400) -> tuple:
    """Deadlines of a beat that hears positions, and how old the newest was at each [ms]."""
    rng = np.random.default_rng(1)
    beat, due, ages, k = Beat(0, PERIOD), [], [], 0
    arrivals = [(phase_ms + every_ms * i + rng.uniform(-jitter_ms, jitter_ms)) * MS for i in range(3 * ticks)]
    for _ in range(ticks):
        due.append(beat.deadline_ns)
        while arrivals[k] <= beat.deadline_ns:
            beat.heard(round(arrivals[k]))
            k += 1
        ages.append((beat.deadline_ns - arrivals[k - 1]) / MS if k else np.nan)
        beat.next(beat.deadline_ns + MS, PERIOD)
    return np.array(due), np.array(ages)


@pytest.mark.parametrize("phase_ms", [0.0, 3.0, 8.0, 13.0, 16.6, 19.9])
def test_ticks_settle_soon_after_the_positions_whatever_moment_they_come_at(phase_ms):
    due, ages = deadlines(phase_ms)
    assert ages[100:] == pytest.approx(LEAD_NS / MS, abs=0.2)
    assert np.abs(np.diff(due) / MS - 20.0).max() <= 0.25  # and never leave unevenly for it


def test_a_sender_that_wavers_by_two_milliseconds_is_heard_in_time_each_time():
    due, ages = deadlines(12.0, jitter_ms=2.0)
    assert ages[150:].min() > 0.5
    assert ages[150:].max() < 6.5
    assert np.abs(np.diff(due)[150:] / MS - 20.0).max() < 0.25


@pytest.mark.parametrize("every_ms", [19.9, 20.1])
def test_a_sender_whose_clock_runs_otherwise_is_followed(every_ms):
    _, ages = deadlines(5.0, every_ms)
    assert ages[150:].min() > 1.0
    assert ages[150:].max() < 7.0


@pytest.mark.parametrize("every_ms", [10.0, 40.0, 100.0, 200.0])
def test_positions_at_a_multiple_of_the_rate_or_a_part_of_it_are_taken_as_soon(every_ms):
    _, ages = deadlines(7.0, every_ms, ticks=3000)
    assert np.nanmin(ages[2500:]) == pytest.approx(LEAD_NS / MS, abs=0.3)


def test_without_positions_ticks_are_a_period_apart():
    due, _ = deadlines(1e9)
    assert (np.diff(due) == PERIOD).all()


def test_missed_periods_stay_missed_and_what_follows_is_even():
    beat = Beat(0, PERIOD)
    beat.next(beat.deadline_ns + 3 * PERIOD + MS, PERIOD)
    assert (beat.deadline_ns, beat.missed) == (4 * PERIOD, 2)
    beat.next(beat.deadline_ns + MS, PERIOD)
    assert (beat.deadline_ns, beat.missed) == (5 * PERIOD, 2)


def pack(message, version: bytes = b"2", key: bytes | None = None) -> bytes:
    mav = mavlink.MAVLink(None, 1, 1)
    if key:
        mav.signing.secret_key, mav.signing.sign_outgoing = key, True
    return bytes(message.pack(mav, force_mavlink1=version == b"1"))


def test_a_position_is_found_in_a_datagram_of_several_packets_of_either_version_signed_or_not():
    position = mavlink.MAVLink_local_position_ned_message(1, 1.0, 2.0, 3.0, 0.0, 0.0, 0.0)
    attitude = mavlink.MAVLink_attitude_message(1, 0.1, 0.2, 0.3, 0.0, 0.0, 0.0)
    high = mavlink.MAVLink_storage_information_message(1, 1, 1, 1, 1.0, 1.0, 1.0, 1.0, 1.0)  # id 261 = 0x105
    for data in (
        pack(position),
        pack(position, b"1"),
        pack(attitude) + pack(position),
        pack(attitude, b"1") + pack(position, b"1"),
        pack(attitude, key=bytes(32)) + pack(position, key=bytes(32)),
        pack(high) + pack(position),
    ):
        assert tells_position(data)
    for data in (pack(attitude), pack(high), pack(attitude, b"1"), b"", b"\xfd", b"\x20" * 40, pack(attitude)[:9]):
        assert not tells_position(data)


def test_no_bytes_make_it_raise_or_run_on():
    rng = np.random.default_rng(2)
    for _ in range(2000):
        data = bytearray(rng.integers(0, 256, rng.integers(0, 80), dtype=np.uint8))
        if data:
            data[0] = (0xFD, 0xFE)[int(rng.integers(2))]
        assert tells_position(bytes(data)) in (True, False)
