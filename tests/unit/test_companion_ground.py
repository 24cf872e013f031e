"""Ground stations and the companion's own component: plans up and down, commands as orders, a reason for every no."""

import json
import math
import random

import pytest

from companion.core import Companion, CompanionConfig
from companion.errors import MissionError
from companion.geodesy import Geodetic
from companion.ground.progress import Course
from companion.ground.protocol import REPEAT_US, TRIES
from companion.ground.station import GroundStation, plan_file
from companion.missionfile import load_mission, parse_mission
from companion.phases import Phase
from companion.seam import Order
from wire.datagram import Datagram
from wire.dialect import mavlink

OURS, GCS = (1, 191), (255, 190)
MISSION, FENCE = mavlink.MAV_MISSION_TYPE_MISSION, mavlink.MAV_MISSION_TYPE_FENCE
HOME = Geodetic(47.397742, 8.545594, 488.0)
PLACES = [(22, 3, 47.397742, 8.545594, 5.0), (16, 3, 47.3979, 8.5458, 6.0), (20, 2, 0.0, 0.0, 0.0)]
ALLOW = lambda order: ""  # noqa: E731  every order can be carried out


class Client:
    """A ground station's end of the line: packs what it says, unpacks what it hears."""

    def __init__(self, station, identity=GCS, peer=("gcs", 1)):
        self.station, self.identity, self.peer = station, identity, peer
        self.mav = mavlink.MAVLink(None)
        self.mav.srcSystem, self.mav.srcComponent = identity
        self.heard = []

    def say(self, message, now_us=0, obey=ALLOW):
        datagram = Datagram("out0", bytes(message.pack(self.mav)), self.peer)
        return self.hear(self.station.take(now_us, datagram, obey))

    def wait(self, now_us):
        return self.hear(self.station.step(now_us))

    def hear(self, datagrams):
        new = []
        for d in datagrams:
            assert (d.link, d.peer) == ("out0", self.peer)
            message = mavlink.MAVLink(None).decode(bytearray(d.data))
            assert (message.get_srcSystem(), message.get_srcComponent()) == OURS
            new.append(message)
        self.heard += new
        return new

    def command(self, number, *params, confirmation=0, obey=ALLOW, now_us=0, target=OURS):
        values = (*params, *[0.0] * (7 - len(params)))
        return self.say(mavlink.MAVLink_command_long_message(*target, number, confirmation, *values), now_us, obey)

    def upload(self, items=PLACES, now_us=0):
        self.say(mavlink.MAVLink_mission_count_message(*OURS, len(items), 0), now_us)
        while self.heard and self.heard[-1].get_type() == "MISSION_REQUEST_INT":
            self.item(items, self.heard[-1].seq, now_us)
        return next(m for m in reversed(self.heard) if m.get_type() == "MISSION_ACK")

    def give(self, rows, plan=FENCE):
        """Upload rows of what a MISSION_ITEM_INT has after its number; the answer to the last."""
        (last, *_) = self.say(mavlink.MAVLink_mission_count_message(*OURS, len(rows), plan))
        while last.get_type() == "MISSION_REQUEST_INT":
            assert last.mission_type == plan
            last = self.say(mavlink.MAVLink_mission_item_int_message(*OURS, last.seq, *rows[last.seq], plan))[0]
        return last

    def read(self, plan=FENCE):
        """Download rows likewise."""
        (count,) = self.say(mavlink.MAVLink_mission_request_list_message(*OURS, plan))
        assert count.mission_type == plan
        found = [self.say(mavlink.MAVLink_mission_request_int_message(*OURS, k, plan))[0] for k in range(count.count)]
        return [tuple(getattr(m, name) for name in m.fieldnames[3:-1]) for m in found]

    def item(self, items, seq, now_us=0, number=None):
        command, frame, x, y, z = items[seq]
        number = seq if number is None else number
        places = (round(x * 1e7), round(y * 1e7), z)
        return self.say(
            mavlink.MAVLink_mission_item_int_message(*OURS, number, frame, command, 0, 1, 0, 0, 0, 0, *places, 0),
            now_us,
        )

    def texts(self):
        """STATUSTEXT put together again."""
        text = ""
        for m in self.heard:
            if m.get_type() == "STATUSTEXT":
                text += m.text if m.id else m.text + "\n"
        return text


def station(place=(10.0, 20.0, 5.0)):
    return GroundStation(lambda: 1, lambda *asked: place)


def types(messages):
    return [m.get_type() for m in messages]


