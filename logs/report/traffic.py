"""One pass over a recording: who said what when, in columns, with nothing interpreted yet.

Packets are read from the raw datagrams, the truth of a recording, so it does not matter whether decoded copies were
kept. A companion's recording hears the vehicle on one link and passes it on to others; a vehicle's own tells on
several. The first HEARTBEAT of an autopilot says which sender, link and direction is *the* vehicle; copies of what it
said elsewhere are only counted. What others say to it (commands, setpoints) is kept beside it.
"""

from array import array
from collections import defaultdict
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from logs import schema
from logs.errors import RecordingError
from logs.reader import RecordedMessage, Recording
from logs.report.columns import Rows, Stream, payload_type
from logs.report.foreign import Translator, reference_of
from wire.dialect import mavlink
from wire.framing import Framer, Packet

TOLD = (
    0, 1, 2, 22, 30, 32, 33, 36, 77, 108, 111, 115, 147, 164, 193, 230, 241, 245, 246, 253, 331, 375,
)  # fmt: skip
"""What a vehicle tells that a report shows, by message id."""
ASKED = (0, 11, 23, 75, 76, 77, 82, 84, 86, 111)
"""What others tell it: heartbeats, modes, parameters, commands, their answers, setpoints, time."""
_WANTED = frozenset((*TOLD, *ASKED))
MOST_RECORDS = 50_000
"""Of each of our own records but references and truth; the first ones."""
MOST_MIRRORS = 2000
MOST_OTHERS = 64
"""Senders that are followed."""
_NO_AUTOPILOT = mavlink.MAV_AUTOPILOT_INVALID
_EMPTY_RATE = (0, 0)
_UNSEEN = (schema.EstimatorBegin, schema.EstimatorInputs)
"""Records that no report shows: what a re-run of the estimator is fed."""
_NO_ROTORS = (float("nan"),) * 8
LOG = ("log", "rx", 1, 1)
"""Who a vehicle is that only its own log tells of."""

Sender = tuple[str, str, int, int]
"""Link, direction, system and component."""


@dataclass(slots=True)
class Tally:
    """Packets of one sender on one link in one direction: how many, missing by sequence, and when they were missing."""

    received: int = 0
    lost: int = 0
    last: int = -1
    at: list[tuple[int, int]] = field(default_factory=list)  # (time [ns], lost so far), the first 10 000

    def hear(self, t_ns: int, sequence: int) -> None:
        """One packet more. A jump by more than half the circle is a late packet, or a sender that began anew."""
        self.received += 1
        missing = (sequence - self.last - 1) & 0xFF if self.last >= 0 else 0
        if 0 < missing < 128:
            self.lost += missing
            if len(self.at) < 10_000:
                self.at.append((t_ns, self.lost))
        if missing < 128 or (missing != 255 and missing < 240):
            self.last = sequence


@dataclass(slots=True)
class Traffic:
    """What one pass found.

    Attributes
    ----------
    streams : messages by sender and id. tallies : packets by sender.
    rates : (packets, bytes) by (link, direction) and second since the epoch of the times.
    records : our own records with log time and publish time [ns], by kind, but for
    references : (n, 9) time [ns], tick, position 2:5 [m], velocity 5:8 [m/s], yaw [rad], in the mission frame.
    truths : (n, 22) time [ns], position 1:4, velocity 4:7, q_nb 7:11, wind 11:14, rotors 14:22 [rad/s], NaN where none.
    mirrors : `foxglove.SceneUpdate` messages, each with its time [ns].
    first_ns, last_ns : of everything.
    vehicle : the sender that is the vehicle; None: no autopilot was heard.
    """

    streams: dict[tuple[Sender, int], Stream] = field(default_factory=dict)
    tallies: dict[Sender, Tally] = field(default_factory=dict)
    rates: dict[tuple[str, str], dict[int, tuple[int, int]]] = field(default_factory=lambda: defaultdict(dict))
    records: dict[type[Any], list[tuple[int, int, Any]]] = field(default_factory=lambda: defaultdict(list))
    mirrors: list[tuple[int, Any]] = field(default_factory=list)
    _references: "array[float]" = field(default_factory=lambda: array("d"))
    _truths: "array[float]" = field(default_factory=lambda: array("d"))
    first_ns: int = 0
    last_ns: int = 0
    messages: int = 0
    datagrams: int = 0
    vehicle: Sender | None = None
    companions: bool = False  # a companion's recording: it has ticks

    @property
    def references(self) -> NDArray[np.float64]:
        return np.frombuffer(self._references, np.float64).reshape(-1, 9)

    @property
    def truths(self) -> NDArray[np.float64]:
        return np.frombuffer(self._truths, np.float64).reshape(-1, 22)

    def kept_in_part(self) -> list[tuple[str, int]]:
        """Messages of which only so many were kept, for there are too many: their names, and how many."""
        thinned = [(number, stream) for (_, number), stream in self.streams.items() if stream.thinned]
        return [(mavlink.mavlink_map[number].msgname, len(stream)) for number, stream in thinned]

    def told(self, message_id: int) -> Rows:
        """The vehicle's messages of a kind."""
        stream = None if self.vehicle is None else self.streams.get((self.vehicle, message_id))
        return _none(message_id) if stream is None else stream.rows()

    def asked(self, message_id: int) -> list[tuple[Sender, Rows]]:
        """What others said to the vehicle of a kind, by sender."""
        if self.vehicle is None:
            return []
        link, direction, *who = self.vehicle
        found = []
        for (sender, number), stream in self.streams.items():
            if number != message_id or list(sender[2:]) == who:
                continue
            if sender[0] == link or (sender[1] != direction and not self.companions):
                found.append((sender, stream.rows()))
        return found


