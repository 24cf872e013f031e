"""No request is left without an answer: every message of the dialect that asks an autopilot for something gets one."""

from typing import Any

import pytest
from flight_double import PointMass
from vehicle_pilot import Pilot

import fakevehicle.vehicle
from fakevehicle.config import Autopilot, LinkConfig, VehicleConfig
from fakevehicle.vehicle import Vehicle
from wire.dialect import mavlink as m

NEEDS_NONE = {
    # Reports, streams of data for other devices, and answers: nobody waits for a reply to them.
    *("COMMAND_ACK", "MISSION_ACK", "PARAM_ERROR", "PARAM_EXT_ACK", "LOGGING_ACK", "LOGGING_DATA"),
    *("LOGGING_DATA_ACKED", "GPS_INJECT_DATA", "MOUNT_STATUS", "CAMERA_STATUS", "CAMERA_FEEDBACK", "GIMBAL_REPORT"),
    *("REMOTE_LOG_DATA_BLOCK", "REMOTE_LOG_BLOCK_STATUS", "GIMBAL_TORQUE_CMD_REPORT", "V2_EXTENSION", "TUNNEL"),
    *("GIMBAL_DEVICE_SET_ATTITUDE", "GIMBAL_DEVICE_ATTITUDE_STATUS", "AUTOPILOT_STATE_FOR_GIMBAL_DEVICE"),
    *("CAN_FRAME", "CANFD_FRAME", "CAN_FILTER_MODIFY", "GLOBAL_POSITION_SENSOR", "RADIO_RC_CHANNELS", "HEARTBEAT"),
    *("LOG_REQUEST_END", "CUBEPILOT_FIRMWARE_UPDATE_START", "CUBEPILOT_FIRMWARE_UPDATE_RESP"),
    "TERRAIN_REQUEST",  # from the vehicle to its ground station
    "PING",  # addressed to somebody it is an answer; tests/unit/test_vehicle_protocol.py asks with it
}
ACCEPTED_SILENTLY = {"SET_POSITION_TARGET_LOCAL_NED", "SET_POSITION_TARGET_GLOBAL_INT", "SET_ATTITUDE_TARGET"}
"""Setpoints: a good one is flown, and only a bad one is talked about."""

AS_THERE = {"px4": set(), "ardupilot": {"SET_MODE", "REQUEST_DATA_STREAM"}}
"""ArduCopter tells the mode by its next HEARTBEAT, and ends streams without a word: so does the flavour."""


def asks() -> list[Any]:
    """Messages that are for an autopilot, or are called requests."""
    ours = [kind for number, kind in sorted(m.mavlink_map.items()) if number < 500]
    found = [kind for kind in ours if "target_system" in kind.fieldnames or "REQUEST" in kind.msgname]
    return [kind for kind in found if kind.msgname not in NEEDS_NONE | ACCEPTED_SILENTLY]


def blank(kind: Any) -> bytes:
    """All fields zero but the target, so 1/1."""
    sender = m.MAVLink(None, srcSystem=255, srcComponent=190)
    flat = []
    for name, type_ in zip(kind.ordered_fieldnames, _wire_types(kind), strict=True):
        length = dict(zip(kind.ordered_fieldnames, kind.array_lengths, strict=True))[name]
        value: Any = 1 if name in ("target_system", "target_component") else 0
        flat += [b""] if type_ == "char" else [value] * max(1, length)
    message = m.MAVLink_message(kind.id, kind.msgname)
    packed: bytes = message._pack(sender, kind.crc_extra, kind.unpacker.pack(*flat))
    return packed


def _wire_types(kind: Any) -> list[str]:
    types = dict(zip(kind.fieldnames, kind.fieldtypes, strict=True))
    return [types[name] for name in kind.ordered_fieldnames]


@pytest.mark.parametrize("autopilot", ["px4", "ardupilot"])
def test_every_request_of_the_dialect_gets_an_answer_within_a_tick_or_two(
    monkeypatch: pytest.MonkeyPatch, autopilot: Autopilot
) -> None:
    monkeypatch.setattr(fakevehicle.vehicle, "FlightStack", PointMass)
    silent: set[str] = set()
    for kind in asks():
        pilot = Pilot(Vehicle(VehicleConfig(links=(LinkConfig("onboard", "gcs"),), autopilot=autopilot)))
        pilot.tick(3)
        usual = {g.get_type() for g in pilot.tick(50)} - {"STATUSTEXT"}
        pilot.send_raw(blank(kind))
        if not [g for g in pilot.tick(3) if g.get_type() not in usual or g.get_type() == "PING"]:
            silent.add(kind.msgname)
    assert silent == AS_THERE[autopilot]


@pytest.fixture
def pilot(monkeypatch: pytest.MonkeyPatch) -> Pilot:
    monkeypatch.setattr(fakevehicle.vehicle, "FlightStack", PointMass)
    pilot = Pilot(Vehicle(VehicleConfig(links=(LinkConfig("onboard"),))))
    pilot.run(1.0)
    return pilot


def refusals(pilot: Pilot, of: str) -> int:
    return len([text for text in pilot.texts() if of in text])


def test_what_clients_send_over_and_over_is_refused_in_words_once_a_minute(pilot: Pilot) -> None:
    for count in (1, 1, 2):
        pilot.send(m.MAVLink_request_data_stream_message(1, 1, 0, 4, 1))
        pilot.run(30.5)
        assert refusals(pilot, "REQUEST_DATA_STREAM refused: ask for messages by MAV_CMD_SET_MESSAGE_INT") == count


ASKED = [
    (m.MAVLink_param_ext_request_read_message(1, 1, b"A", -1), "PARAM_EXT_REQUEST_READ refused"),
    (m.MAVLink_fence_fetch_point_message(1, 1, 0), "FENCE_FETCH_POINT refused"),
    (m.MAVLink_log_erase_message(1, 1), "Erasing logs refused"),
]


@pytest.mark.parametrize(("request_", "words"), ASKED)
def test_who_asks_again_later_is_told_again_and_so_is_everybody_else(pilot: Pilot, request_: Any, words: str) -> None:
    for count in (1, 1, 1, 2):
        pilot.send(request_)
        pilot.run(1.1)
        assert refusals(pilot, words) == count
    pilot.peer = ("127.0.0.1", 50_001)
    pilot.send(request_)
    pilot.tick()
    assert refusals(pilot, words) == 3


def test_a_reason_beside_an_answer_is_told_to_each_client(pilot: Pilot) -> None:
    for port, count in ((50_000, 1), (50_000, 1), (50_001, 2)):
        pilot.peer = ("127.0.0.1", port)
        pilot.send(m.MAVLink_mission_request_int_message(1, 1, 7, 0))
        pilot.run(1.0)
        assert refusals(pilot, "Plan refused: there is no item 7") == count


def test_the_height_of_the_terrain_is_told_to_be_unknown(pilot: Pilot) -> None:
    pilot.send(m.MAVLink_terrain_check_message(473_977_420, 85_455_940))
    pilot.tick()
    report = pilot.last("TERRAIN_REPORT")
    assert (report.lat, report.lon, report.spacing) == (473_977_420, 85_455_940, 0)


def test_old_requests_have_their_own_answers(pilot: Pilot) -> None:
    pilot.send(m.MAVLink_autopilot_version_request_message(1, 1))
    assert [g.get_type() for g in pilot.tick()].count("AUTOPILOT_VERSION") == 1
    pilot.send(m.MAVLink_param_ext_set_message(1, 1, b"A", b"1", 1))
    pilot.tick()
    assert pilot.last("PARAM_EXT_ACK").param_result == m.PARAM_ACK_FAILED