def test_a_plan_is_asked_for_item_by_item_kept_and_read_back_as_it_was():
    client = Client(station())
    ack = client.upload()
    assert (ack.type, ack.target_system, ack.target_component) == (mavlink.MAV_MISSION_ACCEPTED, *GCS)
    assert [m.seq for m in client.heard if m.get_type() == "MISSION_REQUEST_INT"] == [0, 1, 2]
    (count,) = client.say(mavlink.MAVLink_mission_request_list_message(*OURS, 0))
    assert count.count == 3
    for seq, (command, frame, x, y, z) in enumerate(PLACES):
        (item,) = client.say(mavlink.MAVLink_mission_request_int_message(*OURS, seq, 0))
        found = (item.command, item.frame, item.x, item.y, item.z, item.seq)
        assert found == (command, frame, round(x * 1e7), round(y * 1e7), z, seq)
    (item,) = client.say(mavlink.MAVLink_mission_request_message(*OURS, 1, 0))
    assert (item.get_type(), item.x) == ("MISSION_ITEM", pytest.approx(47.3979))


def test_an_uploaded_plan_is_a_mission_from_where_the_vehicle_stands():
    one = station()
    Client(one).upload()
    mission = parse_mission(plan_file(one.missions, HOME), "upload")
    assert [s.kind for s in mission.steps] == ["takeoff", "goto", "return"]
    assert mission.vehicle.start.anywhere
    assert list(mission.ground_plan.items) == one.missions.items


def test_home_before_the_takeoff_as_ardupilots_plans_have_it_is_no_place_to_go_to():
    one, home = station(), (16, 0, 47.397742, 8.545594, 488.0)
    assert Client(one).upload([home, *PLACES]).type == mavlink.MAV_MISSION_ACCEPTED
    assert len(one.missions.items) == 4
    mission = parse_mission(plan_file(one.missions, HOME), "upload")
    assert [s.kind for s in mission.steps] == ["takeoff", "goto", "return"]
    assert list(mission.ground_plan.items) == one.missions.items


@pytest.mark.parametrize(
    ("items", "result", "words"),
    [
        ([PLACES[0], (183, 2, 0, 0, 0)], "UNSUPPORTED", "item 1: MAV_CMD_DO_SET_SERVO (183) is not flown"),
        ([PLACES[0], (16, 10, 47.4, 8.5, 5)], "UNSUPPORTED", "item 1: MAV_CMD_NAV_WAYPOINT (16): found frame"),
        ([PLACES[0], PLACES[2], PLACES[1]], "INVALID", "item 2: MAV_CMD_NAV_WAYPOINT (16) comes after the landing"),
    ],
)
def test_a_plan_that_is_not_flown_is_refused_with_the_item_and_the_one_before_stays(items, result, words):
    one = station()
    client = Client(one)
    client.upload()
    before = one.missions.items
    ack = client.upload(items)
    assert ack.type == getattr(mavlink, f"MAV_MISSION_{result}")
    assert words in client.texts()
    assert one.missions.items == before


def test_a_request_that_stays_unanswered_is_repeated_and_given_up_after_a_while():
    client = Client(station())
    client.say(mavlink.MAVLink_mission_count_message(*OURS, 3, 0))
    assert client.wait(REPEAT_US - 1) == []
    repeats = [client.wait(k * REPEAT_US) for k in range(1, TRIES)]
    assert [types(r) for r in repeats] == [["MISSION_REQUEST_INT"]] * (TRIES - 1)
    last = client.wait(TRIES * REPEAT_US)
    assert last[0].type == mavlink.MAV_MISSION_OPERATION_CANCELLED
    assert "item 0 of 3 did not come" in client.texts()
    assert client.wait(100 * REPEAT_US) == []


def test_doubled_items_are_passed_over_and_one_out_of_turn_does_not_end_the_upload():
    client = Client(station())
    client.say(mavlink.MAVLink_mission_count_message(*OURS, 3, 0))
    client.item(PLACES, 0)
    (again,) = client.item(PLACES, 0)
    assert (again.get_type(), again.seq) == ("MISSION_REQUEST_INT", 1)
    ack = client.item(PLACES, 2)[0]
    assert ack.type == mavlink.MAV_MISSION_INVALID_SEQUENCE
    client.item(PLACES, 1)
    assert client.item(PLACES, 2)[0].type == mavlink.MAV_MISSION_ACCEPTED


