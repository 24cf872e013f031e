# mypy: disable-error-code="no-untyped-def"
# kernels: numba types them by their arguments, which the docstrings name
"""The FOPID-TID law, one loop a call.

    u = u_ff + Kp (b r - y) + Kt D^(-1/n) e + (Ki D^(-lambda) + Ki0 D^(-1)) e - Kd D^mu F(s) y,     e = r - y

Special cases: Kt = 0 is the paper's FOPID (eq. 42); Kp = 0, lambda = mu = 1 is Lurie's tilt-integral-derivative (US
5,371,670); Kt = 0, lambda = mu = 1 is PID. The derivative acts on the measurement only (c = 0) and its coefficients
never change in flight. The paper's Algorithm 1 adds lambda + mu to u, which has no dimension to stand in: not done.

D^(-lambda) is s^(1 - lambda) followed by a trapezoidal 1/s, so that the last thing in the chain is an integrator: the
one anti-windup feeds. It holds Ki times the integral, so that a change of Ki does not bump the output. Rules:

    back-calculation    I += T (u_sat - u) / T_t,   T_t = (Kp / Ki)^(1/lambda)
                        but never past I = 0: the plain form winds the integral up the other way during a long
                        saturation, and a fractional one takes many seconds to come back from there
    conditional         no integration while it would push further into a limit that is active

Records instead of arguments: `LOOP` holds one loop's numbers, `BANK` the filter coefficients and states of all loops.
"""

import numpy as np

from fakevehicle.control.fractional import SECTIONS, run_sections, sections
from fakevehicle.jit import kernel
from fakevehicle.vocabulary import FloatArray

LOOP = np.dtype(
    [
        ("kp", "f8"),
        ("kt", "f8"),
        ("ki", "f8"),
        ("ki0", "f8"),
        ("kd", "f8"),
        ("b", "f8"),  # setpoint weight of the proportional term
        ("period", "f8"),
        ("limit", "f8"),  # the integral stays within +-limit, in units of u
        ("track", "f8"),  # 1 / T_t
        ("n_tilt", "i8"),
        ("n_integral", "i8"),
        ("n_derivative", "i8"),
        ("f_b", "f8"),  # F(s) = w/(s + w) by Tustin: y = f_b (x + x1) - f_a y1
        ("f_a", "f8"),
        ("f_x", "f8"),
        ("f_y", "f8"),
        ("integral", "f8"),  # output of the integrator, gains included
        ("driven", "f8"),  # its input at the last call
        ("p_out", "f8"),  # b r - y
        ("t_out", "f8"),  # D^(-1/n) e
        ("d_out", "f8"),  # -D^mu F y
        ("primed", "f8"),  # 0 until the derivative has seen its first sample
    ]
)
TILT, INTEGRAL, DERIVATIVE = 0, 1, 2


@kernel
def fopid_step(loops, coefficients, states, i, setpoint, measured, forward, pushed):
    """One sample of loop `i`.

    Parameters
    ----------
    loops : (n,) records of `LOOP`.
    coefficients : (3 n, SECTIONS, 3) filter sections, rows TILT, INTEGRAL, DERIVATIVE of each loop.
    states : (3 n, SECTIONS).
    setpoint, measured : r and y.
    forward : u_ff, added to the output.
    pushed : u_sat - u of the last sample, 0 when nothing saturated.

    Returns
    -------
    u, not limited.
    """
    loop = loops[i]
    e = setpoint - measured
    loop.p_out = loop.b * setpoint - measured
    loop.t_out = 0.0
    if loop.kt != 0.0:
        loop.t_out = run_sections(coefficients, states, 3 * i + TILT, loop.n_tilt, e)
    driven = 0.0
    if loop.ki != 0.0:
        driven = loop.ki * run_sections(coefficients, states, 3 * i + INTEGRAL, loop.n_integral, e)
    driven += loop.ki0 * e
    growth = 0.5 * loop.period * (driven + loop.driven)
    loop.driven = driven
    if pushed * growth < 0.0:
        growth = 0.0
    loop.integral += growth
    if pushed * loop.integral < 0.0:  # the integral has a part in the excess: take it back, at most to zero
        back = loop.period * loop.track * pushed
        loop.integral = loop.integral + back if abs(back) < abs(loop.integral) else 0.0
    loop.integral = min(max(loop.integral, -loop.limit), loop.limit)
    loop.d_out = 0.0
    if loop.kd != 0.0:
        if loop.primed == 0.0:  # as if the first measurement had stood there for ever
            loop.primed = 1.0
            loop.f_x, loop.f_y = measured, measured
            rest = -measured
            for k in range(loop.n_derivative):
                b0, b1, a1 = (
                    coefficients[3 * i + DERIVATIVE, k, 0],
                    coefficients[3 * i + DERIVATIVE, k, 1],
                    coefficients[3 * i + DERIVATIVE, k, 2],
                )
                out = rest * (b0 + b1) / (1.0 + a1)
                states[3 * i + DERIVATIVE, k] = b1 * rest - a1 * out
                rest = out
        smooth = loop.f_b * (measured + loop.f_x) - loop.f_a * loop.f_y
        loop.f_x, loop.f_y = measured, smooth
        loop.d_out = run_sections(coefficients, states, 3 * i + DERIVATIVE, loop.n_derivative, -smooth)
    return forward + loop.kp * loop.p_out + loop.kt * loop.t_out + loop.integral + loop.kd * loop.d_out


