"""The table of failsafes, the fence's geometry and the course, each by itself."""

import math
import re
from pathlib import Path

import numpy as np
import pytest

from fakevehicle import course, failsafes, fence
from fakevehicle.course import Course
from fakevehicle.failsafes import EVENTS, RULES, Action, Failsafes, Trigger, Tripped, battery_triggers
from fakevehicle.fence import Breach, FenceMonitor
from fakevehicle.geodesy import to_geodetic
from fakevehicle.modes import Mode
from fakevehicle.params import ParameterSet
from fakevehicle.places import Places
from fakevehicle.plans import COMMANDS, Kind, PlanItem, PlanStore
from fakevehicle.vocabulary import Geodetic, Glance

ORIGIN = Geodetic(math.radians(47.4), math.radians(8.5), 488.0)


def values(**changed: float) -> ParameterSet:
    return ParameterSet((*failsafes.PARAMETERS, *fence.PARAMETERS, *course.PARAMETERS), changed)


# Failsafes


@pytest.mark.parametrize("trigger", Trigger)
def test_every_trigger_has_a_rule_whose_values_its_parameter_allows(trigger: Trigger) -> None:
    rule, parameters = RULES[trigger], values()
    if rule.parameter:
        described = parameters.describe(rule.parameter)
        assert all(described.minimum <= value <= described.maximum for value in rule.actions)
    else:
        assert list(rule.actions) == [0]


def test_every_action_that_is_a_mode_has_an_event() -> None:
    assert set(EVENTS) == {Action.HOLD, Action.RETURN, Action.LAND}


@pytest.mark.parametrize(
    ("name", "value", "trigger", "action"),
    [
        ("COM_OBL_RC_ACT", 3, Trigger.STREAM_LOST, Action.RETURN),
        ("COM_OBL_RC_ACT", 4, Trigger.STREAM_LOST, Action.LAND),
        ("COM_OBL_RC_ACT", 5, Trigger.STREAM_LOST, Action.HOLD),
        ("NAV_DLL_ACT", 0, Trigger.LINK_LOST, Action.NOTHING),
        ("NAV_DLL_ACT", 2, Trigger.LINK_LOST, Action.RETURN),
        ("NAV_DLL_ACT", 6, Trigger.LINK_LOST, Action.MOTORS_OFF),
        ("COM_LOW_BAT_ACT", 0, Trigger.BATTERY_EMERGENCY, Action.WARN),
        ("COM_LOW_BAT_ACT", 2, Trigger.BATTERY_CRITICAL, Action.LAND),
        ("COM_LOW_BAT_ACT", 3, Trigger.BATTERY_CRITICAL, Action.RETURN),
        ("COM_LOW_BAT_ACT", 3, Trigger.BATTERY_EMERGENCY, Action.LAND),
        ("GF_ACTION", 0, Trigger.FENCE_BREACHED, Action.NOTHING),
        ("GF_ACTION", 3, Trigger.FENCE_BREACHED, Action.RETURN),
        ("GF_ACTION", 4, Trigger.FENCE_BREACHED, Action.MOTORS_OFF),
        ("GF_ACTION", 5, Trigger.FENCE_BREACHED, Action.LAND),
    ],
)
def test_a_parameters_value_means_what_px4_means_by_it(name: str, value: int, trigger: Trigger, action: Action) -> None:
    assert Failsafes(values(**{name: value})).action(trigger) is action


def test_a_trigger_fires_when_it_begins_and_again_after_it_has_gone() -> None:
    watch = Failsafes(values())
    lost = [Trigger.POSITION_LOST]
    assert watch.step(lost) == [Tripped(Trigger.POSITION_LOST, Action.LAND)]
    assert watch.step(lost) == []
    assert watch.step([]) == []
    assert len(watch.step(lost)) == 1


def test_of_several_the_most_severe_comes_first_and_those_that_do_nothing_not_at_all() -> None:
    watch = Failsafes(values(GF_ACTION=3, NAV_DLL_ACT=0))
    tripped = watch.step([Trigger.LINK_LOST, Trigger.BATTERY_LOW, Trigger.FENCE_BREACHED, Trigger.POSITION_LOST])
    assert [t.action for t in tripped] == [Action.LAND, Action.RETURN, Action.WARN]


