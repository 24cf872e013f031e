"""Trajectories on the flight clock."""

import numpy as np
import pytest

from companion.motion import JOINT, end_us, joint, state_at
from companion.seam import Flown
from planner import Limits, World, plan

WORLD = World(((0.0, 0.0, -5.0), (20.0, 20.0, 0.0)))


def straight(start_us):
    made = plan(WORLD, (1.0, 1.0, -2.0), (11.0, 1.0, -2.0), Limits(3.0, 6.0, 60.0), 0.3)
    return Flown(made.trajectory, start_us)


def test_it_stands_before_its_start_and_after_its_end():
    flown = straight(1_700_000_000_000_000)
    assert state_at(flown, flown.start_us - 5_000_000).position == pytest.approx([1.0, 1.0, -2.0])
    assert state_at(flown, end_us(flown) + 5_000_000).position == pytest.approx([11.0, 1.0, -2.0])


def test_the_rest_of_a_trajectory_takes_over_from_it_without_a_jump_and_one_that_is_late_does_not():
    flown = straight(5_000_000)
    rest = Flown(flown.trajectory.after(1.5), 6_500_000)
    assert joint(flown, rest) < 0.1 * JOINT
    late = Flown(rest.trajectory, 6_600_000)
    assert joint(flown, late) == pytest.approx(
        np.abs(state_at(flown, 6_600_000).position - rest.trajectory.position(0.0)).max()
    )
