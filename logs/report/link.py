"""The link: how much came, what is missing, how long an answer took, and how the vehicle's clock runs beside ours."""

import numpy as np

from logs.report import contract as c
from logs.report.columns import FloatArray, percentiles
from logs.report.flight import Flight
from logs.report.part import Part, Surroundings, TableRows, each_second, histogram, lines
from logs.schema import Loss

ANSWER_S = 5.0
"""An acknowledgement later than this is of another sending."""
MOST_SENDERS = 30


def link_part(flight: Flight, around: Surroundings) -> Part:
    """Rates, gaps in the sequence, loss counters, round trips, clock offset."""
    part = Part()
    traffic = flight.traffic
    if not traffic.datagrams:
        part.missing = "no datagrams are in the recording"
        return part
    first, last = traffic.first_ns // 1_000_000_000, traffic.last_ns // 1_000_000_000
    if last > first:
        packets: tuple[c.Series, ...] = ()
        sizes: tuple[c.Series, ...] = ()
        for (link, direction), counts in sorted(traffic.rates.items()):
            label = f"{link} {direction}"
            seconds, values = each_second(counts, 0, first, last)
            _, octets = each_second(counts, 1, first, last)
            t = np.maximum(seconds - traffic.first_ns / 1e9, 0.0)[:-1]  # the last second is not whole
            packets += lines(t, {label: values[:-1]}, "step", np.inf)
            sizes += lines(t, {label: octets[:-1] / 1e3}, "step", np.inf)
        part.plots.append(c.Plot("link-rate", "link", "Packets a second", "1/s", packets))
        part.plots.append(c.Plot("link-bytes", "link", "Bytes a second", "kB/s", sizes))
    senders: TableRows = []
    gaps: tuple[c.Series, ...] = ()
    for (link, direction, system, component), tally in list(traffic.tallies.items())[:MOST_SENDERS]:
        whole = tally.received + tally.lost
        share = 100 * tally.lost / whole if whole else 0.0
        senders.append([f"{link} {direction}", f"{system}/{component}", tally.received, tally.lost, round(share, 4)])
        if tally.at and direction == "rx":
            t = np.array([0.0, *(flight.s(t) for t, _ in tally.at), flight.duration_s])
            lost = np.array([0.0, *(float(n) for _, n in tally.at), float(tally.lost)])
            gaps += lines(t, {f"{link} {system}/{component}": lost}, "step", np.inf)
    heads = ("link", "sender", "packets", "missing by sequence", "missing [%]")
    part.tables.append(c.Table("link", "Senders", heads, senders))
    if gaps:
        part.plots.append(c.Plot("link-gaps", "link", "Packets missing by sequence, so far", "", gaps))
    _losses(flight, part)
    _round_trips(flight, part)
    _clock(flight, part)
    load = traffic.told(1)
    if len(load) > 1 and load["m"]["load"].any():
        series = lines(flight.times(load), {"load": load["m"]["load"] / 10.0}, "step")
        part.plots.append(c.Plot("autopilot-load", "link", "The autopilot's load", "%", series))
    return part


def losses(flight: Flight) -> dict[str, int]:
    """The recorder's own counters, as they were last told."""
    return {loss.of: loss.total for _, _, loss in flight.traffic.records.get(Loss, [])}


def _losses(flight: Flight, part: Part) -> None:
    told = flight.traffic.records.get(Loss, [])
    names = dict.fromkeys(loss.of for _, _, loss in told)
    if not names:
        return
    series: tuple[c.Series, ...] = ()
    for name in list(names)[:MOST_SENDERS]:
        t = np.array([flight.s(t) for t, _, loss in told if loss.of == name])
        total = np.array([float(loss.total) for _, _, loss in told if loss.of == name])
        series += lines(t, {name: total}, "step", np.inf)
    part.plots.append(c.Plot("losses", "link", "Counters of what is lost", "", series))