def test_a_second_ground_station_waits_until_the_first_has_uploaded():
    one = station()
    first, second = Client(one), Client(one, (254, 190), ("other", 2))
    first.say(mavlink.MAVLink_mission_count_message(*OURS, 3, 0))
    (ack, *_) = second.say(mavlink.MAVLink_mission_count_message(*OURS, 3, 0))
    assert ack.type == mavlink.MAV_MISSION_DENIED
    assert "somebody else" in second.texts()
    (ack, *_) = second.item(PLACES, 0)
    assert ack.type == mavlink.MAV_MISSION_DENIED
    for seq in range(3):
        last = first.item(PLACES, seq)
    assert last[0].type == mavlink.MAV_MISSION_ACCEPTED


def test_too_many_items_other_kinds_of_plans_and_items_that_are_not_there_are_refused():
    client = Client(station())
    assert client.say(mavlink.MAVLink_mission_count_message(*OURS, 1001, 0))[0].type == mavlink.MAV_MISSION_NO_SPACE
    refused = client.say(mavlink.MAVLink_mission_count_message(*OURS, 3, mavlink.MAV_MISSION_TYPE_RALLY))[0]
    assert (refused.type, refused.mission_type) == (mavlink.MAV_MISSION_UNSUPPORTED, mavlink.MAV_MISSION_TYPE_RALLY)
    assert "rally points refused: rally points are not kept here" in client.texts()
    partly = client.say(mavlink.MAVLink_mission_request_partial_list_message(*OURS, 0, -1, 0))[0]
    assert partly.type == mavlink.MAV_MISSION_UNSUPPORTED
    missing = client.say(mavlink.MAVLink_mission_request_int_message(*OURS, 7, 0))[0]
    assert missing.type == mavlink.MAV_MISSION_INVALID_SEQUENCE
    assert "item 7 was asked for, there are 0" in client.texts()


def test_a_plan_is_cleared():
    one = station()
    client = Client(one)
    client.upload()
    assert client.say(mavlink.MAVLink_mission_clear_all_message(*OURS, 0))[0].type == mavlink.MAV_MISSION_ACCEPTED
    assert one.missions.items == []


def corners(command, *places, inside=0.0):
    """Rows of a polygon's items; y of the first is odd in the last digit, which a float would lose."""
    return [(0, command, 0, 1, float(len(places)), inside, 0.0, 0.0, x, y, 0.0) for x, y in places]


def circle(command, radius, x=473977420, y=85455940):
    return (0, command, 0, 1, radius, 0.0, 0.0, 0.0, x, y, 0.0)


SQUARE = [(473970001, 85440003), (473970001, 85470003), (473990001, 85470003), (473990001, 85440003)]
POND = [(473981001, 85457003), (473981001, 85458003), (473982001, 85458003)]
FENCED = [*corners(5001, *SQUARE), *corners(5002, *POND), circle(5004, 7.25)]


def test_a_fence_is_kept_read_back_as_it_was_and_flown_with():
    one = station()
    client = Client(one)
    ack = client.give(FENCED)
    assert (ack.type, ack.mission_type) == (mavlink.MAV_MISSION_ACCEPTED, FENCE)
    assert client.read() == FENCED
    assert client.read(MISSION) == []
    client.upload()
    data = plan_file(one.missions, HOME)
    mission = parse_mission(data, "upload")
    assert Client(GroundStation(lambda: 1, plan=mission.ground_plan)).read() == FENCED
    fence, metres = mission.geofence(), 111_194.9  # a degree of a sphere's great circle
    north, east = (474000000 - 473977420) / 1e7 * metres, 0.0
    assert fence.inside((north, east, -5.0)) == pytest.approx(-(474000000 - 473990001) / 1e7 * metres, rel=0.01)
    assert fence.inside((0.0, 0.0, -5.0)) == pytest.approx(-7.25, abs=0.01)
    assert json.loads(data)["geoFence"]["circles"][0]["circle"]["radius"] == 7.25


def test_a_fence_is_cleared_alone_or_with_the_plan():
    one = station()
    client = Client(one)
    client.upload()
    client.give(FENCED)
    clear = mavlink.MAVLink_mission_clear_all_message
    assert client.say(clear(*OURS, FENCE))[0].type == mavlink.MAV_MISSION_ACCEPTED
    assert (len(one.missions.items), one.missions.fence) == (3, [])
    client.give(FENCED)
    (ack,) = client.say(clear(*OURS, mavlink.MAV_MISSION_TYPE_ALL))
    assert (ack.type, ack.mission_type) == (mavlink.MAV_MISSION_ACCEPTED, mavlink.MAV_MISSION_TYPE_ALL)
    assert (one.missions.items, one.missions.fence) == ([], [])


