"""Our own records, as protobuf messages: what a companion core takes and gives, and what a simulator knows.

Every record is a frozen dataclass, and the protobuf schema is read off its fields, so there is one statement of each:

    int -> int64    float -> double    bool -> bool    str -> string    tuple[float, ...] -> repeated double (packed)

Doubles travel bit for bit, so a re-run is fed exactly what the core was fed. Field numbers are the order of the
fields: add new ones at the end, with a default; never reorder, remove or retype (then raise `SCHEMA_VERSION`).
"""

from dataclasses import dataclass, fields
from typing import Any, TypeVar

from google.protobuf import descriptor_pb2, descriptor_pool, message_factory

SCHEMA_VERSION = 1
"""Written into every recording; a reader refuses a newer one."""

PACKAGE = "companion"


@dataclass(frozen=True, slots=True)
class Tick:
    """One call of the core's step: its time [us], how many inputs and outputs crossed the seam, and the inputs' digest.

    The digest is `inputs_digest` of the tick's inputs; 0 where none was taken.
    """

    now_us: int
    inputs: int
    outputs: int
    inputs_crc32: int = 0


@dataclass(frozen=True, slots=True)
class PlanWanted:
    """Output: plan this. Vectors are (3,) in the planner's frame [m], [m/s], [m/s^2]; empty means at rest."""

    request_id: int
    start: tuple[float, ...]
    goal: tuple[float, ...]
    start_velocity: tuple[float, ...] = ()
    start_acceleration: tuple[float, ...] = ()
    speed: float = 0.0  # [m/s] limit
    acceleration: float = 0.0  # [m/s^2] limit
    jerk: float = 0.0  # [m/s^3] limit
    radius: float = 0.0  # [m]
    seed: int = 0
    method: str = ""
    via: tuple[float, ...] = ()  # (3 n,) points on the way [m]


@dataclass(frozen=True, slots=True)
class PlanReady:
    """Input: the answer to one `PlanWanted`; the trajectory's control points are flattened, x y z after one another."""

    request_id: int
    ok: bool
    error: str = ""  # name of the planner's error type
    text: str = ""
    control_points: tuple[float, ...] = ()  # (3 n,) [m]
    knots: tuple[float, ...] = ()  # (n + 4,) [s]
    length: float = 0.0  # [m]
    clearance: float = 0.0  # [m]
    certified: bool = False
    cpu_ms: float = 0.0
    method: str = ""


@dataclass(frozen=True, slots=True)
class OperatorCommand:
    """Input: what a person asked for, at the keyboard or from a ground station."""

    name: str
    values: tuple[float, ...] = ()
    source: str = ""


@dataclass(frozen=True, slots=True)
class Note:
    """Output: something worth telling; `level` is a MAV_SEVERITY (3 error, 4 warning, 6 info)."""

    level: int
    phase: str
    text: str


@dataclass(frozen=True, slots=True)
class Reference:
    """Output: where the vehicle should be now; (3,) each [m], [m/s], [m/s^2], yaw [rad]."""

    phase: str
    position: tuple[float, ...]
    velocity: tuple[float, ...]
    acceleration: tuple[float, ...]
    yaw: float


@dataclass(frozen=True, slots=True)
class Truth:
    """What the simulator's physics knew: NED from home [m], [m/s], [m/s^2]; wxyz; body rates and rotors [rad/s]."""

    position_n: tuple[float, ...]
    velocity_n: tuple[float, ...]
    acceleration_n: tuple[float, ...]
    q_nb: tuple[float, ...]
    omega_b: tuple[float, ...]
    rotor_speed: tuple[float, ...]
    wind_n: tuple[float, ...]
    on_ground: bool = False


@dataclass(frozen=True, slots=True)
class ReplanWanted:
    """Output: look at what is flown again; times are the flight clock's. The map is kept by its checksum only."""

    request_id: int
    now_us: int
    switch_us: int  # the answer is flown from then on
    period_us: int
    goal: tuple[float, ...]  # (3,) [m]
    speed: float  # [m/s] limit
    acceleration: float  # [m/s^2] limit
    jerk: float  # [m/s^3] limit
    radius: float  # [m]
    seed: int
    control_points: tuple[float, ...]  # (3 n,) of what is flown [m]
    knots: tuple[float, ...]  # (n + 4,) [s]
    start_us: int
    to_goal: bool
    fresh: bool
    map_version: int = -1  # -1: the map is what it was
    map_crc32: int = 0
    map_runs: int = 0
    movers: tuple[float, ...] = ()  # (10 k,) centre, velocity, radius, growth, stamp, until each
    cold: bool = False  # a plan from scratch, from where what is flown is at `switch_us`


