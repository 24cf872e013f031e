"""Sweeps: a file becomes runs, the same ones every time, and what it says wrongly is told in one line each."""

import itertools
import re
from pathlib import Path

import numpy as np
import pytest

from campaigns.sweep import Sweep, drawn_seeds, load_sweep
from campaigns.sweepfile import SweepFile
from campaigns.table import COLUMNS
from companion.errors import ConfigError
from companion.missionfile import all_keys, parse_mission

MISSION = """\
name: hop
vehicle: {start: {north: 2, east: 2}}
world: {bounds: {north: [0, 10], east: [0, 10], altitude: [0, 4]}}
wind: {north: 1, east: -2}
steps: [{takeoff: {altitude: 1}}, land]
"""
SEVERAL = """\
name: two
world: {bounds: {north: [0, 10], east: [0, 10], altitude: [0, 4]}}
vehicles:
  - {start: {north: 2, east: 2}, steps: [{takeoff: {altitude: 1}}, land]}
  - {start: {north: 8, east: 8}, steps: [{takeoff: {altitude: 1}}, land]}
"""


@pytest.fixture
def load(tmp_path: Path):
    (tmp_path / "hop.yaml").write_text(MISSION)
    (tmp_path / "two.yaml").write_text(SEVERAL)
    (tmp_path / "stiff.params").write_text("FT_VXY_KP 9\nFT_VXY_KI 2\n")

    def load(text: str, missions: str = "missions: [hop.yaml]") -> Sweep:
        path = tmp_path / "sweep.yaml"
        path.write_text(f"name: s\n{missions}\n{text}\n")
        return load_sweep(path)

    return load


def problems(load, text: str, missions: str = "missions: [hop.yaml]") -> list[str]:
    with pytest.raises(ConfigError) as caught:
        load(text, missions)
    return caught.value.problems


def test_every_combination_of_the_axes_is_a_run_and_the_seeds_count_fastest(load) -> None:
    sweep = load("autopilots: [px4, ardupilot]\nwinds: [[0, 0], [3, 0], [0, 5]]\nseeds: [7, 8]")
    found = [(r.autopilot, r.blowing[:2], r.seed) for r in sweep.runs]
    assert found == list(itertools.product(["px4", "ardupilot"], [(0, 0), (3, 0), (0, 5)], [7, 8]))
    assert sweep.combinations == 12
    assert len({run.run_id for run in sweep.runs}) == 12


def test_a_run_that_says_nothing_of_the_wind_has_the_missions(load) -> None:
    (run,) = load("").runs
    assert run.blowing == (1, -2, 0)
    assert run.spec().wind is None
    assert run.columns()["wind_east"] == -2


def test_the_same_flight_has_the_same_id_in_another_sweep_and_another_flight_another(load) -> None:
    (one,) = load("seeds: [3]").runs
    among = load("seeds: 1-5\nwinds: [mission, [4, 0]]\nautopilots: [px4, ardupilot]").runs
    assert [run.run_id for run in among].count(one.run_id) == 1


@pytest.mark.parametrize(
    "axis",
    [
        "seeds: [2]",
        "autopilots: [ardupilot]",
        "winds: [[1.0000001, -2]]",
        "winds: [{north: 1, east: -2, gusts: [{at: 3, velocity: [1, 0, 0]}]}]",
        "faults: ['gps:off@5-6']",
        "links: [{loss: 0.1}]",
        "airframes: [iris]",
        "gains: [pid]",
        "methods: [astar]",
        "limit_s: 60",
    ],
)
def test_whatever_changes_the_flight_changes_its_id(load, axis: str) -> None:
    assert load(axis).runs[0].run_id != load("").runs[0].run_id


@pytest.mark.parametrize("axis", ["timeout_s: 60", "recordings: {failures: 3}", "winds: [[1, -2]]", "name2: x"])
def test_what_does_not_change_the_flight_does_not_change_its_id(load, axis: str) -> None:
    axis = axis.replace("name2: x", "seed: 5")
    assert load(axis).runs[0].run_id == load("").runs[0].run_id


def test_a_link_has_the_runs_seed_and_a_perfect_one_is_none(load) -> None:
    none, lossy = load("links: [none, {loss: 0.3, blackouts: [[1, 2]]}]\nseeds: [9]").runs
    assert none.link is None
    assert lossy.link is not None
    assert (lossy.link.seed, lossy.link.blackouts) == (9, ((1.0, 2.0),))
    assert lossy.columns()["link"] == "loss=0.3 blackout=1-2"


def test_drawn_seeds_are_the_same_every_time_differ_and_a_longer_list_begins_with_the_shorter(load) -> None:
    seeds = [run.seed for run in load("seeds: 50").runs]
    assert seeds == [run.seed for run in load("seeds: 80").runs][:50]
    assert len(set(seeds)) == 50
    assert seeds != [run.seed for run in load("seeds: 50\nseed: 2").runs]
    assert all(0 <= seed < 2**31 for seed in drawn_seeds(1, 0, 1000))


