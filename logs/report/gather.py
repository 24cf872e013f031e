"""A recording, whole, as the data of its page: `gather` reads it once and puts the sections together.

It takes any recording: a companion's own, a bundled vehicle's, or one made from somebody's tlog. A section without
data is left out, and the verdict's table says why.
"""

import datetime
import json
import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from logs.reader import Recording
from logs.report import contract as c
from logs.report.actuators import actuators_part
from logs.report.columns import FloatArray, percentiles
from logs.report.estimator import estimator_part
from logs.report.flight import Flight, flight_of
from logs.report.link import link_part, losses
from logs.report.parameters import Values, parameters_of, parameters_part
from logs.report.part import Part, Surroundings, TableRows
from logs.report.planning import planning_part
from logs.report.scene import scene_of
from logs.report.setpoints import setpoints_part
from logs.report.timeline import mode_name, timeline_part
from logs.report.tracking import clearance_part, path_part, tracked, tracking_part
from logs.report.traffic import LOG, read
from wire.dialect import mavlink

_UNIX_NS = 10**17  # log times beyond this are times of day
STEP_M = 0.1
NOWHERE = Surroundings()


@np.errstate(all="ignore")  # a peer may tell any number, NaN and infinities among them
def gather(recording: Recording, around: Surroundings = NOWHERE, against: Recording | None = None) -> c.Report:
    """Everything a page shows of a recording.

    Parameters
    ----------
    around : what its mission says of the world.
    against : another recording, whose parameters are compared.

    Raises
    ------
    RecordingError    It cannot be read.
    """
    flight = flight_of(read(recording))
    scene, aloft, clearance = scene_of(flight, around)
    metadata = recording.metadata
    values, changed = parameters_of(flight, metadata)
    other = None if against is None else (against.path.name, _parameters(against))
    expected = around.expected.get("min_clearance_m")
    parts: dict[str, Part] = {
        "path": path_part(flight, around),
        "tracking": tracking_part(flight, around),
        "setpoints": setpoints_part(flight, around),
        "estimator": estimator_part(flight, around, _vehicles_own(metadata)),
        "actuators": actuators_part(flight, around),
        "planning": planning_part(flight, around),
        "link": link_part(flight, around),
        "timeline": timeline_part(flight),
        "parameters": parameters_part(values, changed, other),
    }
    nearest = clearance_part(aloft.t, clearance, expected[0] if expected else None, bool(scene.movers))
    parts["path"].plots += nearest.plots
    known = np.empty(0) if scene.movers else clearance  # how great what moves was, only a simulator knows
    header = _header(recording, flight, around, known)
    left_out = [[name, part.missing] for name, part in parts.items() if part.missing]
    tables = [table for part in parts.values() for table in part.tables]
    if left_out:
        tables.insert(0, c.Table("verdict", "Left out for want of data", ("section", "why"), left_out))
    in_part: TableRows = [[name, kept] for name, kept in flight.traffic.kept_in_part()]
    if in_part:
        tables.insert(0, c.Table("verdict", "Too long to be kept whole", ("message", "kept"), in_part))
    if len(flight.truth.t) == 0 and flight.source:
        tables.insert(0, _source_table(flight))
    return c.Report(
        header=header,
        scene=scene,
        plots=tuple(plot for part in parts.values() for plot in part.plots if plot.series),
        histograms=tuple(shown for part in parts.values() for shown in part.histograms),
        events=tuple(event for part in parts.values() for event in part.events),
        tables=tuple(tables),
    )


def _source_table(flight: Flight) -> c.Table:
    frame = (
        "the mission's" if flight.origin_n is not None else "the vehicle's local one: no reference tells the mission's"
    )
    source = "the log's own estimator" if flight.traffic.vehicle == LOG else flight.source
    return c.Table("verdict", "Where from", ("what", "from"), [["position", source], ["frame", frame]])


def _parameters(recording: Recording) -> Values:
    return parameters_of(flight_of(read(recording)), recording.metadata)[0]


def _vehicles_own(metadata: Mapping[str, Mapping[str, str]]) -> dict[str, str] | None:
    """Table `vehicle`, which only a bundled vehicle's own recording has."""
    return dict(metadata["vehicle"]) if "vehicle" in metadata else None


