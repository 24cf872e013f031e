"""Several vehicles: what they tell each other, whom each minds, and eight that swap places."""

import json
import math
from pathlib import Path
from zlib import crc32

import numpy as np
import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st
from typer.testing import CliRunner

from benchmarks.bench_fleet import swap
from companion.cli.app import app
from companion.drivers.rerun import rerun
from companion.errors import MissionError
from companion.fleet.exchange import LARGEST, Shared, pack, unpack
from companion.fleet.member import FLEET_LINK, Member
from companion.fleet.missions import has_vehicles, split
from companion.fleet.others import MOST, TRACKED, Others
from companion.geodesy import Geodetic, to_geodetic
from companion.hooks import Pose
from companion.missionfile import parse_mission
from companion.seam import Flown
from companion.seeing.tracks import Tracks
from companion.testing.many import fly_many
from logs.reader import Recording
from planner import Limits, Trajectory, World, plan
from wire.datagram import Datagram

HERE = np.zeros(3)
OURS = 5
LINE = Trajectory(
    np.array([[0.0, 0, -3], [1, 0, -3], [3, 0, -3], [5, 0, -3], [6, 0, -3]]),
    np.array([0, 0, 0, 0, 2.0, 4, 4, 4, 4]),
)
"""North along the axis, at rest at neither end."""


def shared(sender: int = 1, **more: object) -> Shared:
    values: dict[str, object] = {
        "sequence": 1,
        "stamp_us": 0,
        "position_m": (10.0, 0.0, -3.0),
        "velocity": (1.0, 0.0, 0.0),
        "radius": 0.25,
        "yields": True,
    }
    return Shared(sender=sender, **{**values, **more})  # type: ignore[arg-type]


def centres(tracks: Tracks) -> dict[int, tuple[float, ...]]:
    return {address - TRACKED: tuple(track.position_m) for address, track in tracks._tracks.items()}


# ---- the exchange ---------------------------------------------------------------------------------------------------


def test_what_is_told_comes_back_as_it_was() -> None:
    told = shared(
        sequence=77,
        stamp_us=1_700_000_000_000_000,
        flown=Flown(LINE, 1_699_999_999_000_000, False),
        frame=0xDEADBEEF,
        origin=Geodetic(47.5, -8.25, 488.0),
        yields=False,
    )
    assert unpack(pack(told)) == told
    assert unpack(pack(shared())) == shared()


def test_a_planned_way_is_told_to_a_tenth_of_a_millimetre_and_fits_the_datagram() -> None:
    way = plan(World(((-20, -20, -6), (20, 20, 0)), []), (-14.123, 9.87, -3), (13.3, -9, -2.5), Limits(3, 6, 60), 0.5)
    data = pack(shared(flown=Flown(way.trajectory, 5)))
    back = unpack(data)
    assert len(data) <= LARGEST
    assert back is not None
    assert back.flown is not None
    for t in np.linspace(0, way.trajectory.duration, 50):
        assert np.allclose(back.flown.trajectory.position(t), way.trajectory.position(t), atol=1e-4)


def test_a_way_that_does_not_fit_is_left_out_and_the_place_is_told() -> None:
    count = 400
    knots = np.concatenate([[0, 0, 0], np.arange(count - 2), [count - 3] * 3]).astype(float)
    long = Trajectory(np.arange(3.0 * count).reshape(-1, 3), knots)
    assert unpack(pack(shared(flown=Flown(long, 0)))) == shared()


@given(st.binary(max_size=300), st.integers(0, 200), st.integers(0, 255))
def test_rubbish_and_damage_are_nobody(data: bytes, at: int, value: int) -> None:
    assert unpack(data) is None
    good = bytearray(pack(shared(flown=Flown(LINE, 0))))
    if good[at] != value:
        good[at] = value
        assert unpack(bytes(good)) is None