def read(recording: Recording) -> Traffic:
    """Read a recording through once."""
    traffic, framers, translator = Traffic(), _Framers(), Translator()
    kinds = {schema.schema_name(kind): kind for kind in schema.RECORDS}
    for message in recording.messages():
        if message.channel.direction is not None:
            _packets(traffic, framers, message)
        elif message.channel.encoding == "protobuf" and (kind := kinds.get(message.channel.schema)) is not None:
            _record(traffic, kind, message)
        elif message.channel.schema.startswith(("px4.", "ardupilot.")):
            _logged(traffic, translator, recording, message)
        elif message.channel.schema == "foxglove.SceneUpdate" and len(traffic.mirrors) < MOST_MIRRORS:
            with suppress(RecordingError):
                traffic.mirrors.append((message.log_time_ns, recording.decode(message)))
        traffic.first_ns = message.log_time_ns if not traffic.messages else min(traffic.first_ns, message.log_time_ns)
        traffic.last_ns = max(traffic.last_ns, message.log_time_ns)
        traffic.messages += 1
    return traffic


def _logged(traffic: Traffic, translator: Translator, recording: Recording, message: RecordedMessage) -> None:
    """What an autopilot's own log holds, as if it had been told."""
    schema_name, t_ns = message.channel.schema, message.log_time_ns
    steered = schema_name == "px4.trajectory_setpoint"
    if not steered and not translator.reads(schema_name, message.channel.topic):
        return
    try:
        decoded = recording.decode(message)
    except RecordingError:
        return
    if (reference := reference_of(schema_name, decoded)) is not None:
        traffic._references.extend((t_ns, 0.0, *reference))
    elif not steered:
        traffic.vehicle = traffic.vehicle or LOG
        for number, payload in translator.said(schema_name, decoded):
            stream = traffic.streams.get((LOG, number))
            if stream is None:
                stream = traffic.streams[LOG, number] = Stream(number)
            stream.add(t_ns, 0, payload)


class _Framers(dict[tuple[str, str], Framer]):
    def __missing__(self, key: tuple[str, str]) -> Framer:
        self[key] = framer = Framer()
        return framer


def _record(traffic: Traffic, kind: type[Any], message: RecordedMessage) -> None:
    if kind is schema.Tick:
        traffic.companions = True
        return
    if kind in _UNSEEN:
        return
    try:
        record = schema.decode(kind, message.data)
    except ValueError:
        return
    match record:
        case schema.Reference(position=(_, _, _), velocity=(_, _, _)) as r:
            traffic._references.extend((message.log_time_ns, message.tick, *r.position, *r.velocity, r.yaw))
        case schema.Truth(position_n=(_, _, _), velocity_n=(_, _, _), q_nb=(_, _, _, _), wind_n=(_, _, _)) as r:
            rotors = (*r.rotor_speed, *_NO_ROTORS)[:8]
            traffic._truths.extend((message.log_time_ns, *r.position_n, *r.velocity_n, *r.q_nb, *r.wind_n, *rotors))
        case schema.Reference() | schema.Truth():
            return
        case _ if len(traffic.records[kind]) < MOST_RECORDS:
            traffic.records[kind].append((message.log_time_ns, message.publish_time_ns, record))
        case _:
            return


def _packets(traffic: Traffic, framers: _Framers, message: RecordedMessage) -> None:
    channel, t_ns = message.channel, message.log_time_ns
    assert channel.direction is not None
    way = (channel.link, channel.direction)
    packets = framers[way].packets(message.data)
    rate, second = traffic.rates[way], t_ns // 1_000_000_000
    count, size = rate.get(second, _EMPTY_RATE)
    rate[second] = count + len(packets), size + len(message.data)
    traffic.datagrams += 1
    for packet in packets:
        sender = (*way, packet.system_id, packet.component_id)
        tally = traffic.tallies.get(sender)
        if tally is None:
            if len(traffic.tallies) >= MOST_OTHERS:
                continue
            tally = traffic.tallies[sender] = Tally()
        tally.hear(t_ns, packet.sequence)
        if packet.message_id in _WANTED:
            if traffic.vehicle is None and _is_autopilot(packet):
                traffic.vehicle = sender
            _keep(traffic, sender, packet, t_ns, message.tick)


def _keep(traffic: Traffic, sender: Sender, packet: Packet, t_ns: int, tick: int) -> None:
    vehicle = traffic.vehicle
    if vehicle is not None and sender != vehicle:
        if sender[2:] == vehicle[2:] or packet.message_id not in ASKED:
            return  # a copy of what it said on another link, or telemetry of somebody else
        if traffic.companions and sender[0] != vehicle[0]:
            return
    key = (sender, packet.message_id)
    stream = traffic.streams.get(key)
    if stream is None:
        stream = traffic.streams[key] = Stream(packet.message_id)
    stream.add(t_ns, tick, packet.payload)


def _is_autopilot(packet: Packet) -> bool:
    """Whether this is a HEARTBEAT of something that flies, rather than of a ground station or an onboard computer."""
    if packet.message_id != mavlink.MAVLINK_MSG_ID_HEARTBEAT:
        return False
    payload = packet.payload.ljust(9, b"\0")  # custom mode uint32, type, autopilot, ...
    return payload[5] != int(_NO_AUTOPILOT) and payload[4] != int(mavlink.MAV_TYPE_GCS)


def _none(message_id: int) -> Rows:
    return np.empty(0, np.dtype([("t", "<i8"), ("tick", "<i8"), ("m", payload_type(message_id))]))
