"""What a campaign shows: groups, intervals, failures by kind, pictures."""

import json
from pathlib import Path
from typing import Any

import pytest
from scipy.stats import binomtest

from campaigns.clusters import clusters, kind_of
from campaigns.errors import CampaignError
from campaigns.flying import Flown, lost_row
from campaigns.plots import write_pictures
from campaigns.runs import Run
from campaigns.show import flown, groups, labels, varying, wilson
from campaigns.sofar import rows_so_far
from campaigns.store import Store, open_store
from campaigns.sweep import load_sweep
from campaigns.table import write_tables
from companion.cli.campaign_show import show_campaign, show_rows

TOUCHED, LATE = "touched an obstacle at 12.31 s", "not over after 600 s of simulated time"


def row(number: int, **other: Any) -> dict[str, Any]:
    """A flight in calm air that went well, but for what is said."""
    same = {"mission": "l_shape", "family": "", "autopilot": "px4", "method": "haoaroa", "airframe": "", "gains": ""}
    air = {"wind_north": 0.0, "wind_east": 0.0, "gusts": "", "faults": "", "link": ""}
    came = {"ok": True, "cause": "", "status": "flown", "simulated_s": 30.0}
    figures = {"tracking_p95_m": 0.1, "min_clearance_m": 0.5}
    return {"run_id": f"{number:016x}", "seed": number, **same, **air, **came, **figures, **other}


def failed(number: int, cause: str, **other: Any) -> dict[str, Any]:
    return row(number, ok=False, cause=cause, **other)


WINDS = [
    row(1),
    row(2, tracking_p95_m=0.2),
    row(3, tracking_p95_m=None, min_clearance_m=None),
    row(4, wind_north=8.0, tracking_p95_m=0.5),
    failed(5, TOUCHED, wind_north=8.0, min_clearance_m=-0.05),
    failed(6, "touched an obstacle at 9 s", wind_north=8.0, autopilot="ardupilot"),
    failed(7, LATE, simulated_s=600.0),
    failed(8, "its process was killed by signal 9", status="infrastructure", simulated_s=None, tracking_p95_m=None),
]


@pytest.mark.parametrize(("ok", "of"), [(0, 5), (5, 5), (1, 2), (97, 100), (337, 360)])
def test_the_interval_is_wilsons(ok: int, of: int) -> None:
    theirs = binomtest(ok, of).proportion_ci(0.95, method="wilson")
    assert wilson(ok, of) == pytest.approx((theirs.low, theirs.high), abs=1e-12)


def test_the_interval_holds_what_was_found() -> None:
    for of in range(1, 100):
        for ok in range(of + 1):
            low, high = wilson(ok, of)
            assert 0.0 <= low <= ok / of <= high <= 1.0


def test_nothing_is_known_of_no_flights() -> None:
    assert wilson(0, 0) == (0.0, 1.0)


def test_flights_are_grouped_by_what_varies_and_never_by_seeds() -> None:
    flights = flown(WINDS)
    assert varying(flights) == ["autopilot", "wind"]
    by_wind = {group.values["wind"]: group for group in groups(flights, ["wind"])}
    assert list(by_wind) == ["0, 0 m/s", "8, 0 m/s"]
    calm, windy = by_wind.values()
    assert (calm.flights, calm.ok, windy.flights, windy.ok) == (4, 3, 3, 1)
    assert (calm.p95_median_m, calm.p95_worst_m, calm.clearance_m) == pytest.approx((0.1, 0.2, 0.5))
    assert (windy.p95_worst_m, windy.clearance_m) == (0.5, -0.05)
    assert (calm.simulated_s, windy.simulated_s) == (690.0, 90.0)
    assert [group.values for group in groups(flights, ["autopilot", "wind"])] == [
        {"autopilot": "ardupilot", "wind": "8, 0 m/s"},
        {"autopilot": "px4", "wind": "0, 0 m/s"},
        {"autopilot": "px4", "wind": "8, 0 m/s"},
    ]


def test_many_winds_become_bins_of_their_speed() -> None:
    rows = [row(k, wind_north=-0.1 * k) for k in range(100)]
    found = groups(rows, ["wind"])
    assert [group.flights for group in found] == [20] * 5
    assert found[0].values["wind"].startswith("0 to ")
    assert found[-1].values["wind"].endswith(" to 9.9 m/s")


def test_groups_are_in_the_order_of_people() -> None:
    rows = [row(k, gains=gains) for k, gains in enumerate(("a-10", "a-2", "b", "a-2.5", ""))]
    assert [group.values["gains"] for group in groups(rows, ["gains"])] == ["none", "a-2", "a-2.5", "a-10", "b"]
    winds = [row(k, wind_north=north) for k, north in enumerate((10.0, 2.0, 0.0))]
    assert [group.values["wind"] for group in groups(winds, ["wind"])] == ["0, 0 m/s", "2, 0 m/s", "10, 0 m/s"]


def test_worlds_of_a_family_are_one_mission() -> None:
    assert labels([row(1, mission="forest 1", family="forest"), row(2)], "mission") == ["forest", "l_shape"]


@pytest.mark.parametrize(
    ("cause", "kind"),
    [
        (TOUCHED, "touched an obstacle at # s"),
        ("touched pop-up 3 at 0.5 s", "touched pop-up # at # s"),
        (
            "tracking_error_p95_m: found 0.412, expected at most 0.35",
            "tracking_error_p95_m: found #, expected at most #",
        ),
        (f"{LATE} (first innovation refused: velocity 1.2 at 3.4 s)", "not over after # s of simulated time"),
        ("worlds/a b.yaml: line 3: found 'x', expected -1e-3", "worlds/a …: line #: found …, expected #"),
        ("wind of 3 m/s from px4", "wind of # m/s from px4"),
    ],
)
def test_causes_of_one_kind_differ_in_numbers_and_names_only(cause: str, kind: str) -> None:
    assert kind_of(cause) == kind


