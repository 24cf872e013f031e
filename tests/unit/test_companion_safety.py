"""The safety table, row by row: what a puppet vehicle of either flavour says, and what the companion makes of it."""

import re
from pathlib import Path

import numpy as np
import pytest

from companion.autopilots import AUTOPILOTS
from companion.core import Companion, CompanionConfig
from companion.drivers.planning import InlinePlanning
from companion.geofence import Geofence
from companion.missionfile import parse_mission
from companion.phases import TRANSITIONS, Event, Phase
from companion.safety import SAFETY, Action
from companion.seam import Order, PlanWanted, Reference
from companion.vehiclelink import VEHICLE_LINK
from wire.datagram import Datagram
from wire.dialect import mavlink

MISSION = parse_mission(
    b"""\
name: long hold
vehicle: {start: {north: 5, east: 5}}
world: {bounds: {north: [0, 10], east: [0, 10], altitude: [0, 4]}}
steps: [{takeoff: {altitude: 2}}, {hold: {seconds: 1000}}, land]
""",
    "hold.yaml",
)
WALLED = parse_mission(
    b"""\
name: behind a wall
vehicle: {start: {north: 5, east: 3}}
world:
  bounds: {north: [0, 20], east: [0, 20], altitude: [0, 6]}
  obstacles: [{box: {north: [0, 14], east: [9.5, 10.5], altitude: [0, 6]}}]
steps: [{takeoff: {altitude: 2}}, {hold: {seconds: 1000}}, land]
""",
    "walled.yaml",
)
NUMBER = {"px4": 12, "ardupilot": 3}
OURS = {"px4": 6 << 16, "ardupilot": 4}
HOLD = {"px4": 4 << 16 | 3 << 24, "ardupilot": 5}
LAND = {"px4": 4 << 16 | 6 << 24, "ardupilot": 9}
RTL = {"px4": 4 << 16 | 5 << 24, "ardupilot": 6}
GROUND, AIR = mavlink.MAV_LANDED_STATE_ON_GROUND, mavlink.MAV_LANDED_STATE_IN_AIR


class Puppet:
    """A vehicle that says what it is told to, to a companion that is in the phase it is put into."""

    def __init__(self, flavour, phase, mission=MISSION):
        self.sent, self.references, self.answers, self._owed = [], [], {}, []
        self.plans, self.planned = InlinePlanning(mission.planner_world()), False
        self.silent_on, self.decoder = (), mavlink.MAVLink(None)
        self.flavour, self.mav = flavour, mavlink.MAVLink(None, srcSystem=1, srcComponent=1)
        self.mode = self.intended = LAND[flavour] if phase is Phase.LANDING else OURS[flavour]
        self.armed, self.status, self.battery = True, 4, 90
        self.landed = GROUND if phase is Phase.TAKING_OFF else AIR
        self.flags, self.ratio, self.at, self.boot_ms = 831, 0.1, None, 100_000
        self.says_position = self.says_anything = True
        self.now_us = 1_000_000
        self.companion = Companion(mission, CompanionConfig())
        self.companion.autopilot = AUTOPILOTS[NUMBER[flavour]]
        self.notes = []
        self.companion.itinerary.begin(0) if phase is Phase.TAKING_OFF else self.companion.itinerary.airborne(0)
        if phase is Phase.REJOINING:  # the mission waits elsewhere, and the plan of a way there is never answered
            self.at = self.companion.itinerary.reference(0).position_m + np.array([1.5, 0.0, 0.0])
        self.companion.step(self.now_us, self.said())
        self.companion.step(self.now_us, self.said())
        self.companion.origin_n = np.zeros(3)
        self.companion.phase, self.companion._entered_us, self.companion.failure = phase, self.now_us, ""
        self.companion._asking.forget()
        if phase is Phase.REJOINING:
            self.companion.rejoin.begin(self.companion.pose(0))
            self.companion.itinerary.stopped = True
            self.companion.setpoints.reference = None
        for _ in range(4):
            self.tick()
        assert self.companion.phase is phase

    def said(self):
        if not self.says_anything:
            return []
        m, base = mavlink, 0x80 if self.armed else 0
        out = [
            m.MAVLink_heartbeat_message(2, NUMBER[self.flavour], 1 | base, self.mode, self.status, 3),
            m.MAVLink_extended_sys_state_message(0, self.landed),
            m.MAVLink_sys_status_message(0, 0, 2**28, 0, 0, 0, self.battery, 0, 0, 0, 0, 0, 0),
        ]
        if self.flavour == "px4":
            out.append(m.MAVLink_estimator_status_message(0, self.flags, self.ratio, 0, 0, 0, 0, 0, 0, 0))
            out.append(m.MAVLink_current_mode_message(0, self.mode, self.intended))
        else:
            out.append(m.MAVLink_ekf_status_report_message(self.flags, self.ratio, 0, 0, 0, 0))
        if self.says_position:
            here = self.companion.itinerary.reference(self.now_us).position_m if self.at is None else self.at
            out.append(m.MAVLink_local_position_ned_message(self.boot_ms, *here, 0, 0, 0))
            out.append(m.MAVLink_attitude_message(self.boot_ms, 0, 0, 0, 0, 0, 0))
        out, self._owed = [x for x in out + self._owed if x.get_type() not in self.silent_on], []
        return [Datagram(VEHICLE_LINK, bytes(x.pack(self.mav)), ("vehicle", 1)) for x in out]

    def hear(self, outputs):
        """Keep what is sent to it; a command whose answer is known (`answers`, by its number) is acknowledged."""
        for output in outputs:
            if isinstance(output, Reference):
                self.references.append(output)
            elif isinstance(output, Datagram) and output.link == VEHICLE_LINK:
                message = self.decoder.decode(bytearray(output.data))
                if message.get_type() == "COMMAND_LONG":
                    self.sent.append((self.now_us, message.command, message.param1, message.param2, message.param3))
                    if message.command in self.answers or None in self.answers:
                        result = self.answers.get(message.command, self.answers.get(None))
                        ack = mavlink.MAVLink_command_ack_message(message.command, result, 0, 0, 1, 191)
                        self._owed.append(ack)

    def modes_asked(self, since_us=0):
        return [tuple(int(v) for v in sent[3:]) for sent in self.sent if sent[1] == 176 and sent[0] >= since_us]

    def tick(self, period_us=20_000):
        self.now_us += period_us
        self.boot_ms += period_us // 1000
        outputs = self.companion.step(self.now_us, self.said() + (self.plans.ready() if self.planned else []))
        self.notes += [o.text for o in outputs if hasattr(o, "text")]
        self.hear(outputs)
        for wanted in [o for o in outputs if isinstance(o, PlanWanted)]:
            self.plans.submit(wanted)

    def run(self, seconds):
        for _ in range(round(seconds * 50)):
            self.tick()
        return self.companion


