"""Thrust that gives a climb rate: what ArduPilot makes of an attitude setpoint's thrust, whose half means "stay".

A vehicle with a thrust of r times its hover's, tilted by theta, accelerates upwards by g (r cos(theta) - 1). So the
thrust for a climb rate w is

    T = T_hover (1 + k (w - w_now) / g) / cos(theta),        d T_hover / dt = k_i (w - w_now)

where T_hover is first taken from what it hovers with and then learned. k is the bandwidth; k_i is slow against it.
"""

from dataclasses import dataclass

G = 9.80665
BANDWIDTH = 2.5
"""k [1/s]."""
LEARNING = 0.05
"""k_i [1/m], of thrust 0..1."""
STRONGEST = 3.0
"""Largest acceleration it asks for [m/s^2]."""
LEAST_COSINE = 0.5
"""Steeper tilts get no more thrust than this asks for."""


@dataclass(slots=True)
class ClimbThrust:
    """Remembers the hover thrust, 0..1 of the maximum."""

    hover: float

    def step(self, wanted: float, climb: float, cosine: float, dt_s: float) -> float:
        """The thrust, 0..1.

        Parameters
        ----------
        wanted, climb : climb rates asked for and now [m/s], up positive.
        cosine : of the tilt.
        dt_s : since the last step [s].
        """
        error = wanted - climb
        self.hover = min(max(self.hover + LEARNING * error * dt_s, 0.1), 0.9)
        rise = min(max(BANDWIDTH * error, -STRONGEST), STRONGEST)
        return min(max(self.hover * (1.0 + rise / G) / max(cosine, LEAST_COSINE), 0.0), 1.0)


def climb_rate(thrust: float, up: float, down: float) -> float:
    """What a thrust of 0..1 asks for [m/s]: 0.5 nothing, 1 `up`, 0 `down` [m/s], both positive numbers."""
    return 2.0 * (thrust - 0.5) * (up if thrust >= 0.5 else down)
