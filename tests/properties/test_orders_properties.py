"""Any orders at any time: what is asked of the vehicle never jumps, comes too near to anything or leaves the fence."""

import numpy as np
import pytest

from companion.drivers.planning import answer
from companion.itinerary import Itinerary
from companion.missionfile import parse_mission
from companion.seam import Order, PlanWanted

MISSION = """\
name: any orders
vehicle: {start: {north: 3, east: 3}, radius: 0.3}
world:
  bounds: {north: [0, 30], east: [0, 30], altitude: [0, 8]}
  obstacles:
    - box: {north: [8, 9], east: [0, 12], altitude: [0, 8]}
    - cylinder: {north: 16, east: 8, radius: 1, altitude: [0, 8]}
    - sphere: {north: 20, east: 20, altitude: 3, radius: 2}
fence:
  include: [{corners: [{north: -5, east: -5}, {north: 28, east: -5}, {north: 28, east: 28}, {north: -5, east: 28}]}]
  exclude: [{circle: {north: 5, east: 22, radius: 3}}]
steps:
  - takeoff: {altitude: 2}
  - goto: {north: 14, east: 4, altitude: 2}
  - via: [{north: 20, east: 3, altitude: 3}]
  - goto: {north: 24, east: 10, altitude: 3}
    speed: 2
  - orbit: {north: 22, east: 13, altitude: 3, radius: 2, turns: 1.5}
  - yaw: {heading_deg: -90}
  - wait: {for: order, at_most: 4}
  - return: {altitude: 4}
"""
BEGINNINGS = range(1, 8)  # of steps that one may be sent to
TICK_US = 20_000
LATENCY_TICKS = 7


@pytest.mark.parametrize("seed", range(12))
def test_any_orders_at_any_time_leave_the_reference_smooth_clear_and_inside(seed):
    dice = np.random.default_rng(seed)
    mission = parse_mission(MISSION.encode(), "orders.yaml")
    world, radius, fence = mission.planner_world(), mission.planner_radius(), mission.geofence()
    steps = Itinerary(mission, seed)
    assert steps.obstruction() == ""
    for wanted in steps.wanted():
        steps.take(wanted.request_id, answer(world, wanted).trajectory)
    steps.begin(0)
    asked, rows, times, carried_out = [], [], [], set()
    for tick in range(6000):
        now_us = tick * TICK_US
        if dice.random() < 1 / 150:
            name = str(dice.choice(["hold", "resume", "resume", "skip", "goto", "return" if tick > 4000 else "resume"]))
            values = tuple(dice.uniform((1, 1, 1), (29, 29, 7)).tolist()) if name == "goto" else ()
            if name == "skip":
                values = (float(dice.choice(BEGINNINGS)),)
            if steps.index > 0 and steps.order(now_us, Order(name, values)) == "":
                carried_out.add(name)
        steps.advance(now_us)
        asked += [(tick, item) for item in steps.take_said() if isinstance(item, PlanWanted)]
        while asked and asked[0][0] + LATENCY_TICKS <= tick:
            steps.answer(now_us, answer(world, asked.pop(0)[1]))
        if steps.finished():
            break
        reference = steps.reference(now_us)
        rows.append((reference.position_m, reference.velocity_m, reference.acceleration_m))
        times.append(now_us)
    position, velocity, acceleration = (np.array([row[k] for row in rows]) for k in range(3))
    assert carried_out & {"hold", "goto", "skip"}
    dt, limits = TICK_US / 1e6, mission.limits
    moved = np.diff(position, axis=0) - dt / 2 * (velocity[1:] + velocity[:-1])
    assert np.abs(moved).max() < 5e-4
    assert np.linalg.norm(velocity, axis=1).max() <= limits.speed * (1 + 1e-9)
    assert np.linalg.norm(acceleration, axis=1).max() <= limits.acceleration * 1.06
    assert np.linalg.norm(np.diff(acceleration, axis=0), axis=1).max() <= 1.6 * limits.jerk * dt
    flying = position[:, 2] < -radius - 0.01  # the ground is what a climb leaves
    assert world.distance(position[flying]).min() >= radius - 1e-6
    assert world.wall_distance(position[position[:, 2] <= -1.99]).min() >= radius - 1e-6
    assert min(fence.inside(place) for place in position) >= radius - 1e-6
