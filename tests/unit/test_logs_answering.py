"""A replay answers what a ground station asks for, from what the recording holds; checked with pymavlink's decoder."""

import math
import struct
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from logs_traffic import TLOG, heartbeat

from companion.cli.replay import answers_from
from logs import Attachment, Recording
from logs.answering import REFUSAL, Answering
from logs.recorder import Recorder
from wire.dialect import mavlink as m

ASKER = ("127.0.0.1", 14550)


def pack(message: Any, system: int = 1, component: int = 1) -> bytes:
    return bytes(message.pack(m.MAVLink(None, srcSystem=system, srcComponent=component)))


def parameter(name: bytes, value: float, index: int, count: int = 900, kind: int = 9) -> Any:
    return m.MAVLink_param_value_message(name, value, kind, count, index)


def item(seq: int, x: int) -> Any:
    return m.MAVLink_mission_item_int_message(1, 1, seq, 6, 16, 0, 1, 0.5, 0, 0, math.nan, x, -x, 12.5, 0)


def signalling() -> bytes:
    """A PARAM_VALUE whose float holds the bytes of an integer, which no float arithmetic may touch."""
    mav = m.MAVLink(None, srcSystem=1, srcComponent=1)
    whole = bytearray(parameter(b"SYS_BYTES", 1.0, 7, kind=6).pack(mav))
    whole[10:14] = bytes.fromhex("0100a07f")
    crc = m.x25crc(bytes(whole[1:-2]))
    crc.accumulate(bytes((m.MAVLink_param_value_message.crc_extra,)))
    whole[-2:] = crc.crc.to_bytes(2, "little")
    return bytes(whole)


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Recording:
    path = tmp_path_factory.mktemp("recording") / "flight.mcap"
    traffic: list[tuple[str, str, bytes]] = [
        ("autopilot", "rx", heartbeat()),
        ("autopilot", "rx", pack(parameter(b"MPC_XY_VEL_MAX", 12.0, 31))),
        ("autopilot", "rx", pack(parameter(b"_HASH_CHECK", 1.5, 0xFFFF))),
        ("autopilot", "rx", pack(parameter(b"BAT_LOW_THR", 0.1, 4))),
        ("autopilot", "rx", signalling()),
        ("autopilot", "rx", pack(parameter(b"MPC_XY_VEL_MAX", 8.0, 0xFFFF))),  # read by name: it has no index then
        ("autopilot", "tx", pack(m.MAVLink_mission_count_message(1, 1, 2), 1, 191)),
        ("autopilot", "tx", pack(item(0, 111), 1, 191)),
        ("autopilot", "tx", pack(item(1, 222), 1, 191)),
        ("autopilot", "rx", pack(m.MAVLink_mission_count_message(255, 190, 3))),
        ("autopilot", "rx", pack(item(0, 999))),  # broken off: not the mission
        ("gcs", "rx", pack(parameter(b"NOT_THE_VEHICLES", 1.0, 0), 255, 190)),
        ("autopilot", "rx", pack(m.MAVLink_home_position_message(1, 2, 3, 0, 0, 0, [1, 0, 0, 0], 0, 0, 0))),
    ]
    with Recorder(path, metadata={}, threaded=False) as recorder:
        for tick, (link, direction, data) in enumerate(traffic):
            assert direction in ("rx", "tx")
            recorder.datagram(link, direction, data, log_time_ns=tick, now_us=tick, tick=tick)  # type: ignore[arg-type]
    return Recording.open(path)


@pytest.fixture
def answering(recording: Recording) -> Answering:
    return Answering(recording.messages(), "autopilot")


def ask(answering: Answering, *questions: Any, at_us: int = 0) -> list[Any]:
    """What a ground station hears in answer, decoded."""
    for question in questions:
        answering.receive(pack(question, 255, 190), ASKER, at_us)
    return [message for _, message in heard(answering)]


def heard(answering: Answering) -> Iterator[tuple[bytes, Any]]:
    decoder = m.MAVLink(None)
    now_us = 0
    while answering.pending:
        for data, peer in answering.take(now_us):
            assert peer == ASKER
            message = decoder.decode(bytearray(data))
            assert (message.get_srcSystem(), message.get_srcComponent()) == (1, 1)
            yield data, message
        now_us += 10_000


def test_the_list_holds_every_parameter_once_in_its_order_and_numbered_without_gaps(answering: Answering) -> None:
    found = ask(answering, m.MAVLink_param_request_list_message(1, 1))
    assert [(p.param_id, p.param_index, p.param_count) for p in found] == [
        ("BAT_LOW_THR", 0, 3),
        ("SYS_BYTES", 1, 3),
        ("MPC_XY_VEL_MAX", 2, 3),
    ]
    assert found[0].param_value == pytest.approx(0.1)
    assert found[2].param_value == 8.0  # the last that was told


