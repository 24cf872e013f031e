"""What the live page costs the flight loop, and that a flight with it is the flight without it."""

import math
import time
from pathlib import Path

import pytest

from companion.drivers.recording import to_input
from companion.drivers.rerun import fresh_companion
from companion.drivers.tick import Tick
from companion.service.feed import COLUMNS, Feed, Seen
from companion.service.liveflight import LiveFlight
from companion.verdict import FlightMeter, judge
from logs.reader import Recording
from logs.table import ticks
from wire.datagram import Datagram


def watched(path: Path) -> tuple[Feed, float, float]:
    """The flight again with the live page's tap: its feed, what the tap cost [s], and how long the flight was [s]."""
    recording = Recording.open(path)
    companion, feed, cost_s = fresh_companion(recording), Feed(), 0.0
    meter = FlightMeter(companion)
    live = LiveFlight(feed, companion, meter)
    first_us = last_us = 0
    for entry in ticks(recording):
        inputs = [(s // 1000, i if isinstance(i, Datagram) else to_input(i)) for s, i in entry.inputs]
        tick = Tick(
            entry.index, entry.now_us, inputs, companion.step(entry.now_us, [i for _, i in inputs]), entry.now_us
        )
        meter(tick)
        began = time.perf_counter()
        live(tick)
        cost_s += time.perf_counter() - began
        first_us, last_us = first_us or entry.now_us, entry.now_us
    live.end(judge(companion, meter))
    return feed, cost_s, (last_us - first_us) / 1e6


def test_twenty_moments_a_second_are_put_up_with_path_plan_phases_and_verdict(recording):
    feed, _, flight_s = watched(recording)
    whole = feed.since(Seen())
    with feed._lock:
        rows = [row for _, row in feed._flight.rows]
    assert len(rows) / flight_s == pytest.approx(20, rel=0.1)
    assert {len(row) for row in rows} == {1 + len(COLUMNS)}
    assert whole["header"]["ok"] is True
    assert whole["header"]["phase"] == "done"
    assert [check["name"] for check in whole["header"]["checks"]][:2] == ["phase", "tracking_error_p95_m"]
    assert all(check["ok"] for check in whole["header"]["checks"])
    north_east = [row[1:3] for row in rows if row[1] == row[1]]
    assert math.dist(north_east[0], (1.0, 10.0)) < 0.2  # the path begins where the mission does, not at the origin
    assert len(whole["scene"]["plans"]) == 1
    assert len(whole["scene"]["obstacles"]) == 2
    phases = [event["text"].partition(" (")[0] for event in whole["events"] if event["kind"] == "phase"]
    assert phases[0] == "connecting -> preparing"
    assert phases[-1] == "landing -> done"
    goal = next(row for row in rows if row[0] > 18.5)
    assert goal[3] == pytest.approx(1.5, abs=0.3)  # up, where the last goal is held


@pytest.mark.soak
def test_the_tap_costs_the_flight_loop_less_than_two_milliseconds_a_second(recording):
    costs = []
    for _ in range(5):
        _, cost_s, flight_s = watched(recording)
        costs.append(1e3 * cost_s / flight_s)
    assert min(costs) < 2.0, costs
