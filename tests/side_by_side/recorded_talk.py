"""A recorded conversation between a client and a real autopilot, as a script for a simulated vehicle.

A recording is read into `Turn`s: what the client sent, and the answers that came within `ANSWER_US` and before the next
turn, each as a short token ("ACK 400=0", "TEXT 2", "MISSION_REQUEST 1"). `play` sends the client's half to a vehicle in
lockstep, one packet a tick and at the recorded time (that of the autopilot's boot), and hears its answers as the same
tokens. What a reaction shows only later (modes, arming, mission items reached) is the `story`: the order of changes
over the whole flight.

Tokens say what kind of answer came, for what, with which result; values that belong to the one vehicle or the other (a
version, a parameter's value, a wording) are left out. Answers come in order, but texts are free to stand anywhere
among the answers of a turn: they travel beside the conversation.

Run as a program it extracts what this needs from a whole recording:

    python tests/side_by_side/recorded_talk.py whole.tlog short.tlog.gz
"""

import gzip
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from wire.datagram import Datagram
from wire.dialect import mavlink

CLIENT = 255
ANSWER_US = 150_000
"""An answer comes within this; the slowest of the recorded ones takes 101 ms, most a few."""
TEXT_US = 60_000
"""A text that belongs to an answer comes within this; later ones have other causes."""
TICK_US = 4_000
TRACK_US = 100_000
PEER = ("127.0.0.1", 50000)

_LISTED = ("MISSION_ACK", "MISSION_COUNT", "MISSION_REQUEST", "MISSION_REQUEST_INT", "MISSION_ITEM", "MISSION_ITEM_INT")
_ANSWERS = {*_LISTED, "COMMAND_ACK", "STATUSTEXT", "AUTOPILOT_VERSION", "AVAILABLE_MODES", "MESSAGE_INTERVAL"}
_ANSWERS |= {"FILE_TRANSFER_PROTOCOL", "PARAM_VALUE", "PARAM_ERROR"}
_POLITE = {"HEARTBEAT", "TIMESYNC", "PING", "SYSTEM_TIME"}
"""Sent by a client of its own accord or in answer to the vehicle: not turns, unless they are requests."""


@dataclass(slots=True)
class Turn:
    """One thing a client said, and what came back.

    Attributes
    ----------
    at_us : when, since the autopilot booted.
    said : a short name of it.
    data : the packet.
    answers : tokens.
    """

    at_us: int
    said: str
    data: bytes
    answers: list[str] = field(default_factory=list)


@dataclass(slots=True)
class Talk:
    """A conversation: the turns, and the changes of mode, arming and mission progress in their order."""

    turns: list[Turn]
    story: list[str]
    track: list[tuple[int, list[float]]] = field(default_factory=list)
    """(time since boot [us], position from home [m]) of the simulated vehicle, ten times a second."""


def packets(path: Path) -> Iterator[tuple[int, bytes]]:
    """(time [us], packet) of a tlog, gzipped or not."""
    raw = gzip.decompress(path.read_bytes()) if path.suffix == ".gz" else path.read_bytes()
    at = 0
    while at < len(raw):
        time_us = int.from_bytes(raw[at : at + 8], "big")
        length, overhead = raw[at + 9], 12 + 13 * (raw[at + 10] & 1) if raw[at + 8] == 0xFD else 8
        end = at + 8 + overhead + length
        yield time_us, raw[at + 8 : end]
        at = end


def recorded(path: Path, boot_us: int) -> Talk:
    """The conversation in a tlog whose first packet was heard `boot_us` after the autopilot's boot."""
    decoder = mavlink.MAVLink(None)
    ear, turns, start_us = Ear(), [], None
    for time_us, packet in packets(path):
        start_us = time_us - boot_us if start_us is None else start_us
        message = decoder.decode(bytearray(packet))
        if message.get_srcSystem() == CLIENT:
            if (said := name_of(message)) is not None:
                turns.append(Turn(time_us - start_us, said, packet))
                ear.turns = turns
        else:
            ear.hear(time_us - start_us, message)
    return Talk(turns, ear.story)


