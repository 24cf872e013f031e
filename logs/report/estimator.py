"""The vehicle's estimator: what its gates say, and whether its error is what it believes.

A test ratio is the normalised innovation over its gate: above 1 the measurement is refused. ArduPilot's
EKF_STATUS_REPORT tells variances with the same scale. NIS is held against the middle 95 % of chi^2: as the bundled
vehicle's own recording tells it, where its estimator is recorded; else by its ratio, which is sqrt(NIS / gate) with the
gate the quantile of chi^2 at FT_EKF_GATE: NIS = ratio^2 gate. Where truth and a covariance (ODOMETRY) are told, so is
NEES = e^T P^-1 e of the position.
"""

import json

import numpy as np
from scipy.special import chdtri

from logs.report import contract as c
from logs.report.columns import FloatArray
from logs.report.flight import Flight
from logs.report.part import Part, Surroundings, TableRows, lines, row
from logs.schema import EstimatorState

_STATUS = {
    "velocity": "vel_ratio", "horizontal position": "pos_horiz_ratio", "height": "pos_vert_ratio",
    "magnetometer": "mag_ratio", "above ground": "hagl_ratio", "airspeed": "tas_ratio",
}  # fmt: skip
_REPORT = {
    "velocity": "velocity_variance", "horizontal position": "pos_horiz_variance", "height": "pos_vert_variance",
    "magnetometer": "compass_variance", "above ground": "terrain_alt_variance", "airspeed": "airspeed_variance",
}  # fmt: skip
_DOF = {"velocity": 3, "horizontal position": 2, "height": 1, "magnetometer": 3}
"""Of the bundled vehicle's measurements."""
CONVERGED_M = 50.0
"""Accuracies beyond this are those of a filter that knows nothing yet."""
_GATE = 0.999
"""FT_EKF_GATE, unless the recording says otherwise."""


def estimator_part(flight: Flight, around: Surroundings, metadata: dict[str, str] | None) -> Part:
    """Test ratios, NIS, errors against the truth.

    Parameters
    ----------
    metadata : table ``vehicle`` of the bundled vehicle's own recordings; None elsewhere.
    """
    part = Part()
    for number, names, what in ((230, _STATUS, "Test ratios"), (193, _REPORT, "Variances (test ratios)")):
        rows = flight.traffic.told(number)
        if len(rows) < 2:
            continue
        t = flight.times(rows)
        columns = {name: _known(rows["m"][column]) for name, column in names.items()}
        columns = {name: column for name, column in columns.items() if np.nan_to_num(column).any()}
        series = lines(t, columns, "step")
        if series:
            plot = c.Plot(f"ratios-{number}", "estimator", what, "", series, (("refused above", 1.0),))
            part.plots.append(plot)
        figures = [[*row(name, column), int((column > 1.0).sum())] for name, column in columns.items()]
        part.tables.append(c.Table("estimator", what, ("of", "p50", "p95", "max", "refused"), figures))
        if number == 230 and metadata is not None and not flight.traffic.records.get(EstimatorState):
            _nis_by_ratio(t, columns, metadata, part)
        if number == 230:
            accuracy = {"horizontal": rows["m"]["pos_horiz_accuracy"], "vertical": rows["m"]["pos_vert_accuracy"]}
            _against_truth(flight, part, t, accuracy)
    if not any(plot.id.startswith("ratios") for plot in part.plots):
        _against_truth(flight, part, np.empty(0), {})
    _nis_as_told(flight, part)
    _nees(flight, part)
    _health(flight, part)
    if part.empty:
        part.missing = "neither ESTIMATOR_STATUS nor EKF_STATUS_REPORT was told, and no truth"
    return part


def _known(column: FloatArray) -> FloatArray:
    values: FloatArray = np.asarray(column, dtype=np.float64)
    return values


def _nis_by_ratio(t: FloatArray, ratios: dict[str, FloatArray], metadata: dict[str, str], part: Part) -> None:
    """NIS from the ratios and the gate."""
    try:
        gate = float(json.loads(metadata.get("parameters", "{}")).get("FT_EKF_GATE", _GATE))
    except (ValueError, TypeError, AttributeError):
        return
    if 0.0 < gate < 1.0:
        known = [(name, dof) for name, dof in _DOF.items() if name in ratios]
        _nis(part, [(name, dof, t, ratios[name] ** 2 * float(chdtri(dof, 1.0 - gate))) for name, dof in known])


def _nis_as_told(flight: Flight, part: Part) -> None:
    """NIS as the estimator's own records tell it, sensor by sensor."""
    found: dict[tuple[str, int], list[tuple[float, float]]] = {}
    for t_ns, _, state in flight.traffic.records.get(EstimatorState, []):
        for name, dof, nis in zip(state.sensors.split(","), state.dof, state.nis, strict=False):
            if dof >= 1.0:
                seen = found.setdefault((name, int(dof)), [])
                if not seen or seen[-1][1] != nis:  # else the same measurement again
                    seen.append((flight.s(t_ns), nis))
    rows = [(name.replace("_", " "), dof, np.array(seen)) for (name, dof), seen in found.items()]
    _nis(part, [(name, dof, seen[:, 0], seen[:, 1]) for name, dof, seen in rows])


