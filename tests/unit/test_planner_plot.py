"""Pictures of plans: a file comes out, and importing the planner costs no matplotlib (see test_planner_plan)."""

from pathlib import Path

import numpy as np
import pytest

from planner import Box, Cylinder, Limits, Prism, Sphere, World, plan
from planner.plot import _outline, _slice, save_plot

WORLD = World(((0, 0, -4), (20, 20, 0)), [Box((9, 0, -2.5), (10, 20, 0)), Cylinder((5, 10), 0.5, (-4, 0))])


@pytest.mark.parametrize("names", [("x", "y", "z"), ("north", "east", "-altitude")])
def test_a_png_of_a_plan_is_written(tmp_path: Path, names: tuple[str, str, str]) -> None:
    limits = Limits(3.0, 6.0, 60.0)
    p = plan(WORLD, (1, 10, -1.5), (19, 10, -1.5), limits, 0.3)
    save_plot(WORLD, p, tmp_path / "plan.png", limits, 0.3, names)
    assert (tmp_path / "plan.png").read_bytes().startswith(b"\x89PNG")


def test_an_empty_world_is_drawn_too(tmp_path: Path) -> None:
    world = World(((0, 0, 0), (5, 5, 5)))
    save_plot(world, plan(world, (1, 1, 1), (4, 4, 4), Limits(1.0, 1.0, 10.0), 0.2), tmp_path / "empty.png")
    assert (tmp_path / "empty.png").stat().st_size > 10_000


def test_the_vertical_through_a_ball_meets_it_at_its_chord() -> None:
    bottom, top = _slice(Sphere((0, 0, 1), 1.0), np.array([[0.0, 0, 9], [0.6, 0, 9], [2.0, 0, 9]]))
    np.testing.assert_allclose(bottom, [0.0, 0.2, np.nan])
    np.testing.assert_allclose(top, [2.0, 1.8, np.nan])


def test_the_halo_of_a_prism_is_round_at_its_corners_and_everywhere_as_wide_as_the_radius() -> None:
    triangle = Prism(((0, 0), (4, 0), (0, 3)), (0, 2))
    halo = _outline(triangle, 0.5, np.eye(3)[:, :2]).get_path()
    turn = np.linspace(0.0, 2.0 * np.pi, 200)
    aside = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    for corner in triangle.corners:
        assert all(halo.contains_point(p) for p in corner + 0.49 * aside)
    assert not halo.contains_point((-0.4, -0.4))
    assert halo.contains_point((2.0, -0.49))
    assert not halo.contains_point((2.0, -0.51))