# ---- the verdict ----------------------------------------------------------------------------------------------------


def _header(recording: Recording, flight: Flight, around: Surroundings, clearance: FloatArray) -> c.Header:
    told = _outcome(recording.metadata)
    measured = _measured(flight, clearance)
    measured |= {name: told[name] for name in (*measured, "min_clearance_m") if isinstance(told.get(name), float)}
    phase, failure = _end(flight)
    checks = _checks(told, measured, around)
    ok: bool | None = told.get("ok") if isinstance(told.get("ok"), bool) else None
    phase, failure = str(told.get("phase") or phase), str(told.get("failure") or failure)
    if ok is None and phase and around.phase:
        ok = phase == around.phase and all(check.ok is not False for check in checks)
        ok = ok and recording.complete and not (failure and around.phase == "done")
        ok = ok and not measured.get("min_clearance_m", 0.0) < 0.0
    if not recording.complete:
        failure = failure or f"the recording is not complete: {recording.problem}"
    return c.Header(
        title=str(told.get("mission") or around.name or recording.path.stem),
        ok=ok,
        phase=phase,
        failure=failure,
        start_utc=_utc(flight.t0_ns),
        duration_s=round(flight.duration_s, 3),
        checks=tuple(checks),
        facts=tuple(_facts(recording, flight, measured)),
        loss=tuple(_loss(recording, flight)),
    )


def _outcome(metadata: Mapping[str, Mapping[str, str]]) -> dict[str, Any]:
    """The verdict in table `outcome`, where it is JSON; else nothing."""
    table = metadata.get("outcome", {})
    for text in table.values():
        try:
            found = json.loads(text)
        except ValueError:
            continue
        if isinstance(found, dict):
            return found
    return {}


def _measured(flight: Flight, clearance: FloatArray) -> dict[str, float]:
    """Figures as the verdict names them; those that are not known are not there."""
    figures: dict[str, float] = {"duration_max_s": flight.duration_s}
    _, motion, off = tracked(flight)
    error = np.linalg.norm(off, axis=1)
    if np.isfinite(error).any():
        p50, p95 = percentiles(error, [50, 95])
        figures |= {"tracking_error_p50_m": p50, "tracking_error_p95_m": p95}
        figures["tracking_error_max_m"] = float(np.nanmax(error))
        figures["path_length_m"] = _length(motion.position)
    if np.isfinite(clearance).any():
        figures["min_clearance_m"] = float(np.nanmin(clearance))
    sent = [rows for _, rows in flight.traffic.asked(84) if len(rows) > 1]
    if sent:
        gaps_ms = 1e3 * np.diff(flight.times(max(sent, key=len)))
        p99 = percentiles(gaps_ms, [99])[0]
        figures |= {"setpoint_gap_p99_ms": p99, "setpoint_gap_max_ms": float(gaps_ms.max())}
    return {name: float(value) for name, value in figures.items()}


def _length(position_m: FloatArray) -> float:
    """Of a path through (n, 3) places [m], in steps of at least `STEP_M`, so that noise does not add to it."""
    total, here = 0.0, position_m[0].tolist()
    for there in position_m.tolist():
        step = math.dist(here, there)
        if step >= STEP_M:
            total, here = total + step, there
    return total + math.dist(here, position_m[-1])


def _checks(told: dict[str, Any], measured: dict[str, float], around: Surroundings) -> list[c.Check]:
    """The verdict's own checks where it is in the recording, else the mission's expectations and what was measured."""
    checks = told.get("checks")
    if isinstance(checks, list):
        found = [entry for entry in checks if isinstance(entry, dict) and "name" in entry]
        return [c.Check(str(e["name"]), e.get("value"), e.get("expected"), e.get("ok")) for e in found]
    listed = []
    for name, (bound, at_least) in around.expected.items():
        value = measured.get(name)
        ok = None if value is None else (value >= bound if at_least else value <= bound)
        shown = None if value is None else round(value, 4)
        listed.append(c.Check(name, shown, f"{'≥' if at_least else '≤'} {bound:g}", ok))
    return listed