@given(st.lists(st.tuples(st.integers(0, 250), st.binary(min_size=1, max_size=8)), min_size=1, max_size=8))
def test_whatever_a_liar_with_a_good_checksum_tells_nothing_raises(changes: list[tuple[int, bytes]]) -> None:
    body = bytearray(pack(shared(flown=Flown(LINE, 0)))[10:])
    for at, value in changes:
        body[at : at + len(value)] = value[: max(0, len(body) - at)]
    data = b"CFS1" + (len(body) + 10).to_bytes(2, "little") + crc32(body).to_bytes(4, "little") + bytes(body)
    others, tracks = Others(OURS, 0, Geodetic(47.0, 8.0, 0.0)), Tracks()
    for now_us in (0, 1_000_000, 5_000_000):
        others.take(now_us, data)
        others.step(now_us, now_us, HERE, tracks)
        assert all(math.isfinite(x) for m in tracks.movers() for x in (*m.centre, *m.velocity, m.radius))


def test_a_way_that_nobody_can_fly_is_refused() -> None:
    for points, knots in (
        (LINE.control_points * 200, LINE.knots),  # 300 m/s
        (LINE.control_points, LINE.knots * 1e-3),
        (LINE.control_points, LINE.knots * 1e6),
        (LINE.control_points * 1e5, LINE.knots * 1e4),
    ):
        assert unpack(pack(shared(flown=Flown(Trajectory(points, knots), 0)))) is None


@pytest.mark.parametrize(
    "flaw",
    [
        {"position_m": (math.nan, 0.0, 0.0)},
        {"position_m": (1e7, 0.0, 0.0)},
        {"velocity": (0.0, 500.0, 0.0)},
        {"radius": 0.0},
        {"sender": 0},
        {"sender": 251},
    ],
)
def test_places_and_numbers_that_cannot_be_are_refused(flaw: dict[str, object]) -> None:
    assert unpack(pack(shared(**flaw))) is None


# ---- whom we mind ---------------------------------------------------------------------------------------------------


def heard(*told: Shared, now_us: int = 0, origin: Geodetic | None = None) -> Others:
    others = Others(OURS, 0, origin)
    for one in told:
        others.take(now_us, pack(one))
    return others


def test_a_lower_number_has_the_right_of_way_and_a_higher_one_flies_round_us() -> None:
    tracks = Tracks()
    heard(shared(1), shared(9, position_m=(0.0, 10.0, -3.0))).step(0, 0, HERE, tracks)
    assert centres(tracks) == {1: (10.0, 0.0, -3.0)}


def test_anybody_near_or_unable_to_yield_is_minded_until_that_is_over() -> None:
    tracks = Tracks()
    others = heard(shared(9, position_m=(1.0, 0.0, -0.5)), shared(8, yields=False))
    others.step(0, 0, HERE, tracks)
    assert set(centres(tracks)) == {8, 9}
    others.take(0, pack(shared(9, sequence=2, position_m=(4.0, 0.0, 0.0))))
    others.take(0, pack(shared(8, sequence=2)))
    others.step(0, 0, HERE, tracks)
    assert centres(tracks) == {}


def test_a_vehicle_is_where_its_trajectory_says_and_rests_at_its_end() -> None:
    tracks = Tracks()
    others = heard(shared(flown=Flown(LINE, -1_000_000)))
    for now_us in (0, 1_000_000):
        others.step(now_us, now_us + 7_000_000, HERE, tracks)  # the flight clock is another
        place = LINE.position(1.0 + now_us / 1e6)
        (mover,) = tracks.movers()
        assert np.allclose(mover.centre, place, atol=1e-4)
        assert np.allclose(mover.velocity, LINE.velocity(1.0 + now_us / 1e6), atol=1e-4)
        assert mover.stamp == (now_us + 7_000_000) / 1e6
    others.take(2_900_000, pack(shared(sequence=2, stamp_us=2_900_000, flown=Flown(LINE, -1_000_000))))
    others.step(5_000_000, 5_000_000, HERE, tracks)
    (mover,) = tracks.movers()
    assert np.allclose(mover.centre, LINE.control_points[-1], atol=1e-4)
    assert mover.velocity == (0.0, 0.0, 0.0)


