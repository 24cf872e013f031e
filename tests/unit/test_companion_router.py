"""Who gets which packet: bytes in, bytes and places out."""

from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from companion.cli.vehicle import LINK, build_vehicle
from companion.core import Companion, CompanionConfig
from companion.drivers.lockstep import Pair
from companion.drivers.planning import InlinePlanning
from companion.ground.router import BURST, MOST_ROUTES, MOST_SEEN, Router, target_of
from companion.missionfile import parse_mission
from companion.phases import Phase
from companion.vehiclelink import VEHICLE_LINK
from tests.conftest import HOP
from wire.datagram import Address, Datagram
from wire.dialect import mavlink
from wire.framing import Framer

VEHICLE: Address = ("vehicle", 1)
A: Address = ("a", 1)
B: Address = ("b", 1)
C: Address = ("c", 1)
STATIONS = {"out0": A, "out1": B, "out2": C}


def packet(system: int, component: int, message: Any, sequence: int = 0) -> bytes:
    sender = mavlink.MAVLink(None, srcSystem=system, srcComponent=component)
    sender.seq = sequence
    return bytes(message.pack(sender))


def beat(system: int, component: int, sequence: int = 0) -> bytes:
    return packet(system, component, mavlink.MAVLink_heartbeat_message(6, 8, 0, 0, 4, 3), sequence)


def command(system: int, component: int, number: int = 400, sequence: int = 0, sender: int = 255) -> bytes:
    message = mavlink.MAVLink_command_long_message(system, component, number, 0, 1, 0, 0, 0, 0, 0, 0)
    return packet(sender, 190, message, sequence)


class Net:
    """A router of vehicle 1 with three ground stations, each on a link of its own."""

    def __init__(self) -> None:
        self.router, self.now_us = Router(tuple(STATIONS)), 0

    def say(self, link: str, data: bytes, peer: Address | None = None) -> dict[str, bytes]:
        """What each link gets."""
        came = peer or (VEHICLE if link == VEHICLE_LINK else STATIONS[link])
        self.now_us += 1000
        out = self.router.route(self.now_us, Datagram(link, data, came), 1, VEHICLE)
        assert len({(d.link, d.peer) for d in out}) == len(out)
        return {d.link: d.data for d in out}


def test_the_vehicle_is_heard_by_every_ground_station_in_the_same_bytes() -> None:
    data = beat(1, 1) + packet(1, 1, mavlink.MAVLink_system_time_message(1, 2), 1)
    assert Net().say(VEHICLE_LINK, data) == dict.fromkeys(STATIONS, data)


def test_what_three_ground_stations_say_to_everybody_reaches_all_but_its_sender_once() -> None:
    net = Net()
    for k, link in enumerate(STATIONS):
        data = beat(250 + k, 190)
        assert net.say(link, data) == {other: data for other in (VEHICLE_LINK, *STATIONS) if other != link}


def test_what_is_for_the_companion_never_reaches_the_vehicle() -> None:
    net = Net()
    for number in (20, 21, 176, 192, 193, 300, 400, 512):
        assert net.say("out0", command(1, 191, number)) == {}
        assert net.say("out0", command(0, 191, number)) == {}
    count = mavlink.MAVLink_mission_count_message(1, 191, 3)
    assert net.say("out0", packet(255, 190, count)) == {}
    mixed = command(1, 191) + command(1, 1)
    assert net.say("out0", mixed)[VEHICLE_LINK] == command(1, 1)
    assert net.router.counters.ours == 18


def test_an_answer_goes_only_to_who_asked_even_among_several_on_one_link() -> None:
    net = Net()
    net.say("out0", command(1, 1, sender=250), ("a", 1))
    net.say("out0", beat(251, 190), ("a", 2))
    answer = packet(1, 1, mavlink.MAVLink_command_ack_message(400, 0, 0, 0, 250, 190))
    out = net.router.route(net.now_us + 1, Datagram(VEHICLE_LINK, answer, VEHICLE), 1, VEHICLE)
    assert out == [Datagram("out0", answer, ("a", 1))]


def test_a_target_nobody_has_heard_is_looked_for_everywhere() -> None:
    data = command(77, 1)
    assert set(Net().say("out0", data)) == {VEHICLE_LINK, "out1", "out2"}


def test_the_vehicle_is_addressed_where_it_is_known_to_be() -> None:
    net = Net()
    net.say(VEHICLE_LINK, beat(1, 1))
    out = net.router.route(5000, Datagram("out1", command(1, 1), B), 1, VEHICLE)
    assert out == [Datagram(VEHICLE_LINK, command(1, 1), VEHICLE)]


def test_a_packet_that_goes_round_is_forwarded_once() -> None:
    net = Net()
    first = beat(250, 190)
    assert VEHICLE_LINK in net.say("out0", first)
    assert net.say("out1", first) == {}
    assert net.say(VEHICLE_LINK, first) == {}
    assert net.router.counters.loops == 2


def test_the_vehicles_own_words_echoed_by_a_ground_station_are_dropped() -> None:
    net = Net()
    net.say(VEHICLE_LINK, beat(1, 1))
    net.now_us += 2_000_000
    assert net.say("out0", beat(1, 1)) == {}
    assert net.say("out0", beat(1, 1, 7)) == {}


def test_nobody_else_may_call_himself_the_companion() -> None:
    assert Net().say("out0", beat(1, 191)) == {}


def test_a_flooding_ground_station_is_cut_to_its_rate_and_the_others_are_not() -> None:
    net = Net()
    data = b"".join(beat(250, 190, k % 256) for k in range(10))
    passed = sum(len(net.say("out0", data).get(VEHICLE_LINK, b"")) for _ in range(500)) // len(beat(250, 190))
    assert passed <= BURST + 500 + 1  # half a second
    assert VEHICLE_LINK in net.say("out1", beat(251, 190))