def _end(flight: Flight) -> tuple[str, str]:
    """The last phase, and what went wrong on the way: the first error told, else the words that led there."""
    notes = flight.notes
    if not notes:
        return "", ""
    last = notes[-1][1].phase
    errors = [note.text for _, note in notes if note.level <= 3]
    if errors or last == "done":
        return last, errors[0] if errors else ""
    why = [note.text for _, note in notes if f"-> {last}" in note.text]
    return last, why[-1] if why else ""


def _facts(recording: Recording, flight: Flight, measured: dict[str, float]) -> list[tuple[str, str | float]]:
    traffic, metadata = flight.traffic, recording.metadata
    facts: list[tuple[str, str | float]] = [("recording", recording.path.name)]
    kind = "a companion's" if traffic.companions else "a bundled vehicle's own" if "vehicle" in metadata else "imported"
    facts.append(("kind", kind))
    for name, value in metadata.get("run", {}).items():
        if value and len(value) < 200 and name != "mission":
            facts.append((name.replace("_", " "), value))
    if told := metadata.get("schema", {}):
        facts.append(("format", ", ".join(f"{name} {value}" for name, value in told.items() if len(value) < 50)))
    seed = _seed(metadata)
    if seed is not None and "seed" not in metadata.get("run", {}):
        facts.append(("seed", seed))
    beats = traffic.told(0)
    if traffic.vehicle is not None and len(beats):
        m = beats["m"][-1]
        autopilot = _enum("MAV_AUTOPILOT", int(m["autopilot"]))
        facts.append(
            ("vehicle", f"{traffic.vehicle[2]}/{traffic.vehicle[3]}, {autopilot}, {_enum('MAV_TYPE', int(m['type']))}")
        )
        facts.append(("last mode", mode_name(m)))
    facts += [(f"endpoint {name}", url) for name, url in metadata.get("endpoints", {}).items()]
    words = {
        "tracking_error_p50_m": ("tracking error p50", "m"),
        "tracking_error_p95_m": ("tracking error p95", "m"),
        "path_length_m": ("path", "m"),
        "min_clearance_m": ("least clearance", "m"),
        "setpoint_gap_p99_ms": ("setpoint gap p99", "ms"),
    }
    facts += [(words[name][0], f"{measured[name]:.4g} {words[name][1]}") for name in words if name in measured]
    facts += [("messages", traffic.messages), ("written by", recording.library)]
    if len(recording.paths) > 1:
        facts.append(("parts", len(recording.paths)))
    return facts


def _seed(metadata: Mapping[str, Mapping[str, str]]) -> int | None:
    for table in ("companion.config", "vehicle"):
        try:
            seed = json.loads(metadata.get(table, {}).get("config", "{}")).get("seed")
        except (ValueError, AttributeError):
            continue
        if isinstance(seed, int):
            return seed
    return None


def _enum(name: str, number: int) -> str:
    entry = mavlink.enums[name].get(number)
    return entry.name.removeprefix(f"{name}_").replace("_", " ").lower() if entry else str(number)


def _loss(recording: Recording, flight: Flight) -> list[tuple[str, int]]:
    """Counters of loss: the sequence's, the recorder's, the sockets'."""
    found: dict[str, int] = {}
    told, vehicle = losses(flight), flight.traffic.vehicle
    if vehicle in flight.traffic.tallies:
        found["packets missing by sequence"] = flight.traffic.tallies[vehicle].lost
        link, _, system, component = vehicle
        told.pop(f"{link}.{system}.{component}.sequence_gaps", None)  # the same packets, counted by the recorder
    for name, text in recording.metadata.get("recorder", {}).items():
        if name.startswith("dropped_") and text.isdecimal():
            found[f"not recorded, {name.removeprefix('dropped_')}"] = int(text)
    dropouts = recording.metadata.get("import", {}).get("dropouts", "")
    if dropouts.isdecimal():
        found["dropouts of the log"] = int(dropouts)
    found |= told
    if recording.gaps:
        found["gaps between parts"] = len(recording.gaps)
    return list(found.items())[:24]


def _utc(t0_ns: int) -> str | None:
    if t0_ns < _UNIX_NS:
        return None
    return datetime.datetime.fromtimestamp(t0_ns / 1e9, datetime.UTC).isoformat(timespec="milliseconds")
