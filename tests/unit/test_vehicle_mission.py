"""Plans up and down, missions, fences and failsafes: told on the wire, flown by a point that follows its setpoint."""

import math
from typing import Any

import numpy as np
import pytest
from flight_double import PointMass
from vehicle_pilot import ACCEPTED, DENIED, HOLD, LAND, NAN, OFFBOARD, REJECTED, RTL, UNSUPPORTED, Pilot, position

import fakevehicle.vehicle
from fakevehicle.config import LinkConfig, VehicleConfig
from fakevehicle.plans import Kind, PlanItem, PlanStore, item_flaw, plan_flaw
from fakevehicle.vehicle import Vehicle
from wire.dialect import mavlink

m = mavlink
MISSION = (4, 4)
LATITUDE, LONGITUDE = 47.397742, 8.545594
"""Where the vehicle stands [deg]."""
NORTH, EAST = 1.0 / 111_180.0, 1.0 / 75_500.0
"""A metre in degrees there, to a thousandth."""


@pytest.fixture
def pilot(monkeypatch: pytest.MonkeyPatch) -> Pilot:
    """On the onboard link of a vehicle that knows where it is and stands disarmed."""
    monkeypatch.setattr(fakevehicle.vehicle, "FlightStack", PointMass)
    pilot = Pilot(Vehicle(VehicleConfig(links=(LinkConfig("onboard", "gcs"),))))
    pilot.run(1.0)
    return pilot


def point(pilot: Pilot) -> PointMass:
    stack = pilot.vehicle._stack
    assert isinstance(stack, PointMass)
    return stack


def airborne(pilot: Pilot) -> Pilot:
    assert pilot.command(400, 1) == ACCEPTED
    assert pilot.command(22, NAN, NAN, NAN, NAN, NAN, NAN, NAN) == ACCEPTED
    pilot.until(lambda: pilot.mode == HOLD, 10)
    return pilot


def item(
    seq: int, command: int, north: float = 0.0, east: float = 0.0, up: float = 0.0, *, frame: int = 6, **more: Any
) -> Any:
    """A MISSION_ITEM_INT; a place is metres from home."""
    p = [more.get(f"p{i}", 0.0) for i in (1, 2, 3)] + [more.get("yaw", NAN)]
    placed = frame in (0, 3, 5, 6)
    x = round((LATITUDE + north * NORTH) * 1e7) if placed else 0
    y = round((LONGITUDE + east * EAST) * 1e7) if placed else 0
    kind = more.get("kind", 0)
    return m.MAVLink_mission_item_int_message(1, 1, seq, frame, command, 0, 1, *p, x, y, up, kind)


def waypoint(seq: int, north: float, east: float, up: float, **more: Any) -> Any:
    return item(seq, m.MAV_CMD_NAV_WAYPOINT, north, east, up, **more)


def upload(pilot: Pilot, items: list[Any], kind: int = 0) -> int:
    """Play a client that sends what it is asked for; the result of the MISSION_ACK."""
    pilot.send(m.MAVLink_mission_count_message(1, 1, len(items), kind))
    for _ in range(len(items) + 2):
        heard = pilot.tick()
        acks = [h for h in heard if h.get_type() == "MISSION_ACK"]
        if acks:
            assert acks[0].mission_type == kind
            pilot.tick(5)  # progress is looked at 50 times a second
            return int(acks[0].type)
        (request,) = [h for h in heard if h.get_type() == "MISSION_REQUEST_INT"]
        assert request.mission_type == kind
        pilot.send(items[request.seq])
    raise AssertionError("never acknowledged")


def download(pilot: Pilot, kind: int = 0) -> list[Any]:
    pilot.send(m.MAVLink_mission_request_list_message(1, 1, kind))
    pilot.tick()
    items = []
    for seq in range(pilot.last("MISSION_COUNT").count):
        pilot.send(m.MAVLink_mission_request_int_message(1, 1, seq, kind))
        (answer,) = [h for h in pilot.tick() if h.get_type() == "MISSION_ITEM_INT"]
        items.append(answer)
    return items


def fields(message: Any) -> tuple[Any, ...]:
    """What an item says, without addresses and marks; NaN made comparable."""
    names = ("seq", "frame", "command", "param1", "param2", "param3", "param4", "x", "y", "z", "mission_type")
    return tuple("nan" if getattr(message, n) != getattr(message, n) else getattr(message, n) for n in names)


SQUARE = [
    item(0, m.MAV_CMD_NAV_TAKEOFF, up=3.0),
    waypoint(1, 10.0, 0.0, 5.0),
    waypoint(2, 10.0, 10.0, 5.0, p1=2.0),
    item(3, m.MAV_CMD_NAV_LAND, 0.0, 10.0),
]


# The protocol


def test_at_the_start_every_plan_is_empty(pilot: Pilot) -> None:
    for kind in (0, 1, 2):
        assert download(pilot, kind) == []
        assert (pilot.last("MISSION_COUNT").count, pilot.last("MISSION_COUNT").mission_type) == (0, kind)


def test_what_was_uploaded_reads_back_as_it_was_written(pilot: Pilot) -> None:
    assert upload(pilot, SQUARE) == m.MAV_MISSION_ACCEPTED
    assert [fields(i) for i in download(pilot)] == [fields(i) for i in SQUARE]


def test_the_three_plans_are_kept_apart(pilot: Pilot) -> None:
    rally = [item(0, m.MAV_CMD_NAV_RALLY_POINT, 5.0, 5.0, 10.0, kind=2, yaw=0.0)]
    circle = [item(0, m.MAV_CMD_NAV_FENCE_CIRCLE_INCLUSION, p1=50.0, kind=1, yaw=0.0)]
    assert [upload(pilot, SQUARE), upload(pilot, circle, 1), upload(pilot, rally, 2)] == [0, 0, 0]
    assert [len(download(pilot, kind)) for kind in (0, 1, 2)] == [4, 1, 1]
    pilot.send(m.MAVLink_mission_clear_all_message(1, 1, 1))
    pilot.tick()
    assert [len(download(pilot, kind)) for kind in (0, 1, 2)] == [4, 0, 1]
    pilot.send(m.MAVLink_mission_clear_all_message(1, 1, 255))
    pilot.tick()
    assert pilot.last("MISSION_ACK").type == m.MAV_MISSION_ACCEPTED
    assert [len(download(pilot, kind)) for kind in (0, 1, 2)] == [0, 0, 0]


