"""What the live page is fed with: one thread writes moments of a flight, any number of pages read at their own pace.

A row is a moment: its time, then `COLUMNS`. Of more than `MOST_ROWS` the older half loses every other row, again and
again, so that a page opened late has the whole flight and memory is bounded; the newest half of `MOST_ROWS` at least is
kept as it came (5 minutes at 20 Hz), and at most three quarters. A reader asks for what came after what it has seen
(`since`); one that was slow gets at most `MOST_AT_ONCE` rows of it, evenly. So there is no queue per reader that could
fill up, and nobody waits for a reader.

Orders go the other way: `order` keeps what a page asks for until the flight loop takes it (`take_order`), at most
`MOST_ORDERS`.
"""

import math
import threading
from bisect import bisect_right
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from companion.seam import Order
from logs.report import contract

MOST_ROWS, MOST_AT_ONCE, MOST_EVENTS, MOST_WAYS, MOST_ORDERS = 12_000, 200, 1000, 100, 16
Row = tuple[float, ...]
Json = dict[str, Any]

TRACKS = ("n", "e", "u", "roll", "pitch", "yaw", "rn", "re", "ru")
PLOTS: tuple[tuple[str, str, str, str, tuple[str, ...]], ...] = (
    ("error", "tracking", "Tracking error", "m", ("distance",)),
    ("altitude", "path", "Altitude", "m", ("flown", "reference")),
    ("speed", "path", "Speed", "m/s", ("horizontal", "up")),
    ("tilt", "path", "Roll and pitch", "°", ("roll", "pitch")),
    ("setpoints", "setpoints", "Setpoints sent", "Hz", ("rate",)),
    ("silence", "link", "Since the vehicle was last heard", "ms", ("silence",)),
    ("lost", "link", "Packets lost on the way", "", ("lost",)),
    ("battery", "link", "Battery", "%", ("left",)),
)
"""Id, section, title, unit and labels of each plot, in the order of a row's values after `TRACKS`."""
COLUMNS = (*TRACKS, *(f"{plot}.{label}" for plot, _, _, _, labels in PLOTS for label in labels))
NOTHING = contract.Track([], [], [], [])


@dataclass(frozen=True, slots=True)
class Answer:
    """What became of an order."""

    order: str
    ok: bool
    text: str

    def to_json(self) -> Json:
        """As the page reads it."""
        return {"answer": {"order": self.order, "ok": self.ok, "text": self.text}}


@dataclass(frozen=True, slots=True)
class Asked:
    """An order of a page's, and whom to answer."""

    order: Order
    answer: Callable[[Answer], None]


@dataclass(frozen=True, slots=True)
class Way:
    """A plan; its points (k, 3) north, east, up [m] are worked out by whoever reads it."""

    t: float
    points: Callable[[], Sequence[Sequence[float]]]
    kind: str

    def to_json(self) -> Json:
        """As the page reads it."""
        return {"t": self.t, "points": [_short(x) for point in self.points() for x in point], "kind": self.kind}


@dataclass(slots=True)
class Seen:
    """How far a reader is."""

    flight: int = -1
    row: int = 0
    event: int = 0
    way: int = 0
    header: int = 0


@dataclass(slots=True)
class _Flight:
    """One flight's data; counters go on when the oldest are dropped."""

    header: contract.Header
    scene: contract.Scene
    rows: list[tuple[int, Row]] = field(default_factory=list)
    events: deque[tuple[int, contract.Event]] = field(default_factory=lambda: deque(maxlen=MOST_EVENTS))
    ways: deque[tuple[int, Way]] = field(default_factory=lambda: deque(maxlen=MOST_WAYS))
    row: int = 0
    event: int = 0
    way: int = 0
    headers: int = 0