def test_an_integer_in_the_bytes_of_a_float_arrives_bit_for_bit(answering: Answering) -> None:
    answering.receive(pack(m.MAVLink_param_request_read_message(1, 1, b"SYS_BYTES", -1), 255, 190), ASKER, 0)
    [(data, message)] = heard(answering)
    assert data[10:14] == bytes.fromhex("0100a07f")
    assert message.param_type == 6


def test_a_parameter_is_read_by_number_too_and_an_unknown_one_is_not_made_up(answering: Answering) -> None:
    assert ask(answering, m.MAVLink_param_request_read_message(1, 0, b"", 0))[0].param_id == "BAT_LOW_THR"
    assert ask(answering, m.MAVLink_param_request_read_message(1, 1, b"NO_SUCH", -1)) == []
    assert ask(answering, m.MAVLink_param_request_read_message(1, 1, b"", 3)) == []
    assert ask(answering, m.MAVLink_param_request_list_message(7, 1)) == []


def test_setting_a_parameter_is_answered_with_what_it_was(answering: Answering) -> None:
    [found] = ask(answering, m.MAVLink_param_set_message(1, 1, b"BAT_LOW_THR", 0.9, 9))
    assert found.param_value == pytest.approx(0.1)


ATTACHED = b"""# Onboard parameters
1\t1\tBAT_LOW_THR\t0.9\t9
1\t1\tCOM_ALTITUDE\t2.5\t9
1\t1\tMAV_TOO_MUCH\t1e300\t9
1\t1\tSYS_AUTOSTART\t4001\t6
1\t1\tSYS_NEGATIVE\t-2\t2
1\t1\tTOO_LONG_A_NAME_FOR_ONE\t1\t6
1\t1\t_HASH_CHECK\t17\t5
7\t1\tOF_NOBODY_HEARD\t1.0\t9
"""


def test_what_was_not_told_on_the_wire_comes_from_the_attached_file(recording: Recording) -> None:
    found = ask(Answering(recording.messages(), "autopilot", (), ATTACHED), m.MAVLink_param_request_list_message(1, 1))
    assert [(p.param_id, p.param_index, p.param_count, p.param_type) for p in found] == [
        ("BAT_LOW_THR", 0, 6, 9),
        ("SYS_BYTES", 1, 6, 6),
        ("MPC_XY_VEL_MAX", 2, 6, 9),
        ("COM_ALTITUDE", 3, 6, 9),
        ("SYS_AUTOSTART", 4, 6, 6),
        ("SYS_NEGATIVE", 5, 6, 2),
    ]
    values = [p.param_value for p in found]
    assert values[0] == pytest.approx(0.1)  # what was heard wins
    assert values[3] == 2.5
    assert struct.pack("<f", values[4]) == (4001).to_bytes(4, "little")
    assert struct.pack("<f", values[5])[0] == 0xFE


@pytest.mark.parametrize(("autopilot", "sent"), [(12, struct.pack("<i", 7)), (3, struct.pack("<f", 7.0))])
def test_an_attached_integer_is_told_as_its_autopilot_packs_it(tmp_path: Path, autopilot: int, sent: bytes) -> None:
    file = Attachment("vehicle.params", "text/plain", b"1\t1\tRTL_TYPE\t7\t6\n")
    with Recorder(tmp_path / "a.mcap", metadata={}, attachments=[file], threaded=False) as recorder:
        recorder.datagram("autopilot", "rx", heartbeat(1, 1, autopilot), log_time_ns=0, now_us=0, tick=0)
    answering = answers_from(Recording.open(tmp_path / "a.mcap"), "autopilot")
    [found] = ask(answering, m.MAVLink_param_request_list_message(1, 1))
    assert (found.param_id, struct.pack("<f", found.param_value), found.param_type) == ("RTL_TYPE", sent, 6)


def test_the_mission_is_the_last_that_crossed_the_wire_whole(answering: Answering) -> None:
    [count] = ask(answering, m.MAVLink_mission_request_list_message(1, 1))
    assert (count.count, count.mission_type, count.target_system, count.target_component) == (2, 0, 255, 190)
    first, second = ask(
        answering,
        m.MAVLink_mission_request_int_message(1, 1, 0),
        m.MAVLink_mission_request_message(1, 1, 1),
    )
    assert (first.seq, first.x, first.y, first.z, first.target_system) == (0, 111, -111, 12.5, 255)
    assert math.isnan(first.param4)
    assert (second.seq, second.x, second.get_type()) == (1, 222, "MISSION_ITEM_INT")
    [none] = ask(answering, m.MAVLink_mission_request_list_message(1, 1, m.MAV_MISSION_TYPE_FENCE))
    assert (none.count, none.mission_type) == (0, 1)


def test_a_mission_handed_over_is_told_where_none_crossed_the_wire(recording: Recording) -> None:
    only = [message for message in recording.messages() if message.channel.direction == "rx"]
    answering = Answering(only, "autopilot", [item(0, 5)])
    [found] = ask(answering, m.MAVLink_mission_request_int_message(1, 1, 0))
    assert found.x == 5