def says(**changes):
    def apply(puppet):
        for name, value in changes.items():
            setattr(puppet, name, value[puppet.flavour] if isinstance(value, dict) else value)

    return apply


def strays(metres):
    return lambda p: setattr(p, "at", p.companion.itinerary.reference(p.now_us).position_m + np.array([metres, 0, 0]))


def boots_again(puppet):
    puppet.boot_ms = 500


def no_way(puppet):
    puppet.companion.replanning.trouble = "walled in"


def sees_nothing(puppet):
    puppet.companion.seeing.trouble = lambda flight_us: "no scan from the obstacle sensor for 0.6 s"


def never_returns(puppet):
    puppet.battery = 14
    puppet.companion.itinerary._start = np.array([2.0, 2.0, 0.0])  # and no plan is ever answered


def comes_near_the_fence(puppet):
    puppet.companion.setpoints.fence = Geofence(ceiling=2.2, margin=0.3)  # it flies at 2 m


def leaps(puppet):
    leg = puppet.companion.itinerary._main.leg
    leg.end = leg.end + np.array([1.5, 0.0, 0.0])


def stalls(puppet):
    puppet.tick(700_000)


FLYING, LANDING = Phase.FLYING, Phase.LANDING
ROWS = [
    # rule, phase it happens in, what happens, when nothing has followed yet [s], when it has, phase then, reason
    ("rebooted", FLYING, boots_again, 0.0, 0.2, Phase.FAILED, "the vehicle booted again in the air"),
    ("disarmed", FLYING, says(armed=False), 0.0, 0.5, Phase.FAILED, "the vehicle disarmed in the air"),
    ("landed", LANDING, says(armed=False, landed=GROUND), 0.0, 0.1, Phase.DONE, ""),
    ("gone", LANDING, says(says_anything=False), 55.0, 61.0, Phase.FAILED, "nothing heard from the vehicle for 60 s"),
    ("mode taken", FLYING, says(mode=HOLD, intended=HOLD), 0.2, 0.5, Phase.HANDED_OVER, "the vehicle is in"),
    ("landing stopped", LANDING, says(mode=HOLD, intended=HOLD), 0.2, 0.5, Phase.HANDED_OVER, "the vehicle stopped"),
    ("silent", FLYING, says(says_anything=False), 2.9, 3.2, Phase.LINK_LOST, ""),
    ("no position", FLYING, says(says_position=False), 3.2, 3.8, Phase.LANDING, "no position from the vehicle for 3 s"),
    ("no estimate", FLYING, says(flags=1024), 0.9, 1.2, Phase.LANDING, "estimator not converged: landing"),
    ("astray", Phase.REJOINING, None, 0.0, 0.0, Phase.LANDING, ""),  # below, by itself
    ("stranded", FLYING, no_way, 29.0, 30.2, Phase.LANDING, r"no safe way for 30 s \(walled in\)"),
    ("blind for long", FLYING, sees_nothing, 29.0, 30.2, Phase.LANDING, r"nothing seen for 30 s \(no scan"),
    ("held for long", FLYING, says(ratio=1.5), 31.8, 32.3, Phase.LANDING, r"held for 30 s \(the estimator rejects vel"),
    ("held for long", FLYING, comes_near_the_fence, 29.8, 30.3, Phase.LANDING, r"held for 30 s \(too near the fence\)"),
    ("takeoff late", Phase.TAKING_OFF, says(landed=GROUND), 33.0, 35.0, Phase.LANDING, "not in the air 34 s"),
    (
        "rejoining late",
        Phase.REJOINING,
        says(),
        28.0,
        31.0,
        Phase.LANDING,
        "no way back to the mission in 30 s",
    ),
    ("battery critical", FLYING, says(battery=6), 1.9, 2.2, Phase.LANDING, "battery at 6%: landing"),
    ("no way home", FLYING, never_returns, 31.9, 32.3, Phase.LANDING, "battery at 14%: returning"),
    ("battery low", FLYING, says(battery=14), 1.9, 2.5, Phase.LANDING, "battery at 14%: returning"),  # it is home
    ("jump", FLYING, leaps, None, 0.1, Phase.REJOINING, ""),
    ("stalled", FLYING, stalls, None, 0.1, Phase.REJOINING, ""),
    ("adrift", FLYING, strays(1.5), 0.2, 0.5, Phase.REJOINING, ""),
]


