"""Parameters of vehicles: what PARAM_VALUE told, and the file of them that every part of a recording can hold.

The file is of QGroundControl's form, .params: a line each of system, component, name, value and MAV_PARAM_TYPE, with
tabs between (https://docs.qgroundcontrol.com/master/en/qgc-dev-guide/file_formats/parameters.html). QGroundControl and
MAVProxy load it, and so does `fakevehicle --params`.

PX4 packs an integer's bytes into the float field, ArduPilot sends the float nearest to it
(https://mavlink.io/en/services/parameter.html#parameter_encoding); who sends how, its HEARTBEAT tells.
"""

import re
import struct
from collections.abc import Mapping
from contextlib import suppress

from logs.container import Attachment
from logs.rows import shortest
from wire.dialect import mavlink

ATTACHMENT = "vehicle.params"
"""Name of the file in a recording."""
MOST = 20_000
"""Parameters kept; an autopilot has a thousand or two."""
MOST_FILE_BYTES = 4_000_000
HEARTBEAT, PARAM_VALUE = 0, 22
PARAMETER_MESSAGES = (HEARTBEAT, PARAM_VALUE)
HASH_CHECK = "_HASH_CHECK"
"""PX4's checksum over the others, told as if it were one."""
_FLOAT = struct.Struct("<f")
_INTEGERS = {1: "<Bxxx", 2: "<bxxx", 3: "<Hxx", 4: "<hxx", 5: "<I", 6: "<i"}  # MAV_PARAM_TYPE
_VALUE = struct.Struct("<4sHH16sB")
_NAME = re.compile(r"[!-~]{1,16}")
_HEAD = "# Onboard parameters\n#\n# Vehicle-Id\tComponent-Id\tName\tValue\tType\n"

Key = tuple[int, int, str]
"""System, component, name."""


class ToldParameters:
    """The newest value of each parameter.

    Attributes
    ----------
    changes : how often anything became known or another.
    """

    def __init__(self) -> None:
        self.changes = 0
        self._values: dict[Key, tuple[float, int]] = {}
        self._raw: dict[Key, tuple[bytes, int]] = {}  # told, in whatever way integers are packed
        self._bytewise: set[int] = set()

    def heard(self, message_id: int, system: int, component: int, payload: bytes) -> None:
        """A packet of one of the two kinds; its payload may be cut short, as MAVLink 2 does it."""
        if message_id == HEARTBEAT:
            if payload[5:6] == _PX4:
                self.is_px4(system)
        elif len(payload) <= _VALUE.size:
            value, _, _, name, kind = _VALUE.unpack(payload.ljust(_VALUE.size, b"\0"))
            self.told((system, component, name.partition(b"\0")[0].decode("ascii", "replace")), value, kind)

    def is_px4(self, system: int) -> None:
        """A system packs integers as PX4 does."""
        self._bytewise.add(system)

    def told(self, key: Key, value: bytes, kind: int) -> None:
        """A PARAM_VALUE: the four bytes of its value, and its MAV_PARAM_TYPE; what can be no name is passed over."""
        if key[2] == HASH_CHECK or self._raw.get(key) == (value, kind) or not _NAME.fullmatch(key[2]):
            return
        if key not in self._raw and len(self._raw) + len(self._values) >= MOST:
            return
        self._raw[key] = value, kind
        self.changes += 1

    def read(self, file: bytes) -> None:
        """The values in a file; lines that are none are passed over, and what was told since holds."""
        for line in file[:MOST_FILE_BYTES].decode("utf-8", "replace").splitlines():
            try:
                system, component, name, value, kind = line.split("\t")
                key = int(system), int(component), name
                if key in self._values or len(self._raw) + len(self._values) < MOST:
                    self._values[key] = _exact(float(value), int(kind)), int(kind)
            except ValueError:  # a comment
                continue

    def values(self) -> dict[Key, float]:
        """What each is, integers exact."""
        return {key: value for key, (value, _) in self._all().items()}

    def attachment(self) -> Attachment:
        """All of them as a file."""
        return params_file(self._all())

    def packed(self) -> dict[Key, tuple[bytes, int]]:
        """As PARAM_VALUEs hold them: four bytes, integers as their system packs them, and MAV_PARAM_TYPE.

        What was read and fits into none is left out.
        """
        packed = dict[Key, tuple[bytes, int]]()
        for key, (value, kind) in self._values.items():
            form = _INTEGERS.get(kind) if key[0] in self._bytewise else None
            if key[2] == HASH_CHECK or not _NAME.fullmatch(key[2]) or not 0 <= kind <= 0xFF:
                continue
            with suppress(struct.error, OverflowError):  # more than such a parameter can be
                packed[key] = struct.pack(form or _FLOAT.format, value), kind
        return packed | self._raw

    def _all(self) -> dict[Key, tuple[float, int]]:
        told = {key: (self._value(key[0], *raw), raw[1]) for key, raw in self._raw.items()}
        return self._values | told

    def _value(self, system: int, value: bytes, kind: int) -> float:
        unpack = _INTEGERS.get(kind) if system in self._bytewise else None
        if unpack is not None:
            return int(struct.unpack(unpack, value)[0])
        return _exact(shortest(_FLOAT.unpack(value)[0]), kind)


def _exact(value: float, kind: int) -> float:
    """An integer as one, however it was sent or written; `kind`: its MAV_PARAM_TYPE."""
    return int(value) if kind in _INTEGERS and value.is_integer() else value


def params_file(values: Mapping[Key, tuple[float, int]]) -> Attachment:
    """Values with their MAV_PARAM_TYPE as a file to be attached."""
    lines = (
        f"{system}\t{component}\t{name}\t{_exact(float(value), kind)}\t{kind}\n"
        for (system, component, name), (value, kind) in sorted(values.items())
    )
    return Attachment(ATTACHMENT, "text/plain", (_HEAD + "".join(lines)).encode())


_PX4 = bytes((mavlink.MAV_AUTOPILOT_PX4,))
