"""Missions of every kind of step, and orders in flight: whole flights in memory."""

import numpy as np
import pytest

from companion.cli.vehicle import LINK, build_vehicle
from companion.core import Companion, CompanionConfig
from companion.drivers.lockstep import fly_lockstep
from companion.drivers.planning import InlinePlanning
from companion.drivers.recording import RecordingTap, header
from companion.drivers.rerun import rerun
from companion.geodesy import Geodetic
from companion.ground.station import plan_file
from companion.missionfile import parse_mission
from companion.phases import Phase
from companion.seam import Order, Reference
from companion.service.idle import Idle
from companion.verdict import FlightMeter, judge
from logs.reader import Recording
from logs.recorder import Recorder
from wire.datagram import Datagram
from wire.dialect import mavlink

FIELD = """\
name: field
vehicle:
  start: {north: 3, east: 3}
world:
  bounds: {north: [0, 40], east: [0, 30], altitude: [0, 8]}
"""
TOUR = (
    FIELD
    + """\
steps:
  - takeoff: {altitude: 2}
  - via: [{north: 8, east: 10, altitude: 2}]
  - goto: {north: 14, east: 5, altitude: 3}
    speed: 2
  - orbit: {north: 18, east: 5, altitude: 3, radius: 3, turns: 1.25, clockwise: false}
  - yaw: {heading_deg: 120, rate_deg: 60}
  - wait: {for: order}
  - return: {altitude: 2}
"""
)
STRAIGHT = FIELD + "steps:\n  - takeoff: {altitude: 2}\n  - goto: {north: 37, east: 3, altitude: 2}\n  - land\n"


def path(flight):
    """(time [s], position (n, 3), velocity, acceleration, yaw) of every reference."""
    rows = [(t.now_us / 1e6, o) for t in flight.ticks for o in t.outputs if isinstance(o, Reference)]
    names = ("position_m", "velocity_m", "acceleration_m")
    return (
        np.array([t for t, _ in rows]),
        *(np.array([getattr(r, n) for _, r in rows]) for n in names),
        np.array([r.yaw for _, r in rows]),
    )


def smooth(flight):
    """No jump: each of position, velocity and acceleration changes as slowly as its derivative's limit allows."""
    t, p, v, a, _ = path(flight)
    limits, dt = flight.companion.mission.limits, np.diff(t)[:, None]
    assert np.linalg.norm(np.diff(p, axis=0), axis=1).max() <= limits.speed * dt.max() * 1.001
    assert np.linalg.norm(np.diff(v, axis=0), axis=1).max() <= limits.acceleration * dt.max() * 1.3
    assert np.linalg.norm(np.diff(a, axis=0), axis=1).max() <= limits.jerk * dt.max() * 1.5
    moved = np.diff(p, axis=0) - (v[1:] + v[:-1]) / 2 * dt
    assert np.abs(moved).max() < 1e-3  # the velocity told is that of the position


def orders(*given):
    """An operator who gives each order at the first tick at which its condition holds."""
    waiting = list(given)

    def operator(companion, now_us):
        if waiting and waiting[0][0](companion, now_us):
            return waiting.pop(0)[1]
        return None

    return operator


def after(seconds):
    """So many seconds after the order before it; the first: after the goto began."""
    began = []

    def condition(companion, now_us):
        if companion.phase is Phase.FLYING and companion.itinerary.step.kind == "goto" and not began:
            began.append(now_us)
        return bool(began) and now_us >= began[0] + seconds * 1e6

    return condition


def waiting(companion, now_us):
    return companion.phase is Phase.FLYING and companion.itinerary.step.kind == "wait"


