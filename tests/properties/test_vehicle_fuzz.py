"""A flood of 200 000 datagrams that nobody meant: nothing raises, nothing changes, nothing grows.

Four kinds, in turns: noise; packets with flipped bits; packets of every kind with random payloads, whole and checked;
and real requests with one field spoilt. What may change the vehicle's state is left out of the last two where it is
whole and addressed to us: there, what must not change is everything a valid packet does not ask for.
"""

import gc
import random
import struct
import sys
import tracemalloc
from collections.abc import Callable
from typing import Any

import pytest
from flight_double import PointMass
from vehicle_pilot import Pilot, position

import fakevehicle.vehicle
from fakevehicle.config import Autopilot, LinkConfig, VehicleConfig
from fakevehicle.files import MemoryFiles
from fakevehicle.vehicle import Vehicle
from wire.datagram import Datagram
from wire.dialect import mavlink as m

TICKS = 10_000
EACH = 20
"""Datagrams a tick: 200 000 in all."""
BLOCKS = 5_000
"""Python objects that the second half of the flood may leave behind; bounded tables fill in the first."""
GROWTH = 512 * 1024
"""Bytes that its last tenth may: what replaces older entries of those tables is counted here, too."""
ASKS = {
    # What may change mode, arming, plans, parameters or streams when it is whole and for us.
    m.MAVLINK_MSG_ID_COMMAND_LONG,
    m.MAVLINK_MSG_ID_COMMAND_INT,
    m.MAVLINK_MSG_ID_SET_MODE,
    m.MAVLINK_MSG_ID_PARAM_SET,
}
COMMANDS: list[tuple[int, tuple[float, ...]]] = [
    *((number, (1, 0, 0, 0, 0, 0, 5)) for number in (400, 22, 21, 20, 300, 178, 179, 192, 420, 410, 511, 512, 510)),
    (176, (1, 6, 0, 0, 0, 0, 0)),
    (176, (1, 4, 3, 0, 0, 0, 0)),
    (246, (2, 0, 0, 0, 0, 0, 0)),  # not 1, by which all that is counted here begins anew
]
WORD = struct.Struct("<HBBBBBBI")


def requests(pilot: Pilot) -> list[bytes]:
    """One of every request that asks for no change, whole."""

    def ftp(opcode: int, data: bytes = b"", session: int = 1, offset: int = 0) -> Any:
        payload = (WORD.pack(1, session, opcode, len(data), 0, 0, 0, offset) + data).ljust(251, b"\0")
        return m.MAVLink_file_transfer_protocol_message(0, 1, 1, payload)

    whole = [
        *(ftp(opcode, b"/log/a.mcap") for opcode in range(17)),
        ftp(4, b"@PARAM/param.pck?withdefaults=1"),
        ftp(15, b"", offset=10),
        ftp(3, b"/"),
        m.MAVLink_log_request_list_message(1, 1, 0, 0xFFFF),
        m.MAVLink_log_request_data_message(1, 1, 0, 0, 46_080),
        m.MAVLink_log_request_end_message(1, 1),
        m.MAVLink_log_erase_message(1, 1),
        m.MAVLink_param_request_list_message(1, 1),
        m.MAVLink_param_request_read_message(1, 1, b"MPC_XY_P", -1),
        m.MAVLink_param_request_read_message(1, 1, b"", 7),
        *(m.MAVLink_mission_request_list_message(1, 1, kind) for kind in (0, 1, 2)),
        m.MAVLink_mission_request_int_message(1, 1, 3, 0),
        m.MAVLink_mission_request_message(1, 1, 3, 0),
        m.MAVLink_mission_ack_message(1, 1, 0, 0),
        m.MAVLink_ping_message(1, 2, 0, 0),
        m.MAVLink_timesync_message(0, 5),
        m.MAVLink_serial_control_message(10, 6, 0, 0, 4, [65] * 70),
        m.MAVLink_heartbeat_message(6, 8, 0, 0, 4, 3),
    ]
    return [pilot.bytes_of(message) for message in whole]