@pytest.mark.parametrize(
    ("rows", "result", "words"),
    [
        ([circle(5000, 0.0)], "UNSUPPORTED", "item 0: MAV_CMD_NAV_FENCE_RETURN_POINT (5000) is not kept to"),
        ([circle(16, 0.0)], "UNSUPPORTED", "item 0: MAV_CMD_NAV_WAYPOINT (16) is not kept to"),
        ([circle(5003, math.nan)], "INVALID", "found radius nan m, expected 0 to"),
        ([circle(5003, 0.0)], "INVALID", "found radius 0 m, expected 0 to"),
        ([circle(5003, 9.0, x=910000000)], "INVALID", "found latitude 91"),
        ([(10, *circle(5003, 9.0)[1:])], "UNSUPPORTED", "found frame 10, expected a global one"),
        (corners(5001, *SQUARE)[:3], "INVALID", "found 3 corners, expected 4"),
        ([*corners(5001, *SQUARE)[:3], *corners(5002, *SQUARE)], "INVALID", "item 3: "),
        (corners(5001, *SQUARE[:2]), "INVALID", "found 2 corners, expected 3 to"),
        (corners(5001, SQUARE[0], SQUARE[2], SQUARE[1], SQUARE[3]), "INVALID", "item 0: "),
        ([*corners(5001, *SQUARE), *corners(5001, *SQUARE, inside=1.0)], "UNSUPPORTED", "found a second group"),
        ([circle(5003, 500.0)] * 17, "INVALID", "expected at most 16 areas to stay in"),
    ],
)
def test_a_fence_that_cannot_be_kept_to_is_refused_with_the_item_and_the_one_before_stays(rows, result, words):
    one = station()
    client = Client(one)
    client.give(FENCED)
    ack = client.give(rows)
    assert (ack.type, ack.mission_type) == (getattr(mavlink, f"MAV_MISSION_{result}"), FENCE)
    assert words in client.texts()
    assert client.read() == FENCED


def test_a_place_of_the_plan_beyond_its_fence_is_told_by_its_item():
    one = station()
    client = Client(one)
    client.upload([(16, 0, 47.397742, 8.545594, 488.0), *PLACES])
    client.give([circle(5003, 12.0)])
    with pytest.raises(MissionError, match=r"item 2: steps\.1\.goto: found a place .* m outside the fence"):
        parse_mission(plan_file(one.missions, HOME), "upload")


def test_the_fence_is_not_changed_in_flight_but_a_plan_for_later_is_taken():
    flight = GroundStation(lambda: 1, course=lambda: Course(Phase.FLYING, 1))
    client = Client(flight)
    assert client.give(FENCED).type == mavlink.MAV_MISSION_DENIED
    for plan in (FENCE, mavlink.MAV_MISSION_TYPE_ALL):
        assert client.say(mavlink.MAVLink_mission_clear_all_message(*OURS, plan))[0].type == mavlink.MAV_MISSION_DENIED
    assert "it is not changed in flight" in client.texts()
    assert client.upload().type == mavlink.MAV_MISSION_ACCEPTED
    idle = station()
    Client(idle).give(FENCED)
    idle.after(flight)
    assert (len(idle.missions.items), len(idle.missions.fence)) == (3, len(FENCED))


def test_a_few_items_of_a_plan_are_replaced_and_the_rest_stays():
    one = station()
    client = Client(one)
    client.upload()
    (asked,) = client.say(mavlink.MAVLink_mission_write_partial_list_message(*OURS, 1, 1, MISSION))
    assert asked.seq == 1
    (ack,) = client.item([PLACES[0], (16, 3, 47.3980, 8.5460, 9.0), PLACES[2]], 1)
    assert ack.type == mavlink.MAV_MISSION_ACCEPTED
    assert [(item.command, item.params[6]) for item in one.missions.items] == [(22, 5.0), (16, 9.0), (20, 0.0)]
    ack, *_ = client.say(mavlink.MAVLink_mission_write_partial_list_message(*OURS, 2, 3, MISSION))
    assert ack.type == mavlink.MAV_MISSION_INVALID_SEQUENCE
    assert "found items 2 to 3, expected some of the 3" in client.texts()