def play(turns: Sequence[Turn], vehicle: Any, link: str = "onboard", *, seconds: float = 0.0) -> Talk:
    """Put a vehicle through the client's half; goes on for `seconds` after the last turn."""
    decoder = mavlink.MAVLink(None)
    ear, played, now_us, waiting = Ear(), [], 0, list(reversed(turns))
    track: list[tuple[int, list[float]]] = []
    end_us = turns[-1].at_us + round(seconds * 1e6)
    while waiting or now_us < end_us:
        inputs = []
        if waiting and waiting[-1].at_us <= now_us:  # one a tick, so that it is known what is answered
            turn = waiting.pop()
            inputs = [Datagram(link, turn.data, PEER)]
            played.append(Turn(now_us, turn.said, turn.data))
            ear.turns = played
        for datagram in vehicle.step(now_us, inputs):
            if datagram.link == link:
                ear.hear(now_us, decoder.decode(bytearray(datagram.data)))
        if now_us % TRACK_US == 0:
            track.append((now_us, vehicle.truth.position_n.tolist()))
        now_us += TICK_US
    return Talk(played, ear.story, track)


class Ear:
    """Turns what an autopilot says into tokens: answers to the present turn, and the story."""

    def __init__(self) -> None:
        self.turns: list[Turn] = []
        self.story: list[str] = []
        self._mode: tuple[int, bool] | None = None
        self._reached: int | None = None

    def hear(self, now_us: int, message: Any) -> None:
        kind = message.get_type()
        if kind == "HEARTBEAT":
            mode = (message.custom_mode, bool(message.base_mode & mavlink.MAV_MODE_FLAG_SAFETY_ARMED))
            if self._mode is not None and mode[0] != self._mode[0]:
                self.story.append(f"mode {mode_name(message)}")
                if message.autopilot != mavlink.MAV_AUTOPILOT_PX4:  # its HEARTBEAT waits for its second
                    self._answer(now_us, f"MODE {mode_name(message)}")
            if self._mode is not None and mode[1] != self._mode[1]:
                self.story.append("armed" if mode[1] else "disarmed")
            self._mode = mode
        elif kind == "MISSION_ITEM_REACHED":
            if message.seq != self._reached:  # it is repeated
                self.story.append(f"reached {message.seq}")
            self._reached = message.seq
        elif kind in _ANSWERS or (kind in ("PING", "TIMESYNC") and _is_reply(message)):
            self._answer(now_us, token(message), about(message))
        elif kind in ("HOME_POSITION", "MISSION_CURRENT") and self.turns and kind in self.turns[-1].said:
            self._answer(now_us, kind)

    def _answer(self, now_us: int, word: str | None, what: str = "") -> None:
        """To the newest turn, or the newest that names `what`: a client may ask several things at once."""
        window_us = TEXT_US if word is not None and word.startswith("TEXT") else ANSWER_US
        recent = [t for t in self.turns[-8:] if now_us - t.at_us <= window_us]
        if word is None or not recent or recent[-1].said.startswith("setpoint"):
            return  # nothing answers a setpoint
        turn = next((t for t in reversed(recent) if what and what in t.said), recent[-1])
        if word not in turn.answers or not word.startswith(("PARAM", "FTP", "TEXT", "HOME", "MISSION_CURRENT")):
            turn.answers.append(word)  # a run of them counts once


def about(message: Any) -> str:
    """What an answer names: a command's number, a parameter."""
    kind = message.get_type()
    if kind == "COMMAND_ACK":
        return f" {message.command}("
    return f" {message.param_id}" if kind in ("PARAM_VALUE", "PARAM_ERROR") else ""


def mode_name(message: Any) -> str:
    """The custom mode of a HEARTBEAT: a number, or main/sub in PX4's."""
    custom = message.custom_mode
    if message.autopilot == mavlink.MAV_AUTOPILOT_PX4:
        return f"{custom >> 16 & 0xFF}/{custom >> 24 & 0xFF}"
    return str(custom)