@pytest.mark.parametrize(("remaining", "count"), [(0.5, 0), (0.14, 1), (0.06, 2), (0.04, 3), (0.0, 3)])
def test_a_battery_triggers_every_threshold_it_is_below(remaining: float, count: int) -> None:
    assert len(battery_triggers(remaining, values())) == count


def test_the_page_names_every_parameter_value_item_and_command_of_the_tables() -> None:
    page = Path("docs/vehicle_autopilot.md").read_text()
    rows = {rule.parameter: rule for rule in RULES.values() if rule.parameter}
    for name, rule in rows.items():
        (row,) = [line for line in page.splitlines() if f"| {name} |" in line]
        chosen = {int(n) for n in re.findall(r"\d+", row.split("|")[4])}
        assert set(rule.actions) <= chosen, name
    for parameter in (*failsafes.PARAMETERS, *fence.PARAMETERS):
        assert parameter.name in page
    items = page[page.index("| item |") : page.index("## Failsafes")]
    assert {str(number) for number in COMMANDS[Kind.MISSION]} <= set(re.findall(r"\d+", items))
    assert all(mode.title in page for mode in Mode)


# The fence


def monitor(*items: PlanItem, **changed: float) -> FenceMonitor:
    store = PlanStore()
    store.replace(Kind.FENCE, items)
    return FenceMonitor(store, values(**changed), Places(lambda: ORIGIN, ORIGIN))


def vertices(command: int, corners: np.ndarray) -> list[PlanItem]:
    items = []
    for north, east in corners.tolist():
        place = to_geodetic(np.array([north, east, 0.0]), ORIGIN)
        where = (math.degrees(place.latitude), math.degrees(place.longitude), 0.0)
        items.append(PlanItem(command, 5, (float(len(corners)), 0.0, 0.0, 0.0, *where)))
    return items


def turns(corners: np.ndarray, point: np.ndarray) -> bool:
    """Whether a polygon winds round a point: the sum of the angles its edges are seen under."""
    to = corners - point
    angle = np.arctan2(to[:, 1], to[:, 0])
    swept = np.diff(np.append(angle, angle[0]))
    return abs(float(np.sum((swept + np.pi) % (2 * np.pi) - np.pi))) > np.pi


def test_a_polygons_inside_is_where_it_winds_round() -> None:
    rng = np.random.default_rng(3)
    for _ in range(8):
        count = int(rng.integers(3, 9))
        bearing = np.sort(rng.uniform(0, 2 * np.pi, count))
        radius = rng.uniform(5.0, 40.0, count)
        corners = np.column_stack((radius * np.cos(bearing), radius * np.sin(bearing)))
        inside, outside = monitor(*vertices(5001, corners)), monitor(*vertices(5002, corners))
        for point in rng.uniform(-40.0, 40.0, (60, 2)):
            position_n = np.array([*point, -5.0])
            kept = turns(corners, point)
            assert (inside.breach_at(position_n, np.zeros(3)) is None) is kept
            assert (outside.breach_at(position_n, np.zeros(3)) is None) is not kept


def test_all_zones_hold_together() -> None:
    hole = PlanItem(5004, 5, (5.0, 0.0, 0.0, 0.0, 47.4, 8.5, 0.0))
    square = np.array([[-20.0, -20.0], [20.0, -20.0], [20.0, 20.0], [-20.0, 20.0]])
    watch, home_n = monitor(*vertices(5001, square), hole), np.zeros(3)
    assert watch.breach_at(np.array([10.0, 0.0, -5.0]), home_n) is None
    assert watch.breach_at(np.array([3.0, 0.0, -5.0]), home_n) is Breach.BOUNDARY
    assert watch.breach_at(np.array([25.0, 0.0, -5.0]), home_n) is Breach.BOUNDARY


