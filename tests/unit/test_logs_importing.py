"""Logs of others as recordings: .tlog by our own reader, .ulg by pyulog, .BIN by pymavlink."""

import random
import struct
import sys
from pathlib import Path

import pytest
from logs_traffic import TLOG, captured, sent_by_ground

from logs import Recording, RecordingError
from logs.diff import diff
from logs.export.tlog import to_tlog
from logs.importing import import_log
from logs.rows import Row, rows
from logs.selection import Selection
from logs.wire_replay import paced, vehicle_link, vehicle_links, vehicle_traffic


def told(path: Path) -> dict[str, list[Row]]:
    """The rows of a recording by topic."""
    recording = Recording.open(path)
    assert recording.complete
    found: dict[str, list[Row]] = {}
    for row in rows(recording, recording.messages()):
        found.setdefault(row.topic, []).append(row)
    return found


def test_a_telemetry_log_becomes_a_recording_that_replays_and_goes_back_to_the_byte(tmp_path: Path) -> None:
    done = import_log(TLOG, tmp_path / "flight.mcap")
    recording = Recording.open(done.path)
    assert done.messages == len(list(captured()))
    assert recording.metadata["import"]["of"] == TLOG.name
    assert vehicle_link(recording) == "autopilot"
    replayed = [due.data for due in paced(vehicle_traffic(recording, "autopilot"))]
    assert replayed == [packet for _, packet in captured() if not sent_by_ground(packet)]
    to_tlog(recording, tmp_path / "back.tlog", Selection())
    assert (tmp_path / "back.tlog").read_bytes() == TLOG.read_bytes()
    assert diff(recording, recording).same


def test_an_import_is_not_put_before_parts_of_another_recording(tmp_path: Path) -> None:
    (tmp_path / "a.tlog").write_bytes(bytes(8))
    (tmp_path / "a.part0002.mcap").write_bytes(b"older")
    with pytest.raises(RecordingError, match=r"a\.mcap: a\.part0002\.mcap is there already"):
        import_log(tmp_path / "a.tlog", tmp_path / "a.mcap", force=True)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.part0002.mcap", "a.tlog"]


def test_a_damaged_telemetry_log_gives_every_whole_packet_and_says_what_is_in_none(tmp_path: Path) -> None:
    whole = TLOG.read_bytes()
    entries = [(time, packet) for time, packet in captured()]
    first = 8 + len(entries[0][1])
    source = tmp_path / "bad.tlog"
    source.write_bytes(whole[:first] + b"\xfd\xfe noise \xfd" * 5 + whole[first:-9])
    done = import_log(source, tmp_path / "flight.mcap")
    raw = [item.data for item in Recording.open(done.path).messages() if item.channel.direction]
    assert raw == [packet for _, packet in entries[:-1]]
    left = 8 + len(entries[-1][1]) - 9
    assert done.told == [f"{5 * 10 + left} bytes are in no packet"]


@pytest.mark.parametrize(
    ("name", "data", "reason"),
    [
        ("a.tlog", b"", "the file is empty"),
        ("a.tlog", b"x" * 3000, "no telemetry log"),
        ("a.ulg", b"x" * 300, "pyulog cannot read it"),
        ("a.bin", b"x" * 300, "no ArduPilot log"),
        ("a.BIN", b"\xa3\x95" + b"x" * 300, "there is nothing in it|cannot read it"),
        ("a.txt", b"", r"found the ending '.txt', expected .tlog, .ulg or .BIN"),
    ],
)
def test_what_is_no_log_is_refused_in_one_line_and_leaves_nothing(
    name: str, data: bytes, reason: str, tmp_path: Path
) -> None:
    if name.endswith("ulg"):
        pytest.importorskip("pyulog")
    (tmp_path / name).write_bytes(data)
    with pytest.raises(RecordingError, match=reason) as caught:
        import_log(tmp_path / name, tmp_path / "out.mcap")
    assert "\n" not in str(caught.value)
    assert [path.name for path in tmp_path.iterdir()] == [name]


