"""A battery as a telemetry source: charge that is drawn, voltage that sags. Nothing acts on it yet.

Hover power of a 2 kg quadrotor with 10 inch propellers is about 180 W [momentum theory at a figure of merit of 0.6];
power grows with thrust^1.5. Open-circuit voltage falls linearly from 4.2 to 3.5 V a cell.
"""

from dataclasses import dataclass

CELLS = 4
CAPACITY = 5.0 * 3600.0  # [A s], the 5000 mAh pack Holybro ships with the X500
RESISTANCE = 0.02  # [ohm] of the pack
IDLE_POWER = 8.0  # [W] electronics
FULL_POWER = 400.0  # [W] four motors at full thrust; 0.59^1.5 of it is the 180 W of hover


@dataclass(slots=True)
class Battery:
    """State of one pack; `draw` once a tick."""

    used: float = 0.0  # [A s]
    current: float = 0.0  # [A]

    @property
    def remaining(self) -> float:
        """0..1."""
        return max(0.0, 1.0 - self.used / CAPACITY)

    @property
    def voltage(self) -> float:
        """At the terminals [V]."""
        return CELLS * (3.5 + 0.7 * self.remaining) - RESISTANCE * self.current

    def draw(self, thrust: float, armed: bool, duration_s: float) -> None:
        """Take one tick's charge at a collective thrust of 0..1."""
        power = IDLE_POWER + (FULL_POWER * max(thrust, 0.0) ** 1.5 if armed else 0.0)
        self.current = power / self.voltage
        self.used += self.current * duration_s