class Feed:
    """One writer, any readers.

    Attributes
    ----------
    flying : whether orders are taken.
    """

    def __init__(self, title: str = "companion") -> None:
        self._lock = threading.Lock()
        self._number = 0
        self._flight = _Flight(contract.Header(title), contract.Scene(NOTHING, reference=NOTHING))
        self._orders: deque[Asked] = deque()
        self.flying = False

    # ---- written by the flight loop -----------------------------------------------------------------------------

    def begin(self, header: contract.Header, scene: contract.Scene, *, orders: bool = True) -> None:
        """A new flight, which takes orders or not: every page begins anew."""
        with self._lock:
            self._flight, self._number = _Flight(header, scene), self._number + 1
            self._orders.clear()
            self.flying = orders

    def sample(self, row: Row) -> None:
        """A moment: its time [s], then `COLUMNS`; NaN is not known."""
        flight = self._flight
        with self._lock:
            flight.row += 1
            flight.rows.append((flight.row, row))
            if len(flight.rows) > MOST_ROWS:
                half = len(flight.rows) // 2
                flight.rows[:half] = flight.rows[:half:2]

    def event(self, event: contract.Event) -> None:
        """A line of the timeline."""
        flight = self._flight
        with self._lock:
            flight.event += 1
            flight.events.append((flight.event, event))

    def way(self, way: Way) -> None:
        """A plan."""
        flight = self._flight
        with self._lock:
            flight.way += 1
            flight.ways.append((flight.way, way))

    def header(self, **changes: Any) -> None:
        """Fields of the header that change: phase, ok, failure, checks ..."""
        flight = self._flight
        with self._lock:
            flight.headers += 1
            flight.header = replace(flight.header, **changes)

    def end(self) -> None:
        """No more orders; those that wait are refused."""
        with self._lock:
            self.flying = False
            waiting, self._orders = list(self._orders), deque()
        for asked in waiting:
            asked.answer(Answer(asked.order.name, False, "the flight is over"))

    def take_order(self) -> Asked | None:
        """The oldest order that nobody has taken yet."""
        if not self._orders:
            return None
        with self._lock:
            return self._orders.popleft() if self._orders else None

    # ---- read by pages ------------------------------------------------------------------------------------------

    def order(self, asked: Asked) -> str:
        """Hand an order to the flight loop; why not, or nothing."""
        with self._lock:
            if not self.flying:
                return "no flight is under way"
            if len(self._orders) >= MOST_ORDERS:
                return "too many orders wait"
            self._orders.append(asked)
        return ""

    def since(self, seen: Seen) -> Json | None:
        """What a reader has not seen: the whole object first and after a change of flight; None: nothing."""
        with self._lock:
            flight, number = self._flight, self._number
            whole = seen.flight != number
            if whole:
                seen.flight, seen.row, seen.event, seen.way, seen.header = number, 0, 0, 0, 0
            rows = [row for _, row in flight.rows[bisect_right(flight.rows, seen.row, key=lambda entry: entry[0]) :]]
            events = [event for at, event in flight.events if at > seen.event] if flight.event > seen.event else []
            ways = [way for at, way in flight.ways if at > seen.way] if flight.way > seen.way else []
            header = flight.header if flight.headers > seen.header else None
            seen.row, seen.event, seen.way, seen.header = flight.row, flight.event, flight.way, flight.headers
        if whole:
            return _whole(flight, rows, events, ways)
        more = _more(rows[:: -(-len(rows) // MOST_AT_ONCE)] if rows else [])
        if events:
            more["events"] = [event.to_json() for event in events]
        if ways:
            more["plans"] = [way.to_json() for way in ways]
        if header is not None:
            more["header"] = header.to_json()
        return {"append": more} if more else None


def _whole(flight: _Flight, rows: list[Row], events: list[contract.Event], ways: list[Way]) -> Json:
    """The one object of the contract, as of now."""
    columns = dict(zip(("t", *COLUMNS), zip(*rows, strict=True) if rows else [[]] * (1 + len(COLUMNS)), strict=True))
    t: Any = columns["t"]
    path = contract.Track(t, *(columns[name] for name in TRACKS[:6]))
    reference = contract.Track(t, *(columns[name] for name in TRACKS[6:]))
    plots = tuple(
        contract.Plot(
            plot, section, title, unit, tuple(contract.Series(label, t, columns[f"{plot}.{label}"]) for label in labels)
        )
        for plot, section, title, unit, labels in PLOTS
    )
    scene = replace(flight.scene, path=path, reference=reference)
    report: Json = contract.Report(flight.header, scene, plots, events=tuple(events)).to_json()
    report["scene"]["plans"] = [way.to_json() for way in ways]
    return report


def _more(rows: list[Row]) -> Json:
    """Rows as the page appends them."""
    if not rows:
        return {}
    short = [[_short(value) for value in row] for row in rows]
    series: dict[str, Mapping[str, Any]] = {}
    at, times = 1 + len(TRACKS), [row[0] for row in short]
    for plot, _, _, _, labels in PLOTS:
        series[plot] = {label: [times, [row[at + k] for row in short]] for k, label in enumerate(labels)}
        at += len(labels)
    newest = short[-1]
    more: Json = {"series": series}
    path = [row[:7] for row in short if row[1] is not None]
    if path:
        more["path"] = path
        more["pose"] = dict(zip(TRACKS[:6], newest[1:7], strict=True))
    reference = [[row[0], *row[7:10]] for row in short if row[7] is not None]
    if reference:
        more["reference"] = reference
    return more


def _short(value: float) -> float | None:
    """For JSON: tenths of millimetres are enough; what is not known is null."""
    return round(value, 4) if math.isfinite(value) else None
