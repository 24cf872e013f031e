"""Whom the companion obeys, told apart by system id, component and address."""

import math

from companion.core import Companion, CompanionConfig
from companion.hooks import NothingSeen
from companion.missionfile import load_mission
from companion.seam import Note
from companion.vehiclelink import VEHICLE_LINK
from wire.datagram import Datagram
from wire.dialect import mavlink

MISSION = load_mission("missions/l_shape.yaml")
HERE, ELSEWHERE = ("127.0.0.1", 1001), ("127.0.0.1", 2002)


def said(message, peer, system=1, component=1):
    mav = mavlink.MAVLink(None, srcSystem=system, srcComponent=component)
    return Datagram(VEHICLE_LINK, bytes(message.pack(mav)), peer)


def heartbeat(autopilot=12):
    return mavlink.MAVLink_heartbeat_message(2, autopilot, 0x01, 0x3040000, 3, 3)


def position(x):
    return mavlink.MAVLink_local_position_ned_message(0, x, 0.0, 0.0, 0.0, 0.0, 0.0)


def notes(outputs):
    return [o.text for o in outputs if isinstance(o, Note)]


def test_the_first_autopilot_heard_is_the_vehicle_and_its_address_is_the_only_one_spoken_to():
    companion = Companion(MISSION, CompanionConfig())
    first = companion.step(0, [said(heartbeat(), HERE), said(heartbeat(), ELSEWHERE), said(position(5.0), ELSEWHERE)])
    second = companion.step(20_000, [said(heartbeat(), ELSEWHERE), said(position(7.0), HERE)])
    assert companion.telemetry.position_n[0] == 7.0
    assert {o.peer for o in [*first, *second] if isinstance(o, Datagram)} == {HERE}
    told = "another sender at 127.0.0.1:2002 also calls itself system 1: it is not obeyed"
    assert notes(first).count(told) == 1
    assert told not in notes(second)
    assert companion.link.foreign_packets == 3


def test_a_ground_station_a_companion_and_another_system_are_not_the_vehicle():
    companion = Companion(MISSION, CompanionConfig(system_id=7))
    strangers = [
        said(heartbeat(autopilot=8), HERE, system=7),  # no autopilot
        said(heartbeat(), HERE, system=7, component=191),
        said(heartbeat(), HERE, system=255),
        said(position(3.0), HERE, system=7),  # before it said what it is
    ]
    assert companion.step(0, strangers) == []
    assert companion.telemetry.heartbeat_us is None
    assert notes(companion.step(20_000, [said(heartbeat(), HERE, system=7)]))


def test_a_vehicle_of_another_make_is_refused_by_name():
    companion = Companion(MISSION, CompanionConfig())
    companion.step(0, [said(heartbeat(autopilot=18), HERE)])
    assert companion.over
    assert companion.failure == "autopilot type 18 found, expected ArduPilot (3) or PX4 (12)"


def test_a_ground_station_hears_the_vehicle_and_our_heartbeat_and_is_heard_only_when_there_is_a_vehicle():
    companion = Companion(MISSION, CompanionConfig(ground_links=("out0",)))
    question = said(mavlink.MAVLink_param_request_list_message(1, 1), HERE, system=255, component=190).data
    asked = Datagram("out0", question, ("10.0.0.9", 14550))
    assert companion.step(0, [asked]) == []
    out = companion.step(20_000, [said(heartbeat(), HERE), asked])
    assert Datagram(VEHICLE_LINK, question, HERE) in out
    ground = [o.data for o in out if isinstance(o, Datagram) and o.link == "out0"]
    assert said(heartbeat(), HERE).data in ground
    assert any(data[5:10] == bytes([1, 191, 0, 0, 0]) for data in ground)


def test_time_that_stands_still_sends_one_heartbeat_a_second_and_no_burst_after_a_gap():
    companion = Companion(MISSION, CompanionConfig())
    beats = []
    for now_us in (0, 500_000, 1_000_000, 7_300_000, 7_320_000, 8_000_000):
        outputs = companion.step(now_us, [said(heartbeat(), HERE)])
        beats.append(sum(isinstance(o, Datagram) and o.data[7:10] == b"\0\0\0" for o in outputs))
    assert beats == [1, 0, 1, 1, 0, 1]
    assert math.isclose(companion.origin_n.sum(), 0.0)


class Seen(NothingSeen):
    """Keeps what it is handed."""

    def __init__(self):
        self.kinds = []

    def take(self, packet, pose):
        self.kinds.append((packet.system_id, packet.component_id, packet.message_id))
        return False


def test_a_sensor_of_our_system_on_a_link_of_its_own_is_seen_and_told_to_nobody():
    companion = Companion(MISSION, CompanionConfig(sensor_links=("sensor0",), ground_links=("out0",)))
    companion.seeing = seen = Seen()
    companion.step(0, [said(heartbeat(), HERE)])
    scan = mavlink.MAVLink_distance_sensor_message(5, 20, 1000, 250, 0, 0, 0, 255)
    told = [Datagram("sensor0", said(scan, ELSEWHERE, system=k, component=196).data, ELSEWHERE) for k in (1, 2)]
    out = companion.step(20_000, told)
    assert seen.kinds == [(1, 1, 0), (1, 196, 132)]
    assert not [o for o in out if isinstance(o, Datagram) and told[0].data in o.data]


def test_a_vehicle_that_calls_from_another_port_is_known_again_once_the_old_one_was_silent():
    companion = Companion(MISSION, CompanionConfig())
    companion.step(0, [said(heartbeat(), HERE)])
    companion.step(2_000_000, [said(heartbeat(), ELSEWHERE)])
    assert companion.link.peer == HERE
    companion.step(3_100_000, [said(heartbeat(), ELSEWHERE), said(position(4.0), ELSEWHERE)])
    assert companion.link.peer == ELSEWHERE
    assert companion.telemetry.position_n[0] == 4.0


def test_another_system_does_not_take_the_place_of_one_that_fell_silent():
    companion = Companion(MISSION, CompanionConfig())
    companion.step(0, [said(heartbeat(), HERE)])
    companion.step(5_000_000, [said(heartbeat(), ELSEWHERE, system=2)])
    assert companion.link.system_id == 1
    assert companion.link.peer == HERE
