"""A smaller recording made of another: the messages wanted, byte for byte, with their times, ticks and order.

Tables and attachments come along; the table `filter` says what was wanted and of which file. It opens and replays as
any recording. It can be run again if it begins with the flight and every topic of the seam is in it (`SEAM`).
"""

import json
from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path

from logs.container import Container
from logs.errors import RecordingError
from logs.export import Exported, begun, unfinished
from logs.parts import PART, refuse_beside_parts
from logs.reader import FILTER, RECOVERY, ChannelInfo, Recording
from logs.selection import Selection, nothing_left, selected

SEAM = ("/mavlink/raw/*", "/companion/*")
"""Topics without which a recording cannot be run again."""


def filtered(recording: Recording, path: Path, wanted: Selection, force: bool = False) -> Exported:
    """Write what is wanted of a recording, of all its parts, into one file.

    Raises
    ------
    RecordingError    It cannot be written, parts of another recording of its name are there, or nothing is selected.
    """
    if path.exists() and any(path.samefile(part) for part in recording.paths):
        raise RecordingError(path, "is the recording itself")
    refuse_beside_parts(path)
    done = begun(recording, path)
    with unfinished(path, force) as temporary, open(temporary, "xb", buffering=0) as file:
        container = Container(file)
        for name, values in _tables(recording, wanted).items():
            container.add_metadata(name, values)
        for attachment in recording.attachments.values():
            container.add_attachment(attachment.name, attachment.media_type, attachment.data)
        channels: dict[ChannelInfo, int] = {}
        schemas: dict[str, int] = {}
        for message in selected(recording.messages(), wanted):
            channel = message.channel
            number = channels.get(channel)
            if number is None:
                number = channels[channel] = _declare(container, recording, channel, schemas)
            container.add_message(number, message.tick, message.log_time_ns, message.publish_time_ns, message.data)
            done.count(channel.topic)
        if not done.messages:
            raise nothing_left(recording, wanted, "message")
        container.finish()
    return done


def _tables(recording: Recording, wanted: Selection) -> dict[str, Mapping[str, str]]:
    tables = {name: values for name, values in recording.metadata.items() if name not in (PART, RECOVERY, FILTER)}
    told = {name: json.dumps(value) for name, value in asdict(wanted).items() if value not in ((), None)}
    tables[FILTER] = {"of": recording.path.name, **told}
    if recording.problem:
        tables[FILTER] = {**tables[FILTER], "problem": recording.problem}
    return tables


def _declare(container: Container, recording: Recording, channel: ChannelInfo, schemas: dict[str, int]) -> int:
    number = 0
    if channel.schema:
        if channel.schema not in schemas:
            data = recording.descriptor_set(channel.schema)
            schemas[channel.schema] = container.add_schema(channel.schema, "protobuf", data)
        number = schemas[channel.schema]
    metadata: dict[str, str] = {}
    if channel.direction is not None:
        metadata = {"link": channel.link, "direction": channel.direction}
    if channel.peer is not None:
        metadata |= {"peer_host": channel.peer[0], "peer_port": str(channel.peer[1])}
    return container.add_channel(channel.topic, channel.encoding, number, metadata)
