"""The last look before something is flown."""

import math

import numpy as np
import pytest

from companion.guard import clear_for
from companion.seam import Flown
from companion.seeing.rollingmap import RollingMap
from companion.seeing.sensing import Scan
from planner import Limits, MovingSphere, World, plan

START_US = 3_000_000


@pytest.fixture(scope="module")
def flown():
    world = World(((0.0, 0.0, -5.0), (20.0, 20.0, 0.0)))
    return Flown(plan(world, (1.0, 5.0, -2.0), (13.0, 5.0, -2.0), Limits(3.0, 6.0, 60.0), 0.3).trajectory, START_US)


def map_with(*points):
    made, position = RollingMap(0.1, (-5.0, 0.0)), np.array([5.0, 5.0, -2.0])
    away = np.array(points, dtype=float).reshape(-1, 3) - position
    distance = np.linalg.norm(away, axis=1)
    if len(away):
        made.add(0, Scan(0, position, away / distance[:, None], distance, 25.0))
    return made


def until(flown):
    return START_US + round(flown.trajectory.duration * 1e6)


def test_an_empty_map_is_clear_for_ever(flown):
    assert clear_for(flown, START_US, until(flown), map_with(), (), 0.4) == math.inf


def test_it_tells_when_the_vehicle_first_comes_too_near_to_a_cell(flown):
    said = clear_for(flown, START_US, until(flown), map_with((9.05, 5.05, -2.0)), (), 0.4)
    x = flown.trajectory.position(np.array([said]))[0, 0]
    assert 9.0 - 0.4 - 0.07 <= x <= 9.0 - 0.4 + 0.07  # the cell begins at 9.0; a sample each 0.06 m


@pytest.mark.parametrize(("beside", "clear"), [(0.35, False), (0.55, True)])
def test_a_cell_beside_the_way_counts_by_its_edge(flown, beside, clear):
    cell = map_with((9.05, 5.0 + beside + 0.05, -2.0))
    assert (clear_for(flown, START_US, until(flown), cell, (), 0.4) == math.inf) is clear


def test_only_what_is_asked_for_is_looked_at(flown):
    seen = map_with((9.05, 5.05, -2.0))
    assert clear_for(flown, START_US, START_US + 1_000_000, seen, (), 0.4) == math.inf


def test_a_mover_is_met_where_and_when_it_will_be(flown):
    t = 2.0
    x = float(flown.trajectory.position(np.array([t]))[0, 0])
    crossing = MovingSphere((x, 5.0 - 2.0 * t, -2.0), (0.0, 2.0, 0.0), 0.5, 0.0, START_US / 1e6)
    said = clear_for(flown, START_US, until(flown), map_with(), (crossing,), 0.4)
    assert t - 0.5 < said < t
    gone = MovingSphere((x, 5.0 + 2.0, -2.0), (0.0, 2.0, 0.0), 0.5, 0.0, START_US / 1e6)
    assert clear_for(flown, START_US, until(flown), map_with(), (gone,), 0.4) == math.inf
