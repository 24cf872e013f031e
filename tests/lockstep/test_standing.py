"""GIVEN a vehicle that stands (holds, waits), WHEN something comes, THEN it goes out of the way and comes back."""

import numpy as np
import pytest

from companion.drivers.desk import ReplanDesk
from companion.missionfile import parse_mission
from companion.phases import Phase
from companion.seam import PlanWanted, Reference, ReplanWanted
from companion.testing.flight import Flight
from companion.testing.spec import FlightSpec
from companion.vehiclelink import VEHICLE_LINK
from tests.unit import test_companion_safety as table
from wire.datagram import Datagram
from wire.dialect import mavlink

ROOM = """\
name: standing
vehicle: {start: {north: 10, east: 10}}
world:
  bounds: {north: [0, 20], east: [0, 20], altitude: [0, 4]}
  movers:
    - {sphere: {north: 10, east: 3, altitude: 1.5, radius: 0.4}, velocity: {north: 0, east: 1.2}}
sensing: {use: true, resolution: 0.2, clearance: 0.3, mover_radius: 0.5}
steps: [{takeoff: {altitude: 1.5}}, STEP, {goto: {north: 13, east: 10, altitude: 1.5}}, land]
"""


def flown(step, autopilot):
    """What came of it, and the references with their times [s]."""
    flight, ticks = Flight(FlightSpec(ROOM.replace("STEP", step).encode(), autopilot=autopilot)), []
    result = flight.fly(taps=[ticks.append])
    rows = [(t.now_us / 1e6, o) for t in ticks for o in t.outputs if isinstance(o, Reference)]
    return result, np.array([t for t, _ in rows]), [r for _, r in rows]


@pytest.mark.parametrize("autopilot", ["px4", "ardupilot"])
@pytest.mark.parametrize(
    "step", ["{hold: {seconds: 20}}", pytest.param("{wait: {for: order, at_most: 20}}", marks=pytest.mark.slow)]
)
def test_a_mover_that_comes_at_a_vehicle_at_rest_is_dodged_and_the_mission_goes_on_from_its_place(step, autopilot):
    result, t, flown_ = flown(step, autopilot)
    assert result.ok, result.cause
    assert result.min_clearance_m > 0.1
    began, ended = (next(at for at, _, text in result.notes if text.startswith(f"step {k}: ")) for k in (1, 2))
    assert 20.0 <= ended - began < 27.0  # a step that is away when its time is over comes back first
    places = np.array([r.position_m for r in flown_])
    away = np.linalg.norm(places - (10.0, 10.0, -1.5), axis=1)[(t > began) & (t < ended)]
    assert away.max() > 0.5
    assert away[0] < 1e-6
    assert away[-1] < 1e-6
    in_air = t > began
    for what, limit in (("position_m", 3.0), ("velocity_m", 6.0), ("acceleration_m", 60.0)):
        rows = np.array([getattr(r, what) for r in flown_])[in_air]
        assert np.linalg.norm(np.diff(rows, axis=0), axis=1).max() <= 0.02 * limit + 1e-6


WAITING = b"""\
name: waiting
vehicle: {start: {north: 5, east: 10}}
world: {bounds: {north: [0, 20], east: [0, 20], altitude: [0, 4]}}
sensing: {use: true, clearance: 0.3}
steps: [{takeoff: {altitude: 2}}, {wait: {for: order}}, {goto: {north: 15, east: 10, altitude: 2}}, land]
"""


def scan_of_the_wall(puppet, north=6.55, east=(8.0, 12.0)):
    """What a ring of distances says of an upright wall across the way, 25 m at most."""
    x, y, _ = puppet.at
    bearing = np.radians(5.0 * np.arange(72))
    with np.errstate(divide="ignore"):
        far = (north - x) / np.cos(bearing)
    at = y + far * np.sin(bearing)
    hit = (far > 0.0) & (far < 25.0) & (at >= east[0]) & (at <= east[1])
    said = np.where(hit, np.round(100.0 * far), 2501).astype(int).tolist()
    m = mavlink.MAVLink_obstacle_distance_message(1000 * puppet.boot_ms, 0, said, 5, 20, 2500, 5.0, 0.0, 1)
    return Datagram(VEHICLE_LINK, bytes(m.pack(puppet.mav)), ("vehicle", 1))


def test_the_way_back_to_where_a_mission_waits_leads_round_what_is_seen_and_was_never_told():
    puppet = table.Puppet("px4", Phase.FLYING, parse_mission(WAITING, "waiting.yaml"))
    companion = puppet.companion
    companion.seeing.begin()
    puppet.at = np.array([8.0, 10.0, -2.0])  # blown off, to the other side of a wall
    east = np.arange(8.0, 12.05, 0.1)
    wall = np.column_stack((np.full(len(east), 6.55), east, np.full(len(east), -2.0)))
    world = companion.mission.planner_world()
    desks, answers, asked, nearest = {False: ReplanDesk(world), True: ReplanDesk(world)}, [], [], np.inf
    for _ in range(50 * 20):
        puppet.now_us, puppet.boot_ms = puppet.now_us + 20_000, puppet.boot_ms + 20
        outputs = companion.step(puppet.now_us, [*puppet.said(), scan_of_the_wall(puppet), *answers])
        asked += [o for o in outputs if isinstance(o, PlanWanted | ReplanWanted)]
        answers = [desks[o.cold].answer(o) for o in outputs if isinstance(o, ReplanWanted)]
        if asked and companion.phase is Phase.FLYING:  # until then it stands
            puppet.at = companion.setpoints.reference.position_m
        nearest = min(nearest, float(np.linalg.norm(wall - puppet.at, axis=1).min()))
        if asked and companion.phase is Phase.FLYING and not companion.itinerary.away:
            break
    assert asked
    assert companion.itinerary.step.wait is not None
    assert np.linalg.norm(puppet.at - (5.0, 10.0, -2.0)) < 1e-3
    assert nearest > 0.35
    assert not [o for o in asked if isinstance(o, PlanWanted)]  # nothing was planned in the world as it was told
