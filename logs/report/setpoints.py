"""Setpoints: how often they left, how evenly, and where they paused."""

import numpy as np

from logs.report import contract as c
from logs.report.columns import percentiles
from logs.report.flight import Flight
from logs.report.part import MOST_SECONDS, Part, Surroundings, TableRows, histogram, lines

NAMES = {82: "SET_ATTITUDE_TARGET", 84: "SET_POSITION_TARGET_LOCAL_NED", 86: "SET_POSITION_TARGET_GLOBAL_INT"}
FAILSAFE_S = 0.5
"""A vehicle that hears nothing for this long leaves the mode (PX4 COM_OF_LOSS_T 1 s, less; told as a level)."""
MOST_GAPS = 20


def setpoints_part(flight: Flight, around: Surroundings) -> Part:
    """Rate, spacing and gaps of the setpoints of whoever sent most of them."""
    part = Part()
    sent = [(number, who, rows) for number in NAMES for who, rows in flight.traffic.asked(number) if len(rows) > 1]
    if not sent:
        part.missing = "nobody sent setpoints"
        return part
    number, who, rows = max(sent, key=lambda entry: len(entry[2]))
    t = np.sort(flight.times(rows))
    gaps_ms = np.round(1e3 * np.diff(t), 6)  # times are whole nanoseconds
    p50, p99 = percentiles(gaps_ms, [50, 99])
    bound = around.expected.get("setpoint_gap_p99_ms")
    levels = [("p99", p99)] + ([("limit of p99", bound[0])] if bound else [])
    whose = f"{NAMES[number]} from {who[2]}/{who[3]}, as they {'left' if who[1] == 'tx' else 'arrived'}."
    gap = lines(t[1:], {"gap": gaps_ms}, "dots", np.inf)
    part.plots.append(c.Plot("setpoint-gap", "setpoints", "Time since the one before", "ms", gap, tuple(levels), whose))
    if 3.0 < t[-1] - t[0] < MOST_SECONDS:
        counts, edges = np.histogram(t, bins=np.arange(np.floor(t[0]), np.ceil(t[-1]) + 1.0))
        rate = lines(edges[1:-2] + 0.5, {"setpoints": counts[1:-1].astype(float)}, "step", np.inf)
        part.plots.append(c.Plot("setpoint-rate", "setpoints", "Setpoints a second", "1/s", rate))
    jitter = histogram(
        "setpoint-jitter", "setpoints", "Spacing less the median", "ms", gaps_ms[gaps_ms < 1e3 * FAILSAFE_S] - p50
    )
    part.histograms += [jitter] if jitter else []
    figures: TableRows = [
        ["setpoints", len(t)],
        ["mean rate [1/s]", round((len(t) - 1) / (t[-1] - t[0]), 3) if t[-1] > t[0] else None],
        ["spacing p50 [ms]", round(p50, 3)],
        ["spacing p99 [ms]", round(p99, 3)],
        ["spacing max [ms]", round(float(gaps_ms.max()), 3)],
        ["standard deviation [ms]", round(float(gaps_ms.std()), 3)],
    ]
    part.tables.append(c.Table("setpoints", "Spacing", ("figure", "value"), figures))
    long = np.flatnonzero(gaps_ms > max(3 * p50, 50.0))
    if len(long):
        worst = long[np.argsort(-gaps_ms[long], kind="stable")[:MOST_GAPS]]
        listed = [[round(float(t[k]), 3), round(float(gaps_ms[k]), 1)] for k in np.sort(worst)]
        title = "Gaps" if len(long) <= MOST_GAPS else f"The longest of {len(long)} gaps"
        part.tables.append(c.Table("setpoints", title, ("from [s]", "for [ms]"), listed))
    return part