class Flood:
    """Draws datagrams from one generator."""

    def __init__(self, pilot: Pilot, seed: int) -> None:
        self.random = random.Random(seed)
        self.requests = requests(pilot)
        self.orders = [
            pilot.bytes_of(message)
            for message in (
                m.MAVLink_command_long_message(1, 1, 400, 0, 0, 21196, 0, 0, 0, 0, 0),
                m.MAVLink_command_long_message(1, 1, 176, 0, 1, 4, 6, 0, 0, 0, 0),
                m.MAVLink_command_int_message(1, 1, 0, 192, 0, 0, -1, 1, 0, 0, 473977420, 85455940, 500.0),
                m.MAVLink_set_mode_message(1, 157, 3 << 16),
                m.MAVLink_param_set_message(1, 1, b"MPC_XY_CRUISE", 1.0, 9),
                m.MAVLink_mission_clear_all_message(1, 1, 255),
                m.MAVLink_mission_count_message(1, 1, 3, 0),
                *(m.MAVLink_mission_count_message(1, 1, 2, kind) for kind in (0, 1, 2)),
                *(
                    m.MAVLink_mission_item_int_message(
                        1, 1, seq, 3, c, 0, 1, 1, 2, 3, 4, 473977420, 85455940, 5.0, kind
                    )
                    for seq, c, kind in ((0, 22, 0), (1, 16, 0), (0, 5001, 1), (1, 5004, 1), (0, 5100, 2))
                ),
                m.MAVLink_mission_item_message(1, 1, 0, 0, 16, 2, 1, 0, 0, 0, 0, 47.4, 8.5, 500.0),
                m.MAVLink_mission_set_current_message(1, 1, 1),
                *(m.MAVLink_command_long_message(1, 1, c, 0, *p) for c, p in COMMANDS),
                m.MAVLink_set_attitude_target_message(0, 1, 1, 0, [1, 0, 0, 0], 0, 0, 0, 0.6),
                m.MAVLink_set_position_target_global_int_message(
                    0, 1, 1, 5, 0x9F8, 473977420, 85455940, 490.0, 0, 0, 0, 0, 0, 0, 0, 0
                ),
                position(1, 2, -3),
            )
        ]
        self.kinds = [kind for _, kind in sorted(m.mavlink_map.items())]
        self.sender = m.MAVLink(None, srcSystem=255, srcComponent=190)

    def next(self) -> bytes:
        kind = self.random.randrange(4)
        if kind == 0:
            return self.random.randbytes(self.random.randrange(300))
        if kind == 1:  # damaged, so the checksum turns it away
            data = bytearray(self.random.choice(self.orders + self.requests))
            data[self.random.randrange(1, len(data))] ^= 1 << self.random.randrange(8)
            return bytes(data)
        if kind == 2:
            cls = self.random.choice(self.kinds)
            raw = self.random.randbytes(cls.unpacker.size)
            if cls.id in ASKS or cls.id in SETPOINTS or cls.id in PLANS:
                raw = addressed(cls, raw, 77)
            return self.whole(cls, raw)
        return self.spoilt(self.random.choice(self.requests))

    def order(self) -> bytes:
        """A whole packet for us that asks for a change, or nearly; now and then one that is left as it was."""
        if self.random.random() < 0.2:
            cls = self.random.choice(self.kinds)
            return self.whole(cls, addressed(cls, self.random.randbytes(cls.unpacker.size), 1))
        data = self.random.choice(self.orders)
        return data if self.random.random() < 0.2 else self.spoilt(data)

    def spoilt(self, data: bytes) -> bytes:
        """The same packet with one to three bytes of its payload changed, whole."""
        number = data[7] | data[8] << 8 | data[9] << 16
        cls = m.mavlink_map[number]
        raw = bytearray(data[10:-2].ljust(cls.unpacker.size, b"\0"))
        for _ in range(self.random.randrange(1, 4)):
            raw[self.random.randrange(len(raw))] = self.random.randrange(256)
        return self.whole(cls, bytes(raw))

    def whole(self, cls: Any, raw: bytes) -> bytes:
        """A packet that is all right, but for what it says."""
        self.sender.seq = self.random.randrange(256)
        packed: bytes = m.MAVLink_message(cls.id, cls.msgname)._pack(self.sender, cls.crc_extra, raw)
        return packed