def test_a_breach_is_counted_once_and_ends() -> None:
    watch, home_n = monitor(GF_MAX_HOR_DIST=10.0, GF_MAX_VER_DIST=8.0), np.array([1.0, 0.0, 2.0])
    assert watch.present
    steps = [(0.0, -5.0), (12.0, -5.0), (13.0, -5.0), (0.0, -5.0), (0.0, -6.5)]
    seen = [watch.step(20_000 * i, np.array([north, 0.0, down]), home_n) for i, (north, down) in enumerate(steps)]
    assert seen == [None, Breach.BOUNDARY, Breach.BOUNDARY, None, Breach.CEILING]
    assert (watch.breaches, watch.since_us) == (2, 80_000)


def test_without_any_fence_every_place_is_kept() -> None:
    watch = monitor()
    assert not watch.present
    assert watch.breach_at(np.array([1e6, 0.0, -1e6]), np.zeros(3)) is None


# The course


def glance(*, x: float = 0.0, vx: float = 0.0, z: float = -5.0, yaw: float = 0.0, known: bool = True) -> Glance:
    return Glance(0, x, 0.0, z, vx, 0.0, 0.0, yaw, 0.6, True, known, known, True, 0)


def test_it_stops_where_braking_ends() -> None:
    way = Course(values(MPC_ACC_HOR=2.0))
    way.stop(glance(x=1.0, vx=4.0), moving=True)
    np.testing.assert_allclose(way.setpoint(0).position_n, [1.0 + 4.0**2 / (2 * 2.0), 0.0, -5.0])
    way.stop(glance(x=1.0, vx=4.0), moving=False)
    np.testing.assert_allclose(way.setpoint(0).position_n, [1.0, 0.0, -5.0])


def test_it_says_the_same_object_while_nothing_changes() -> None:
    way = Course(values())
    way.stop(glance(), moving=True)
    assert way.setpoint(0) is way.setpoint(4_000)
    way.leg_to(4_000, np.array([10.0, 0.0, -5.0]))
    assert way.setpoint(1_000_000) is not way.setpoint(1_004_000)
    assert way.setpoint(60_000_000) is way.setpoint(60_004_000)


@pytest.mark.parametrize(("wanted", "by"), [(90.0, 90.0), (-90.0, -90.0), (190.0, -170.0)])
def test_the_nose_turns_the_shorter_way_at_its_rate(wanted: float, by: float) -> None:
    way = Course(values(MPC_YAWRAUTO_MAX=30.0))
    way.stop(glance(), moving=False)
    way.turn_to(0, math.radians(wanted))
    assert way.yaw(1_000_000) == pytest.approx(math.copysign(math.radians(30.0), by))
    assert math.remainder(way.yaw(7_000_000) - math.radians(wanted), 2 * math.pi) == pytest.approx(0.0, abs=1e-9)


def test_a_leg_keeps_every_speed_it_is_told() -> None:
    def top_speed(way: Course, end_n: list[float]) -> np.ndarray:
        way.stop(glance(z=0.0), moving=False)
        way.leg_to(0, np.array(end_n))
        return np.max([np.abs(way.setpoint(t).velocity_n) for t in range(0, 60_000_000, 100_000)], axis=0)

    way = Course(values(MPC_XY_CRUISE=6.0, MPC_Z_V_AUTO_UP=2.0, MPC_Z_V_AUTO_DN=1.0))
    np.testing.assert_allclose(top_speed(way, [60.0, 0.0, 0.0]), [6.0, 0.0, 0.0], atol=1e-9)
    assert top_speed(way, [0.0, 0.0, -30.0])[2] == pytest.approx(2.0)
    assert top_speed(way, [10.0, 0.0, 20.0])[2] == pytest.approx(1.0)
    way.cruise = 2.5
    assert top_speed(way, [60.0, 0.0, 0.0])[0] == pytest.approx(2.5)


def test_a_descent_without_a_position_stands_still_by_velocity() -> None:
    way = Course(values())
    way.stop(glance(), moving=False)
    blind = way.descend(0, glance(known=False), 0.0)
    assert np.isnan(blind.position_n).all()
    np.testing.assert_array_equal(blind.velocity_n[:2], 0.0)
    assert blind.velocity_n[2] > 0.0
