"""A recording is what the companion would do again, bit for bit; and a changed byte is found."""

import hashlib
import json
import re
from pathlib import Path

import pytest
import typer
from mcap.reader import make_reader
from mcap.writer import Writer
from mcap_protobuf.decoder import DecoderFactory

from companion.cli.rerun import rerun_log
from companion.cli.simulate import simulate_mission
from companion.drivers.changes import changes_of
from companion.drivers.rerun import rerun
from companion.errors import MissionError, RerunError
from logs.filter import SEAM, filtered
from logs.reader import Recording
from logs.recorder import Recorder
from logs.selection import Selection


def test_the_same_seed_gives_a_byte_identical_recording_and_another_seed_does_not(recording, tmp_path, capsys):
    digests = []
    for seed in (1, 2):
        file = tmp_path / f"{seed}.mcap"
        simulate_mission(Path("missions/l_shape.yaml"), seed, file, "px4", as_json=True)
        digests.append(hashlib.sha256(file.read_bytes()).hexdigest())
    assert digests[0] == hashlib.sha256(recording.read_bytes()).hexdigest()
    assert digests[0] != digests[1]


def test_a_rerun_reproduces_every_output(recording):
    outcome = rerun(Recording.open(recording))
    assert outcome.comparison.first is None
    assert outcome.comparison.equal == outcome.comparison.outputs > 2 * outcome.ticks
    assert rerun_log(recording, as_json=False) == 0


def test_the_plain_mcap_reader_and_its_protobuf_decoder_open_the_recording(recording):
    with recording.open("rb") as file:
        reader = make_reader(file, decoder_factories=[DecoderFactory()], validate_crcs=True)
        summary = reader.get_summary()
        decoded = {
            channel.topic: message
            for _, channel, _, message in reader.iter_decoded_messages(
                [c.topic for c in summary.channels.values() if c.message_encoding == "protobuf"]
            )
        }
        attached = [attachment.name for attachment in reader.iter_attachments()]
        assert list(dict.fromkeys(attached)) == ["mission.yaml", "vehicle.params"]  # parameters once more as they ended
    assert {"/mavlink/1/1/ATTITUDE", "/mavlink/1/191/SET_POSITION_TARGET_LOCAL_NED"} <= decoded.keys()
    assert decoded["/companion/plan_ready"].certified
    assert sum(summary.statistics.channel_message_counts.values()) == summary.statistics.message_count


def rewritten(source: Path, target: Path, change) -> None:
    """The recording written again by the plain library, one message's bytes changed: a file without a torn checksum."""
    with source.open("rb") as old, target.open("wb") as new:
        reader, writer = make_reader(old), Writer(new)
        writer.start()
        summary = reader.get_summary()
        schemas = {0: 0} | {i: writer.register_schema(s.name, s.encoding, s.data) for i, s in summary.schemas.items()}
        channels = {
            i: writer.register_channel(c.topic, c.message_encoding, schemas[c.schema_id], c.metadata)
            for i, c in summary.channels.items()
        }
        for attachment in reader.iter_attachments():
            writer.add_attachment(0, 0, attachment.name, attachment.media_type, attachment.data)
        for metadata in reader.iter_metadata():
            writer.add_metadata(metadata.name, metadata.metadata)
        for _, channel, message in reader.iter_messages(log_time_order=False):
            data = change(channel.topic, message)
            writer.add_message(channels[channel.id], message.log_time, data, message.publish_time, message.sequence)
        writer.finish()


def flip(topic: str, tick: int, byte: int):
    """Flip one bit of the first message of a topic at or after a tick."""
    done = []

    def change(found: str, message) -> bytes:
        if found != topic or message.sequence < tick or done:
            return message.data
        done.append(message)
        return bytes(b ^ (1 if i == byte else 0) for i, b in enumerate(message.data))

    return change


@pytest.mark.parametrize(
    ("topic", "tick", "byte"),
    [
        ("/mavlink/raw/autopilot/rx", 0, 12),  # any telemetry before the flight
        ("/mavlink/raw/autopilot/rx", 700, 0),  # the start byte of a packet in flight
        ("/mavlink/raw/autopilot/rx", 1000, 20),
        ("/companion/plan_ready", 0, 60),  # inside a control point
    ],
)
def test_one_flipped_byte_of_an_input_makes_the_rerun_fail_and_name_the_first_difference(
    recording, tmp_path, capsys, topic, tick, byte
):
    target = tmp_path / "flipped.mcap"
    rewritten(recording, target, flip(topic, tick, byte))
    assert rerun_log(target, as_json=True) == 3
    result = json.loads(capsys.readouterr().out)
    assert not result["ok"]
    first = result["first_difference"]
    found = int(re.match(r"tick (\d+), companion\.Tick: .*Tick\.inputs_crc32 recorded", first).group(1))
    assert found >= tick


def test_a_rewritten_recording_without_a_change_still_passes(recording, tmp_path):
    target = tmp_path / "same.mcap"
    rewritten(recording, target, lambda topic, message: message.data)
    assert rerun_log(target, as_json=False) == 0


