"""What of a recording is wanted: by topic, message, sender, link and time."""

from pathlib import Path
from typing import Any

import pytest
from logs_traffic import heartbeat, record, record_captured

from logs import Recording, schema
from logs.errors import RecordingError
from logs.filter import filtered
from logs.recorder import Recorder
from logs.rows import plain, rows, shortest
from logs.selection import Selection, datagrams, nothing_left, selected
from wire.dialect import mavlink
from wire.framing import Framer


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Recording:
    path = tmp_path_factory.mktemp("recording") / "flight.mcap"
    with Recorder(path, metadata={}, threaded=False) as recorder:
        recorder.datagram("gcs", "rx", heartbeat(255, 190, 8), log_time_ns=0, now_us=0, tick=0)
        record_captured(recorder)
        record(recorder, schema.Note(6, "flying", "a note"), 3_000_000, 400)
    return Recording.open(path)


def found(recording: Recording, wanted: Selection) -> list[str]:
    return sorted({message.channel.topic for message in selected(recording.messages(), wanted)})


def test_nothing_asked_for_is_everything(recording: Recording) -> None:
    assert list(selected(recording.messages(), Selection())) == list(recording.messages())


def test_topics_are_patterns(recording: Recording) -> None:
    assert found(recording, Selection(topics=("/companion/*",))) == ["/companion/note", "/companion/tick"]
    assert found(recording, Selection(topics=("/mavlink/1/1/ATT*", "/mavlink/raw/gcs/rx"))) == [
        "/mavlink/1/1/ATTITUDE",
        "/mavlink/1/1/ATTITUDE_QUATERNION",
        "/mavlink/1/1/ATTITUDE_TARGET",
        "/mavlink/raw/gcs/rx",
    ]


def test_a_datagram_is_wanted_for_a_packet_in_it(recording: Recording) -> None:
    wanted = Selection(names=("ATTITUDE",), systems=(1,))
    raw = [m for m in selected(recording.messages(), wanted) if m.channel.direction]
    decoded = [m for m in selected(recording.messages(), wanted) if not m.channel.direction]
    assert len(raw) == len(decoded) > 50
    packets = [packet for message in raw for packet in Framer().packets(message.data)]
    assert {packet.message_id for packet in packets} == {mavlink.MAVLINK_MSG_ID_ATTITUDE}
    assert found(recording, Selection(systems=(255,)))[-1] == "/mavlink/raw/gcs/rx"
    assert found(recording, Selection(links=("gcs",))) == ["/mavlink/raw/gcs/rx"]
    assert found(recording, Selection(names=("Note",))) == ["/companion/note"]


def test_a_stretch_of_time_counts_from_the_first_message(recording: Recording) -> None:
    times = [m.log_time_ns for m in selected(recording.messages(), Selection(start_s=1.0, duration_s=0.5))]
    assert min(times) >= 1_000_000_000
    assert max(times) <= 1_500_000_000
    assert len(times) == sum(1_000_000_000 <= m.log_time_ns <= 1_500_000_000 for m in recording.messages())


@pytest.mark.parametrize("wanted", [{"start_s": -1.0}, {"start_s": float("nan")}, {"duration_s": 0.0}])
def test_a_time_that_is_none_is_refused(wanted: dict[str, float]) -> None:
    with pytest.raises(ValueError, match="expected a time in seconds"):
        Selection(**wanted)  # type: ignore[arg-type]


def test_decoded_values_are_those_of_pymavlink(recording: Recording) -> None:
    decoder = mavlink.MAVLink(None)
    packets: dict[tuple[int, str, int], list[dict[str, Any]]] = {}
    for message in recording.messages():
        for packet in Framer().packets(message.data) if message.channel.direction else ():
            decoded = decoder.decode(bytearray(packet.raw))
            values = {name: getattr(decoded, name) for name in decoded.fieldnames}
            packets.setdefault((message.tick, decoded.get_type(), packet.system_id), []).append(values)
    count = 0
    for row in rows(recording, recording.messages()):
        if row.system is not None:
            expected = [
                {name: _near(value) for name, value in values.items()}
                for values in packets[row.tick, row.name, row.system]
            ]
            assert row.values in expected
            count += 1
    assert count > 1000


def _near(value: Any) -> Any:
    return pytest.approx(value, rel=1e-7, nan_ok=True) if isinstance(value, float | list) else value


def test_a_32_bit_float_is_told_in_as_few_digits_as_it_needs() -> None:
    import numpy as np

    assert shortest(float(np.float32(0.1))) == 0.1
    generator = np.random.default_rng(1)
    for value in generator.integers(0, 2**32, 2000, dtype=np.uint32).view(np.float32):
        told = shortest(float(value))
        assert np.float32(told) == value or value != value
        if np.isfinite(value) and abs(value) > 1e-37:
            assert told == float(str(value))


def test_a_note_is_a_dictionary() -> None:
    message = schema._MESSAGES[schema.Note](level=4, phase="flying", text="x")
    assert plain(message) == {"level": 4, "phase": "flying", "text": "x"}


def test_a_name_may_be_written_in_small_letters(recording: Recording) -> None:
    assert found(recording, Selection(names=("attitude", "note"))) == found(
        recording, Selection(names=("ATTITUDE", "Note"))
    )


def test_a_topic_of_decoded_packets_names_the_datagrams_they_came_in(recording: Recording) -> None:
    named = list(datagrams(recording.messages(), Selection(topics=("/mavlink/1/1/ATTITUDE",))))
    assert named == [
        message
        for message in selected(recording.messages(), Selection(names=("ATTITUDE",), systems=(1,)))
        if message.channel.direction
    ]
    raw = list(datagrams(recording.messages(), Selection(topics=("/mavlink/raw/gcs/*",))))
    assert {message.channel.topic for message in raw} == {"/mavlink/raw/gcs/rx"}


@pytest.mark.parametrize(
    ("wanted", "told"),
    [
        (Selection(names=("ATITUDE",)), r"it holds no ATITUDE \(did you mean ATTITUDE\?\)"),
        (Selection(topics=("/nowhere/*",)), r"no topic is like '/nowhere/\*'"),
        (Selection(systems=(7,)), r"nothing is of system 7 \(systems: 1, 255\)"),
        (Selection(start_s=1e6), r"left of what is asked for$"),
    ],
)
def test_what_leaves_nothing_is_told_with_what_may_be_meant(recording: Recording, wanted: Selection, told: str) -> None:
    with pytest.raises(RecordingError, match=told):
        raise nothing_left(recording, wanted)


@pytest.mark.parametrize(
    ("wanted", "told"),
    [
        (Selection(names=("ATTITUDE",), start_s=1e6), r"left of what is asked for$"),
        (Selection(topics=("/mavlink/1/1/ATTITUDE",), start_s=1e6), r"left of what is asked for$"),
        (Selection(names=("ATITUDE",)), r"it holds no ATITUDE \(did you mean ATTITUDE\?\)"),
        (Selection(systems=(7,)), r"nothing is of system 7 \(systems: 1, 255\)"),
    ],
)
def test_of_a_recording_of_datagrams_alone_the_same_is_told(
    recording: Recording, wanted: Selection, told: str, tmp_path: Path
) -> None:
    filtered(recording, tmp_path / "raw.mcap", Selection(topics=("/mavlink/raw/*",)))
    with pytest.raises(RecordingError, match=told):
        raise nothing_left(Recording.open(tmp_path / "raw.mcap"), wanted)
