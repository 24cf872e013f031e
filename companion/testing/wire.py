"""A wire that loses, repeats, delays and invents, the same way every time: the faults of a link, in lockstep.

Each datagram, in each direction, in the order in which it is sent:
1. is gone when its moment lies in a blackout, or with probability `loss`;
2. is late by a time drawn evenly from 0 to `jitter_ms`, and with probability `reorder` by another 20 to 60 ms, so that
   later ones overtake it;
3. comes a second time with probability `duplicate`, with a delay of its own.

Between them come `garbage` datagrams a second of noise or of packets with broken bytes, and with `shouting` another
system on the same address, with HEARTBEATs of an autopilot, positions far away and commands to everybody it can think
of. Toward the vehicle it shouts at a third one only: a real autopilot obeys whoever addresses it.

Everything is drawn from two generators of one seed, one a direction: the same datagrams meet the same fate.
"""

import heapq
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from wire.datagram import Datagram
from wire.dialect import mavlink

SHOUTER, BYSTANDER = 42, 43
"""System ids of who shouts, and of the one it shouts at where the vehicle hears it."""
SHOUT_EVERY_US = 100_000
OVERTAKEN_US = (20_000, 60_000)
MOST_WAITING = 100_000
"""Datagrams on the way in one direction; what is more is lost."""


@dataclass(frozen=True, slots=True)
class LinkFaults:
    """What a link does to its datagrams, in both directions alike.

    Attributes
    ----------
    loss, duplicate, reorder : probabilities, 0 to 1.
    jitter_ms : longest delay [ms].
    blackouts : from and to [s] of the simulated time, in which nothing passes.
    garbage : datagrams a second of noise.
    shouting : whether another system is on the link.
    seed : of all of it.

    Raises
    ------
    ValueError : a number is out of its range; the message names it.
    """

    loss: float = 0.0
    duplicate: float = 0.0
    reorder: float = 0.0
    jitter_ms: float = 0.0
    blackouts: tuple[tuple[float, float], ...] = ()
    garbage: float = 0.0
    shouting: bool = False
    seed: int = 0

    def __post_init__(self) -> None:
        for name in ("loss", "duplicate", "reorder"):
            if not 0.0 <= getattr(self, name) <= 1.0:
                raise ValueError(f"{name} {getattr(self, name):g}: expected 0 to 1")
        for name, most in (("jitter_ms", 10_000.0), ("garbage", 1000.0)):
            if not 0.0 <= getattr(self, name) <= most:
                raise ValueError(f"{name} {getattr(self, name):g}: expected 0 to {most:g}")
        for start, end in self.blackouts:
            if not (math.isfinite(start) and start < end):
                raise ValueError(f"blackout from {start:g} to {end:g} s: expected an end after the start")
        if self.seed < 0:
            raise ValueError(f"seed {self.seed}: expected 0 or more")


@dataclass(slots=True)
class WireCounters:
    """What happened on one direction."""

    sent: int = 0
    lost: int = 0
    repeated: int = 0
    invented: int = 0


class FaultyWire:
    """Both directions of one link with `LinkFaults`; a `companion.drivers.lockstep.Wire`.

    Parameters
    ----------
    faults : what goes wrong.
    link : the vehicle's name for the link, for what is invented toward it.
    """

    def __init__(self, faults: LinkFaults, link: str) -> None:
        up, down = np.random.default_rng(faults.seed).spawn(2)
        self._up = _Way(faults, up, _Shouter(BYSTANDER, 1))
        self._down = _Way(faults, down, _Shouter(1, 191))
        self._link = link

    @property
    def counters(self) -> tuple[WireCounters, WireCounters]:
        """To the vehicle, to the companion."""
        return self._up.counters, self._down.counters

    def to_vehicle(self, now_us: int, sent: Sequence[Datagram]) -> list[Datagram]:
        """What arrives at the vehicle at `now_us`."""
        return self._up.carry(now_us, sent, self._link)

    def to_companion(self, now_us: int, sent: Sequence[Datagram]) -> list[Datagram]:
        """What arrives at the companion at `now_us`."""
        return self._down.carry(now_us, sent, "")


