"""Path and tracking: where it was, where it should have been, and how far from each other."""

import numpy as np

from logs.report import contract as c
from logs.report.columns import FloatArray, pause_s
from logs.report.flight import Flight, Motion
from logs.report.part import Part, Surroundings, histogram, lines, row

AXES = ("north", "east", "down")


def tracked(flight: Flight) -> tuple[str, Motion, FloatArray]:
    """What the error is taken of: "truth" where it is told, else "estimate"; its samples; and (n, 3) off the reference.

    NaN where no reference was near in time.
    """
    source, motion = ("truth", flight.truth) if len(flight.truth.t) else ("estimate", flight.flown)
    motion = flight.when(motion, flight.tracked)
    return source, motion, off_reference(flight, motion)


def off_reference(flight: Flight, motion: Motion) -> FloatArray:
    """(n, 3) position less reference at the same time; NaN where the reference paused."""
    reference = flight.reference
    off: FloatArray = motion.position - reference.at(motion.t)
    if len(reference.t) > 1:
        nearest = np.clip(np.searchsorted(reference.t, motion.t), 1, len(reference.t) - 1)
        off[reference.t[nearest] - reference.t[nearest - 1] > pause_s(reference.t)] = np.nan
    return off


def cross_track(flight: Flight, motion: Motion, off: FloatArray) -> FloatArray:
    """(n,) what of the error is across the reference's velocity [m]; all of it where the reference stands."""
    reference = flight.reference
    columns = [np.interp(motion.t, reference.t, reference.velocity[:, k]) for k in range(3)]
    velocity = np.nan_to_num(np.stack(columns, axis=1))
    speed = np.linalg.norm(velocity, axis=1)
    along = np.einsum("ij,ij->i", off, velocity) / np.where(speed > 0.05, speed, np.inf)
    across: FloatArray = np.sqrt(np.maximum((off**2).sum(axis=1) - along**2, 0.0))
    return across


def path_part(flight: Flight, around: Surroundings) -> Part:
    """Altitude and speed."""
    part = Part()
    altitude: list[c.Series] = []
    speed: list[c.Series] = []
    for label, motion in (("flown", flight.flown), ("truth", flight.truth), ("reference", flight.reference)):
        if len(motion.t):
            altitude += lines(motion.t, {label: -motion.position[:, 2]})
            level = np.hypot(motion.velocity[:, 0], motion.velocity[:, 1])
            speed += lines(motion.t, {label: level})
            if label == "flown":
                speed += lines(motion.t, {"climb": -motion.velocity[:, 2]})
    if altitude:
        part.plots.append(c.Plot("altitude", "path", "Altitude", "m", tuple(altitude)))
        limit = around.limits.get("speed")
        levels = (("limit", limit),) if limit else ()
        part.plots.append(c.Plot("speed", "path", "Speed over ground", "m/s", tuple(speed), levels))
    else:
        part.missing = "no position was told"
    return part


def clearance_part(t: FloatArray, clearance: FloatArray, expected: float | None, movers: bool) -> Part:
    """How far the hull was from the nearest obstacle."""
    levels = [("contact", 0.0)] + ([("expected", expected)] if expected is not None else [])
    note = (
        "What moves is taken to be where it told, or else was reckoned to be, and as great as the planner took it."
        if movers
        else ""
    )
    series = lines(t, {"nearest": clearance})
    plot = c.Plot("clearance", "path", "Clearance of the hull", "m", series, tuple(levels), note)
    return Part([plot]) if plot.series else Part()


def tracking_part(flight: Flight, around: Surroundings) -> Part:
    """Errors by axis, across the track, their distribution, and the attitude."""
    part = Part()
    a = flight.attitude
    source, motion, off = tracked(flight)
    error = np.linalg.norm(off, axis=1)
    if np.isfinite(error).any():
        across = cross_track(flight, motion, off)
        bound = around.expected.get("tracking_error_p95_m")
        finite = error[np.isfinite(error)]
        levels = [("p95", float(np.percentile(finite, 95)))] + ([("limit of p95", bound[0])] if bound else [])
        note = f"Distance of the {source} from the reference at the same time."
        series = lines(motion.t, {"distance": error, "across the track": across})
        part.plots.append(c.Plot("error", "tracking", "Tracking error", "m", series, tuple(levels), note))
        axes = lines(motion.t, {name: off[:, k] for k, name in enumerate(AXES)})
        part.plots.append(c.Plot("error-axes", "tracking", "Tracking error by axis", "m", axes))
        shown = histogram("error-histogram", "tracking", "Tracking error", "m", error)
        part.histograms += [shown] if shown else []
        rows = [row(f"to the {source}", error), row("across the track", across)]
        rows += [row(name, np.abs(off[:, k])) for k, name in enumerate(AXES)]
        if source == "truth":
            seen = flight.when(flight.flown, flight.tracked)
            rows.insert(1, row("to the estimate", np.linalg.norm(off_reference(flight, seen), axis=1)))
        part.tables.append(c.Table("tracking", "Tracking error", ("of", "p50 [m]", "p95 [m]", "max [m]"), rows))
        velocity = np.stack(
            [np.interp(motion.t, flight.reference.t, flight.reference.velocity[:, k]) for k in range(3)], axis=1
        )
        if np.isfinite(velocity).all():
            differing = np.where(np.isfinite(error), np.linalg.norm(motion.velocity - velocity, axis=1), np.nan)
            shown_v = lines(motion.t, {"difference": differing})
            part.plots.append(c.Plot("velocity-error", "tracking", "Velocity less the reference's", "m/s", shown_v))
    else:
        part.missing = "nothing says where it should have been while it flew"
    if len(a):
        angles = lines(a[:, 0], {name: np.degrees(a[:, k]) for k, name in enumerate(("roll", "pitch"), start=1)})
        part.plots.append(c.Plot("attitude", "tracking", "Roll and pitch", "°", angles))
        heading = np.degrees(a[:, 3])
        heading = np.where(np.abs(np.diff(heading, prepend=heading[:1])) > 180.0, np.nan, heading)
        part.plots.append(c.Plot("heading", "tracking", "Heading", "°", lines(a[:, 0], {"yaw": heading})))
    return part
