"""Whose MAVLink behaviour the vehicle shows: PX4's or ArduPilot's, over the same flying underneath.

`flavour_of` makes the one that the configuration names; `base.Flavour` says what a flavour decides.
"""

from fakevehicle.config import Autopilot
from fakevehicle.flavours.ardupilot import ArduPilot
from fakevehicle.flavours.base import Flavour
from fakevehicle.flavours.px4 import Px4

__all__ = ["FLAVOURS", "Flavour", "flavour_of"]

FLAVOURS: dict[Autopilot, type[Flavour]] = {"px4": Px4, "ardupilot": ArduPilot}


def flavour_of(autopilot: Autopilot) -> Flavour:
    """A new one; it belongs to one vehicle, and knows nothing of it until `attach`."""
    return FLAVOURS[autopilot]()
