"""GIVEN a vehicle at another pace than ours, WHEN it flies by what it sees, THEN all that is seen has its time."""

from pathlib import Path

import numpy as np
import pytest

from companion.cli.vehicle import seen_world
from companion.phases import Phase
from tests.lockstep.test_pace_and_boot import Paced

MISSIONS = Path("missions")


class Told:
    """How old what is known of movers is, and how far off where they are held to be now, once a tenth of a second."""

    def __init__(self):
        self.companion = self.vehicle = None
        self.ages, self.errors, self.counts = [], [], []

    def watch(self, vehicle, rate):
        self.vehicle = Paced(vehicle, rate)
        return self.vehicle

    def operator(self, companion, now_us):
        self.companion = companion

    def __call__(self, tick):
        if self.companion is None or self.companion.phase is not Phase.FLYING or tick.now_us % 100_000:
            return
        flight_s, start = self.companion._flight_us / 1e6, np.array(self.companion.mission.start_m())
        balls = seen_world(self.companion.mission).movers.spheres(self.vehicle.own_us)[:, :3] + start
        movers = self.companion.seeing.tracks.movers()
        self.counts.append(len(movers))
        for mover, ball in zip(movers, balls, strict=len(movers) == len(balls)):
            age = flight_s - mover.stamp
            self.ages.append(age)
            where = np.array(mover.centre) + age * np.array(mover.velocity)
            self.errors.append(float(np.linalg.norm(where - ball)))


@pytest.mark.parametrize("rate", [0.8, 0.95, 1.25])
def test_what_moves_is_known_to_be_where_it_is_at_any_pace_and_the_goal_is_reached(fly, rate):
    told = Told()
    text = (MISSIONS / "movers.yaml").read_text()
    flight = fly(text, between=lambda v: told.watch(v, rate), operator=told.operator, taps=[told])
    assert flight.companion.phase is Phase.DONE
    assert not flight.companion.failure
    assert min(told.counts) == 8
    assert 0.0 <= min(told.ages) <= max(told.ages) < 0.5
    assert max(told.errors) < 0.3


@pytest.mark.parametrize("rate", [0.8, 1.25])
def test_a_wall_that_nobody_told_of_is_flown_around_at_any_pace(fly, rate):
    flight = fly((MISSIONS / "l_shape_unknown.yaml").read_text(), between=lambda v: Paced(v, rate))
    assert flight.verdict.ok, flight.verdict.failure or flight.verdict.failed_expectations
    assert flight.companion.clock.rate == pytest.approx(rate, rel=0.004)
