"""Actuators: what the motors were told, how fast they turned, how often they could do no more; and the battery."""

import numpy as np

from logs.report import contract as c
from logs.report.columns import FloatArray
from logs.report.flight import Flight
from logs.report.part import Part, Surroundings, TableRows, lines

LEAST_US, MOST_US = 1000.0, 2000.0
"""Pulse widths of nothing and everything [us]."""
SHARE = 0.01
"""Of the range: so near to its end is saturated."""
MOTORS = 8


def actuators_part(flight: Flight, around: Surroundings) -> Part:
    """Outputs, saturation, rotor speeds, battery."""
    part = Part()
    _servos(flight, part)
    _outputs(flight, part)
    _rotors(flight, part)
    if part.empty:
        part.missing = "neither SERVO_OUTPUT_RAW, ACTUATOR_OUTPUT_STATUS nor rotor speeds were told"
    _battery(flight, part)
    return part


def _servos(flight: Flight, part: Part) -> None:
    rows = flight.traffic.told(36)
    if len(rows) < 2:
        return
    rows = rows[rows["m"]["port"] == rows["m"]["port"][0]]
    columns = {f"servo {k}": rows["m"][f"servo{k}_raw"].astype(np.float64) for k in range(1, MOTORS + 1)}
    columns = {name: np.where((v == 0) | (v == 65535), np.nan, v) for name, v in columns.items()}
    columns = _used(columns)
    t = flight.times(rows)
    series = lines(t, columns, "step")
    if series:
        levels = (("least", LEAST_US), ("most", MOST_US))
        part.plots.append(c.Plot("servos", "actuators", "Servo outputs", "µs", series, levels))
        _saturation(flight, part, t, columns, LEAST_US, MOST_US, "Servo outputs", "µs")


def _used(columns: dict[str, FloatArray]) -> dict[str, FloatArray]:
    """Those that ever change, if any does: the others drive nothing."""
    finite = {name: column[np.isfinite(column)] for name, column in columns.items()}
    moving = {name: columns[name] for name, column in finite.items() if len(column) and np.ptp(column) > 0.0}
    return moving or columns


def _outputs(flight: Flight, part: Part) -> None:
    rows = flight.traffic.told(375)
    if len(rows) < 2:
        return
    used = min(int(rows["m"]["active"].max()).bit_length(), 16)
    columns = {f"actuator {k + 1}": rows["m"]["actuator"][:, k].astype(np.float64) for k in range(used)}
    columns = _used(columns)
    t = flight.times(rows)
    series = lines(t, columns, "step")
    if series:
        part.plots.append(c.Plot("actuators", "actuators", "Actuator outputs", "", series))
        top = max(float(np.nanmax(v)) for v in columns.values())
        low, high = (LEAST_US, MOST_US) if top > 2.0 else (0.0, 1.0)
        _saturation(flight, part, t, columns, low, high, "Actuator outputs", "")


def _rotors(flight: Flight, part: Part) -> None:
    rows = flight.traffic.truths
    if len(rows) > 1:
        t = (rows[:, 0] - flight.t0_ns) / 1e9
        series = lines(t, {f"rotor {k + 1}": rows[:, 14 + k] for k in range(8)})
        if series:
            part.plots.append(c.Plot("rotors", "actuators", "Rotor speeds (truth)", "rad/s", series))


def _saturation(
    flight: Flight,
    part: Part,
    t: FloatArray,
    columns: dict[str, FloatArray],
    low: float,
    high: float,
    what: str,
    unit: str,
) -> None:
    """How much of the time in the air each output was at an end of its range."""
    aloft = np.ones(len(t), dtype=bool)
    if flight.aloft is not None:
        aloft = (t >= flight.aloft[0]) & (t <= flight.aloft[1])
    margin = SHARE * (high - low)
    rows: TableRows = []
    for name, column in columns.items():
        values = column[aloft & np.isfinite(column)]
        if len(values):
            at_most, at_least = (
                100 * float(part_.mean()) for part_ in (values >= high - margin, values <= low + margin)
            )
            figures = [float(values.min()), float(np.median(values)), float(values.max())]
            rows.append([name, *(round(v, 3) for v in figures), round(at_most, 2), round(at_least, 2)])
    if rows:
        of = f" [{unit}]" if unit else ""
        heads = ("output", f"least{of}", f"p50{of}", f"most{of}", "at its most [%]", "at its least [%]")
        part.tables.append(c.Table("actuators", f"{what} in the air", heads, rows))


def _battery(flight: Flight, part: Part) -> None:
    rows = flight.traffic.told(1)
    if len(rows) < 2:
        return
    m, t = rows["m"], flight.times(rows)
    voltage = np.where(m["voltage_battery"] == 65535, np.nan, m["voltage_battery"] / 1000.0)
    current = np.where(m["current_battery"] < 0, np.nan, m["current_battery"] / 100.0)
    left = np.where(m["battery_remaining"] < 0, np.nan, m["battery_remaining"].astype(np.float64))
    if np.nan_to_num(voltage).any():
        part.plots.append(c.Plot("battery", "actuators", "Battery", "V", lines(t, {"voltage": voltage}, "step")))
    if np.nan_to_num(current).any():
        part.plots.append(c.Plot("current", "actuators", "Current", "A", lines(t, {"current": current}, "step")))
    if np.nan_to_num(left).any() and np.nanmin(left) < np.nanmax(left):
        part.plots.append(c.Plot("charge", "actuators", "Charge left", "%", lines(t, {"left": left}, "step")))
