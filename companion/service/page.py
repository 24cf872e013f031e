"""The service's page for people: one state as HTML, which renews itself and needs nothing from elsewhere."""

from collections.abc import Mapping
from html import escape
from typing import Any

STYLE = """
:root { color-scheme: light dark; --ink: #1c2126; --soft: #5b6670; --paper: #f6f7f8; --card: #ffffff; --line: #dde2e6;
  --good: #14733c; --bad: #b3261e; --warn: #8a5a00; --busy: #1a5fb4; }
@media (prefers-color-scheme: dark) { :root { --ink: #e6e9ec; --soft: #9aa5af; --paper: #14181c; --card: #1c2228;
  --line: #313a42; --good: #5bc98a; --bad: #ff8a80; --warn: #e0b050; --busy: #7db3f5; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--paper); color: var(--ink); font: 15px/1.5 system-ui, sans-serif; }
main { max-width: 72rem; margin: 0 auto; padding: 1.5rem 1rem; }
header { display: flex; flex-wrap: wrap; gap: .25rem 1rem; align-items: baseline; margin-bottom: 1rem; }
h1 { font-size: 1.5rem; margin: 0; } h2 { font-size: 1rem; margin: 0 0 .5rem; color: var(--soft); font-weight: 600; }
.state { font-weight: 600; color: var(--busy); } .good { color: var(--good); } .bad { color: var(--bad); }
.warn { color: var(--warn); }
.cards { display: grid; grid-template-columns: repeat(auto-fit, minmax(20rem, 1fr)); gap: 1rem; }
section { background: var(--card); border: 1px solid var(--line); border-radius: .5rem; padding: 1rem; min-width: 0; }
table { border-collapse: collapse; width: 100%; } td { padding: .15rem 0; vertical-align: top; }
td:first-child { color: var(--soft); padding-right: 1rem; white-space: nowrap; }
td:last-child { text-align: right; font-variant-numeric: tabular-nums; overflow-wrap: anywhere; }
ol { margin: 0; padding: 0; list-style: none; font-size: .9rem; } li { padding: .15rem 0; overflow-wrap: anywhere; }
time { color: var(--soft); margin-right: .5rem; font-variant-numeric: tabular-nums; } .wide { grid-column: 1 / -1; }
footer { color: var(--soft); font-size: .85rem; margin-top: 1rem; } a { color: inherit; }
"""
SCRIPT = """
setInterval(async () => {
  const note = document.getElementById("gone");
  try {
    const page = await (await fetch("/", {cache: "no-store"})).text();
    const fresh = new DOMParser().parseFromString(page, "text/html").querySelector("main");
    document.querySelector("main").replaceWith(fresh);
  } catch { if (note) { note.hidden = false; } }
}, 1000);
"""
LABELS = {
    "vehicle": "Vehicle",
    "flight": "Flight",
    "last_flight": "Last flight",
    "replanning": "Replanning",
    "links": "Links",
    "routing": "Packets routed",
    "fleet": "Other vehicles",
}


def render(state: Mapping[str, Any], ill: str) -> str:
    """The page: the state as tables, and the notes of late."""
    well = f'<span class="bad">{escape(ill)}</span>' if ill else '<span class="good">ready</span>'
    cards = "".join(_card(key, title, state[key]) for key, title in LABELS.items() if _worth(key, state.get(key)))
    notes = "".join(
        f"<li><time>{escape(note['time'][11:19])}</time>"
        f'<span class="{NOTES.get(note["level"], "")}">{escape(note["text"])}</span></li>'
        for note in reversed(state.get("notes", []))
    )
    mission = escape(str(state.get("mission") or "no mission"))
    return (
        '<!doctype html><html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width, initial-scale=1"><title>companion</title>'
        f"<style>{STYLE}</style></head><body><main><header><h1>companion</h1>"
        f'<span class="state">{escape(str(state.get("state", "starting")))}</span><span>{mission}</span>{well}</header>'
        f'<p id="gone" class="bad" hidden>The service does not answer any more.</p><div class="cards">{cards}'
        f'<section class="wide"><h2>Notes</h2><ol>{notes}</ol></section></div>'
        f"<footer>{_version(state.get('version'))}up {_duration(state.get('up_s'))} · "
        f"{_live(state.get('live'))}"
        '<a href="/state.json">state.json</a> · <a href="/health">health</a> · <a href="/ready">ready</a>'
        "</footer></main>"
        f"<script>{SCRIPT}</script></body></html>"
    )


NOTES = {"error": "bad", "warning": "warn"}
"""Classes of levels."""


def _version(version: object) -> str:
    return f"version {escape(str(version))}, " if version else ""


def _live(address: object) -> str:
    """A link to the live page; its token, which gives orders, is in the log only."""
    if not address:
        return ""
    return f'<a href="{escape(str(address))}">live page</a> (open the address with its token, which the log has) · '


def _worth(key: str, values: Mapping[str, Any] | None) -> bool:
    """Whether a card says anything: that nothing was routed does not."""
    return bool(values) and (key != "routing" or any((values or {}).values()))


def _card(card: str, title: str, values: Mapping[str, Any]) -> str:
    rows = "".join(
        f"<tr><td>{escape(_label(card, key))}</td><td>{escape(_shown(key, value))}</td></tr>"
        for key, value in values.items()
        if value is not None
    )
    return f"<section><h2>{escape(title)}</h2><table>{rows}</table></section>"


UNITS = (("_m_s", "m/s"), ("_m", "m"), ("_s", "s"), ("_ms", "ms"), ("_hz", "Hz"), ("_deg", "°"), ("_mb", "MB"))


def _unit(key: str) -> tuple[str, str]:
    """The ending of a key that is a unit, and the unit."""
    return max(((e, u) for e, u in UNITS if key.endswith(e)), key=lambda pair: len(pair[0]), default=("", ""))


WORDS = {
    ("vehicle", "position_m"): "position NED",
    ("vehicle", "velocity_m_s"): "velocity NED",
    ("flight", "position_m"): "in the mission NED",
    ("flight", "seconds"): "time",
    ("last_flight", "seconds"): "time",
}
"""Labels that are not their key, by card and key."""


def _label(card: str, key: str) -> str:
    return WORDS.get((card, key)) or key.removesuffix(_unit(key)[0]).replace("_", " ")


def _shown(key: str, value: Any) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    if key == "battery":
        return f"{100 * value:.0f} %"
    if isinstance(value, list):
        text = "\u2003".join(f"{x:.2f}" for x in value)
    elif key == "seconds":
        return f"{value:.1f} s"
    elif isinstance(value, float):
        text = f"{value:.7f}" if key in ("latitude", "longitude") else f"{value:.2f}"
    else:
        text = str(value)
    return f"{text} {_unit(key)[1]}".rstrip()


def _duration(seconds: Any) -> str:
    if not isinstance(seconds, int | float):
        return "-"
    hours, rest = divmod(int(seconds), 3600)
    return f"{hours} h {rest // 60} min" if hours else f"{rest // 60} min {rest % 60} s"