SETPOINTS = {
    m.MAVLINK_MSG_ID_SET_POSITION_TARGET_LOCAL_NED,
    m.MAVLINK_MSG_ID_SET_POSITION_TARGET_GLOBAL_INT,
    m.MAVLINK_MSG_ID_SET_ATTITUDE_TARGET,
}
PLANS = {
    m.MAVLINK_MSG_ID_MISSION_COUNT,
    m.MAVLINK_MSG_ID_MISSION_CLEAR_ALL,
    m.MAVLINK_MSG_ID_MISSION_ITEM,
    m.MAVLINK_MSG_ID_MISSION_ITEM_INT,
    m.MAVLINK_MSG_ID_MISSION_SET_CURRENT,
    m.MAVLINK_MSG_ID_MISSION_WRITE_PARTIAL_LIST,
    m.MAVLINK_MSG_ID_SET_HOME_POSITION,
    m.MAVLINK_MSG_ID_SET_GPS_GLOBAL_ORIGIN,
    m.MAVLINK_MSG_ID_REQUEST_DATA_STREAM,
    m.MAVLINK_MSG_ID_PARAM_EXT_SET,
    m.MAVLINK_MSG_ID_MANUAL_CONTROL,
    m.MAVLINK_MSG_ID_RC_CHANNELS_OVERRIDE,
}


def addressed(cls: Any, raw: bytes, system: int) -> bytes:
    """The same message for a system and its autopilot."""
    out = bytearray(raw)
    sizes = {"char": 1, "uint8_t": 1, "int8_t": 1, "uint16_t": 2, "int16_t": 2, "uint32_t": 4, "int32_t": 4}
    sizes |= {"float": 4, "double": 8, "uint64_t": 8, "int64_t": 8}
    types = dict(zip(cls.fieldnames, cls.fieldtypes, strict=True))
    at = 0
    for i, name in enumerate(cls.ordered_fieldnames):
        if name in ("target_system", "target"):  # MANUAL_CONTROL calls it target
            out[at] = system
        if name == "target_component":
            out[at] = 1
        at += sizes[types[name]] * max(1, cls.array_lengths[i])
    return bytes(out)


def state(pilot: Pilot) -> tuple[Any, ...]:
    """Everything that a valid packet would have to ask for."""
    flying = pilot.vehicle.flying
    parameters = pilot.vehicle.parameters
    return (
        *(flying.mode, flying.intended, flying.armed, flying.failsafe, flying.airborne, flying.landing),
        tuple(parameters[name] for name in parameters),
        None if flying.home is None else (*flying.home.position_n, flying.home.yaw),
    )


def flooded(pilot: Pilot, flood: "Flood", ticks: int, each: Callable[[], bytes], keep: Callable[[], bytes]) -> None:
    """Run the vehicle under `EACH` datagrams a tick and hold what they leave behind against the bounds."""
    vehicle, now_us, blocks = pilot.vehicle, pilot.now_us, 0
    try:
        for tick in range(ticks):
            peers = ("127.0.0.1", flood.random.randrange(1, 65_536)), ("127.0.0.1", 9)
            inputs = [Datagram("onboard", each(), flood.random.choice(peers)) for _ in range(EACH)]
            if tick % 10 == 0:
                inputs.append(Datagram("onboard", keep(), ("127.0.0.1", 9)))
            vehicle.step(now_us, inputs)
            now_us += vehicle.TICK_US
            if tick == ticks // 2:
                gc.collect()
                blocks = sys.getallocatedblocks()
            if tick == ticks * 9 // 10:
                tracemalloc.start()  # it makes everything five times slower
        gc.collect()
        assert tracemalloc.get_traced_memory()[0] < GROWTH
    finally:
        tracemalloc.stop()
    assert sys.getallocatedblocks() - blocks < BLOCKS
    pilot.now_us = now_us
    pilot.send(m.MAVLink_ping_message(1, 2, 0, 0))
    assert [g for g in pilot.tick() if g.get_type() == "PING"]  # it still answers


