"""Which ticks the vehicle's process waits for."""

from fakevehicle.config import LinkConfig, VehicleConfig
from fakevehicle.driver import TICKS_A_WAKE, Seat, _patience
from fakevehicle.vehicle import TICK_US, Vehicle
from wire.datagram import Datagram
from wire.dialect import mavlink

POSITION = mavlink.MAVLINK_MSG_ID_LOCAL_POSITION_NED


def asks(interval_us: float, kind: int = POSITION) -> Datagram:
    command = mavlink.MAV_CMD_SET_MESSAGE_INTERVAL
    message = mavlink.MAVLink_command_long_message(1, 1, command, 0, kind, interval_us, 0, 0, 0, 0, 0)
    return Datagram("onboard", bytes(message.pack(mavlink.MAVLink(None, 255, 190))), ("companion", 1))


def test_no_tick_in_which_a_position_is_told_waits_for_another():
    vehicle = Vehicle(VehicleConfig(links=(LinkConfig("onboard", "onboard"),)))
    seats, now_us, waited, told = [Seat(vehicle, {}, lambda now_us: None)], 0, [], 0
    while now_us < 8_000_000:
        patience = _patience(seats, now_us)
        waited.append(patience)
        for left in range(patience, -1, -1):
            inputs = [asks(20_000)] if now_us == 52_000 else []
            sent = vehicle.step(now_us, inputs)
            tells = any(d.data[7:10] == POSITION.to_bytes(3, "little") for d in sent)
            assert not (tells and left)
            told += tells
            now_us += TICK_US
    assert told > 50
    assert max(waited) == TICKS_A_WAKE - 1


def test_a_vehicle_that_is_asked_for_no_position_waits_no_longer_than_another():
    vehicle = Vehicle(VehicleConfig(links=(LinkConfig("onboard", "onboard"),)))
    vehicle.step(0, [asks(-1)])
    assert vehicle.position_due_us is None
    assert _patience([Seat(vehicle, {}, lambda now_us: None)], TICK_US) == TICKS_A_WAKE - 1


def test_streams_asked_for_one_after_another_are_told_in_one_tick():
    vehicle = Vehicle(VehicleConfig(links=(LinkConfig("onboard", "onboard"),)))
    attitude = mavlink.MAVLINK_MSG_ID_ATTITUDE
    asked, told = {52_000: asks(20_000), 164_000: asks(20_000, attitude)}, {POSITION: [], attitude: []}
    for now_us in range(0, 8_000_000, TICK_US):
        for datagram in vehicle.step(now_us, [asked[now_us]] if now_us in asked else []):
            told.get(int.from_bytes(datagram.data[7:10], "little"), []).append(now_us)
    assert len(told[POSITION]) > 50
    assert set(told[POSITION][10:]) <= set(told[attitude])
