"""Plan files of ground stations: what they say is flown, what is not flown is refused by name, all else is kept."""

import json
import math
import random
from contextlib import suppress

import pytest
import yaml
from pymavlink import mavwp

from companion.cli.convert import convert_mission, converted
from companion.errors import MissionError
from companion.geodesy import Geodetic
from companion.missionfile import parse_mission
from companion.planfiles import is_plan_file, read
from companion.planfiles.items import Item, ItemFlaw
from companion.planfiles.reading import READERS, to_steps
from companion.planfiles.writing import from_steps
from logs.errors import RecordingError

HOME = [47.397742, 8.545594, 488.0]


def simple(command, *params, frame=3, **more):
    return {
        "AMSLAltAboveTerrain": None,
        "Altitude": 10,
        "autoContinue": True,
        "command": command,
        "doJumpId": 1,
        "frame": frame,
        "params": list(params),
        "type": "SimpleItem",
        **more,
    }


def plan(*items, fence=None, **more):
    """A `.plan` as the format's page describes it, and a key it does not know."""
    document = {
        "fileType": "Plan",
        "geoFence": fence or {"circles": [], "polygons": [], "version": 2},
        "groundStation": "QGroundControl",
        "mission": {
            "cruiseSpeed": 15,
            "firmwareType": 12,
            "globalPlanAltitudeMode": 1,
            "hoverSpeed": 4,
            "items": list(items),
            "plannedHomePosition": HOME,
            "vehicleType": 2,
            "version": 2,
        },
        "rallyPoints": {"points": [[47.4, 8.5, 50]], "version": 2},
        "version": 1,
        "somebodysOwn": {"keep": ["me", 1.5, None]},
        **more,
    }
    return json.dumps(document, indent=4) + "\n"


SURVEYED = (
    simple(22, 0, 0, 0, None, 47.397742, 8.545594, 10),
    simple(178, 1, 2.5, -1, 0, 0, 0, 0, frame=2),
    simple(16, 3, 0, 0, None, 47.3979, 8.5458, 12, myNote="the barn"),
    simple(18, 2, 0, -5, 1, 47.3980, 8.5460, 12),
    simple(115, 90, 30, 0, 0, 0, 0, 0, frame=2),
    simple(20, 0, 0, 0, 0, 0, 0, 0, frame=2),
)
WPL = """\
QGC WPL 110
0\t1\t0\t16\t0.000000\t0.000000\t0.000000\t0.000000\t47.397742\t8.545594\t488.000000\t1
1\t0\t3\t22\t0.000000\t0.000000\t0.000000\t0.000000\t47.397742\t8.545594\t10.000000\t1
2\t0\t3\t82\t0.000000\t0.000000\t0.000000\t0.000000\t47.397800\t8.545700\t10.000000\t1
3\t0\t3\t16\t0.000000\t0.000000\t0.000000\t0.000000\t47.397900\t8.545800\t12.000000\t1
4\t0\t0\t19\t4.000000\t0.000000\t0.000000\t0.000000\t47.397900\t8.545900\t500.000000\t1
5\t0\t3\t21\t0.000000\t0.000000\t0.000000\t0.000000\t47.397950\t8.545900\t0.000000\t1
"""


def steps(mission):
    return [(s.kind, s.speed) for s in mission.steps]


def test_a_plan_of_qgroundcontrol_becomes_a_mission_that_begins_where_the_vehicle_is_found():
    mission = parse_mission(plan(*SURVEYED).encode(), "barn.plan")
    assert steps(mission) == [
        ("takeoff", None),
        ("goto", 2.5),
        ("hold", None),
        ("orbit", 2.5),
        ("yaw", None),
        ("return", 2.5),
    ]
    goto, orbit = mission.steps[1].goto, mission.steps[3].orbit
    metres = 6_371_000 * math.pi / 180  # a sphere is good to 0.5 %
    assert goto.north == pytest.approx((47.3979 - HOME[0]) * metres, rel=0.005)
    assert goto.east == pytest.approx((8.5458 - HOME[1]) * metres * math.cos(math.radians(HOME[0])), rel=0.005)
    assert (goto.altitude, orbit.radius, orbit.turns, orbit.clockwise) == (12, 5, 2, False)
    assert (mission.name, mission.limits.speed, mission.vehicle.start.anywhere) == ("barn", 4, True)
    assert mission.world.bounds.north.low <= -50