@pytest.mark.parametrize("flavour", ["px4", "ardupilot"])
@pytest.mark.parametrize(
    ("rule", "phase", "happens", "not_before", "by", "then", "reason"),
    [r for r in ROWS if r[2]],
    ids=lambda v: getattr(v, "__name__", str(v)),
)
def test_a_row_of_the_table_leads_where_it_says_and_not_before(
    flavour, rule, phase, happens, not_before, by, then, reason
):
    puppet = Puppet(flavour, phase)
    happens(puppet)
    if not_before is not None:
        assert puppet.run(not_before).phase is phase, puppet.notes
    companion = puppet.run(by - (not_before or 0.0))
    gone_through = [note.split(" -> ")[1].split(" (")[0] for note in puppet.notes if " -> " in note]
    assert companion.phase is then or then.value in gone_through, puppet.notes
    assert re.match(reason, companion.failure)


@pytest.mark.parametrize("flavour", ["px4", "ardupilot"])
@pytest.mark.parametrize(
    ("happens", "after_s", "why"),
    [
        (says(says_position=False), 0.6, "no position for 0.5 s"),
        (says(ratio=1.5), 2.1, "the estimator rejects velocity"),
        (comes_near_the_fence, 0.1, "too near the fence"),
        (says(silent_on=("HEARTBEAT",)), 3.1, "no HEARTBEAT for 3 s, so its mode may be another's"),
        (says(silent_on=("ESTIMATOR_STATUS", "EKF_STATUS_REPORT")), 2.1, "no word of the estimator for 2 s"),
    ],
    ids=["position late", "estimate doubted", "at the fence", "no heartbeat", "estimate unknown"],
)
def test_a_row_that_holds_stands_on_the_path_and_goes_on_when_it_is_over(flavour, happens, after_s, why):
    puppet = Puppet(flavour, FLYING)
    happens(puppet)
    companion = puppet.run(after_s)
    assert companion.phase is FLYING
    assert companion.itinerary.stopped
    assert f"holding: {why}" in puppet.notes
    puppet.says_position, puppet.ratio, puppet.silent_on, puppet.companion.setpoints.fence = True, 0.1, (), None
    puppet.run(0.2)
    assert companion.phase is FLYING
    assert not companion.itinerary.stopped


def test_a_vehicle_whose_sensor_is_silent_stands_on_the_path_until_it_speaks_again():
    puppet = Puppet("px4", FLYING)
    sees_nothing(puppet)
    companion = puppet.run(5.0)
    assert companion.phase is FLYING
    assert companion.itinerary.stopped
    assert "holding: no scan from the obstacle sensor for 0.6 s" in puppet.notes
    companion.seeing.trouble = lambda flight_us: ""
    puppet.run(0.2)
    assert not companion.itinerary.stopped


def test_a_px4_that_misses_our_setpoints_is_waited_for_where_it_holds():
    puppet = Puppet("px4", FLYING)
    puppet.mode = HOLD["px4"]  # OFFBOARD is still intended
    assert puppet.run(0.6).phase is Phase.REJOINING
    puppet.mode = OURS["px4"]
    assert puppet.run(0.5).phase is FLYING  # it stands where the mission waits