def test_items_may_come_and_go_in_the_float_form(pilot: Pilot) -> None:
    pilot.send(m.MAVLink_mission_count_message(1, 1, 1, 0))
    pilot.tick()
    pilot.send(m.MAVLink_mission_item_message(1, 1, 0, 3, 16, 0, 1, 0, 0, 0, 0, LATITUDE, LONGITUDE, 7, 0))
    pilot.tick()
    assert pilot.last("MISSION_ACK").type == m.MAV_MISSION_ACCEPTED
    pilot.send(m.MAVLink_mission_request_message(1, 1, 0, 0))
    pilot.tick()
    answer = pilot.last("MISSION_ITEM")
    assert (answer.x, answer.y, answer.z) == pytest.approx((LATITUDE, LONGITUDE, 7.0), abs=1e-5)
    (whole,) = download(pilot)
    assert whole.x == pytest.approx(LATITUDE * 1e7, abs=40)  # a float has seven digits


def test_a_part_of_a_plan_is_replaced_by_itself(pilot: Pilot) -> None:
    assert upload(pilot, SQUARE) == 0
    pilot.send(m.MAVLink_mission_write_partial_list_message(1, 1, 1, 2, 0))
    for seq in (1, 2):
        pilot.tick()
        assert pilot.last("MISSION_REQUEST_INT").seq == seq
        pilot.send(waypoint(seq, -3.0, 4.0, 9.0))
    pilot.tick()
    assert pilot.last("MISSION_ACK").type == m.MAV_MISSION_ACCEPTED
    assert [i.z for i in download(pilot)] == [3.0, 9.0, 9.0, 0.0]


def test_an_unanswered_request_is_repeated_and_then_given_up(pilot: Pilot) -> None:
    assert upload(pilot, SQUARE[:2]) == 0
    pilot.send(m.MAVLink_mission_count_message(1, 1, 3, 0))
    heard = pilot.run(4.9)
    assert [h.seq for h in heard if h.get_type() == "MISSION_REQUEST_INT"] == [0] * 10
    heard = pilot.run(0.5)
    (ack,) = [h for h in heard if h.get_type() == "MISSION_ACK"]
    assert ack.type == m.MAV_MISSION_OPERATION_CANCELLED
    assert "timed out" in pilot.texts()[-1]
    assert len(download(pilot)) == 2  # what was there is there


def test_a_repeated_item_is_taken_once_and_a_wrong_one_refused(pilot: Pilot) -> None:
    pilot.send(m.MAVLink_mission_count_message(1, 1, 3, 0))
    pilot.tick()
    pilot.send(SQUARE[0], SQUARE[0])
    pilot.tick()
    assert pilot.of("MISSION_ACK") == []
    pilot.send(SQUARE[2])
    pilot.tick()
    assert pilot.last("MISSION_ACK").type == m.MAV_MISSION_INVALID_SEQUENCE
    pilot.send(SQUARE[1])
    pilot.tick()
    pilot.send(SQUARE[2])
    pilot.tick()
    assert pilot.last("MISSION_ACK").type == m.MAV_MISSION_ACCEPTED
    assert len(download(pilot)) == 3


def test_a_plan_comes_through_a_link_that_loses_every_second_packet(pilot: Pilot) -> None:
    """GIVEN a client that repeats what is not answered WHEN half of all is lost THEN the plan arrives whole."""
    rng = np.random.default_rng(7)
    newest: Any = m.MAVLink_mission_count_message(1, 1, len(SQUARE), 0)
    for _ in range(60):
        if rng.random() < 0.5:
            pilot.send(newest)
        heard = [h for h in pilot.run(0.3) if rng.random() < 0.5]
        if any(h.get_type() == "MISSION_ACK" and h.type == m.MAV_MISSION_ACCEPTED for h in heard):
            break
        for request in (h for h in heard if h.get_type() == "MISSION_REQUEST_INT"):
            newest = SQUARE[request.seq]
    else:
        raise AssertionError("never acknowledged")
    assert [fields(i) for i in download(pilot)] == [fields(i) for i in SQUARE]
    assert pilot.texts() == []


def test_a_second_client_waits_for_the_first(pilot: Pilot) -> None:
    other = Pilot(pilot.vehicle, peer=("127.0.0.1", 50001))
    pilot.send(m.MAVLink_mission_count_message(1, 1, 3, 0))
    pilot.tick()
    other.now_us = pilot.now_us
    other.send(m.MAVLink_mission_count_message(1, 1, 2, 0))
    other.tick()
    assert other.last("MISSION_ACK").type == m.MAV_MISSION_DENIED
    assert "another client" in other.texts()[-1]


@pytest.mark.parametrize(
    ("wrong", "result"),
    [
        (item(1, 31_000), m.MAV_MISSION_UNSUPPORTED),
        (waypoint(1, 0, 0, 5, frame=1), m.MAV_MISSION_UNSUPPORTED_FRAME),
        (waypoint(1, 0, 0, 5, p1=-1.0), m.MAV_MISSION_INVALID_PARAM1),
        (waypoint(1, 0, 0, 5, p2=-1.0), m.MAV_MISSION_INVALID_PARAM2),
        (waypoint(1, 0, 0, 20_000.0), m.MAV_MISSION_INVALID_PARAM7),
        (
            m.MAVLink_mission_item_int_message(1, 1, 1, 6, 16, 0, 1, 0, 0, 0, 0, 0, 0, 5, 0),
            m.MAV_MISSION_INVALID_PARAM5_X,
        ),
        (
            m.MAVLink_mission_item_int_message(1, 1, 1, 6, 16, 0, 1, 0, 0, 0, 0, 910_000_000, 5, 5, 0),
            m.MAV_MISSION_INVALID_PARAM5_X,
        ),
        (
            m.MAVLink_mission_item_int_message(1, 1, 1, 6, 16, 0, 1, 0, 0, 0, 0, 5, 1_900_000_000, 5, 0),
            m.MAV_MISSION_INVALID_PARAM6_Y,
        ),
        (item(1, m.MAV_CMD_DO_JUMP, frame=2, p1=7.0, p2=1.0), m.MAV_MISSION_INVALID_PARAM1),
    ],
)
def test_an_item_that_cannot_be_flown_ends_the_upload_by_its_reason(pilot: Pilot, wrong: Any, result: int) -> None:
    assert upload(pilot, [SQUARE[0], wrong]) == result
    assert pilot.texts()[-1].startswith("Plan refused")
    assert download(pilot) == []


def test_more_items_than_there_is_room_for_are_refused_at_once(pilot: Pilot) -> None:
    pilot.send(m.MAVLink_mission_count_message(1, 1, 60_000, 0))
    pilot.tick()
    assert pilot.last("MISSION_ACK").type == m.MAV_MISSION_NO_SPACE