def test_a_wpl_file_counts_altitudes_from_home_or_from_the_sea_as_each_frame_says():
    mission = parse_mission(WPL.encode(), "w.waypoints")
    assert [s.kind for s in mission.steps] == ["takeoff", "via", "goto", "goto", "hold", "goto", "land"]
    assert [s.goto.altitude for s in mission.steps if s.goto] == [12, 12, 12]
    assert mission.origin.altitude == 488


def test_what_a_plan_has_beside_our_items_comes_back_byte_for_byte():
    text = plan(*SURVEYED, fence={"circles": [], "polygons": [], "version": 2, "params": [1]})
    again, unsaid = converted(text.encode(), "barn.plan", ".plan")
    assert again == text
    assert unsaid == []


def test_a_wpl_file_written_by_pymavlink_is_read_and_one_of_ours_is_read_by_pymavlink(tmp_path):
    theirs, ours = tmp_path / "theirs.waypoints", tmp_path / "ours.waypoints"
    theirs.write_text(WPL)
    loader = mavwp.MAVWPLoader()
    loader.load(str(theirs))
    loader.save(str(theirs))
    text, _ = converted(theirs.read_bytes(), "theirs.waypoints", ".waypoints")
    ours.write_text(text)
    again = mavwp.MAVWPLoader()
    again.load(str(ours))
    assert [str(w) for w in again.wpoints] == [str(w) for w in loader.wpoints]


FLOWN = """\
name: round trip
origin: {latitude: 47.397742, longitude: 8.545594, altitude: 488}
vehicle: {start: {north: 0, east: 0}}
world: {bounds: {north: [-60, 90], east: [-60, 90], altitude: [0, 40]}}
fence: {include: [{circle: {north: 10, east: 10, radius: 60}}], exclude: [{corners: [{north: 50, east: 0},
  {north: 55, east: 0}, {north: 55, east: 5}]}]}
steps:
  - takeoff: {altitude: 10}
  - via: [{north: 8, east: 1.5, altitude: 11}]
  - goto: {north: 10, east: 20, altitude: 12}
    speed: 2
  - orbit: {latitude: 47.39801, longitude: 8.54587, altitude: 12, radius: 4, turns: 1.5, clockwise: false}
  - yaw: {heading_deg: 90, rate_deg: 30}
  - hold: {seconds: 2.5}
  - wait: {for: order}
  - goto: {north: 2, east: 2, altitude: 5}
  - land
"""


@pytest.mark.parametrize("ending", [".plan", ".waypoints"])
def test_a_mission_comes_back_from_either_format_within_a_millimetre(ending):
    before = parse_mission(FLOWN.encode(), "round trip.yaml")
    text, _ = converted(FLOWN.encode(), "round trip.yaml", ending)
    back, _ = converted(text.encode(), f"round trip{ending}", ".yaml")
    after = parse_mission(back.encode(), "back.yaml")
    kinds = [s.kind for s in after.steps]
    assert [k for k in kinds if k != "goto"] == [s.kind for s in before.steps if s.kind != "goto"]
    for kind in ("goto", "orbit"):
        places = [[getattr(s, kind) for s in m.steps if getattr(s, kind)] for m in (before, after)]
        ends = [{(round(p.north, 3), round(p.east, 3), p.altitude) for p in found} for found in places]
        assert ends[0] <= ends[1]  # a wait for an order names the place where it waits
    assert [s.hold for s in after.steps if s.hold] == [s.hold for s in before.steps if s.hold]
    assert [s.yaw for s in after.steps if s.yaw] == [s.yaw for s in before.steps if s.yaw]
    assert after.steps[2].speed == 2
    assert after.origin == before.origin
    if ending == ".plan":
        assert after.geofence().inside((10, 10, -5)) == pytest.approx(before.geofence().inside((10, 10, -5)), abs=0.1)
        assert after.geofence().inside((52, 1, -5)) < 0