def test_failures_are_gathered_the_commonest_first_with_what_they_share() -> None:
    found = clusters(WINDS)
    assert [(c.kind, len(c.run_ids)) for c in found] == [
        ("touched an obstacle at # s", 2),
        ("its process was killed by signal #", 1),
        ("not over after # s of simulated time", 1),
    ]
    assert found[0].run_ids == (f"{5:016x}", f"{6:016x}")
    assert found[0].common == {"wind": "8, 0 m/s"}


def test_a_campaign_under_way_is_shown_with_how_far_it_is(capsys: pytest.CaptureFixture[str]) -> None:
    assert show_rows(Path("my winds"), WINDS, 20, [], None, as_json=False) == 0
    told = capsys.readouterr().out
    assert "my winds: 7 flown of 20 runs; 4 ended as expected (57.1 %), 3 did not; 1 could not be flown" in told
    assert "2  touched an obstacle at # s, all with wind 8, 0 m/s" in told
    assert f"companion campaign rerun 'my winds' {5:016x}" in told
    assert show_rows(Path("new"), [], 20, [], None, as_json=False) == 0
    assert capsys.readouterr().out == "new: 0 flown of 20 runs\n"


def test_json_has_every_group_and_failure(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    assert show_rows(Path("winds"), WINDS, 8, ["autopilot"], tmp_path, as_json=True) == 0
    told = json.loads(capsys.readouterr().out)
    assert (told["runs"], told["flown"], told["failed"], told["not_flown"]) == (8, 7, 3, 1)
    assert [group["values"] for group in told["groups"]] == [{"autopilot": "ardupilot"}, {"autopilot": "px4"}]
    assert sum(failure["count"] for failure in told["failures"]) == 4
    assert [Path(picture).name for picture in told["pictures"]] == ["ok.png", "tracking.png", "clearance.png"]


def test_a_column_that_is_not_there_is_named_with_those_that_are(tmp_path: Path) -> None:
    with pytest.raises(CampaignError, match=r"^--by: found winds, expected columns among airframe, .*, wind, "):
        show_rows(tmp_path, WINDS, 8, ["winds"], None, as_json=False)


def test_pictures_are_drawn_of_what_was_measured_only(tmp_path: Path) -> None:
    unmeasured = [row(k, tracking_p95_m=None, min_clearance_m=None) for k in range(3)]
    assert [path.name for path in write_pictures(unmeasured, [], tmp_path, "three")] == ["ok.png"]
    assert (tmp_path / "ok.png").read_bytes().startswith(b"\x89PNG")
    assert write_pictures([], [], tmp_path / "none", "none") == []


def test_a_folder_that_cannot_be_written_is_one_line(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with pytest.raises(CampaignError, match=r"file: cannot write the pictures: "):
        write_pictures(WINDS, [], tmp_path / "file", "winds")


SWEEP = """\
name: three
worlds: [{family: gap}]
seeds: [1, 2, 3]
"""


@pytest.fixture
def three(tmp_path: Path) -> tuple[Store, tuple[Run, ...]]:
    """A campaign of three runs, of which nothing is done."""
    (tmp_path / "three.yaml").write_text(SWEEP)
    sweep = load_sweep(tmp_path / "three.yaml")
    return open_store(tmp_path / "campaign", sweep, resume=False), sweep.runs


def came(run: Run, **other: Any) -> Flown:
    return Flown({**lost_row(run, ""), "status": "flown", "ok": True, **other}, 1.0, 1.0, "here")


def test_what_is_done_is_shown_at_any_moment(three: tuple[Store, tuple[Run, ...]]) -> None:
    store, (first, second, third) = three
    assert rows_so_far(store) == []
    store.complete(second, came(second), 1)
    assert [row["run_id"] for row in rows_so_far(store)] == [second.run_id]
    # A command ends with a run that nobody could fly; the next flies it, and has not written its tables yet.
    write_tables(
        store.folder,
        [{**came(second).row, "recording": ""}, {**lost_row(third, "its process died"), "recording": ""}],
        [],
    )
    assert [(row["run_id"], row["status"]) for row in rows_so_far(store)] == [
        (second.run_id, "flown"),
        (third.run_id, "infrastructure"),
    ]
    store.complete(third, came(third, ok=False, cause="touched"), 1)
    store.complete(first, came(first), 1)
    assert [(row["run_id"], row["ok"]) for row in rows_so_far(store)] == [
        (first.run_id, True),
        (second.run_id, True),
        (third.run_id, False),
    ]


@pytest.mark.parametrize("column", ["ok", "tracking_p95_m", "cause"])
def test_a_damaged_result_is_left_out_and_named(
    column: str, three: tuple[Store, tuple[Run, ...]], capsys: pytest.CaptureFixture[str]
) -> None:
    store, (first, second, _) = three
    store.complete(first, came(first, **{column: ["nonsense"]}), 1)
    store.complete(second, came(second), 1)
    assert show_campaign(store.folder, [], None, as_json=False) == 0
    told = capsys.readouterr()
    assert "1 flown of 3 runs" in told.out
    assert f"{first.run_id}: damaged, and left out" in told.err


def test_a_folder_that_is_no_campaign_is_one_line(tmp_path: Path) -> None:
    with pytest.raises(CampaignError, match=r"campaign.json: cannot be read: No such file or directory"):
        show_campaign(tmp_path, [], None, as_json=False)
