"""Recordings in the formats of others, read back by those others: pymavlink, the csv and json modules, pyarrow."""

import csv
import json
import math
import os
import subprocess
import sys
from collections import Counter
from pathlib import Path
from typing import Any

import pytest
from google.protobuf import descriptor_pb2
from logs_traffic import heartbeat, record, record_captured
from mcap.writer import Writer
from pymavlink import mavutil

from logs import Recording, RecordingError, schema
from logs.export import FileNames
from logs.export.csv import to_csv
from logs.export.json_lines import to_json
from logs.export.parquet import to_parquet
from logs.export.tlog import to_tlog
from logs.recorder import Recorder
from logs.selection import Selection
from wire.dialect import mavlink as m

ALL = Selection()
GREAT = (1 << 64) - 3


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Recording:
    path = tmp_path_factory.mktemp("recording") / "flight.mcap"
    mav = m.MAVLink(None, srcSystem=1, srcComponent=1)
    odd = m.MAVLink_odometry_message(
        GREAT, 1, 1, math.nan, math.inf, 0.1, [1.0, 0.0, 0.0, math.nan], 0, 0, 0, 0, 0, 0, [0.5] * 21, [math.nan] * 21
    )
    tunnel = m.MAVLink_tunnel_message(0, 0, 7, 3, [1, 2, 3] + [0] * 125)
    with Recorder(path, metadata={}, threaded=False) as recorder:
        record_captured(recorder)
        for tick, data in enumerate((odd.pack(mav), tunnel.pack(mav)), 1000):
            recorder.datagram("autopilot", "rx", bytes(data), log_time_ns=7_000_000_000, now_us=7_000_000, tick=tick)
        recorder.datagram("gcs", "tx", heartbeat(), log_time_ns=8_000_000_000, now_us=8_000_000, tick=2000)
        record(recorder, schema.PlanReady(1, True, text='say "a, b"\nc', control_points=(1.0, 2.0)), 8_000_000, 2001)
        record(recorder, schema.PlanReady(2, True, knots=(0.5, 0.25, 0.125)), 8_000_000, 2002)
    return Recording.open(path)


def decoded(recording: Recording) -> Counter[str]:
    return Counter(item.channel.topic for item in recording.messages() if item.channel.schema)


def test_a_telemetry_log_has_every_packet_of_the_vehicles_link_for_pymavlink(
    recording: Recording, tmp_path: Path
) -> None:
    path = tmp_path / "flight.tlog"
    done = to_tlog(recording, path, ALL)
    expected = sum(item.channel.link == "autopilot" for item in recording.messages())
    reader = mavutil.mavlink_connection(str(path))
    found: Counter[str] = Counter()
    times = []
    while (message := reader.recv_msg()) is not None:
        found[message.get_type()] += 1
        times.append(message._timestamp)
    reader.close()
    assert done.messages == sum(found.values()) == expected > 1000
    assert "BAD_DATA" not in found
    assert times == sorted(times)
    assert times[-1] == pytest.approx(7.0)


def test_mavlogdump_counts_the_same_packets(recording: Recording, tmp_path: Path) -> None:
    path = tmp_path / "flight.tlog"
    done = to_tlog(recording, path, ALL)
    program = Path(sys.executable).parent / "mavlogdump.py"
    if not program.exists():
        pytest.skip("mavlogdump.py is not installed beside this Python")
    told = subprocess.run(
        [sys.executable, str(program), "--format", "json", "--dialect", "all", str(path)],
        env={**os.environ, "MAVLINK20": "1"},
        capture_output=True,
        text=True,
        timeout=60,
        check=True,
    )
    kinds = Counter(json.loads(line)["meta"]["type"] for line in told.stdout.splitlines() if line.startswith("{"))
    assert sum(kinds.values()) == done.messages
    assert "BAD_DATA" not in kinds