TOUR = [
    (16, 0, 47.397742, 8.545594, 488.0),  # 0: home
    (178, 2, 0.0, 0.0, 0.0),  # 1: a speed, done on the spot
    (22, 3, 47.397742, 8.545594, 5.0),  # 2: step 0
    (16, 3, 47.3978, 8.5457, 5.0),  # 3: step 1
    (82, 3, 47.3979, 8.5457, 5.0),  # 4: step 2, on the way of
    (82, 3, 47.3980, 8.5457, 5.0),  # 5: likewise
    (16, 3, 47.3981, 8.5457, 5.0),  # 6: step 3
    (20, 2, 0.0, 0.0, 0.0),  # 7: step 4
]


class Flight:
    """A station whose flight is wherever it is said to be."""

    def __init__(self, items=TOUR):
        one = station()
        rows = [(f, c, 0, 1, *((0.0, 2.5) if c == 178 else (0.0, 0.0)), 0.0, 0.0) for c, f, *_ in items]
        rows = [(*row, round(x * 1e7), round(y * 1e7), z) for row, (_, _, x, y, z) in zip(rows, items, strict=True)]
        assert Client(one).give(rows, MISSION).type == mavlink.MAV_MISSION_ACCEPTED
        mission = parse_mission(plan_file(one.missions, HOME), "upload")
        self.course, self.now_us = Course(Phase.CONNECTING, 0), 0
        self.station = GroundStation(lambda: 1, plan=mission.ground_plan, course=lambda: self.course, links=("a", "b"))
        self.client = Client(self.station)
        self.steps = [s.kind for s in mission.steps]

    def tick(self, phase, step, seconds=0.02, **more):
        """What is told on link a, and the same on link b."""
        self.course, self.now_us = Course(phase, step, **more), self.now_us + round(seconds * 1e6)
        sent = self.station.step(self.now_us)
        told = {
            link: [mavlink.MAVLink(None).decode(bytearray(d.data)) for d in sent if d.link == link] for link in "ab"
        }
        assert [str(m) for m in told["a"]] == [str(m) for m in told["b"]]
        assert all((d.peer, m.get_srcComponent()) == (None, 191) for d, m in zip(sent[::2], told["a"], strict=True))
        return [(m.seq, m.total, m.mission_state) if m.get_type() == "MISSION_CURRENT" else m.seq for m in told["a"]]


NOT_STARTED, ACTIVE, PAUSED, COMPLETE = 2, 3, 4, 5


def test_the_progress_of_an_uploaded_plan_is_told_once_a_second_and_as_it_changes_each_item_once():
    f = Flight()
    assert f.steps == ["takeoff", "goto", "via", "goto", "return"]
    assert f.tick(Phase.PLANNING, 0) == [(1, 7, NOT_STARTED)]
    assert f.tick(Phase.PLANNING, 0, 0.98) == []
    assert f.tick(Phase.PLANNING, 0) == [(1, 7, NOT_STARTED)]
    assert f.tick(Phase.TAKING_OFF, 0) == [1, (2, 7, ACTIVE)]
    assert f.tick(Phase.FLYING, 1) == [2, (3, 7, ACTIVE)]
    assert f.tick(Phase.FLYING, 1, held=True) == [(3, 7, PAUSED)]
    assert f.tick(Phase.FLYING, 1) == [(3, 7, ACTIVE)]
    assert f.tick(Phase.FLYING, 2) == [3, (4, 7, ACTIVE)]
    assert f.tick(Phase.FLYING, 3) == []
    assert f.tick(Phase.FLYING, 4) == [4, 5, 6, (7, 7, ACTIVE)]
    assert f.tick(Phase.LANDING, 5) == []
    assert f.tick(Phase.DONE, 5) == [7, (7, 7, COMPLETE)]
    idle = GroundStation(lambda: 1, links=("a",))
    idle.missions.take_over(f.station.missions)
    idle.after(f.station)
    (current,) = [mavlink.MAVLink(None).decode(bytearray(d.data)) for d in idle.step(0)]
    assert (current.seq, current.total, current.mission_state) == (7, 7, COMPLETE)


def test_a_flight_that_is_cut_short_or_taken_over_is_paused_and_its_last_items_are_not_reached():
    f = Flight()
    assert f.tick(Phase.FLYING, 1) == [1, 2, (3, 7, ACTIVE)]
    assert f.tick(Phase.HANDED_OVER, 1) == [(3, 7, PAUSED)]
    assert f.tick(Phase.FLYING, 1) == [(3, 7, ACTIVE)]
    assert f.tick(Phase.LANDING, 1, whole=False) == [(3, 7, PAUSED)]
    assert f.tick(Phase.DONE, 1, whole=False) == [(3, 7, PAUSED)]  # and its mission_mode changes


