"""Plans that cannot be flown as they are meant are refused, and jumps lead where each autopilot counts them to."""

import math
from typing import Any

import pytest
from flight_double import PointMass
from vehicle_pilot import ACCEPTED, NAN, Pilot

import fakevehicle.vehicle
from fakevehicle.config import LinkConfig, VehicleConfig
from fakevehicle.plans import Flaw, Kind, PlanItem, item_flaw, plan_flaw
from fakevehicle.vehicle import Vehicle
from wire.dialect import mavlink

m = mavlink
AUTO = 3


def item(command: int, *params: float, north: float = 0.0, up: float = 5.0) -> PlanItem:
    """A place some metres north of where the vehicle stands, or a command."""
    p = [*params, *[0.0] * (4 - len(params))]
    return PlanItem(command, 3, (p[0], p[1], p[2], p[3], 47.397742 + north / 111_180.0, 8.545594, up))


TAKEOFF, WAYPOINT = item(22), item(16)


def jump(target: float, times: float = -1.0) -> PlanItem:
    return PlanItem(m.MAV_CMD_DO_JUMP, 2, (target, times, 0.0, 0.0, 0.0, 0.0, 0.0))


@pytest.fixture
def pilot(monkeypatch: pytest.MonkeyPatch) -> Pilot:
    """A client of the ArduPilot flavour, in GUIDED at 5 m."""
    monkeypatch.setattr(fakevehicle.vehicle, "FlightStack", PointMass)
    pilot = Pilot(Vehicle(VehicleConfig(links=(LinkConfig("onboard", "gcs"),), autopilot="ardupilot")))
    pilot.run(3.5)
    return pilot


def wire(seq: int, i: PlanItem) -> Any:
    x, y = (round(v * 1e7) for v in i.params[4:6])
    return m.MAVLink_mission_item_int_message(1, 1, seq, i.frame, i.command, 0, 1, *i.params[:4], x, y, i.params[6], 0)


def write(pilot: Pilot, begin: Any, first: int, items: list[PlanItem]) -> int:
    """Send what is asked for; the result."""
    pilot.send(begin)
    pilot.tick()
    for seq, each in enumerate(items, start=first):
        assert pilot.last("MISSION_REQUEST").seq == seq
        pilot.send(wire(seq, each))
        pilot.tick()
    return int(pilot.last("MISSION_ACK").type)


def upload(pilot: Pilot, items: list[PlanItem]) -> int:
    whole = [WAYPOINT, *items]  # home comes first
    return write(pilot, m.MAVLink_mission_count_message(1, 1, len(whole), 0), 0, whole)


def read(pilot: Pilot, seq: int) -> Any:
    pilot.send(m.MAVLink_mission_request_int_message(1, 1, seq, 0))
    pilot.tick()
    return pilot.last("MISSION_ITEM_INT")


def reached(pilot: Pilot) -> list[int]:
    return [message.seq for message in pilot.of("MISSION_ITEM_REACHED")]


def test_where_item_0_is_home_a_jump_counts_it(pilot: Pilot) -> None:
    # GIVEN home, takeoff, three waypoints and a jump to the second of them
    stays = [item(16, 0.5, north=n) for n in (3.0, 6.0, 9.0)]
    assert upload(pilot, [TAKEOFF, *stays, jump(3, 1), item(16, 0.5)]) == m.MAV_MISSION_ACCEPTED
    assert read(pilot, 5).param1 == 3
    # WHEN it is flown
    assert pilot.command(m.MAV_CMD_DO_SET_MODE, 1, 4) == ACCEPTED
    assert pilot.command(400, 1) == ACCEPTED
    assert pilot.command(22, 0, 0, 0, 0, 0, 0, 5) == ACCEPTED
    pilot.run(8)
    assert pilot.command(m.MAV_CMD_DO_SET_MODE, 1, AUTO) == ACCEPTED
    pilot.until(lambda: 6 in reached(pilot), 60)
    # THEN item 3 is flown twice
    assert reached(pilot) == [1, 2, 3, 4, 5, 3, 4, 5, 6]


