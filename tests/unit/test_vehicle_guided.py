"""How ArduPilot reads setpoints: which groups count in which frame, and what is a stop. Numbers worked by hand."""

import math

import numpy as np
import pytest

from fakevehicle.flavours.guided import Wanted, carried_on, setpoint_of
from fakevehicle.vocabulary import Setpoint

POSITION_ONLY, VELOCITY_ONLY, ACCELERATION_ONLY = 0xDF8, 0xDC7, 0xC3F
POSITION_VELOCITY, ALL, POSITION_ACCELERATION = 0xDC0, 0xC00, 0xC38
HERE = np.array([10.0, 20.0, -5.0])
EAST = math.pi / 2


def wanted(mask: int, frame: int = 1, **others: float) -> Wanted:
    return Wanted(
        mask,
        frame,
        np.array([1.0, 2.0, -3.0]),
        np.array([0.5, 0.25, -1.0]),
        np.array([0.1, 0.2, 0.3]),
        others.get("yaw", 0.3),
        others.get("yaw_rate", 0.4),
    )


def groups(setpoint: Setpoint | None) -> str:
    """Which of position, velocity, acceleration are asked for; "stop" when nothing is."""
    if setpoint is None:
        return "stop"
    given = (setpoint.position_n, setpoint.velocity_n, setpoint.acceleration_n)
    return "".join(letter for letter, vector in zip("pva", given, strict=True) if np.isfinite(vector).all())


@pytest.mark.parametrize(
    ("mask", "meaning"),
    [
        (POSITION_ONLY, "p"),
        (VELOCITY_ONLY, "v"),
        (ACCELERATION_ONLY, "a"),
        (POSITION_VELOCITY, "pv"),
        (ALL, "pva"),
        (0xC07, "va"),
        (POSITION_ACCELERATION, "stop"),
        (0xFFF, "stop"),
        (ACCELERATION_ONLY | 0x200, "stop"),  # a force
        (POSITION_ONLY | 0x001, "stop"),  # one ignored axis drops its group
        (POSITION_VELOCITY | 0x004, "v"),
        (POSITION_VELOCITY | 0x010, "p"),
        (POSITION_ONLY | 0x200, "p"),  # the force bit means the acceleration, which is ignored
    ],
)
def test_a_group_counts_only_when_it_is_whole(mask: int, meaning: str) -> None:
    assert groups(setpoint_of(wanted(mask), HERE, 0.0)) == meaning


@pytest.mark.parametrize(
    ("frame", "position", "velocity", "yaw"),
    [
        (1, [1, 2, -3], [0.5, 0.25, -1], 0.3),
        (7, [11, 22, -8], [0.5, 0.25, -1], 0.3),
        (8, [8, 21, -8], [-0.25, 0.5, -1], 0.3 + EAST),  # forward is east, right is south
        (9, [8, 21, -8], [-0.25, 0.5, -1], 0.3 + EAST),
    ],
)
def test_body_frames_are_turned_by_the_heading_and_offsets_are_added(
    frame: int, position: list[float], velocity: list[float], yaw: float
) -> None:
    setpoint = setpoint_of(wanted(POSITION_VELOCITY & ~0x400, frame), HERE, EAST)
    assert setpoint is not None
    np.testing.assert_allclose(setpoint.position_n, position, atol=1e-12)
    np.testing.assert_allclose(setpoint.velocity_n, velocity, atol=1e-12)
    assert setpoint.yaw == pytest.approx(yaw)


@pytest.mark.parametrize("frame", [0, 3, 5, 6, 11, 12, 99])
def test_any_other_frame_is_a_stop(frame: int) -> None:
    assert setpoint_of(wanted(POSITION_ONLY, frame), HERE, 0.0) is None


@pytest.mark.parametrize("number", [math.nan, math.inf, 1e30])
def test_a_number_that_is_none_is_a_stop_where_it_is_asked_for_and_nothing_where_it_is_ignored(number: float) -> None:
    bad = Wanted(VELOCITY_ONLY, 1, np.full(3, number), np.zeros(3), np.full(3, number), number, number)
    assert groups(setpoint_of(bad, HERE, 0.0)) == "v"
    worse = Wanted(POSITION_ONLY, 1, np.full(3, number), np.zeros(3), np.zeros(3), 0.0, 0.0)
    assert setpoint_of(worse, HERE, 0.0) is None


def test_a_followed_point_goes_on_at_its_velocity_and_rests_after_the_timeout() -> None:
    asked = setpoint_of(wanted(ALL), HERE, 0.0)
    assert asked is not None
    later = carried_on(asked, 2.0, 3.0)
    assert later is not None
    assert later.position_n.tolist() == [2.0, 2.5, -5.0]
    assert later.velocity_n.tolist() == [0.5, 0.25, -1.0]
    at_rest = carried_on(asked, 60.0, 3.0)
    assert at_rest is not None
    assert at_rest.position_n.tolist() == [2.5, 2.75, -6.0]
    assert at_rest.velocity_n.tolist() == [0.0, 0.0, 0.0]


@pytest.mark.parametrize("mask", [POSITION_ONLY, VELOCITY_ONLY])
def test_what_has_no_position_or_no_velocity_does_not_go_on(mask: int) -> None:
    asked = setpoint_of(wanted(mask), HERE, 0.0)
    assert asked is not None
    assert carried_on(asked, 1.0, 3.0) is None