def _round_trips(flight: Flight, part: Part) -> None:
    """Command to its acknowledgement, and TIMESYNC there and back [ms]."""
    traffic = flight.traffic
    answered = traffic.told(77)
    trips: list[tuple[float, float]] = []
    for number in (75, 76):
        for _, rows in traffic.asked(number):
            for t, command in zip(flight.times(rows), rows["m"]["command"], strict=True):
                times = flight.times(answered)[answered["m"]["command"] == command]
                later = times[(times >= t) & (times <= t + ANSWER_S)]
                if len(later):
                    trips.append((float(t), 1e3 * float(later[0] - t)))
    table: TableRows = []
    if trips:
        took = np.array(sorted(trips))
        table.append(_figures("command to its acknowledgement", took[:, 1]))
        series = lines(took[:, 0], {"answer": took[:, 1]}, "dots", np.inf)
        part.plots.append(c.Plot("ack-time", "link", "Command to acknowledgement", "ms", series))
    synced = _timesync(flight)
    if len(synced):
        table.append(_figures("TIMESYNC there and back", synced[:, 1]))
        series = lines(synced[:, 0], {"round trip": synced[:, 1]}, "dots", np.inf)
        part.plots.append(c.Plot("round-trip", "link", "TIMESYNC there and back", "ms", series))
        shown = histogram("round-trip-histogram", "link", "TIMESYNC there and back", "ms", synced[:, 1])
        part.histograms += [shown] if shown else []
    if table:
        heads = ("of", "p50 [ms]", "p95 [ms]", "max [ms]", "times")
        part.tables.append(c.Table("link", "Round trips", heads, table))


def _timesync(flight: Flight) -> FloatArray:
    """(n, 2) when [s] and round trip [ms]: answers (tc1 != 0) matched with questions by ts1, whoever asked."""
    ours = [rows for _, rows in flight.traffic.asked(111)]
    theirs = flight.traffic.told(111)
    every = [*ours, theirs] if len(theirs) else ours
    questions = {int(r["m"]["ts1"]): int(r["t"]) for rows in every for r in rows[rows["m"]["tc1"] == 0]}
    found = []
    for rows in every:
        for r in rows[rows["m"]["tc1"] != 0]:
            asked_ns = questions.get(int(r["m"]["ts1"]))
            if asked_ns is not None and 0 <= r["t"] - asked_ns <= ANSWER_S * 1e9:
                found.append((flight.s(int(r["t"])), (int(r["t"]) - asked_ns) / 1e6))
    return np.array(found).reshape(-1, 2)


def _clock(flight: Flight, part: Part) -> None:
    """How the vehicle's time since boot runs against the recording's: the least late messages tell."""
    rows = flight.traffic.told(30)
    rows = rows if len(rows) > 10 else flight.traffic.told(33)
    if len(rows) <= 10:
        return
    t = flight.times(rows)
    boot = rows["m"]["time_boot_ms"].astype(np.float64)
    again = np.flatnonzero(np.diff(boot) < -1000.0)
    first = int(again[-1]) + 1 if len(again) else 0  # after the last time it booted
    t, boot = t[first:], boot[first:]
    if len(t) <= 10:
        return
    late = 1e3 * t - boot
    late = np.round(late - late.min(), 6)  # times are whole nanoseconds
    series = lines(t, {"late": late}, "dots")
    spread = float(np.percentile(late, 95))
    seconds = t.astype(np.int64)
    _, where = np.unique(seconds, return_index=True)
    floor = np.minimum.reduceat(late, where)  # the least late of each second
    drift = np.polyfit(t[where], floor, 1)[0] * 1e3 if len(where) > 4 else 0.0  # [us/s]
    pace = 1.0 - drift / 1e6
    note = f"Arrival less the time since boot told, from its least. The vehicle's clock runs at {pace:.6f} of ours."
    part.plots.append(c.Plot("clock", "link", "Clock offset and lateness", "ms", series, (("p95", spread),), note))
    zero = flight.t0_ns / 1e9 + (t[late.argmin()] - boot[late.argmin()] / 1e3)
    offset = f"{abs(zero) if abs(zero) < 5e-4 else zero:.3f} s" if zero < 1e8 else f"Unix time {zero:.3f} s"
    figures: TableRows = [["the vehicle's clock began at", offset], ["its pace", round(float(pace), 6)]]
    figures.append(["lateness p95 [ms]", round(spread, 2)])
    part.tables.append(c.Table("link", "Clock", ("figure", "value"), figures))


def _figures(name: str, took_ms: FloatArray) -> list[str | float | None]:
    p50, p95 = percentiles(took_ms, [50, 95])
    return [name, round(p50, 2), round(p95, 2), round(float(took_ms.max()), 2), len(took_ms)]