def test_an_item_that_is_not_there_is_refused_by_its_number(pilot: Pilot) -> None:
    assert upload(pilot, SQUARE) == 0
    pilot.send(m.MAVLink_mission_request_int_message(1, 1, 4, 0))
    pilot.tick()
    assert pilot.last("MISSION_ACK").type == m.MAV_MISSION_INVALID_SEQUENCE
    assert "item 4" in pilot.texts()[-1]


def test_polygons_must_be_whole() -> None:
    def vertex(count: float, command: int = 5001) -> PlanItem:
        return PlanItem(command, 5, (count, 0.0, 0.0, 0.0, 47.0, 8.0, 0.0))

    assert plan_flaw(Kind.FENCE, [vertex(3)] * 3 + [vertex(4, 5002)] * 4) is None
    for broken in ([vertex(3)] * 2, [vertex(3)] * 4, [vertex(3), vertex(3), vertex(3, 5002)], [vertex(3.5)] * 4):
        assert plan_flaw(Kind.FENCE, broken) is not None
    assert item_flaw(Kind.FENCE, vertex(2)) is not None


def test_a_plans_identity_follows_its_content() -> None:
    store = PlanStore()
    assert store.opaque_id(Kind.MISSION) == 0
    here = PlanItem(16, 6, (0.0, 0.0, 0.0, 0.0, 47.0, 8.0, 5.0))
    there = PlanItem(16, 6, (0.0, 0.0, 0.0, 0.0, 47.0, 8.1, 5.0))
    store.replace(Kind.MISSION, [here])
    first = store.opaque_id(Kind.MISSION)
    store.replace(Kind.MISSION, [there])
    assert store.opaque_id(Kind.MISSION) not in (0, first)
    store.replace(Kind.MISSION, [here])
    assert store.opaque_id(Kind.MISSION) == first
    with pytest.raises(ValueError, match="not known"):
        store.replace(Kind.RALLY, [here])


# Missions in flight


def reached(pilot: Pilot) -> list[int]:
    """Items reached, each once."""
    return list(dict.fromkeys(message.seq for message in pilot.of("MISSION_ITEM_REACHED")))


def at(pilot: Pilot, seq: int) -> bool:
    """Whether an item is the newest that was reached."""
    newest = pilot._newest.get("MISSION_ITEM_REACHED")
    return newest is not None and newest.seq == seq


def test_a_mission_takes_off_flies_its_waypoints_and_lands(pilot: Pilot) -> None:
    assert upload(pilot, SQUARE) == 0
    assert pilot.last("MISSION_CURRENT").mission_state == 2  # not started
    assert pilot.command(400, 1) == ACCEPTED
    assert pilot.command(176, 1, 4, 4) == ACCEPTED
    assert pilot.mode == MISSION
    corners = []
    for seq in (0, 1, 2):
        pilot.until(lambda seq=seq: at(pilot, seq), 40)
        corners.append(point(pilot).p.copy())
    np.testing.assert_allclose(corners, [[0, 0, -3], [10, 0, -5], [10, 10, -5]], atol=1.1)
    assert pilot.last("MISSION_CURRENT").mission_state == 3
    pilot.until(lambda: pilot.landed_state == 4, 20)
    pilot.until(lambda: not pilot.armed, 20)
    np.testing.assert_allclose(point(pilot).p, [0, 10, 0], atol=0.5)
    assert (reached(pilot), pilot.mode) == ([0, 1, 2, 3], HOLD)
    last = pilot.last("MISSION_CURRENT")
    assert (last.seq, last.total, last.mission_state) == (3, 4, 5)


def test_mission_start_arms_by_itself_and_needs_a_mission(pilot: Pilot) -> None:
    assert pilot.command(300, 0, 0) == REJECTED
    assert "no mission" in pilot.texts()[-1]
    assert upload(pilot, SQUARE) == 0
    assert pilot.command(300, 0, 0) == ACCEPTED
    assert (pilot.armed, pilot.mode) == (True, MISSION)


def test_a_mission_that_is_held_goes_on_where_it_was(pilot: Pilot) -> None:
    assert upload(pilot, SQUARE) == 0
    assert pilot.command(300, 0, 0) == ACCEPTED
    pilot.until(lambda: at(pilot, 0), 10)
    pilot.run(1.0)
    assert pilot.command(176, 1, 4, 3) == ACCEPTED
    pilot.run(2.0)
    current = pilot.last("MISSION_CURRENT")
    assert (current.seq, current.mission_state, current.mission_mode) == (1, 4, 2)
    assert pilot.command(176, 1, 4, 4) == ACCEPTED
    pilot.until(lambda: at(pilot, 1), 10)


def test_an_end_in_the_air_is_held(pilot: Pilot) -> None:
    assert upload(pilot, [*SQUARE[:2]]) == 0
    assert pilot.command(300, 0, 0) == ACCEPTED
    pilot.until(lambda: pilot.mode == HOLD, 30)
    pilot.run(2.0)
    np.testing.assert_allclose(point(pilot).p, [10, 0, -5], atol=0.2)
    assert pilot.last("MISSION_CURRENT").mission_state == 5


def test_jumps_are_counted_and_speeds_kept(pilot: Pilot) -> None:
    plan = [
        item(0, m.MAV_CMD_DO_CHANGE_SPEED, frame=2, p1=1.0, p2=1.0),
        waypoint(1, 3.0, 0.0, 3.0),
        waypoint(2, 0.0, 0.0, 3.0),
        item(3, m.MAV_CMD_DO_JUMP, frame=2, p1=1.0, p2=2.0),
        item(4, m.MAV_CMD_NAV_RETURN_TO_LAUNCH, frame=2),
    ]
    assert upload(pilot, plan) == 0
    assert pilot.command(300, 0, 0) == ACCEPTED
    begin_us = pilot.now_us
    pilot.until(lambda: pilot.mode == RTL, 60)
    assert pilot.now_us - begin_us > 6 * 3.0e6  # six legs of three metres at 1 m/s
    order = [
        seq
        for _, link, _, h in pilot.heard
        if h.get_type() == "MISSION_ITEM_REACHED" and link == "onboard"
        for seq in [h.seq]
    ]
    assert [seq for i, seq in enumerate(order) if i == 0 or seq != order[i - 1]] == [0, 1, 2, 3, 1, 2, 3, 1, 2, 3, 4]
    pilot.until(lambda: not pilot.armed, 30)


def test_a_mission_without_a_takeoff_climbs_first(pilot: Pilot) -> None:
    assert upload(pilot, [waypoint(0, 8.0, 0.0, 1.0)]) == 0
    assert pilot.command(300, 0, 0) == ACCEPTED
    pilot.until(lambda: point(pilot).p[0] > 0.3, 20)
    assert point(pilot).p[2] < -2.0
    pilot.until(lambda: at(pilot, 0), 20)


