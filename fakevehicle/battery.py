"""A battery: charge that is drawn, voltage that sags, and motors that turn slower for it.

Open-circuit voltage of a lithium-polymer cell falls linearly from 4.2 V to 3.5 V over the capacity that is used; the
pack's resistance takes its share of the current. Power goes with the cube of the rotor speeds (thrust^1.5, momentum
theory). A motor's full speed is proportional to the voltage (a speed constant, as brushless motors are sold by), and
an airframe's `max_rotor_speed` belongs to a full pack without load; `sag` is what is left of it.
"""

from dataclasses import dataclass
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

FULL_CELL, EMPTY_CELL = 4.2, 3.5
"""Open-circuit voltage of a cell [V]: charged, and at the end of the capacity that is used."""

_Positive = Annotated[float, Field(gt=0, allow_inf_nan=False)]
_NotNegative = Annotated[float, Field(ge=0, allow_inf_nan=False)]


class Pack(BaseModel):
    """A battery's numbers, as an airframe's file gives them.

    Raises
    ------
    pydantic.ValidationError : a number cannot be.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    cells: Annotated[int, Field(ge=1, le=14)]  # in series
    capacity: _Positive  # [A h]
    resistance: _NotNegative  # of the pack [ohm]
    idle_power: _NotNegative  # electronics [W]
    full_power: _Positive  # the motors at full speed [W]


@dataclass(slots=True)
class Battery:
    """State of one pack; `draw` some fifty times a second.

    Attributes
    ----------
    pack : its numbers.
    capacity : [A s]; the pack's, unless somebody wants it to be empty sooner.
    used : [A s].
    current : [A].
    silent : never; its monitor (`sensors.gauge`) may be.
    """

    pack: Pack
    capacity: float = 0.0
    used: float = 0.0
    current: float = 0.0
    silent: bool = False

    def __post_init__(self) -> None:
        self.capacity = self.capacity or 3600.0 * self.pack.capacity

    @property
    def remaining(self) -> float:
        """0..1."""
        return max(0.0, 1.0 - self.used / self.capacity)

    @property
    def voltage(self) -> float:
        """At the terminals [V]; never less than half the empty one, where electronics would have given up."""
        cells = self.pack.cells
        open_circuit = cells * (EMPTY_CELL + (FULL_CELL - EMPTY_CELL) * self.remaining)
        return max(open_circuit - self.pack.resistance * self.current, 0.5 * EMPTY_CELL * cells)

    @property
    def sag(self) -> float:
        """Voltage over that of a full pack without load."""
        return self.voltage / (FULL_CELL * self.pack.cells)

    def draw(self, effort: float, duration_s: float) -> None:
        """Take some charge.

        Parameters
        ----------
        effort : mean over the rotors of (speed / full speed)^3.
        duration_s : [s].
        """
        power = self.pack.idle_power + self.pack.full_power * effort
        self.current = power / self.voltage
        self.used += self.current * duration_s