class LoopBank:
    """Several FOPID-TID loops that run together: their records, filters and the rules for changing them.

    Parameters
    ----------
    periods : sampling period of each loop [s].

    Attributes
    ----------
    loops : (n,) of `LOOP`.  coefficients : (3 n, SECTIONS, 3).  states : (3 n, SECTIONS).
    """

    def __init__(self, periods: tuple[float, ...]) -> None:
        n = len(periods)
        self.loops = np.zeros(n, LOOP)
        self.loops["period"] = periods
        self.coefficients: FloatArray = np.zeros((3 * n, SECTIONS, 3))
        self.states: FloatArray = np.zeros((3 * n, SECTIONS))

    def set_gains(
        self, i: int, *, kp: float, kt: float, ki: float, ki0: float, kd: float, b: float, lam: float, limit: float
    ) -> None:
        """Change loop `i`'s gains without a jump of its output: I takes up u_prev - (the other terms with new gains).

        Parameters
        ----------
        lam : order lambda of the integral, for the tracking time only.
        limit : bound of the integral, in units of u.
        """
        loop = self.loops[i]
        before = loop["kp"] * loop["p_out"] + loop["kt"] * loop["t_out"] + loop["kd"] * loop["d_out"]
        before += loop["integral"]
        loop["kp"], loop["kt"], loop["ki"], loop["ki0"], loop["kd"], loop["b"] = kp, kt, ki, ki0, kd, b
        loop["limit"] = limit
        total = ki + ki0
        loop["track"] = (total / kp) ** (1.0 / lam) if kp > 0.0 and total > 0.0 else 1.0 if total > 0.0 else 0.0
        after = loop["kp"] * loop["p_out"] + loop["kt"] * loop["t_out"] + loop["kd"] * loop["d_out"]
        loop["integral"] = min(max(before - after, -limit), limit)
        if ki == ki0 == 0.0:
            loop["integral"] = 0.0

    def set_orders(
        self, i: int, *, lam: float, mu: float, tilt_n: float, band: tuple[float, float], derivative_cutoff: float
    ) -> None:
        """Change loop `i`'s orders and forget what its filters remember; only while the motors are at rest.

        Parameters
        ----------
        lam, mu : orders of integral and derivative, 0..1.
        tilt_n : the tilt term is s^(-1/n).
        band : where the operators are accurate [rad/s].
        derivative_cutoff : corner of F(s) [rad/s].
        """
        loop = self.loops[i]
        period = float(loop["period"])
        chains = (
            (TILT, "n_tilt", -1.0 / tilt_n),
            (INTEGRAL, "n_integral", 1.0 - lam),
            (DERIVATIVE, "n_derivative", mu),
        )
        for row, name, alpha in chains:
            chain = sections(alpha, band[0], band[1], period)
            loop[name] = len(chain)
            self.coefficients[3 * i + row, : len(chain)] = chain
        c = 2.0 / period
        loop["f_b"] = derivative_cutoff / (c + derivative_cutoff)
        loop["f_a"] = (derivative_cutoff - c) / (c + derivative_cutoff)
        self.clear(i)

    def clear(self, i: int) -> None:
        """Loop `i` as new: no memory, no trim."""
        loop = self.loops[i]
        self.states[3 * i : 3 * i + 3] = 0.0
        for name in ("f_x", "f_y", "integral", "driven", "p_out", "t_out", "d_out", "primed"):
            loop[name] = 0.0

    def rebase(self, i: int) -> None:
        """Forget the errors of the past but keep the trim: the integral takes over what the tilt term was giving."""
        loop = self.loops[i]
        if loop["ki"] + loop["ki0"] > 0.0:
            carried = loop["integral"] + loop["kt"] * loop["t_out"]
            loop["integral"] = min(max(carried, -loop["limit"]), loop["limit"])
        self.states[3 * i : 3 * i + 2] = 0.0
        loop["driven"], loop["t_out"] = 0.0, 0.0