@pytest.mark.parametrize("flavour", ["px4", "ardupilot"])
def test_a_vehicle_that_does_not_follow_on_the_way_back_is_landed(flavour):
    puppet = Puppet(flavour, Phase.REJOINING)
    puppet.run(0.1)
    puppet.at = puppet.at + np.array([-3.0, 0.0, 0.0])
    assert puppet.run(0.8).phase is Phase.REJOINING
    assert puppet.run(0.5).phase is Phase.LANDING
    assert re.match(r"the vehicle is 3\.0 m from its reference", puppet.companion.failure)


HOME = {"px4": (4, 5), "ardupilot": (6, 0)}
DOWN = {"px4": (4, 6), "ardupilot": (9, 0)}


@pytest.mark.parametrize("flavour", ["px4", "ardupilot"])
def test_a_low_battery_flies_a_planned_way_home_and_lands_there(flavour):
    puppet = Puppet(flavour, FLYING, WALLED)
    puppet.planned = True
    puppet.run(3.0)
    puppet.companion.itinerary._start = np.array([2.0, 17.0, 0.0])  # behind a wall from where it holds
    puppet.battery = 14
    puppet.run(2.2)
    assert "battery at 14%: returning (return on a planned way)" in puppet.notes
    assert puppet.companion.phase is FLYING
    assert "it returns" in puppet.companion.obey(puppet.now_us, Order("hold"))
    puppet.run(30.0)
    assert puppet.companion.phase is Phase.LANDING
    assert set(puppet.modes_asked()) == {DOWN[flavour]}
    world, way = WALLED.planner_world(), np.array([reference.position_m for reference in puppet.references])
    assert world.distance(way).min() > WALLED.planner_radius() - 0.01
    assert np.linalg.norm(way[-1][:2] - [2.0, 17.0]) < 0.01
    assert puppet.companion.failure == "battery at 14%: returning"


@pytest.mark.parametrize("flavour", ["px4", "ardupilot"])
def test_a_low_battery_without_a_way_home_is_the_autopilots_to_return_with_and_the_reason_is_told(flavour):
    puppet = Puppet(flavour, FLYING, WALLED)
    puppet.planned = True
    puppet.companion.itinerary._start = np.array([2.0, 10.0, 0.0])  # in the wall
    puppet.battery = 14
    puppet.run(2.5)
    assert puppet.companion.phase is Phase.LANDING
    assert set(puppet.modes_asked()) == {HOME[flavour]}
    assert any(note.startswith("no way home is planned (north 2, east 10") for note in puppet.notes), puppet.notes


@pytest.mark.parametrize("flavour", ["px4", "ardupilot"])
@pytest.mark.parametrize("why", ["an order", "the battery"])
def test_a_vehicle_that_returns_by_its_autopilot_is_landed_where_it_is_when_that_is_ordered_or_the_battery_ends(
    flavour, why
):
    puppet = Puppet(flavour, FLYING, WALLED)
    puppet.planned = True
    puppet.answers[176] = 0
    puppet.companion.itinerary._start = np.array([2.0, 10.0, 0.0])
    puppet.battery = 14
    puppet.run(2.5)
    puppet.mode = puppet.intended = RTL[flavour]
    puppet.run(3.0)
    assert set(puppet.modes_asked()) == {HOME[flavour]}
    if why == "an order":
        assert puppet.companion.obey(puppet.now_us, Order("land", source="255/190")) == ""
    else:
        puppet.battery = 6
    since_us = puppet.now_us + 1
    puppet.run(5.0)
    asked = puppet.modes_asked(since_us)
    assert set(asked) == {DOWN[flavour]}
    assert len(asked) > 1  # it was accepted, and does not show
    puppet.mode = puppet.intended = LAND[flavour]
    puppet.run(0.5)
    since_us = puppet.now_us + 1
    puppet.run(5.0)
    assert puppet.modes_asked(since_us) == []
    puppet.armed, puppet.landed = False, GROUND
    assert puppet.run(0.2).phase is Phase.DONE


@pytest.mark.parametrize("flavour", ["px4", "ardupilot"])
def test_a_vehicle_is_not_ready_with_a_battery_that_it_would_have_to_return_with(flavour):
    puppet = Puppet(flavour, FLYING)
    puppet.battery, puppet.armed, puppet.landed = 5, False, GROUND
    puppet.tick()
    assert "battery at 5%" in puppet.companion.autopilot.not_ready(puppet.now_us, puppet.companion.telemetry)


def interrupted(phase):
    puppet = Puppet("px4", FLYING if phase is Phase.LINK_LOST else phase)
    if phase is Phase.LINK_LOST:
        puppet.says_anything = False
        assert puppet.run(3.2).phase is phase
    return puppet