def test_items_that_are_left_out_are_not_reached_and_those_flown_again_are_reached_again():
    f = Flight()
    assert f.tick(Phase.FLYING, 1) == [1, 2, (3, 7, ACTIVE)]
    assert f.tick(Phase.FLYING, 4, skipped=(1, 4)) == [(7, 7, ACTIVE)]
    assert f.tick(Phase.FLYING, 1, skipped=(2, 1)) == [(3, 7, ACTIVE)]
    assert f.tick(Phase.FLYING, 2, skipped=(2, 1)) == [3, (4, 7, ACTIVE)]


def test_between_flights_the_plan_is_not_started_and_where_there_is_none_that_is_said():
    idle = GroundStation(lambda: 1, links=("out0",))
    client = Client(idle, peer=None)
    assert client.wait(0) == []  # a ground station may show it as the vehicle's own mission
    client.upload()
    (there,) = client.wait(20_000)
    assert (there.seq, there.total, there.mission_state) == (0, 3, NOT_STARTED)
    assert client.wait(5_000_000) == []
    ack, told = client.command(mavlink.MAV_CMD_REQUEST_MESSAGE, mavlink.MAVLINK_MSG_ID_MISSION_CURRENT)
    assert (ack.result, told.total) == (mavlink.MAV_RESULT_ACCEPTED, 3)
    client.say(mavlink.MAVLink_mission_clear_all_message(*OURS, MISSION))
    (none,) = client.wait(6_000_000)
    assert (none.seq, none.total, none.mission_state) == (0, 65535, mavlink.MISSION_STATE_NO_MISSION)


@pytest.mark.parametrize(("item", "step"), [(1, 0), (3, 1), (4, 2), (7, 4)])
def test_a_plan_is_gone_on_with_from_the_item_that_is_set(item, step):
    f, given = Flight(), []
    obey = lambda order: given.append((order.name, order.values)) or ""  # noqa: E731
    (ack,) = f.client.command(mavlink.MAV_CMD_DO_SET_MISSION_CURRENT, float(item), obey=obey)
    assert ack.result == mavlink.MAV_RESULT_ACCEPTED
    told = f.client.say(mavlink.MAVLink_mission_set_current_message(*OURS, item), obey=obey)
    assert types(told) == ["MISSION_CURRENT"]
    assert given == [("skip", (float(step),))] * 2


@pytest.mark.parametrize(
    ("item", "words"),
    [(0, "found item 0, expected 1 to 7"), (8, "found item 8"), (5, "flown in one with the one before"), (6, "in one")],
)
def test_an_item_that_cannot_be_gone_on_with_is_refused_in_both_forms(item, words):
    f, given = Flight(), []
    ack, *_ = f.client.command(mavlink.MAV_CMD_DO_SET_MISSION_CURRENT, float(item), obey=given.append)
    assert ack.result == mavlink.MAV_RESULT_DENIED
    assert "DO_SET_MISSION_CURRENT refused" in f.client.texts()
    current, *_ = f.client.say(mavlink.MAVLink_mission_set_current_message(*OURS, item), obey=given.append)
    assert current.get_type() == "MISSION_CURRENT"
    assert "MISSION_SET_CURRENT refused" in f.client.texts()
    assert f.client.texts().count(words) == 2
    assert given == []


@pytest.mark.parametrize(
    ("command", "params", "orders"),
    [
        (mavlink.MAV_CMD_MISSION_START, (), ["start"]),
        (mavlink.MAV_CMD_DO_PAUSE_CONTINUE, (0.0,), ["hold"]),
        (mavlink.MAV_CMD_DO_PAUSE_CONTINUE, (1.0,), ["resume"]),
        (mavlink.MAV_CMD_NAV_RETURN_TO_LAUNCH, (), ["return"]),
        (mavlink.MAV_CMD_NAV_LAND, (), ["land"]),
        (mavlink.MAV_CMD_NAV_LOITER_UNLIM, (), ["hold"]),
        (mavlink.MAV_CMD_COMPONENT_ARM_DISARM, (0.0,), ["abort"]),
        (mavlink.MAV_CMD_DO_REPOSITION, (-1, 0, 0, math.nan, 47.4, 8.5, 495), ["goto"]),
        (mavlink.MAV_CMD_DO_REPOSITION, (-1, 0, 0, math.nan, math.nan, math.nan, math.nan), ["hold"]),
    ],
)
def test_each_command_is_an_order_and_is_acknowledged(command, params, orders):
    given = []
    client = Client(station())
    (ack,) = client.command(command, *params, obey=lambda order: given.append(order) or "")
    assert [order.name for order in given] == orders
    assert given[0].source == "255/190"
    found = (ack.command, ack.result, ack.target_system, ack.target_component)
    assert found == (command, mavlink.MAV_RESULT_ACCEPTED, *GCS)
    if orders == ["goto"]:
        assert given[0].values == (10.0, 20.0, 5.0)


