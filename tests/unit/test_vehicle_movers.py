"""What flies about and what appears: where it is, who sees it, who is told."""

import math
from pathlib import Path

import numpy as np
import pytest

from fakevehicle.config import LinkConfig, VehicleConfig
from fakevehicle.errors import ScenarioError
from fakevehicle.scenario import load_scenario, world_text
from fakevehicle.sensors.movers import Movers, PopUp
from fakevehicle.sensors.obstacles import Nearby, World
from fakevehicle.vehicle import Vehicle
from wire.dialect import mavlink

AHEAD = np.array([[1.0, 0.0, 0.0]])
WALL = World(boxes=np.array([[6.0, -2.0, -4.0, 6.3, 2.0, 0.0]]))


def stepped(movers: Movers, until_s: float, dt: float = 1e-4):
    """The same balls by small steps, reflected where a step takes them out."""
    place, course, radius = movers.balls[:, :3].copy(), movers.balls[:, 3:6].copy(), movers.balls[:, 6:7]
    for _ in range(round(until_s / dt)):
        place += course * dt
        low, high = place < movers.low_n + radius, place > movers.high_n - radius
        course[low], course[high] = np.abs(course[low]), -np.abs(course[high])
    return place, course


def test_a_ball_is_where_small_steps_and_reflections_take_it() -> None:
    rng = np.random.default_rng(5)
    balls = np.hstack([rng.uniform(-3, 3, (8, 3)), rng.uniform(-2, 2, (8, 3)), rng.uniform(0.2, 0.5, (8, 1))])
    movers = Movers(balls, np.full(3, -4.0), np.full(3, 4.0))
    for until in (0.0, 1.7, 9.3):
        place, course = movers.at(round(1e6 * until))
        expected_place, expected_course = stepped(movers, until)
        np.testing.assert_allclose(place, expected_place, atol=2e-3)
        np.testing.assert_array_equal(course, expected_course)


def test_without_a_block_a_ball_flies_straight_on() -> None:
    place, course = Movers(np.array([[1.0, 2.0, -3.0, -0.5, 1.0, 0.0, 0.4]])).at(20_000_000)
    np.testing.assert_allclose(place, [[-9.0, 22.0, -3.0]])
    np.testing.assert_allclose(course, [[-0.5, 1.0, 0.0]])