@pytest.mark.parametrize("autopilot", ["px4", pytest.param("ardupilot", marks=pytest.mark.slow)])
def test_via_orbit_yaw_wait_and_return_are_flown_in_order_and_the_flight_ends_where_it_began(fly, autopilot):
    flight = fly(TOUR, operator=orders((waiting, Order("resume"))), autopilot=autopilot)
    assert flight.verdict.ok, flight.verdict.failure
    truth = flight.verdict.track.position_m
    assert np.linalg.norm(truth[-1][:2] - (3, 3)) < 0.5
    steps = [note.split(": ")[1] for note in flight.notes if note.startswith("step ") and "planned" not in note]
    assert steps[-6:] == ["goto", "orbit", "yaw", "wait", "return", "land"]
    _, p, v, _, yaw = path(flight)
    assert np.linalg.norm(p - (8, 10, -2), axis=1).min() < 0.05
    assert np.linalg.norm(p - (14, 5, -3), axis=1).min() < 1e-3
    on_circle = np.abs(np.hypot(p[:, 0] - 18, p[:, 1] - 5) - 3) < 1e-6
    around = np.unwrap(np.arctan2(p[on_circle, 1] - 5, p[on_circle, 0] - 18))
    assert around[-1] - around[0] == pytest.approx(-2.5 * np.pi, abs=0.02)  # anticlockwise from above
    assert np.rad2deg(yaw[-1]) == pytest.approx(120)
    np.testing.assert_allclose(p[-1], (3, 3, -2), atol=1e-4)
    going = slice(0, int(np.argmin(np.linalg.norm(p - (14, 5, -3), axis=1))))
    assert np.linalg.norm(v[going], axis=1).max() <= 2.0 + 1e-9
    smooth(flight)


def test_a_hold_at_3_m_per_s_comes_to_rest_within_2_m_of_the_way_and_resume_goes_on_without_a_jump(fly):
    flight = fly(STRAIGHT, operator=orders((after(4.0), Order("hold")), (after(9.0), Order("resume"))))
    assert flight.verdict.ok, flight.verdict.failure
    t, p, v, _, _ = path(flight)
    speed = np.linalg.norm(v, axis=1)
    asked = next(tick.now_us / 1e6 for tick in flight.ticks for o in tick.outputs if getattr(o, "text", "") == "hold")
    at = int(np.argmin(np.abs(t - asked)))
    assert speed[at] > 2.9
    rest = at + int(np.argmax(speed[at:] < 1e-9))
    assert np.linalg.norm(p[rest] - p[at]) < 2.0
    assert t[rest] - t[at] < 1.6
    assert speed[rest : rest + 100].max() < 1e-9
    truth = flight.verdict.track.position_m
    assert truth[:, 0].max() == pytest.approx(37, abs=0.3)
    smooth(flight)


@pytest.mark.slow
def test_goto_flies_to_the_place_and_holds_there_and_resume_goes_back_to_where_the_mission_was_left(fly):
    flight = fly(
        STRAIGHT,
        operator=orders((after(4.0), Order("goto", (12.0, 20.0, 4.0))), (after(20.0), Order("resume"))),
    )
    assert flight.verdict.ok, flight.verdict.failure
    _, p, _, _, _ = path(flight)
    there = np.linalg.norm(p - (12, 20, -4), axis=1) < 1e-6
    assert there.sum() > 100
    assert any("holding until ordered on" in note for note in flight.notes)
    np.testing.assert_allclose(p[-1], (37, 3, -2), atol=1e-6)
    smooth(flight)


def test_a_flight_goes_on_with_an_earlier_or_a_later_step_when_it_is_told_to_and_nothing_jumps(fly):
    steps = "".join(f"  - goto: {{north: {n}, east: {e}, altitude: 2}}\n" for n, e in ((20, 3), (20, 12), (37, 12)))
    three = FIELD + f"steps:\n  - takeoff: {{altitude: 2}}\n{steps}  - land\n"
    in_step = lambda k: lambda companion, now_us: companion.itinerary.index == k  # noqa: E731
    refused = Order("skip", (0.0,))
    given = orders((after(1.0), refused), (after(1.0), Order("skip", (2.0,))), (in_step(3), Order("skip", (1.0,))))
    flight = fly(three, operator=given)
    assert flight.verdict.ok, flight.verdict.failure
    assert any("found step 0, expected 1 to 4" in note for note in flight.notes)
    begun = [note for note in flight.notes if note.startswith("step ") and "planned" not in note]
    assert begun == [
        *("step 1: goto", "step 2: goto, as ordered", "step 3: goto"),
        *("step 1: goto, as ordered", "step 2: goto", "step 3: goto", "step 4: land"),
    ]
    _, p, _, _, _ = path(flight)
    np.testing.assert_allclose(p[-1], (37, 12, -2), atol=1e-6)
    smooth(flight)


