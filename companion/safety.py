"""What leads to what when something goes wrong in the air: a table.

`SAFETY` is read from the top: of the rules that have held long enough in the present phase, the first that names an
event is what happens, so the order is that of urgency. `HOLD` rules name none: while one of them holds, the mission's
clock stands and the vehicle waits on its path; each says why once. `Watch` is what the rules look at; `docs/safety.md`
is the table for people, and a test walks every row of both.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from enum import Enum

from companion.phases import Event, Phase

SILENT_S = 3.0
GIVE_UP_S = 60.0
POSITION_HOLD_S, POSITION_LAND_S = 0.5, 3.0
HEARTBEAT_S, MODE_S = 2.0, 30.0
ESTIMATOR_S = 1.5
HEARD_S = 1.5
"""A vehicle heard within this is there: its HEARTBEAT comes once a second."""
ADRIFT_M, ASTRAY_M = 1.0, 2.0
ROUNDING_M = 1e-6
ANSWERS_S = 3.0
"""PX4 returns to OFFBOARD within a second of setpoints that come again."""
STALLED_S = 0.5
BATTERY_LOW, BATTERY_CRITICAL = 0.15, 0.07
TROUBLE_S = 30.0
TAKEOFF_S = 30.0
"""More than the climb takes."""
REJOIN_S = 30.0


class Action(Enum):
    """What is done, most urgent first."""

    FAIL = "nothing more is sent"
    HAND_OVER = "whoever took the mode flies"
    WAIT = "speak on, and wait to hear it"
    LAND = "land here"
    GO_HOME = "the autopilot's own return"
    RETURN = "return on a planned way"
    REJOIN = "hold where it is, then fly back to the path"
    HOLD = "stand on the path"


@dataclass(frozen=True, slots=True)
class Watch:
    """What is looked at, once a tick; times in seconds of our clock."""

    phase: Phase
    phase_s: float = 0.0  # since it was entered
    takeoff_s: float = 0.0  # what the climb may take
    silent_s: float = 0.0  # since anything was heard of the vehicle
    position_s: float = 0.0  # since its last position
    heartbeat_s: float = 0.0  # since its last HEARTBEAT
    mode_s: float = 0.0  # since it last said in which mode it is, by HEARTBEAT or CURRENT_MODE
    estimator_s: float = 0.0  # since it last said how good its estimate is
    tick_gap_s: float = 0.02  # since our own tick before
    rebooted: bool = False
    disarmed: bool = False  # surely
    in_control: bool = True
    mode_sure: bool = True  # it is not perhaps an old mode, told by packets that came late
    mode: str = ""
    last_text: str = ""  # what the vehicle said lately, if it matters
    stream_lost: bool = False  # it left our mode only since it missed our setpoints
    failsafe: str = ""
    answers_s: float = 0.0  # since the vehicle answered us in this phase
    comes_down: bool = False
    came_down: bool = False  # it did so before
    on_ground: bool = False
    mode_asked: bool = False  # a change of mode is under way
    estimator: str = ""  # why its estimate is not one to fly by
    rejected: tuple[str, ...] = ()  # what its estimator does not believe
    error_m: float = 0.0  # from the reference
    battery: float | None = None  # what is left, 0..1
    blind: str = ""  # why it cannot be flown by what is seen
    returning: bool = False  # on the mission's own way home, since the battery is low
    no_way_home: str = ""  # why there is no such way
    going_home: bool = False  # it lands by the autopilot's own return
    jump: str = ""  # why the next setpoint does not follow from the last
    no_way: str = ""  # why there is nothing safe to fly but a stop
    held: str = ""  # why the mission's clock had to stand in the tick before
    fence_m: float | None = None  # from the reference to the fence, less what is kept; negative: too near


@dataclass(frozen=True, slots=True)
class Rule:
    """In `phases`, when `holds` has told a reason for `after_s`: `action`, by `event`."""

    name: str
    action: Action
    event: Event | None
    phases: frozenset[Phase]
    after_s: float
    holds: Callable[[Watch], str]


_FLOWN = frozenset({Phase.TAKING_OFF, Phase.FLYING, Phase.REJOINING})
_MISSION = frozenset({Phase.FLYING})
_WALKED = _MISSION | {Phase.TAKING_OFF}
"""Where the mission's clock runs: a climb by setpoints is walked, too."""


def _rebooted(w: Watch) -> str:
    return "the vehicle booted again in the air: nothing more is sent" if w.rebooted else ""


def _disarmed(w: Watch) -> str:
    return "the vehicle disarmed in the air, or never left the ground" if w.disarmed else ""


def _landed(w: Watch) -> str:
    return "landed" if w.disarmed else ""


def _gone(w: Watch) -> str:
    return f"nothing heard from the vehicle for {GIVE_UP_S:g} s" if w.silent_s > GIVE_UP_S else ""


