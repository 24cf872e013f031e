"""The parameter file and the parameters' description, against hand-worked bytes and other people's decoder."""

import json
import struct

import pytest
from pymavlink.mavftp import MAVFTP

from fakevehicle.param_pack import pack
from fakevehicle.params import Parameter, ParameterSet, ParameterType
from fakevehicle.services.metadata import GENERAL, PARAMETERS, Metadata
from fakevehicle.vehicle import PARAMETERS as ALL

THREE = (
    Parameter("MPC_XY_P", 0.5, 0, 2, "1/s", "gain"),
    Parameter("MPC_XY_CRUISE", 5.0, 0, 20, "m/s", "speed"),
    Parameter("MAV_SYS_ID", 1, 1, 255, "", "id", ParameterType.INT32),
)


def test_the_bytes_are_as_worked_by_hand() -> None:
    parameters = ParameterSet(THREE, {"MPC_XY_P": 1.0})
    whole = bytes.fromhex(
        "1b67 0300 0300"  # magic, three of three
        "03 90 4d41565f5359535f4944 01000000"  # int32, ten new characters and none common: MAV_SYS_ID, 1
        "04 b1 50435f58595f435255495345 0000a040"  # float, twelve new after one common: M + PC_XY_CRUISE, 5.0
        "04 07 50 0000803f"  # one new after seven common: MPC_XY_ + P, 1.0
    )
    assert pack(parameters) == whole
    with_defaults = bytes.fromhex("1c67") + whole[2:-7] + bytes.fromhex("14 07 50 0000803f 0000003f")
    assert pack(parameters, "withdefaults=1") == with_defaults
    assert pack(parameters, "start=2") == bytes.fromhex("1b67 0100 0300 04 70 4d50435f58595f50 0000803f")
    assert pack(parameters, "start=9&count=1") == bytes.fromhex("1b67 0000 0300")
    assert pack(parameters, "start=-1&count=%00&withdefaults=yes") == whole


@pytest.mark.parametrize("query", ["", "withdefaults=1"])
def test_pymavlink_decodes_every_parameter_of_the_vehicle(query: str) -> None:
    changed = {"MIS_TAKEOFF_ALT": 7.5, "COM_OBL_RC_ACT": 4}
    parameters = ParameterSet(ALL, changed)
    decoded = MAVFTP.ftp_param_decode(pack(parameters, query))
    kinds = {3: ParameterType.INT32, 4: ParameterType.REAL32}
    found = [(name.decode(), value, kinds[kind]) for name, value, kind in decoded.params]
    assert found == [(name, parameters[name], parameters.describe(name).type) for name in parameters]
    if query:
        differs = {n: d for (n, v, _), (_, d, _) in zip(decoded.params, decoded.defaults, strict=True) if v != d}
        assert differs == {b"MIS_TAKEOFF_ALT": 2.5, b"COM_OBL_RC_ACT": 5}


def crc_register(data: bytes) -> int:
    register = 0
    for byte in data:
        register ^= byte
        for _ in range(8):
            register = register >> 1 ^ (0xEDB88320 if register & 1 else 0)
    return register


def test_the_message_leads_to_the_general_file_and_that_to_the_description_of_every_parameter() -> None:
    parameters = ParameterSet(ALL)
    metadata = Metadata(parameters, frozenset({"MAV_SYS_ID"}), lambda: 1_234_567)
    number, extra, payload = metadata.component_metadata()
    assert (number, extra, len(payload)) == (397, 182, 108)
    time_ms, crc = struct.unpack_from("<II", payload)
    assert (time_ms, payload[8:].rstrip(b"\0")) == (1234, b"mftp:///" + GENERAL.encode())
    general = metadata.files[GENERAL]("")
    assert crc == crc_register(general)
    (kind,) = json.loads(general)["metadataTypes"]
    described = metadata.files[PARAMETERS]("")
    assert kind == {"type": 1, "uri": "mftp:///" + PARAMETERS, "fileCrc": crc_register(described)}
    told = {p["name"]: p for p in json.loads(described)["parameters"]}
    assert set(told) == {p.name for p in ALL}
    for p in ALL:
        one = told[p.name]
        assert one["type"] == ("Float" if p.type is ParameterType.REAL32 else "Int32")
        assert (one["default"], one["min"], one["max"]) == (p.default, p.minimum, p.maximum)
        assert (one.get("units", ""), one["shortDesc"]) == (p.unit, p.description)
    assert told["MAV_SYS_ID"]["longDesc"] == "Fixed at the start."