def ulog() -> bytes:
    """A small PX4 log, by https://docs.px4.io/main/en/dev_log/ulog_file_format."""

    def message(kind: bytes, body: bytes) -> bytes:
        return struct.pack("<H", len(body)) + kind + body

    def keyed(kind: bytes, key: bytes, value: bytes) -> bytes:
        return message(kind, bytes((len(key),)) + key + value)

    def attitude(number: int, time_us: int, *q: float) -> bytes:
        return message(b"D", struct.pack("<HQ4fB", number, time_us, *q, 7))

    return b"".join(
        (
            b"ULog\x01\x12\x35\x01" + struct.pack("<Q", 1_000),
            message(b"B", bytes(40)),
            message(b"F", b"vehicle_attitude:uint64_t timestamp;float[4] q;uint8_t quat_reset_counter;"),
            keyed(b"I", b"char[3] sys_name", b"PX4"),
            keyed(b"P", b"float MPC_XY_VEL_MAX", struct.pack("<f", 12.5)),
            keyed(b"P", b"int32_t SYS_AUTOSTART", struct.pack("<i", 4001)),
            message(b"A", struct.pack("<BH", 0, 3) + b"vehicle_attitude"),
            message(b"A", struct.pack("<BH", 1, 4) + b"vehicle_attitude"),
            attitude(3, 5_000, 1.0, 0.0, 0.0, 0.5),
            attitude(4, 6_000, 0.0, 1.0, 0.0, 0.0),
            message(b"L", b"6" + struct.pack("<Q", 6_500) + b"Takeoff detected"),
            keyed(b"P", b"float MPC_XY_VEL_MAX", struct.pack("<f", 8.0)),
            attitude(3, 7_000, 0.0, 0.0, 1.0, 0.25),
        )
    )


def test_a_px4_log_becomes_channels_with_its_own_names(tmp_path: Path) -> None:
    pytest.importorskip("pyulog")
    (tmp_path / "log.ulg").write_bytes(ulog())
    done = import_log(tmp_path / "log.ulg", tmp_path / "log.mcap")
    found = told(done.path)
    first, second = found["/px4/vehicle_attitude/0"]
    assert first.values == {"timestamp": 5_000, "q": [1.0, 0.0, 0.0, 0.5], "quat_reset_counter": 7}
    assert (first.log_time_ns, second.log_time_ns) == (5_000_000, 7_000_000)
    assert len(found["/px4/vehicle_attitude/1"]) == 1
    [text] = found["/px4/log"]
    assert text.values["text"] == "Takeoff detected"
    parameters = [(row.values["name"], row.values["value"]) for row in found["/px4/parameter"]]
    assert parameters == [("MPC_XY_VEL_MAX", 12.5), ("SYS_AUTOSTART", 4001.0), ("MPC_XY_VEL_MAX", 8.0)]
    times = [item.log_time_ns for item in Recording.open(done.path).messages()]
    assert times == sorted(times)
    assert done.messages == len(times) == 7


def test_parameters_of_imported_logs_are_compared(tmp_path: Path) -> None:
    changed = dataflash().replace(struct.pack("<f", 0.25), struct.pack("<f", 0.5))
    for name, data in (("a", dataflash()), ("b", changed)):
        (tmp_path / f"{name}.bin").write_bytes(data)
        import_log(tmp_path / f"{name}.bin", tmp_path / f"{name}.mcap")
    found = diff(Recording.open(tmp_path / "a.mcap"), Recording.open(tmp_path / "b.mcap"))
    assert found.parameters == {(0, 0, "ATC_RAT_RLL_P"): (0.25, 0.5)}


def test_without_pyulog_there_is_one_clear_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pyulog", None)
    (tmp_path / "log.ulg").write_bytes(ulog())
    with pytest.raises(RecordingError, match=r"pip install 'mavlink-companion\[ulog\]'"):
        import_log(tmp_path / "log.ulg", tmp_path / "log.mcap")