def test_the_nose_points_along_the_way_unless_the_item_says_where(pilot: Pilot) -> None:
    assert upload(pilot, [waypoint(0, 0.0, 10.0, 5.0), waypoint(1, 0.0, 20.0, 5.0, yaw=180.0)]) == 0
    assert pilot.command(300, 0, 0) == ACCEPTED
    pilot.until(lambda: at(pilot, 0), 20)
    assert point(pilot).setpoint.yaw == pytest.approx(math.pi / 2, abs=0.01)
    pilot.until(lambda: at(pilot, 1), 20)
    assert abs(point(pilot).setpoint.yaw) == pytest.approx(math.pi, abs=0.01)


def test_the_current_item_is_set_and_a_missing_one_refused(pilot: Pilot) -> None:
    assert upload(pilot, SQUARE) == 0
    pilot.send(m.MAVLink_mission_set_current_message(1, 1, 2))
    pilot.tick()
    assert pilot.last("MISSION_CURRENT").seq == 2
    assert pilot.command(224, 1) == ACCEPTED
    assert pilot.last("MISSION_CURRENT").seq == 1
    pilot.send(m.MAVLink_mission_set_current_message(1, 1, 9))
    pilot.tick()
    assert pilot.last("MISSION_ACK").type == m.MAV_MISSION_INVALID_SEQUENCE
    assert pilot.command(224, 9) == DENIED
    assert pilot.last("MISSION_CURRENT").seq == 1


def test_a_new_mission_begins_with_its_first_item(pilot: Pilot) -> None:
    assert upload(pilot, SQUARE) == 0
    assert pilot.command(300, 0, 0) == ACCEPTED
    pilot.until(lambda: at(pilot, 1), 20)
    assert upload(pilot, [waypoint(0, -5.0, 0.0, 6.0)]) == 0
    assert pilot.last("MISSION_CURRENT").seq == 0
    pilot.until(lambda: pilot.mode == HOLD, 20)
    np.testing.assert_allclose(point(pilot).p, [-5, 0, -6], atol=1.1)


def test_arming_in_mission_mode_without_a_mission_is_refused(pilot: Pilot) -> None:
    assert upload(pilot, SQUARE) == 0
    assert pilot.command(176, 1, 4, 4) == ACCEPTED
    pilot.send(m.MAVLink_mission_clear_all_message(1, 1, 0))
    pilot.tick()
    assert pilot.command(400, 1) == REJECTED
    assert "no mission" in pilot.texts()[-1]


def test_a_guided_item_is_a_goto(pilot: Pilot) -> None:
    airborne(pilot)
    guided = m.MAVLink_mission_item_message(1, 1, 0, 3, 16, 2, 1, 0, 0, 0, 0, LATITUDE + 6 * NORTH, LONGITUDE, 4, 0)
    pilot.send(guided)
    pilot.tick()
    assert pilot.last("MISSION_ACK").type == m.MAV_MISSION_ACCEPTED
    pilot.run(8.0)
    np.testing.assert_allclose(point(pilot).p, [6, 0, -4], atol=0.5)
    assert download(pilot) == []


def test_waypoints_without_a_hold_are_passed_in_order_and_those_with_one_stopped_at(pilot: Pilot) -> None:
    plan = [
        item(0, m.MAV_CMD_NAV_TAKEOFF, up=5.0),
        waypoint(1, 12.0, 0.0, 5.0),
        item(2, m.MAV_CMD_DO_CHANGE_SPEED, frame=2, p1=1.0, p2=2.0),
        waypoint(3, 12.0, 12.0, 5.0),
        waypoint(4, 0.0, 12.0, 5.0, p1=1.5),
        waypoint(5, 0.0, 0.0, 5.0),
    ]
    assert upload(pilot, plan) == 0
    assert pilot.command(300, 0, 0) == ACCEPTED
    slowest: dict[int, float] = {}
    top = 0.0
    while pilot.mode != HOLD or not pilot.armed:
        pilot.run(0.02)
        for seq, place in ((1, (12, 0)), (3, (12, 12)), (4, (0, 12))):
            if math.dist(point(pilot).p[:2], place) < 1.0:
                asked = float(np.linalg.norm(point(pilot).setpoint.velocity_n))
                slowest[seq] = min(slowest.get(seq, 9.0), asked)
        if at(pilot, 3):
            top = max(top, float(np.linalg.norm(point(pilot).setpoint.velocity_n)))
        assert pilot.now_us < 90e6
    assert slowest[1] > 1.0  # the next leg's 2 m/s, round a right angle
    assert slowest[3] > 1.0
    assert slowest[4] == 0.0
    assert top == pytest.approx(2.0)
    assert reached(pilot) == [0, 1, 2, 3, 4, 5]
    np.testing.assert_allclose(point(pilot).p, [0, 0, -5], atol=0.2)


def test_a_waypoint_that_was_missed_is_flown_back_to(pilot: Pilot) -> None:
    plan = [item(0, m.MAV_CMD_NAV_TAKEOFF, up=5.0), waypoint(1, 15.0, 0.0, 5.0), waypoint(2, 15.0, 15.0, 5.0)]
    assert upload(pilot, plan) == 0
    assert pilot.command(300, 0, 0) == ACCEPTED
    pilot.until(lambda: point(pilot).p[0] > 10.0, 30)
    # WHEN a gust holds it off while the way goes round the corner
    for _ in range(75):
        point(pilot).p[0] = min(point(pilot).p[0], 12.0)
        pilot.tick(10)
    # THEN it is not said to be reached before the vehicle has been there
    assert not at(pilot, 1)
    pilot.until(lambda: at(pilot, 1), 20)
    assert math.dist(point(pilot).p, (15, 0, -5)) < 1.0
    pilot.until(lambda: at(pilot, 2), 20)


def test_a_held_mission_goes_on_from_the_middle_of_a_corner(pilot: Pilot) -> None:
    plan = [item(0, m.MAV_CMD_NAV_TAKEOFF, up=5.0), waypoint(1, 15.0, 0.0, 5.0), waypoint(2, 15.0, 15.0, 5.0)]
    assert upload(pilot, plan) == 0
    assert pilot.command(300, 0, 0) == ACCEPTED
    pilot.until(lambda: at(pilot, 1), 20)
    assert pilot.command(176, 1, 4, 3) == ACCEPTED
    pilot.run(3.0)
    assert np.linalg.norm(point(pilot).v) < 0.05
    assert pilot.command(176, 1, 4, 4) == ACCEPTED
    pilot.until(lambda: at(pilot, 2), 20)
    assert reached(pilot) == [0, 1, 2]