@dataclass(frozen=True, slots=True)
class ReplanReady:
    """Input: the answer to one `ReplanWanted`; no knots: what was flown goes on, or there is no stop."""

    request_id: int
    kind: str
    control_points: tuple[float, ...] = ()  # (3 n,) [m]
    knots: tuple[float, ...] = ()  # (n + 4,) [s]
    start_us: int = 0
    to_goal: bool = False
    certified: bool = False
    clearance: float = 0.0  # [m]
    backup_control_points: tuple[float, ...] = ()
    backup_knots: tuple[float, ...] = ()
    backup_start_us: int = 0
    reason: str = ""
    cpu_ms: float = 0.0


@dataclass(frozen=True, slots=True)
class Loss:
    """A counter of what is lost, when it has changed: `autopilot.kernel_drops`, `autopilot.1.1.sequence_gaps` ..."""

    of: str
    total: int  # since the recording began


@dataclass(frozen=True, slots=True)
class EstimatorBegin:
    """The bundled vehicle's estimator begins (`fresh`), or has other parameters from the next inputs on."""

    now_us: int  # the vehicle's time since it booted
    fresh: bool
    parameters: str  # values by name, as JSON
    field_n: tuple[float, ...]  # (3,) [gauss]
    gravity: float  # [m/s^2]
    period_us: int  # of a tick


@dataclass(frozen=True, slots=True)
class EstimatorInputs:
    """What it took in the n ticks up to `now_us`; `samples` are rows of 15, as `fakevehicle.sensorlog` says."""

    now_us: int
    imu: tuple[float, ...]  # (6 n,) body rate and specific force [rad/s], [m/s^2]
    flying: tuple[float, ...]  # (n,) whether the motors carried it
    samples: tuple[float, ...] = ()  # (15 k,) of GPS, barometer and magnetometer, in the order they arrived


@dataclass(frozen=True, slots=True)
class EstimatorState:
    """What it made of them, as of `now_us`; NIS of each sensor's newest measurement."""

    now_us: int
    position_n: tuple[float, ...]  # (3,) from its origin [m]
    velocity_n: tuple[float, ...]
    acceleration_n: tuple[float, ...]
    q_nb: tuple[float, ...]
    omega_b: tuple[float, ...]
    gyro_bias: tuple[float, ...]
    accel_bias: tuple[float, ...]
    sigma: tuple[float, ...] = ()  # (15,) 1 sigma of attitude, velocity, position, gyro and accelerometer bias
    resets: int = 0
    sensors: str = ""  # names, with commas between them; the columns beside are in this order
    nis: tuple[float, ...] = ()
    dof: tuple[float, ...] = ()
    accepted: tuple[float, ...] = ()


@dataclass(frozen=True, slots=True)
class Tracking:
    """How far the vehicle says it is from where it should be: the distance, and the way there, NED [m]."""

    error: float
    north: float
    east: float
    down: float


Record = (
    Tick
    | PlanWanted
    | PlanReady
    | OperatorCommand
    | Note
    | Reference
    | Truth
    | ReplanWanted
    | ReplanReady
    | Loss
    | EstimatorBegin
    | EstimatorInputs
    | EstimatorState
    | Tracking
)
RecordT = TypeVar("RecordT", bound=Record)

RECORDS: tuple[type[Record], ...] = (
    Tick,
    PlanWanted,
    PlanReady,
    OperatorCommand,
    Note,
    Reference,
    Truth,
    ReplanWanted,
    ReplanReady,
    Loss,
    EstimatorBegin,
    EstimatorInputs,
    EstimatorState,
    Tracking,
)
INPUTS: tuple[type[Record], ...] = (PlanReady, OperatorCommand, ReplanReady)
OUTPUTS: tuple[type[Record], ...] = (PlanWanted, Note, Reference, ReplanWanted)
ASIDE: tuple[type[Record], ...] = (Loss, EstimatorBegin, EstimatorInputs, EstimatorState, Tracking)
"""Records of the recorder itself and of the vehicle's inside, which did not cross the seam."""