def test_what_a_format_cannot_say_is_told():
    told = FLOWN.replace("    speed: 2", "    speed: 2\n    clearance: 1").replace("exclude:", "ceiling: 30, exclude:")
    _, unsaid = converted(told.encode(), "m.yaml", ".plan")
    assert unsaid == ["steps.2.clearance", "fence.ceiling"]
    _, unsaid = converted(told.encode(), "m.yaml", ".waypoints")
    assert "fence" in unsaid
    with pytest.raises(MissionError, match=r"steps\.6: found the step wait, which no plan item says"):
        converted(FLOWN.replace("for: order", "for: battery above, percent: 20").encode(), "m.yaml", ".plan")
    no_origin = "\n".join(line for line in FLOWN.splitlines() if not line.startswith(("origin", "  - orbit")))
    with pytest.raises(MissionError, match="origin: found nothing"):
        converted(no_origin.encode(), "m.yaml", ".plan")


@pytest.mark.parametrize(
    ("item", "words"),
    [
        (simple(183, 1, 1500, 0, 0, 0, 0, 0, frame=2), "item 1: MAV_CMD_DO_SET_SERVO (183) is not flown"),
        (simple(177, 1, 2, 0, 0, 0, 0, 0, frame=2), "item 1: MAV_CMD_DO_JUMP (177) is not flown"),
        (simple(16, 0, 0, 0, None, 47.4, 8.5, 10, frame=10), "found frame MAV_FRAME_GLOBAL_TERRAIN_ALT (10)"),
        (simple(16, 0, 0, 0, None, None, None, 10), "found no place"),
        (simple(16, 0, 0, 7, None, 47.4, 8.5, 10), "found pass radius 7, expected none"),
        (simple(18, 2, 0, None, 1, 47.4, 8.5, 10), "found 2 turns of radius nan m"),
        (simple(115, 90, 30, 0, 1, 0, 0, 0, frame=2), "found relative angle 1"),
        (simple(178, 3, 2, -1, 0, 0, 0, 0, frame=2), "found speed type 3"),
        (simple(16, 0, 0, 0, None, 147.4, 8.5, 10), "latitude 147.4"),
        (simple(16, 0, 0, 0, None, 47.4, 8.5, 0), "found altitude 0 m above home"),
        (simple(16, 0, 0, 0, None, 47.4, 8.5, 488, frame=0), "found altitude 0 m above home"),
        (simple(16, 0, 0, 0, None, 47.4, 8.5, 10, frame=2), "found frame MAV_FRAME_MISSION (2)"),
        (simple(21, 0, 2, 0, 0, 0, 0, 0), "found a precision landing"),
        (simple(178, 1, None, -1, 0, 0, 0, 0, frame=2), "found nan m/s"),
        (simple(19, None, 0, 0, 0, 47.4, None, 9), "found no place"),
        (simple(93, -1, 13, 30, 0, 0, 0, 0, frame=2), "found a time of day"),
    ],
)
def test_an_item_that_is_not_flown_is_refused_by_its_number_and_name(item, words):
    with pytest.raises(MissionError) as caught:
        parse_mission(plan(SURVEYED[0], item).encode(), "x.plan")
    assert words in str(caught.value)
    assert str(caught.value).startswith("x.plan: item 1: ")
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("kind", ["survey", "CorridorScan", "StructureScan", "fwLandingPattern"])
def test_a_pattern_is_refused_by_its_name(kind):
    pattern = {"type": "ComplexItem", "complexItemType": kind, "version": 5, "TransectStyleComplexItem": {"Items": []}}
    with pytest.raises(MissionError, match=rf"mission\.items\.1: found ComplexItem '{kind}', which is not flown"):
        parse_mission(plan(SURVEYED[0], pattern).encode(), "x.plan")