def _nis(part: Part, measured: list[tuple[str, int, FloatArray, FloatArray]]) -> None:
    """Over its degrees of freedom: a plot for each kind of measurement, and a table of all."""
    rows: TableRows = []
    for name, dof, t, nis in measured:
        low, high = float(chdtri(dof, 0.975)), float(chdtri(dof, 0.025))
        finite = nis[np.isfinite(nis)]
        if not len(finite):
            continue
        inside = float(((finite >= low) & (finite <= high)).mean())
        rows.append([name, dof, round(float(finite.mean()), 3), f"{low:.3g} to {high:.3g}", round(100 * inside, 1)])
        levels = (("2.5 %", low), ("97.5 %", high))
        freedom = f"{dof} degree{'s' if dof > 1 else ''} of freedom (mean {dof})"
        note = f"{100 * inside:.0f} % inside the middle 95 % of chi² with {freedom}."
        id, series = f"nis-{name.replace(' ', '-')}", lines(t, {"NIS": nis}, "dots")
        part.plots.append(c.Plot(id, "estimator", f"NIS, {name}", "", series, levels, note))
    columns = ("of", "degrees of freedom", "mean", "middle 95 % of chi²", "inside [%]")
    if rows:
        part.tables.append(c.Table("estimator", "Normalised innovations squared", columns, rows))


def _against_truth(flight: Flight, part: Part, t: FloatArray, accuracy: dict[str, FloatArray]) -> None:
    """The estimate less the truth, beside what the estimator believes."""
    if not len(flight.truth.t) or not len(flight.flown.t):
        return
    off = flight.flown.position - flight.truth.at(flight.flown.t)
    columns = {"horizontal": np.hypot(off[:, 0], off[:, 1]), "vertical": np.abs(off[:, 2])}
    series = lines(flight.flown.t, columns)
    believed = {f"believed, {name}": _known(column) for name, column in accuracy.items()}
    believed = {name: np.where(column < CONVERGED_M, column, np.nan) for name, column in believed.items()}
    believed = {name: column for name, column in believed.items() if np.nan_to_num(column).any()}
    series += lines(t, believed, "step")
    note = "Position, from where it stood when the flight began."
    part.plots.append(c.Plot("estimate-error", "estimator", "Estimate less truth", "m", series, (), note))
    rows = [row(name, column) for name, column in columns.items()]
    part.tables.append(c.Table("estimator", "Estimate less truth", ("of", "p50 [m]", "p95 [m]", "max [m]"), rows))


def _nees(flight: Flight, part: Part) -> None:
    """Whether the position's error is as great as ODOMETRY's covariance says."""
    rows = flight.traffic.told(331)
    if len(rows) < 2 or not len(flight.truth.t):
        return
    c21 = rows["m"]["pose_covariance"].astype(np.float64)
    P = np.empty((len(rows), 3, 3))  # upper triangle of a 6 x 6, row by row: xx xy xz . . . yy yz . . . zz
    for (i, k), at in {(0, 0): 0, (0, 1): 1, (0, 2): 2, (1, 1): 6, (1, 2): 7, (2, 2): 11}.items():
        P[:, i, k] = P[:, k, i] = c21[:, at] if i == k else np.nan_to_num(c21[:, at])  # NaN: not told
    position = np.stack([rows["m"][name].astype(np.float64) for name in "xyz"], axis=1)
    if flight.origin_n is not None:
        position = position - flight.origin_n
    t = flight.times(rows)
    off = position - flight.truth.at(t)
    with np.errstate(all="ignore"):
        good = (
            np.isfinite(P).all(axis=(1, 2)) & np.isfinite(off).all(axis=1) & (np.linalg.det(np.nan_to_num(P)) > 1e-18)
        )
    if flight.aloft is not None:
        good &= (t >= flight.aloft[0]) & (t <= flight.aloft[1])
    if good.sum() < 2:
        return
    nees = np.einsum("ni,ni->n", off[good], np.linalg.solve(P[good], off[good][:, :, None])[:, :, 0])
    low, high = float(chdtri(3, 0.975)), float(chdtri(3, 0.025))
    inside = 100 * float(((nees >= low) & (nees <= high)).mean())
    note = f"{inside:.0f} % inside the middle 95 % of chi² with 3 degrees of freedom; taken from where it stood."
    levels = (("2.5 %", low), ("97.5 %", high))
    plot = c.Plot("nees", "estimator", "NEES, position", "", lines(t[good], {"NEES": nees}), levels, note)
    part.plots.append(plot)


def _health(flight: Flight, part: Part) -> None:
    """Vibration, where it is told."""
    rows = flight.traffic.told(241)
    if len(rows) > 1:
        columns = {axis: rows["m"][f"vibration_{axis}"] for axis in "xyz"}
        series = lines(flight.times(rows), columns)
        if series:
            part.plots.append(c.Plot("vibration", "estimator", "Vibration", "m/s²", series))