def test_turns_are_flown_with_the_nose_to_their_centre(pilot: Pilot) -> None:
    plan = [
        item(0, m.MAV_CMD_NAV_TAKEOFF, up=4.0),
        item(1, m.MAV_CMD_NAV_LOITER_TURNS, 10.0, 0.0, 6.0, p1=1.0, p3=-4.0),
        waypoint(2, 0.0, 0.0, 5.0),
    ]
    assert upload(pilot, plan) == 0
    assert pilot.command(300, 0, 0) == ACCEPTED
    pilot.until(lambda: abs(point(pilot).p[1]) > 1.0, 30)
    assert point(pilot).p[1] > 0.0  # from the south side, counter-clockwise seen from above: through the east
    bearings = []
    while not at(pilot, 1):
        pilot.run(0.1)
        north, east, down = point(pilot).p - [10.0, 0.0, 0.0]
        assert math.hypot(north, east) == pytest.approx(4.0, abs=0.5)
        assert down == pytest.approx(-6.0, abs=0.2)
        bearings.append(math.atan2(east, north))
        nose = point(pilot).setpoint.yaw
        assert abs(math.remainder(nose - math.atan2(-east, -north), 2 * math.pi)) < 0.3
        assert pilot.now_us < 60e6
    assert np.unwrap(bearings)[-1] - math.pi == pytest.approx(-2 * math.pi, abs=0.1)
    pilot.until(lambda: at(pilot, 2), 20)
    assert reached(pilot) == [0, 1, 2]


@pytest.mark.parametrize("command", [195, 201])
def test_the_nose_looks_at_a_place_until_it_is_told_not_to(pilot: Pilot, command: int) -> None:
    plan = [
        item(0, m.MAV_CMD_NAV_TAKEOFF, up=5.0),
        item(1, command, 10.0, 10.0, 0.0, p1=3.0),
        waypoint(2, 20.0, 0.0, 5.0),
        item(3, m.MAV_CMD_DO_SET_ROI_NONE, frame=2),
        waypoint(4, 20.0, 10.0, 5.0),
    ]
    assert upload(pilot, plan) == 0
    assert pilot.command(300, 0, 0) == ACCEPTED
    pilot.until(lambda: point(pilot).p[0] > 2.0, 30)
    # WHEN the mission is held and goes on THEN it still looks there
    assert pilot.command(176, 1, 4, 3) == ACCEPTED
    pilot.run(2.0)
    assert pilot.command(176, 1, 4, 4) == ACCEPTED
    pilot.until(lambda: point(pilot).p[0] > 10.0, 30)
    while point(pilot).p[0] < 18.0:
        pilot.run(0.1)
        wanted = math.atan2(10.0 - point(pilot).p[1], 10.0 - point(pilot).p[0])
        assert abs(math.remainder(point(pilot).setpoint.yaw - wanted, 2 * math.pi)) < 0.15
    # WHEN there is nothing to look at THEN the nose is along the way again
    pilot.until(lambda: at(pilot, 4), 30)
    assert point(pilot).setpoint.yaw == pytest.approx(math.pi / 2, abs=0.15)


def test_a_survey_as_ground_stations_plan_it_is_flown_and_its_camera_told_to_be_missing(pilot: Pilot) -> None:
    plan = [
        item(0, m.MAV_CMD_DO_GIMBAL_MANAGER_PITCHYAW, frame=2, p1=-90.0),
        item(1, m.MAV_CMD_NAV_TAKEOFF, up=8.0),
        waypoint(2, 10.0, 0.0, 8.0),
        item(3, m.MAV_CMD_DO_SET_CAM_TRIGG_DIST, frame=2, p1=5.0, p3=1.0),
        item(4, m.MAV_CMD_CONDITION_GATE, 10.0, 20.0, 8.0, yaw=0.0),
        item(5, m.MAV_CMD_DO_SET_CAM_TRIGG_DIST, frame=2),
        waypoint(6, 14.0, 20.0, 8.0),
        item(7, m.MAV_CMD_IMAGE_START_CAPTURE, frame=2, p2=2.0),
        waypoint(8, 14.0, 0.0, 8.0),
        item(9, m.MAV_CMD_IMAGE_STOP_CAPTURE, frame=2),
        item(10, m.MAV_CMD_DO_SET_SERVO, frame=2, p1=9.0, p2=1500.0),
        item(11, m.MAV_CMD_DO_MOUNT_CONTROL, frame=2, p1=-45.0),
        item(12, m.MAV_CMD_NAV_DELAY, frame=2, p1=1.0),
        item(13, m.MAV_CMD_NAV_RETURN_TO_LAUNCH, frame=2),
    ]
    assert upload(pilot, plan) == 0
    assert [fields(i) for i in download(pilot)] == [fields(i) for i in plan]
    assert pilot.command(300, 0, 0) == ACCEPTED
    slowest = 9.0
    while pilot.mode != RTL:
        pilot.run(0.02)
        if at(pilot, 4) or at(pilot, 6):
            slowest = min(slowest, float(np.linalg.norm(point(pilot).setpoint.velocity_n)))
        assert pilot.now_us < 60e6
    assert slowest > 0.5  # what the camera is asked for is done in passing
    assert reached(pilot) == list(range(14))
    missing = [text for text in pilot.texts() if "passed over" in text]
    assert missing == [
        "Mission items for a gimbal are passed over: there is none",
        "Mission items for a camera are passed over: there is none",
        "Mission items for a servo are passed over: there is none",
    ]


@pytest.mark.parametrize(
    ("wrong", "result"),
    [
        (item(1, m.MAV_CMD_DO_SET_ROI, 5.0, 5.0, p1=2.0), m.MAV_MISSION_INVALID_PARAM1),
        (item(1, m.MAV_CMD_DO_SET_ROI, frame=2, p1=3.0), m.MAV_MISSION_UNSUPPORTED_FRAME),
        (item(1, m.MAV_CMD_NAV_LOITER_TURNS, 5.0, 5.0, 5.0, p1=-1.0), m.MAV_MISSION_INVALID_PARAM1),
        (item(1, m.MAV_CMD_NAV_LOITER_TURNS, 5.0, 5.0, 5.0, p1=1.0, p3=2e4), m.MAV_MISSION_INVALID_PARAM3),
    ],
)
def test_turns_and_places_to_look_at_that_cannot_be_are_refused(pilot: Pilot, wrong: Any, result: int) -> None:
    assert upload(pilot, [SQUARE[0], wrong]) == result
    assert pilot.texts()[-1].startswith("Plan refused")


