"""Whether the vehicle has fallen over, as PX4's failure detector has it: roll or pitch beyond a limit for a while.

Judged from the estimate, armed or not. What follows is for the failsafes' table to say; that it may not be armed is for
the modes'. Names and defaults are PX4's (docs.px4.io, failure detector).
"""

import math

from fakevehicle.params import Parameter, ParameterSet, ParameterType
from fakevehicle.vocabulary import Glance

_I = ParameterType.INT32
PARAMETERS: tuple[Parameter, ...] = (
    Parameter("FD_FAIL_R", 60, 0, 180, "deg", "Roll beyond this is an attitude failure; 0: never", _I),
    Parameter("FD_FAIL_P", 60, 0, 180, "deg", "Pitch beyond this is an attitude failure; 0: never", _I),
    Parameter("FD_FAIL_R_TTRI", 0.3, 0.02, 5.0, "s", "for so long"),
    Parameter("FD_FAIL_P_TTRI", 0.3, 0.02, 5.0, "s", "for so long"),
)


class FlipDetector:
    """Debounces roll and pitch; `fallen` is the answer.

    Parameters
    ----------
    parameters : the vehicle's.
    """

    def __init__(self, parameters: ParameterSet) -> None:
        self._parameters = parameters
        self._since_us: dict[str, int] = {}
        self.fallen = False

    def step(self, now_us: int, glance: Glance) -> None:
        """Look at the estimate at `now_us` [us]; an attitude that is not known is none that has failed."""
        w, x, y, z = glance.q_nb
        upright = 1.0 - 2.0 * (x * x + y * y)  # cosine of the tilt: no angle is larger than that
        if upright > 0.9 and not self._since_us and not self.fallen:
            return
        roll = math.atan2(2.0 * (w * x + y * z), upright)
        pitch = math.asin(min(max(2.0 * (w * y - z * x), -1.0), 1.0))
        self.fallen = False
        for axis, angle in (("R", roll), ("P", pitch)):
            limit = self._parameters[f"FD_FAIL_{axis}"]
            if not glance.attitude_valid or limit == 0 or abs(math.degrees(angle)) <= limit:
                self._since_us.pop(axis, None)
                continue
            since_us = self._since_us.setdefault(axis, now_us)
            self.fallen |= now_us - since_us >= 1e6 * self._parameters[f"FD_FAIL_{axis}_TTRI"]