def _taken(w: Watch) -> str:
    if w.in_control or w.stream_lost or w.mode_asked or not w.mode_sure:
        return ""
    return f"{w.failsafe or f'the vehicle is in {w.mode} now'}{w.last_text}; it is not fought for"


def _failsafe(w: Watch) -> str:
    if not w.stream_lost or w.in_control or not w.mode_sure or w.answers_s <= ANSWERS_S:
        return ""
    return f"{w.failsafe} though it hears us{w.last_text}; it is not fought for"


def _pilot_unknown(w: Watch) -> str:
    if w.mode_s <= MODE_S or w.silent_s >= HEARD_S:
        return ""
    return f"no HEARTBEAT from the vehicle for {MODE_S:g} s: who flies it is not known; it is not fought for"


def _stopped_landing(w: Watch) -> str:
    if w.comes_down or w.on_ground or not w.mode_sure or (not w.came_down and w.in_control):
        return ""
    if not w.came_down and (w.stream_lost or w.mode_asked):
        return ""
    return f"the vehicle stopped landing and is in {w.mode} now; it is not fought for"


def _silent(w: Watch) -> str:
    return f"nothing heard from the vehicle for {SILENT_S:g} s" if w.silent_s > SILENT_S else ""


def _no_position(w: Watch) -> str:
    lost = w.position_s > POSITION_LAND_S and w.silent_s < HEARD_S
    return f"no position from the vehicle for {POSITION_LAND_S:g} s: landing" if lost else ""


def _no_estimate(w: Watch) -> str:
    return f"{w.estimator}: landing" if w.estimator and w.silent_s < HEARD_S else ""


def _astray(w: Watch) -> str:
    if w.error_m <= ASTRAY_M or w.position_s > POSITION_HOLD_S or w.mode_s > HEARTBEAT_S:
        return ""  # untold it may be a pilot's
    return f"the vehicle is {w.error_m:.1f} m from its reference for 1 s: landing"


def _stranded(w: Watch) -> str:
    return f"no safe way for {TROUBLE_S:g} s ({w.no_way}): landing" if w.no_way else ""


def _blind_for_long(w: Watch) -> str:
    return f"nothing seen for {TROUBLE_S:g} s ({w.blind}): landing" if w.blind else ""


def _held_for_long(w: Watch) -> str:
    return f"held for {TROUBLE_S:g} s ({w.held}): landing" if w.held else ""


def _takeoff_late(w: Watch) -> str:
    late = w.phase_s > w.takeoff_s + TAKEOFF_S
    return f"not in the air {w.takeoff_s + TAKEOFF_S:.0f} s after the takeoff began: landing" if late else ""


def _rejoin_late(w: Watch) -> str:
    late = w.phase_s > REJOIN_S and w.mode_s <= HEARTBEAT_S
    return f"no way back to the mission in {REJOIN_S:g} s: landing" if late else ""


def _battery_critical(w: Watch) -> str:
    if w.phase is Phase.LANDING and not w.going_home:
        return ""  # it lands already
    return f"battery at {w.battery:.0%}: landing" if w.battery is not None and w.battery <= BATTERY_CRITICAL else ""


def _battery_low(w: Watch) -> str:
    low = w.battery is not None and w.battery <= BATTERY_LOW and not w.returning
    return f"battery at {w.battery:.0%}: returning" if low else ""


def _no_way_home(w: Watch) -> str:
    return f"no way home is planned ({w.no_way_home})" if w.returning and w.no_way_home else ""


def _stream_lost(w: Watch) -> str:
    lost = w.stream_lost and not w.in_control and w.mode_sure
    return f"the vehicle misses our setpoints and is in {w.mode}" if lost else ""


def _stalled(w: Watch) -> str:
    return f"no setpoint left for {w.tick_gap_s:.1f} s" if w.tick_gap_s > STALLED_S else ""


def _adrift(w: Watch) -> str:
    late = w.position_s > POSITION_HOLD_S
    return f"the vehicle is {w.error_m:.1f} m from its reference" if w.error_m > ADRIFT_M and not late else ""


def _jumped(w: Watch) -> str:
    return f"setpoints do not follow each other: {w.jump}" if w.jump else ""


def _position_late(w: Watch) -> str:
    return f"no position for {POSITION_HOLD_S:g} s" if w.position_s > POSITION_HOLD_S else ""


def _blind(w: Watch) -> str:
    return w.blind


def _no_heartbeat(w: Watch) -> str:
    late = w.heartbeat_s > HEARTBEAT_S and w.silent_s < HEARD_S
    return f"no HEARTBEAT for {SILENT_S:g} s, so its mode may be another's" if late else ""


def _unknown(w: Watch) -> str:
    late = w.estimator_s > ESTIMATOR_S and w.silent_s < HEARD_S
    return "no word of the estimator for 2 s" if late else ""


def _doubted(w: Watch) -> str:
    return f"the estimator rejects {' and '.join(w.rejected)}" if w.rejected else ""


def _at_the_fence(w: Watch) -> str:
    return "too near the fence" if w.fence_m is not None and w.fence_m < -ROUNDING_M else ""