@pytest.mark.parametrize("phase", [Phase.TAKING_OFF, Phase.REJOINING, Phase.LINK_LOST])
def test_a_hold_ordered_while_the_mission_is_interrupted_is_carried_out_when_it_goes_on(phase):
    puppet = interrupted(phase)
    assert puppet.companion.obey(puppet.now_us, Order("resume")) == "nothing is held"
    assert puppet.companion.obey(puppet.now_us, Order("return")) == ""
    assert puppet.companion.obey(puppet.now_us, Order("hold")) == ""  # the newest counts
    puppet.companion.phase, puppet.at, puppet.says_anything = FLYING, None, True
    puppet.companion.setpoints.reference, puppet.companion.itinerary.stopped = None, False
    puppet.run(3.0)
    assert "hold, as ordered before" in puppet.notes
    assert puppet.companion.itinerary.holding
    assert puppet.companion.phase is FLYING


@pytest.mark.parametrize("phase", [Phase.TAKING_OFF, Phase.REJOINING, Phase.LINK_LOST])
def test_an_abort_lands_at_once_where_the_mission_is_interrupted(phase):
    puppet = interrupted(phase)
    assert puppet.companion.obey(puppet.now_us, Order("abort")) == ""
    assert puppet.run(0.1).phase is Phase.LANDING


def test_a_vehicle_that_a_pilot_flies_is_not_landed_by_a_ground_station_and_on_the_ground_not_taken_back():
    puppet = Puppet("px4", FLYING)
    puppet.mode = puppet.intended = PILOTS["px4"]
    assert puppet.run(1.0).phase is Phase.HANDED_OVER
    assert "somebody else flies" in puppet.companion.obey(puppet.now_us, Order("land", source="255/190"))
    puppet.landed = GROUND
    puppet.run(0.1)
    assert puppet.companion.obey(puppet.now_us, Order("resume")) == "the vehicle stands on the ground"
    assert puppet.run(1.0).phase is Phase.HANDED_OVER
    assert puppet.companion.obey(puppet.now_us, Order("land")) == ""  # the operator's Ctrl-C
    assert puppet.run(0.1).phase is Phase.FAILED


def test_a_vehicle_that_is_armed_when_the_flight_is_prepared_is_not_waited_for():
    puppet = Puppet("px4", FLYING)
    puppet.companion.phase, puppet.companion._boots = Phase.PREPARING, puppet.companion.telemetry.boots
    assert puppet.run(0.1).phase is Phase.FAILED
    assert "somebody else armed the vehicle" in puppet.companion.failure


@pytest.mark.parametrize("flavour", ["px4", "ardupilot"])
def test_a_vehicle_that_a_pilot_had_is_taken_back_only_when_the_operator_says_so(flavour):
    puppet = Puppet(flavour, FLYING)
    puppet.mode = puppet.intended = HOLD[flavour]
    assert puppet.run(1.0).phase is Phase.HANDED_OVER
    puppet.mode = puppet.intended = OURS[flavour]
    assert puppet.run(1.0).phase is Phase.HANDED_OVER  # not by itself
    assert not puppet.companion.obey(puppet.now_us, Order("resume"))
    puppet.run(0.1)
    assert puppet.companion.phase in (Phase.REJOINING, FLYING)
    assert puppet.run(1.0).phase is FLYING
    assert not puppet.companion.failure


def test_rules_stand_in_the_order_of_their_urgency_and_name_events_that_the_phases_know():
    order = list(Action)
    urgency = [order.index(rule.action) for rule in SAFETY]
    assert urgency == sorted(urgency)
    for rule in SAFETY:
        assert (rule.event is None) is (rule.action is Action.HOLD)
        for phase in rule.phases:
            assert rule.event is None or (phase, rule.event) in TRANSITIONS, rule.name


def test_every_row_is_in_the_page_and_walked_here():
    page = Path("docs/safety.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| ([a-z ]+) \|", page, flags=re.MULTILINE)
    assert [name for name in rows if name != "rule"] == [rule.name for rule in SAFETY]
    walked = {row[0] for row in ROWS} | {
        "stream lost",
        "failsafe",
        "pilot unknown",
        "position late",
        "blind",
        "no heartbeat",
        "estimate unknown",
        "estimate doubted",
        "at the fence",
    }
    assert walked == {rule.name for rule in SAFETY}


def test_a_silent_vehicle_is_no_event_of_the_ground():
    assert (Phase.HANDED_OVER, Event.VEHICLE_SILENT) not in TRANSITIONS


PILOTS = {"px4": 3 << 16, "ardupilot": 5}  # Position, LOITER


def commands_after(puppet, happening, seconds):
    """Commands sent while something happens, and in the phase that follows."""
    decoder, sent = mavlink.MAVLink(None), []
    happening(puppet)
    for _ in range(round(seconds * 50)):
        puppet.now_us, puppet.boot_ms = puppet.now_us + 20_000, puppet.boot_ms + 20
        for output in puppet.companion.step(puppet.now_us, puppet.said()):
            if isinstance(output, Datagram) and output.link == VEHICLE_LINK:
                message = decoder.decode(bytearray(output.data))
                sent += [message.command] if message.get_type() == "COMMAND_LONG" else []
    return sent


