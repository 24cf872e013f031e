"""Reports of autopilots' own logs, made here byte by byte: a circle at 1 m/s, 0.3 m east of where it should be."""

import math
import struct
from pathlib import Path

import numpy as np
import pytest

from companion.cli.report import write_report
from logs.report import contract as c
from logs.report.foreign import Translator

PERIOD_US, MOMENTS, RADIUS_M, OFF_M = 100_000, 200, 2.0, 0.3


def circle(k: int) -> tuple[float, ...]:
    """Position and velocity NED at the k-th moment: 1 m/s about the origin, 5 m up."""
    angle = k * PERIOD_US / 1e6 / RADIUS_M
    place = (RADIUS_M * math.cos(angle), RADIUS_M * math.sin(angle), -5.0)
    return (*place, -math.sin(angle), math.cos(angle), 0.0)


def px4_log() -> bytes:
    """By https://docs.px4.io/main/en/dev_log/ulog_file_format and the fields of PX4's msg/."""
    position = "float x;float y;float z;float vx;float vy;float vz;bool xy_valid;bool z_valid;"
    kinds = {
        "vehicle_local_position": (position, "<6f2?"),
        "trajectory_setpoint": ("float[3] position;float[3] velocity;float yaw;", "<7f"),
        "vehicle_attitude": ("float[4] q;", "<4f"),
        "vehicle_status": ("uint8_t arming_state;uint8_t nav_state;bool failsafe;", "<BB?"),
        "battery_status": ("float voltage_v;float current_a;float remaining;", "<3f"),
        "actuator_motors": ("float[12] control;", "<12f"),
    }  # fmt: skip
    numbers = {name: k for k, name in enumerate(kinds)}

    def message(kind: bytes, body: bytes) -> bytes:
        return struct.pack("<H", len(body)) + kind + body

    def data(name: str, time_us: int, *values: float) -> bytes:
        return message(b"D", struct.pack("<HQ", numbers[name], time_us) + struct.pack(kinds[name][1], *values))

    parts = [b"ULog\x01\x12\x35\x01" + struct.pack("<Q", 1_000), message(b"B", bytes(40))]
    for name, (fields, _) in kinds.items():
        parts.append(message(b"F", f"{name}:uint64_t timestamp;{fields}".encode()))
    key = b"float MPC_XY_P"
    parts.append(message(b"P", bytes((len(key),)) + key + struct.pack("<f", 0.95)))
    for name, number in numbers.items():
        parts.append(message(b"A", struct.pack("<BH", 0, number) + name.encode()))
    half = math.sqrt(0.5)
    for k in range(MOMENTS):
        t, flying = 1_000_000 + k * PERIOD_US, 20 <= k < 180
        north, east, *rest = circle(k)
        parts += [
            data("vehicle_status", t, 2 if flying else 1, 14 if flying else 4, False),
            data("trajectory_setpoint", t, north, east, *rest, 0.0),
            data("vehicle_local_position", t, north, east + OFF_M, *rest, True, True),
            data("vehicle_attitude", t, half, 0.0, 0.0, half),
            data("battery_status", t, 16.2, 8.5, 0.75),
            data("actuator_motors", t, *[0.5, 0.6, 0.7, 0.8], *[math.nan] * 8),
        ]
        if k == 20:
            parts.append(message(b"L", b"4" + struct.pack("<Q", t) + b"wind is strong"))
    return b"".join(parts)


def ardupilot_log() -> bytes:
    """By AP_Logger's LogStructure.h and https://ardupilot.org/copter/docs/logmessages.html."""
    kinds = {
        "FMT": (128, "BBnNZ", "Type,Length,Name,Format,Columns", "<BB4s16s64s"),
        "PARM": (130, "QNf", "TimeUS,Name,Value", "<Q16sf"),
        "ATT": (131, "Qfff", "TimeUS,Roll,Pitch,Yaw", "<Qfff"),
        "XKF1": (132, "QBffffff", "TimeUS,C,VN,VE,VD,PN,PE,PD", "<QBffffff"),
        "MODE": (133, "QMBB", "TimeUS,Mode,ModeNum,Rsn", "<QBBB"),
        "ARM": (134, "QB", "TimeUS,ArmState", "<QB"),
        "RCOU": (135, "QHHHHHHHH", "TimeUS,C1,C2,C3,C4,C5,C6,C7,C8", "<Q8H"),
        "MSG": (136, "QZ", "TimeUS,Message", "<Q64s"),
    }

    def message(name: str, *values: object) -> bytes:
        return b"\xa3\x95" + bytes((kinds[name][0],)) + struct.pack(kinds[name][3], *values)

    parts = []
    for name, (number, letters, columns, packing) in kinds.items():
        length = 3 + struct.calcsize(packing)
        parts.append(message("FMT", number, length, name.encode(), letters.encode(), columns.encode()))
    parts.append(message("PARM", 900_000, b"PSC_POSXY_P", 1.25))
    for k in range(MOMENTS):
        t = 1_000_000 + k * PERIOD_US
        north, east, down, *velocity = circle(k)
        if k in (0, 20, 180):
            parts += [message("MODE", t, 4, 4 if k == 20 else 0, 1), message("ARM", t, k == 20)]
        parts += [
            message("XKF1", t, 0, *velocity, north, east, down),
            message("XKF1", t, 1, 9.0, 9.0, 9.0, 99.0, 99.0, 99.0),
            message("ATT", t, 3.0, -2.0, 270.0),
            message("RCOU", t, 1500, 1600, 1700, 1800, *[0] * 4),
        ]
    parts.append(message("MSG", 21_000_000, b"ArduCopter V4.6"))
    return b"".join(parts)