def test_latitude_and_longitude_0_are_where_the_item_before_is_as_ardupilot_has_it():
    text = """\
QGC WPL 110
0\t1\t0\t16\t0\t0\t0\t0\t-35.363262\t149.165237\t584.059998\t1
1\t0\t3\t22\t0.00\t0.00\t0.00\t0.00\t0.00\t0.00\t20.000000\t1
2\t0\t3\t18\t1.00\t0.00\t5.00\t0.00\t0.00\t0.00\t0.000000\t1
3\t0\t3\t16\t0.00\t0.00\t0.00\t0.00\t-35.36249980\t149.16512400\t25.000000\t1
4\t0\t3\t19\t3.00\t0.00\t5.00\t0.00\t0.00\t0.00\t0.000000\t1
5\t0\t3\t16\t0.00\t0.00\t0.00\t0.00\t0.00\t0.00\t30.000000\t1
6\t0\t3\t21\t0.00\t0.00\t0.00\t0.00\t0.00\t0.00\t0.000000\t1
"""
    mission = parse_mission(text.encode(), "loiter.txt")
    assert [s.kind for s in mission.steps] == ["takeoff", "orbit", "goto", "goto", "hold", "goto", "land"]
    orbit, (first, again, higher) = mission.steps[1].orbit, [s.goto for s in mission.steps if s.goto]
    assert (orbit.north, orbit.east, orbit.altitude) == (0, 0, 20)
    assert (again.north, again.east, again.altitude) == (first.north, first.east, first.altitude)
    assert (higher.north, higher.east, higher.altitude) == (first.north, first.east, 30)


def test_a_home_that_was_never_set_is_the_first_place_of_the_file():
    unset = WPL.replace("47.397742\t8.545594\t488.000000", "0.000000\t0.000000\t0.000000", 1)
    mission = parse_mission(unset.replace("4\t0\t0\t19", "4\t0\t3\t19").encode(), "w.waypoints")
    assert mission.origin.latitude == pytest.approx(47.397742)
    assert mission.ground_plan.first == 1


def test_a_takeoff_over_terrain_is_one_over_home_and_one_in_no_frame_that_says_how_high_is_refused():
    far = simple(16, 0, 0, 0, None, 47.3979, 8.5458, 10)
    mission = parse_mission(plan(simple(22, 0, 0, 0, None, *HOME[:2], 7, frame=10), far).encode(), "x.plan")
    assert mission.steps[0].takeoff.altitude == 7
    with pytest.raises(MissionError, match=r"item 0: MAV_CMD_NAV_TAKEOFF \(22\): found frame MAV_FRAME_MISSION"):
        parse_mission(plan(simple(22, 0, 0, 0, None, *HOME[:2], 7, frame=2), far).encode(), "x.plan")


def test_an_altitude_below_home_is_flown_where_the_ground_falls_away():
    below = simple(16, 0, 0, 0, None, 47.3979, 8.5458, -12)
    mission = parse_mission(plan(SURVEYED[0], below).encode(), "x.plan")
    assert mission.steps[1].goto.altitude == -12
    assert mission.world.bounds.altitude.low <= -12