def test_an_order_that_cannot_be_carried_out_is_denied_with_its_reason():
    client = Client(station())
    reason = "north 20, east 29, altitude 2 is 1.00 m outside the fence"
    ack, *_ = client.command(mavlink.MAV_CMD_DO_REPOSITION, -1, 0, 0, 0, 47.4, 8.5, 495, obey=lambda order: reason)
    assert ack.result == mavlink.MAV_RESULT_DENIED
    assert client.texts() == f"DO_REPOSITION refused: {reason}"


def test_a_start_is_never_the_word_that_takes_the_vehicle_back_from_a_pilot():
    given = []
    ack, *_ = Client(station()).command(
        mavlink.MAV_CMD_MISSION_START, obey=lambda order: given.append(order.name) or "not while handed over"
    )
    assert (given, ack.result) == (["start"], mavlink.MAV_RESULT_DENIED)
    companion = Companion(load_mission("missions/hop.yaml"), CompanionConfig())
    companion.phase = Phase.HANDED_OVER
    assert companion.obey(0, Order("start")) == "not while handed over"
    assert companion.obey(0, Order("resume")) == ""


@pytest.mark.parametrize(
    ("command", "params", "result", "words"),
    [
        (mavlink.MAV_CMD_DO_SET_SERVO, (1, 1500), "UNSUPPORTED", "DO_SET_SERVO is not obeyed by the companion"),
        (
            mavlink.MAV_CMD_DO_SET_MODE,
            (1, 4),
            "UNSUPPORTED",
            "DO_SET_MODE is not obeyed by the companion: the vehicle's",
        ),
        (mavlink.MAV_CMD_NAV_TAKEOFF, (), "UNSUPPORTED", "it takes off by itself when a mission is started"),
        (mavlink.MAV_CMD_DO_CHANGE_SPEED, (1, 4), "UNSUPPORTED", "the speed is the plan's"),
        (mavlink.MAV_CMD_REQUEST_MESSAGE, (148 + 1,), "UNSUPPORTED", "message 149 is not told"),
        (mavlink.MAV_CMD_MISSION_START, (3.0,), "DENIED", "found first item 3, expected 0"),
        (mavlink.MAV_CMD_MISSION_START, (0.0, 1.0), "DENIED", "found last item 1, expected 0"),
        (mavlink.MAV_CMD_DO_SET_MISSION_CURRENT, (2.0,), "DENIED", "no plan of a ground station is flown"),
        (mavlink.MAV_CMD_DO_SET_MISSION_CURRENT, (math.nan,), "DENIED", "found item nan"),
        (mavlink.MAV_CMD_NAV_LOITER_UNLIM, (0, 0, 0, 0, 47.0, 8.0), "DENIED", "DO_REPOSITION goes to a place"),
        (60_000, (), "UNSUPPORTED", "command 60000 is not obeyed"),
        (mavlink.MAV_CMD_COMPONENT_ARM_DISARM, (1.0,), "DENIED", "it arms by itself when a mission is started"),
        (mavlink.MAV_CMD_DO_PAUSE_CONTINUE, (7.0,), "DENIED", "found 7, expected 0 to pause or 1 to go on"),
        (mavlink.MAV_CMD_DO_REPOSITION, (0, 0, 0, 0, 147.0, 8.5, 5), "DENIED", "found no place"),
    ],
)
def test_what_is_no_order_is_refused_by_name(command, params, result, words):
    given = []
    client = Client(station())
    ack, *_ = client.command(command, *params, obey=lambda order: given.append(order) or "")
    assert ack.result == getattr(mavlink, f"MAV_RESULT_{result}")
    assert words in client.texts()
    assert given == []


