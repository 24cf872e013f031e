"""What is seen is planned for in processes of their own: setpoints leave evenly and soon, all of it on one core."""

from pathlib import Path

import numpy as np
import pytest

from benchmarks.bench_latency import Flown, fly, one_core
from missions import __file__ as missions

TRIES = 3
"""Whoever else uses the machine may hold up a flight or two: the quietest counts."""


@pytest.mark.soak
@pytest.mark.udp
@pytest.mark.parametrize("autopilot", ["px4", "ardupilot"])
def test_setpoints_leave_at_50_hz_and_within_10_ms_of_their_state_while_replanning_at_10_hz_on_the_vehicles_own_core(
    autopilot, tmp_path: Path
):
    data = Path(missions).with_name("l_shape_unknown.yaml").read_bytes()
    flights: list[Flown] = []
    with one_core():
        for k in range(TRIES):
            folder = tmp_path / str(k)
            folder.mkdir()
            flights.append(fly(data, autopilot, folder, first=True))
            if in_time(flights[-1]):
                break
    for flight in flights:
        assert flight.verdict.ok, flight.verdict.failure or flight.verdict.failed_expectations
        assert flight.replans > 60
        assert flight.worst_joint < 1e-6
    best = min(flights, key=lambda f: np.percentile(f.timing.gaps_ms, 99))
    assert 1e3 / best.timing.gaps_ms.mean() == pytest.approx(50.0, abs=0.7)  # it follows the vehicle's beat
    assert best.late <= 0.1 * best.replans
    told = [
        (np.percentile(f.timing.gaps_ms, [50, 99, 100]), {n: np.percentile(v, [50, 99, 100]) for n, v in latency(f)})
        for f in flights
    ]
    assert any(in_time(f) for f in flights), told


def latency(flight: Flown) -> list[tuple[str, list[float]]]:
    return list(flight.timing.latency_ms.items())


def in_time(flight: Flown) -> bool:
    gaps = flight.timing.gaps_ms
    evenly = np.percentile(gaps, 99) <= 25.0 and gaps.max() <= 100.0
    return evenly and all(np.percentile(values, 99) <= 10.0 for _, values in latency(flight))
