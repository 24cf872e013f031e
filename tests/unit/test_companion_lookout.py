"""What is flown as it was planned is held against what is seen: climbs stop, landings wait."""

import numpy as np
import pytest

from companion.errors import MissionError
from companion.itinerary import Itinerary
from companion.lookout import LONGEST_WAIT_US, Lookout
from companion.missionfile import parse_mission
from companion.seeing.sight import Sight
from planner import plan

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


def test_a_step_after_a_climb_that_stopped_on_the_way_begins_at_once():
    watched = Watched(climbing=True)
    mission = parse_mission(
        MISSION.replace("land]", "hold: {seconds: 2}}, land]").replace("4}}, h", "4}}, {h").encode(), ""
    )
    watched.itinerary = Itinerary(mission, 1)
    watched.lookout = Lookout(mission, watched.itinerary, watched.sight)
    watched.itinerary.begin(0)
    watched.run(2.0)
    watched.run(3.0, (10.0, 10.0, -3.0))
    watched.run(6.0)
    watched.climbing = False
    watched.itinerary.airborne(watched.now_us)
    watched.run(1.9)
    assert not watched.itinerary.finished()
    watched.run(0.2)
    assert watched.itinerary.finished()


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


WAITS = MISSION.replace(
    "{takeoff: {altitude: 4}}, land", "{takeoff: {altitude: 4}}, WAIT, {goto: {north: 18, east: 10, altitude: 4}}, land"
)


def waiting(wait):
    watched = Watched(climbing=False)
    mission = parse_mission(WAITS.replace("WAIT", f"{{wait: {wait}}}").encode(), "waits.yaml")
    watched.itinerary = Itinerary(mission, 1)
    for wanted in watched.itinerary.wanted():
        made = plan(mission.planner_world(), wanted.start_m, wanted.goal_m, wanted.limits, wanted.radius)
        watched.itinerary.take(wanted.request_id, made.trajectory)
    watched.lookout = Lookout(mission, watched.itinerary, watched.sight)
    watched.itinerary.airborne(0)
    return watched


def test_a_wait_for_movers_ends_as_soon_as_nothing_crosses_the_first_of_the_next_way():
    watched = waiting("{for: movers clear}")
    watched.run(0.8, (14.0, 8.0, -4.0), (0.0, 1.0, 0.0))  # across the way, far from the vehicle
    assert watched.itinerary.step.wait is not None
    watched.run(0.3, (14.0, 13.0, -4.0), (0.0, 1.0, 0.0))  # it has crossed
    assert watched.itinerary.step.goto is not None


def test_a_wait_for_movers_keeps_the_radius_that_it_says_and_lasts_no_longer_than_at_most():
    beside = ((14.0, 13.0, -4.0), (0.0, 0.0, 0.0))
    watched = waiting("{for: movers clear, radius: 3, at_most: 4}")
    watched.run(3.5, *beside)
    assert watched.itinerary.step.wait is not None
    watched.run(1.0, *beside)
    assert watched.itinerary.step.goto is not None
    watched = waiting("{for: movers clear, radius: 2}")
    watched.run(0.3, *beside)
    assert watched.itinerary.step.goto is not None


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("WAIT", "{wait: {for: order, radius: 2}}", "expected radius with movers clear only"),
        ("sensing: {clearance: 0.3}\n", "", "found a wait for movers clear, expected the key sensing"),
    ],
)
def test_a_wait_for_movers_that_cannot_be_is_refused_in_the_file(old, new, words):
    text = WAITS.replace(old, new).replace("WAIT", "{wait: {for: movers clear}}")
    with pytest.raises(MissionError) as caught:
        parse_mission(text.encode(), "waits.yaml")
    assert any(words in problem for problem in caught.value.problems)