def test_turns_that_leave_the_fence_are_not_begun(pilot: Pilot) -> None:
    assert upload(pilot, square_fence(12.0), 1) == 0
    for radius, result in ((15.0, REJECTED), (5.0, ACCEPTED)):
        assert upload(pilot, [SQUARE[0], item(1, 18, 0.0, 0.0, 5.0, p1=1.0, p3=radius)]) == 0
        assert pilot.command(300, 0, 0) == result


# Home, return, speed


def test_home_is_where_it_is_put_and_stays_at_arming(pilot: Pilot) -> None:
    assert pilot.command(410) == ACCEPTED
    pilot.send(m.MAVLink_command_int_message(1, 1, 0, 179, 0, 0, 0, 0, 0, 0, *_e7(4.0, 3.0), 488.0))
    assert Pilot.ack(pilot.tick(), 179) == ACCEPTED
    home = pilot.last("HOME_POSITION")
    assert (home.x, home.y, home.z) == pytest.approx((4.0, 3.0, 0.0), abs=0.02)
    airborne(pilot)
    assert pilot.last("HOME_POSITION").x == pytest.approx(4.0, abs=0.02)
    assert pilot.command(20) == ACCEPTED
    pilot.until(lambda: not pilot.armed, 40)
    np.testing.assert_allclose(point(pilot).p, [4, 3, 0], atol=0.5)
    assert pilot.command(179, 1) == ACCEPTED
    assert pilot.command(179, 0, 0, 0, 0, -47.0, 8.0, 0.0) == DENIED


def _e7(north: float, east: float) -> tuple[int, int]:
    return round((LATITUDE + north * NORTH) * 1e7), round((LONGITUDE + east * EAST) * 1e7)


def test_home_that_is_not_known_is_told_by_the_result_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(fakevehicle.vehicle, "FlightStack", PointMass)
    pilot = Pilot(Vehicle(VehicleConfig(links=(LinkConfig("onboard", "gcs"),))))
    assert pilot.command(410) == 4
    assert pilot.texts() == []


def test_a_return_ends_at_the_nearest_rally_point(pilot: Pilot) -> None:
    rally = [
        item(0, m.MAV_CMD_NAV_RALLY_POINT, 30.0, 0.0, 10.0, kind=2),
        item(1, m.MAV_CMD_NAV_RALLY_POINT, -30.0, 0.0, 10.0, kind=2),
    ]
    assert upload(pilot, rally, 2) == 0
    airborne(pilot)
    pilot.send(m.MAVLink_command_int_message(1, 1, 6, 192, 0, 0, -1, 1, 0, NAN, *_e7(20.0, 0.0), 5.0))
    pilot.run(12.0)
    assert pilot.command(20) == ACCEPTED
    pilot.until(lambda: not pilot.armed, 40)
    np.testing.assert_allclose(point(pilot).p, [30, 0, 0], atol=0.5)


def test_speed_changes_hold_until_the_mode_changes(pilot: Pilot) -> None:
    assert pilot.command(178, 2, 3) == DENIED
    assert pilot.command(178, 1, 100) == DENIED
    assert upload(pilot, [waypoint(0, 40.0, 0.0, 3.0)]) == 0
    assert pilot.command(300, 0, 0) == ACCEPTED
    pilot.run(0.1)
    assert pilot.command(178, 1, 1.0, -1) == ACCEPTED
    pilot.until(lambda: point(pilot).p[0] > 3.0, 30)
    assert np.hypot(*point(pilot).v[:2]) == pytest.approx(1.0, abs=0.1)


def test_a_goto_flies_as_fast_as_it_is_told(pilot: Pilot) -> None:
    airborne(pilot)
    pilot.send(m.MAVLink_command_int_message(1, 1, 6, 192, 0, 0, 2.0, 1, 0, NAN, *_e7(30.0, 0.0), 2.5))
    assert Pilot.ack(pilot.tick(), 192) == ACCEPTED
    pilot.run(6.0)
    assert np.hypot(*point(pilot).v[:2]) == pytest.approx(2.0, abs=0.1)


# The fence, and other failsafes


def square_fence(half: float, command: int = 5001) -> list[Any]:
    corners = [(-half, -half), (half, -half), (half, half), (-half, half)]
    return [item(i, command, n, e, frame=5, p1=4.0, kind=1, yaw=0.0) for i, (n, e) in enumerate(corners)]


def test_a_breach_follows_the_parameter(pilot: Pilot) -> None:
    pilot.vehicle.parameters.set("GF_ACTION", 3)
    assert upload(pilot, square_fence(5.0), 1) == 0
    airborne(pilot)
    pilot.send(position(10, 0, -3))
    assert pilot.command(176, 1, 6) == ACCEPTED
    for _ in range(200):
        pilot.send(position(10, 0, -3))
        pilot.run(0.05)
        if pilot.mode == RTL:
            break
    assert pilot.mode == RTL
    assert "fence breached" in pilot.texts()[-1]
    status = pilot.last("FENCE_STATUS")
    assert (status.breach_status, status.breach_count, status.breach_type) == (1, 1, m.FENCE_BREACH_BOUNDARY)
    pilot.until(lambda: not pilot.armed, 30)
    np.testing.assert_allclose(point(pilot).p, [0, 0, 0], atol=0.5)
    assert pilot.last("FENCE_STATUS").breach_status == 0


@pytest.mark.parametrize("fence", [square_fence(5.0), [item(0, 5003, frame=5, p1=5.0, kind=1, yaw=0.0)]])
def test_a_place_beyond_the_fence_is_refused(pilot: Pilot, fence: list[Any]) -> None:
    assert upload(pilot, fence, 1) == 0
    airborne(pilot)
    pilot.send(m.MAVLink_command_int_message(1, 1, 6, 192, 0, 0, -1, 1, 0, NAN, *_e7(20.0, 0.0), 5.0))
    assert Pilot.ack(pilot.tick(), 192) == REJECTED
    assert "outside the fence" in pilot.texts()[-1]
    pilot.send(m.MAVLink_command_int_message(1, 1, 6, 192, 0, 0, -1, 1, 0, NAN, *_e7(3.0, 0.0), 5.0))
    assert Pilot.ack(pilot.tick(), 192) == ACCEPTED