@pytest.mark.parametrize("flavour", ["px4", "ardupilot"])
def test_a_pilot_who_takes_the_mode_again_after_giving_it_back_is_not_asked_for_it(flavour):
    puppet = Puppet(flavour, Phase.FLYING)
    says(mode=HOLD, intended=HOLD)(puppet)
    assert puppet.run(1.0).phase is Phase.HANDED_OVER
    strays(2.5)(puppet)
    assert puppet.companion.obey(puppet.now_us, Order("resume")) == ""
    puppet.run(0.2)
    says(mode=OURS, intended=OURS)(puppet)
    assert puppet.run(1.0).phase is Phase.REJOINING
    assert commands_after(puppet, says(mode=PILOTS, intended=PILOTS), 5.0) == []
    assert puppet.companion.phase is Phase.HANDED_OVER


@pytest.mark.parametrize("flavour", ["px4", "ardupilot"])
def test_a_pilot_who_takes_the_mode_before_a_landing_shows_is_told_to_land_no_more_than_once(flavour):
    puppet = Puppet(flavour, Phase.FLYING)
    assert puppet.companion.obey(puppet.now_us, Order("land")) == ""
    assert puppet.run(0.3).phase is Phase.LANDING
    assert len(commands_after(puppet, says(mode=PILOTS, intended=PILOTS), 10.0)) <= 1
    assert puppet.companion.phase is Phase.HANDED_OVER


@pytest.mark.parametrize("flavour", ["px4", "ardupilot"])
@pytest.mark.parametrize("phase", [Phase.PLANNING, Phase.ENGAGING])
def test_a_vehicle_that_somebody_else_arms_meanwhile_is_not_taken_over(flavour, phase):
    puppet = Puppet(flavour, Phase.FLYING)
    puppet.companion.phase, puppet.companion._boots = phase, puppet.companion.telemetry.boots
    assert commands_after(puppet, says(mode=PILOTS, intended=PILOTS), 2.0) == []
    assert puppet.companion.phase is Phase.FAILED
    assert "somebody else armed the vehicle" in puppet.companion.failure


def test_a_vehicle_armed_by_its_pilot_in_another_mode_is_not_told_to_take_off():
    puppet = Puppet("ardupilot", Phase.FLYING)
    puppet.companion.phase, puppet.companion._boots = Phase.ARMING, puppet.companion.telemetry.boots
    says(armed=False, landed=GROUND)(puppet)
    puppet.run(1.0)
    assert mavlink.MAV_CMD_NAV_TAKEOFF not in commands_after(puppet, says(armed=True, mode=PILOTS), 1.0)
    assert puppet.companion.phase is Phase.FAILED


def test_setpoints_stay_where_a_landing_begins_that_comes_from_no_path():
    puppet = Puppet("px4", Phase.REJOINING)
    puppet.run(0.2)
    held = puppet.companion.setpoints.reference.position_m
    assert puppet.companion.obey(puppet.now_us, Order("land")) == ""
    assert puppet.run(0.4).phase is Phase.LANDING
    assert np.array_equal(puppet.companion.setpoints.reference.position_m, held)


LONG_WAY = parse_mission(
    b"""\
name: over and away
vehicle: {start: {north: 2, east: 2}}
world: {bounds: {north: [0, 20], east: [0, 20], altitude: [0, 6]}}
steps: [{takeoff: {altitude: 1.5}}, {hold: {seconds: 3}}, {goto: {north: 15, east: 15, altitude: 1.5}}, land]
""",
    "away.yaml",
)


def test_a_vehicle_that_does_not_lift_gets_setpoints_above_its_place_alone_and_is_landed():
    puppet = Puppet("px4", Phase.TAKING_OFF, LONG_WAY)
    puppet.at = np.array([2.0, 2.0, 0.0])
    puppet.run(40.0)
    assert puppet.companion.phase is Phase.LANDING
    assert "not in the air 33 s after the takeoff began" in puppet.companion.failure
    places = np.array([reference.position_m for reference in puppet.references])
    assert np.ptp(places[:, :2], axis=0).max() == 0.0
    assert places[:, 2].min() == pytest.approx(-1.5)


def test_a_climb_that_is_told_to_be_over_late_goes_on_from_its_top():
    puppet = Puppet("px4", Phase.TAKING_OFF, LONG_WAY)
    puppet.run(20.0)
    assert puppet.companion.phase is Phase.TAKING_OFF
    puppet.landed = AIR
    puppet.run(0.1)
    assert puppet.companion.phase is FLYING
    assert puppet.companion.itinerary.index == 1
    places = np.array([reference.position_m for reference in puppet.references])
    assert np.abs(np.diff(places, axis=0)).max() < 0.05


def test_a_vehicle_that_does_not_follow_the_climb_is_landed_after_a_second():
    puppet = Puppet("px4", Phase.TAKING_OFF)
    puppet.run(4.0)
    strays(2.5)(puppet)
    assert puppet.run(0.8).phase is Phase.TAKING_OFF
    assert puppet.run(0.5).phase is Phase.LANDING


