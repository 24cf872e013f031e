"""The battery's monitor: voltage, current and charge as it reads them, ten times a second.

It reads without noise; what can go wrong are faults, of words of three: voltage [V], current [A], remaining 0..1.
"""

import numpy as np

from fakevehicle.battery import Battery, Pack
from fakevehicle.faults import Channel, FaultSchedule, Sensor

MOST_V, MOST_A = 65.0, 320.0
"""What a monitor's registers, and MAVLink's fields, can hold."""


class Gauge:
    """What a monitor says about a battery.

    Parameters
    ----------
    battery : the true one.
    faults : of all sensors.
    rng : of NOISE faults.

    Attributes
    ----------
    pack : its numbers.
    voltage, current, remaining : as they were read last [V], [A], 0..1.
    silent : whether nothing comes; the numbers are then the last ones.
    """

    def __init__(self, battery: Battery, faults: FaultSchedule, rng: np.random.Generator) -> None:
        self._battery, self._faults = battery, faults
        self._channel = Channel(Sensor.BATTERY, faults, rng)
        self.silent = False
        self.voltage, self.current, self.remaining = battery.voltage, battery.current, battery.remaining

    @property
    def used(self) -> float:
        """Charge that was drawn, counted apart from what may fail [A s]."""
        return self._battery.used

    @property
    def pack(self) -> Pack:
        """The pack's numbers."""
        return self._battery.pack

    def read(self, now_us: int) -> None:
        """Look at the battery."""
        b = self._battery
        self.voltage, self.current, self.remaining = (
            (b.voltage, b.current, b.remaining)
            if not self._faults.concerns(Sensor.BATTERY)
            else self._spoilt(now_us, np.array([b.voltage, b.current, b.remaining]))
        )

    def _spoilt(self, now_us: int, word: np.ndarray[tuple[int], np.dtype[np.float64]]) -> tuple[float, float, float]:
        said = self._channel.through(now_us, word)
        self.silent = said is None
        if said is None:
            return self.voltage, self.current, self.remaining
        voltage, current, remaining = said.tolist()
        return min(max(voltage, 0.0), MOST_V), min(max(current, -MOST_A), MOST_A), min(max(remaining, 0.0), 1.0)
