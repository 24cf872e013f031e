"""`companion log cat | filter | diff | export | import`: what is printed, exit codes, and one JSON object."""

import json
import os
import re
import sys
import time
from pathlib import Path
from typing import Any

import pytest
from logs_traffic import TLOG, heartbeat, record, record_captured
from mcap.writer import Writer
from typer.testing import CliRunner

from companion.cli.app import app
from companion.cli.keys import Keyboard, keyboard
from companion.cli.lookup import cat
from logs import Attachment, schema
from logs.errors import RecordingError
from logs.recorder import Recorder
from logs.selection import Selection


@pytest.fixture(scope="module")
def log(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("recording") / "flight.mcap"
    with Recorder(path, metadata={}, threaded=False) as recorder:
        recorder.datagram("gcs", "rx", heartbeat(255, 190, 8), log_time_ns=0, now_us=0, tick=0)
        record_captured(recorder)
        record(recorder, schema.Note(6, "flying", "a note\x1b[31m"), 3_000_000, 400)
    return path


def run(*arguments: object) -> tuple[int, str]:
    """Exit code and stdout."""
    done = CliRunner().invoke(app, ["log", *map(str, arguments)])
    if done.exception is not None and not isinstance(done.exception, SystemExit):
        raise done.exception
    return done.exit_code, done.stdout


def test_messages_are_printed_with_mavlinks_names_and_the_time_since_the_first(log: Path) -> None:
    code, out = run("cat", log, "--message", "ATTITUDE", "--start", 1, "-n", 2)
    assert code == 0
    first, second = out.splitlines()
    assert first.split()[1:3] == ["1/1", "ATTITUDE"]
    assert 1.0 <= float(first.split()[0]) <= float(second.split()[0]) < 1.2
    assert "time_boot_ms=" in first
    assert "yawspeed=" in first


def test_a_text_from_a_peer_cannot_write_to_the_terminal(log: Path) -> None:
    _, out = run("cat", log, "--topic", "/companion/note")
    assert 'text="a note?[31m"' in out


def test_nothing_in_a_strangers_file_is_obeyed_by_the_terminal_or_taken_for_markup(tmp_path: Path) -> None:
    path = tmp_path / "strange.mcap"
    with path.open("wb") as file:
        writer = Writer(file)
        writer.start(library="theirs [/x] \x1b[31m")
        channel = writer.register_channel("/[/x]\x1b[2J", "json", 0)
        writer.add_message(channel, 0, b"{}", 0)
        writer.add_attachment(0, 0, "[/y]\x1b[2J", "text/plain", b"")
        writer.add_metadata("import", {"of": "[/z]"})
        writer.finish()
    code, out = run("info", path)
    assert code == 0
    assert "theirs [/x] ?[31m" in out
    assert "made of [/z]" in out
    assert "\x1b" not in out


def test_info_says_what_a_recording_was_made_of_and_when_it_began(log: Path, tmp_path: Path) -> None:
    run("import", TLOG, "-o", tmp_path / "px4.mcap")
    _, out = run("info", tmp_path / "px4.mcap")
    assert f"made of {TLOG.name} (format tlog" in out
    assert re.search(r"begun 20\d\d-\d\d-\d\d \d\d:\d\d:\d\d UTC", out)
    run("filter", log, "-o", tmp_path / "small.mcap", "--message", "ATTITUDE")
    _, out = run("info", tmp_path / "small.mcap")
    assert 'filtered from flight.mcap (names ["ATTITUDE"]' in out
    assert "begun" not in out


def test_with_json_every_line_is_an_object(log: Path) -> None:
    _, out = run("cat", log, "--sysid", 255, "--json")
    lines = [json.loads(line) for line in out.splitlines()]
    assert {line["system"] for line in lines} == {255}


def test_nothing_left_is_told(log: Path) -> None:
    with pytest.raises(RecordingError, match="no decoded message is left"):
        cat(log, Selection(names=("NO_SUCH",)), None, False)


@pytest.mark.parametrize(("to", "name"), [("tlog", "flight.tlog"), ("csv", "flight.csv"), ("json", "flight.jsonl")])
def test_an_export_stands_beside_the_recording_unless_told_otherwise(log: Path, to: str, name: str) -> None:
    code, out = run("export", log, "--to", to, "--json", "--duration", 2)
    told = json.loads(out)
    assert (code, told["ok"], told["path"]) == (0, True, str(log.with_name(name)))
    assert told["packets" if to == "tlog" else "messages"] == sum(told["topics"].values()) > 100
    assert log.with_name(name).exists()


def test_filter_and_import_make_recordings(log: Path, tmp_path: Path) -> None:
    code, out = run("filter", log, "-o", tmp_path / "small.mcap", "--sysid", 1, "--json")
    assert (code, json.loads(out)["ok"]) == (0, True)
    code, out = run("import", TLOG, "-o", tmp_path / "px4.mcap", "--json")
    assert (code, json.loads(out)["ok"]) == (0, True)
    code, out = run("info", tmp_path / "px4.mcap", "--json")
    assert json.loads(out)["metadata"]["import"]["format"] == "tlog"


def test_two_recordings_that_differ_end_with_3_and_those_that_do_not_with_0(log: Path, tmp_path: Path) -> None:
    assert run("diff", log, log)[0] == 0
    run("filter", log, "-o", tmp_path / "small.mcap", "--start", 2)
    code, out = run("diff", log, tmp_path / "small.mcap", "--json")
    told = json.loads(out)
    assert (code, told["ok"]) == (3, False)
    assert set(told["first"]) == {"topic", "field", "count", "largest", "first_s", "left", "right"}
    assert told["counts"]["/mavlink/255/190/HEARTBEAT"][0] > 0
    code, out = run("diff", log, tmp_path / "small.mcap")
    assert code == 3
    assert "they part at " in out


def test_two_flights_differ_by_the_keys_of_mission_and_configuration(tmp_path: Path) -> None:
    paths = []
    for number, (speed, seed) in enumerate(((2, 1), (2.5, 3))):
        mission = f"name: hop\nlimits: {{speed: {speed}}}\nsteps:\n  - takeoff: {{altitude: 2}}\n  - land\n".encode()
        attached = [Attachment("mission.yaml", "application/yaml", mission)]
        metadata = {"companion.config": {"config": json.dumps({"seed": seed, "ground_links": []})}}
        paths.append(tmp_path / f"{number}.mcap")
        with Recorder(paths[-1], metadata=metadata, attachments=attached, threaded=False) as recorder:
            record(recorder, schema.Note(6, "flying", "words"), 3_000_000, 0)
    assert run("diff", paths[0], paths[0])[0] == 0
    code, out = run("diff", *paths)
    assert code == 3
    assert "mission and configuration:\n  limits.speed: 2 | 2.5\n  seed: 1 | 3\n" in out
    code, out = run("diff", *paths, "--json")
    assert (code, json.loads(out)["settings"][0]) == (3, {"name": "limits.speed", "left": 2, "right": 2.5})
    assert run("diff", *paths, "--message", "Note")[0] == 0


def test_a_comparison_of_nothing_is_an_error_and_not_a_pass(log: Path) -> None:
    with pytest.raises(RecordingError, match=r"no decoded message is left .* it holds no ATTITUDEX"):
        run("diff", log, log, "--message", "ATTITUDEX")


@pytest.mark.parametrize("to", ["tlog", "csv", "json", "parquet"])
def test_an_export_of_a_recording_cut_short_says_so(log: Path, tmp_path: Path, to: str) -> None:
    if to == "parquet":
        pytest.importorskip("pyarrow")
    cut = tmp_path / "cut.mcap"
    cut.write_bytes(log.read_bytes()[:-3000])
    code, out = run("export", cut, "--to", to, "--json")
    [left_out] = json.loads(out)["left_out"]
    assert (code, "cut short" in left_out) == (0, True)


def test_what_is_printed_and_compared_of_a_recording_cut_short_comes_with_a_word(log: Path, tmp_path: Path) -> None:
    cut = tmp_path / "cut.mcap"
    cut.write_bytes(log.read_bytes()[:-3000])
    for arguments in (["cat", cut, "-n", 1], ["diff", cut, cut]):
        done = CliRunner().invoke(app, ["log", *map(str, arguments)])
        assert "cut.mcap: not complete: " in done.stderr


def test_without_a_terminal_nobody_presses_a_key(monkeypatch: pytest.MonkeyPatch) -> None:
    with open(os.devnull) as nothing:
        monkeypatch.setattr(sys, "stdin", nothing)
        with keyboard() as keys:
            assert not keys.there
            assert keys() == []


def test_keys_are_told_one_by_one_also_when_an_arrow_comes_in_pieces() -> None:
    pty: Any = pytest.importorskip("pty")
    tty: Any = pytest.importorskip("tty")
    ours, theirs = pty.openpty()
    try:
        tty.setcbreak(theirs)
        keys = Keyboard(theirs)
        assert keys() == []
        found = []
        for piece in (b" x\x1b", b"[", b"C\x1bOC", b"q"):
            os.write(ours, piece)
            time.sleep(0.01)
            found.append(keys())
        assert found == [["pause"], [], ["step", "step"], ["quit"]]
    finally:
        os.close(ours)
        os.close(theirs)


def test_a_wrong_stretch_of_time_is_wrong_usage(log: Path) -> None:
    assert run("cat", log, "--duration", 0)[0] == 2
