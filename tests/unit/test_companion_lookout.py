"""What is flown as it was planned is held against what is seen: climbs stop, landings wait."""

import numpy as np
import pytest

from companion.itinerary import Itinerary
from companion.lookout import LONGEST_WAIT_US, Lookout
from companion.missionfile import parse_mission
from companion.seeing.sight import Sight

MISSION = """\
name: lookout
vehicle: {start: {north: 10, east: 10}}
world: {bounds: {north: [0, 20], east: [0, 20], altitude: [0, 8]}}
sensing: {clearance: 0.3}
steps: [{takeoff: {altitude: 4}}, land]
"""
TICK_US = 20_000


class Watched:
    """An itinerary that is walked while movers tell where they are."""

    def __init__(self, climbing):
        mission = parse_mission(MISSION.encode(), "lookout.yaml")
        self.itinerary, self.sight = Itinerary(mission, 1), Sight(mission)
        self.lookout = Lookout(mission, self.itinerary, self.sight)
        self.climbing, self.now_us, self.said = climbing, 0, []
        self.itinerary.begin(0) if climbing else self.itinerary.airborne(0)

    def run(self, seconds, place=None, velocity=(0.0, 0.0, 0.0)):
        """Walk on; a mover tells its place at the beginning, and goes on from there."""
        for k in range(round(seconds * 50)):
            if place is not None:
                now = tuple(p + v * k * 0.02 for p, v in zip(place, velocity, strict=True))
                self.sight.tracks.told(self.now_us, 1, now, velocity, 0.5)
            self.sight.tracks.forget(self.now_us)
            self.itinerary.advance(self.now_us)
            self.said += [note.text for note in self.lookout.step(self.now_us, self.climbing)]
            self.now_us += TICK_US
        return self.itinerary.reference(self.now_us).position_m


def test_a_climb_stops_below_what_crosses_it_and_goes_on_when_that_is_gone():
    watched = Watched(climbing=True)
    watched.run(2.0)  # half a metre high or so
    below = watched.run(1.5, (10.0, 10.0, -3.0))
    assert watched.run(2.0, (10.0, 10.0, -3.0)) == pytest.approx(below, abs=0.05)
    assert -below[2] < 3.0 - 0.5 - 0.35
    assert any("something crosses the climb" in text for text in watched.said)
    watched.run(2.0, (10.0, 12.0, -3.0), (0.0, 2.0, 0.0))
    assert watched.run(6.0) == pytest.approx((10.0, 10.0, -4.0))


def test_a_climb_goes_on_when_standing_there_would_be_hit_as_well():
    watched = Watched(climbing=True)
    here = watched.run(3.0)
    on = watched.run(1.0, (10.0, 12.0, here[2]), (0.0, -1.0, 0.0))
    assert here[2] - on[2] > 0.7


def test_a_landing_waits_while_something_is_about_to_cross_it_and_a_minute_at_most():
    watched = Watched(climbing=False)
    assert watched.itinerary.finished()
    assert watched.lookout.may_land(0)
    watched.sight.tracks.told(0, 1, (10.0, 13.0, -1.0), (0.0, -1.0, 0.0), 0.5)
    assert not watched.lookout.may_land(0)
    assert "the landing waits" in watched.lookout.step(0)[0].text
    watched.sight.tracks.told(0, 1, (10.0, 13.0, -1.0), (0.0, 1.0, 0.0), 0.5)
    assert watched.lookout.may_land(20_000)  # it goes away
    late_us = LONGEST_WAIT_US + 20_000
    watched.sight.tracks.told(late_us, 1, (10.0, 10.0, -1.0), (0.0, 0.0, 0.0), 0.5)
    assert watched.lookout.may_land(late_us)


def test_one_that_stands_is_sent_out_of_the_way_only_of_what_comes_near():
    for velocity, away in (((0.0, -1.5, 0.0), True), ((0.0, 0.0, 0.0), False)):
        watched = Watched(climbing=False)
        watched.run(0.1, (10.0, 13.5, -4.0), velocity)
        assert watched.itinerary.away is away
        if away:
            assert np.allclose(watched.itinerary.aim().goal_m, (10.0, 10.0, -4.0))
            assert not watched.itinerary.finished()