@pytest.mark.parametrize(("order", "place"), [("return", (3, 3)), pytest.param("abort", None, marks=pytest.mark.slow)])
def test_return_and_abort_come_to_rest_first_and_land(fly, order, place):
    flight = fly(STRAIGHT, operator=orders((after(4.0), Order(order))))
    assert flight.companion.phase is Phase.DONE
    assert f"cut short in step 1 by the order to {order}" in flight.verdict.failure
    _, p, v, _, _ = path(flight)
    assert np.linalg.norm(v[-1]) < 1e-9
    if place is not None:
        np.testing.assert_allclose(p[-1][:2], place, atol=1e-6)
    smooth(flight)


@pytest.mark.slow
def test_an_order_that_cannot_be_carried_out_is_refused_with_its_reason_and_changes_nothing(fly):
    fenced = STRAIGHT.replace("steps:", "fence: {include: [{circle: {north: 20, east: 3, radius: 25}}]}\nsteps:")
    flight = fly(
        fenced,
        operator=orders(
            (after(2.0), Order("goto", (20.0, 29.0, 2.0))),
            (after(2.5), Order("goto", (20.0, 27.5, 2.0))),
            (after(3.0), Order("goto", (20.0, 10.0, 7.9))),
            (after(3.5), Order("resume")),
        ),
    )
    assert flight.verdict.ok, flight.verdict.failure
    refused = [note for note in flight.notes if note.startswith(("goto: ", "resume: "))]
    assert "north 20, east 29, altitude 2 is 1.0" in refused[0]
    assert "m outside the fence" in refused[0]
    assert "m too near the fence (it keeps 0.75 m)" in refused[1]
    assert "0.65 m too near the bounds" in refused[2]
    assert refused[3] == "resume: nothing is held"


def test_no_reference_ever_leaves_the_fence_and_the_way_leads_round_what_is_excluded(fly):
    fence = (
        "fence:\n"
        "  include: [{corners: [{north: -5, east: -5}, {north: 45, east: -5}, {north: 45, east: 12}, "
        "{north: -5, east: 12}]}]\n"
        "  exclude: [{corners: [{north: 18, east: -9}, {north: 20, east: -9}, {north: 20, east: 7}, "
        "{north: 18, east: 7}]}, {circle: {north: 30, east: 4, radius: 2}}]\n"
        "  ceiling: 4\n"
    )
    flight = fly(STRAIGHT.replace("steps:", fence + "steps:"))
    assert flight.verdict.ok, flight.verdict.failure
    _, p, _, _, _ = path(flight)
    geofence = flight.companion.mission.geofence()
    assert min(geofence.inside(q) for q in p) >= 0.75 - 1e-9
    assert p[:, 1].max() > 7.7
    assert flight.verdict.min_clearance_m is None  # a fence is nothing to touch


def placed(start):
    """A flight from a place on the earth to another; the bundled vehicle stands where `start` says."""
    return (
        "name: placed\norigin: {latitude: 47.397742, longitude: 8.545594, altitude: 488}\n"
        f"vehicle: {{start: {start}}}\n"
        "world: {bounds: {north: [-40, 40], east: [-40, 40], altitude: [0, 8]}}\n"
        "steps:\n  - takeoff: {altitude: 2}\n"
        "  - goto: {latitude: 47.39787, longitude: 8.545594, altitude: 2}\n  - land\n"
    )


def test_a_mission_with_an_origin_is_flown_from_where_the_vehicle_is_found_to_the_place_on_the_earth(fly):
    flight = fly(placed("{north: -3, east: 5}"))
    assert flight.verdict.ok, flight.verdict.failure
    _, p, _, _, _ = path(flight)
    np.testing.assert_allclose(p[0][:2], (-3, 5), atol=1.0)  # within what its GPS says
    np.testing.assert_allclose(p[-1][:2], ((47.39787 - 47.397742) * 111_200, 0.0), atol=0.05)


