"""CPU time of the simulated vehicle: `python -m benchmarks.bench_vehicle [seconds]`.

Everything is measured as CPU time of this process for one simulated second, hovering in HOLD after a takeoff; the least
of many windows of one second stands beside the median, since what else the machine does can only add to it. The last
lines are of runs against real sockets and the clock, CPU time over wall time.
"""

import socket
import statistics
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from typing import cast

import numpy as np

from fakevehicle.airframe import load_airframe
from fakevehicle.config import LinkConfig, Profile, VehicleConfig, zurich
from fakevehicle.driver import LinkPlan, Seat, open_links, run
from fakevehicle.flight import PARAMETERS, FlightStack
from fakevehicle.params import ParameterSet
from fakevehicle.vehicle import TICK_US, Vehicle
from fakevehicle.vocabulary import Setpoint
from wire.datagram import Datagram
from wire.dialect import mavlink
from wire.endpoint import Endpoint

TICKS_A_SECOND = 1_000_000 // TICK_US
HUNDRED: Mapping[int, float] = {
    mavlink.MAVLINK_MSG_ID_ATTITUDE: 30.0,
    mavlink.MAVLINK_MSG_ID_LOCAL_POSITION_NED: 20.0,
    mavlink.MAVLINK_MSG_ID_GLOBAL_POSITION_INT: 18.0,
}
"""Rates that make a ground station's link carry a hundred messages a second [Hz]."""
PLAIN = "whole vehicle, a ground station's link"


class Peer:
    """Sends commands into a vehicle's link and steps it."""

    def __init__(self, vehicle: Vehicle, link: str) -> None:
        self.vehicle, self.link, self.now_us = vehicle, link, 0
        self._mavlink = mavlink.MAVLink(None, srcSystem=255, srcComponent=190)

    def command(self, number: int, *params: float) -> None:
        """One COMMAND_LONG in one tick; it must be accepted."""
        values = [*params, *[0.0] * (7 - len(params))]
        message = mavlink.MAVLink_command_long_message(1, 1, number, 0, *values)
        before = self.vehicle.counters.rejected_commands
        inputs = [Datagram(self.link, message.pack(self._mavlink), ("127.0.0.1", 50000))]
        self.vehicle.step(self.now_us, inputs)
        self.now_us += TICK_US
        if self.vehicle.counters.rejected_commands != before:
            raise RuntimeError(f"command {number} was refused")

    def seconds(self, count: float) -> None:
        """Step through simulated time with nothing coming in."""
        for _ in range(round(count * TICKS_A_SECOND)):
            self.vehicle.step(self.now_us, [])
            self.now_us += TICK_US


def hovering(profile: Profile, rates: Mapping[int, float]) -> Peer:
    """A vehicle with one link that has taken off and holds."""
    peer = Peer(Vehicle(VehicleConfig(links=(LinkConfig("it", profile),))), "it")
    peer.seconds(8.0)
    peer.command(mavlink.MAV_CMD_COMPONENT_ARM_DISARM, 1.0)
    peer.command(mavlink.MAV_CMD_NAV_TAKEOFF, *[float("nan")] * 7)
    for number, rate in rates.items():
        peer.command(mavlink.MAV_CMD_SET_MESSAGE_INTERVAL, number, 1e6 / rate)
    peer.seconds(10.0)
    return peer


def windows(second: Callable[[], None], count: int) -> list[float]:
    """CPU times [ms] of that many simulated seconds."""
    found = []
    for _ in range(count):
        begin = time.process_time()
        second()
        found.append(1e3 * (time.process_time() - begin))
    return found


def stack_alone(count: int, gust: float) -> list[float]:
    """Physics, sensors, estimator and loops, without MAVLink."""
    stack = FlightStack(
        airframe=load_airframe("x500"),
        parameters=ParameterSet(PARAMETERS, {"SIM_WIND_GUST": gust}),
        home=zurich(),
        heading=0.0,
        wind_n=np.zeros(3),
        seed=1,
    )
    now_us = 0

    def second(setpoint: Setpoint | None) -> None:
        nonlocal now_us
        for _ in range(TICKS_A_SECOND):
            now_us += TICK_US
            stack.tick(now_us, setpoint, setpoint is not None)

    for _ in range(8):
        second(None)
    setpoint = Setpoint(stack.estimate.position_n - [0.0, 0.0, 5.0], np.zeros(3), np.zeros(3), 0.0)
    for _ in range(5):
        second(setpoint)
    return windows(lambda: second(setpoint), count)


class Continued:
    """A vehicle that has flown already, for a driver whose time begins at zero."""

    def __init__(self, peer: Peer) -> None:
        self._peer = peer

    def step(self, _now_us: int, inputs: Sequence[Datagram]) -> list[Datagram]:
        """As the vehicle's, in its own time."""
        now_us, self._peer.now_us = self._peer.now_us, self._peer.now_us + TICK_US
        return self._peer.vehicle.step(now_us, inputs)


def real_time(peer: Peer, seconds: float) -> tuple[float, int]:
    """CPU over wall time of a hovering vehicle that streams to a socket nobody reads, and ticks that were late."""
    sink = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    sink.bind(("127.0.0.1", 0))
    links = open_links([LinkPlan(peer.link, "gcs", Endpoint("udpout", "127.0.0.1", sink.getsockname()[1]))])
    seat = Seat(cast(Vehicle, Continued(peer)), links, lambda _: None)
    began, cpu = time.monotonic(), time.process_time()
    try:
        counters = run([seat], speed=1.0, stopped=lambda: time.monotonic() - began > seconds)
    finally:
        for link in links.values():
            link.close()
        sink.close()
    return (time.process_time() - cpu) / (time.monotonic() - began), counters.late


def main() -> None:
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 40
    print(
        "\n## The vehicle, CPU ms for a simulated second\n\n| case | messages/s | least | median |\n|---|---|---|---|"
    )
    peers: dict[str, Peer] = {}
    for name, profile, rates in (
        (PLAIN, "gcs", {}),
        ("whole vehicle, 100 msg/s", "gcs", HUNDRED),
        ("whole vehicle, a companion's link", "onboard", {}),
    ):
        peer = peers[name] = hovering(profile, rates)  # type: ignore[arg-type]
        before = peer.vehicle.counters.sent
        found = windows(lambda p=peer: p.seconds(1.0), count)  # type: ignore[misc]
        sent = (peer.vehicle.counters.sent - before) / count
        print(f"| {name} | {sent:.0f} | {min(found):.2f} | {statistics.median(found):.2f} |")
    for name, gust in (("flight stack alone", 0.0), ("flight stack alone, gusts of 8 m/s", 8.0)):
        found = stack_alone(count, gust)
        print(f"| {name} | 0 | {min(found):.2f} | {statistics.median(found):.2f} |")
    print("\nIn real time, hovering, % of a core (ten seconds each, the least and the greatest of five):\n")
    for name, peer in peers.items():
        if name != PLAIN:
            shares = [real_time(peer, 10.0) for _ in range(5)]
            least, most = (100.0 * f(share for share, _ in shares) for f in (min, max))
            print(f"- {name}: {least:.1f} to {most:.1f} %, {sum(late for _, late in shares)} ticks late")


if __name__ == "__main__":
    main()
