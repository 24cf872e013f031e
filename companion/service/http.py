"""The service's page on this machine: `/` to read, `/state.json` for programs, `/health` and `/ready` for watchdogs.

Served from a thread of its own, which only hands out what the flight loop left in a `Board`; there is nothing to send
here that would change a flight.
"""

import json
import socket
import threading
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from html import escape
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

from companion.errors import LinkError

STALE_S = 2.0
"""What a loop has not put up again for so long is not its state any more."""
HUNG_S = 15.0
"""A loop that has put up nothing for so long does not turn any more: whoever looks after the process may restart it.
Compiling kernels the first time may take seconds."""
TIMEOUT_S = 5.0
MOST_THREADS = 16
HOSTS = ("127.0.0.1", "localhost", "[::1]")


class Board:
    """Where the flight loop puts up its state."""

    def __init__(self) -> None:
        self._state: dict[str, Any] = {}
        self._at_s = -1e9

    def put(self, state: dict[str, Any]) -> None:
        """Put up a state; it must not be changed afterwards."""
        self._state, self._at_s = state, time.monotonic()

    def state(self) -> dict[str, Any]:
        """What is up now."""
        return self._state

    def hung(self) -> str:
        """Why the process is of no use any more, or nothing. A vehicle that is not there is no reason."""
        return "the loop hangs" if time.monotonic() - self._at_s > HUNG_S else ""

    def not_ready(self) -> str:
        """Why no vehicle can be flown or watched just now, or nothing."""
        if time.monotonic() - self._at_s > STALE_S:
            return f"the loop has not shown its state for {STALE_S:g} s"
        return "" if self._state.get("vehicle", {}).get("heard") else "the vehicle is not heard"


@contextmanager
def served(place: tuple[str, int], board: Board) -> Iterator[tuple[str, int]]:
    """Serve the board as long as this lasts; yields where.

    Raises
    ------
    LinkError : the port is taken.
    """
    family = socket.AF_INET6 if ":" in place[0] else socket.AF_INET
    server_class = type("Server", (_Server,), {"board": board, "address_family": family})
    try:
        server = server_class(place, _Handler)
    except OSError as error:
        raise LinkError(f"http {place[0]}:{place[1]}: {error.strerror or error}") from error
    thread = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.2}, name="http", daemon=True)
    thread.start()
    try:
        yield server.server_address[0], server.server_address[1]
    finally:
        server.shutdown()
        server.server_close()
        thread.join(TIMEOUT_S)


class _Server(ThreadingHTTPServer):
    board: Board
    daemon_threads = True
    _busy = threading.BoundedSemaphore(MOST_THREADS)

    def process_request(self, request: Any, client_address: Any) -> None:
        if not self._busy.acquire(blocking=False):
            self.shutdown_request(request)
            return
        super().process_request(request, client_address)

    def process_request_thread(self, request: Any, client_address: Any) -> None:
        try:
            super().process_request_thread(request, client_address)
        finally:
            self._busy.release()

    def handle_error(self, request: Any, client_address: Any) -> None:
        """A reader that goes away is nobody's trouble."""


class _Handler(BaseHTTPRequestHandler):
    server: _Server
    timeout = TIMEOUT_S
    server_version, sys_version = "companion", ""

    def do_GET(self) -> None:
        host = self.headers.get("Host", "").rsplit(":", 1)[0] if self.headers.get("Host") != "[::1]" else "[::1]"
        if host not in HOSTS:
            self._answer(HTTPStatus.FORBIDDEN, "text/plain", b"this page is for this machine only\n")
            return
        match self.path.partition("?")[0]:
            case "/":
                page = render(self.server.board.state(), self.server.board.not_ready())
                self._answer(HTTPStatus.OK, "text/html", page.encode())
            case "/state.json":
                self._answer(HTTPStatus.OK, "application/json", _json(self.server.board.state()))
            case "/health":
                self._judge(self.server.board.hung())
            case "/ready":
                self._judge(self.server.board.not_ready())
            case _:
                self._answer(HTTPStatus.NOT_FOUND, "text/plain", b"there are /, /state.json, /health and /ready\n")

    do_HEAD = do_GET

    def _judge(self, reason: str) -> None:
        status = HTTPStatus.SERVICE_UNAVAILABLE if reason else HTTPStatus.OK
        self._answer(status, "application/json", _json({"ok": not reason, "reason": reason or None}))

    def _answer(self, status: HTTPStatus, kind: str, body: bytes) -> None:
        self.send_response(status)
        self.send_header("Content-Type", f"{kind}; charset=utf-8")
        self.send_header("Content-Length", str(len(body)))
        self.send_header("Cache-Control", "no-store")
        self.send_header("X-Content-Type-Options", "nosniff")
        policy = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; connect-src 'self'"
        self.send_header("Content-Security-Policy", policy)
        self.end_headers()
        if self.command != "HEAD":
            self.wfile.write(body)

    def log_message(self, format: str, *args: Any) -> None:
        """The log is for flights."""