@pytest.mark.slow
def test_a_vehicle_found_elsewhere_than_its_file_says_does_not_fly_unless_it_may_be_anywhere(fly):
    class Elsewhere:
        """The vehicle, told to everybody 0.0001 degrees farther north."""

        def __init__(self, vehicle):
            self.vehicle, self.TICK_US = vehicle, vehicle.TICK_US

        def step(self, now_us, inputs):
            return [self.moved(d) for d in self.vehicle.step(now_us, inputs)]

        def moved(self, d):
            if d.data[7:10] != (33).to_bytes(3, "little"):
                return d
            mav = mavlink.MAVLink(None)
            message = mav.decode(bytearray(d.data))
            message.lat += 1000
            mav.srcSystem, mav.srcComponent = 1, 1
            return Datagram(d.link, bytes(message.pack(mav)), d.peer)

    refused = fly(placed("{north: 0, east: 0}"), between=Elsewhere)
    assert refused.companion.phase is Phase.FAILED
    assert "the vehicle stands 11." in refused.verdict.failure
    flown = fly(placed("{north: 0, east: 0, anywhere: true}"), between=Elsewhere)
    assert flown.verdict.ok, flown.verdict.failure
    np.testing.assert_allclose(path(flown)[1][0], (11.12, 0, 0), atol=0.5)


class Pilot:
    """A ground station in the loop: what it says goes in as a datagram, what it hears is kept."""

    def __init__(self, *given):
        self.given, self.heard, self.mav, self.seq = list(given), [], mavlink.MAVLink(None), 0
        self.mav.srcSystem, self.mav.srcComponent = 255, 190

    def __call__(self, companion, now_us):
        if self.given and self.given[0][0](companion, now_us):
            self.mav.seq = self.seq = (self.seq + 1) & 0xFF
            message = self.given.pop(0)[1]
            return Datagram("out0", bytes(message.pack(self.mav)), ("gcs", 1))
        return None

    def hear(self, tick):
        for o in tick.outputs:
            if isinstance(o, Datagram) and o.link == "out0" and o.peer == ("gcs", 1):
                message = mavlink.MAVLink(None).decode(bytearray(o.data))
                if message.get_srcComponent() == 191:
                    self.heard.append((tick.now_us, message))


def command(number, *params):
    values = (*params, *[0.0] * (7 - len(params)))
    return mavlink.MAVLink_command_long_message(1, 191, number, 0, *values)


def still(companion, now_us):
    reference = companion.itinerary.reference(now_us)
    return companion.itinerary.holding and float(np.linalg.norm(reference.velocity_m)) == 0.0


def test_a_ground_station_pauses_moves_and_sends_the_flight_home_and_each_command_is_acknowledged_with_its_reason(fly):
    target = 47.397742 + 25.0 / 111_200  # 25 m north of where the flight began
    pilot = Pilot(
        (after(3.0), command(mavlink.MAV_CMD_DO_PAUSE_CONTINUE, 0.0)),
        (still, command(mavlink.MAV_CMD_DO_REPOSITION, -1, 0, 0, 0, target, 8.545594 + 0.005, 490.0)),
        (still, command(mavlink.MAV_CMD_DO_REPOSITION, -1, 0, 0, 0, target, 8.545594 + 10.0 / 75_400, 491.0)),
        (after(16.0), command(mavlink.MAV_CMD_NAV_RETURN_TO_LAUNCH)),
    )
    flight = fly(STRAIGHT, operator=pilot, taps=[pilot.hear], ground_links=("out0",))
    assert flight.companion.phase is Phase.DONE
    assert "cut short in step 1 by the order to return" in flight.verdict.failure
    acks = [(m.command, m.result) for _, m in pilot.heard if m.get_type() == "COMMAND_ACK"]
    assert acks == [
        (mavlink.MAV_CMD_DO_PAUSE_CONTINUE, mavlink.MAV_RESULT_ACCEPTED),
        (mavlink.MAV_CMD_DO_REPOSITION, mavlink.MAV_RESULT_DENIED),
        (mavlink.MAV_CMD_DO_REPOSITION, mavlink.MAV_RESULT_ACCEPTED),
        (mavlink.MAV_CMD_NAV_RETURN_TO_LAUNCH, mavlink.MAV_RESULT_ACCEPTED),
    ]
    texts = "".join(m.text for _, m in pilot.heard if m.get_type() == "STATUSTEXT")
    assert "DO_REPOSITION refused: north 28" in texts
    assert "m too near the bounds" in texts
    _, p, _, _, _ = path(flight)
    assert np.linalg.norm(p - (28, 13, -3), axis=1).min() < 1.0  # 3 m above home's 488 m; within what GPS says
    np.testing.assert_allclose(p[-1][:2], (3, 3), atol=1e-6)
    assert not any(m.get_type() == "HEARTBEAT" for _, m in pilot.heard if m.get_srcSystem() != 1)
    smooth(flight)