TOPICS: dict[type[Record], str] = {
    Tick: "/companion/tick",
    PlanWanted: "/companion/plan_wanted",
    PlanReady: "/companion/plan_ready",
    OperatorCommand: "/companion/operator",
    Note: "/companion/note",
    Reference: "/companion/reference",
    Truth: "/vehicle/truth",
    ReplanWanted: "/companion/replan_wanted",
    ReplanReady: "/companion/replan_ready",
    Loss: "/companion/losses",
    Tracking: "/companion/tracking",
    EstimatorBegin: "/vehicle/estimator/begin",
    EstimatorInputs: "/vehicle/estimator/inputs",
    EstimatorState: "/vehicle/estimator/state",
}
"""Where each record is kept, unless a driver says otherwise."""

_Field = descriptor_pb2.FieldDescriptorProto
_TYPES: dict[Any, tuple["_Field.Type.ValueType", bool]] = {
    int: (_Field.TYPE_INT64, False),
    float: (_Field.TYPE_DOUBLE, False),
    bool: (_Field.TYPE_BOOL, False),
    str: (_Field.TYPE_STRING, False),
    tuple[float, ...]: (_Field.TYPE_DOUBLE, True),
}


def _descriptor_set() -> descriptor_pb2.FileDescriptorSet:
    """The schema of every record, read off the dataclasses."""
    file = descriptor_pb2.FileDescriptorProto(name=f"{PACKAGE}.proto", package=PACKAGE, syntax="proto3")
    for kind in RECORDS:
        message = file.message_type.add(name=kind.__name__)
        for number, entry in enumerate(fields(kind), start=1):
            type_, repeated = _TYPES[entry.type]
            label = _Field.LABEL_REPEATED if repeated else _Field.LABEL_OPTIONAL
            message.field.add(name=entry.name, number=number, type=type_, label=label)
    return descriptor_pb2.FileDescriptorSet(file=[file])


_SET = _descriptor_set()
DESCRIPTOR_SET: bytes = _SET.SerializeToString(deterministic=True)
"""Serialized FileDescriptorSet with all our messages; what an MCAP schema holds."""

_pool = descriptor_pool.DescriptorPool()
_pool.Add(_SET.file[0])
_MESSAGES: dict[type[Any], type[Any]] = {
    kind: message_factory.GetMessageClass(_pool.FindMessageTypeByName(schema))
    for kind, schema in ((kind, f"{PACKAGE}.{kind.__name__}") for kind in RECORDS)
}
_NAMES: dict[type[Any], tuple[str, ...]] = {kind: tuple(entry.name for entry in fields(kind)) for kind in RECORDS}
_REPEATED: dict[type[Any], frozenset[str]] = {
    kind: frozenset(entry.name for entry in fields(kind) if _TYPES[entry.type][1]) for kind in RECORDS
}
_BY_SCHEMA: dict[str, type[Record]] = {f"{PACKAGE}.{kind.__name__}": kind for kind in RECORDS}


def schema_name(kind: type[Any]) -> str:
    """Full protobuf name of a record type, such as ``companion.Tick``."""
    return f"{PACKAGE}.{kind.__name__}"


def kind_of(name: str) -> type[Record] | None:
    """The record type of a full protobuf name; None if it is not one of ours."""
    return _BY_SCHEMA.get(name)


def encode(record: Record) -> bytes:
    """Protobuf bytes of a record; equal records give equal bytes."""
    kind = type(record)
    message = _MESSAGES[kind](**{name: getattr(record, name) for name in _NAMES[kind]})
    data: bytes = message.SerializeToString(deterministic=True)
    return data


def decode(kind: type[RecordT], data: bytes) -> RecordT:
    """The record in protobuf bytes; fields of later versions are ignored, absent ones are zero or empty.

    Raises
    ------
    ValueError    The bytes are not a protobuf message of this kind.
    """
    message = _MESSAGES[kind]()
    try:
        message.ParseFromString(data)
    except Exception as error:  # google.protobuf.message.DecodeError, whose stubs are untyped
        raise ValueError(f"{len(data)} bytes are not a {schema_name(kind)}: {error}") from error
    repeated = _REPEATED[kind]
    values: dict[str, Any] = {
        name: tuple(getattr(message, name)) if name in repeated else getattr(message, name) for name in _NAMES[kind]
    }
    return kind(**values)