def test_a_file_is_written_again_byte_for_byte_however_its_numbers_look():
    odd = plan(*SURVEYED).replace("8.5458", "8.54580000").replace("[]", "[\n            ]")
    assert converted(odd.encode(), "x.plan", ".plan")[0] == odd
    assert converted(WPL.encode(), "x.waypoints", ".waypoints")[0] == WPL


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('{"fileType": "Plan"', "line 1: not JSON"),
        ('{"fileType": "Other", "mission": {}}', "expected 'Plan'"),
        ('{"fileType": "Plan", "mission": 3}', "mission: found 3, expected an object"),
        ('{"fileType": "Plan", "fileType": "Plan", "mission": {}}', "'fileType': found twice in one object"),
        (plan(*SURVEYED).replace('"hoverSpeed": 4', '"hoverSpeed": -4'), "mission.hoverSpeed: found -4, expected 0.1"),
        (
            plan({**SURVEYED[0], "params": [0, 0, 0, 10**400, 1, 2, 3]}),
            "found a number beyond all bounds as the 4., expected seven",
        ),
        ('{"fileType": "Plan", "mission": {"items": 3}}', "mission.items: expected a list"),
        ('{"fileType": "Plan", "x": ' + "[" * 5000 + "]" * 5000 + "}", "levels of nesting"),
        (plan(*SURVEYED, mission={"items": [], "plannedHomePosition": [1, 2]}), "mission.plannedHomePosition"),
        (plan({**SURVEYED[0], "params": [1, 2]}), "params: expected seven numbers or null"),
        (plan({**SURVEYED[0], "command": "22"}), "expected whole numbers"),
        (plan(), "found no place to go to"),
        ("QGC WPL 100\n", "expected 'QGC WPL 110'"),
        ("QGC WPL 110\n", "found no items"),
        (WPL.replace("\t12.000000", ""), "line 5: found 11 columns, expected 12"),
        (WPL.replace("3\t0\t3\t16", "3\t0\t3\tx"), "line 5: found a word, expected whole numbers"),
        (WPL.replace("3\t0\t3\t16", "7\t0\t3\t16"), "line 5: found index 7, expected 3"),
        (WPL.replace("3\t0\t3\t16", "3\t0\t3\t70000"), "line 5: found a number too large for a command"),
        (WPL.replace("47.397900\t8.545800", "nan\t8.545800"), "line 5: found a negative or infinite number"),
    ],
)
def test_a_file_that_is_no_plan_is_refused_in_one_clear_line(text, words):
    with pytest.raises(MissionError) as caught:
        parse_mission(text.encode(), "x.plan")
    assert words in caught.value.problems[0]


def test_the_fence_of_a_plan_is_the_missions_and_a_place_beyond_it_is_refused():
    def fence(radius):
        return {"circles": [{"circle": {"center": HOME[:2], "radius": radius}, "inclusion": True}], "polygons": []}

    mission = parse_mission(plan(*SURVEYED, fence=fence(200)).encode(), "x.plan")
    assert mission.geofence().inside((0, 0, -5)) == pytest.approx(200, rel=0.001)
    with pytest.raises(MissionError, match=r"steps\.1\.goto: found a place .* m outside the fence"):
        parse_mission(plan(*SURVEYED, fence=fence(15)).encode(), "x.plan")
    two = fence(200)  # of two areas to stay in both hold: autopilots differ, and this is the stricter reading
    two["circles"] += fence(15)["circles"]
    with pytest.raises(MissionError, match=r"item 2: steps\.1\.goto: found a place .* m outside the fence"):
        parse_mission(plan(*SURVEYED, fence=two).encode(), "x.plan")


def test_a_plan_without_a_takeoff_climbs_first_and_one_without_a_landing_lands_last():
    items = [Item(16, 3, (0, 0, 0, math.nan, 47.3979, 8.5458, 7.0))]
    found = to_steps(items, 488.0)
    assert [next(iter(s)) for s in found] == ["takeoff", "goto", "land"]
    assert found[0]["takeoff"]["altitude"] == 7.0


def test_every_item_that_a_mission_is_written_as_is_one_that_is_read():
    mission = parse_mission(FLOWN.encode(), "m.yaml")
    items, _ = from_steps(mission.steps, Geodetic(*HOME), (0, 0))
    assert {item.command for item in items} <= set(READERS)


@pytest.mark.parametrize("command", sorted(READERS))
def test_an_item_of_any_kind_with_nothing_in_it_is_read_or_refused(command):
    for frame in (0, 1, 2, 3, 10, 200):
        for number in (0.0, math.nan, -1.0, 1e30, math.inf):
            with suppress(ItemFlaw):  # any other exception is a fault
                assert to_steps([Item(command, frame, (number,) * 7)], 0.0)


