"""A client of the vehicle in memory: speaks with pymavlink's encoder, hears with its decoder, and counts time."""

import math
from typing import Any

from fakevehicle.vehicle import TICK_US, Vehicle
from wire.datagram import Address, Datagram
from wire.dialect import mavlink

NAN = math.nan


class Pilot:
    """One peer on one link. `heard` keeps (now_us, link, peer, message) of everything the vehicle sent."""

    def __init__(self, vehicle: Vehicle, link: str = "onboard", peer: Address = ("127.0.0.1", 50000)) -> None:
        self.vehicle = vehicle
        self.link = link
        self.peer = peer
        self.now_us = 0
        self.heard: list[tuple[int, str, Address | None, Any]] = []
        self._mavlink = mavlink.MAVLink(None, srcSystem=255, srcComponent=190)
        self._waiting: list[Datagram] = []
        self._newest: dict[str, Any] = {}

    def bytes_of(self, message: Any, *, mavlink1: bool = False) -> bytes:
        packed: bytes = message.pack(self._mavlink, force_mavlink1=mavlink1)
        self._mavlink.seq = (self._mavlink.seq + 1) % 256
        return packed

    def send(self, *messages: Any, mavlink1: bool = False) -> None:
        """Will arrive with the next tick."""
        self._waiting += [Datagram(self.link, self.bytes_of(m, mavlink1=mavlink1), self.peer) for m in messages]

    def send_raw(self, data: bytes) -> None:
        self._waiting.append(Datagram(self.link, data, self.peer))

    def tick(self, count: int = 1) -> list[Any]:
        """Run some ticks; what was heard on our link in them."""
        begin = len(self.heard)
        for _ in range(count):
            inputs, self._waiting = self._waiting, []
            for datagram in self.vehicle.step(self.now_us, inputs):
                message = self._mavlink.decode(bytearray(datagram.data))
                self.heard.append((self.now_us, datagram.link, datagram.peer, message))
                if datagram.link == self.link:
                    self._newest[message.get_type()] = message
            self.now_us += TICK_US
        return [m for _, link, _, m in self.heard[begin:] if link == self.link]

    def run(self, seconds: float) -> list[Any]:
        return self.tick(round(seconds * 1e6 / TICK_US))

    def fly(self, seconds: float, setpoint: Any) -> list[Any]:
        """Run while sending one setpoint at 20 Hz."""
        heard: list[Any] = []
        for _ in range(round(seconds * 20)):
            self.send(setpoint)
            heard += self.run(0.05)
        return heard

    def command(self, number: int, *params: float) -> int:
        """Send a COMMAND_LONG and give back the result of its acknowledgement, which comes in the same tick."""
        values = [*params, *[0.0] * (7 - len(params))]
        self.send(mavlink.MAVLink_command_long_message(1, 1, number, 0, *values))
        return self.ack(self.tick(), number)

    @staticmethod
    def ack(heard: list[Any], number: int) -> int:
        (ack,) = [m for m in heard if m.get_type() == "COMMAND_ACK"]
        assert ack.command == number
        assert (ack.target_system, ack.target_component) == (255, 190)
        return int(ack.result)

    def of(self, kind: str) -> list[Any]:
        """Every message of one kind on our link, oldest first."""
        return [m for _, link, _, m in self.heard if link == self.link and m.get_type() == kind]

    def last(self, kind: str) -> Any:
        """The newest message of one kind on our link."""
        return self._newest[kind]

    def texts(self) -> list[str]:
        """STATUSTEXTs, their chunks put together again."""
        whole: list[str] = []
        for message in self.of("STATUSTEXT"):
            if message.id and message.chunk_seq:
                whole[-1] += message.text
            else:
                whole.append(message.text)
        return whole

    def until(self, condition: Any, seconds: float) -> float:
        """Run until `condition()` holds; the time it took, or a failure."""
        begin = self.now_us
        while not condition():
            assert self.now_us - begin < seconds * 1e6, f"not within {seconds} s: {self.texts()[-3:]}"
            self.tick()
        return (self.now_us - begin) * 1e-6

    @property
    def mode(self) -> tuple[int, int]:
        """(main, sub) of the newest HEARTBEAT."""
        custom = self.last("HEARTBEAT").custom_mode
        return custom >> 16 & 0xFF, custom >> 24 & 0xFF

    @property
    def armed(self) -> bool:
        return bool(self.last("HEARTBEAT").base_mode & 128)

    @property
    def landed_state(self) -> int:
        return int(self.last("EXTENDED_SYS_STATE").landed_state)


def position(north: float, east: float, down: float, yaw: float = 0.0) -> Any:
    """A position setpoint in local NED."""
    return mavlink.MAVLink_set_position_target_local_ned_message(
        0, 1, 1, 1, 0x9F8, north, east, down, 0, 0, 0, 0, 0, 0, yaw, 0
    )


HOLD, LAND, RTL, TAKEOFF, OFFBOARD = (4, 3), (4, 6), (4, 5), (4, 2), (6, 0)
ACCEPTED, REJECTED, DENIED, UNSUPPORTED, FAILED = 0, 1, 2, 3, 4
