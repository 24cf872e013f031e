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
    def name(self) -> str:
        """MAV_CMD's name and number."""
        entry = _m.enums["MAV_CMD"].get(self.command)
        return f"{entry.name} ({self.command})" if entry is not None else f"MAV_CMD {self.command}"


class ItemFlaw(ValueError):
    """An item that is not flown: `index` and why, `what` one clause."""

    def __init__(self, index: int, what: str, unsupported: bool = False) -> None:
        self.index, self.what, self.unsupported = index, what, unsupported
        super().__init__(f"item {index}: {what}")