def test_a_climb_stands_while_the_position_is_late():
    puppet = Puppet("px4", Phase.TAKING_OFF)
    puppet.run(1.0)
    puppet.says_position = False
    puppet.run(1.5)
    held = puppet.companion.setpoints.reference.position_m
    puppet.run(0.5)
    assert "holding: no position for 0.5 s" in puppet.notes
    assert np.array_equal(puppet.companion.setpoints.reference.position_m, held)
    assert held[2] > -1.9


@pytest.mark.parametrize("flavour", ["px4", "ardupilot"])
def test_a_vehicle_whose_mode_is_told_no_more_is_held_then_left_alone_with_no_mode_asked_for(flavour):
    puppet = Puppet(flavour, FLYING)
    puppet.silent_on = ("HEARTBEAT", "CURRENT_MODE")
    assert puppet.run(2.9).phase is FLYING
    assert not puppet.companion.itinerary.stopped
    assert puppet.run(0.2).itinerary.stopped
    assert puppet.run(26.0).phase is FLYING
    puppet.mode = puppet.intended = PILOTS[flavour]
    assert puppet.run(1.2).phase is Phase.HANDED_OVER
    puppet.run(20.0)
    assert puppet.modes_asked() == []
    assert "no HEARTBEAT from the vehicle for 30 s: who flies it is not known" in puppet.companion.failure


def test_a_px4_that_still_tells_its_mode_is_landed_when_its_heartbeat_stays_away():
    puppet = Puppet("px4", FLYING)
    puppet.silent_on = ("HEARTBEAT",)
    assert puppet.run(32.0).phase is FLYING
    assert puppet.run(1.5).phase is Phase.LANDING
    assert "held for 30 s (no HEARTBEAT" in puppet.companion.failure


@pytest.mark.parametrize("flavour", ["px4", "ardupilot"])
def test_an_estimator_of_which_nothing_is_told_is_not_flown_by_for_ever(flavour):
    puppet = Puppet(flavour, FLYING)
    puppet.silent_on = ("ESTIMATOR_STATUS", "EKF_STATUS_REPORT")
    assert puppet.run(31.5).phase is FLYING
    assert puppet.run(1.0).phase is Phase.LANDING
    assert "held for 30 s (no word of the estimator for 2 s): landing" in puppet.companion.failure


def test_a_landing_is_not_asked_for_again_while_no_heartbeat_tells_whose_vehicle_it_is():
    puppet = Puppet("ardupilot", FLYING)
    puppet.answers[176] = 0
    puppet.companion.obey(puppet.now_us, Order("land"))
    puppet.silent_on = ("HEARTBEAT",)
    puppet.run(5.0)
    asked = len(puppet.modes_asked())
    puppet.run(20.0)
    assert len(puppet.modes_asked()) == asked <= 2


def arming(flavour):
    puppet = Puppet(flavour, FLYING)
    puppet.companion.phase, puppet.companion._boots = Phase.ARMING, puppet.companion.telemetry.boots
    puppet.companion._asking.question = puppet.companion.autopilot.arm()
    puppet.armed, puppet.landed, puppet.mode = False, GROUND, OURS[flavour]
    return puppet


def disarms(puppet, since_us=0):
    return [at for at, command, p1, *_ in puppet.sent if (command, p1) == (400, 0.0) and at >= since_us]


@pytest.mark.parametrize("flavour", ["px4", "ardupilot"])
def test_a_vehicle_that_arms_after_the_flight_was_called_off_is_told_to_disarm_until_it_is(flavour):
    puppet = arming(flavour)
    puppet.run(0.1)
    assert puppet.companion.obey(puppet.now_us, Order("land")) == ""
    puppet.run(0.2)
    puppet.armed = True  # our word to arm arrived late
    assert puppet.run(5.0).phase is Phase.DISARMING
    assert len(disarms(puppet)) >= 8  # the answers are lost
    puppet.answers[400] = 0
    puppet.run(5.0)
    assert puppet.companion.phase is Phase.DISARMING  # accepted, and not done
    assert disarms(puppet, puppet.now_us - 3_000_000)
    puppet.armed = False
    assert puppet.run(0.1).phase is Phase.FAILED
    assert puppet.companion.failure == "cancelled by the operator"


@pytest.mark.parametrize("flavour", ["px4", "ardupilot"])
def test_a_vehicle_that_refuses_to_arm_is_disarmed_for_as_long_as_its_word_can_be_late(flavour):
    puppet = arming(flavour)
    puppet.answers[400] = mavlink.MAV_RESULT_DENIED
    assert puppet.run(1.0).phase is Phase.DISARMING
    assert disarms(puppet)
    assert puppet.run(0.5).phase is Phase.FAILED
    assert "the vehicle refused to arm" in puppet.companion.failure