class Uploader(Pilot):
    """A ground station that hands over a plan, and then a fence whose pond lies on the straight way."""

    POND = (47.39780, 8.545594, 2.5)
    PLANS = (
        (
            (22, 3, 0.0, 47.397742, 8.545594, 3.0),
            (16, 3, 0.0, 47.39787, 8.545594, 3.0),
            (20, 2, 0.0, 0.0, 0.0, 0.0),
        ),
        (
            (5003, 0, 60.0, 47.397742, 8.545594, 0.0),
            (5004, 0, POND[2], *POND[:2], 0.0),
        ),
    )

    def __init__(self):
        super().__init__()
        counts = [mavlink.MAVLink_mission_count_message(1, 191, len(self.PLANS[k]), k) for k in (0, 1)]
        self.waiting = [counts[0]]
        self.next = counts[1:]

    def __call__(self, companion, now_us):
        if now_us > 8_000_000 and self.waiting:  # the vehicle has found its place
            self.given = [(lambda companion, now_us: True, self.waiting.pop(0))]
        return super().__call__(companion, now_us)

    def hear(self, tick):
        before = len(self.heard)
        super().hear(tick)
        for _, m in self.heard[before:]:
            if m.get_type() == "MISSION_REQUEST_INT":
                command, frame, first, x, y, z = self.PLANS[m.mission_type][m.seq]
                place, none = (round(x * 1e7), round(y * 1e7), z), float("nan")
                params = (m.seq, frame, command, 0, 1, first, 0, 0, none, *place, m.mission_type)
                self.waiting.append(mavlink.MAVLink_mission_item_int_message(1, 191, *params))
            elif m.get_type() == "MISSION_ACK":
                self.waiting, self.next = self.next, []


class NobodyPlans:
    def submit(self, wanted):
        raise AssertionError("nothing is planned between flights")

    def ready(self):
        return []


class Later:
    """A vehicle whose clock has run before."""

    def __init__(self, vehicle, gone_us):
        self.vehicle, self.gone_us, self.TICK_US = vehicle, gone_us, vehicle.TICK_US

    def step(self, now_us, inputs):
        return self.vehicle.step(now_us + self.gone_us, inputs)


class Watcher(Pilot):
    """A ground station that listens to what everybody is told."""

    def hear(self, tick):
        for o in tick.outputs:
            if isinstance(o, Datagram) and o.link == "out0" and o.peer is None:
                message = mavlink.MAVLink(None).decode(bytearray(o.data))
                if message.get_srcComponent() == 191:
                    self.heard.append((tick.now_us, message))