def test_a_telemetry_log_tells_a_packet_that_crossed_two_links_once_and_no_key(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    mav = m.MAVLink(None, srcSystem=255, srcComponent=190)
    key = bytes(m.MAVLink_setup_signing_message(1, 1, [7] * 32, 5).pack(mav))
    with Recorder(path, metadata={}, threaded=False) as recorder:
        recorder.datagram("autopilot", "rx", heartbeat(), log_time_ns=2_000, now_us=1, tick=0)
        recorder.datagram("gcs", "tx", heartbeat(), log_time_ns=3_000, now_us=1, tick=0)
        recorder.datagram("autopilot", "tx", key + b"noise", log_time_ns=4_000, now_us=1, tick=0)
    target = tmp_path / "a.tlog"
    done = to_tlog(Recording.open(path), target, ALL)
    assert target.read_bytes() == (2).to_bytes(8, "big") + heartbeat()
    assert done.left_out == ["5 bytes that are in no packet", "1 SETUP_SIGNING: their keys are masked"]
    assert to_tlog(Recording.open(path), target, Selection(links=("gcs",)), force=True).messages == 1


def test_csv_has_a_file_a_topic_a_line_a_message_and_a_column_an_element(recording: Recording, tmp_path: Path) -> None:
    done = to_csv(recording, tmp_path / "flight", ALL)
    tables = {
        path.stem: list(csv.DictReader(path.read_text().splitlines(keepends=True)))
        for path in (tmp_path / "flight").iterdir()
    }
    expected = {topic.strip("/").replace("/", "_"): count for topic, count in decoded(recording).items()}
    assert {name: len(lines) for name, lines in tables.items()} == expected
    assert sum(expected.values()) == done.messages
    odd = tables["mavlink_1_1_ODOMETRY"][-1]
    assert int(odd["time_usec"]) == GREAT
    assert (odd["x"], odd["y"], odd["z"]) == ("nan", "inf", "0.1")
    assert (odd["q[0]"], odd["q[3]"]) == ("1.0", "nan")
    assert odd["log_time_ns"] == "7000000000"
    [tunnel] = tables["mavlink_1_1_TUNNEL"]
    assert [tunnel[f"payload[{number}]"] for number in range(4)] == ["1", "2", "3", "0"]
    assert "payload[127]" in tunnel
    first, second = tables["companion_plan_ready"]
    assert (first["text"], first["ok"]) == ('say "a, b"\nc', "1")
    assert (first["control_points[1]"], first["knots[2]"], second["knots[2]"]) == ("2.0", "", "0.125")


def test_lines_of_json_are_json_for_the_strictest_reader(recording: Recording, tmp_path: Path) -> None:
    def never(text: str) -> Any:
        raise AssertionError(text)

    done = to_json(recording, tmp_path / "flight.jsonl", ALL)
    lines = [json.loads(line, parse_constant=never) for line in (tmp_path / "flight.jsonl").read_text().splitlines()]
    assert Counter(line["topic"] for line in lines) == decoded(recording)
    assert len(lines) == done.messages
    odd = [line for line in lines if line["name"] == "ODOMETRY"][-1]
    assert odd["values"]["time_usec"] == GREAT
    assert (odd["values"]["x"], odd["values"]["y"], odd["values"]["z"]) == (None, None, 0.1)
    assert odd["values"]["q"] == [1.0, 0.0, 0.0, None]
    assert (odd["system"], odd["component"], odd["log_time_ns"]) == (1, 1, 7_000_000_000)


def test_parquet_keeps_counts_types_and_values(recording: Recording, tmp_path: Path) -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    to_parquet(recording, tmp_path / "flight", ALL)
    tables = {path.stem: parquet.read_table(path) for path in (tmp_path / "flight").iterdir()}
    expected = {topic.strip("/").replace("/", "_"): count for topic, count in decoded(recording).items()}
    assert {name: table.num_rows for name, table in tables.items()} == expected
    odd = tables["mavlink_1_1_ODOMETRY"]
    assert [str(odd.schema.field(name).type) for name in ("log_time_ns", "time_usec", "x")] == [
        "int64",
        "uint64",
        "float",
    ]
    values = odd.to_pylist()[-1]
    assert values["time_usec"] == GREAT
    assert math.isnan(values["x"])
    assert values["q"][:3] == [1.0, 0.0, 0.0]
    assert tables["mavlink_1_1_TUNNEL"].to_pylist()[0]["payload"][:4] == [1, 2, 3, 0]
    assert tables["companion_plan_ready"].to_pylist()[1]["knots"] == [0.5, 0.25, 0.125]


def test_without_pyarrow_there_is_one_clear_line(
    recording: Recording, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    with pytest.raises(RecordingError, match=r"pip install 'mavlink-companion\[parquet\]'"):
        to_parquet(recording, tmp_path / "flight", ALL)


@pytest.mark.parametrize("export", [to_tlog, to_csv, to_json])
def test_what_is_there_is_kept_and_nothing_is_left_of_what_fails(
    export: Any, recording: Recording, tmp_path: Path
) -> None:
    target = tmp_path / "flight.out"
    with pytest.raises(RecordingError, match="is left of what is asked for"):
        export(recording, target, Selection(names=("NO_SUCH",)))
    assert list(tmp_path.iterdir()) == []
    some = Selection(names=("ATTITUDE",))
    export(recording, target, some)
    with pytest.raises(RecordingError, match="is there already; --force replaces it"):
        export(recording, target, some)
    export(recording, target, some, force=True)
    assert list(tmp_path.iterdir()) == [target]


def test_topics_that_are_alike_to_a_file_system_get_files_of_their_own() -> None:
    names = FileNames()
    assert [names.of(topic) for topic in ("/a/B", "/a/b", "/a_b", "/../x", "/")] == [
        "a_B",
        "a_b_2",
        "a_b_3",
        "_x",
        "_",
    ]


def strange(path: Path) -> Recording:
    """A recording of somebody else's: messages of a kind that holds itself, and a map."""
    file = descriptor_pb2.FileDescriptorProto(name="n.proto", package="n", syntax="proto3")
    node = file.message_type.add(name="Node")
    node.field.add(name="next", number=1, type=11, label=1, type_name=".n.Node")
    node.field.add(name="value", number=2, type=5, label=1)
    entry = node.nested_type.add(name="TagsEntry")
    entry.options.map_entry = True
    entry.field.add(name="key", number=1, type=9, label=1)
    entry.field.add(name="value", number=2, type=5, label=1)
    node.field.add(name="tags", number=3, type=11, label=3, type_name=".n.Node.TagsEntry")
    with path.open("wb") as out:
        writer = Writer(out)
        writer.start()
        files = descriptor_pb2.FileDescriptorSet(file=[file]).SerializeToString()
        channel = writer.register_channel("/node", "protobuf", writer.register_schema("n.Node", "protobuf", files))
        writer.add_message(channel, 1, b"\x10\x05", 1)  # value 5
        writer.add_message(
            channel, 2, b"\x0a\x04\x0a\x02\x10\x07\x1a\x05\x0a\x01a\x10\x09", 2
        )  # next.next.value 7, a: 9
        writer.finish()
    return Recording.open(path)


@pytest.mark.parametrize("export", [to_csv, to_json, to_parquet])
def test_messages_that_hold_themselves_and_maps_are_told_whole(export: Any, tmp_path: Path) -> None:
    if export is to_parquet:
        pytest.importorskip("pyarrow")
    done = export(strange(tmp_path / "strange.mcap"), tmp_path / "out", Selection())
    inner = [{"next": [{"next": [], "value": 7, "tags": []}], "value": 0, "tags": []}]
    if export is to_json:
        _, second = (json.loads(line)["values"] for line in done.path.read_text().splitlines())
        found = second["next"], second["tags"]
    elif export is to_csv:
        _, second = csv.DictReader((done.path / "node.csv").read_text().splitlines())
        found = json.loads(second["next"]), json.loads(second["tags"])
    else:
        import pyarrow.parquet

        second = pyarrow.parquet.read_table(done.path / "node.parquet").to_pylist()[1]
        found = json.loads(second["next"]), json.loads(second["tags"])
    assert found == (inner, [{"key": "a", "value": 9}])
