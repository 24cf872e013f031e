"""Planning in flight: when it is asked, what is flown, and what the desk answers."""

from dataclasses import replace

import numpy as np
import pytest

from companion.drivers.desk import ReplanDesk, with_cells
from companion.drivers.recording import to_input, to_record
from companion.hooks import Pose
from companion.missionfile import parse_mission
from companion.motion import JOINT, end_us, joint, state_at
from companion.replanning import LATE, LONGEST_US, PERIOD_US, Replanning
from companion.seam import Flown, MapView, PlanWanted
from companion.seeing.sensing import Scan
from companion.seeing.sight import Sight
from planner import Limits, MovingSphere, VoxelGrid, World, plan

MISSION = """\
name: replanning
vehicle:
  start: {north: 1, east: 10}
world:
  bounds: {north: [0, 30], east: [0, 20], altitude: [0, 5]}
steps: [{takeoff: {altitude: 2}}, {goto: {north: 28, east: 10, altitude: 2}}, land]
sensing: {clearance: 0.3}
"""
LIMITS = Limits(3.0, 6.0, 60.0)
START, GOAL = (1.0, 10.0, -2.0), (28.0, 10.0, -2.0)
BEGIN_US, TICK_US = 1_700_000_000_000_000, 20_000


class Leg:
    """One leg, flown as whoever replans says."""

    def __init__(self, trajectory):
        self.what = Flown(trajectory, BEGIN_US)
        self.aimed = PlanWanted(1, START, GOAL, LIMITS, 0.65, 1, "haoaroa")
        self.joints = []

    def flown(self, now_us):
        return None if self.what.to_goal and now_us >= end_us(self.what) else self.what

    def aim(self):
        return self.aimed

    def leave_out_place(self):
        return False

    def follow(self, now_us, flown):
        if flown is not self.what:
            self.joints.append(joint(self.what, flown))
        self.what = flown


class Flight:
    """A leg, what is seen, and a desk that answers after so many ticks; None: never."""

    def __init__(self, late_ticks=1):
        mission = parse_mission(MISSION.encode(), "replanning.yaml")
        self.sight = Sight(mission)
        world = mission.planner_world()
        self.leg = Leg(plan(world, START, GOAL, LIMITS, 0.65).trajectory)
        self.replanning = Replanning(mission, self.leg, self.sight, 1)
        self.desks = {False: ReplanDesk(world), True: ReplanDesk(world)}
        self.late_ticks, self.waiting, self.asked, self.said = late_ticks, [], [], []
        self.now_us = BEGIN_US

    def run(self, seconds, walls=lambda t: ()):
        """Fly on; walls: (m, 3) points that are seen now."""
        for _ in range(round(seconds * 50)):
            t = (self.now_us - BEGIN_US) / 1e6
            place = state_at(self.leg.what, self.now_us).position
            points = np.array(walls(t), dtype=float).reshape(-1, 3)
            if len(points) and self.now_us % 100_000 == 0:
                away = points - place
                far = np.linalg.norm(away, axis=1)
                self.sight.map.add(self.now_us, Scan(0, place, away / far[:, None], far, 25.0))
            self.sight.tracks.forget(self.now_us)
            due = [ready for at_us, ready in self.waiting if at_us <= self.now_us]
            self.waiting = [w for w in self.waiting if w[0] > self.now_us]
            for ready in due:
                self.replanning.take(ready, self.now_us)
            at = state_at(self.leg.what, self.now_us)
            pose = Pose(self.now_us, at.position + self.offset, at.velocity, 0.0, 0.0, 0.0)
            for wanted in self.replanning.step(self.now_us, pose):
                self.asked.append(wanted)
                if self.late_ticks is not None:
                    ready = self.desks[wanted.cold].answer(wanted)
                    self.waiting.append((self.now_us + self.late_ticks * TICK_US, ready))
            self.said += [note.text for note in self.replanning.take_said()]
            self.now_us += TICK_US

    offset = (0.0, 0.0, 0.0)

    def place(self):
        return state_at(self.leg.what, self.now_us).position


def wall(x, low, high):
    """Points on a wall across the way."""
    y = np.arange(low, high, 0.1)
    return np.column_stack((np.full(len(y), x + 0.05), y + 0.05, np.full(len(y), -2.0)))


def test_it_asks_ten_times_a_second_a_period_ahead_of_the_switch_and_names_what_is_flown():
    flight = Flight()
    flight.run(2.0)
    warm = [w for w in flight.asked if not w.cold]
    assert np.diff([w.now_us for w in warm]).tolist() == [PERIOD_US] * 19
    assert all(w.switch_us - w.now_us == PERIOD_US for w in warm)
    assert [w.fresh for w in warm] == [True] + [False] * 19
    assert warm[0].map is not None
    assert all(w.map is None for w in warm[1:])  # nothing new was seen


