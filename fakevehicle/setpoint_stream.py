"""The newest setpoint that a peer has sent: how old it is, and what it means on the ground and in the air."""

import math

from fakevehicle.guidance import asks_to_climb, asks_to_sink, completed
from fakevehicle.landing import TOUCH_THRUST
from fakevehicle.params import Parameter, ParameterSet
from fakevehicle.vocabulary import Setpoint

LIFT_PATIENCE_US = 2_000_000
"""A standing vehicle in OFFBOARD keeps its motors flying this long after the last setpoint that asked to climb."""
PARAMETERS: tuple[Parameter, ...] = (
    Parameter("GUID_TIMEOUT", 3.0, 0.1, 10.0, "s", "Guided mode: setpoints without a position are flown this long"),
)


class SetpointStream:
    """Keeps the newest setpoint.

    Parameters
    ----------
    parameters : the vehicle's.
    hover : collective thrust of a hover, 0..1 of the maximum.

    Attributes
    ----------
    newest : None when there was none, or something else has taken its place.
    """

    def __init__(self, parameters: ParameterSet, hover: float) -> None:
        self._parameters = parameters
        self._hover = hover
        self.newest: Setpoint | None = None
        self._newest_us = 0
        self._climb_us: int | None = None  # when one last asked a standing vehicle to climb

    @property
    def by_thrust(self) -> bool:
        """Whether attitude or body rates are asked for, which need no position."""
        return self.newest is not None and not math.isnan(self.newest.thrust)

    def take(self, now_us: int, setpoint: Setpoint) -> None:
        """One more has come."""
        self.newest, self._newest_us = completed(setpoint), now_us

    def fresh(self, now_us: int) -> bool:
        """Whether the newest came within COM_OF_LOSS_T."""
        return self.newest is not None and now_us - self._newest_us < self._parameters["COM_OF_LOSS_T"] * 1e6

    def settle(self) -> None:
        """Nobody has asked to climb yet: another mode has begun, or the ground was left or reached."""
        self._climb_us = None

    def sinks(self, z: float) -> bool:
        """Whether a vehicle at down coordinate `z` [m] is asked to sink for a while yet."""
        asked = self.newest
        if asked is None:
            return False
        return asked.thrust < TOUCH_THRUST * self._hover if self.by_thrust else asks_to_sink(asked, z)

    def offboard(self, now_us: int, z: float, airborne: bool) -> Setpoint | None:
        """What OFFBOARD flies: a standing vehicle, at down coordinate `z` [m], idles until it is asked to climb."""
        asked = self.newest
        if asked is None or airborne:
            return asked
        if asks_to_climb(asked, z):
            self._climb_us = now_us
        lifting = self._climb_us is not None and now_us - self._climb_us < LIFT_PATIENCE_US
        return asked if lifting else None

    def guided(self, now_us: int) -> Setpoint | None:
        """What GUIDED flies: with a position for ever, else for GUID_TIMEOUT; after that it is forgotten."""
        asked = self.newest
        if asked is None:
            return None
        old_s = (now_us - self._newest_us) * 1e-6
        if not math.isnan(float(asked.position_n[0])) or old_s < self._parameters["GUID_TIMEOUT"]:
            return asked
        self.newest = None
        return None