def test_a_mission_that_leaves_the_fence_is_not_begun(pilot: Pilot) -> None:
    assert upload(pilot, SQUARE) == 0
    assert upload(pilot, square_fence(5.0), 1) == 0
    assert pilot.command(300, 0, 0) == REJECTED
    assert "outside the fence" in pilot.texts()[-1]
    assert (pilot.armed, pilot.mode) == (False, HOLD)
    assert upload(pilot, square_fence(50.0), 1) == 0
    assert pilot.command(300, 0, 0) == ACCEPTED


def test_a_mission_in_flight_is_held_once_it_would_leave_the_fence(pilot: Pilot) -> None:
    # GIVEN a small mission under way inside a circle of 30 m
    circle = item(0, m.MAV_CMD_NAV_FENCE_CIRCLE_INCLUSION, p1=30.0, kind=1)
    assert upload(pilot, [circle], 1) == upload(pilot, SQUARE) == 0
    assert pilot.command(300, 0, 0) == ACCEPTED
    pilot.until(lambda: at(pilot, 0), 20)
    # WHEN another one that leads out of it takes its place
    assert upload(pilot, [waypoint(0, 300.0, 0.0, 5.0)]) == 0
    assert "Mission not possible: outside the fence" in pilot.texts()
    pilot.run(1.0)
    # THEN it is held where it was, and the reason told
    assert (pilot.armed, pilot.mode) == (True, HOLD)
    assert "Failsafe activated: mission not possible, outside the fence, Hold" in pilot.texts()
    pilot.run(10.0)
    assert abs(point(pilot).p[0]) < 10.0
    assert pilot.command(300, 0, 0) == REJECTED


@pytest.mark.parametrize("narrower", ["fence", "parameter"])
def test_a_mission_in_flight_is_held_once_the_fence_is_too_narrow_for_it(pilot: Pilot, narrower: str) -> None:
    assert upload(pilot, [SQUARE[0], waypoint(1, 40.0, 0.0, 5.0), waypoint(2, 40.0, 40.0, 5.0)]) == 0
    assert pilot.command(300, 0, 0) == ACCEPTED
    pilot.until(lambda: at(pilot, 0), 20)
    if narrower == "fence":
        assert upload(pilot, [item(0, m.MAV_CMD_NAV_FENCE_CIRCLE_INCLUSION, p1=30.0, kind=1)], 1) == 0
    else:
        pilot.vehicle.parameters.set("GF_MAX_HOR_DIST", 30.0)
    pilot.run(0.1)
    assert pilot.mode == HOLD


def test_a_fence_that_only_warns_holds_no_mission_and_refuses_no_goto(pilot: Pilot) -> None:
    pilot.vehicle.parameters.set("GF_ACTION", 1)
    assert upload(pilot, square_fence(5.0), 1) == upload(pilot, SQUARE) == 0
    assert pilot.command(300, 0, 0) == ACCEPTED
    pilot.until(lambda: "Fence breached" in pilot.texts(), 30)
    assert pilot.mode == MISSION
    pilot.send(m.MAVLink_mission_item_message(1, 1, 0, 3, 16, 2, 1, 0, 0, 0, 0, LATITUDE + 20 * NORTH, LONGITUDE, 5.0))
    pilot.tick()
    assert pilot.last("MISSION_ACK").type == m.MAV_MISSION_ACCEPTED


def test_a_mission_that_does_not_fit_cannot_be_armed_for(pilot: Pilot) -> None:
    assert upload(pilot, SQUARE) == 0
    assert pilot.command(176, 1, 4, 4) == ACCEPTED
    assert upload(pilot, square_fence(5.0), 1) == 0
    assert pilot.command(400, 1) == REJECTED
    assert pilot.texts()[-1] == "Arming denied: outside the fence"


def test_a_mission_for_another_field_is_not_begun(pilot: Pilot) -> None:
    far = [SQUARE[0], waypoint(1, 12_000.0, 0.0, 5.0)]
    assert upload(pilot, far) == 0  # kept, as PX4 does
    assert pilot.texts()[-1] == "Mission not possible: a place of the mission is too far away"
    assert pilot.command(300, 0, 0) == REJECTED
    assert pilot.texts()[-1] == "Mission start denied: a place of the mission is too far away"
    pilot.vehicle.parameters.set("MIS_DIST_1WP", 15_000.0)
    assert pilot.command(300, 0, 0) == ACCEPTED


def test_no_place_of_a_mission_is_on_another_continent(pilot: Pilot) -> None:
    pilot.vehicle.parameters.set("MIS_DIST_1WP", 0.0)
    for north, result in ((90_000.0, ACCEPTED), (2_000_000.0, REJECTED)):
        assert upload(pilot, [*SQUARE[:2], waypoint(2, north, 0.0, 5.0)]) == 0
        assert pilot.command(300, 0, 0) == result
        assert pilot.command(176, 1, 4, 3) == ACCEPTED
        pilot.command(400, 0, 21196)


def test_a_mission_start_that_is_refused_changes_nothing(pilot: Pilot) -> None:
    assert upload(pilot, SQUARE) == 0
    battery = pilot.vehicle._stack.battery
    battery.used = 0.97 * battery.capacity
    pilot.run(0.1)
    assert pilot.command(300, 2, 0) == REJECTED
    assert pilot.texts()[-1] == "Mission start denied: battery too low"
    pilot.run(1.0)
    assert (pilot.armed, pilot.mode, pilot.last("MISSION_CURRENT").seq) == (False, HOLD, 0)


def test_standing_in_an_exclusion_zone_forbids_arming(pilot: Pilot) -> None:
    assert upload(pilot, square_fence(5.0, 5002), 1) == 0
    pilot.run(0.1)
    assert pilot.command(400, 1) == REJECTED
    assert "outside the fence" in pilot.texts()[-1]


def test_a_fence_that_is_switched_off_keeps_nobody(pilot: Pilot) -> None:
    def bits(field: str) -> bool:
        pilot.run(1.1)
        return bool(getattr(pilot.last("SYS_STATUS"), f"onboard_control_sensors_{field}") & m.MAV_SYS_STATUS_GEOFENCE)

    assert [bits("present"), bits("health")] == [False, True]
    assert upload(pilot, square_fence(5.0, 5002), 1) == 0
    assert [bits("present"), bits("enabled"), bits("health")] == [True, True, False]
    assert pilot.command(207, 0) == ACCEPTED
    assert [bits("present"), bits("enabled"), bits("health")] == [True, False, True]
    assert pilot.command(400, 1) == ACCEPTED
    assert pilot.command(207, 2) == DENIED


def test_what_is_accepted_without_effect_is_said(pilot: Pilot) -> None:
    airborne(pilot)
    assert pilot.command(185, 0) == ACCEPTED
    assert pilot.texts()[-1] == "Termination not asked for, param1 is not 1: nothing done"
    assert pilot.command(22, NAN, NAN, NAN, NAN, NAN, NAN, NAN) == ACCEPTED
    pilot.run(0.1)
    assert pilot.texts()[-1] == "Takeoff in flight: climbs from here, never sinks"


