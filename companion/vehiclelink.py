"""The link toward the vehicle: who on it is obeyed, and our packets to them.

Obeyed is the configured system's autopilot, or the first autopilot that says it is one. Its address is fixed by its
first HEARTBEAT: whoever else uses the same system id from elsewhere is another, and told about once. Only when the
first has been silent for `RELEARN_US` a HEARTBEAT from elsewhere is taken for its: a vehicle that was started again
calls from another port.
"""

from collections.abc import Iterator
from typing import Any

from wire.datagram import Address, Datagram
from wire.dialect import mavlink
from wire.framing import Framer, Packet

VEHICLE_LINK = "autopilot"
"""Its name; every other link is a ground station's."""
COMPONENT_ID = mavlink.MAV_COMP_ID_ONBOARD_COMPUTER
AUTOPILOT_COMPONENT = mavlink.MAV_COMP_ID_AUTOPILOT1
RELEARN_US = 3_000_000


class VehicleLink:
    """One vehicle, as it is reached.

    Parameters
    ----------
    system_id : obey only this vehicle; None: the first autopilot heard.
    speaks_first : the vehicle waits to be called.

    Attributes
    ----------
    framer : its counters tell what was lost.
    system_id : of the vehicle that is obeyed; None before it is known.
    peer : its address; None before it was heard, and in a lockstep without addresses.
    heard_us : when it was last heard; None before that.
    foreign_packets : packets of others, recorded but not obeyed.
    impostor : in words, somebody else who calls himself the same; empty, and empty again once told.
    decoder : pymavlink's, for whoever decodes a packet whole.
    """

    def __init__(self, system_id: int | None, speaks_first: bool) -> None:
        self._wanted, self._speaks_first = system_id, speaks_first
        self.framer = Framer()
        self.system_id = system_id
        self.peer: Address | None = None
        self.heard_us: int | None = None
        self.foreign_packets = 0
        self.impostor = ""
        self.decoder = mavlink.MAVLink(None)
        self._impostor_told = False
        self._sequence = 0

    @property
    def target(self) -> int:
        """System id to write into messages; 0, everybody, before it is known."""
        return self.system_id or 0

    @property
    def may_speak(self) -> bool:
        """Whether there is somebody to speak to: the vehicle was heard, or it waits to be called."""
        return self.heard_us is not None or self._speaks_first

    def packets(self, now_us: int, datagram: Datagram) -> Iterator[tuple[Packet, bool]]:
        """The packets of the vehicle's system in a datagram, and whether they are its autopilot's, who is obeyed.

        Everybody's but the autopilot's are counted as foreign.
        """
        for packet in self.framer.packets(datagram.data):
            gone = self.heard_us is None or now_us - self.heard_us > RELEARN_US
            if gone and (self.heard_us is None or datagram.peer != self.peer) and self._is_autopilot(packet):
                self.system_id, self.peer, self.heard_us = packet.system_id, datagram.peer, now_us
                self._impostor_told = False
            if self.is_vehicle(packet, datagram.peer):
                if packet.message_id in mavlink.mavlink_map:  # of others the checksum is not known: they may be noise
                    self.heard_us = now_us
                yield packet, True
            else:
                self._count_foreign(packet, datagram.peer)
                if self.heard_us is not None and packet.system_id == self.system_id and datagram.peer == self.peer:
                    yield packet, False

    def is_vehicle(self, packet: Packet, peer: Address | None) -> bool:
        """Whether a packet is from the autopilot that is obeyed."""
        known = self.heard_us is not None and peer == self.peer
        return known and packet.system_id == self.system_id and packet.component_id == AUTOPILOT_COMPONENT

    def pack(self, message: Any) -> Datagram:
        """One message to the vehicle, from its own system id and our component."""
        self.decoder.srcSystem, self.decoder.srcComponent = self.system_id or 1, COMPONENT_ID
        self.decoder.seq = self._sequence
        self._sequence = (self._sequence + 1) & 0xFF
        return Datagram(VEHICLE_LINK, bytes(message.pack(self.decoder)), self.peer)

    def heartbeat(self, state: int) -> Datagram:
        """HEARTBEAT of the companion to the vehicle; `state` is a MAV_STATE."""
        kind = mavlink.MAV_TYPE_ONBOARD_CONTROLLER
        return self.pack(mavlink.MAVLink_heartbeat_message(kind, mavlink.MAV_AUTOPILOT_INVALID, 0, 0, state, 3))

    def _count_foreign(self, packet: Packet, peer: Address | None) -> None:
        self.foreign_packets += 1
        same_name = self.heard_us is not None and packet.system_id == self.system_id
        if same_name and peer != self.peer and not self._impostor_told:
            self._impostor_told = True
            where = "elsewhere" if peer is None else f"{peer[0]}:{peer[1]}"
            self.impostor = f"another sender at {where} also calls itself system {self.system_id}: it is not obeyed"

    def _is_autopilot(self, packet: Packet) -> bool:
        """Whether a packet is a HEARTBEAT of an autopilot that may be obeyed."""
        if packet.message_id != mavlink.MAVLINK_MSG_ID_HEARTBEAT or packet.component_id != AUTOPILOT_COMPONENT:
            return False
        heartbeat = self.decoder.decode(bytearray(packet.raw))
        known = self.system_id if self.heard_us is not None else self._wanted
        return packet.system_id == (known or packet.system_id) and (
            heartbeat.autopilot != mavlink.MAV_AUTOPILOT_INVALID
        )