def _json(value: Mapping[str, Any]) -> bytes:
    return json.dumps(value, indent=2, allow_nan=False).encode() + b"\n"


STYLE = """
:root { color-scheme: light dark; --ink: #1c2126; --soft: #5b6670; --paper: #f6f7f8; --card: #ffffff; --line: #dde2e6;
  --good: #14733c; --bad: #b3261e; --busy: #1a5fb4; }
@media (prefers-color-scheme: dark) { :root { --ink: #e6e9ec; --soft: #9aa5af; --paper: #14181c; --card: #1c2228;
  --line: #313a42; --good: #5bc98a; --bad: #ff8a80; --busy: #7db3f5; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--paper); color: var(--ink); font: 15px/1.5 system-ui, sans-serif; }
main { max-width: 60rem; margin: 0 auto; padding: 1.5rem 1rem; }
header { display: flex; flex-wrap: wrap; gap: .25rem 1rem; align-items: baseline; margin-bottom: 1rem; }
h1 { font-size: 1.5rem; margin: 0; } h2 { font-size: 1rem; margin: 0 0 .5rem; color: var(--soft); font-weight: 600; }
.state { font-weight: 600; color: var(--busy); } .good { color: var(--good); } .bad { color: var(--bad); }
.cards { display: grid; grid-template-columns: repeat(auto-fit, minmax(17rem, 1fr)); gap: 1rem; }
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
    well = f'<span class="bad">{escape(ill)}</span>' if ill else '<span class="good">healthy</span>'
    cards = "".join(_card(title, state[key]) for key, title in LABELS.items() if state.get(key))
    notes = "".join(
        f"<li><time>{escape(note['time'][11:19])}</time>"
        f'<span class="{"bad" if note["level"] == "error" else ""}">{escape(note["text"])}</span></li>'
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
        f"<footer>version {escape(str(state.get('version', '')))}, up {_duration(state.get('up_s'))} · "
        '<a href="/state.json">state.json</a> · <a href="/health">health</a> · <a href="/ready">ready</a>'
        "</footer></main>"
        f"<script>{SCRIPT}</script></body></html>"
    )


def _card(title: str, values: Mapping[str, Any]) -> str:
    rows = "".join(
        f"<tr><td>{escape(_label(key))}</td><td>{escape(_shown(key, value))}</td></tr>"
        for key, value in values.items()
        if value is not None
    )
    return f"<section><h2>{escape(title)}</h2><table>{rows}</table></section>"


UNITS = (("_m_s", "m/s"), ("_m", "m"), ("_s", "s"), ("_ms", "ms"), ("_hz", "Hz"), ("_deg", "°"), ("_mb", "MB"))


def _unit(key: str) -> tuple[str, str]:
    """The ending of a key that is a unit, and the unit."""
    return max(((e, u) for e, u in UNITS if key.endswith(e)), key=lambda pair: len(pair[0]), default=("", ""))


def _label(key: str) -> str:
    return key.removesuffix(_unit(key)[0]).replace("_", " ")


def _shown(key: str, value: Any) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    if key == "battery":
        return f"{100 * value:.0f} %"
    if isinstance(value, list):
        text = "  ".join(f"{x:.2f}" for x in value)
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
