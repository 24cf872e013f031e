"""A recording is what the companion would do again, bit for bit; and a changed byte is found."""

import hashlib
from pathlib import Path

import pytest
from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory

from companion.cli.rerun import rerun_log
from companion.cli.simulate import simulate_mission
from companion.drivers.rerun import rerun
from logs.reader import Recording


@pytest.fixture(scope="module")
def recording(tmp_path_factory) -> Path:
    file = tmp_path_factory.mktemp("recordings") / "flight.mcap"
    assert simulate_mission(Path("missions/l_shape.yaml"), 1, file, as_json=False) == 0
    return file


def test_the_same_seed_gives_a_byte_identical_recording_and_another_seed_does_not(recording, tmp_path, capsys):
    digests = []
    for seed in (1, 2):
        file = tmp_path / f"{seed}.mcap"
        simulate_mission(Path("missions/l_shape.yaml"), seed, file, as_json=True)
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
        assert [a.name for a in reader.iter_attachments()] == ["mission.yaml"]
    assert {"/mavlink/1/1/ATTITUDE", "/mavlink/1/191/SET_POSITION_TARGET_LOCAL_NED"} <= decoded.keys()
    assert decoded["/companion/plan_ready"].certified
    assert sum(summary.statistics.channel_message_counts.values()) == summary.statistics.message_count
