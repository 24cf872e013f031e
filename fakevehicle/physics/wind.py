# mypy: disable-error-code="no-untyped-def"
# kernels: numba types them by their arguments, which the docstrings name
"""Wind: a steady part, gusts on a schedule, and Dryden turbulence (MIL-F-8785C, low altitude) discretised exactly.

Below 1000 ft, with h the height in ft and W20 the mean wind at 20 ft (MIL-F-8785C, 3.7.3.4):

    sigma_w = 0.1 W20,   sigma_u = sigma_v = sigma_w / (0.177 + 0.000823 h)^0.4
    L_w = h,             L_u = L_v = h / (0.177 + 0.000823 h)^1.2

The axes are the wind's: u along the mean wind over ground, w down, v to the right of both; in still air u is north.
White noise n of unit intensity goes through the forming filters of the spectra, with T = L / V at airspeed V
(MIL-F-8785C, 3.7.1.2):

    H_u(s) = sigma_u sqrt(2 T) / (1 + T s)                     H_v,w(s) = sigma sqrt(T) (1 + sqrt(3) T s) / (1 + T s)^2

In states of dimension one, p' = -p/T + n/sqrt(T) and q' = (p - q)/T, the second is sigma (sqrt(3) p + (1 - sqrt(3)) q).
Its stationary covariances are <pp> = 1/2, <pq> = <qq> = 1/4, which gives the variance sigma^2. A step of theta = dt/T:

    p+ = e p + a                      e = exp(-theta)           <aa> = (1 - e^2) / 2
    q+ = e (theta p + q) + b                                    <ab> = (1 - e^2 (1 + 2 theta)) / 4
                                                                <bb> = (1 - e^2 (1 + 2 theta + 2 theta^2)) / 4

which is the continuous process at the sampling times whatever dt is, so the variance does not depend on the step.
"""

import math
from dataclasses import dataclass

import numpy as np

from fakevehicle.jit import kernel
from fakevehicle.vocabulary import FloatArray

FEET = 3.280839895
ROOT3 = math.sqrt(3.0)
TURBULENCE = 5
"""States, and normal draws a step: one for u, two each for v and w."""


@dataclass(frozen=True, slots=True)
class Gust:
    """A gust on the schedule: it rises as half a cosine, holds and falls again as it rose.

    Attributes
    ----------
    start_us : when it begins [us].
    rise_s, hold_s : how long it takes to rise, and stays [s].
    velocity_n : (3,) what it adds to the wind at its height, NED [m/s].

    Raises
    ------
    ValueError : a time below zero, or a velocity that is not three finite numbers.
    """

    start_us: int
    rise_s: float
    hold_s: float
    velocity_n: FloatArray

    def __post_init__(self) -> None:
        if not (self.start_us >= 0 and 0.0 <= self.rise_s < math.inf and 0.0 <= self.hold_s < math.inf):
            raise ValueError(f"gust at {self.start_us} us, rise {self.rise_s} s, hold {self.hold_s} s: expected >= 0")
        if np.shape(self.velocity_n) != (3,) or not np.all(np.isfinite(self.velocity_n)):
            raise ValueError(f"gust {self.velocity_n}: expected three finite numbers, north, east, down")


def gust_table(gusts: tuple[Gust, ...]) -> FloatArray:
    """(n, 6) start, rise, hold [s] and velocity in n [m/s], as `scheduled` reads it."""
    rows = [[g.start_us * 1e-6, g.rise_s, g.hold_s, *np.asarray(g.velocity_n, float)] for g in gusts]
    return np.array(rows, dtype=float).reshape(-1, 6)


@kernel
def scheduled(table, now, wind):
    """Add the gusts of a `gust_table` that blow at `now` [s] to `wind`, (3,) in n [m/s], in place."""
    for k in range(table.shape[0]):
        since, rise, hold = now - table[k, 0], table[k, 1], table[k, 2]
        if since <= 0.0 or since >= 2.0 * rise + hold:
            continue
        share = 1.0
        if since < rise:
            share = 0.5 - 0.5 * math.cos(math.pi * since / rise)
        elif since > rise + hold:
            share = 0.5 + 0.5 * math.cos(math.pi * (since - rise - hold) / rise)
        for i in range(3):
            wind[i] += share * table[k, 3 + i]


@kernel
def across(state, first, theta, noise):
    """One step of a second-order process, states and draws at `first` and `first + 1`; its value over sigma."""
    e = math.exp(-theta)
    aa = -0.5 * math.expm1(-2.0 * theta)
    ab = 0.25 * (1.0 - e * e * (1.0 + 2.0 * theta))
    bb = 0.25 * (1.0 - e * e * (1.0 + 2.0 * theta + 2.0 * theta * theta))
    a = math.sqrt(aa)
    p, q = state[first], state[first + 1]
    state[first] = e * p + a * noise[first]
    state[first + 1] = (
        e * (theta * p + q) + ab / a * noise[first] + math.sqrt(max(bb - ab * ab / aa, 0.0)) * noise[first + 1]
    )
    return ROOT3 * state[first] + (1.0 - ROOT3) * state[first + 1]


@kernel
def turbulence(state, strength, height, airspeed, dt, noise):
    """Advance the turbulence by `dt`.

    Parameters
    ----------
    state : (TURBULENCE,) of dimension one, in place; zeros at the start.
    strength : W20, mean wind at 20 ft [m/s].
    height : above ground [m]; taken as at least 3 m and at most 300 m, the range of the model.
    airspeed : [m/s], taken as at least 1 (the turbulence drifts past a hovering vehicle with the mean wind).
    dt : [s], > 0.
    noise : (TURBULENCE,) standard normal draws.

    Returns
    -------
    u, v, w : in wind axes [m/s].
    """
    h = min(max(height, 3.0), 300.0) * FEET
    shape = 0.177 + 0.000823 * h
    sigma_w = 0.1 * strength
    sigma_u = sigma_w / shape**0.4
    length_w = h / FEET
    length_u = length_w / shape**1.2
    speed = max(airspeed, 1.0)
    theta_u, theta_w = speed * dt / length_u, speed * dt / length_w
    state[0] = math.exp(-theta_u) * state[0] + math.sqrt(-math.expm1(-2.0 * theta_u)) * noise[0]
    v = across(state, 1, theta_u, noise)
    w = across(state, 3, theta_w, noise)
    return sigma_u * state[0], sigma_u * v, sigma_w * w
