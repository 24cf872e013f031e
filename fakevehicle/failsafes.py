"""What can go wrong in flight, and what is done about it: one table.

`RULES[trigger]` names the parameter that chooses and what each of its values stands for; without a parameter there is
no choice. Actions are ordered by severity. `Failsafes.step` says what has newly begun: a trigger fires when it begins,
and again only after it has gone, so that a pilot who asks for another mode afterwards is obeyed. Of several the most
severe wins. What an action means in each mode is for the modes' own table to say (`modes.py`).

Names and numbers are PX4's. Its values that need sticks are not offered.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from enum import Enum, IntEnum

from fakevehicle.modes import Event
from fakevehicle.params import Parameter, ParameterSet, ParameterType

_I = ParameterType.INT32
PARAMETERS: tuple[Parameter, ...] = (
    Parameter("COM_OF_LOSS_T", 1.0, 0.1, 60.0, "s", "Setpoints missing for this long end OFFBOARD"),
    Parameter("COM_OBL_RC_ACT", 5, 3, 5, "", "What follows then: 3 return, 4 land, 5 hold", _I),
    Parameter("COM_POS_FS_DELAY", 2.0, 0.0, 30.0, "s", "Position not known for this long in flight is lost"),
    Parameter("COM_DL_LOSS_T", 10.0, 1.0, 300.0, "s", "No ground station's heartbeat for this long: data link lost"),
    Parameter("NAV_DLL_ACT", 0, 0, 6, "", "What follows: 0 nothing, 1 hold, 2 return, 3 land, 5 and 6 motors off", _I),
    Parameter("BAT_LOW_THR", 0.15, 0.05, 0.9, "", "Charge left that is low"),
    Parameter("BAT_CRIT_THR", 0.07, 0.02, 0.5, "", "Charge left that is critical"),
    Parameter("BAT_EMERGEN_THR", 0.05, 0.01, 0.4, "", "Charge left that is an emergency"),
    Parameter(
        "COM_LOW_BAT_ACT", 0, 0, 3, "", "Critical charge: 0 a warning, 2 land, 3 return, land in an emergency", _I
    ),
    Parameter("CBRK_FLIGHTTERM", 121212, 0, 121212, "", "Fallen over in flight: 0 motors off, 121212 a warning", _I),
    Parameter("COM_LKDOWN_TKO", 3.0, -1.0, 5.0, "s", "Fallen over this long after takeoff, or before: motors off"),
    Parameter("GF_ACTION", 2, 0, 5, "", "Fence: 0 nothing, 1 a warning, 2 hold, 3 return, 4 motors off, 5 land", _I),
)


class Trigger(Enum):
    """What went wrong; the value tells it to people."""

    STREAM_LOST = "setpoints stopped"
    LINK_LOST = "no connection to the ground station"
    BATTERY_LOW = "battery low"
    BATTERY_CRITICAL = "battery critical"
    BATTERY_EMERGENCY = "battery nearly empty"
    POSITION_LOST = "position lost"
    FENCE_BREACHED = "fence breached"
    FALLEN = "attitude failure"
    FALLEN_AT_TAKEOFF = "attitude failure at takeoff"
    MISSION_UNFIT = "mission not possible"


class Action(IntEnum):
    """What is done, the less severe first."""

    NOTHING = 0
    WARN = 1
    HOLD = 2
    RETURN = 3
    LAND = 4
    MOTORS_OFF = 5


_N, _W, _H, _R, _L, _M = Action.NOTHING, Action.WARN, Action.HOLD, Action.RETURN, Action.LAND, Action.MOTORS_OFF


@dataclass(frozen=True, slots=True)
class Rule:
    """What follows a trigger.

    Attributes
    ----------
    parameter : chooses; empty: the only action in `actions` is under 0.
    actions : by the parameter's value; one that is not listed does nothing.
    """

    parameter: str
    actions: Mapping[int, Action]


RULES: Mapping[Trigger, Rule] = {
    Trigger.STREAM_LOST: Rule("COM_OBL_RC_ACT", {3: _R, 4: _L, 5: _H}),
    Trigger.LINK_LOST: Rule("NAV_DLL_ACT", {1: _H, 2: _R, 3: _L, 5: _M, 6: _M}),
    Trigger.BATTERY_LOW: Rule("", {0: _W}),
    Trigger.BATTERY_CRITICAL: Rule("COM_LOW_BAT_ACT", {0: _W, 2: _L, 3: _R}),
    Trigger.BATTERY_EMERGENCY: Rule("COM_LOW_BAT_ACT", {0: _W, 2: _L, 3: _L}),
    Trigger.POSITION_LOST: Rule("", {0: _L}),
    Trigger.FALLEN: Rule("CBRK_FLIGHTTERM", {0: _M, 121212: _W}),
    Trigger.FALLEN_AT_TAKEOFF: Rule("", {0: _M}),
    Trigger.FENCE_BREACHED: Rule("GF_ACTION", {1: _W, 2: _H, 3: _R, 4: _M, 5: _L}),
    Trigger.MISSION_UNFIT: Rule("", {0: _H}),
}
EVENTS: Mapping[Action, Event] = {
    Action.HOLD: Event.FAIL_HOLD,
    Action.RETURN: Event.FAIL_RTL,
    Action.LAND: Event.FAIL_LAND,
}
"""The modes' events of those actions that are a mode. A return or a hold without a position is a landing."""


def battery_triggers(remaining: float, parameters: ParameterSet) -> tuple[Trigger, ...]:
    """What a charge of 0..1 triggers: every threshold it is below."""
    thresholds = (
        (Trigger.BATTERY_LOW, "BAT_LOW_THR"),
        (Trigger.BATTERY_CRITICAL, "BAT_CRIT_THR"),
        (Trigger.BATTERY_EMERGENCY, "BAT_EMERGEN_THR"),
    )
    return tuple(trigger for trigger, name in thresholds if remaining < parameters[name])


@dataclass(frozen=True, slots=True)
class Tripped:
    """A trigger that has newly begun, and what is to be done."""

    trigger: Trigger
    action: Action


class Failsafes:
    """Remembers which triggers hold, so that each fires once."""

    def __init__(self, parameters: ParameterSet) -> None:
        self._parameters = parameters
        self._holding: frozenset[Trigger] = frozenset()

    def action(self, trigger: Trigger) -> Action:
        """What the parameters choose for a trigger."""
        rule = RULES[trigger]
        value = int(self._parameters[rule.parameter]) if rule.parameter else 0
        return rule.actions.get(value, Action.NOTHING)

    def step(self, holding: Iterable[Trigger]) -> list[Tripped]:
        """What has begun since the last step and does something, the most severe first."""
        now = frozenset(holding)
        if now == self._holding:
            return []
        begun = [Tripped(trigger, self.action(trigger)) for trigger in Trigger if trigger in now - self._holding]
        self._holding = now
        return sorted((t for t in begun if t.action is not Action.NOTHING), key=lambda t: -t.action)