def name_of(message: Any) -> str | None:
    """What a client's message is called here; None when it wants no answer."""
    kind = message.get_type()
    target = "" if getattr(message, "target_system", 1) in (0, 1) else f" to system {message.target_system}"
    match kind:
        case "COMMAND_LONG" | "COMMAND_INT":
            number = message.command
            shown = {176: (message.param1, message.param2, message.param3), 400: (message.param1, message.param2)}
            shown |= {n: (message.param1,) for n in (510, 511, 512, 520)}
            if number == 512 and message.param1 == mavlink.MAVLINK_MSG_ID_AVAILABLE_MODES:
                shown[512] = (message.param1, message.param2)
            values = ",".join(f"{value:g}" for value in shown.get(number, ()))
            extra = {242: " HOME_POSITION"}.get(round(message.param1), "") if number == 512 else ""
            return f"{kind.removeprefix('COMMAND_')} {number}({values}){extra}{target}"
        case "PARAM_SET" | "PARAM_REQUEST_READ":
            return f"{kind} {message.param_id or message.param_index}"
        case "MISSION_COUNT":
            return f"MISSION_COUNT {message.count} type {message.mission_type}"
        case "MISSION_ITEM" | "MISSION_ITEM_INT" | "MISSION_REQUEST" | "MISSION_REQUEST_INT":
            return f"{kind} {message.seq} type {message.mission_type}"
        case "MISSION_REQUEST_LIST" | "MISSION_CLEAR_ALL" | "MISSION_ACK":
            return f"{kind} type {message.mission_type}"
        case "MISSION_SET_CURRENT":
            return f"MISSION_SET_CURRENT {message.seq} -> MISSION_CURRENT"
        case "SET_MODE":
            return f"SET_MODE {message.custom_mode}"
        case "SET_POSITION_TARGET_LOCAL_NED":
            return f"setpoint, mask {message.type_mask}, frame {message.coordinate_frame}"
        case "FILE_TRANSFER_PROTOCOL":
            return f"FTP {bytes(message.payload)[3]}"
        case "REQUEST_DATA_STREAM":
            return f"REQUEST_DATA_STREAM {message.req_stream_id}"
        case "PING" | "TIMESYNC" if not _is_reply(message):
            return kind
        case _ if kind in _POLITE:
            return None
        case _:
            return str(kind)


def token(message: Any) -> str | None:
    """What an autopilot's message is called here."""
    kind = message.get_type()
    match kind:
        case "COMMAND_ACK":
            return f"ACK {message.command}={message.result}"
        case "STATUSTEXT":
            progress = message.severity >= mavlink.MAV_SEVERITY_INFO
            return None if progress or (message.id and message.chunk_seq) else f"TEXT {message.severity}"
        case "MISSION_ACK":
            return f"MISSION_ACK {message.type}"
        case "MISSION_COUNT":
            return f"MISSION_COUNT {message.count}"
        case _ if kind in _LISTED:
            return f"{kind} {message.seq}"
        case "PARAM_VALUE":
            return "PARAM_VALUE"
        case "FILE_TRANSFER_PROTOCOL":
            return {128: "FTP ack", 129: "FTP nak"}.get(bytes(message.payload)[3], "FTP")
        case "AVAILABLE_MODES":
            return f"AVAILABLE_MODES {message.mode_index}"
        case _:
            return str(kind)


def _is_reply(message: Any) -> bool:
    return bool(message.tc1) if message.get_type() == "TIMESYNC" else message.target_system != 0


def extract(whole: Path, short: Path) -> None:
    """The client's half and the autopilot's reactions; streams, lists and what repeats are left out."""
    decoder = mavlink.MAVLink(None)
    mode: Any = None
    current, asked_us = -1, 0
    kept = bytearray()
    for time_us, packet in packets(whole):
        try:
            message = decoder.decode(bytearray(packet))
        except mavlink.MAVError:
            continue
        kind = message.get_type()
        if message.get_srcSystem() == CLIENT:
            keep = name_of(message) is not None
            asked_us = time_us if kind in ("PARAM_REQUEST_READ", "PARAM_SET") else asked_us
        elif kind == "HEARTBEAT":
            now = (message.custom_mode, message.base_mode, message.system_status)
            keep, mode = now != mode, now
        elif kind == "PARAM_VALUE":
            keep = message.param_index < 4 or time_us - asked_us < ANSWER_US
        elif kind == "FILE_TRANSFER_PROTOCOL":
            keep = bytes(message.payload)[4] < 239  # not the content of a file
        elif kind in ("PING", "TIMESYNC"):
            keep = _is_reply(message)
        elif kind == "MISSION_CURRENT":
            keep, current = message.seq != current, message.seq
        else:
            keep = kind in _ANSWERS or kind in ("MISSION_ITEM_REACHED", "HOME_POSITION")
        if keep or not kept:  # the first packet tells when it began
            kept += time_us.to_bytes(8, "big") + packet
    short.write_bytes(gzip.compress(bytes(kept), 9, mtime=0))


if __name__ == "__main__":
    extract(Path(sys.argv[1]), Path(sys.argv[2]))
