"""How near the loops are to instability: the largest sensitivity of the linear model of roll or pitch about hover.

One axis has one actuator, so what counts is the loop broken at the torque (as an angular acceleration), with all that
feeds it: body rate, attitude, velocity and position. With s = jw and

    C(s)  = Kp + Kt s^(-1/n) + Ki s^(-lambda) + Ki0/s + Kd s^mu F(s),  F = w_f/(s + w_f)       what acts on y
    R(s)  = b Kp + Kt s^(-1/n) + Ki s^(-lambda) + Ki0/s                                        what acts on r
    M(s)  = 1/(tau s + 1), tau the mean of up and down       H(s) = w_g/(s + w_g), the gyro's low pass
    D1(s) = exp(-1.5 T1 s), D2(s) = exp(-1.5 T2 s)            a tick of computing and half a tick of holding
    B(s)  = (C_v + R_v P_p/s)/s                               velocity and position, per tilt in units of g

    L_torque = M D1/s (C_r H + R_r D2 P_q/s (1 + B))
    L_tilt   = A B,   A = G/(1 + G),  G = T_r D2 P_q/s,  T_r = (M D1/s) R_r/(1 + (M D1/s) C_r H)

L_tilt is the outer loops broken where acceleration is asked for. For each, S = 1/(1 + L) and Ms = max |S|; the nearest
that L comes to -1 is 1/Ms, so gain may be raised by at least Ms/(Ms - 1) and phase may lag 2 asin(1/(2 Ms)) more
(Astrom & Hagglund, Advanced PID Control, 2006, sec. 4.6; s^alpha as the ideal operator, as in their Nyquist plots).

Stability itself is Nyquist's count. L has no poles to the right, and at 0 it is like s^-q: from 0+ to infinity the
argument of 1 + L turns by q pi/2, less pi for every pole of the closed loop to the right.

Left out: the estimator (its output follows the IMU, within a tick), saturation, drag, and the lead on acceleration,
which is feed-forward.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fakevehicle.airframe import Airframe
from fakevehicle.control.gains import FOPID_LOOPS, INNER_PERIOD, OUTER_PERIOD
from fakevehicle.params import ParameterSet

Complex = NDArray[np.complex128]
Values = Mapping[str, float] | ParameterSet
LOWEST, HIGHEST, POINTS = 1e-4, 3e3, 3000
"""The grid of frequencies [rad/s], even in the logarithm."""
UNSTABLE = 100.0
"""Ms of a loop that is not stable."""


@dataclass(frozen=True, slots=True)
class Margin:
    """Of one loop: its largest sensitivity and where [rad/s]; `UNSTABLE` when the closed loop is not stable."""

    ms: float
    frequency: float


@dataclass(frozen=True, slots=True)
class Margins:
    """Of the two places where the loops are broken."""

    torque: Margin
    tilt: Margin

    @property
    def ms(self) -> float:
        """The larger of both."""
        return max(self.torque.ms, self.tilt.ms)


def margin(loop: Callable[[Complex], Complex], order: float) -> Margin:
    """Largest sensitivity of a loop.

    Parameters
    ----------
    loop : L(s) on a vector of s = jw; without poles to the right of the imaginary axis.
    order : q, as which L goes like s^-q towards 0.
    """
    w = np.geomspace(LOWEST, HIGHEST, POINTS)
    back = 1.0 + loop(np.asarray(1j * w, np.complex128))
    turned = np.unwrap(np.angle(back))
    right = (order * math.pi / 2.0 - (turned[-1] - turned[0])) / math.pi
    k = int(np.argmin(np.abs(back)))
    if round(right) != 0:
        return Margin(UNSTABLE, float(w[k]))
    return Margin(min(max(float(1.0 / np.abs(back[k])), 1.0 + 1e-9), UNSTABLE), float(w[k]))


def margins(airframe: Airframe, values: Values) -> Margins:
    """Margins of the roll axis with these parameters.

    Parameters
    ----------
    values : of `fakevehicle.control.gains.PARAMETERS`, by name.
    """
    lag = 0.5 * (airframe.time_constant_up + airframe.time_constant_down)
    cutoff = 2.0 * math.pi * values["IMU_GYRO_CUTOFF"]
    attitude, place = values["MC_ROLL_P"], values["MPC_XY_P"]

    def inner(s: Complex) -> Complex:
        return np.exp(-1.5 * INNER_PERIOD * s) / (s * (lag * s + 1.0))

    def outer(s: Complex) -> Complex:
        on_y, on_r = law(values, "VXY", s)
        return (on_y + on_r * place / s) / s

    def turning(s: Complex) -> Complex:
        return np.exp(-1.5 * OUTER_PERIOD * s) * attitude / s

    def torque(s: Complex) -> Complex:
        on_y, on_r = law(values, "RXY", s)
        return inner(s) * (on_y * cutoff / (s + cutoff) + on_r * turning(s) * (1.0 + outer(s)))

    def tilt(s: Complex) -> Complex:
        on_y, on_r = law(values, "RXY", s)
        g = inner(s) * on_r / (1.0 + inner(s) * on_y * cutoff / (s + cutoff)) * turning(s)
        return g / (1.0 + g) * outer(s)

    velocity = order_at_zero(values, "VXY") + 1.0 + (1.0 if place > 0.0 else 0.0)
    rate = order_at_zero(values, "RXY") + 1.0 + (1.0 if attitude > 0.0 else 0.0)
    return Margins(margin(torque, rate + (velocity if attitude > 0.0 else 0.0)), margin(tilt, velocity))


def law(values: Values, name: str, s: Complex) -> tuple[Complex, Complex]:
    """C(s) and R(s) of the FOPID-TID loop `name` (VXY, RXY)."""
    p = {term: float(values[f"FT_{name}_{term}"]) for term in ("KP", "KT", "KI", "KI0", "KD", "B")}
    lam, mu, n = (float(values[f"FT_{name}_{order}"]) for order in ("LAMBDA", "MU", "TILTN"))
    cutoff = next(loop.cutoff for loop in FOPID_LOOPS if loop.name == name)
    slow = p["KT"] * s ** (-1.0 / n) + p["KI"] * s**-lam + p["KI0"] / s
    return p["KP"] + slow + p["KD"] * s**mu * cutoff / (s + cutoff), p["B"] * p["KP"] + slow


def order_at_zero(values: Values, name: str) -> float:
    """q of a loop's law: the highest order of integration that has a gain."""
    has = (("KT", 1.0 / values[f"FT_{name}_TILTN"]), ("KI", float(values[f"FT_{name}_LAMBDA"])), ("KI0", 1.0))
    return max((order for term, order in has if values[f"FT_{name}_{term}"] > 0.0), default=0.0)