def test_without_a_mission_the_companion_idles_takes_an_upload_and_flies_it_when_it_is_told_to_start(tmp_path):
    config = CompanionConfig(ground_links=("out0",))
    vehicle = build_vehicle(parse_mission(STRAIGHT.encode(), "straight.yaml"), 1)
    idle, station = Idle(config), Uploader()
    gone_us = fly_lockstep(
        idle,
        vehicle,
        LINK,
        NobodyPlans(),
        [station.hear],
        limit_s=12.0,
        operator=lambda now_us: station(idle, now_us),
        stop=lambda: idle.station.missions.uploads > 1,
    )
    assert [m.type for _, m in station.heard if m.get_type() == "MISSION_ACK"] == [mavlink.MAV_MISSION_ACCEPTED] * 2
    place = idle.telemetry.global_e7
    here = Geodetic(place[0] * 1e-7, place[1] * 1e-7, place[2] * 1e-3)
    data = plan_file(idle.station.missions, here)
    mission = parse_mission(data, "uploaded.plan")
    idle.mission = mission.name
    assert idle.obey(Order("start")) == ""
    assert idle.over
    companion = Companion(mission, config)
    meter, ticks, watcher = FlightMeter(companion), [], Watcher()
    recording = tmp_path / "uploaded.mcap"
    with Recorder(recording, threaded=False, **header(companion, data)) as recorder:
        taps = [meter, ticks.append, watcher.hear, RecordingTap(companion, recorder)]
        planning = InlinePlanning(mission.planner_world())
        fly_lockstep(companion, Later(vehicle, gone_us), LINK, planning, taps, limit_s=60.0)
    verdict = judge(companion, meter)
    assert verdict.ok, verdict.failure
    north = (47.39787 - 47.397742) * 111_200
    assert verdict.track.position_m[:, 0].max() == pytest.approx(north, abs=0.5)
    here, there = (
        [(i.command, i.frame, repr(i.params)) for i in (*s.missions.items, *s.missions.fence)]
        for s in (companion.ground, idle.station)
    )
    assert here == there
    pond = np.array([(Uploader.POND[0] - 47.397742) * 111_200, 0.0])
    away = np.linalg.norm(verdict.track.position_m[:, :2] - pond, axis=1)
    assert away.min() > Uploader.POND[2] + mission.vehicle.radius
    assert [m.seq for _, m in watcher.heard if m.get_type() == "MISSION_ITEM_REACHED"] == [0, 1, 2]
    told = [(us, m) for us, m in watcher.heard if m.get_type() == "MISSION_CURRENT"]
    shown = [(m.seq, m.mission_state) for _, m in told]
    assert list(dict.fromkeys(shown)) == [(0, 2), (0, 3), (1, 3), (2, 3), (2, 5)]
    assert max(np.diff([us for us, _ in told])) == 1_000_000
    assert rerun(Recording.open(recording)).comparison.first is None


SEEN = """\
name: seen
vehicle: {start: {north: 3, east: 3}}
world:
  bounds: {north: [0, 30], east: [0, 20], altitude: [0, 4]}
  obstacles:
    - box: {north: [9, 10], east: [4, 9], altitude: [0, 4]}
      hidden: true
    - box: {north: [23, 24], east: [12, 14], altitude: [0, 4]}
      hidden: true
sensing: {use: true}
limits: {speed: 2}
steps:
  - takeoff: {altitude: 1.5}
  - via: [{north: 9.5, east: 6.5, altitude: 1.5}, {north: 14, east: 9, altitude: 1.5}]
  - goto: {north: 20, east: 3, altitude: 1.5}
  - orbit: {north: 23, east: 10, altitude: 1.5, radius: 3}
  - land
"""


@pytest.mark.slow
def test_what_is_seen_on_a_leg_with_points_or_on_a_circle_is_flown_round_and_the_points_are_passed(fly):
    flight = fly(SEEN)
    assert any("planned by what is seen, point by point" in note for note in flight.notes)
    assert any("something is in the way: stopping before it" in note for note in flight.notes)
    assert any("something stays in the way: round it" in note for note in flight.notes)
    assert flight.verdict.ok, flight.verdict.failure
    assert any("a point on the way is left out: GoalInCollision" in note for note in flight.notes)  # within the wall
    _, p, _, _, _ = path(flight)
    assert np.linalg.norm(p - (14, 9, -1.5), axis=1).min() < 1e-3
    assert np.hypot(p[-1][0] - 23.0, p[-1][1] - 10.0) == pytest.approx(3.0, abs=1e-3)
    assert flight.verdict.min_clearance_m > 0.05
    smooth(flight)


@pytest.mark.slow
def test_orders_work_while_the_flight_is_replanned_from_what_is_seen(fly):
    text = SEEN.replace(next(line for line in SEEN.splitlines(keepends=True) if "- via:" in line), "").replace(
        "  - orbit: {north: 23, east: 10, altitude: 1.5, radius: 3}\n", ""
    )
    flight = fly(
        text.replace("[4, 9]", "[0, 6]"),
        operator=orders(
            (after(2.0), Order("hold")),
            (after(4.0), Order("resume")),
            (after(2.0), Order("goto", (18.0, 15.0, 1.5))),
            (after(16.0), Order("resume")),
        ),
    )
    assert flight.verdict.ok, flight.verdict.failure
    _, p, _, _, _ = path(flight)
    assert np.linalg.norm(p - (18, 15, -1.5), axis=1).min() < 1e-3
    np.testing.assert_allclose(p[-1], (20, 3, -1.5), atol=0.05)
    assert flight.verdict.min_clearance_m > 0.05
