"""Writes what a foreign log holds into protobuf channels, with the names and types that the log gives."""

import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import TracebackType
from typing import Any, Self

from google.protobuf import descriptor_pb2, descriptor_pool, message_factory

from logs import schema
from logs.container import Container

_Field = descriptor_pb2.FieldDescriptorProto
KINDS: dict[str, "_Field.Type.ValueType"] = {
    "int": _Field.TYPE_INT64,
    "uint": _Field.TYPE_UINT64,
    "float": _Field.TYPE_FLOAT,
    "double": _Field.TYPE_DOUBLE,
    "bool": _Field.TYPE_BOOL,
    "str": _Field.TYPE_STRING,
}
"""What a field may be."""
_LATEST_NS = (1 << 63) - 1


class Foreign:
    """A recording being made of a foreign log.

    Parameters
    ----------
    about : the table `import`.
    package : of the schemas' names, such as ``px4``.
    """

    def __init__(self, path: Path, package: str, about: Mapping[str, str]) -> None:
        self._file = open(path, "xb", buffering=0)  # noqa: SIM115  closed at the end of the block
        self._package = package
        self._container = Container(self._file)
        self._container.add_metadata("schema", {"version": str(schema.SCHEMA_VERSION)})
        self._container.add_metadata("import", about)
        self._topics: dict[str, tuple[int, Any, tuple[str, ...]]] = {}
        self._schemas: dict[str, tuple[int, Any]] = {}

    def declare(self, topic: str, name: str, fields: Sequence[tuple[str, str, bool]]) -> None:
        """A topic of messages called `name`, whose fields are (name, kind, whether a list)."""
        names: list[str] = []
        for field, _, _ in fields:
            names.append(_unlike(identifier(field), names))
        full = f"{self._package}.{identifier(name)}"
        known = self._schemas.get(full)
        if known is None:
            file = descriptor_pb2.FileDescriptorProto(name=f"{full}.proto", package=self._package, syntax="proto3")
            message = file.message_type.add(name=identifier(name))
            for number, (field, (_, kind, repeated)) in enumerate(zip(names, fields, strict=True), start=1):
                label = _Field.LABEL_REPEATED if repeated else _Field.LABEL_OPTIONAL
                message.field.add(name=field, number=number, type=KINDS[kind], label=label)
            pool = descriptor_pool.DescriptorPool()
            pool.Add(file)
            data = descriptor_pb2.FileDescriptorSet(file=[file]).SerializeToString(deterministic=True)
            number = self._container.add_schema(full, "protobuf", data)
            known = number, message_factory.GetMessageClass(pool.FindMessageTypeByName(full))
            self._schemas[full] = known
        channel = self._container.add_channel(topic, "protobuf", known[0], {})
        self._topics[topic] = channel, known[1], tuple(names)

    def add(self, topic: str, number: int, time_ns: int, values: Sequence[Any]) -> None:
        """One message, its values in the order of the fields."""
        channel, kind, names = self._topics[topic]
        time_ns = min(max(0, time_ns), _LATEST_NS)  # whatever a damaged log says
        data = kind(**dict(zip(names, values, strict=True))).SerializeToString(deterministic=True)
        self._container.add_message(channel, number, time_ns, time_ns, data)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        try:
            if kind is None:
                self._container.finish()
        finally:
            self._file.close()


def identifier(text: str) -> str:
    """A name as protobuf allows it."""
    name = re.sub(r"[^A-Za-z0-9_]", "_", text)[:100]
    return name if re.match(r"[A-Za-z]", name) else f"x{name}"


def _unlike(name: str, taken: Sequence[str]) -> str:
    """The name, or one made of it that is not taken."""
    number, new = 1, name
    while new in taken:
        number += 1
        new = f"{name}_{number}"
    return new