@pytest.mark.parametrize(
    ("command", "params", "words"),
    [
        (mavlink.MAV_CMD_DO_REPOSITION, (5.0, 1, 0, math.nan, 47.4, 8.5, 495), "at the mission's speed"),
        (mavlink.MAV_CMD_DO_REPOSITION, (-1.0, 1, 0, 90.0, 47.4, 8.5, 495), "the nose stays as it is"),
        (mavlink.MAV_CMD_DO_REPOSITION, (-1.0, 1, 0, math.nan, 47.4, 8.5, 495), ""),
        (mavlink.MAV_CMD_NAV_LAND, (0, 0, 0, 0, 47.4, 8.5, 0), "it lands where it is"),
        (mavlink.MAV_CMD_NAV_LAND, (0, 0, 0, math.nan, math.nan, math.nan, math.nan), ""),
    ],
)
def test_what_of_an_obeyed_command_is_left_out_is_said(command, params, words):
    client = Client(station())
    ack, *_ = client.command(command, *params)
    assert ack.result == mavlink.MAV_RESULT_ACCEPTED
    assert words in client.texts()
    assert bool(words) == bool(client.texts())


def test_a_place_is_refused_while_nobody_knows_where_the_vehicle_is():
    client = Client(station(place=None))
    ack, *_ = client.command(mavlink.MAV_CMD_DO_REPOSITION, 0, 0, 0, 0, 47.0, 8.5, 5)
    assert ack.result == mavlink.MAV_RESULT_DENIED
    assert "not known" in client.texts()


def test_a_command_repeated_since_its_answer_was_lost_is_answered_again_and_not_carried_out_again():
    given = []
    client = Client(station())
    for confirmation in (0, 1, 2):
        (ack,) = client.command(
            mavlink.MAV_CMD_DO_PAUSE_CONTINUE, 0.0, confirmation=confirmation, obey=lambda o: given.append(o) or ""
        )
        assert ack.result == mavlink.MAV_RESULT_ACCEPTED
    assert len(given) == 1
    client.command(mavlink.MAV_CMD_DO_PAUSE_CONTINUE, 1.0, confirmation=1, obey=lambda o: given.append(o) or "")
    assert [o.name for o in given] == ["hold", "resume"]


@pytest.mark.parametrize("target", [(1, 1), (1, 0), (0, 0), (2, 191), (1, 190)])
def test_what_is_for_the_vehicle_for_everybody_or_for_another_is_not_ours(target):
    client = Client(station())
    assert client.command(mavlink.MAV_CMD_MISSION_START, target=target) == []
    assert client.say(mavlink.MAVLink_mission_count_message(*target, 3, 0)) == []


def test_nobody_is_answered_before_the_vehicle_is_known():
    client = Client(GroundStation(lambda: 0))
    assert client.command(mavlink.MAV_CMD_MISSION_START) == []


def test_the_companion_says_what_it_can_when_asked_for_its_version():
    ack, version = Client(station()).command(mavlink.MAV_CMD_REQUEST_MESSAGE, mavlink.MAVLINK_MSG_ID_AUTOPILOT_VERSION)
    assert ack.result == mavlink.MAV_RESULT_ACCEPTED
    assert version.capabilities & mavlink.MAV_PROTOCOL_CAPABILITY_MISSION_INT


def test_any_bytes_and_any_packets_for_us_are_taken_without_an_exception():
    dice = random.Random(5)
    one = station()
    client = Client(one)
    kinds = [mavlink.mavlink_map[n] for n in (76, 75, 44, 39, 73, 45, 43, 40, 51, 47, 41, 37, 38)]
    for number in range(3000):
        kind = dice.choice(kinds)
        size = kind.unpacker.size
        payload = bytearray(dice.choice((0, 1, 3, 22, 127, 128, 255, dice.randrange(256))) for _ in range(size))
        for name, value in (("target_system", 1), ("target_component", 191)):
            at = kind.ordered_fieldnames.index(name)
            payload[-size + sum(_sizes(kind)[:at])] = value
        message = kind(*_values(kind, bytes(payload)))
        one.take(number * 20_000, Datagram("out0", bytes(message.pack(client.mav)), ("gcs", 1)), ALLOW)
        one.step(number * 20_000)
    for _ in range(300):
        one.take(0, Datagram("out0", dice.randbytes(dice.randrange(1, 300)), None), ALLOW)


def _sizes(kind):
    letters = bytes(kind.native_format).decode().lstrip("<")
    return [{"f": 4, "i": 4, "I": 4, "H": 2, "h": 2, "B": 1, "b": 1}[letter] for letter in letters]


def _values(kind, payload):
    """A message's fields in the order of its constructor."""
    found = dict(zip(kind.ordered_fieldnames, kind.unpacker.unpack(payload), strict=True))
    return [found[name] for name in kind.fieldnames]
