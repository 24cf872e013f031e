"""What other people's readers find in a recording is what is in it: message by message counts, and every field decoded.

`mcap` with `mcap_protobuf`, and in node `@mcap/core` with protobufjs and `@foxglove/schemas` (`make readers`).
"""

import json
import re
import shutil
import subprocess
from collections import Counter
from pathlib import Path

import pytest
from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory

from companion.cli.log import show_info
from companion.testing.flight import FlightSpec, fly
from logs.reader import Recording

HERE = Path(__file__).parent
LAYOUT = Path("docs/foxglove-layout.json")
MIRRORS = {"/map/position", "/vehicle/pose", "/tf", "/vehicle/path", "/plan/path", "/scene/obstacles", "/log"}


@pytest.fixture(scope="module")
def recording(tmp_path_factory) -> Path:
    """A flight by sight among movers."""
    file = tmp_path_factory.mktemp("readers") / "movers.mcap"
    result = fly(FlightSpec(Path("missions/movers.yaml"), record=file))
    assert result.ok, result.cause
    return file


@pytest.fixture(scope="module")
def ours(recording) -> dict[str, int]:
    """Messages by topic, as our own reader has them."""
    opened = Recording.open(recording)
    assert opened.complete
    counts = Counter(message.channel.topic for message in opened.messages())
    assert set(counts) >= MIRRORS
    return dict(counts)


@pytest.fixture(scope="module")
def decoded(recording):
    """Every protobuf message by topic, as `mcap_protobuf` decodes it; checksums are checked."""
    found: dict[str, list] = {}
    with open(recording, "rb") as file:
        reader = make_reader(file, decoder_factories=[DecoderFactory()], validate_crcs=True)
        topics = {c.topic for c in reader.get_summary().channels.values() if c.message_encoding == "protobuf"}
        for _, channel, _, message in reader.iter_decoded_messages(sorted(topics)):
            found.setdefault(channel.topic, []).append(message)
    return found


def test_the_mcap_package_finds_what_our_reader_finds(recording, ours, decoded):
    with open(recording, "rb") as file:
        reader = make_reader(file, validate_crcs=True)
        assert Counter(channel.topic for _, channel, _ in reader.iter_messages()) == ours
        assert reader.get_summary().statistics.message_count == sum(ours.values())
    assert {topic: len(messages) for topic, messages in decoded.items()} == {
        topic: count for topic, count in ours.items() if not topic.startswith("/mavlink/raw/")
    }


def test_log_info_counts_the_same(recording, ours, capsys):
    assert show_info(recording, True) == 0
    told = json.loads(capsys.readouterr().out)
    assert {topic: of["count"] for topic, of in told["topics"].items()} == ours
    assert told["messages"] == sum(ours.values())


def test_node_reads_every_message_and_the_well_known_ones_fit_the_published_schemas(recording, ours, decoded):
    if shutil.which("node") is None:
        pytest.skip("node is not installed")
    if not (HERE / "node_modules").is_dir():
        pytest.skip("the node packages are not installed: make readers")
    run = subprocess.run(["node", HERE / "read.mjs", recording], capture_output=True, text=True, timeout=120)
    assert run.returncode == 0, run.stderr
    told = json.loads(run.stdout)
    assert told["problems"] == []
    assert told["counts"] == ours
    assert told["messages"] == sum(ours.values())
    assert told["decoded"] == {topic: len(messages) for topic, messages in decoded.items()}
    assert set(told["last"]) == MIRRORS
    last = decoded["/vehicle/pose"][-1].pose
    seen = told["last"]["/vehicle/pose"]["pose"]
    for part in ("position", "orientation"):
        assert seen[part] == {f.name: value for f, value in getattr(last, part).ListFields()}


def test_what_a_viewer_draws_is_the_flight(decoded):
    """The path ends over the last pose, the plan at the goal; the scene has the world, what was seen, and movers."""
    pose, path = decoded["/vehicle/pose"], decoded["/vehicle/path"][-1].poses
    assert min(p.pose.position.z for p in pose) > -1.0  # up is up
    assert max(p.pose.position.z for p in pose) > 1.0
    end, last = path[-1].position, pose[-1].pose.position
    assert (end.x, end.y) == pytest.approx((last.x, last.y), abs=0.5)
    kinds: set[str] = set()
    for update in decoded["/scene/obstacles"]:
        kinds |= {p.value for entity in update.entities for p in entity.metadata if p.key == "kind"}
    assert kinds >= {"bounds", "mover"}
    errors = [t.error for t in decoded["/companion/tracking"]]
    assert 0.0 < max(errors) < 1.0
    assert {log.name for log in decoded["/log"]} == {"companion", "vehicle"}


def named_in(layout) -> set[str]:
    """Every topic, and every field behind a topic, that the layout names."""
    found: set[str] = set()
    for panel in layout["configById"].values():
        found |= {path["value"] for path in panel.get("paths", [])} | set(panel.get("topicColors", {}))
        found |= set(panel.get("topics", {}))
        found |= {panel[key] for key in ("topicPath", "followTopic", "topicToRender") if key in panel}
    return found


def test_the_layout_names_only_topics_and_fields_that_a_recording_has(decoded):
    layout = json.loads(LAYOUT.read_text())
    names = named_in(layout)
    assert len(names) > 20
    for name in sorted(names):
        topic, _, path = name.partition(".")
        assert topic in decoded, name
        message = decoded[topic][-1]
        for field, index in re.findall(r"(\w+)(?:\[(\d+)\])?", path):
            assert field in message.DESCRIPTOR.fields_by_name, name
            message = getattr(message, field)
            message = message[int(index)] if index else message
        assert not path or isinstance(message, int | float | str), name


def test_the_layout_places_every_panel_once_and_frames_are_those_of_the_recording(decoded):
    layout = json.loads(LAYOUT.read_text())

    def placed(node) -> list[str]:
        return [node] if isinstance(node, str) else placed(node["first"]) + placed(node["second"])

    assert sorted(placed(layout["layout"])) == sorted(layout["configById"])
    scene = layout["configById"]["3D!scene"]
    frames = {(tf.parent_frame_id, tf.child_frame_id) for tf in decoded["/tf"]}
    assert frames == {(scene["followTf"], "vehicle")}
    assert scene["layers"]["grid"]["frameId"] == scene["followTf"]