def test_two_stations_of_one_name_are_both_answered() -> None:
    net = Net()
    net.say("out0", beat(255, 190))
    net.say("out1", beat(255, 190, 100))
    answer = packet(1, 1, mavlink.MAVLink_command_ack_message(400, 0, 0, 0, 255, 190))
    assert set(net.say(VEHICLE_LINK, answer)) == {"out0", "out1"}
    net.now_us += 59_900_000
    net.say("out1", beat(255, 190, 101))
    net.now_us += 200_000
    later = packet(1, 1, mavlink.MAVLink_command_ack_message(400, 0, 0, 0, 255, 190), 1)
    assert set(net.say(VEHICLE_LINK, later)) == {"out1"}


def test_while_the_vehicle_is_not_known_nothing_for_a_companion_is_sent_to_where_it_is_called() -> None:
    router = Router(tuple(STATIONS))
    assert router.route(0, Datagram("out0", command(1, 191, 300), A), None, None) == []
    other = router.route(1, Datagram("out0", command(2, 191, 300), A), 1, VEHICLE)
    assert {d.link for d in other} == {VEHICLE_LINK, "out1", "out2"}


def test_what_is_kept_is_bounded_whatever_is_sent() -> None:
    net = Net()
    for k in range(6000):
        net.now_us += 100
        net.say(VEHICLE_LINK, beat(2 + k % 250, 1 + k // 250, k % 256))
    assert len(net.router._routes) <= MOST_ROUTES
    assert len(net.router._seen) <= MOST_SEEN


def test_targets_are_read_where_the_dialect_packs_them() -> None:
    """Against pymavlink's own packing of every message that has a target."""
    count = 0
    for kind in mavlink.mavlink_map.values():
        if "target_system" not in kind.fieldnames:
            continue
        values: list[Any] = []
        for name, type_ in zip(kind.fieldnames, kind.fieldtypes, strict=True):
            length = kind.array_lengths[kind.ordered_fieldnames.index(name)]
            plain: Any = b"" if type_ == "char" else [0] * length if length else 0
            values.append({"target_system": 37, "target_component": 42}.get(name, plain))
        (found,) = Framer().packets(packet(255, 190, kind(*values)))
        assert target_of(found) == (37, 42 if "target_component" in kind.fieldnames else 0)
        count += 1
    assert count > 80


@given(st.lists(st.tuples(st.sampled_from([VEHICLE_LINK, *STATIONS]), st.binary(max_size=80)), max_size=20))
def test_rubbish_goes_nowhere_and_never_raises(said: list[tuple[str, bytes]]) -> None:
    net = Net()
    for link, data in said:
        whole = sum(len(p.raw) for p in Framer().packets(data))
        out = net.say(link, data)
        assert all(len(d) <= whole for d in out.values())


def test_a_flight_with_three_ground_stations_one_of_which_echoes_everything() -> None:
    """What the vehicle and each station get in a whole flight: nothing twice, nothing that is for the companion."""
    mission = parse_mission(HOP.encode(), "hop.yaml")
    companion = Companion(mission, CompanionConfig(seed=1, ground_links=tuple(STATIONS)))
    vehicle = build_vehicle(mission, 1)
    pair = Pair(companion, vehicle, LINK, InlinePlanning(mission.planner_world()), [])
    heard: dict[str, list[bytes]] = {link: [] for link in (VEHICLE_LINK, *STATIONS)}
    said: list[Datagram] = []
    now_us = 0
    while not companion.over and now_us < 60_000_000:
        outputs = [o for o in pair.tick(now_us, said) if isinstance(o, Datagram)]
        now_us += companion.TICK_US
        said = [Datagram("out2", o.data, C) for o in outputs if o.link == "out2"]  # a loop
        for k, link in enumerate(("out0", "out1")):
            if now_us % 1_000_000 == 0:
                second = now_us // 1_000_000
                said.append(Datagram(link, beat(250 + k, 190, second % 256), STATIONS[link]))
                said.append(Datagram(link, command(1, 191, 512, second % 256, 250 + k), STATIONS[link]))
                asked = mavlink.MAVLink_param_request_read_message(1, 1, b"MPC_XY_VEL_MAX", -1)
                said.append(Datagram(link, packet(250 + k, 190, asked, (second + 1) % 256), STATIONS[link]))
        for o in outputs:
            heard[o.link].append(o.data)
    assert companion.phase is Phase.DONE
    packets = {link: [p for data in datas for p in Framer().packets(data)] for link, datas in heard.items()}
    assert not [p for p in packets[VEHICLE_LINK] if target_of(p)[1] == 191]
    seconds = now_us // 1_000_000
    for k in (0, 1):
        theirs = [p for p in packets[VEHICLE_LINK] if p.system_id == 250 + k]
        assert len(theirs) == len({p.raw for p in theirs})
        assert 2 * (seconds - 2) <= len(theirs) <= 2 * seconds
        answers = [p for p in packets[f"out{k}"] if p.message_id == mavlink.MAVLINK_MSG_ID_PARAM_VALUE]
        assert len(answers) >= seconds - 2
    for link in STATIONS:
        vehicles = [p.raw for p in packets[link] if (p.system_id, p.component_id) == (1, 1)]
        before: dict[bytes, int] = {}
        for at, raw in enumerate(vehicles):  # the same again only after its sequence has come round
            assert at - before.get(raw, -1000) > 200
            before[raw] = at
    assert companion.router.counters.loops > 1000


def test_without_ground_stations_there_is_nothing_to_do() -> None:
    assert Router(()).route(0, Datagram(VEHICLE_LINK, beat(1, 1), VEHICLE), 1, VEHICLE) == []
