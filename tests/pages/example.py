"""A page's data from a flown recording, for the tests: what they show is a real flight, read with `logs.reader`."""

import json
import math
from collections import defaultdict
from pathlib import Path
from typing import Any

import numpy as np
import yaml
from scipy.interpolate import BSpline

from logs.reader import Recording
from logs.report import contract as c

EARTH_M = 6_371_000.0
WANTED = ("LOCAL_POSITION_NED", "ATTITUDE", "ADSB_VEHICLE", "ESTIMATOR_STATUS", "SERVO_OUTPUT_RAW", "COMMAND_ACK")
OURS = ("reference", "note", "replan_ready", "plan_ready")


def example(path: Path, ok: bool | None = True) -> c.Report:
    """Everything a page can show, from one recording of the bundled vehicle."""
    recording = Recording.open(path)
    mission = yaml.safe_load(recording.attachments["mission.yaml"].data)
    start = mission["vehicle"]["start"]
    origin = np.array([start["north"], start["east"], 0.0])
    found: dict[str, list[tuple[float, Any]]] = defaultdict(list)
    sent = []
    for message in recording.messages():
        name = message.channel.topic.rsplit("/", 1)[-1]
        t = message.log_time_ns / 1e9
        if name == "SET_POSITION_TARGET_LOCAL_NED":
            sent.append(t)
        elif name in OURS or (name in WANTED and message.channel.topic.startswith("/mavlink/1/1/")):
            found[name].append((t, recording.decode(message)))

    def column(name: str, read: Any) -> np.ndarray:
        return np.array([read(m) for _, m in found[name]], dtype=float)

    def times(name: str) -> np.ndarray:
        return np.array([t for t, _ in found[name]])

    t = times("LOCAL_POSITION_NED")
    position = column("LOCAL_POSITION_NED", lambda m: (m.x, m.y, m.z)) + origin
    angles = column("ATTITUDE", lambda m: (m.roll, m.pitch, m.yaw))
    at = times("ATTITUDE")
    roll, pitch, yaw = (np.interp(t, at, np.unwrap(angles[:, k])) for k in range(3))
    rt = times("reference")
    reference = column("reference", lambda m: tuple(m.position))
    position += reference[0] - [
        np.interp(rt[0], t, position[:, k]) for k in range(3)
    ]  # where it stood is where it was told
    expected = np.stack([np.interp(t, rt, reference[:, k], left=np.nan, right=np.nan) for k in range(3)], axis=1)
    off = position - expected
    error = np.linalg.norm(off, axis=1)
    flying = np.isfinite(error)
    p50, p95 = np.percentile(error[flying], [50, 95])
    duration = float(t[-1])

    boxes = [_obstacle(o) for o in mission["world"].get("obstacles", [])]
    bounds = mission["world"]["bounds"]
    corners = tuple((bounds["north"][k], bounds["east"][k], bounds["altitude"][k]) for k in (0, 1))
    nearest, where = _least(boxes, position, t)
    plans = [c.Way(s, _curve(m.control_points, m.knots)) for s, m in found["plan_ready"] if m.ok]
    for s, m in found["replan_ready"]:
        if m.kind == "switch" and len(m.knots):
            plans.append(c.Way(s, _curve(m.control_points, m.knots), "switch"))
        if len(m.backup_knots):
            plans.append(c.Way(s, _curve(m.backup_control_points, m.backup_knots, 12), "backup"))

    scene = c.Scene(
        path=c.Track(t, position[:, 0], position[:, 1], -position[:, 2], roll, pitch, yaw, error),
        reference=c.Track(rt, reference[:, 0], reference[:, 1], -reference[:, 2]),
        obstacles=tuple(boxes),
        bounds=corners,
        plans=tuple(plans),
        movers=_movers(found["ADSB_VEHICLE"]),
        least=where,
    )
    velocity = column("LOCAL_POSITION_NED", lambda m: (m.vx, m.vy, m.vz))
    gaps_ms = 1e3 * np.diff(sent)
    jitter = np.random.default_rng(1).normal(20, 0.4, max(2, len(gaps_ms)))  # lockstep has none: as over UDP
    counts, edges = np.histogram(jitter, bins=40)
    cpu = np.array([m.cpu_ms for _, m in found["replan_ready"] + found["plan_ready"] if m.cpu_ms > 0])
    plan_counts, plan_edges = np.histogram(cpu if cpu.size else [5.0, 9.0], bins=24)
    estimator = times("ESTIMATOR_STATUS")
    servo = times("SERVO_OUTPUT_RAW")

    def line(label: str, x: np.ndarray, v: np.ndarray, style: Any = "line") -> c.Series:
        return c.Series(label, x, v, style)

    def ratio(field: str) -> np.ndarray:
        return column("ESTIMATOR_STATUS", lambda m: getattr(m, field))

    motors = [
        line(f"servo{k}", servo, column("SERVO_OUTPUT_RAW", lambda m, k=k: getattr(m, f"servo{k}_raw")), "step")
        for k in (1, 2, 3, 4)
    ]
    plots = (
        c.Plot(
            "altitude",
            "path",
            "Altitude",
            "m",
            (line("flown", t, -position[:, 2]), line("reference", rt, -reference[:, 2])),
        ),
        c.Plot(
            "speed",
            "path",
            "Speed",
            "m/s",
            (line("horizontal", t, np.hypot(velocity[:, 0], velocity[:, 1])), line("vertical", t, -velocity[:, 2])),
            (("limit", float(mission.get("limits", {}).get("speed", 3))),),
        ),
        c.Plot(
            "error",
            "tracking",
            "Tracking error",
            "m",
            (line("distance", t, error),),
            (("p95", p95), ("limit", 0.35)),
            "Distance from the reference at the same time.",
        ),
        c.Plot(
            "error-axes",
            "tracking",
            "Tracking error by axis",
            "m",
            tuple(line(n, t, off[:, k]) for k, n in enumerate(("north", "east", "down"))),
        ),
        c.Plot(
            "attitude",
            "tracking",
            "Attitude",
            "°",
            tuple(line(n, at, np.degrees(angles[:, k])) for k, n in enumerate(("roll", "pitch", "yaw"))),
        ),
        c.Plot(
            "gaps",
            "setpoints",
            "Gap between setpoints",
            "ms",
            (line("gap", np.array(sent[1:]), gaps_ms, "dots"),),
            (("deadline", 30.0),),
        ),
        c.Plot(
            "ratios",
            "estimator",
            "Test ratios",
            "",
            tuple(line(n, estimator, ratio(f"{n}_ratio"), "step") for n in ("vel", "pos_horiz", "pos_vert", "mag")),
            (("reject", 1.0),),
        ),
        c.Plot("motors", "actuators", "Motors", "µs", tuple(motors), (("most", 2000.0),)),
        c.Plot(
            "planning",
            "planning",
            "Planner time",
            "ms",
            (line("replan", times("replan_ready"), column("replan_ready", lambda m: m.cpu_ms), "dots"),),
            (("deadline", 100.0),),
        ),
        c.Plot(
            "load",
            "link",
            "Link rate",
            "1/s",
            (line("received", *_rate(t)), line("setpoints", *_rate(np.array(sent)))),
        ),
    )
    events = [c.Event(s, "phase" if "->" in m.text else "text", m.level, m.text) for s, m in found["note"]]
    events += [
        c.Event(s, "ack", 6 if not m.result else 4, f"command {m.command}: result {m.result}")
        for s, m in found["COMMAND_ACK"]
    ]
    checks = (
        c.Check("tracking_error_p95_m", round(float(p95), 4), "≤ 0.35", bool(p95 <= 0.35)),
        c.Check(
            "min_clearance_m",
            None if nearest is None else round(nearest, 3),
            "≥ 0.1",
            None if nearest is None else nearest >= 0.1,
        ),
        c.Check("duration_max_s", round(duration, 2), "≤ 60", ok is not False),
        c.Check("setpoint_gap_p99_ms", round(float(np.percentile(gaps_ms, 99)), 2), "≤ 30", True),
    )
    by_axis = [
        [n, *(float(q) for q in np.percentile(np.abs(off[flying, k]), [50, 95, 100]))]
        for k, n in enumerate(("north", "east", "down"))
    ]
    parameters = [[f"MPC_EXAMPLE_{k:02d}", round(0.1 * k * k, 3), round(0.1 * k, 3)] for k in range(30)]
    config = json.loads(recording.metadata["companion.config"]["config"])
    return c.Report(
        header=c.Header(
            title=mission["name"],
            ok=ok,
            phase="done" if ok is not False else "aborted",
            failure="" if ok is not False else "duration_max_s: 24.18, expected at most 20",
            start_utc="2026-03-02T09:41:07Z",
            duration_s=duration,
            checks=checks,
            facts=(
                ("version", "0.1.0"),
                ("revision", "b14cd39"),
                ("seed", config["seed"]),
                ("vehicle", "PX4, bundled, X500"),
                ("endpoint", "udpin:127.0.0.1:14540"),
                ("tracking error p50", f"{p50:.3f} m"),
                ("path", f"{np.linalg.norm(np.diff(position, axis=0), axis=1).sum():.1f} m"),
            ),
            loss=(("datagrams dropped", 0), ("decoded dropped", 0), ("sequence gaps", 0)),
        ),
        scene=scene,
        plots=plots,
        histograms=(
            c.Histogram(
                "jitter",
                "setpoints",
                "Setpoint spacing",
                "ms",
                edges,
                counts.tolist(),
                (("p50", 20.0), ("p99", float(np.percentile(jitter, 99)))),
            ),
            c.Histogram(
                "plan-time",
                "planning",
                "Planner time",
                "ms",
                plan_edges,
                plan_counts.tolist(),
                (("p95", float(np.percentile(cpu if cpu.size else [9.0], 95))),),
            ),
        ),
        events=tuple(sorted(events, key=lambda e: e.t)),
        tables=(
            c.Table("tracking", "Tracking error", ("axis", "p50 [m]", "p95 [m]", "max [m]"), by_axis),
            c.Table("parameters", "Parameters that differ from the default", ("name", "value", "default"), parameters),
        ),
    )