def test_a_file_is_known_by_its_content_not_by_its_name():
    assert is_plan_file(plan(*SURVEYED).encode())
    assert is_plan_file(WPL.encode())
    assert not is_plan_file(b"{name: a mission in flow style}")
    assert read(b"\xef\xbb\xbf" + plan(*SURVEYED).encode(), "x").home == Geodetic(*HOME)
    assert yaml.safe_load(converted(WPL.encode(), "w.waypoints", ".yaml")[0])["name"] == "w"


ODD = [None, True, -1, math.inf, math.nan, "x", [], {}, [1, 2], 1e30, 0, 2**70, 10**400, {"a": 1}, 178, -0.0, "\x00"]


def _broken_values(dice):
    fence = {
        "circles": [{"circle": {"center": HOME[:2], "radius": 200}, "inclusion": True}],
        "polygons": [{"polygon": [[47.39, 8.5], [47.39, 8.51], [47.4, 8.5]], "inclusion": False}],
    }
    document = json.loads(plan(*SURVEYED, fence=fence))
    for _ in range(dice.choice((1, 1, 2, 4))):
        places = [(o, k) for o in _inside(document) for k in (o if isinstance(o, dict) else range(len(o)))]
        holder, key = dice.choice(places)
        holder[key] = dice.choice(ODD)
    return json.dumps(document).encode(), "x.plan"


def _broken_bytes(dice, text, name):
    data = bytearray(text.encode())
    for _ in range(dice.choice((1, 3, 10))):
        at, what, some = dice.randrange(len(data)), dice.random(), dice.randrange(1, 40)
        if what < 0.4:
            data[at] = dice.choice(b"0123456789.-+eE\t\n NaInf#{}[]\x00\xff")
        elif what < 0.7:
            del data[at : at + some]
        else:
            data[at:at] = data[dice.randrange(len(data)) :][:some]
    return bytes(data), name


def test_of_2000_damaged_files_each_is_read_or_refused_in_clear_lines_and_nothing_else_happens():
    dice = random.Random(1)
    text, refused, lines = plan(*SURVEYED), 0, []
    for number in range(2000):
        data, name = (
            _broken_values(dice),
            _broken_bytes(dice, text, "x.plan"),
            _broken_bytes(dice, WPL, "x.waypoints"),
        )[number % 3]
        try:
            parse_mission(data, name)
        except MissionError as error:
            refused += 1
            lines += error.problems
            continue
        for ending in (
            (".plan", ".waypoints", ".yaml") if number % 4 == 0 else ()
        ):  # what is flown is written, and what is written is flown
            try:
                again, _ = converted(data, name, ending)
            except MissionError as error:
                raise AssertionError(data) from error
            parse_mission(again.encode(), f"again{ending}")
    assert 1000 < refused < 1950
    assert [line for line in lines if not (0 < len(line) <= 200 and line.isprintable())] == []


def _inside(value):
    """Every list and object of a document."""
    if isinstance(value, dict | list):
        yield value
        for inner in value.values() if isinstance(value, dict) else value:
            yield from _inside(inner)


def test_a_conversion_replaces_nothing_unasked_and_says_what_is_lost_as_json_too(tmp_path, capsys):
    source, target = tmp_path / "barn.yaml", tmp_path / "barn.plan"
    source.write_text(FLOWN, encoding="utf-8")
    assert convert_mission(source, target, force=False, as_json=True) == 0
    told = json.loads(capsys.readouterr().out)
    assert (told["ok"], told["path"]) == (True, str(target))
    assert json.loads(target.read_text())["fileType"] == "Plan"
    with pytest.raises(RecordingError, match="is there already; --force replaces it"):
        convert_mission(source, target, force=False, as_json=True)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["barn.plan", "barn.yaml"]
