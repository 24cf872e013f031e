"""A mission file says what it must, or every problem gets its own line: where, what was found, what was expected."""

from pathlib import Path

import numpy as np
import pytest

from companion.errors import MissionError
from companion.fleet.missions import has_vehicles, split
from companion.missionfile import load_mission, parse_mission

GOOD = """\
name: hop
vehicle:
  start: {north: 1, east: 2}
world:
  bounds: {north: [0, 20], east: [0, 20], altitude: [0, 4]}
  obstacles:
    - box: {north: [9, 10], east: [6, 15], altitude: [0, 3]}
    - cylinder: {north: 5, east: 5, radius: 0.4, altitude: [1, 4]}
    - sphere: {north: 3, east: 4, altitude: 2, radius: 0.5}
steps:
  - takeoff: {altitude: 1.5}
  - goto: {north: 19, east: 10, altitude: 2}
  - land
"""


def problems(text: str) -> list[str]:
    with pytest.raises(MissionError) as caught:
        parse_mission(text.encode(), "hop.yaml")
    return caught.value.problems


def test_a_good_mission_turns_altitudes_upside_down_into_ned():
    mission = parse_mission(GOOD.encode(), "hop.yaml")
    box, cylinder, sphere = mission.planner_world().obstacles
    np.testing.assert_array_equal((box.lower, box.upper), ((9, 6, -3), (10, 15, 0)))
    assert tuple(cylinder.z) == (-4, -1)
    np.testing.assert_array_equal(sphere.centre, (3, 4, -2))
    assert mission.steps[1].goto.ned() == (19, 10, -2)
    assert mission.start_m() == (1, 2, 0)


@pytest.mark.parametrize("path", sorted(Path("missions").glob("*.yaml")), ids=lambda p: p.stem)
def test_every_mission_that_ships_is_a_good_one(path):
    data = path.read_bytes()
    missions = [part.mission for part in split(data, str(path))] if has_vehicles(data) else [load_mission(path)]
    assert all(mission.name for mission in missions)


@pytest.mark.parametrize(
    ("old", "new", "line", "words"),
    [
        ("altitude: 1.5", "altitude: high", 11, ["steps.0.takeoff.altitude", "'high'", "a valid number"]),
        ("altitude: 1.5", 'altitude: "3"', 11, ["steps.0.takeoff.altitude", "'3'", "a valid number"]),
        ("altitude: 1.5", "altitude: true", 11, ["steps.0.takeoff.altitude", "True", "a valid number"]),
        ("altitude: 1.5", "altitude: 1.0e+300", 11, ["steps.0.takeoff.altitude", "1e+300", "less than or equal to"]),
        ("altitude: 1.5", "altitude: -1", 11, ["steps.0.takeoff.altitude", "-1", "greater than 0"]),
        ("altitude: 1.5", "altitude: .inf", 11, ["steps.0.takeoff.altitude", "found inf", "a finite number"]),
        ("altitude: 1.5", "altitude: .nan", 11, ["steps.0.takeoff.altitude", "found nan", "a finite number"]),
        ("east: 10,", "eats: 10,", 12, ["steps.1.goto.eats", "unknown key", "did you mean east?"]),
        ("east: 10,", "east: 10, east: 11,", 12, ["east", "found twice, expected once"]),
        (
            "{altitude: 1.5}",
            "",
            11,
            ["steps.0", "exactly one of takeoff, goto, via, orbit, yaw, hold, wait, return, land"],
        ),
        ("{altitude: 1.5}", "3", 11, ["steps.0.takeoff", "found 3", "expected a mapping"]),
        ("east: 10,", "", 12, ["steps.1.goto.east", "found nothing", "expected a value"]),
        ("north: [0, 20]", "north: [20, 0]", 5, ["world.bounds.north", "low < high", "[20, 0]"]),
        ("north: [0, 20]", "north: 20", 5, ["world.bounds.north", "pair [low, high]", "20"]),
        ("radius: 0.4", "radius: 0", 8, ["world.obstacles.1.cylinder.radius", "greater than 0"]),
        ("- land", "- hover", 13, ["steps.2", "'hover'"]),
        ("- land", "- hold: {seconds: 1}", 10, ["steps: found hold as step 2, expected land as the last"]),
        ("  - takeoff: {altitude: 1.5}\n", "", 10, ["steps: found goto as step 0, expected takeoff as the first"]),
        ("- sphere:", "- sphere: null\n      pyramid:", 10, ["world.obstacles.2.pyramid", "unknown key"]),
    ],
)
def test_each_problem_names_its_line_its_key_what_was_found_and_what_was_expected(old, new, line, words):
    assert old in GOOD
    found = problems(GOOD.replace(old, new, 1))
    text = next(p for p in found if words[0] in p)
    for word in words:
        assert word in text
    if new:
        assert f"line {line}:" in text