def _curve(points: Any, knots: Any, count: int = 60) -> np.ndarray:
    """Points (north, east, up) along a cubic B-spline in NED."""
    spline = BSpline(np.array(knots), np.array(points).reshape(-1, 3), 3)
    curve: np.ndarray = spline(np.linspace(knots[3], knots[-4], count)) * [1, 1, -1]
    return curve


def _obstacle(entry: dict[str, Any]) -> dict[str, Any]:
    if "box" in entry:
        b = entry["box"]
        return c.box(*(tuple(b[a][k] for a in ("north", "east", "altitude")) for k in (0, 1)))  # type: ignore[arg-type]
    y = entry["cylinder"]
    return c.cylinder((y["north"], y["east"], y["altitude"][0]), y["radius"], y["altitude"][1] - y["altitude"][0])


def _least(boxes: list[dict[str, Any]], position: np.ndarray, t: np.ndarray) -> tuple[float | None, Any]:
    """The least distance to a box, less the hull."""
    best: tuple[float, int] | None = None
    place = position * [1, 1, -1]
    for box in boxes:
        if box["kind"] != "box":
            continue
        away = np.linalg.norm(
            np.maximum(np.maximum(np.array(box["low"]) - place, place - np.array(box["high"])), 0), axis=1
        )
        k = int(away.argmin())
        if best is None or away[k] < best[0]:
            best = float(away[k]), k
    if best is None:
        return None, None
    clearance, k = best[0] - 0.35, best[1]
    return clearance, (float(t[k]), tuple(place[k].tolist()), clearance)


def _movers(heard: list[tuple[float, Any]]) -> tuple[c.Mover, ...]:
    by_name: dict[str, list[tuple[float, float, float, float]]] = defaultdict(list)
    lat0, lon0, alt0 = 473977420e-7, 85455940e-7, 488.0
    for t, m in heard:
        north = math.radians(m.lat * 1e-7 - lat0) * EARTH_M
        east = math.radians(m.lon * 1e-7 - lon0) * EARTH_M * math.cos(math.radians(lat0))
        by_name[m.callsign].append((t, 2 + north, 10 + east, m.altitude / 1000 - alt0))
    return tuple(c.Mover(name, 0.45, c.Track(*np.array(rows)[::5].T)) for name, rows in sorted(by_name.items()))


def _rate(t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    counts, edges = np.histogram(t, bins=np.arange(0, t[-1] + 1))
    return edges[:-1], counts.astype(float)
