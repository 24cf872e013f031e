"""How high the ground below is, by the rangefinder: a filter of one state beside the big one.

The state is the down coordinate of the ground below, in the estimator's frame. A distance d along z_b, with R_nb's last
entry c = cos(tilt), says

    t = z + c d,      R = c^2 (sigma^2 + (share d)^2)

with z of the estimator's output. Between samples the ground may slope, and z wanders with its own error:

    P <- P + WANDER^2 dt + (gradient v dt)^2                    v over ground

The height above ground is t - z at any time, so that it follows the vehicle between samples and beyond. Nothing of this
goes back into the height itself: what stands on the ground must not move the vehicle.

a sample that is             is                             since
-----------------------------------------------------------------------------------------------------------
out of reach (NaN)           passed over
of a tilt above TILT         passed over                    the beam looks aside
outside the gate             refused                        a bird, an edge, a fault
STEP refusals that agree     believed: a new ground         a roof, a table
the same for STUCK_US        passed over, in flight         real sensors never say the same for so long

The height is valid while a sample was taken in within `aiding.STALE_US`.
"""

import math
import struct

from fakevehicle.estimator.aiding import Aid
from fakevehicle.params import Parameter, ParameterSet
from fakevehicle.vocabulary import FloatArray, RangeSample

PARAMETERS: tuple[Parameter, ...] = (
    Parameter("EKF2_RNG_NOISE", 0.02, 0.01, 2.0, "m", "estimator: rangefinder noise"),
    Parameter("EKF2_RNG_SFE", 0.005, 0, 0.2, "m/m", "estimator: rangefinder noise as a share of the distance"),
    Parameter("EKF2_RNG_GATE", 5.0, 0.1, 20, "SD", "estimator: gate of the rangefinder"),
    Parameter("EKF2_TERR_GRAD", 0.5, 0, 2, "m/m", "estimator: slope of the ground"),
)
WANDER = 0.1
"""Of the estimator's height against the ground [m/sqrt(s)]."""
TILT = math.cos(math.radians(45.0))
"""Least cosine of the tilt at which a sample counts, as PX4's range_cos_max_tilt."""
STEP = 6
"""Refusals in a row that agree with each other are a new ground; a third of a second."""
LONGEST_S = 1.0
"""Time between samples that the ground is let wander for, at most [s]."""

_DOUBLE = struct.Struct("<d")


class Terrain:
    """The ground below.

    Parameters
    ----------
    parameters : the values of (at least) `PARAMETERS`.

    Attributes
    ----------
    down : its down coordinate in the estimator's frame [m].
    variance : of it [m^2].
    test_ratio : sqrt(NIS) of the newest sample over its gate, above 1: refused; NaN before the first.
    resets : how often a new ground was believed.
    """

    def __init__(self, parameters: ParameterSet) -> None:
        self.down = 0.0
        self.variance = math.inf
        self.test_ratio = math.nan
        self.resets = 0
        self._aid = Aid()
        self._taken_us = 0
        self._refused = 0  # in a row, and agreeing
        self._candidate = 0.0
        self.configure(parameters)

    def configure(self, p: ParameterSet) -> None:
        """Read the parameters again."""
        self._noise, self._share = float(p["EKF2_RNG_NOISE"]), float(p["EKF2_RNG_SFE"])
        self._gate, self._gradient = float(p["EKF2_RNG_GATE"]), float(p["EKF2_TERR_GRAD"])

    def valid(self, now_us: int) -> bool:
        """Whether it is known now."""
        return self._aid.fresh(now_us)

    def moved(self, delta_down: float) -> None:
        """The estimate's height has jumped by this [m]; the ground jumps with it."""
        self.down += delta_down
        self._candidate += delta_down

    def take(self, sample: RangeSample, out: FloatArray, flying: bool) -> None:
        """Take a sample in.

        Parameters
        ----------
        sample : the newest of the rangefinder.
        out : (16,) the estimator's output at that time, see `Estimator`.
        flying : whether the motors carry it.
        """
        now_us = sample.now_us
        _, _, z, vx, vy, _, _, qx, qy = out[:9].tolist()
        c = 1.0 - 2.0 * (qx * qx + qy * qy)
        stuck = self._aid.stuck(_DOUBLE.pack(sample.distance), now_us)
        if math.isnan(sample.distance) or c < TILT or (stuck and flying):
            self._refused = 0
            return
        dt = min((now_us - self._taken_us) * 1e-6, LONGEST_S)
        self._taken_us = now_us
        slope = self._gradient * math.hypot(vx, vy) * dt
        wandered = WANDER * WANDER * dt + slope * slope
        noise = c * c * (self._noise**2 + (self._share * sample.distance) ** 2)
        measured = z + c * sample.distance
        if math.isinf(self.variance):
            self.down, self.variance = measured, noise
            self._aid.accept(now_us)
            return
        self.variance += wandered
        innovation, spread = measured - self.down, self.variance + noise
        self.test_ratio = abs(innovation) / (self._gate * math.sqrt(spread))
        if self.test_ratio > 1.0:
            agrees = abs(measured - self._candidate) <= self._gate * math.sqrt(2.0 * noise + wandered)
            self._refused = self._refused + 1 if agrees else 1
            self._candidate = measured
            if self._refused < STEP:
                return
            self.down, self.variance = measured, noise
            self.resets += 1
        else:
            gain = self.variance / spread
            self.down += gain * innovation
            self.variance *= 1.0 - gain
        self._refused = 0
        self._aid.accept(now_us)
