"""Ground stations and the companion's own component: plans up and down, commands as orders, a reason for every no."""

import math
import random

import pytest

from companion.geodesy import Geodetic
from companion.ground.protocol import REPEAT_US, TRIES
from companion.ground.station import GroundStation, plan_file
from companion.missionfile import parse_mission
from wire.datagram import Datagram
from wire.dialect import mavlink

OURS, GCS = (1, 191), (255, 190)
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


def station(items=(), place=(10.0, 20.0, 5.0)):
    return GroundStation(lambda: 1, lambda *asked: place, items)


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
    mission = parse_mission(plan_file(one.missions.items, Geodetic(47.397742, 8.545594, 488.0)), "upload")
    assert [s.kind for s in mission.steps] == ["takeoff", "goto", "return"]
    assert mission.vehicle.start.anywhere
    assert len(mission.plan_items) == 3


def test_home_before_the_takeoff_as_ardupilots_plans_have_it_is_no_place_to_go_to():
    one, home = station(), (16, 0, 47.397742, 8.545594, 488.0)
    assert Client(one).upload([home, *PLACES]).type == mavlink.MAV_MISSION_ACCEPTED
    assert len(one.missions.items) == 4
    mission = parse_mission(plan_file(one.missions.items, Geodetic(47.397742, 8.545594, 488.0)), "upload")
    assert [s.kind for s in mission.steps] == ["takeoff", "goto", "return"]


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
    refused = client.say(mavlink.MAVLink_mission_count_message(*OURS, 3, mavlink.MAV_MISSION_TYPE_FENCE))[0]
    assert (refused.type, refused.mission_type) == (mavlink.MAV_MISSION_UNSUPPORTED, mavlink.MAV_MISSION_TYPE_FENCE)
    missing = client.say(mavlink.MAVLink_mission_request_int_message(*OURS, 7, 0))[0]
    assert missing.type == mavlink.MAV_MISSION_INVALID_SEQUENCE
    assert "item 7 was asked for, there are 0" in client.texts()


def test_a_plan_is_cleared():
    one = station()
    client = Client(one)
    client.upload()
    assert client.say(mavlink.MAVLink_mission_clear_all_message(*OURS, 0))[0].type == mavlink.MAV_MISSION_ACCEPTED
    assert one.missions.items == []


@pytest.mark.parametrize(
    ("command", "params", "orders"),
    [
        (mavlink.MAV_CMD_MISSION_START, (), ["start"]),
        (mavlink.MAV_CMD_DO_PAUSE_CONTINUE, (0.0,), ["hold"]),
        (mavlink.MAV_CMD_DO_PAUSE_CONTINUE, (1.0,), ["resume"]),
        (mavlink.MAV_CMD_NAV_RETURN_TO_LAUNCH, (), ["return"]),
        (mavlink.MAV_CMD_NAV_LAND, (), ["land"]),
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


def test_a_start_in_flight_goes_on_with_what_was_held():
    given = []

    def obey(order):
        given.append(order.name)
        return "" if order.name == "resume" else "not while flying"

    (ack,) = Client(station()).command(mavlink.MAV_CMD_MISSION_START, obey=obey)
    assert (given, ack.result) == (["start", "resume"], mavlink.MAV_RESULT_ACCEPTED)


@pytest.mark.parametrize(
    ("command", "params", "result", "words"),
    [
        (mavlink.MAV_CMD_DO_SET_SERVO, (1, 1500), "UNSUPPORTED", "DO_SET_SERVO is not obeyed by the companion"),
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
    kinds = [mavlink.mavlink_map[n] for n in (76, 75, 44, 39, 73, 45, 43, 40, 51, 47)]
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
