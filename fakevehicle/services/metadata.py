"""What every parameter means, for machines: COMPONENT_METADATA and the two JSON files it leads to.

A client asks for COMPONENT_METADATA (397) and finds a file's address and checksum in it; that file, "general", names
the "parameter" file, which has name, type, range, unit and description of every parameter. Both are read by MAVLink
FTP. The formats are the Component Metadata Protocol's (https://mavlink.io/en/services/component_information.html),
general.schema.json and parameter.schema.json of mavlink/component_metadata.
"""

import json
from collections.abc import Callable, Mapping

from fakevehicle.codec import Prepared
from fakevehicle.files import OpenFile
from fakevehicle.params import ParameterSet, ParameterType
from fakevehicle.services.ftp import checksum
from fakevehicle.services.service import Builder, Service

COMPONENT_METADATA = 397
_CRC_EXTRA = 182
"""Of COMPONENT_METADATA (uint32 time_boot_ms, uint32 file_crc, char[100] uri); pymavlink's dialects leave it out."""
GENERAL = "etc/extras/component_general.json"
PARAMETERS = "etc/extras/parameters.json"
_TYPE_PARAMETER = 1  # COMP_METADATA_TYPE_PARAMETER
_DECIMALS = 6


class Metadata(Service):
    """Makes the two files and the message that leads to them.

    Parameters
    ----------
    parameters : the vehicle's. What is described does not change while it flies, so the files are made once.
    read_only : names that are fixed for the vehicle's life.
    now_us : the vehicle's clock.
    """

    def __init__(self, parameters: ParameterSet, read_only: frozenset[str], now_us: Callable[[], int]) -> None:
        self._now_us = now_us
        described = [_described(parameters, name, name in read_only) for name in parameters]
        self._parameters = _json({"version": 1, "parameters": described})
        self._general = _json(
            {
                "version": 1,
                "metadataTypes": [
                    {"type": _TYPE_PARAMETER, "uri": _uri(PARAMETERS), "fileCrc": _crc(self._parameters)}
                ],
            }
        )

    @property
    def files(self) -> Mapping[str, Callable[[str], bytes]]:
        """By path, for a `Tree`."""
        return {GENERAL: lambda _query: self._general, PARAMETERS: lambda _query: self._parameters}

    def builders(self) -> Mapping[int, Builder]:
        """By message id."""
        return {COMPONENT_METADATA: self.component_metadata}

    def component_metadata(self) -> Prepared:
        """COMPONENT_METADATA: where the general file is, and its checksum."""
        uri = _uri(GENERAL).encode("ascii").ljust(100, b"\0")
        time_boot_ms = self._now_us() // 1000 & 0xFFFFFFFF
        payload = time_boot_ms.to_bytes(4, "little") + _crc(self._general).to_bytes(4, "little") + uri
        return Prepared(COMPONENT_METADATA, _CRC_EXTRA, payload)


def _described(parameters: ParameterSet, name: str, read_only: bool) -> dict[str, object]:
    """One parameter as parameter.schema.json wants it."""
    p = parameters.describe(name)
    real = p.type is ParameterType.REAL32
    number: Callable[[float], float | int] = float if real else int
    found: dict[str, object] = {
        "name": name,
        "type": "Float" if real else "Int32",
        "shortDesc": p.description,
        "group": name.partition("_")[0],
        "default": number(p.default),
        "min": number(p.minimum),
        "max": number(p.maximum),
    }
    if p.unit:
        found["units"] = p.unit
    if real:
        found["decimalPlaces"] = _DECIMALS
    if read_only:
        found["longDesc"] = "Fixed at the start."  # the format has no word for it
    return found


def _uri(path: str) -> str:
    return f"mftp:///{path}"


def _json(content: object) -> bytes:
    return json.dumps(content, ensure_ascii=True, allow_nan=False, separators=(",", ":")).encode("ascii")


def _crc(data: bytes) -> int:
    return checksum(OpenFile(len(data), lambda offset, size: data[offset : offset + size]))
