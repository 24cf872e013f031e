"""Recordings of anything come back; files of anything are refused or read, and nothing else happens."""

import struct
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from hypothesis import given, settings
from hypothesis import strategies as st
from mcap.data_stream import RecordBuilder
from mcap.records import Channel, Chunk, Message, Schema

from logs import Direction, LogsError, Output, Recording, compare, outputs_sha256, schema, ticks
from logs.info import info
from logs.recorder import Recorder
from wire.datagram import Datagram

MAGIC = b"\x89MCAP0\r\n"
peers = st.one_of(st.none(), st.tuples(st.sampled_from(["127.0.0.1", "::1"]), st.integers(1, 65535)))
datagrams = st.builds(Datagram, st.sampled_from(["autopilot", "gcs"]), st.binary(max_size=60), peers)
texts = st.text(st.characters(exclude_categories=["Cs"]), max_size=10)
numbers = st.floats(allow_nan=False)
vectors = st.lists(numbers, max_size=6).map(tuple)
inputs = st.one_of(datagrams, st.builds(schema.OperatorCommand, texts))
outputs = st.one_of(
    datagrams,
    st.builds(schema.Note, st.integers(0, 7), texts, texts),
    st.builds(schema.Reference, texts, vectors, vectors, vectors, numbers),
)
rows = st.lists(st.tuples(st.lists(inputs, max_size=4), st.lists(outputs, max_size=4)), max_size=6)


@contextmanager
def scratch() -> Iterator[Path]:
    """A file name in a folder that goes away (hypothesis calls a test many times within one `tmp_path`)."""
    with tempfile.TemporaryDirectory() as folder:
        yield Path(folder) / "a.mcap"


def write(
    recorder: Recorder, direction: Direction, item: Datagram | schema.Record, stamp_us: int, now_us: int, tick: int
) -> None:
    if isinstance(item, Datagram):
        recorder.datagram(
            item.link, direction, item.data, log_time_ns=stamp_us * 1000, now_us=now_us, tick=tick, peer=item.peer
        )
    else:
        topic = schema.TOPICS[type(item)]
        recorder.message(topic, item, log_time_ns=stamp_us * 1000, now_us=now_us, tick=tick)


@settings(max_examples=60, deadline=None)
@given(rows, st.booleans())
def test_whatever_crosses_the_seam_comes_back_as_the_same_table(
    table: list[tuple[list[Datagram | schema.Record], list[Datagram | schema.Record]]], threaded: bool
) -> None:
    with scratch() as path:
        with Recorder(path, metadata={}, threaded=threaded) as recorder:
            for tick, (received, sent) in enumerate(table):
                now_us = tick * 20_000
                for item in received:
                    write(recorder, "rx", item, now_us, now_us, tick)
                write(recorder, "tx", schema.Tick(now_us, len(received), len(sent)), now_us, now_us, tick)
                for item in sent:
                    write(recorder, "tx", item, now_us, now_us, tick)
        found = [([i for _, i in row.inputs], [o for _, o in row.outputs]) for row in ticks(Recording.open(path))]
    assert found == table


def chunk_of(records: bytes) -> bytes:
    """A chunk without compression and checksum, so that whatever is in it is believed."""
    builder = RecordBuilder()
    Chunk(
        compression="",
        data=records,
        message_start_time=0,
        message_end_time=0,
        uncompressed_crc=0,
        uncompressed_size=len(records),
    ).write(builder)
    data: bytes = builder.end()
    return data


def read_everything(content: bytes) -> str:
    """Read a file of this content in every way there is; returns the error or the problem; one there must be."""
    with scratch() as path:
        path.write_bytes(content)
        try:
            recording = Recording.open(path)
            for message in recording.messages():
                recording.decode(message)
            list(ticks(recording))
            info(path)
        except LogsError as error:
            return str(error)
        return recording.problem


@given(st.binary(max_size=200), st.booleans())
def test_any_bytes_behind_the_magic_are_read_or_refused(rubbish: bytes, in_a_chunk: bool) -> None:
    assert read_everything(MAGIC + (chunk_of(rubbish) if in_a_chunk else rubbish))


@given(st.binary(max_size=60), st.integers(0, 0xFF))
def test_a_record_of_any_kind_in_a_chunk_is_read_or_refused(body: bytes, opcode: int) -> None:
    assert read_everything(MAGIC + chunk_of(struct.pack("<BQ", opcode, len(body)) + body))


@given(st.binary(min_size=1, max_size=30), st.sampled_from(schema.RECORDS))
def test_a_record_of_ours_with_any_bytes_is_read_or_refused(data: bytes, kind: type[schema.Record]) -> None:
    builder = RecordBuilder()
    Schema(id=1, name=schema.schema_name(kind), encoding="protobuf", data=schema.DESCRIPTOR_SET).write(builder)
    Channel(id=1, topic="/a", message_encoding="protobuf", metadata={}, schema_id=1).write(builder)
    Message(channel_id=1, log_time=0, publish_time=0, sequence=0, data=data).write(builder)
    assert read_everything(MAGIC + chunk_of(builder.end()))


runs = st.lists(
    st.builds(
        Output, st.integers(0, 5), st.sampled_from(["autopilot", "gcs", "companion.Note"]), st.binary(max_size=8)
    ),
    max_size=12,
).map(lambda found: sorted(found, key=lambda output: output.tick))


@given(runs, runs)
def test_a_comparison_is_fair(one: list[Output], other: list[Output]) -> None:
    assert compare(one, one).first is None
    there, back = compare(one, other), compare(other, one)
    assert (there.outputs, there.equal) == (back.outputs, back.equal)
    assert max(len(one), len(other)) <= there.outputs <= len(one) + len(other)
    assert (there.first is None) == (there.equal == there.outputs)
    if outputs_sha256(one) == outputs_sha256(other):
        assert there.first is None
