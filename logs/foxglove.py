"""The well-known Foxglove schemas that we write, as protobuf: one table of fields, and message classes made of it.

Foxglove, Lichtblick, Rerun and PlotJuggler know them by their names (``foxglove.PoseInFrame``), so that they show a
recording with no plug-in. Names, numbers and types are those of the published protobuf definitions
(`@foxglove/schemas` 2.1, MIT); the tests hold the table against `foxglove-schemas-protobuf`. Why it is a table of our
own is in docs/decisions/0012.
"""

from typing import Any, Final

from google.protobuf import descriptor_pb2, descriptor_pool, duration_pb2, message_factory, timestamp_pb2

PACKAGE = "foxglove"

_ENUMS: Final = {
    "Log.Level": ("UNKNOWN", "DEBUG", "INFO", "WARNING", "ERROR", "FATAL"),
    "LocationFix.PositionCovarianceType": ("UNKNOWN", "APPROXIMATED", "DIAGONAL_KNOWN", "KNOWN"),
    "LinePrimitive.Type": ("LINE_STRIP", "LINE_LOOP", "LINE_LIST"),
    "SceneEntityDeletion.Type": ("MATCHING_ID", "ALL"),
}
# Fields in the order of their numbers, from 1. `*`: repeated; `?`: optional with presence.
_FIELDS: Final = {
    "Vector3": "x:double y:double z:double",
    "Point3": "x:double y:double z:double",
    "Quaternion": "x:double y:double z:double w:double",
    "Color": "r:double g:double b:double a:double",
    "Pose": "position:Vector3 orientation:Quaternion",
    "KeyValuePair": "key:string value:string",
    "LocationFix": "latitude:double longitude:double altitude:double position_covariance:double*"
    " position_covariance_type:LocationFix.PositionCovarianceType timestamp:Timestamp frame_id:string color:Color?"
    " metadata:KeyValuePair* heading:double? velocity:Vector3?",
    "FrameTransform": "timestamp:Timestamp parent_frame_id:string child_frame_id:string translation:Vector3"
    " rotation:Quaternion",
    "PoseInFrame": "timestamp:Timestamp frame_id:string pose:Pose",
    "PosesInFrame": "timestamp:Timestamp frame_id:string poses:Pose*",
    "Log": "timestamp:Timestamp level:Log.Level message:string name:string file:string line:fixed32",
    "ArrowPrimitive": "pose:Pose shaft_length:double shaft_diameter:double head_length:double head_diameter:double"
    " color:Color",
    "CubePrimitive": "pose:Pose size:Vector3 color:Color",
    "SpherePrimitive": "pose:Pose size:Vector3 color:Color",
    "CylinderPrimitive": "pose:Pose size:Vector3 bottom_scale:double top_scale:double color:Color",
    "LinePrimitive": "type:LinePrimitive.Type pose:Pose thickness:double scale_invariant:bool points:Point3*"
    " color:Color colors:Color* indices:fixed32*",
    "TriangleListPrimitive": "pose:Pose points:Point3* color:Color colors:Color* indices:fixed32*",
    "TextPrimitive": "pose:Pose billboard:bool font_size:double scale_invariant:bool color:Color text:string",
    "ModelPrimitive": "pose:Pose scale:Vector3 color:Color override_color:bool url:string media_type:string data:bytes",
    "SceneEntity": "timestamp:Timestamp frame_id:string id:string lifetime:Duration frame_locked:bool"
    " metadata:KeyValuePair* arrows:ArrowPrimitive* cubes:CubePrimitive* spheres:SpherePrimitive*"
    " cylinders:CylinderPrimitive* lines:LinePrimitive* triangles:TriangleListPrimitive* texts:TextPrimitive*"
    " models:ModelPrimitive*",
    "SceneEntityDeletion": "timestamp:Timestamp type:SceneEntityDeletion.Type id:string",
    "SceneUpdate": "deletions:SceneEntityDeletion* entities:SceneEntity*",
}

_Field = descriptor_pb2.FieldDescriptorProto
_SCALARS: Final = {
    "double": _Field.TYPE_DOUBLE,
    "fixed32": _Field.TYPE_FIXED32,
    "bool": _Field.TYPE_BOOL,
    "string": _Field.TYPE_STRING,
    "bytes": _Field.TYPE_BYTES,
}
_WELL_KNOWN: Final = {"Timestamp": timestamp_pb2.DESCRIPTOR, "Duration": duration_pb2.DESCRIPTOR}


def _descriptor_set() -> descriptor_pb2.FileDescriptorSet:
    """All of them in one file, and the two of Google's that they are made with."""
    files = descriptor_pb2.FileDescriptorSet()
    for known in _WELL_KNOWN.values():
        known.CopyToProto(files.file.add())
    names = [known.name for known in _WELL_KNOWN.values()]
    ours = files.file.add(name=f"{PACKAGE}.proto", package=PACKAGE, syntax="proto3", dependency=names)
    for name, entries in _FIELDS.items():
        message = ours.message_type.add(name=name)
        for enum, values in _ENUMS.items():
            if enum.startswith(f"{name}."):
                own = message.enum_type.add(name=enum.partition(".")[2])
                for number, value in enumerate(values):
                    own.value.add(name=value, number=number)
        for number, entry in enumerate(entries.split(), start=1):
            _add_field(message, number, entry)
    return files


def _add_field(message: descriptor_pb2.DescriptorProto, number: int, entry: str) -> None:
    name, _, kind = entry.partition(":")
    label = _Field.LABEL_REPEATED if kind.endswith("*") else _Field.LABEL_OPTIONAL
    field = message.field.add(name=name, number=number, label=label)
    if kind.endswith("?"):  # presence is a union of one, by protobuf's own convention
        field.proto3_optional, field.oneof_index = True, len(message.oneof_decl)
        message.oneof_decl.add(name=f"_{name}")
    kind = kind.rstrip("*?")
    if kind in _SCALARS:
        field.type = _SCALARS[kind]
        return
    field.type = _Field.TYPE_ENUM if kind in _ENUMS else _Field.TYPE_MESSAGE
    field.type_name = f".google.protobuf.{kind}" if kind in _WELL_KNOWN else f".{PACKAGE}.{kind}"


_SET = _descriptor_set()
DESCRIPTOR_SET: bytes = _SET.SerializeToString(deterministic=True)
"""Serialized FileDescriptorSet of all of them; what an MCAP schema holds."""

_pool = descriptor_pool.DescriptorPool()
for _file in _SET.file:
    _pool.Add(_file)


def _class(name: str) -> Any:
    return message_factory.GetMessageClass(_pool.FindMessageTypeByName(name))


Timestamp, Duration = (_class(f"google.protobuf.{name}") for name in _WELL_KNOWN)
CLASSES: Final[dict[str, Any]] = {name: _class(f"{PACKAGE}.{name}") for name in _FIELDS}
"""Message classes by name, without the package."""


def timestamp(ns: int) -> Any:
    """A time [ns] as these schemas have it."""
    return Timestamp(seconds=ns // 1_000_000_000, nanos=ns % 1_000_000_000)