def test_where_item_0_is_home_a_part_of_the_plan_may_be_a_jump(pilot: Pilot) -> None:
    assert upload(pilot, [TAKEOFF, WAYPOINT, jump(2, 1), WAYPOINT]) == m.MAV_MISSION_ACCEPTED
    begin = m.MAVLink_mission_write_partial_list_message(1, 1, 4, 4, 0)
    assert write(pilot, begin, 4, [jump(1, 2)]) == m.MAV_MISSION_ACCEPTED
    assert [read(pilot, seq).param1 for seq in (3, 4)] == [2, 1]


def test_where_item_0_is_home_nothing_jumps_there_and_the_last_item_is_a_target(pilot: Pilot) -> None:
    assert upload(pilot, [TAKEOFF, jump(3, 1), WAYPOINT]) == m.MAV_MISSION_ACCEPTED
    for target in (0, 4):
        assert upload(pilot, [TAKEOFF, jump(target, 1), WAYPOINT]) == m.MAV_MISSION_INVALID_PARAM1
        assert pilot.texts()[-1] == f"Plan refused: jump to item {target}, expected 1..3"


@pytest.mark.parametrize(
    ("kind", "wrong", "result", "reason"),
    [
        (Kind.FENCE, item(5003, NAN), 6, "inclusion circle: param1 is not given"),
        (Kind.FENCE, item(5004, NAN), 6, "exclusion circle: param1 is not given"),
        (Kind.MISSION, jump(1.5), 6, "jump: param1 is 1.5, expected a whole number"),
        (Kind.MISSION, jump(0, 2.5), 7, "jump: param2 is 2.5, expected a whole number"),
        (Kind.MISSION, jump(0, NAN), 7, "jump: param2 is not given"),
        (Kind.MISSION, item(16, up=-9000.0), 12, "waypoint: param7 is -9000, expected -500..10000"),
        (Kind.MISSION, item(16, 0, 0, 0, math.inf), 9, "waypoint: param4 is inf, expected a finite number"),
    ],
)
def test_what_an_item_needs_cannot_be_left_open(kind: Kind, wrong: PlanItem, result: int, reason: str) -> None:
    assert item_flaw(kind, wrong) == Flaw(result, reason)


SPEED = PlanItem(m.MAV_CMD_DO_CHANGE_SPEED, 2, (1.0, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0))


@pytest.mark.parametrize(
    "plan",
    [
        [TAKEOFF, jump(1)],
        [TAKEOFF, SPEED, jump(1)],
        [TAKEOFF, jump(4), WAYPOINT, WAYPOINT, jump(1)],
        [jump(2, 9), WAYPOINT, SPEED, jump(0, 9), WAYPOINT],
    ],
)
def test_jumps_in_a_ring_without_a_place_are_refused(plan: list[PlanItem]) -> None:
    flaw = plan_flaw(Kind.MISSION, plan)
    assert flaw is not None
    assert "leads back to itself" in flaw.reason


@pytest.mark.parametrize(
    "plan",
    [
        [TAKEOFF, WAYPOINT, SPEED, jump(1)],
        [TAKEOFF, jump(3), WAYPOINT, SPEED, WAYPOINT, jump(1)],
        [TAKEOFF, jump(1, 0)],
        [TAKEOFF, PlanItem(m.MAV_CMD_CONDITION_DELAY, 2, (1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)), jump(1)],
    ],
)
def test_jumps_with_a_place_between_may_go_on_for_ever(plan: list[PlanItem]) -> None:
    assert plan_flaw(Kind.MISSION, plan) is None


def test_a_plan_that_goes_nowhere_fast_does_not_flood_the_links(pilot: Pilot) -> None:
    # a wait of no time at all is the shortest ring there can be
    wait = PlanItem(m.MAV_CMD_CONDITION_DELAY, 2, (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0))
    assert upload(pilot, [TAKEOFF, wait, jump(2)]) == m.MAV_MISSION_ACCEPTED
    assert pilot.command(m.MAV_CMD_DO_SET_MODE, 1, 4) == ACCEPTED
    assert pilot.command(400, 1) == ACCEPTED
    assert pilot.command(22, 0, 0, 0, 0, 0, 0, 5) == ACCEPTED
    pilot.run(8)
    assert pilot.command(m.MAV_CMD_DO_SET_MODE, 1, AUTO) == ACCEPTED
    pilot.run(2)
    before = len(reached(pilot))
    pilot.run(4)
    assert len(reached(pilot)) - before <= 200