def test_a_wall_across_the_way_is_flown_around_and_no_switch_jumps():
    flight = Flight()
    flight.run(15.0, lambda t: wall(12.0, 7.0, 12.0) if t > 0.5 else ())
    assert flight.place() == pytest.approx(GOAL, abs=1e-6)
    assert flight.replanning.switches >= 1
    assert max(flight.leg.joints) <= JOINT
    assert flight.replanning.late == 0


def test_where_no_answer_comes_it_flies_on_only_as_long_as_a_stop_after_it_is_clear():
    flight = Flight()
    flight.run(1.0)
    flight.late_ticks = None
    flight.run(8.0, lambda t: wall(12.0, 0.0, 20.0))
    assert flight.place()[0] < 12.0 - 0.35
    assert not flight.leg.what.to_goal
    assert flight.replanning.stops == 1
    assert max(flight.leg.joints) <= JOINT
    assert any("stopping: no answer in time" in text for text in flight.said)


def test_answers_that_come_too_late_are_counted_and_dropped_and_the_period_grows():
    flight = Flight(late_ticks=8)  # 160 ms
    flight.run(3.0)
    assert flight.replanning.late >= LATE
    assert any("asked every 200 ms now" in text for text in flight.said)
    before = flight.replanning.late
    flight.run(2.0)
    assert flight.replanning.late <= before + 1  # 160 ms are in time now
    assert flight.asked[-1].period_us == 2 * PERIOD_US <= LONGEST_US


def test_a_wall_that_comes_up_between_question_and_answer_is_seen_by_the_guard():
    flight = Flight()
    flight.run(3.0)
    place = flight.place()
    assert state_at(flight.leg.what, flight.now_us).velocity[0] > 2.5
    flight.run(3.0, lambda t: wall(place[0] + 1.8, 5.0, 15.0))
    assert flight.place()[0] < place[0] + 1.8 - 0.35
    assert max(flight.leg.joints) <= JOINT


def test_at_a_stop_a_plan_from_scratch_is_asked_for_from_where_it_ends_and_flown_without_a_jump():
    flight = Flight()
    flight.run(20.0, lambda t: wall(10.0, 3.0, 17.0) if t > 0.5 else ())
    cold = [w for w in flight.asked if w.cold]
    assert cold
    assert all(w.switch_us == end_us(w.flown) and not w.flown.to_goal for w in cold)
    assert flight.replanning.scratch >= 1
    assert flight.place() == pytest.approx(GOAL, abs=1e-6)
    assert max(flight.leg.joints) <= JOINT


def test_a_goal_walled_off_ends_at_a_stop_with_the_trouble_told():
    flight = Flight()
    flight.run(7.0, lambda t: wall(12.0, 0.0, 20.0))
    assert flight.place()[0] < 12.0
    assert flight.replanning.trouble
    assert not flight.leg.what.to_goal


def test_a_vehicle_that_is_blown_off_its_way_is_planned_for_anew_from_where_it_is():
    flight = Flight()
    flight.run(3.0)
    flight.offset = (0.0, 0.8, 0.0)
    flight.run(0.28)
    assert flight.replanning.drifts == 0
    flight.run(0.06)
    assert flight.replanning.drifts == 1
    assert flight.place()[1] == pytest.approx(10.8, abs=0.1)
    flight.offset = (0.0, 0.0, 0.0)
    flight.run(15.0)
    assert flight.place() == pytest.approx(GOAL, abs=1e-6)


def test_when_the_estimator_moves_its_origin_the_flight_begins_anew_at_once():
    flight = Flight()
    flight.run(3.0)
    flight.sight.jumped = True
    flight.run(0.02)
    assert flight.replanning.drifts == 1
    flight.run(15.0)
    assert flight.place() == pytest.approx(GOAL, abs=1e-6)


def test_the_same_inputs_give_the_same_questions():
    def asked():
        flight = Flight()
        flight.run(6.0, lambda t: wall(12.0, 7.0, 12.0) if t > 0.5 else ())
        return [to_record(w, "flying") for w in flight.asked]

    assert asked() == asked()


def test_questions_and_answers_survive_the_recording():
    flight = Flight()
    flight.run(1.0, lambda t: wall(12.0, 7.0, 12.0))
    wanted = flight.asked[-1]
    ready = flight.desks[False].answer(wanted)
    back = to_input(to_record(ready, "flying"))
    assert back.reason == ready.reason
    assert back.backup == ready.backup
    assert back.flown == ready.flown


# ---- the desk ----------------------------------------------------------------------------------------------------

WORLD = World(((0.0, 0.0, -5.0), (30.0, 20.0, 0.0)))


def view(*runs):
    return MapView((0.0, 0.0, 0.0), 0.1, np.array(runs, dtype=np.int16).reshape(-1, 4), 1)


