"""Whatever arrives, the vehicle neither raises nor forgets itself; and its outputs depend on its inputs only."""

from typing import Any

import numpy as np
import pytest
from flight_double import PointMass
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from vehicle_pilot import Pilot, position

import fakevehicle.vehicle
from fakevehicle.config import LinkConfig, VehicleConfig
from fakevehicle.vehicle import Vehicle
from wire.datagram import Datagram
from wire.dialect import mavlink
from wire.framing import Framer

PEER = ("127.0.0.1", 9)
SETTINGS = settings(max_examples=40, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
KINDS = sorted(mavlink.mavlink_map)


@pytest.fixture
def pilot(monkeypatch: pytest.MonkeyPatch) -> Pilot:
    """A flying vehicle with a stream of setpoints in OFFBOARD."""
    monkeypatch.setattr(fakevehicle.vehicle, "FlightStack", PointMass)
    return flying()


def flying() -> Pilot:
    pilot = Pilot(Vehicle(VehicleConfig(links=(LinkConfig("onboard"),))))
    pilot.run(1.0)
    pilot.send(position(0, 0, -3))
    assert (pilot.command(176, 1, 6), pilot.command(400, 1)) == (0, 0)
    pilot.fly(3.0, position(0, 0, -3))
    return pilot


def state(pilot: Pilot) -> tuple[Any, ...]:
    flying = pilot.vehicle.flying
    return (flying.mode, flying.intended, flying.armed, flying.failsafe, flying.airborne, flying.landing)


@SETTINGS
@given(data=st.binary(max_size=600))
def test_bytes_that_are_no_packet_change_nothing(pilot: Pilot, data: bytes) -> None:
    if Framer().packets(data):
        return
    before, parameters = state(pilot), pilot.vehicle.parameters.version
    pilot.send_raw(data)
    heard = pilot.tick()
    assert state(pilot) == before
    assert pilot.vehicle.parameters.version == parameters
    assert not [g for g in heard if g.get_type() in ("COMMAND_ACK", "PARAM_VALUE", "STATUSTEXT")]


@SETTINGS
@given(data=st.data())
def test_a_damaged_packet_changes_nothing(pilot: Pilot, data: st.DataObject) -> None:
    """A flipped bit anywhere but in the start byte is caught by the checksum; a lost start byte is no packet."""
    number = data.draw(st.sampled_from((400, 21, 176, 20)))
    good = bytearray(pilot.bytes_of(mavlink.MAVLink_command_long_message(1, 1, number, 0, 0, 21196, 3, 0, 0, 0, 0)))
    place = data.draw(st.integers(0, len(good) - 1))
    good[place] ^= 1 << data.draw(st.integers(0, 7))
    before = state(pilot)
    pilot.send(position(0, 0, -3))
    pilot.send_raw(bytes(good))
    pilot.tick()
    assert state(pilot) == before


@SETTINGS
@given(
    kind=st.sampled_from(KINDS),
    payload=st.binary(min_size=255, max_size=255),
    system=st.integers(0, 255),
    targets=st.sampled_from(((1, 1), (0, 0), None)),
)
def test_any_message_with_any_payload_is_survived(
    pilot: Pilot, kind: int, payload: bytes, system: int, targets: tuple[int, int] | None
) -> None:
    cls = mavlink.mavlink_map[kind]
    raw = bytearray(payload[: cls.unpacker.size])
    if targets is not None:  # most random payloads are for somebody else
        for name, value in zip(("target_system", "target_component"), targets, strict=True):
            if name in cls.ordered_fieldnames:
                raw[_offset(cls, name)] = value
    sender = mavlink.MAVLink(None, srcSystem=system, srcComponent=190)
    message = mavlink.MAVLink_message(kind, cls.msgname)
    pilot.send_raw(message._pack(sender, cls.crc_extra, bytes(raw)))
    pilot.tick()
    pilot.send(mavlink.MAVLink_ping_message(1, 2, 0, 0))
    assert [g for g in pilot.tick() if g.get_type() == "PING"]  # it still answers


def _offset(cls: Any, name: str) -> int:
    """Byte offset of a one-byte field in the payload."""
    sizes = {"char": 1, "uint8_t": 1, "int8_t": 1, "uint16_t": 2, "int16_t": 2, "uint32_t": 4, "int32_t": 4}
    sizes |= {"float": 4, "double": 8, "uint64_t": 8, "int64_t": 8}
    types = dict(zip(cls.fieldnames, cls.fieldtypes, strict=True))
    at = 0
    for i, field in enumerate(cls.ordered_fieldnames):
        if field == name:
            return at
        at += sizes[types[field]] * max(1, cls.array_lengths[i])
    raise AssertionError(name)


@settings(SETTINGS, max_examples=10)
@given(steps=st.lists(st.lists(st.sampled_from(("arm", "disarm", "hold", "land", "setpoint", "noise")), max_size=3)))
def test_two_vehicles_given_the_same_say_the_same(pilot: Pilot, steps: list[list[str]]) -> None:
    words = {
        "arm": mavlink.MAVLink_command_long_message(1, 1, 400, 0, 1, 0, 0, 0, 0, 0, 0),
        "disarm": mavlink.MAVLink_command_long_message(1, 1, 400, 0, 0, 0, 0, 0, 0, 0, 0),
        "hold": mavlink.MAVLink_command_long_message(1, 1, 176, 0, 1, 4, 3, 0, 0, 0, 0),
        "land": mavlink.MAVLink_command_long_message(1, 1, 21, 0, 0, 0, 0, 0, 0, 0, 0),
        "setpoint": position(1, 2, -3),
    }
    one, two, now_us = flying().vehicle, flying().vehicle, pilot.now_us
    for step in steps:
        data = [b"\xfd\x00noise" if word == "noise" else pilot.bytes_of(words[word]) for word in step]
        inputs = [Datagram("onboard", d, PEER) for d in data]
        for _ in range(5):
            assert one.step(now_us, inputs) == two.step(now_us, inputs)
            now_us += 4000
            inputs = []
    np.testing.assert_array_equal(one.truth.position_n, two.truth.position_n)
