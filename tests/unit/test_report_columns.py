"""Columns of a report: payloads read as they were packed, and no extreme lost where columns are made short."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from logs.report.columns import MOST_POINTS, Stream, payload_type, short, with_gaps
from logs.report.part import histogram
from logs.report.scene import curve_of
from wire.dialect import mavlink


@pytest.mark.parametrize("number", [0, 1, 22, 30, 32, 33, 36, 76, 77, 108, 111, 115, 230, 253, 331, 375])
def test_payloads_read_as_columns_are_what_the_dialect_decodes(number):
    kind = mavlink.mavlink_map[number]
    size = payload_type(number).itemsize
    payload = np.random.default_rng(number).integers(1, 120, size, dtype=np.uint8).tobytes()
    stream = Stream(number)
    stream.add(5, 7, payload)
    row = stream.rows()[0]
    encoder = mavlink.MAVLink(None)
    whole = bytearray(b"\xfd" + bytes((size, 0, 0, 0, 1, 1)) + number.to_bytes(3, "little") + payload)
    whole += encoder_crc(whole, kind.crc_extra)
    message = encoder.decode(whole)
    for name in message.get_fieldnames():
        told, found = getattr(message, name), row["m"][name]
        if isinstance(told, str):
            assert found.decode() == told
        else:
            np.testing.assert_allclose(np.atleast_1d(found), np.atleast_1d(told), rtol=1e-6)
    assert (row["t"], row["tick"]) == (5, 7)


def encoder_crc(packet: bytearray, extra: int) -> bytes:
    """The checksum of a MAVLink 2 packet without one."""
    crc = mavlink.x25crc(packet[1:])
    crc.accumulate(bytes((extra,)))
    return int(crc.crc).to_bytes(2, "little")


def test_a_payload_cut_short_has_zeros_at_its_end():
    stream = Stream(30)
    stream.add(1, 0, b"\x01")
    assert stream.rows()["m"]["time_boot_ms"] == [1]
    assert stream.rows()["m"]["yaw"] == [0.0]


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(1, 4), st.integers(200, 5000))
def test_no_spike_is_lost_where_columns_are_made_short(seed, columns, n):
    rng = np.random.default_rng(seed)
    values = [rng.normal(size=n) for _ in range(columns)]
    for column in values:
        column[rng.integers(n)] = 100.0
        column[rng.integers(n)] = -100.0
    t = np.arange(n, dtype=float)
    shorter, *found = short(t, *values, most=120)
    assert len(shorter) <= min(n, 400)
    assert np.all(np.diff(shorter) > 0)
    assert (shorter[0], shorter[-1]) == (0, n - 1)
    for column, before in zip(found, values, strict=True):
        assert (column.min(), column.max()) == (before.min(), before.max())
        np.testing.assert_array_equal(column, before[shorter.astype(int)])


def test_ten_minutes_at_fifty_a_second_are_kept_whole_and_ten_hours_are_not():
    t = np.arange(30_000) / 50.0
    assert len(short(t, np.sin(t))[0]) == 30_000
    t = np.arange(1_800_000) / 50.0
    assert len(short(t, np.sin(t))[0]) <= MOST_POINTS + 2


def test_a_stream_beyond_its_bound_keeps_its_extremes(monkeypatch):
    monkeypatch.setattr("logs.report.columns.MOST_ROWS", 2000)
    stream = Stream(36)
    for k in range(9000):
        pulse = 1999 if k == 777 else 1001 if k == 4321 else 1500 + k % 7
        stream.add(k, k, k.to_bytes(4, "little") + pulse.to_bytes(2, "little"))
    rows = stream.rows()
    assert len(rows) <= 2000
    assert stream.thinned
    assert (rows["m"]["servo1_raw"].min(), rows["m"]["servo1_raw"].max()) == (1001, 1999)
    assert np.all(np.diff(rows["t"]) > 0)


def test_no_line_is_drawn_across_a_pause():
    t = np.array([0.0, 1.0, 2.0, 30.0, 31.0])
    times, (values,) = with_gaps(t, [t], 5.0)
    assert times.tolist() == [0.0, 1.0, 2.0, 16.0, 30.0, 31.0]
    assert math.isnan(values[3])
    assert np.isfinite(np.delete(values, 3)).all()


def test_a_histogram_counts_everything_however_far_the_tail_reaches():
    values = np.concatenate([np.random.default_rng(1).normal(20.0, 0.1, 5000), [900.0, np.nan]])
    shown = histogram("h", "setpoints", "spacing", "ms", values)
    assert shown is not None
    assert sum(shown.counts) == 5001
    assert max(shown.edges) < 30.0
    assert "900" in shown.note


def test_values_that_are_all_the_same_make_one_bar():
    shown = histogram("h", "setpoints", "spacing", "ms", np.full(100, 20.0) + 1e-13 * np.arange(100))
    assert shown is not None
    assert sorted(shown.counts)[-2:] == [0, 100]


def test_a_plan_is_drawn_from_where_it_begins_to_where_it_ends_and_one_that_is_none_is_not_drawn():
    points = [[0.0, 0, 0]] * 3 + [[5.0, 1, -1]] + [[9.0, 3, -2]] * 3
    knots = [0.0, 0, 0, 0, 1, 2, 3, 4, 4, 4, 4]
    curve = curve_of([x for p in points for x in p], knots, 20)
    assert curve is not None
    np.testing.assert_allclose(curve[[0, -1]], [[0, 0, 0], [9, 3, 2]], atol=1e-12)
    assert curve_of([0.0] * 20, knots, 20) is None
    assert curve_of([math.nan] * 21, knots, 20) is None
    assert curve_of([], [], 20) is None