def test_a_byte_flipped_in_the_file_itself_is_a_failed_verification_too(recording, tmp_path, capsys):
    data = bytearray(recording.read_bytes())
    data[len(data) // 2] ^= 1
    target = tmp_path / "torn.mcap"
    target.write_bytes(data)
    assert rerun_log(target, as_json=True) == 3
    assert "damaged at byte" in json.loads(capsys.readouterr().out)["problem"]


def test_a_changed_output_is_named_by_message_and_field(recording, tmp_path, capsys):
    target = tmp_path / "output.mcap"
    rewritten(recording, target, flip("/companion/reference", 800, 30))
    assert rerun_log(target, as_json=True) == 3
    assert "companion.Reference: Reference." in json.loads(capsys.readouterr().out)["first_difference"]


def test_a_file_that_is_no_recording_of_a_companion_is_one_line(tmp_path):
    target = tmp_path / "other.mcap"
    with target.open("wb") as file:
        writer = Writer(file)
        writer.start()
        writer.finish()
    with pytest.raises(RerunError, match="no mission and configuration"):
        rerun_log(target, as_json=False)


def test_a_filtered_recording_that_keeps_the_seam_from_the_start_runs_again_bit_for_bit(recording, tmp_path):
    wanted = Selection(topics=SEAM, duration_s=5.003)
    outcome = rerun(Recording.open(filtered(Recording.open(recording), tmp_path / "small.mcap", wanted).path))
    assert outcome.comparison.first is None
    assert outcome.ticks == 250


@pytest.mark.parametrize("wanted", [{"names": ("ATTITUDE",)}, {"start_s": 2.0}, {"topics": ("/mavlink/raw/*/rx",)}])
def test_a_filtered_recording_without_what_a_rerun_needs_is_told_what_to_keep(recording, tmp_path, wanted):
    small = filtered(Recording.open(recording), tmp_path / "small.mcap", Selection(**wanted))
    with pytest.raises(
        RerunError, match=r"filtered from flight.mcap without .*; filter with --topic '/mavlink/raw/\*'"
    ):
        rerun(Recording.open(small.path))


def test_a_later_part_is_no_beginning_and_the_first_is_named(recording, tmp_path):
    whole = Recording.open(recording)
    metadata = {name: values for name, values in whole.metadata.items() if name != "schema"}
    metadata |= {"part": {"number": "2", "of": "flight.mcap"}}
    path = tmp_path / "flight.part0002.mcap"
    with Recorder(path, metadata=metadata, attachments=list(whole.attachments.values()), threaded=False):
        pass
    with pytest.raises(RerunError, match=r"is part 2; a re-run begins with flight.mcap"):
        rerun(Recording.open(path))


def test_what_a_changed_limit_changes_is_listed_by_field_with_when_first_and_how_much_at_most(recording, capsys):
    assert rerun_log(recording, as_json=True, sets=["limits.climb=0.8"]) == 0
    result = json.loads(capsys.readouterr().out)
    assert result["ok"]
    assert result["set"] == {"limits.climb": 0.8}
    assert 0 < result["equal"] < result["outputs"]
    listed = {change["what"]: change for change in result["changes"]}
    sent = listed["SET_POSITION_TARGET_LOCAL_NED.vz"]
    assert sent["times"] == result["differences"]["SET_POSITION_TARGET_LOCAL_NED.vz"] > 100
    assert sent["largest"] > 0.1  # it was told to climb at 1 m/s
    assert sent["recorded"] != sent["produced"]
    first = min(change["first_tick"] for change in result["changes"])
    assert result["first_difference"].startswith(f"tick {first}, ")
    assert sent["largest_tick"] >= sent["first_tick"] >= first


def test_a_changed_seed_of_the_configuration_changes_what_is_asked_of_the_planner_and_no_more(recording, capsys):
    assert rerun_log(recording, as_json=True, sets=["seed=7"]) == 0
    result = json.loads(capsys.readouterr().out)
    assert result["seed"] == 7
    assert result["differences"] == {"PlanWanted.seed": 1}
    assert rerun_log(recording, as_json=False, sets=["seed=7"]) == 0
    assert "1 x PlanWanted.seed from tick" in capsys.readouterr().out


def test_a_change_to_what_it_was_changes_nothing(recording, capsys):
    assert rerun_log(recording, as_json=True, sets=["seed=1", "limits.climb=1.0", "steps.0.takeoff.altitude=1.5"]) == 0
    result = json.loads(capsys.readouterr().out)
    assert result["equal"] == result["outputs"]


@pytest.mark.parametrize(
    ("text", "error", "told"),
    [
        ("limits.climb", typer.BadParameter, "expected KEY=VALUE"),
        ("limts.climb=1", RerunError, "limts.climb: found an unknown key"),
        ("limits.climb=fast", MissionError, "mission.yaml as changed: limits.climb: found 'fast'"),
        ("limits.clim=1", MissionError, "did you mean climb"),
        ("seed=fast", RerunError, "seed: found 'fast', expected a valid integer"),
        ("steps.99.hold=1", RerunError, "found '99', expected the number of one of"),
        ("name.first=1", RerunError, "expected a mapping or a list"),
        ("seed=[", typer.BadParameter, "expected a value as YAML"),
    ],
)
def test_a_change_that_has_no_place_is_one_line_that_names_it(recording, text, error, told):
    with pytest.raises(error, match=re.escape(told)):
        rerun_log(recording, as_json=False, sets=[text])


def test_the_same_key_twice_is_refused():
    with pytest.raises(RerunError, match="each key once"):
        changes_of(["seed=1", "seed=2"])
