"""Parquet: a folder with a file a topic, in columns of the types that the messages have.

Lists of numbers stay lists, nested messages are taken apart, lists of messages are JSON; `log_time_ns` is an int64.
Wants the package pyarrow (`pip install mavlink-companion[parquet]`).
"""

import json
from pathlib import Path
from typing import Any

from google.protobuf.descriptor import Descriptor, FieldDescriptor

from logs.errors import RecordingError
from logs.export import Exported, FileNames, begun, unfinished
from logs.export.tables import jsonable
from logs.reader import RecordedMessage, Recording
from logs.rows import flat, nests, row
from logs.selection import Selection, nothing_left, selected
from logs.transcode import PACKAGE

GROUP = 8192
"""Messages of a topic written at once: what is kept in memory of each."""


def to_parquet(recording: Recording, path: Path, wanted: Selection, force: bool = False) -> Exported:
    """Write every selected decoded topic into a file of its own in the folder `path`.

    Raises
    ------
    RecordingError    pyarrow is not installed, it cannot be written, or nothing is selected.
    """
    try:
        import pyarrow
        import pyarrow.parquet
    except ImportError as error:
        reason = "Parquet wants the package pyarrow: pip install 'mavlink-companion[parquet]'"
        raise RecordingError(path, reason) from error
    done = begun(recording, path)
    names = FileNames()
    tables: dict[str, _Table] = {}
    with unfinished(path, force, folder=True) as folder:
        try:
            for message in selected(recording.messages(), wanted):
                if not message.channel.schema:
                    continue
                topic = message.channel.topic
                table = tables.get(topic)
                if table is None:
                    table = tables[topic] = _Table(pyarrow, folder / f"{names.of(topic)}.parquet", recording, message)
                table.add(recording, message)
                done.count(topic)
        finally:
            for table in tables.values():
                table.close()
        if not done.messages:
            raise nothing_left(recording, wanted)
    return done


class _Table:
    """One topic's file."""

    def __init__(self, pyarrow: Any, path: Path, recording: Recording, first: RecordedMessage) -> None:
        self._arrow = pyarrow
        fields = [("log_time_ns", pyarrow.int64())]
        self._told: set[str] = set()  # columns that are JSON
        self._fields(recording.decode(first).DESCRIPTOR, "", fields)
        self._schema = pyarrow.schema(fields)
        self._writer = pyarrow.parquet.ParquetWriter(path, self._schema, compression="zstd")
        self._columns: dict[str, list[Any]] = {name: [] for name, _ in fields}

    def add(self, recording: Recording, message: RecordedMessage) -> None:
        found = dict(flat(row(recording, message).values))
        found["log_time_ns"] = message.log_time_ns
        for name, column in self._columns.items():
            value = found.get(name)
            told = name in self._told and value is not None
            column.append(json.dumps(jsonable(value), separators=(",", ":")) if told else value)
        if len(self._columns["log_time_ns"]) >= GROUP:
            self._flush()

    def close(self) -> None:
        self._flush()
        self._writer.close()

    def _flush(self) -> None:
        if self._columns["log_time_ns"]:
            self._writer.write_table(self._arrow.table(self._columns, schema=self._schema))
            self._columns = {name: [] for name in self._columns}

    def _fields(self, descriptor: Descriptor | None, prefix: str, into: list[tuple[str, Any]]) -> None:
        if descriptor is None:
            return
        octets = descriptor.full_name.startswith(f"{PACKAGE}.")
        for field in descriptor.fields:
            name = prefix + field.name
            if nests(field):
                self._fields(field.message_type, f"{name}.", into)
                continue
            if field.message_type is not None:
                kind = self._arrow.string()
                self._told.add(name)
            elif octets and field.type == FieldDescriptor.TYPE_BYTES:
                kind = self._arrow.list_(self._arrow.uint8())
            else:
                kind = getattr(self._arrow, _TYPES.get(field.type, "int64"))()
                kind = self._arrow.list_(kind) if field.is_repeated else kind
            into.append((name, kind))


_TYPES: dict[int, str] = {
    FieldDescriptor.TYPE_INT32: "int32",
    FieldDescriptor.TYPE_SINT32: "int32",
    FieldDescriptor.TYPE_SFIXED32: "int32",
    FieldDescriptor.TYPE_ENUM: "int32",
    FieldDescriptor.TYPE_UINT32: "uint32",
    FieldDescriptor.TYPE_FIXED32: "uint32",
    FieldDescriptor.TYPE_UINT64: "uint64",
    FieldDescriptor.TYPE_FIXED64: "uint64",
    FieldDescriptor.TYPE_FLOAT: "float32",
    FieldDescriptor.TYPE_DOUBLE: "float64",
    FieldDescriptor.TYPE_BOOL: "bool_",
    FieldDescriptor.TYPE_STRING: "string",
    FieldDescriptor.TYPE_BYTES: "binary",
}