@pytest.fixture(scope="module")
def px4(tmp_path_factory: pytest.TempPathFactory) -> c.Report:
    pytest.importorskip("pyulog")
    return made(tmp_path_factory.mktemp("px4") / "log.ulg", px4_log())


@pytest.fixture(scope="module")
def ardupilot(tmp_path_factory: pytest.TempPathFactory) -> c.Report:
    return made(tmp_path_factory.mktemp("ardupilot") / "log.BIN", ardupilot_log())


def made(path: Path, data: bytes) -> c.Report:
    path.write_bytes(data)
    report, _, _ = write_report(path, path.with_suffix(".html"))
    return report


def values(report: c.Report, plot: str, label: str) -> np.ndarray:
    (series,) = [s for p in report.plots if p.id == plot for s in p.series if s.label == label]
    return np.asarray(series.v)


def test_the_path_in_either_log_is_the_circle_that_was_flown(px4: c.Report, ardupilot: c.Report):
    for report, off in ((px4, OFF_M), (ardupilot, 0.0)):
        path = report.scene.path
        north, east, up = (np.asarray(column, dtype=float) for column in (path.n, path.e, path.u))
        assert len(north) == MOMENTS
        assert np.hypot(north, east - off) == pytest.approx(RADIUS_M, abs=1e-5)
        assert up == pytest.approx(5.0)
        assert values(report, "speed", "flown") == pytest.approx(1.0, abs=1e-5)


def test_px4s_own_setpoints_are_what_its_tracking_is_held_against(px4: c.Report):
    (table,) = [t for t in px4.tables if t.section == "tracking"]
    rows = {row[0]: row[1:] for row in table.rows}
    assert rows["to the estimate"] == pytest.approx([OFF_M] * 3, abs=1e-4)
    assert rows["east"] == pytest.approx([OFF_M] * 3, abs=1e-4)
    assert rows["north"] == pytest.approx([0.0] * 3, abs=1e-4)


def test_modes_arming_and_texts_are_on_the_timeline_when_they_were(px4: c.Report, ardupilot: c.Report):
    for report, mode in ((px4, "mode Offboard"), (ardupilot, "mode Guided")):
        told = {event.text: event.t for event in report.events}
        began = told[mode]
        assert told["armed"] == pytest.approx(began, abs=0.01)
        assert told["disarmed"] - began == pytest.approx(16.0, abs=0.01)
    (warning,) = [event for event in px4.events if "wind is strong" in event.text]
    assert warning.level == 4
    assert any("ArduCopter V4.6" in event.text for event in ardupilot.events)


def test_attitude_battery_motors_and_parameters_are_told_in_their_units(px4: c.Report, ardupilot: c.Report):
    assert values(px4, "heading", "yaw") == pytest.approx(90.0, abs=1e-4)
    assert values(px4, "battery", "voltage") == pytest.approx(16.2)
    assert values(px4, "current", "current") == pytest.approx(8.5)
    assert values(px4, "actuators", "actuator 4") == pytest.approx(0.8)
    assert values(ardupilot, "heading", "yaw") == pytest.approx(-90.0, abs=1e-4)
    assert values(ardupilot, "attitude", "roll") == pytest.approx(3.0, abs=1e-5)
    assert values(ardupilot, "servos", "servo 3") == pytest.approx(1700.0)
    for report, name, value in ((px4, "MPC_XY_P", 0.95), (ardupilot, "PSC_POSXY_P", 1.25)):
        (table,) = [t for t in report.tables if t.title.startswith("All")]
        assert table.rows == [[name, value]]


def test_a_log_of_another_version_is_told_as_far_as_it_goes():
    class Empty:
        pass

    translator = Translator()
    for schema in translator._readers:
        assert translator.said(schema, Empty()) == []