@pytest.mark.parametrize("flavour", ["px4", "ardupilot"])
def test_a_vehicle_that_falls_silent_while_it_is_armed_is_disarmed_when_it_is_heard_again(flavour):
    puppet = arming(flavour)
    puppet.run(0.1)
    puppet.says_anything = False
    assert puppet.run(10.0).phase is Phase.DISARMING
    puppet.armed = puppet.says_anything = True
    since_us = puppet.now_us
    puppet.run(2.0)
    assert disarms(puppet, since_us)
    puppet.armed = False
    assert puppet.run(0.5).phase is Phase.FAILED
    assert puppet.companion.failure.startswith("nothing heard from the vehicle")


def test_a_vehicle_that_flies_though_its_takeoff_was_called_off_is_landed_and_one_that_a_pilot_has_is_left():
    for change, phase in ((says(armed=True, landed=AIR), Phase.LANDING), (says(armed=True, mode=PILOTS), Phase.FAILED)):
        puppet = arming("ardupilot")
        puppet.companion.obey(puppet.now_us, Order("land"))
        puppet.run(0.5)
        change(puppet)
        assert puppet.run(0.5).phase is phase


@pytest.mark.parametrize("phase", [FLYING, Phase.TAKING_OFF])
def test_a_px4_that_holds_though_it_hears_us_is_its_failsafes_and_never_landed(phase):
    puppet = Puppet("px4", phase)
    puppet.answers[None] = 0
    puppet.mode, puppet.status = HOLD["px4"], 5  # OFFBOARD is still intended: its link to the sticks is gone, say
    puppet.run(5.0)
    assert puppet.companion.phase is Phase.HANDED_OVER
    puppet.run(40.0)
    assert puppet.modes_asked() == []
    assert puppet.companion.failure == "PX4's failsafe chose Hold though it hears us; it is not fought for"


def test_a_px4_that_holds_and_does_not_hear_us_is_waited_for():
    puppet = Puppet("px4", FLYING)
    puppet.mode = HOLD["px4"]
    assert puppet.run(20.0).phase is Phase.REJOINING
    puppet.answers[None] = 0
    assert puppet.run(1.0).phase is Phase.REJOINING
    puppet.mode = OURS["px4"]  # our setpoints come again, too
    assert puppet.run(0.5).phase is FLYING


@pytest.mark.parametrize("flavour", ["px4", "ardupilot"])
def test_a_reference_that_leaps_is_not_sent_and_a_way_to_it_is_planned(flavour):
    puppet = Puppet(flavour, FLYING, WALLED)
    puppet.planned = True
    puppet.run(0.5)
    before = puppet.companion.setpoints.reference.position_m
    puppet.at = before
    leaps(puppet)
    puppet.run(0.2)
    assert (
        "setpoints do not follow each other: the next is 1.5 m away (hold where it is, then fly back to the path)"
        in (puppet.notes)
    )
    puppet.at = None  # it follows
    for _ in range(200):
        puppet.tick()
        puppet.at = puppet.companion.setpoints.reference.position_m
    assert puppet.companion.phase is FLYING
    places = np.array([reference.position_m for reference in puppet.references])
    assert np.linalg.norm(np.diff(places, axis=0), axis=1).max() < 0.1
    assert places[-1] == pytest.approx(before + np.array([1.5, 0.0, 0.0]), abs=0.06)


def test_setpoints_stay_where_they_are_when_the_vehicle_falls_silent_on_its_way_back():
    puppet = Puppet("px4", Phase.REJOINING)
    puppet.run(0.2)
    held = puppet.companion.setpoints.reference.position_m
    puppet.says_anything = False
    assert puppet.run(4.0).phase is Phase.LINK_LOST
    assert np.array_equal(puppet.companion.setpoints.reference.position_m, held)


def test_no_setpoint_ends_the_climb_of_a_vehicle_that_climbs_by_itself_and_is_not_heard():
    puppet = Puppet("ardupilot", Phase.TAKING_OFF)
    puppet.landed = mavlink.MAV_LANDED_STATE_TAKEOFF
    puppet.run(0.5)
    puppet.says_anything = False
    assert puppet.run(5.0).phase is Phase.LINK_LOST
    puppet.says_anything = True
    assert puppet.run(1.0).phase is Phase.REJOINING
    assert puppet.references == []
    puppet.landed = AIR
    puppet.run(0.2)
    assert puppet.references


def test_a_vehicle_that_leaves_its_path_while_no_heartbeat_tells_whose_it_is_is_not_told_to_land():
    puppet = Puppet("ardupilot", FLYING)
    puppet.silent_on = ("HEARTBEAT",)
    puppet.run(5.0)
    assert puppet.companion.phase is FLYING
    strays(5.0)(puppet)
    puppet.run(10.0)
    strays(12.0)(puppet)
    assert puppet.run(10.0).phase is not Phase.LANDING
    assert puppet.run(6.0).phase is Phase.HANDED_OVER
    assert puppet.modes_asked() == []