class _Way:
    """One direction."""

    def __init__(self, faults: LinkFaults, rng: np.random.Generator, shouter: "_Shouter") -> None:
        self._faults, self._rng, self._shouter = faults, rng, shouter
        self._waiting: list[tuple[int, int, Datagram]] = []
        self._number = 0
        self._last_us = 0
        self._shout_due_us = 0
        self._sample = b"\xfd" + bytes(20)  # a packet that passed lately, for garbage that looks like one
        self.counters = WireCounters()

    def carry(self, now_us: int, sent: Sequence[Datagram], link: str) -> list[Datagram]:
        f = self._faults
        for datagram in sent:
            self._send(now_us, datagram)
        if f.garbage > 0.0 and self._rng.random() < f.garbage * (now_us - self._last_us) * 1e-6:
            self.counters.invented += 1
            self._put(now_us, Datagram(link, self._noise()))
        if f.shouting and now_us >= self._shout_due_us:
            self._shout_due_us = now_us + SHOUT_EVERY_US
            for data in self._shouter.shout(now_us):
                self.counters.invented += 1
                self._put(now_us, Datagram(link, data))
        self._last_us = now_us
        arrived = []
        while self._waiting and self._waiting[0][0] <= now_us:
            arrived.append(heapq.heappop(self._waiting)[2])
        return arrived

    def _send(self, now_us: int, datagram: Datagram) -> None:
        f = self._faults
        lost, again, overtaken, *delays = self._rng.random(6).tolist()
        self.counters.sent += 1
        self._sample = datagram.data
        dark = any(start <= now_us * 1e-6 < end for start, end in f.blackouts)
        if dark or lost < f.loss:
            self.counters.lost += 1
            return
        least, most = OVERTAKEN_US
        behind = least + delays[2] * (most - least) if overtaken < f.reorder else 0.0
        self._put(now_us + round(1e3 * f.jitter_ms * delays[0] + behind), datagram)
        if again < f.duplicate:
            self.counters.repeated += 1
            self._put(now_us + round(1e3 * f.jitter_ms * delays[1]), datagram)

    def _put(self, due_us: int, datagram: Datagram) -> None:
        if len(self._waiting) >= MOST_WAITING:
            self.counters.lost += 1
            return
        self._number += 1  # those that are due together arrive in the order they were sent
        heapq.heappush(self._waiting, (due_us, self._number, datagram))

    def _noise(self) -> bytes:
        """Random bytes, or a packet of which a few bytes are not what they were."""
        if self._rng.random() < 0.5:
            return self._rng.bytes(int(self._rng.integers(1, 300)))
        data = bytearray(self._sample)
        for place in self._rng.integers(0, len(data), 3).tolist():
            data[place] ^= int(self._rng.integers(1, 256))
        return bytes(data)


class _Shouter:
    """Another system: what it says, and to whom it gives its commands."""

    def __init__(self, system: int, component: int) -> None:
        self._target = system, component
        self._mavlink = mavlink.MAVLink(None)
        self._mavlink.srcSystem, self._mavlink.srcComponent = SHOUTER, 1
        self._turn = 0

    def shout(self, now_us: int) -> Iterator[bytes]:
        """The next of its sayings."""
        m, boot_ms = mavlink, now_us // 1000 & 0xFFFFFFFF
        sayings: tuple[Any, ...] = (
            m.MAVLink_heartbeat_message(m.MAV_TYPE_QUADROTOR, m.MAV_AUTOPILOT_PX4, 0x81, 9 << 16, 4, 3),
            m.MAVLink_local_position_ned_message(boot_ms, 1e4, -1e4, 50.0, 20.0, 0.0, 0.0),
            self._command(m.MAV_CMD_NAV_LAND),
            self._command(m.MAV_CMD_COMPONENT_ARM_DISARM, 0.0, 21196.0),
            self._command(m.MAV_CMD_DO_SET_MODE, 1.0, 4.0, 3.0),
            self._command(m.MAV_CMD_NAV_RETURN_TO_LAUNCH),
            m.MAVLink_extended_sys_state_message(0, m.MAV_LANDED_STATE_ON_GROUND),
            m.MAVLink_command_ack_message(m.MAV_CMD_COMPONENT_ARM_DISARM, m.MAV_RESULT_DENIED),
        )
        saying = sayings[self._turn % len(sayings)]
        self._turn += 1
        self._mavlink.seq = self._turn & 0xFF
        yield bytes(saying.pack(self._mavlink))

    def _command(self, number: int, *params: float) -> Any:
        seven = (*params, *(0.0,) * (7 - len(params)))
        return mavlink.MAVLink_command_long_message(*self._target, number, 0, *seven)
