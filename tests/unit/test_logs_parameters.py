"""The vehicle's parameters in a recording, as a file that others load."""

import math
import struct
from pathlib import Path

import pytest

from fakevehicle.config import VehicleConfig
from fakevehicle.param_file import load_parameter_file
from fakevehicle.recordings import FlightLog, parameters_of
from fakevehicle.vehicle import Vehicle
from logs import Attachment, Recording
from logs import parameters as parameters_module
from logs.diff import diff
from logs.parameters import ToldParameters
from logs.parts import Rotation
from logs.recorder import Recorder
from wire.dialect import mavlink as m

PX4 = m.MAVLink_heartbeat_message(2, m.MAV_AUTOPILOT_PX4, 0, 0, 3, 3)
ARDUPILOT = m.MAVLink_heartbeat_message(2, m.MAV_AUTOPILOT_ARDUPILOTMEGA, 0, 0, 3, 3)
FOUR = 5.605193857299268e-45  # as PX4 packs it


def value(name: bytes, number: float, kind: int = 9) -> m.MAVLink_message:
    return m.MAVLink_param_value_message(name, number, kind, 900, 7)


def record(recorder: Recorder, at_s: float, *messages: m.MAVLink_message, system: int = 1) -> None:
    mav = m.MAVLink(None, srcSystem=system, srcComponent=1)
    at_us = round(1e6 * at_s)
    for message in messages:
        data = bytes(message.pack(mav))
        recorder.datagram("autopilot", "rx", data, log_time_ns=at_us * 1000, now_us=at_us, tick=at_us // 20_000)


def lines(file: bytes) -> list[str]:
    return [line for line in file.decode().splitlines() if not line.startswith("#")]


def test_a_part_begins_with_what_was_told_before_it_and_ends_with_what_was_told_in_it(tmp_path: Path) -> None:
    path = tmp_path / "a.mcap"
    with Recorder(path, metadata={}, threaded=False, rotation=Rotation(seconds=2.0)) as recorder:
        record(recorder, 0.1, PX4, value(b"MPC_XY_VEL_MAX", 5.0), value(b"SYS_AUTOSTART", FOUR, 6))
        for k in range(60):
            record(recorder, 0.2 + 0.1 * k, PX4)
            if k == 50:
                record(recorder, 0.2 + 0.1 * k, value(b"MPC_XY_VEL_MAX", 8.1), value(b"_HASH_CHECK", 1.0, 6))
    slow, fast = ["1\t1\tMPC_XY_VEL_MAX\t5.0\t9"], ["1\t1\tMPC_XY_VEL_MAX\t8.1\t9"]
    rest = ["1\t1\tSYS_AUTOSTART\t4\t6"]
    found = []
    for part in Recording.open(path).paths:
        (tmp_path / "alone.mcap").write_bytes(part.read_bytes())
        found.append(lines(Recording.open(tmp_path / "alone.mcap").attachments["vehicle.params"].data))
    assert found == [slow + rest, slow + rest, fast + rest, fast + rest]


def test_an_autopilot_that_sends_the_nearest_float_is_not_read_as_px4_and_systems_are_told_apart(
    tmp_path: Path,
) -> None:
    path = tmp_path / "a.mcap"
    with Recorder(path, metadata={}, threaded=False) as recorder:
        record(recorder, 0.1, ARDUPILOT, value(b"FRAME_CLASS", 1.0, 2), system=3)
        record(recorder, 0.2, PX4, value(b"SYS_AUTOSTART", FOUR, 6), system=4)
    found = lines(Recording.open(path).attachments["vehicle.params"].data)
    assert found == ["3\t1\tFRAME_CLASS\t1\t2", "4\t1\tSYS_AUTOSTART\t4\t6"]


def test_a_recording_of_which_nobody_told_a_parameter_holds_no_file_of_them(tmp_path: Path) -> None:
    with Recorder(tmp_path / "a.mcap", metadata={}, threaded=False) as recorder:
        record(recorder, 0.1, PX4)
    assert not Recording.open(tmp_path / "a.mcap").attachments


@pytest.mark.parametrize("autopilot", ["px4", "ardupilot"])
def test_the_bundled_vehicles_file_is_read_again_by_the_one_that_loads_ground_stations_files(
    tmp_path: Path, autopilot: str
) -> None:
    flown = Vehicle(VehicleConfig(autopilot=autopilot), {"MC_ROLL_P": 7.25, "COM_OBL_RC_ACT": 4})  # type: ignore[arg-type]
    path = tmp_path / "flown.params"
    path.write_bytes(parameters_of(flown).data)
    known = Vehicle(VehicleConfig(autopilot=autopilot)).told_parameters  # type: ignore[arg-type]
    loaded = load_parameter_file(path, known)
    assert not loaded.passed_over
    ours = ToldParameters()
    ours.read(path.read_bytes())
    assert len(ours.values()) == len(known)
    assert len(loaded.values) == len(known)
    assert all(loaded.values[name] == pytest.approx(flown.told_parameters[name], rel=1e-7) for name in known)


def test_two_flights_of_different_gains_differ_by_the_gains_names(tmp_path: Path) -> None:
    paths = []
    for number, gain in enumerate((6.5, 9.0)):
        log = FlightLog(
            tmp_path / str(number), VehicleConfig(), {"MC_ROLL_P": gain}, started_unix_s=0.0, threaded=False
        )
        log.close()
        paths.append(log.path)
    found = diff(*map(Recording.open, paths))
    assert found.parameters == {(1, 1, "MC_ROLL_P"): (6.5, 9.0)}
    assert not found.same


def test_what_was_told_goes_over_what_was_attached(tmp_path: Path) -> None:
    path, attached = (
        tmp_path / "a.mcap",
        Attachment("vehicle.params", "text/plain", b"# x\n1\t1\tA\t1\t6\n1\t1\tB\t0.5\t9\n"),
    )
    with Recorder(path, metadata={}, attachments=[attached], threaded=False) as recorder:
        record(recorder, 0.1, ARDUPILOT, value(b"A", 2.0, 6))
    assert lines(Recording.open(path).attachments["vehicle.params"].data) == ["1\t1\tA\t2\t6", "1\t1\tB\t0.5\t9"]


def test_names_that_can_be_none_and_more_than_there_can_be_are_passed_over(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(parameters_module, "MOST", 3)
    told = ToldParameters()
    for name in (b"A\tB", b"A\nB", b"", b"\xff\xfe", b"A B"):
        told.heard(22, 1, 1, bytes(8) + name.ljust(16, b"\0") + b"\x09")
    assert told.changes == 0
    for k in range(10):
        told.heard(22, 1, 1, bytes(8) + b"P%d" % k)  # cut short, as MAVLink 2 does it
    told.heard(22, 1, 1, bytes(400))
    assert list(told.values()) == [(1, 1, "P0"), (1, 1, "P1"), (1, 1, "P2")]
    told.read(b"1\t1\tQ\t1.0\t9\nrubbish\n1\t1\tP0\tnan\t9\n\xff\xff\t\n")
    assert list(told.values()) == [(1, 1, "P0"), (1, 1, "P1"), (1, 1, "P2")]
    assert not math.isnan(told.values()[1, 1, "P0"])


@pytest.mark.parametrize(("autopilot", "packed"), [(m.MAV_AUTOPILOT_PX4, "<i"), (m.MAV_AUTOPILOT_ARDUPILOTMEGA, "<f")])
def test_a_file_of_what_was_told_is_read_again_as_what_was_told(autopilot: int, packed: str) -> None:
    told, again = ToldParameters(), ToldParameters()
    told.heard(0, 1, 1, bytes(5) + bytes((autopilot,)) + bytes(3))
    for name, value, kind in (("COUNT", struct.pack(packed, -5), 6), ("GAIN", struct.pack("<f", 0.1), 9)):
        told.told((1, 1, name), value, kind)
    again.read(told.attachment().data)
    assert again.values() == told.values() == {(1, 1, "COUNT"): -5, (1, 1, "GAIN"): 0.1}
    assert again.attachment() == told.attachment()
    assert "COUNT\t-5\t6" in lines(told.attachment().data)[0]


def test_integers_in_a_file_may_be_written_as_floats_and_what_is_none_stays_as_it_is() -> None:
    told = ToldParameters()
    told.read(b"1\t1\tA\t5.0\t6\n1\t1\tB\t2147483647\t6\n1\t1\tC\t0.5\t6\n1\t1\tD\tinf\t6\n")
    assert [str(value) for value in told.values().values()] == ["5", "2147483647", "0.5", "inf"]
