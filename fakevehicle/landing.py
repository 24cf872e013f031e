"""Whether the vehicle stands or flies, judged from its own estimate and thrust, never from truth.

It has taken off when it pushes and has risen or climbs. It has landed when the loops, still asked to sink, have let go
of the thrust and nothing moves: in free fall the speed gives it away, in a steady descent the thrust does.

Before that it touches the ground, when it is asked to sink and does not although the thrust is below a hover's. Whoever
flies it should then let the motors idle: loops that go on pulling feet over the ground against the wind wind themselves
up, lean, and keep the thrust too high for the landing to be seen. Were it wrong, in the air, 0.6 m/s of sinking would
end it, which idling motors give within six hundredths of a second.
"""

import math
from dataclasses import dataclass

from fakevehicle.vocabulary import Glance

LIFT_THRUST = 0.6  # of a hover's, as the other thrusts
LIFT_HEIGHT = 0.2  # [m] above where it stood
LIFT_CLIMB = 0.3  # [m/s]
LIFT_TIME_US = 80_000
LAND_THRUST = 0.5
LAND_SINK = 0.3  # [m/s] either way
LAND_DRIFT = 1.0  # [m/s]
BLIND_DRIFT = 3.0  # [m/s] while the velocity is not known: it is still the newest guess
LAND_TIME_US = 1_000_000
TOUCH_THRUST = 0.85
TOUCH_SINK = 0.1  # [m/s] either way; every descent is asked to be faster
LET_GO_SINK = 0.6  # [m/s] either way: a vehicle that leaned into the wind falls back on its feet
TOUCH_TIME_US = 400_000


@dataclass(slots=True)
class LandDetector:
    """Debounces the transitions; `airborne` is the answer, and `touching` says that the ground is probably there.

    `hover` is the thrust of a hover, as a share of the maximum: what a thrust means depends on the airframe.
    """

    hover: float
    airborne: bool = False
    touching: bool = False
    _still_since_us: int | None = None
    _since_us: int | None = None
    _standing_z: float = math.nan  # [m] down coordinate where it last stood

    def step(self, now_us: int, glance: Glance, armed: bool, sinking: bool) -> None:
        """Look at one tick.

        Parameters
        ----------
        now_us : [us].
        glance : the estimate's newest, and the collective that the loops command.
        armed : disarmed motors give no thrust, whatever is commanded.
        sinking : whether the loops are asked to sink.
        """
        z, vn, ve, vd = glance.z, glance.vx, glance.vy, glance.vz
        thrust = glance.thrust / self.hover if armed else 0.0
        drifting, limit = math.hypot(vn, ve), LAND_DRIFT if glance.velocity_valid else BLIND_DRIFT
        slow = LET_GO_SINK if self.touching else TOUCH_SINK
        resting = thrust < TOUCH_THRUST and abs(vd) < slow and drifting < limit
        if not (self.airborne and sinking and resting):
            self._still_since_us = None
        elif self._still_since_us is None:
            self._still_since_us = now_us
        self.touching = self._still_since_us is not None and now_us - self._still_since_us >= TOUCH_TIME_US
        if self.airborne:
            changing = thrust < LAND_THRUST and abs(vd) < LAND_SINK and drifting < limit
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
