# mypy: disable-error-code="no-untyped-def"
# kernels: numba types them by their arguments, which the docstrings name
"""Wind: a steady part and Dryden turbulence (MIL-F-8785C, low altitude), discretised exactly.

Below 1000 ft, with h the height in ft and W20 the mean wind at 20 ft:

    sigma_w = 0.1 W20,   sigma_u = sigma_v = sigma_w / (0.177 + 0.000823 h)^0.4
    L_w = h,             L_u = L_v = h / (0.177 + 0.000823 h)^1.2

Here each component is a first-order Gauss-Markov process of those sigma and L at airspeed V,

    u' = -(V/L) u + sigma sqrt(2 V/L) w(t)    =>    u_k+1 = a u_k + sigma sqrt(1 - a^2) n_k,   a = exp(-V dt / L)

which is Dryden's longitudinal form exactly, for any dt; for the lateral and vertical components it is the usual
first-order stand-in of the second-order form, with the same variance and scale length.
"""

import math
from dataclasses import dataclass

from fakevehicle.jit import kernel
from fakevehicle.vocabulary import FloatArray

FEET = 3.280839895


@dataclass(frozen=True, slots=True)
class Gust:
    """A gust on the schedule: it rises, holds and falls again as fast as it rose.

    Attributes
    ----------
    start_us : when it begins [us].
    rise_s, hold_s : how long it takes to rise, and stays [s].
    velocity_n : (3,) what it adds to the wind at its height, NED [m/s].
    """

    start_us: int
    rise_s: float
    hold_s: float
    velocity_n: FloatArray


@kernel
def gust_step(gust, strength, height, airspeed, dt, noise):
    """Advance the turbulence by `dt` in place.

    Parameters
    ----------
    gust : (3,) turbulent part of the wind in n [m/s].
    strength : W20, mean wind at 20 ft [m/s]; 0 is calm.
    height : above ground [m]; taken as at least 3 m and at most 300 m, the range of the model.
    airspeed : [m/s], taken as at least 1 (the turbulence drifts past a hovering vehicle with the mean wind).
    dt : [s].
    noise : (3,) standard normal draws.
    """
    h = min(max(height, 3.0), 300.0) * FEET
    shape = 0.177 + 0.000823 * h
    sigma_w = 0.1 * strength
    sigma_u = sigma_w / shape**0.4
    length_w = h / FEET
    length_u = length_w / shape**1.2
    speed = max(airspeed, 1.0)
    for i in range(3):
        sigma = sigma_u if i < 2 else sigma_w
        a = math.exp(-speed * dt / (length_u if i < 2 else length_w))
        gust[i] = a * gust[i] + sigma * math.sqrt(1.0 - a * a) * noise[i]