_IN_AIR = _FLOWN | {Phase.LINK_LOST}
_LANDING, _HANDED = frozenset({Phase.LANDING}), frozenset({Phase.HANDED_OVER})

SAFETY: tuple[Rule, ...] = (
    Rule("rebooted", Action.FAIL, Event.REBOOTED, _IN_AIR | _LANDING | _HANDED, 0.0, _rebooted),
    Rule("disarmed", Action.FAIL, Event.DISARMED, _IN_AIR | _HANDED, 0.0, _disarmed),
    Rule("landed", Action.FAIL, Event.DISARMED, _LANDING, 0.0, _landed),
    Rule("gone", Action.FAIL, Event.GIVEN_UP, frozenset({Phase.LINK_LOST}) | _LANDING | _HANDED, 0.0, _gone),
    Rule("mode taken", Action.HAND_OVER, Event.MODE_LOST, _FLOWN, 0.0, _taken),
    Rule("failsafe", Action.HAND_OVER, Event.MODE_LOST, frozenset({Phase.REJOINING}), 0.0, _failsafe),
    Rule("pilot unknown", Action.HAND_OVER, Event.MODE_LOST, _FLOWN, 0.0, _pilot_unknown),
    Rule("landing stopped", Action.HAND_OVER, Event.MODE_LOST, _LANDING, 0.0, _stopped_landing),
    Rule("silent", Action.WAIT, Event.VEHICLE_SILENT, _FLOWN, 0.0, _silent),
    Rule("no position", Action.LAND, Event.LAND_ASKED, _FLOWN, 0.5, _no_position),  # not before one can have arrived
    Rule("no estimate", Action.LAND, Event.LAND_ASKED, _FLOWN, 1.0, _no_estimate),
    Rule("astray", Action.LAND, Event.LAND_ASKED, _FLOWN, 1.0, _astray),
    Rule("stranded", Action.LAND, Event.LAND_ASKED, _MISSION, TROUBLE_S, _stranded),
    Rule("blind for long", Action.LAND, Event.LAND_ASKED, _MISSION, TROUBLE_S, _blind_for_long),
    Rule("held for long", Action.LAND, Event.LAND_ASKED, _WALKED, TROUBLE_S, _held_for_long),
    Rule("takeoff late", Action.LAND, Event.LAND_ASKED, frozenset({Phase.TAKING_OFF}), 0.0, _takeoff_late),
    Rule("rejoining late", Action.LAND, Event.LAND_ASKED, frozenset({Phase.REJOINING}), 0.0, _rejoin_late),
    Rule("battery critical", Action.LAND, Event.LAND_ASKED, _FLOWN | _LANDING, 2.0, _battery_critical),
    Rule("no way home", Action.GO_HOME, Event.LAND_ASKED, _MISSION, 0.0, _no_way_home),
    Rule("battery low", Action.RETURN, Event.HOME_ASKED, _MISSION, 2.0, _battery_low),
    Rule("stream lost", Action.REJOIN, Event.INTERRUPTED, _WALKED, 0.0, _stream_lost),
    Rule("stalled", Action.REJOIN, Event.INTERRUPTED, _MISSION, 0.0, _stalled),
    Rule("adrift", Action.REJOIN, Event.INTERRUPTED, _MISSION, 0.3, _adrift),
    Rule("jump", Action.REJOIN, Event.INTERRUPTED, _WALKED, 0.0, _jumped),
    Rule("position late", Action.HOLD, None, _WALKED, 0.0, _position_late),
    Rule("blind", Action.HOLD, None, _MISSION, 0.0, _blind),
    Rule("no heartbeat", Action.HOLD, None, _WALKED, SILENT_S - HEARTBEAT_S, _no_heartbeat),
    Rule("estimate unknown", Action.HOLD, None, _WALKED, 0.5, _unknown),
    Rule("estimate doubted", Action.HOLD, None, _WALKED, 2.0, _doubted),
    Rule("at the fence", Action.HOLD, None, _WALKED, 0.0, _at_the_fence),
)


@dataclass(slots=True)
class Safety:
    """Keeps for how long each rule has held.

    Attributes
    ----------
    hold : why the mission's clock has to stand, or nothing.
    """

    hold: str = ""
    _since_us: dict[str, int] = field(default_factory=dict)

    def step(self, now_us: int, watch: Watch) -> tuple[Rule, str] | None:
        """The rule that acts now and its reason, if there is one."""
        acting: tuple[Rule, str] | None = None
        self.hold = ""
        for rule in SAFETY:
            reason = rule.holds(watch) if watch.phase in rule.phases else ""
            if not reason:
                self._since_us.pop(rule.name, None)
                continue
            since_us = self._since_us.setdefault(rule.name, now_us)
            if now_us - since_us < rule.after_s * 1e6:
                continue
            if rule.event is None:
                self.hold = self.hold or reason
            elif acting is None:
                acting = (rule, reason)
        return acting