@pytest.mark.parametrize(
    ("balls", "said"),
    [
        (np.zeros((1, 6)), "shape"),
        (np.array([[0, 0, 0, 0, 0, 0, -1.0]]), "radius"),
        (np.array([[0, 0, 0, np.nan, 0, 0, 1.0]]), "finite"),
        (np.array([[3.9, 0, 0, 0, 0, 0, 0.5]]), "mover 0 begins outside"),
    ],
)
def test_a_mover_that_cannot_be_is_refused(balls: np.ndarray, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        Movers(balls, np.full(3, -4.0), np.full(3, 4.0))


def test_a_ray_meets_a_ball_where_the_ball_is_now() -> None:
    nearby = Nearby(World(movers=Movers(np.array([[10.0, 0.0, -2.0, -1.0, 0.0, 0.0, 0.5]]))))
    here = np.array([0.0, 0.0, -2.0])
    for now_s, distance in ((0, 9.5), (4, 5.5), (9, 0.5)):
        assert nearby.at(now_s * 1_000_000, here, 25.0).cast(here, AHEAD, 25.0)[0] == pytest.approx(distance)


def test_a_pop_up_is_not_there_before_its_time_and_stays_after_it() -> None:
    nearby = Nearby(World(popups=(PopUp(WALL, at_us=3_000_000),)))
    here = np.array([0.0, 0.0, -2.0])
    seen = [nearby.at(t, here, 25.0).cast(here, AHEAD, 25.0)[0] for t in (0, 2_999_999, 3_000_000, 9_000_000)]
    assert seen == [math.inf, math.inf, 6.0, 6.0]


def test_a_pop_up_appears_once_the_vehicle_is_near_and_stays_when_it_goes_away() -> None:
    nearby = Nearby(World(popups=(PopUp(WALL, within=4.0), PopUp(WALL, at_us=10**12))))
    seen = []
    for north in (0.0, 1.9, 2.0, -10.0):
        here = np.array([north, 0.0, -2.0])
        seen.append(nearby.at(0, here, 25.0).cast(here, AHEAD, 25.0)[0])
    assert seen == [math.inf, math.inf, 4.0, 16.0]


@pytest.mark.parametrize("when", [{}, {"at_us": 5, "within": 2.0}, {"at_us": -1}, {"within": 0.0}])
def test_a_pop_up_has_one_way_to_appear(when: dict[str, float]) -> None:
    with pytest.raises(ValueError, match="pop-up"):
        PopUp(WALL, **when)


def test_a_scenario_s_movers_and_pop_ups_are_written_as_they_are_read(tmp_path: Path) -> None:
    world = World(
        boxes=WALL.boxes,
        movers=Movers(np.array([[1.0, 0.0, -2.0, 1.5, 0.0, 0.0, 0.4]]), np.full(3, -9.0), np.full(3, 9.0)),
        popups=(PopUp(WALL, at_us=12_000_000), PopUp(WALL, within=6.0)),
    )
    file = tmp_path / "s.yaml"
    file.write_text(world_text(world), encoding="utf-8")
    read = load_scenario(file).world
    assert read is not None
    assert read.movers is not None
    np.testing.assert_array_equal(read.movers.balls, world.movers.balls)
    np.testing.assert_array_equal([read.movers.low_n, read.movers.high_n], [np.full(3, -9.0), np.full(3, 9.0)])
    assert [(p.at_us, p.within) for p in read.popups] == [(12_000_000, None), (None, 6.0)]
    np.testing.assert_array_equal(read.popups[1].solids.boxes, WALL.boxes)


def test_a_scenario_s_impossible_mover_is_one_clear_line(tmp_path: Path) -> None:
    file = tmp_path / "s.yaml"
    file.write_text("world: {movers: {balls: [[1, 2, 3]]}}", encoding="utf-8")
    with pytest.raises(ScenarioError, match=r"world\.movers\.balls: a row of 3 numbers, expected 7"):
        load_scenario(file)


def told(world: World | None, autopilot: str, seconds: float) -> list:
    vehicle = Vehicle(VehicleConfig(links=(LinkConfig("onboard"),), world=world, autopilot=autopilot))
    decoder, heard = mavlink.MAVLink(None), []
    for k in range(1, round(seconds / 0.004) + 1):
        for datagram in vehicle.step(4000 * k, []):
            heard += [(4000 * k, m) for m in decoder.parse_buffer(datagram.data) or []]
    return [(at, m) for at, m in heard if m.get_type() == "ADSB_VEHICLE"]


BALLS = Movers(np.array([[5.0, 0.0, -2.0, 0.0, 1.5, -0.5, 0.4], [0.0, 8.0, -1.0, -1.0, 0.0, 0.0, 0.3]]))


def test_movers_tell_where_they_are_in_turn_five_times_a_second_each() -> None:
    reports = told(World(movers=BALLS), "px4", 2.0)
    assert [m.ICAO_address - 0xC00001 for _, m in reports] == [k % 2 for k in range(len(reports))]
    assert len(reports) == pytest.approx(20, abs=1)
    at, first = reports[-1] if reports[-1][1].ICAO_address == 0xC00001 else reports[-2]
    metres = 6378137.0 * math.radians(1e-7)  # of one unit of latitude, on WGS 84's equatorial radius
    assert (first.lat - 473977420) * metres == pytest.approx(5.0, abs=0.05)
    assert (first.lon - 85455940) * metres * math.cos(math.radians(47.39)) == pytest.approx(1.5e-6 * at, abs=0.05)
    assert first.altitude == pytest.approx(488_000 + 2000 + 0.5e-3 * at, abs=20)
    assert (first.heading, first.hor_velocity, first.ver_velocity) == (9000, 150, 50)
    assert first.flags & 0b1000111 == 0b1000111


def test_where_nothing_moves_nobody_is_told_and_arducopter_waits_to_be_asked() -> None:
    assert told(None, "px4", 0.5) == []
    assert told(World(movers=BALLS), "ardupilot", 0.5) == []