def test_seeds_that_are_written_out_are_taken_as_they_are(load) -> None:
    assert [run.seed for run in load("seeds: [5, 3]").runs] == [5, 3]
    assert [run.seed for run in load("seeds: 3-6").runs] == [3, 4, 5, 6]


def test_a_sample_is_of_the_combinations_each_once_and_the_same_every_time(load) -> None:
    text = "seeds: 1-100\nautopilots: [px4, ardupilot]\nwinds: [[0, 0], [3, 0], [6, 0]]\nsample: 40"
    sweep, every = load(text), load(text.replace("sample: 40", ""))
    ids = [run.run_id for run in sweep.runs]
    order = [run.run_id for run in every.runs]
    assert sweep.combinations == 600
    assert len(set(ids)) == 40
    assert [order.index(i) for i in ids] == sorted(order.index(i) for i in ids)
    assert ids == [run.run_id for run in load(text).runs]
    assert {run.blowing[0] for run in sweep.runs} == {0, 3, 6}


def test_worlds_of_the_families_are_missions_with_their_family_and_seed(load) -> None:
    runs = load("", "worlds: [{family: L, seeds: [4]}, {family: gap, seeds: 2}]").runs
    assert (runs[0].family, runs[0].world_seed) == ("L", 4)
    assert [run.family for run in runs] == ["L", "gap", "gap"]
    assert parse_mission(runs[0].data, "x").name == "L 4"


def test_gains_are_a_preset_a_file_or_single_parameters_over_them(load) -> None:
    runs = load("gains: [default, pid, stiff.params, {name: mine, preset: pid, set: {FT_VXY_KP: 7}}]").runs
    assert [run.gains for run in runs] == ["default", "pid", "stiff", "mine"]
    assert runs[0].parameters == ()
    assert dict(runs[1].parameters)["FT_VXY_KP"] == 6.0
    assert dict(runs[2].parameters) == {"FT_VXY_KP": 9.0, "FT_VXY_KI": 2.0}
    assert dict(runs[3].parameters) == {**dict(runs[1].parameters), "FT_VXY_KP": 7.0}


def test_an_airframe_of_a_file_is_told_apart_by_its_content(load, tmp_path: Path) -> None:
    shipped = Path("fakevehicle/airframes/iris.yaml").read_text()
    (tmp_path / "mine.yaml").write_text(shipped)
    (mine,) = load("airframes: [mine.yaml]").runs
    assert mine.columns()["airframe"] == "mine"
    assert list(mine.files()) == [tmp_path / "mine.yaml"]
    (tmp_path / "mine.yaml").write_text(shipped + "# heavier\n")
    (other,) = load("airframes: [mine.yaml]").runs
    assert other.run_id != mine.run_id


def test_a_mission_is_told_apart_by_the_maps_that_it_names(load, tmp_path: Path) -> None:
    np.savez(tmp_path / "map.npz", occupied=np.ones((2, 2, 2), bool), origin=[7.0, 7.0, 0.0], resolution=0.5)
    world = "world: {bounds: {north: [0, 10], east: [0, 10], altitude: [0, 4]}, obstacles: [{voxels: {file: map.npz}}]}"
    (tmp_path / "mapped.yaml").write_text(MISSION.replace(MISSION.splitlines()[2], world))
    (one,) = load("", "missions: [mapped.yaml]").runs
    assert list(one.files()) == [tmp_path / "map.npz"]
    np.savez(tmp_path / "map.npz", occupied=np.ones((2, 2, 3), bool), origin=[7.0, 7.0, 0.0], resolution=0.5)
    (other,) = load("", "missions: [mapped.yaml]").runs
    assert other.data == one.data
    assert other.run_id != one.run_id


def test_a_method_is_written_into_the_mission_that_is_flown(load) -> None:
    own, other = load("methods: [mission, jps]").runs
    assert (own.method, other.method) == ("haoaroa", "jps")
    assert own.data == MISSION.encode()
    assert parse_mission(other.data, "x").method == "jps"