def dataflash() -> bytes:
    """A small ArduPilot log, by AP_Logger's LogStructure.h."""

    def declared(number: int, length: int, name: bytes, letters: bytes, columns: bytes) -> bytes:
        return b"\xa3\x95\x80" + struct.pack("<BB4s16s64s", number, length, name, letters, columns)

    return b"".join(
        (
            declared(128, 89, b"FMT", b"BBnNZ", b"Type,Length,Name,Format,Columns"),
            declared(130, 31, b"PARM", b"QNf", b"TimeUS,Name,Value"),
            declared(131, 23, b"ATT", b"QffI", b"TimeUS,Roll,Pitch,Count"),
            declared(132, 75, b"MSG", b"QZ", b"TimeUS,Message"),
            b"\xa3\x95\x82" + struct.pack("<Q16sf", 1_000_000, b"ATC_RAT_RLL_P", 0.25),
            b"\xa3\x95\x83" + struct.pack("<QffI", 2_000_000, 1.5, -2.5, 7),
            b"\xa3\x95\x83" + struct.pack("<QffI", 2_100_000, 1.75, -2.25, 8),
            b"\xa3\x95\x84" + struct.pack("<Q64s", 2_200_000, b"ArduCopter V4.6"),
        )
    )


def test_an_ardupilot_log_becomes_channels_with_its_own_names(tmp_path: Path) -> None:
    (tmp_path / "log.BIN").write_bytes(dataflash())
    done = import_log(tmp_path / "log.BIN", tmp_path / "log.mcap")
    found = told(done.path)
    first, second = found["/ardupilot/ATT"]
    assert first.values == {"TimeUS": 2_000_000, "Roll": 1.5, "Pitch": -2.5, "Count": 7}
    assert second.log_time_ns - first.log_time_ns == 100_000_000
    assert found["/ardupilot/PARM"][0].values["Name"] == "ATC_RAT_RLL_P"
    assert found["/ardupilot/MSG"][0].values["Message"] == "ArduCopter V4.6"


def test_a_log_without_datagrams_is_not_replayed_and_says_of_what_it_was_made(tmp_path: Path) -> None:
    (tmp_path / "log.BIN").write_bytes(dataflash())
    recording = Recording.open(import_log(tmp_path / "log.BIN", tmp_path / "log.mcap").path)
    for find in (vehicle_link, vehicle_links):
        with pytest.raises(RecordingError, match="made of a dataflash log, holds decoded messages only"):
            find(recording)


def test_a_kind_of_message_without_a_length_does_not_hold_the_import_up_for_ever(tmp_path: Path) -> None:
    nothing = b"\xa3\x95\x80" + struct.pack("<BB4s16s64s", 140, 0, b"NONE", b"", b"")
    (tmp_path / "log.BIN").write_bytes(dataflash() + nothing + b"\xa3\x95\x8c" * 20)
    with pytest.raises(RecordingError, match="has no length"):
        import_log(tmp_path / "log.BIN", tmp_path / "log.mcap")


@pytest.mark.parametrize("ending", [".tlog", ".ulg", ".bin"])
def test_whatever_bytes_are_damaged_there_is_a_recording_or_one_line(
    ending: str, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    if ending == ".ulg":
        pytest.importorskip("pyulog")
    whole = {".tlog": TLOG.read_bytes()[:5_000], ".ulg": ulog(), ".bin": dataflash()}[ending]
    generator = random.Random(3)
    source, target = tmp_path / f"x{ending}", tmp_path / "x.mcap"
    read, refused = 0, list[str]()
    for _ in range(80):
        data = bytearray(whole)
        for _ in range(generator.choice((1, 3, 20))):
            data[generator.randrange(len(data))] = generator.randrange(256)
        source.write_bytes(data[: generator.randrange(len(data) // 2, len(data) + 1)])
        try:
            import_log(source, target, force=True)
        except RecordingError as error:
            refused.append(str(error))
            continue
        recording = Recording.open(target)
        assert recording.complete
        assert list(recording.messages())
        read += 1
    assert read > 20
    assert not any("\n" in text for text in refused)
    assert capfd.readouterr().out == ""  # one JSON object is all that may stand there
