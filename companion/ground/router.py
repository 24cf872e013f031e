"""Who gets which packet: a small router between the vehicle and its ground stations.

It learns where each (system, component) speaks from, be it several places at once, and follows MAVLink's rules
(https://mavlink.io/en/guide/routing.html):

    no target, or everybody     to every link but the one it came from
    a target that was heard     only there, never back to its sender
    a target nobody has heard   as if it were for everybody

and four of our own:

    ours                        what is addressed to the companion is not for the vehicle, whose autopilot may answer
                                commands to any component of its system; nor is it while that system is not known
    loops                       a packet that comes by a second way within `TWICE_US` has gone round: dropped; so is one
                                that claims to be of the companion, or, from a ground station's link, of the vehicle
    damage                      what is no whole packet with a good checksum goes nowhere
    floods                      a ground link may hand over `RATE` packets a second, and `BURST` at once

Everything that is kept is bounded: `MOST_ROUTES` senders, `MOST_SEEN` packets.
"""

from collections import OrderedDict
from dataclasses import dataclass
from struct import calcsize
from zlib import crc32

from companion.vehiclelink import COMPONENT_ID, VEHICLE_LINK
from wire.datagram import Address, Datagram
from wire.dialect import mavlink
from wire.framing import Framer, Packet

SILENT_US = 60_000_000
"""A sender unheard for so long has no place any more."""
TWICE_US = 500_000
MOST_ROUTES = 256
MOST_SEEN = 4096
RATE, BURST = 1000.0, 500.0

Place = tuple[str, Address | None]
"""A link, and who on it."""


def _target_offsets() -> dict[int, tuple[int, int]]:
    """By message id: where the payload has the target's system and component; -1 where it has none."""
    found = {}
    for number, kind in mavlink.mavlink_map.items():
        letters = bytes(kind.native_format).decode().lstrip("<")
        offset, places = 0, {}
        for name, letter, length in zip(kind.ordered_fieldnames, letters, kind.array_lengths, strict=True):
            places[name] = offset
            offset += calcsize(f"<{length or 1}{letter}")
        if "target_system" in places:
            found[number] = (places["target_system"], places.get("target_component", -1))
    return found


_TARGETS = _target_offsets()


def target_of(packet: Packet) -> tuple[int, int]:
    """(system, component) that a packet is for; 0 is everybody."""
    places = _TARGETS.get(packet.message_id)
    if places is None:
        return 0, 0
    system, component = (packet.payload[at] if 0 <= at < len(packet.payload) else 0 for at in places)
    return system, component


@dataclass(slots=True)
class RouterCounters:
    """Packets: routed, for us alone, gone round in a loop, over the rate; and datagrams with damage in them."""

    routed: int = 0
    ours: int = 0
    loops: int = 0
    flooded: int = 0
    damaged: int = 0


class Router:
    """Routes of one companion.

    Parameters
    ----------
    ground_links : the links beside the vehicle's.

    Attributes
    ----------
    counters : what became of the packets.
    """

    def __init__(self, ground_links: tuple[str, ...]) -> None:
        self.counters = RouterCounters()
        self._links = (VEHICLE_LINK, *ground_links)
        self._framer = Framer()
        self._routes: dict[tuple[int, int, Place], int] = {}  # who speaks from where -> when last
        self._seen: OrderedDict[int, tuple[int, Place]] = OrderedDict()  # checksum -> when and whence it came first
        self._allowed: dict[str, tuple[float, int]] = {link: (BURST, 0) for link in ground_links}

    def route(self, now_us: int, datagram: Datagram, system_id: int | None, peer: Address | None) -> list[Datagram]:
        """Where the packets of a datagram go; one that goes whole to one place stays one datagram.

        Parameters
        ----------
        system_id, peer : of the vehicle, where they are known; ours is the vehicle's system id.
        """
        if len(self._links) == 1:
            return []
        came: Place = (datagram.link, datagram.peer)
        packets = self._framer.packets(datagram.data)
        size = sum(len(packet.raw) for packet in packets)
        self.counters.damaged += size != len(datagram.data)
        parts: dict[Place, list[bytes]] = {}
        for packet in packets:
            for place in self._places(now_us, packet, came, system_id, peer):
                parts.setdefault(place, []).append(packet.raw)
        return [Datagram(link, b"".join(raws), at) for (link, at), raws in parts.items()]

    def _places(
        self, now_us: int, packet: Packet, came: Place, system_id: int | None, peer: Address | None
    ) -> list[Place]:
        sender, link = (packet.system_id, packet.component_id), came[0]
        if system_id is not None and sender == (system_id, COMPONENT_ID):
            self.counters.loops += 1
            return []
        if link != VEHICLE_LINK and not self._may(now_us, link):
            self.counters.flooded += 1
            return []
        if self._went_round(now_us, packet, came) or not self._learn(now_us, sender, came):
            self.counters.loops += 1
            return []
        target = target_of(packet)
        if target[1] == COMPONENT_ID and (system_id is None or target[0] in (0, system_id)):
            self.counters.ours += 1
            return []
        places = self._toward(now_us, target, came)
        self.counters.routed += bool(places)
        return [(VEHICLE_LINK, peer) if place[0] == VEHICLE_LINK else place for place in places]

    def _toward(self, now_us: int, target: tuple[int, int], came: Place) -> list[Place]:
        system, component = target
        if system:
            known = [
                place
                for (sys, comp, place), heard_us in self._routes.items()
                if sys == system and component in (0, comp) and now_us - heard_us <= SILENT_US
            ]
            if known:
                return [place for place in dict.fromkeys(known) if place not in (came, (came[0], None))]
        return [(link, None) for link in self._links if link != came[0]]

    def _learn(self, now_us: int, sender: tuple[int, int], came: Place) -> bool:
        """Remember where a sender speaks from; False when it is the vehicle's and speaks from elsewhere."""
        vehicles: Place = (VEHICLE_LINK, None)
        place = vehicles if came[0] == VEHICLE_LINK else came
        heard_us = self._routes.get((*sender, vehicles))
        if place != vehicles and heard_us is not None and now_us - heard_us <= SILENT_US:
            return False
        key = (*sender, place)
        if key not in self._routes and len(self._routes) >= MOST_ROUTES:
            del self._routes[min(self._routes, key=self._routes.__getitem__)]
        self._routes[key] = now_us
        return True

    def _went_round(self, now_us: int, packet: Packet, came: Place) -> bool:
        """Whether the same packet has come another way just before."""
        seen = self._seen
        while seen and (len(seen) >= MOST_SEEN or now_us - next(iter(seen.values()))[0] > TWICE_US):
            seen.popitem(last=False)
        key = crc32(packet.raw)
        first = seen.get(key)
        if first is None:
            seen[key] = (now_us, came)
            return False
        return first[1] != came

    def _may(self, now_us: int, link: str) -> bool:
        """Take one packet from what the link may hand over."""
        left, then_us = self._allowed.get(link, (0.0, now_us))
        left = min(BURST, left + RATE * max(0, now_us - then_us) / 1e6)
        self._allowed[link] = (max(0.0, left - 1.0), now_us)
        return left >= 1.0
