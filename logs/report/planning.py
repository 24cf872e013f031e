"""Planning: what each answer cost, whether it came in time, and what became of it."""

from collections import Counter

import numpy as np

from logs.report import contract as c
from logs.report.columns import FloatArray, percentiles
from logs.report.flight import Flight
from logs.report.part import Part, Surroundings, TableRows, histogram, lines, row
from logs.schema import PlanReady, PlanWanted, ReplanReady, ReplanWanted

MEANING = {
    "keep": "flown on as it was",
    "switch": "another way to the goal, proved",
    "backup": "a stop, proved",
    "none": "nothing was proved",
}
MOST_LISTED = 100


def planning_part(flight: Flight, around: Surroundings) -> Part:
    """CPU time, its distribution, answers in time, what was decided."""
    part = Part()
    records = flight.traffic.records
    plans = [(flight.s(t), p) for t, _, p in records.get(PlanReady, [])]
    replans = [(flight.s(t), r) for t, _, r in records.get(ReplanReady, [])]
    if not plans and not replans:
        part.missing = "nothing was planned"
        return part
    _cost(part, plans, replans)
    _in_time(flight, part)
    if plans:
        asked = {w.request_id: w for _, _, w in records.get(PlanWanted, [])}
        rows: TableRows = []
        for t, p in plans[:MOST_LISTED]:
            limit = asked[p.request_id].method if p.request_id in asked else ""
            figures = [round(p.length, 2), round(p.knots[-1] - p.knots[0], 2) if p.knots else None]
            outcome = ("proved" if p.certified else "not proved") if p.ok else f"{p.error}: {p.text}"
            clear = round(p.clearance, 3) if p.ok else None
            rows.append([round(t, 2), p.request_id, p.method or limit, *figures, clear, _ms(p.cpu_ms), outcome])
        heads = ("at [s]", "step", "method", "length [m]", "time [s]", "spare [m]", "CPU [ms]", "outcome")
        part.tables.append(c.Table("planning", "Plans", heads, rows))
    if replans:
        kinds = Counter(r.kind for _, r in replans)
        listed: TableRows = [[kind, MEANING.get(kind, ""), count] for kind, count in kinds.most_common()]
        part.tables.append(c.Table("planning", "Decisions on the way", ("kind", "meaning", "answers"), listed))
        reasons = Counter((r.kind, _plain(r.reason)) for _, r in replans if r.kind != "keep" and r.reason)
        why: TableRows = [[kind, reason, count] for (kind, reason), count in reasons.most_common(20)]
        if why:
            part.tables.append(c.Table("planning", "Why", ("kind", "reason", "answers"), why))
        times = np.array([t for t, _ in replans])
        decided = {
            kind: np.array([float(level) if r.kind == kind else np.nan for _, r in replans])
            for level, kind in enumerate(MEANING)
        }
        series = lines(times, decided, "dots")
        part.plots.append(c.Plot("decisions", "planning", "Decisions, each kind on a line of its own", "", series))
        spare = np.array([r.clearance if abs(r.clearance) < 1e6 else np.nan for _, r in replans])
        series = lines(times, {"spare": spare}, "dots")  # one stands alone as often as not
        if series:
            plot = c.Plot(
                "spare", "planning", "What is flown keeps beyond its radius", "m", series, (("contact", 0.0),)
            )
            part.plots.append(plot)
    return part


def _cost(part: Part, plans: list[tuple[float, PlanReady]], replans: list[tuple[float, ReplanReady]]) -> None:
    """CPU time over the flight, and how many answers cost at most how much."""
    series: tuple[c.Series, ...] = ()
    rows: TableRows = []
    spent = []
    for label, answers in (("plan", plans), ("look again", replans)):
        cpu = np.array([answer.cpu_ms for _, answer in answers])
        known = cpu > 0.0
        if known.any():
            t = np.array([t for t, _ in answers])[known]
            series += lines(t, {label: cpu[known]}, "dots", np.inf)
            rows.append([*row(label, cpu[known], 3), int(known.sum())])
            spent.append(cpu[known])
    if not series:
        return
    part.plots.append(c.Plot("planner-time", "planning", "CPU time of an answer", "ms", series))
    heads = ("of", "p50 [ms]", "p95 [ms]", "max [ms]", "answers")
    part.tables.append(c.Table("planning", "CPU time of an answer", heads, rows))
    shown = histogram("planner-histogram", "planning", "CPU time of an answer", "ms", np.concatenate(spent))
    part.histograms += [shown] if shown else []


def _in_time(flight: Flight, part: Part) -> None:
    """Answers against the moment they were to be flown from, on the flight's clock."""
    records = flight.traffic.records
    answers = {r.request_id: (t, at) for t, at, r in records.get(ReplanReady, [])}
    asked = [(t, at, w) for t, at, w in records.get(ReplanWanted, []) if not w.cold]
    if not asked:
        return
    spare: list[tuple[float, float]] = []
    late = unanswered = 0
    for t, at, w in asked:
        answer = answers.get(w.request_id)
        if answer is None:
            unanswered += 1
            continue
        left_ms = (w.switch_us - w.now_us) / 1e3 - (answer[1] - at) / 1e6
        late += left_ms < 0.0
        spare.append((flight.s(t), left_ms))
    rows: TableRows = [
        ["asked", len(asked)],
        ["answered in time", len(spare) - late],
        ["late", late],
        ["unanswered", unanswered],
    ]
    if spare:
        t_left: FloatArray = np.array(spare)
        p5, p50 = percentiles(t_left[:, 1], [5, 50])
        rows += [["time left, p5 [ms]", round(p5, 1)], ["time left, p50 [ms]", round(p50, 1)]]
        series = lines(t_left[:, 0], {"left": t_left[:, 1]}, "dots")
        levels = (("deadline", 0.0),)
        part.plots.append(c.Plot("deadline", "planning", "Time left before the deadline", "ms", series, levels))
    part.tables.append(c.Table("planning", "Deadlines", ("figure", "value"), rows))


def _ms(cpu_ms: float) -> float | None:
    """Lockstep has no clock: its answers cost nothing that is known."""
    return round(cpu_ms, 2) if cpu_ms > 0.0 else None


def _plain(reason: str) -> str:
    """A reason without its figures, so that equal ones count together."""
    return "".join("#" if ch.isdigit() else ch for ch in reason).replace("#.#", "#").replace("##", "#")
