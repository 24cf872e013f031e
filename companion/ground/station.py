"""The companion as ground stations meet it: its own component, with a mission protocol and commands of its own.

    station = GroundStation(system_id=lambda: companion.link.target, locate=companion.locate)
    datagrams = station.take(now_us, datagram, obey)

Answers go back the way the question came. `plan_file` makes of an uploaded plan the file that is flown.
"""

from collections.abc import Callable, Sequence
from typing import Any

from companion.geodesy import Geodetic
from companion.ground.orders import Locate, Orders
from companion.ground.progress import Course, Progress
from companion.ground.protocol import Answer, MissionProtocol, Sender, without_home
from companion.hooks import Obey
from companion.planfiles.fence import to_fence
from companion.planfiles.items import GroundPlan
from companion.planfiles.qgc import write_plan
from companion.vehiclelink import COMPONENT_ID
from wire.datagram import Address, Datagram
from wire.dialect import mavlink
from wire.framing import Framer

TEXT = 50
"""Characters of a STATUSTEXT; longer ones go in chunks."""
MOST_CHUNKS = 4
WANTED = frozenset(
    {
        mavlink.MAVLINK_MSG_ID_COMMAND_LONG,
        mavlink.MAVLINK_MSG_ID_COMMAND_INT,
        mavlink.MAVLINK_MSG_ID_MISSION_SET_CURRENT,
        mavlink.MAVLINK_MSG_ID_MISSION_COUNT,
        mavlink.MAVLINK_MSG_ID_MISSION_WRITE_PARTIAL_LIST,
        mavlink.MAVLINK_MSG_ID_MISSION_REQUEST_PARTIAL_LIST,
        mavlink.MAVLINK_MSG_ID_MISSION_ITEM,
        mavlink.MAVLINK_MSG_ID_MISSION_ITEM_INT,
        mavlink.MAVLINK_MSG_ID_MISSION_CLEAR_ALL,
        mavlink.MAVLINK_MSG_ID_MISSION_REQUEST_LIST,
        mavlink.MAVLINK_MSG_ID_MISSION_REQUEST,
        mavlink.MAVLINK_MSG_ID_MISSION_REQUEST_INT,
        mavlink.MAVLINK_MSG_ID_MISSION_ACK,
    }
)
"""What is decoded at all."""
USUAL_SPEED = 3.0
"""Of an uploaded plan that names no speed [m/s]."""


def nowhere(latitude: float, longitude: float, altitude: float, above_home: bool) -> None:
    """Nothing is known of where a place is."""


class GroundStation:
    """Answers ground stations; a `hooks.Ground`.

    Parameters
    ----------
    system_id : gives the vehicle's, which is ours, too; 0 while it is not known: then nobody is answered.
    locate : finds places of the earth in the mission frame.
    plan : what the flight flies, and what is kept at the beginning.
    course : where the flight is; None: this is no flight.
    links : of everybody who is told how far it is.

    Attributes
    ----------
    missions : the mission protocol, with the plans.
    progress : how far the flight is in the plan.
    """

    def __init__(
        self,
        system_id: Callable[[], int],
        locate: Locate = nowhere,
        plan: GroundPlan | None = None,
        course: Callable[[], Course] | None = None,
        links: Sequence[str] = (),
    ) -> None:
        self._system_id, self._links = system_id, tuple(links)
        kept = GroundPlan() if plan is None else plan
        fixed = "" if course is None else "it is not changed in flight"
        self.missions = MissionProtocol(kept.items, kept.fence, fixed)
        self.progress = Progress(plan, course)
        self._orders = Orders(locate, self.progress)
        self._framer = Framer()
        self._mav = mavlink.MAVLink(None)
        self._sequence = 0
        self._texts = 0
        self._places: dict[Sender, tuple[str, Address | None]] = {}  # whence each sender last spoke to us

    def take(self, now_us: int, datagram: Datagram, obey: Obey) -> list[Datagram]:
        """A ground station's datagram: what to answer. What it orders is carried out by `obey`."""
        out: list[Datagram] = []
        ours = self._system_id()
        for packet in self._framer.packets(datagram.data):
            if packet.message_id not in WANTED or not ours:
                continue
            try:
                message = self._mav.decode(bytearray(packet.raw))
            except mavlink.MAVError:
                continue  # not what its id says: the router counts it
            if (message.target_system, message.target_component) != (ours, COMPONENT_ID):
                continue
            sender = Sender(packet.system_id, packet.component_id)
            if len(self._places) >= MOST_SENDERS and sender not in self._places:
                self._places.clear()
            self._places[sender] = (datagram.link, datagram.peer)
            uploads = self.missions.uploads
            answer = self._orders.take(now_us, sender, message, obey) or self.missions.take(now_us, sender, message)
            self.progress.complete = self.progress.complete and uploads == self.missions.uploads
            out.extend(self._sent(answer))
        return out

    def step(self, now_us: int) -> list[Datagram]:
        """Once a tick, at its end: repeats and progress."""
        out = self._sent(self.missions.step(now_us))
        if self._system_id():
            kept = self.missions.items
            flown, _ = without_home(kept)
            for message in self.progress.step(now_us, len(kept) - len(flown), len(flown)):
                data = self._packed(message)
                out.extend(Datagram(link, data) for link in self._links)
        return out

    def after(self, flight: "GroundStation") -> None:
        """Go on after a flight that had a station of its own: with what was uploaded meanwhile, and how far it got."""
        if flight.missions.uploads:
            self.missions.take_over(flight.missions)
        self.progress.complete = flight.progress.complete and not flight.missions.uploads

    def _sent(self, answer: Answer | None) -> list[Datagram]:
        place = None if answer is None else self._places.get(answer.to)
        if answer is None or place is None:
            return []
        messages = [*answer.messages, *self._text(answer.text)]
        return [Datagram(place[0], self._packed(message), place[1]) for message in messages]

    def _text(self, text: str) -> list[Any]:
        """STATUSTEXT of severity WARNING, in chunks where it is long."""
        data = text.encode("ascii", "replace")[: TEXT * MOST_CHUNKS]
        if not data:
            return []
        if len(data) <= TEXT:
            return [mavlink.MAVLink_statustext_message(mavlink.MAV_SEVERITY_WARNING, data)]
        self._texts = self._texts % 0xFFFF + 1
        chunks = [data[at : at + TEXT] for at in range(0, len(data), TEXT)]
        if len(chunks[-1]) == TEXT:
            chunks.append(b"")  # a text ends with a chunk that is not full
        return [
            mavlink.MAVLink_statustext_message(mavlink.MAV_SEVERITY_WARNING, chunk, self._texts, number)
            for number, chunk in enumerate(chunks)
        ]

    def _packed(self, message: Any) -> bytes:
        self._mav.srcSystem, self._mav.srcComponent = self._system_id(), COMPONENT_ID
        self._mav.seq = self._sequence
        self._sequence = (self._sequence + 1) & 0xFF
        return bytes(message.pack(self._mav))


MOST_SENDERS = 64


def plan_file(plans: MissionProtocol, here: Geodetic) -> bytes:
    """What was uploaded as the bytes of a `.plan`, to be flown and recorded; home is where the vehicle stands."""
    flown, _ = without_home(plans.items)
    uploaded = {"home": plans.items[: len(plans.items) - len(flown)], "fence": plans.fence}
    return write_plan(flown, here, USUAL_SPEED, to_fence(plans.fence), None, uploaded).encode()
