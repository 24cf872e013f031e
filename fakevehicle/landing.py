"""Whether the vehicle stands or flies, judged from its own estimate and thrust, never from truth.

It has taken off when it pushes and has risen or climbs. It has landed when the loops, still asked to sink, have let go
of the thrust and nothing moves: in free fall the speed gives it away, in a steady descent the thrust does.
"""

import math
from dataclasses import dataclass

from fakevehicle.vocabulary import Estimate

LIFT_THRUST = 0.35  # of the maximum; a hovering X500 needs 0.59
LIFT_HEIGHT = 0.2  # [m] above where it stood
LIFT_CLIMB = 0.3  # [m/s]
LIFT_TIME_US = 80_000
LAND_THRUST = 0.3
LAND_SINK = 0.3  # [m/s] either way
LAND_DRIFT = 1.0  # [m/s]
LAND_TIME_US = 1_000_000


@dataclass(slots=True)
class LandDetector:
    """Debounces the two transitions; `airborne` is the answer."""

    airborne: bool = False
    _since_us: int | None = None
    _standing_z: float = math.nan  # [m] down coordinate where it last stood

    def step(self, now_us: int, estimate: Estimate, thrust: float, armed: bool) -> None:
        """Look at one tick.

        Parameters
        ----------
        now_us : [us].
        estimate : the estimator's newest.
        thrust : collective the loops command, 0..1 of the maximum.
        armed : disarmed motors give no thrust, whatever is commanded.
        """
        _, _, z = estimate.position_n.tolist()
        vn, ve, vd = estimate.velocity_n.tolist()
        thrust = thrust if armed else 0.0
        if self.airborne:
            changing = thrust < LAND_THRUST and abs(vd) < LAND_SINK and math.hypot(vn, ve) < LAND_DRIFT
            needed_us = LAND_TIME_US
        else:
            if not armed or math.isnan(self._standing_z):
                self._standing_z = z
            changing = thrust > LIFT_THRUST and (self._standing_z - z > LIFT_HEIGHT or -vd > LIFT_CLIMB)
            needed_us = LIFT_TIME_US
        if not changing:
            self._since_us = None
        elif self._since_us is None:
            self._since_us = now_us
        elif now_us - self._since_us >= needed_us:
            self.airborne = not self.airborne
            self._since_us = None
            self._standing_z = z