def test_a_mission_that_was_cleared_later_is_not_told(recording: Recording) -> None:
    with_no_item = pack(m.MAVLink_mission_count_message(1, 1, 0), 1, 191)
    *_, last = recording.messages()
    sent = next(message.channel for message in recording.messages() if message.channel.direction == "tx")
    cleared = [*recording.messages(), replace(last, channel=sent, data=with_no_item)]
    [count] = ask(Answering(cleared, "autopilot"), m.MAVLink_mission_request_list_message(1, 1))
    assert count.count == 0


def test_who_is_no_autopilot_does_not_answer_in_its_place(recording: Recording) -> None:
    first, *_ = recording.messages()
    radio = replace(first, data=pack(m.MAVLink_heartbeat_message(6, m.MAV_AUTOPILOT_INVALID, 0, 0, 4, 3), 51, 1))
    everything = Answering([radio, *recording.messages()], "autopilot")
    everybody = m.MAVLink_param_request_read_message(0, 0, b"BAT_LOW_THR", -1)
    assert [found.param_id for found in ask(everything, everybody)] == ["BAT_LOW_THR"]


@pytest.mark.parametrize("number", [math.inf, -math.inf, math.nan, -1.0, 242.5, 3e38])
def test_a_message_whose_number_is_none_is_denied(answering: Answering, number: float) -> None:
    [ack, *_] = ask(answering, command(m.MAV_CMD_REQUEST_MESSAGE, number))
    assert ack.result == m.MAV_RESULT_DENIED


def test_a_message_asked_for_is_the_last_that_was_sent_of_it(answering: Answering) -> None:
    ack, home = ask(answering, command(m.MAV_CMD_REQUEST_MESSAGE, m.MAVLINK_MSG_ID_HOME_POSITION))
    assert (ack.command, ack.result, ack.target_system) == (512, m.MAV_RESULT_ACCEPTED, 255)
    assert (home.latitude, home.longitude, home.altitude) == (1, 2, 3)


def test_a_recorded_setup_signing_is_given_to_nobody(recording: Recording) -> None:
    first, *_ = recording.messages()
    signing = replace(first, data=pack(m.MAVLink_setup_signing_message(1, 1, [7] * 32, 1)))
    answering = Answering([*recording.messages(), signing], "autopilot")
    [beat] = ask(answering, command(m.MAV_CMD_REQUEST_MESSAGE, m.MAVLINK_MSG_ID_HEARTBEAT))[1:]
    assert beat.get_type() == "HEARTBEAT"
    ack, *more = ask(answering, command(m.MAV_CMD_REQUEST_MESSAGE, m.MAVLINK_MSG_ID_SETUP_SIGNING))
    assert ack.result == m.MAV_RESULT_DENIED
    assert [message.get_type() for message in more] == ["STATUSTEXT"]


def command(number: int, first: float = 0.0) -> Any:
    return m.MAVLink_command_long_message(1, 1, number, 0, first, 0, 0, 0, 0, 0, 0)


def test_everything_else_is_denied_with_a_reason_told_once_a_second(answering: Answering) -> None:
    arm, upload = command(m.MAV_CMD_COMPONENT_ARM_DISARM, 1), m.MAVLink_mission_count_message(1, 1, 4)
    found = ask(answering, arm, upload, m.MAVLink_mission_clear_all_message(1, 1))
    assert [message.get_type() for message in found] == ["COMMAND_ACK", "STATUSTEXT", "MISSION_ACK", "MISSION_ACK"]
    assert [found[0].result, found[2].type, found[3].type] == [m.MAV_RESULT_DENIED] + [m.MAV_MISSION_DENIED] * 2
    assert found[1].text == REFUSAL
    again = ask(answering, arm, at_us=2_000_000)
    assert [message.get_type() for message in again] == ["COMMAND_ACK", "STATUSTEXT"]


def test_who_asks_for_files_is_told_that_there_is_none(answering: Answering) -> None:
    request = struct.pack("<HBBBBBxI", 41, 0, 4, 3, 0, 0, 0) + b"@PARAM/param.pck"
    [found] = ask(answering, m.MAVLink_file_transfer_protocol_message(0, 1, 1, request.ljust(251, b"\0")))
    sequence, _, opcode, size, asked = struct.unpack("<HBBBB", bytes(found.payload[:6]))
    assert (sequence, opcode, size, asked, found.payload[12]) == (42, 129, 1, 4, 10)


def test_a_flood_of_questions_is_heard_so_far_and_answered_in_small_bursts(answering: Answering) -> None:
    question = pack(m.MAVLink_param_request_list_message(1, 1), 255, 190)
    for _ in range(10_000):
        answering.receive(question, ASKER, 0)
    assert len(answering.take(0)) == 8
    assert answering.take(1_000) == []
    assert sum(1 for _ in heard(answering)) <= 20_010


def test_bytes_that_are_no_question_are_passed_over(answering: Answering) -> None:
    for data in (b"", b"\xfd", TLOG.read_bytes()[:5000], pack(m.MAVLink_mission_request_int_message(1, 1, 9))[:-1]):
        answering.receive(data, ASKER, 0)
    assert not answering.pending