def test_a_termination_stops_the_motors_in_the_air(pilot: Pilot) -> None:
    airborne(pilot)
    assert pilot.command(185, 0) == ACCEPTED
    assert pilot.armed
    assert pilot.command(185, 1) == ACCEPTED
    assert not pilot.armed


def test_the_origin_stays_and_is_told_to_who_wants_to_put_it_elsewhere(pilot: Pilot) -> None:
    pilot.send(m.MAVLink_set_gps_global_origin_message(1, 470000000, 80000000, 0))
    (origin,) = [h for h in pilot.tick() if h.get_type() == "GPS_GLOBAL_ORIGIN"]
    assert origin.latitude == pytest.approx(LATITUDE * 1e7, abs=10)
    assert pilot.texts()[-1].startswith("Origin denied")


def test_the_ceiling_is_a_fence_too(pilot: Pilot) -> None:
    pilot.vehicle.parameters.set("GF_MAX_VER_DIST", 6.0)
    airborne(pilot)
    pilot.send(position(0, 0, -9))
    assert pilot.command(176, 1, 6) == ACCEPTED
    pilot.fly(4.0, position(0, 0, -9))
    assert pilot.mode == HOLD
    assert pilot.last("FENCE_STATUS").breach_type == m.FENCE_BREACH_MAXALT


def test_a_failsafe_may_stop_the_motors_in_the_air(pilot: Pilot) -> None:
    pilot.vehicle.parameters.set("GF_ACTION", 4)
    pilot.vehicle.parameters.set("GF_MAX_HOR_DIST", 5.0)
    airborne(pilot)
    point(pilot).p[0] = 8.0
    pilot.run(0.1)
    assert not pilot.armed
    assert "motors off" in " ".join(pilot.texts()[-2:])


@pytest.mark.parametrize(("action", "mode"), [(1, HOLD), (2, RTL), (3, LAND)])
def test_a_lost_ground_station_follows_the_parameter(pilot: Pilot, action: int, mode: tuple[int, int]) -> None:
    pilot.vehicle.parameters.set("NAV_DLL_ACT", action)
    airborne(pilot)
    pilot.send(m.MAVLink_heartbeat_message(m.MAV_TYPE_GCS, 8, 0, 0, 4, 3))
    pilot.send(position(0, 0, -2.5))
    assert pilot.command(176, 1, 6) == ACCEPTED
    pilot.fly(9.5, position(0, 0, -2.5))
    assert pilot.mode == OFFBOARD
    pilot.fly(1.0, position(0, 0, -2.5))
    assert pilot.mode == mode
    assert "ground station" in pilot.texts()[-1]


def test_a_battery_warns_returns_and_lands(pilot: Pilot) -> None:
    pilot.vehicle.parameters.set("COM_LOW_BAT_ACT", 3)
    airborne(pilot)
    battery = pilot.vehicle._stack.battery
    capacity = battery.used / (1.0 - battery.remaining)
    for left, mode, words in (
        (0.12, HOLD, "Battery low"),
        (0.06, RTL, "battery critical"),
        (0.03, LAND, "nearly empty"),
    ):
        battery.used = (1.0 - left) * capacity
        pilot.run(0.1)
        assert pilot.mode == mode
        assert words in pilot.texts()[-1]
    pilot.until(lambda: not pilot.armed, 20)
    assert pilot.command(400, 1) == REJECTED
    assert "battery" in pilot.texts()[-1]


def test_a_lost_position_lands_where_it_is(pilot: Pilot) -> None:
    airborne(pilot)
    point(pilot).position_known = False
    pilot.run(1.9)
    assert pilot.mode == HOLD
    pilot.run(0.2)
    assert pilot.mode == LAND
    assert "position lost" in pilot.texts()[-1]
    assert np.isnan(point(pilot).setpoint.position_n).all()
    pilot.until(lambda: not pilot.armed, 20)


def test_a_pilot_who_asks_after_a_failsafe_is_obeyed_until_it_begins_again(pilot: Pilot) -> None:
    pilot.vehicle.parameters.set("GF_ACTION", 3)
    pilot.vehicle.parameters.set("GF_MAX_HOR_DIST", 5.0)
    airborne(pilot)
    point(pilot).p[0] = 8.0
    pilot.run(0.1)
    assert pilot.mode == RTL
    assert pilot.command(176, 1, 4, 3) == ACCEPTED
    pilot.run(1.0)
    assert pilot.mode == HOLD
    point(pilot).p[0] = 0.0
    pilot.run(0.1)
    point(pilot).p[0] = 8.0
    pilot.run(0.1)
    assert pilot.mode == RTL


def test_a_failure_is_injected_by_command(pilot: Pilot) -> None:
    assert pilot.command(420, m.FAILURE_UNIT_SENSOR_GPS, m.FAILURE_TYPE_OFF, 0) == ACCEPTED
    assert [f.sensor.name for f in point(pilot).faults] == ["GPS"]
    assert pilot.command(420, m.FAILURE_UNIT_SENSOR_GPS, m.FAILURE_TYPE_OK, 0) == ACCEPTED
    assert point(pilot).faults == []
    assert pilot.command(420, m.FAILURE_UNIT_SYSTEM_MOTOR, m.FAILURE_TYPE_OFF, 99) == DENIED
    assert pilot.command(420, m.FAILURE_UNIT_SENSOR_GPS, m.FAILURE_TYPE_OFF, 2) == DENIED
    assert pilot.command(420, 99, 1, 0) == DENIED
    assert pilot.command(420, m.FAILURE_UNIT_SENSOR_GPS, 7, 0) == UNSUPPORTED


def test_a_failure_names_one_motor_or_all_of_them(pilot: Pilot) -> None:
    def failing() -> list[int]:
        return [f.index for f in point(pilot).faults]

    motor, off, ok = m.FAILURE_UNIT_SYSTEM_MOTOR, m.FAILURE_TYPE_OFF, m.FAILURE_TYPE_OK
    assert pilot.command(420, motor, off, 2) == pilot.command(420, motor, off, 3) == ACCEPTED
    assert failing() == [1, 2]
    assert pilot.command(420, motor, ok, 2) == ACCEPTED
    assert failing() == [2]
    assert pilot.command(420, motor, ok, 0) == ACCEPTED
    assert failing() == []
    assert pilot.command(420, motor, off, 0) == ACCEPTED
    assert failing() == [0, 1, 2, 3]