def vehicle_with_a_log(autopilot: Autopilot) -> Vehicle:
    config = VehicleConfig(links=(LinkConfig("onboard"),), autopilot=autopilot)
    return Vehicle(config, files=MemoryFiles({"a.mcap": bytes(60_000)}))


@pytest.mark.slow
def test_200_000_datagrams_change_nothing_and_leave_nothing_behind() -> None:
    """Of the whole vehicle, in PX4's flavour, in Offboard: it stays where it is."""
    pilot = Pilot(vehicle_with_a_log("px4"))
    pilot.run(9.0)
    pilot.send(position(0, 0, -3))
    assert (pilot.command(176, 1, 6), pilot.command(400, 1)) == (0, 0)
    pilot.fly(9.0, position(0, 0, -3))
    before, flood = state(pilot), Flood(pilot, 1)
    place_n = pilot.vehicle.truth.position_n
    assert before[4]  # airborne
    flooded(pilot, flood, TICKS, flood.next, lambda: pilot.bytes_of(position(0, 0, -3)))
    assert state(pilot) == before
    assert abs(pilot.vehicle.truth.position_n - place_n).max() < 1.0
    counters = pilot.vehicle.counters
    assert counters.packets > TICKS * EACH // 4
    assert counters.bad_crc > TICKS * EACH // 8


@pytest.mark.soak
@pytest.mark.slow
def test_as_many_change_as_little_in_ardupilots_flavour() -> None:
    """The same in Guided."""
    pilot = Pilot(vehicle_with_a_log("ardupilot"))
    pilot.run(9.0)
    assert (pilot.command(176, 1, 4), pilot.command(400, 1), pilot.command(22, 0, 0, 0, 0, 0, 0, 5)) == (0, 0, 0)
    pilot.run(9.0)
    before, flood = state(pilot), Flood(pilot, 3)
    place_n = pilot.vehicle.truth.position_n
    assert before[4]  # airborne
    flooded(pilot, flood, TICKS, flood.next, lambda: pilot.bytes_of(m.MAVLink_ping_message(1, 2, 0, 0)))
    assert state(pilot) == before
    assert abs(pilot.vehicle.truth.position_n - place_n).max() < 1.0
    counters = pilot.vehicle.counters
    assert counters.packets > TICKS * EACH // 4
    assert counters.bad_crc > TICKS * EACH // 8


@pytest.mark.slow
@pytest.mark.parametrize("autopilot", ["px4", "ardupilot"])
def test_orders_spoilt_in_a_field_are_answered_or_refused_but_never_fatal(
    monkeypatch: pytest.MonkeyPatch, autopilot: Autopilot
) -> None:
    """Whole, for us, and asking for changes: whatever they do, the vehicle lives, answers and does not grow."""
    monkeypatch.setattr(fakevehicle.vehicle, "FlightStack", PointMass)
    pilot = Pilot(vehicle_with_a_log(autopilot))
    pilot.run(1.0)
    flood = Flood(pilot, 2)
    flooded(pilot, flood, 1_500, flood.order, lambda: pilot.bytes_of(position(0, 0, -3)))
    assert pilot.vehicle.counters.rejected_commands > 100
    if autopilot == "px4":  # whose parameter is among the orders
        assert pilot.vehicle.parameters.version > 50