def test_all_problems_are_told_at_once():
    assert len(problems(GOOD.replace("altitude: 1.5", "altitude: x").replace("radius: 0.4", "radius: y"))) == 2


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "expected a mapping"),
        ("- a\n- b\n", "a list of 2"),
        ("name: [unclosed", "not YAML"),
        ("[" * 200_000, "levels of nesting"),
        ("name: &a x\nvehicle: *a\n", "alias"),
        ("name: !!python/object/apply:os.system ['true']", "not YAML"),
    ],
)
def test_what_is_not_a_mission_at_all_is_said_in_one_line(text, words):
    (problem,) = problems(text)
    assert words in problem
    assert "\n" not in problem


def test_bytes_that_are_not_text_and_files_that_are_not_there_are_said_in_one_line(tmp_path):
    with pytest.raises(MissionError, match="not UTF-8"):
        parse_mission(b"\xff\xfe\x00", "x")
    with pytest.raises(MissionError, match=r"missing\.yaml: cannot be read: No such file"):
        load_mission(tmp_path / "missing.yaml")
    with pytest.raises(MissionError, match="more than 1000000 bytes"):
        parse_mission(b"#" * 5_000_000, "x")


def test_a_place_kilometres_away_is_refused_with_the_distance_until_the_mission_says_that_it_is_meant():
    far = GOOD.replace("bounds: {north: [0, 20]", "bounds: {north: [0, 90000]")
    far = far.replace("- land", "- goto: {north: 60001, east: 2, altitude: 1.5}\n  - land")
    (problem,) = problems(far)
    assert problem == (
        "line 13: steps.2.goto: found a place 60000 m from the start, expected at most 5000 m (limits.reach)"
    )
    assert parse_mission((far + "limits: {reach: 70000}\n").encode(), "x").limits.reach == 70_000


def test_a_latitude_half_a_degree_off_in_a_ground_stations_plan_is_refused_by_its_item():
    item = "{i}\t0\t3\t{c}\t0\t0\t0\t0\t{lat}\t8.545594\t10\t1\n"
    rows = [(0, 16, 47.397742), (1, 22, 47.397742), (2, 16, 47.897742), (3, 20, 0.0)]
    text = "QGC WPL 110\n" + "".join(item.format(i=i, c=c, lat=lat) for i, c, lat in rows)
    (problem,) = problems(text)
    assert "found a place 55589 m from the start, expected at most 5000 m" in problem


def test_a_mission_of_several_vehicles_where_one_is_wanted_is_told_as_such_and_by_nothing_else():
    (problem,) = problems(Path("missions/swap.yaml").read_text())
    assert "vehicles: found several vehicles, expected one: companion simulate, fly, run and test take" in problem


def test_a_key_that_is_there_twice_is_refused_in_a_mission_of_several_vehicles_too():
    text = Path("missions/swap.yaml").read_text() + "\nname: again\n"
    with pytest.raises(MissionError, match="name: found twice, expected once"):
        split(text.encode(), "swap.yaml")