def test_clocks_may_differ_by_hours_and_datagrams_may_be_late() -> None:
    tracks, hours_us = Tracks(), 7_200_000_000
    others = Others(OURS, 0, None)
    for k in range(10):
        stamp_us = k * 100_000
        late_us = 0 if k == 3 else 40_000 * (k % 3)
        told = shared(sequence=k, stamp_us=stamp_us, flown=Flown(LINE, 0))
        others.take(stamp_us + hours_us + late_us, pack(told))
    others.step(hours_us + 1_000_000, 0, HERE, tracks)
    assert np.allclose(centres(tracks)[1], LINE.position(1.0), atol=1e-4)


def test_a_silent_vehicle_grows_and_is_forgotten_with_a_word() -> None:
    tracks, others = Tracks(), heard(shared())
    radii = {}
    for now_us in (400_000, 1_500_000, 2_900_000, 3_100_000):
        others.step(now_us, now_us, HERE, tracks)
        radii[now_us] = [m.radius for m in tracks.movers()]
    assert radii == {400_000: [0.25], 1_500_000: [1.25], 2_900_000: [pytest.approx(2.65)], 3_100_000: []}
    assert [note.text for note in others.take_said()] == ["vehicle 1 is heard", "vehicle 1 is not heard any more"]


def test_an_older_datagram_that_comes_late_changes_nothing_and_a_restart_counts() -> None:
    tracks = Tracks()
    others = heard(shared(sequence=50), shared(sequence=49, position_m=(99.0, 0.0, 0.0)))
    others.step(0, 0, HERE, tracks)
    assert centres(tracks)[1][0] == 10.0
    others.take(0, pack(shared(sequence=1, position_m=(20.0, 0.0, 0.0))))
    others.step(0, 0, HERE, tracks)
    assert centres(tracks)[1][0] == 20.0


def test_other_mission_frames_are_joined_by_their_origins_or_not_minded_with_a_word() -> None:
    ours = Geodetic(47.0, 8.0, 500.0)
    theirs = Geodetic(*to_geodetic(ours, 30.0, -40.0), 510.0)
    tracks = Tracks()
    away = Geodetic(-47.0, 8.0, 510.0)
    others = heard(shared(1, frame=1, origin=theirs), shared(2, frame=1), shared(3, frame=1, origin=away), origin=ours)
    others.step(0, 0, HERE, tracks)
    assert np.allclose(centres(tracks)[1], (40.0, -40.0, -13.0), atol=1e-3)
    assert set(centres(tracks)) == {1}
    assert "vehicle 2 does not say where near us on the earth it flies: not minded" in [
        n.text for n in others.take_said()
    ]


def test_two_with_our_number_are_told_once_and_what_is_kept_is_bounded() -> None:
    others = heard(shared(OURS), shared(OURS), *(shared(n) for n in range(6, 251)))
    said = [note.text for note in others.take_said()]
    assert said[0] == f"another companion also calls itself vehicle {OURS}"
    assert len(said) <= 8
    assert len(others.places(0)) == MOST
    assert others.bad == 2


def test_a_member_tells_ten_times_a_second_in_the_air_and_nothing_on_the_ground() -> None:
    (part, *_) = swap(1, 2, 10.0)
    member = Member(2, part.mission, Tracks(), calls=2)
    sent: list[Datagram] = []
    for k in range(100):
        pose = Pose(k * 20_000, np.zeros(3), np.zeros(3), 0.0, 0.0, 0.0)
        out = member.step(k * 20_000 + 10**9, pose, Flown(LINE, 0), airborne=k >= 50, yields=True)
        sent += [o for o in out if isinstance(o, Datagram)]
        assert k >= 50 or not out
    assert [d.link for d in sent] == [f"{FLEET_LINK}0", f"{FLEET_LINK}1"] * 10
    told = unpack(sent[0].data)
    assert told is not None
    assert told.flown is not None
    assert told.flown.start_us == 10**9  # on the clock of the stamp


# ---- mission files --------------------------------------------------------------------------------------------------

TWO = """\
name: two
world: {bounds: {north: [-5, 15], east: [-5, 5], altitude: [0, 5]}}
vehicle: {radius: 0.3}
vehicles:
  - name: a
    start: {north: 0, east: 0}
    steps: [{takeoff: {altitude: 2}}, {goto: {north: 10, east: 0, altitude: 2}}, land]
  - {start: {north: 10, east: 0}, steps: [{takeoff: {altitude: 2}}, {goto: {north: 0, east: 0, altitude: 2}}, land]}
"""