def test_the_desks_world_has_the_cells_that_are_near_and_no_others():
    seen = view((100, 100, -50, 0), (105, 100, -50, 0), (290, 100, -50, 0))
    world = with_cells(WORLD, seen, np.array([9.0, 10.0, -2.0]), 9.0)
    points = np.array([[10.05, 10.05, -2.0], [10.55, 10.05, -2.0], [10.3, 10.05, -2.0], [29.05, 10.05, -2.0]])
    distance = world.distance(points)
    assert (distance[:2] <= 0.0).all()
    assert distance[2] == pytest.approx(0.2, abs=1e-6)
    assert distance[3] > 1.0


def test_cells_beside_a_known_voxel_map_are_put_on_its_lattice():
    known = World(WORLD.bounds, [VoxelGrid(np.ones((2, 2, 2), dtype=bool), (3.07, 3.0, -2.0), 0.25)])
    world = with_cells(known, view((100, 100, -30, -10)), np.array([9.0, 10.0, -2.0]), 9.0)
    assert world.distance(np.array([[10.05, 10.05, -2.0], [3.3, 3.2, -1.8]])).max() <= 0.0


def test_movers_are_missed_on_a_clock_far_from_zero():
    flight = Flight()
    crossing = MovingSphere((7.0, 6.0, -2.0), (0.0, 2.0, 0.0), 0.5, 0.0, BEGIN_US / 1e6)
    flight.sight.tracks.told(BEGIN_US, 1, crossing.centre, crossing.velocity, 0.5)
    gap = np.inf
    for _ in range(300):
        flight.run(0.02)
        t = (flight.now_us - BEGIN_US) / 1e6
        flight.sight.tracks.told(flight.now_us, 1, (7.0, 6.0 + 2.0 * t, -2.0), crossing.velocity, 0.5)
        gap = min(gap, float(np.linalg.norm(flight.place() - (7.0, 6.0 + 2.0 * t, -2.0))))
    assert gap > 0.5 + 0.35


def test_a_plan_from_scratch_steps_out_of_the_radius_first():
    flight = Flight()
    rest = Flown(plan(WORLD, (5.0, 10.0, -2.0), (6.0, 10.0, -2.0), LIMITS, 0.3).trajectory, BEGIN_US, to_goal=False)
    flight.run(0.02)
    near = view(*((64, 96 + k, -50, 0) for k in range(8)))  # 0.4 m ahead of where it rests
    wanted = replace(flight.asked[0], flown=rest, switch_us=end_us(rest), cold=True, map=near, radius=0.65)
    ready = ReplanDesk(WORLD).answer(wanted)
    assert ready.kind == "backup"
    assert not ready.flown.to_goal
    end = ready.flown.trajectory.position(ready.flown.trajectory.duration)
    assert with_cells(WORLD, near, end, 9.0).distance(end[None])[0] >= 0.65


@pytest.mark.parametrize(
    ("place", "velocity", "crosses"),
    [
        ((6.0, 10.0, -1.0), (-1.5, 0.0, 0.0), True),  # straight at it
        ((6.0, 10.0, -1.0), (1.5, 0.0, 0.0), False),  # away
        ((6.0, 10.0, -4.5), (-1.5, 0.0, 0.0), False),  # far above
        ((0.6, 13.0, -1.0), (-0.5, -1.5, 0.0), True),  # back from the wall of the bounds
        ((6.0, 10.0, -1.0), (-0.2, 0.0, 0.0), False),  # not soon
    ],
)
def test_it_waits_on_the_ground_while_something_crosses_the_climb(place, velocity, crosses):
    flight = Flight()
    flight.sight.tracks.told(BEGIN_US, 1, place, velocity, 0.5)
    assert bool(flight.replanning.in_the_way(BEGIN_US)) is crosses


def test_where_the_goal_is_too_near_to_something_no_answer_leads_to_a_goal():
    flight = Flight()
    flight.run(0.02)
    rest = Flown(plan(WORLD, (5.0, 10.0, -2.0), (6.0, 10.0, -2.0), LIMITS, 0.3).trajectory, BEGIN_US, to_goal=False)
    covered = view(*((100 + i, 100, -50, 0) for i in range(3)))
    wanted = replace(flight.asked[0], flown=rest, goal_m=(10.0, 10.0, -2.0), map=covered, fresh=True)
    desk = ReplanDesk(WORLD)
    for _ in range(3):
        ready = desk.answer(wanted)
        assert ready.flown is None or not ready.flown.to_goal
        wanted = replace(wanted, fresh=False, map=None, now_us=wanted.switch_us, switch_us=wanted.switch_us + PERIOD_US)


def test_a_vehicle_at_rest_is_looked_ahead_for_however_long_it_has_been_resting():
    flight = Flight()
    flight.run(0.02)
    rest = Flown(plan(WORLD, (5.0, 10.0, -2.0), (6.0, 10.0, -2.0), LIMITS, 0.3).trajectory, BEGIN_US, to_goal=False)
    for later_us in (0, 10_000_000):
        now_us = end_us(rest) + later_us
        flight.sight.tracks.told(now_us, 1, (6.0, 11.8, -2.0), (0.0, -1.5, 0.0), 0.5)
        assert 0.2 < flight.replanning._ways.clear(rest, now_us) < 0.7
