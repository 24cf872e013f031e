"""The timeline: modes, texts, commands and their answers, phases, failsafes, orders, in one list."""

from typing import Any, Literal

import numpy as np

from logs.report import contract as c
from logs.report.flight import Flight
from logs.report.part import Part
from logs.schema import OperatorCommand
from wire.dialect import mavlink

MOST_EVENTS = 5000
"""On the page; of more the warnings and errors come first."""
_ARMED = 128
_PX4_MODES = {
    1: "Manual", 2: "Altitude", 3: "Position", 5: "Acro", 6: "Offboard", 7: "Stabilized",
    (4, 1): "Ready", (4, 2): "Takeoff", (4, 3): "Hold", (4, 4): "Mission", (4, 5): "Return", (4, 6): "Land",
    (4, 8): "Follow", (4, 9): "Precision land",
}  # fmt: skip
"""Main mode, or main and sub mode of PX4's custom_mode (bits 16 to 23, and 24 to 31)."""
_FAILSAFE_STATES = {5: "critical", 6: "emergency", 8: "flight termination"}
_FAILSAFE_WORDS = ("failsafe", "link lost", "handed over", "low battery", "geofence", "fence:", "rejoin")
Kind = Literal["phase", "text", "command", "ack", "order", "failsafe", "mode"]


def timeline_part(flight: Flight) -> Part:
    """Every event, in order."""
    events: list[c.Event] = []
    told = _notes(flight, events)
    _texts(flight, events, told)
    _modes(flight, events)
    _commands(flight, events)
    for t, _, order in flight.traffic.records.get(OperatorCommand, []):
        values = f" {', '.join(f'{v:g}' for v in order.values)}" if order.values else ""
        events.append(c.Event(flight.s(t), "order", 6, f"{order.name}{values} (from {order.source or 'somebody'})"))
    events.sort(key=lambda event: event.t)
    part = Part(events=_most_telling(events))
    if len(events) > MOST_EVENTS:
        title = f"{len(events) - MOST_EVENTS} of {len(events)} events are left out, the least grave ones"
        part.tables.append(c.Table("timeline", title, ("kind", "events"), _kinds(events)))
    if not events:
        part.missing = "nothing was said or done"
    return part


def _kinds(events: list[c.Event]) -> list[list[str | float | None]]:
    kinds = dict.fromkeys(event.kind for event in events)
    return [[kind, sum(event.kind == kind for event in events)] for kind in kinds]


def _most_telling(events: list[c.Event]) -> list[c.Event]:
    if len(events) <= MOST_EVENTS:
        return events
    kept = sorted(events, key=lambda event: (event.level > 4, event.kind in ("text", "ack")))[:MOST_EVENTS]
    return sorted(kept, key=lambda event: event.t)


def _notes(flight: Flight, events: list[c.Event]) -> list[tuple[float, str]]:
    """The companion's own words; returns what of them the vehicle had said."""
    vehicles = []
    for t, note in flight.notes:
        kind: Kind = "text"
        if " -> " in note.text:
            kind = "phase"
        elif note.text.startswith("vehicle: "):
            vehicles.append((t, note.text.removeprefix("vehicle: ")))
        if any(word in note.text.lower() for word in _FAILSAFE_WORDS):
            kind = "failsafe"
        events.append(c.Event(t, kind, note.level, note.text))
    return vehicles


def _texts(flight: Flight, events: list[c.Event], told: list[tuple[float, str]]) -> None:
    """STATUSTEXT, whole where it came in pieces, unless the companion has passed it on."""
    rows = flight.traffic.told(253)
    passed_on = {text for _, text in told}
    pieces: dict[int, tuple[float, int, str]] = {}
    for t, m in zip(flight.times(rows), rows["m"], strict=True):
        text, id = m["text"].decode("utf-8", "replace"), int(m["id"])
        if id:
            began, level, before = pieces.pop(id, (float(t), int(m["severity"]), ""))
            text = before + text
            if len(m["text"]) == 50 and len(text) < 1000:
                pieces[id] = began, level, text
                continue
        _text(events, float(t), int(m["severity"]), text, passed_on)
    for began, level, text in pieces.values():
        _text(events, began, level, text, passed_on)