def test_a_mission_of_several_is_split_into_mission_files_of_one() -> None:
    assert has_vehicles(TWO.encode())
    parts = split(TWO.encode(), "two.yaml")
    assert [part.name for part in parts] == ["a", "2"]
    for part in parts:
        assert parse_mission(part.data, "part").model_dump() == part.mission.model_dump()
        assert part.mission.vehicle.radius == 0.3
    assert [part.mission.start_m() for part in parts] == [(0, 0, 0), (10, 0, 0)]


@pytest.mark.parametrize(
    ("found", "instead", "problem"),
    [
        ("name: a", "name: a\n    speed: 3", "two.yaml: vehicles.0: expected a mapping with start, steps"),
        ("{start: {north: 10", "{start: {nord: 10", "two.yaml: vehicles.1 (2): vehicle.start"),
        (
            "north: 10, east: 0}, steps",
            "north: 0.5, east: 0}, steps",
            "two.yaml: vehicles: a and 2 start nearer than 0.6",
        ),
        ("name: two", "name: two\nsteps: [land]", "two.yaml: steps: found beside vehicles"),
        ("  - {start", "  - {name: a, start", "two.yaml: vehicles.1.name: found 'a' twice"),
        ("vehicles:\n", "vehicles: 3\nother:\n", "two.yaml: vehicles: expected a list of 1 to 32"),
        ("name: two", "name: &x two\nnick: *x", "two.yaml: line 2: found a YAML alias"),
    ],
)
def test_a_mistake_in_a_mission_of_several_is_named(found: str, instead: str, problem: str) -> None:
    with pytest.raises(MissionError) as caught:
        split(TWO.replace(found, instead).encode(), "two.yaml")
    assert str(caught.value).startswith(problem)


# ---- flights --------------------------------------------------------------------------------------------------------


def test_two_that_swap_places_fly_round_each_other_and_alone_they_would_meet(tmp_path: Path) -> None:
    document = yaml.safe_load(TWO)
    parts = split(yaml.safe_dump(document).encode(), "two.yaml")
    assert fly_many(parts, seed=3, share=False).separation_m < 0.6
    result = fly_many(parts, seed=3, record=tmp_path)
    assert all(v.phase == "done" and not v.failure for v in result.verdicts)
    assert result.separation_m > 0.6
    for file in sorted(tmp_path.iterdir()):
        again = rerun(Recording(file))
        assert again.comparison.first is None, again.comparison


def test_a_mission_of_several_is_simulated_and_told_as_one_object(tmp_path: Path) -> None:
    (tmp_path / "two.yaml").write_text(TWO)
    parts = ["--record", str(tmp_path / "flown"), "--rotate-time", "5"]
    done = CliRunner().invoke(app, ["simulate", str(tmp_path / "two.yaml"), "--json", *parts])
    told = json.loads(done.stdout)
    assert (done.exit_code, told["ok"], [v["vehicle"] for v in told["vehicles"]]) == (0, True, ["a", "2"])
    assert told["separation_m"] > 0.6
    flown = [Recording.open(tmp_path / "flown" / name) for name in ("1.mcap", "2.mcap")]
    assert all(len(recording.paths) > 2 and recording.complete for recording in flown)
    assert all(b"MC_ROLL_P" in recording.attachments["vehicle.params"].data for recording in flown)


def test_one_companion_does_not_fly_several_vehicles(tmp_path: Path) -> None:
    (tmp_path / "two.yaml").write_text(TWO)
    done = CliRunner().invoke(app, ["fly", str(tmp_path / "two.yaml"), "--master", "udpin:127.0.0.1:1"])
    assert done.exit_code == 2
    assert "--master: found with" in done.output


@pytest.mark.slow
def test_eight_on_a_circle_of_10_m_swap_places_without_coming_near() -> None:
    result = fly_many(swap(1, 8, 10.0), seed=100)
    assert [v.phase for v in result.verdicts] == ["done"] * 8
    assert result.separation_m > 0.6
