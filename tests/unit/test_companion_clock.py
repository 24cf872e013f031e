"""The flight's clock runs at the vehicle's pace, never jumps, and is exactly ours where the vehicle is in step."""

import numpy as np
import pytest

from companion.drivers.realtime import tick_ns
from companion.vehicleclock import SLEW, VehicleClock

TICK = 20_000


def run(rate, seconds, jitter_ms=0.0, slowly=lambda now_us: False, stop=None, seed=1):
    """(our time, the clock's) of each tick; messages come late by up to `jitter_ms`."""
    clock, rng = VehicleClock(), np.random.default_rng(seed)
    on_the_way, rows = [], []
    for now_us in range(0, round(seconds * 1e6), TICK):
        if stop is None or not stop[0] <= now_us / 1e6 < stop[1]:
            on_the_way.append((now_us + round(1e3 * jitter_ms * rng.random()), int(now_us * rate) // 1000))
        for at, boot_ms in sorted(on_the_way):
            if at <= now_us:
                clock.heard(now_us, boot_ms)
        on_the_way = [(at, boot_ms) for at, boot_ms in on_the_way if at > now_us]
        rows.append((now_us, clock.at(now_us, slowly(now_us))))
    return clock, np.array(rows)


@pytest.mark.parametrize("rate", [0.5, 0.987, 1.02, 2.0, 4.0])
def test_the_rate_is_found(rate):
    assert run(rate, 12.0)[0].rate == pytest.approx(rate, abs=0.002 * rate)


@pytest.mark.parametrize("rate", [0.9999, 1.0, 1.0005])
def test_a_vehicle_in_step_has_exactly_our_time(rate):
    clock, rows = run(rate, 30.0)
    assert clock.rate == 1.0
    np.testing.assert_array_equal(rows[:, 0], rows[:, 1])


@pytest.mark.parametrize("rate", [0.987, 1.0, 2.0])
def test_what_the_link_delays_bends_it_little(rate):
    assert run(rate, 20.0, jitter_ms=200.0)[0].rate == pytest.approx(rate, abs=0.01)


def test_in_the_air_it_changes_its_rate_slowly_and_never_runs_backwards():
    _, rows = run(0.5, 12.0, slowly=lambda now_us: True)
    steps = np.diff(rows[:, 1])
    assert (steps > 0).all()
    assert np.abs(np.diff(steps)).max() <= SLEW * TICK * 1e-6 * TICK + 1.5


def test_a_silence_keeps_the_rate():
    clock, rows = run(2.0, 20.0, stop=(10.0, 16.0))
    assert clock.rate == pytest.approx(2.0, abs=0.01)
    assert np.diff(rows[-500:, 1]) == pytest.approx(2 * TICK, abs=400)


@pytest.mark.parametrize(
    ("rate", "tick_ms"), [(0.5, 20.0), (1.0, 20.0), (1.25, 16.0), (4.0, 5.0), (10.0, 2.0), (50.0, 2.0)]
)
def test_a_vehicle_faster_than_ours_gets_its_setpoints_at_50_hz_of_its_own_time(rate, tick_ms):
    assert tick_ns(20_000, rate) == tick_ms * 1e6
