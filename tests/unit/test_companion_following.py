"""Things that stand by themselves in a ring, followed from scan to scan: what moves is told from what stands."""

import math

import numpy as np
import pytest

from companion.seeing.following import LOST_US, SEEN, SPARE, Following, clusters
from companion.seeing.rollingmap import RollingMap
from companion.seeing.sensing import Scan
from companion.seeing.tracks import Tracks

SECTORS = 72
BEARING = np.arange(SECTORS) * 2.0 * math.pi / SECTORS
LEVEL = np.column_stack((np.cos(BEARING), np.sin(BEARING), np.zeros(SECTORS)))


def ring(here, circles=(), walls=(), noise=None):
    """What a level ring sees of upright circles (north, east, radius) and walls (two ends)."""
    said = np.full(SECTORS, math.inf)
    for north, east, radius in circles:
        to = np.array([north, east]) - here[:2]
        along = LEVEL[:, :2] @ to
        apart = to @ to - along**2
        meets = (apart < radius**2) & (along > 0.0)
        said[meets] = np.minimum(said[meets], along[meets] - np.sqrt(radius**2 - apart[meets]))
    for a, b in walls:
        a, e = np.array(a) - here[:2], np.array(b) - np.array(a)
        across = LEVEL[:, 0] * e[1] - LEVEL[:, 1] * e[0]
        with np.errstate(divide="ignore", invalid="ignore"):
            t = (a[0] * e[1] - a[1] * e[0]) / across
            share = (a[0] * LEVEL[:, 1] - a[1] * LEVEL[:, 0]) / across
        meets = (t > 0.0) & (share >= 0.0) & (share <= 1.0)
        said[meets] = np.minimum(said[meets], t[meets])
    if noise is not None:
        said = said + 0.03 * noise.standard_normal(SECTORS)
    return Scan(0, np.array(here, dtype=float), LEVEL, said, 25.0)


def followed(seconds, circles_at, here_at=lambda s: (0.0, 0.0, -1.5), walls=(), seed=0):
    """Ten rings a second; the tracks, the map and the follower at the end."""
    tracks, seen_map, noise = Tracks(), RollingMap(0.1, (-4.0, 0.0)), np.random.default_rng(seed)
    following = Following(tracks, seen_map, 0.4)
    most = 0
    for k in range(round(10 * seconds) + 1):
        scan = ring(here_at(0.1 * k), circles_at(0.1 * k), walls, noise)
        following.look(100_000 * k, scan, scan.distance)
        seen_map.add(100_000 * k, scan)
        most = max(most, len(tracks))
    return tracks, seen_map, following, most


@pytest.mark.parametrize("seed", range(5))
def test_somebody_who_walks_across_is_found_where_he_is_and_as_fast(seed):
    tracks, _, _, _ = followed(2.0, lambda s: [(5.0, -2.0 + 1.5 * s, 0.4)], seed=seed)
    (mover,) = tracks.movers()
    assert math.dist(mover.centre[:2], (5.0, 1.0)) < 0.4
    assert math.dist(mover.velocity, (0.0, 1.5, 0.0)) < 0.5
    assert mover.radius == pytest.approx(0.4 + SPARE)


@pytest.mark.parametrize("seed", range(5))
def test_poles_and_walls_that_are_flown_past_do_not_move(seed):
    poles = [(4.0, 2.0, 0.3), (6.0, -1.5, 0.2), (9.0, 1.0, 0.5), (7.0, 4.0, 0.15)]
    walls = [((12.0, -6.0), (12.0, 6.0)), ((2.0, 6.0), (8.0, 7.0))]
    *_, most = followed(4.0, lambda s: poles, lambda s: (2.5 * s, 0.2 * math.sin(s), -1.5), walls, seed)
    assert most == 0


def test_a_piece_of_wall_seen_between_two_poles_is_no_thing_by_itself():
    scan = ring((0.0, 0.0, -1.5), [(3.0, 0.6, 0.4), (3.0, -0.6, 0.4)], [((5.0, -0.4), (5.0, 0.4))])
    places = [place for place, _, _ in clusters(scan, scan.distance, 0.4)]
    assert not any(math.dist(place, (5.0, 0.0)) < 0.8 for place in places)


def test_what_is_beside_something_that_nobody_looked_at_is_no_thing_by_itself():
    scan = ring((0.0, 0.0, -1.5), [(3.0, 0.0, 0.3)])
    hit = np.flatnonzero(np.isfinite(scan.distance))
    assert clusters(scan, scan.distance, 0.4)
    scan.distance[(hit + 3) % SECTORS] = math.nan
    scan.distance[(hit - 3) % SECTORS] = math.nan
    assert not clusters(scan, scan.distance, 0.4)


def test_who_is_not_seen_any_more_is_forgotten_and_one_who_stops_is_no_mover():
    tracks, _, following, _ = followed(2.0, lambda s: [(5.0, -2.0 + 1.5 * s, 0.4)])
    empty = ring((0.0, 0.0, -1.5))
    following.look(2_000_000 + LOST_US, empty, empty.distance)
    assert len(tracks) == 1
    following.look(2_100_000 + LOST_US, empty, empty.distance)
    assert not len(tracks)
    assert not following.count
    tracks, *_ = followed(6.0, lambda s: [(5.0, min(-2.0 + 1.5 * s, 1.0), 0.4)])
    assert not len(tracks)


def test_what_a_mover_was_taken_for_before_it_was_one_leaves_the_map():
    _, seen_map, _, _ = followed(0.3, lambda s: [(5.0, -2.0 + 1.5 * s, 0.4)])
    before = len(seen_map.view().runs)
    tracks, seen_map, following, _ = followed(1.0, lambda s: [(5.0, -2.0 + 1.5 * s, 0.4)])
    assert before > 0
    assert len(tracks) == 1
    (mover,) = tracks.movers()
    scan = ring((0.0, 0.0, -1.5), [(5.0, -0.35, 0.4)])
    following.look(1_100_000, scan, scan.distance)
    view = seen_map.view()
    east = view.origin[1] + (view.runs[:, 1] + 0.5) * view.resolution
    assert not (east < mover.centre[1] - 1.0).any()


def test_addresses_are_beyond_those_of_transponders_and_of_the_fleet_and_there_are_only_so_many():
    rng = np.random.default_rng(3)
    tracks, seen_map = Tracks(), RollingMap(0.1, (-4.0, 0.0))
    following = Following(tracks, seen_map, 0.4)
    for k in range(200):
        scan = ring((0.0, 0.0, -1.5))
        scan.distance[rng.integers(0, SECTORS, 30)] = rng.uniform(0.3, 11.0, 30)
        following.look(100_000 * k, scan, scan.distance)
        assert following.count <= 32
    assert all(address > SEEN for address in tracks._tracks)