def _text(events: list[c.Event], t: float, level: int, text: str, passed_on: set[str]) -> None:
    clean = "".join(ch if ch.isprintable() else " " for ch in text).strip()
    if clean and clean not in passed_on:
        kind: Kind = "failsafe" if "failsafe" in clean.lower() else "text"
        events.append(c.Event(t, kind, level, f"vehicle: {clean}"))


def _modes(flight: Flight, events: list[c.Event]) -> None:
    """Modes, arming and states of alarm, where a HEARTBEAT first tells them."""
    rows = flight.traffic.told(0)
    last: tuple[int, bool, int] | None = None
    for t, m in zip(flight.times(rows), rows["m"], strict=True):
        now = int(m["custom_mode"]), bool(m["base_mode"] & _ARMED), int(m["system_status"])
        if last is None or now[0] != last[0]:
            events.append(c.Event(float(t), "mode", 6, f"mode {mode_name(m)}"))
        if last is not None and now[1] != last[1]:
            events.append(c.Event(float(t), "mode", 6, "armed" if now[1] else "disarmed"))
        if now[2] in _FAILSAFE_STATES and (last is None or now[2] != last[2]):
            events.append(c.Event(float(t), "failsafe", 3, f"the vehicle's state is {_FAILSAFE_STATES[now[2]]}"))
        last = now


def mode_name(heartbeat: Any) -> str:
    """The flight mode in a HEARTBEAT, as PX4 and ArduPilot's copter name it."""
    number = int(heartbeat["custom_mode"])
    if heartbeat["autopilot"] == mavlink.MAV_AUTOPILOT_PX4:
        main, sub = number >> 16 & 0xFF, number >> 24 & 0xFF
        return _PX4_MODES.get((main, sub)) or _PX4_MODES.get(main) or f"{main}/{sub}"
    if heartbeat["autopilot"] == mavlink.MAV_AUTOPILOT_ARDUPILOTMEGA:
        entry = mavlink.enums.get("COPTER_MODE", {}).get(number)
        return entry.name.removeprefix("COPTER_MODE_").replace("_", " ").capitalize() if entry else str(number)
    return str(number)


def _commands(flight: Flight, events: list[c.Event]) -> None:
    """Commands to the vehicle and what it answered."""
    traffic = flight.traffic
    for number in (76, 75):
        for who, rows in traffic.asked(number):
            for t, m in zip(flight.times(rows), rows["m"], strict=True):
                text = f"{command_name(int(m['command']))}{_values(m, number)} from {who[2]}/{who[3]}"
                events.append(c.Event(float(t), "command", 6, text))
    for who, rows in traffic.asked(11):
        for t, m in zip(flight.times(rows), rows["m"], strict=True):
            text = f"SET_MODE base {m['base_mode']}, custom {m['custom_mode']} from {who[2]}/{who[3]}"
            events.append(c.Event(float(t), "command", 6, text))
    answers = traffic.told(77)
    for t, m in zip(flight.times(answers), answers["m"], strict=True):
        result = int(m["result"])
        level = 6 if result in (0, 5) else 4
        text = f"{command_name(int(m['command']))}: {_result(result)}"
        events.append(c.Event(float(t), "ack", level, text))


def _values(m: np.void, number: int) -> str:
    """A command's parameters up to the last that is not zero; a message's number by its name."""
    if m["command"] == mavlink.MAV_CMD_SET_MESSAGE_INTERVAL and number == 76:
        known_as = mavlink.mavlink_map.get(int(m["param1"]))
        return f" ({known_as.msgname if known_as else int(m['param1'])}, {m['param2']:g} µs)"
    values = [float(m[f"param{k}"]) for k in range(1, 5)]
    places = ("x", "y", "z") if number == 75 else ("param5", "param6", "param7")
    values += [float(m[key]) for key in places]
    known = [k for k, v in enumerate(values) if v != 0.0 and not np.isnan(v)]
    shown = values[: known[-1] + 1] if known else []
    return f" ({', '.join(f'{v:g}' for v in shown)})" if shown else ""


def command_name(command: int) -> str:
    """MAV_CMD's name without its prefix, or the number."""
    entry = mavlink.enums["MAV_CMD"].get(command)
    return entry.name.removeprefix("MAV_CMD_") if entry else f"command {command}"


def _result(result: int) -> str:
    entry = mavlink.enums["MAV_RESULT"].get(result)
    return entry.name.removeprefix("MAV_RESULT_").lower().replace("_", " ") if entry else f"result {result}"