def test_the_recordings_that_are_kept_anyway_are_drawn_by_the_seed(load) -> None:
    text = "seeds: 1-50\nrecordings: {sample: 5}"
    assert len(load(text).sampled) == 5
    assert load(text).sampled == load(text).sampled != load(text + "\nseed: 2").sampled


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("seed: -1", "line 3: seed: found -1, expected greater than or equal to 0"),
        ("seeds: []", "line 3: seeds: found"),
        ("seeds: 9-3", "line 3: seeds: found '9-3', expected FIRST <= LAST"),
        ("seeds: [1, 1]", "line 3: seeds: found 1 twice, expected each value once"),
        ("autopilots: []", "line 3: autopilots: found a list of 0, expected at least one value"),
        ("autopilots: [px5]", "line 3: autopilots.0: found 'px5', expected 'px4' or 'ardupilot'"),
        (
            "wind: [[1, 0]]",
            "line 3: wind: found an unknown key, expected one of docs/campaigns.md; did you mean winds?",
        ),
        ("winds: [[1, 2, 3]]", "line 3: winds.0: found a list of 3, expected the word mission, [NORTH, EAST] in m/s"),
        ("winds: [[.nan, 2]]", "line 3: winds.0: found nan"),
        ("faults: ['gps:gone']", "line 3: faults.0: fault 'gps:gone': expected one of gyro"),
        ("faults: [none, ['gyro:off', 'gps:noise@2']]", "line 3: faults.1.1: fault gps:noise: expected a magnitude"),
        ("links: [{los: 1}]", "line 3: links.0.los: found an unknown key, expected one of docs/campaigns.md; did you"),
        ("links: [{loss: 2}]", "line 3: links.0.loss: found 2, expected less than or equal to 1"),
        ("airframes: [x501]", "line 3: airframes.0: x501: found No such file or directory, expected a file, or one of"),
        ("gains: [{set: {FT_VXX_KP: 1}}]", "line 3: gains.0: FT_VXX_KP=1.0: no parameter FT_VXX_KP, did you mean FT_V"),
        ("gains: [{set: {FT_VXY_KP: 999}}]", "line 3: gains.0: FT_VXY_KP=999.0: FT_VXY_KP: 999 is outside 0..200"),
        ("gains: [gone.params]", "gone.params: No such file or directory (px4)"),
        ("methods: [rrt]", "line 3: methods.0: found 'rrt', expected 'mission', 'haoaroa'"),
        ("sample: 0", "line 3: sample: found 0, expected greater than or equal to 1"),
        ("seeds: 1-9000\nwinds: [[0, 0], [1, 0]]\nlimit_s: 0", "line 5: limit_s: found 0, expected greater than or"),
    ],
)
def test_what_cannot_be_is_told_with_line_key_found_and_expected(load, text: str, told: str) -> None:
    (problem,) = problems(load, text)
    assert told in problem


@pytest.mark.parametrize(
    ("missions", "told"),
    [
        ("missions: []", "line 1: sweep: found neither missions nor worlds, expected at least one of them"),
        ("missions: [gone.yaml]", "gone.yaml: cannot be read: No such file or directory"),
        ("missions: [sweep.yaml]", "line 2: missions.0: "),
        ("worlds: [{family: M}]", "line 2: worlds.0.family: found 'M', expected one of gap, L, H, U, Omega"),
        ("missions: &a [hop.yaml]\nworlds: *a", "found a YAML alias"),
        ("missions: [hop.yaml]\nmissions: [hop.yaml]", "line 3: missions: found twice, expected once"),
    ],
)
def test_missions_that_cannot_be_flown_are_told(load, missions: str, told: str) -> None:
    assert told in problems(load, "", missions)[0]


def test_every_problem_is_told_at_once(load) -> None:
    assert len(problems(load, "airframes: [x501]\ngains: [{set: {FT_VXX_KP: 1}}]", "missions: [gone.yaml]")) == 3


def test_more_combinations_than_can_be_are_refused_unless_a_sample_is_asked_for(load) -> None:
    text = "seeds: 1-100000\nautopilots: [px4, ardupilot]\nwinds: [[0, 0], [1, 0]]"
    assert problems(load, text) == ["line 1: sweep: found 400000 combinations, expected at most 200000, or sample"]
    assert len(load(text + "\nsample: 10").runs) == 10


def test_missions_of_several_vehicles_are_flown_as_they_are_and_refused_what_is_for_one(load) -> None:
    assert len(load("seeds: [1, 2]\nautopilots: [px4, ardupilot]", "missions: [two.yaml]").runs) == 4
    told = problems(load, "winds: [[1, 0]]\ngains: [pid]", "missions: [two.yaml]")
    assert told[0] == "line 3: winds: found with a mission of several vehicles, expected with one vehicle only"
    assert len(told) == 2


def test_two_ways_to_write_one_flight_are_refused_before_anything_is_flown(load) -> None:
    (told,) = problems(load, "winds: [mission, [1, -2]]")
    assert told == "line 1: sweep: two runs are the same flight: hop, seed 1, px4; expected values that differ"


@pytest.mark.parametrize("file", sorted(Path("campaigns/examples").glob("*.yaml")), ids=lambda path: path.stem)
def test_the_examples_are_sweeps_that_can_be_flown(file: Path) -> None:
    assert load_sweep(file).runs


def test_the_page_names_every_key_and_every_column() -> None:
    named = set(re.findall(r"[a-z_0-9]+", " ".join(re.findall(r"`([^`]*)`", Path("docs/campaigns.md").read_text()))))
    assert all_keys(SweepFile) - {"of_mission"} | set(COLUMNS) <= named
