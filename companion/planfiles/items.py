"""Plan items, as ground stations keep and send them.

An item is a MAV_CMD with a frame and seven numbers; x and y are latitude and longitude [deg] in a global frame, north
and east [m] in a local one, z is an altitude above home, above the sea, or down, as the frame says. `reading` makes
our steps of them, `writing` them of our steps.
"""

from dataclasses import dataclass, field
from typing import Any

from wire.dialect import mavlink

MOST_ITEMS = 1000
"""Of one plan."""
NAN = float("nan")

_m = mavlink
GLOBAL = {
    _m.MAV_FRAME_GLOBAL: False,
    _m.MAV_FRAME_GLOBAL_INT: False,
    _m.MAV_FRAME_GLOBAL_RELATIVE_ALT: True,
    _m.MAV_FRAME_GLOBAL_RELATIVE_ALT_INT: True,
}
"""Frames with latitude and longitude: whether the altitude counts from home."""


@dataclass(frozen=True, slots=True)
class Item:
    """One item.

    Attributes
    ----------
    command : MAV_CMD.
    frame : MAV_FRAME.
    params : p1 to p7; NaN where nothing is said.
    extra : what a file has beside that; kept as it is.
    """

    command: int
    frame: int
    params: tuple[float, float, float, float, float, float, float]
    extra: dict[str, Any] = field(default_factory=dict, compare=False)

    @property
    def follows(self) -> bool:
        """Whether the next item is flown after it without being asked for; formats write the word in two ways."""
        return bool(self.extra.get("autocontinue", self.extra.get("autoContinue", True)))

    @property
    def name(self) -> str:
        """MAV_CMD's name and number."""
        entry = _m.enums["MAV_CMD"].get(self.command)
        return f"{entry.name} ({self.command})" if entry is not None else f"MAV_CMD {self.command}"


@dataclass(frozen=True, slots=True)
class GroundPlan:
    """A mission's items as ground stations count them, and where the mission's steps have them.

    Attributes
    ----------
    items : all of them, with the home that some plans begin with.
    first : the first that is flown; those before it are home.
    begins, ends : by item: the step that it begins with, and the step at which it is over.
    fence : items of the fence.
    """

    items: tuple[Item, ...] = ()
    first: int = 0
    begins: tuple[int, ...] = ()
    ends: tuple[int, ...] = ()
    fence: tuple[Item, ...] = ()

    def current(self, step: int) -> int:
        """The item that is flown in a step; the number of items where none is left."""
        return next((k for k, end in enumerate(self.ends) if k >= self.first and end > step), len(self.items))

    def step_of(self, item: int) -> int | str:
        """The step that an item begins with, or why it cannot be begun with."""
        if not self.first <= item < len(self.items):
            return f"found item {item}, expected {self.first} to {len(self.items) - 1}"
        before = self.ends[item - 1] if item > self.first else 0
        if self.begins[item] < before == self.ends[item]:
            return f"item {item} is flown in one with the one before it"
        return before


class ItemFlaw(ValueError):
    """An item that is not flown: `index` and why, `what` one clause."""

    def __init__(self, index: int, what: str, unsupported: bool = False) -> None:
        self.index, self.what, self.unsupported = index, what, unsupported
        super().__init__(f"item {index}: {what}")
