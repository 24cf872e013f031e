# mypy: disable-error-code="no-untyped-def"
# kernels: numba types them by their arguments, which the docstrings name
"""The FOPID-TID law, one loop a call.

    u = u_ff + Kp (b r - y) + Kt D^(-1/n) e + (Ki D^(-lambda) + Ki0 D^(-1)) e - Kd D^mu F(s) y,     e = r - y

Special cases: Kt = 0 is the paper's FOPID (eq. 42); Kp = 0, lambda = mu = 1 is Lurie's tilt-integral-derivative (US
5,371,670); Kt = 0, lambda = mu = 1 is PID, to the rounding, since orders of one have no fractional operator in them.
The derivative acts on the measurement only (c = 0) and its coefficients never change in flight. The paper's Algorithm 1
adds lambda + mu to u, which has no dimension to stand in: not done.

D^(-lambda) is s^(1 - lambda) followed by a trapezoidal 1/s, so that the last thing in the chain is an integrator: the
one a change of gains feeds. It holds Ki times the integral, so that a change of Ki does not bump the output.

Anti-windup acts on what goes into the filters, never on the integrator alone. With w = u_sat - u:

    e_c = e + w / Kp          the error that would have given u_sat (Hanus' conditioning); e while nothing saturates
    tilt                      takes e_c
    integral, w e_c < 0       would push further into the limit: its filter and its integrator hold still
    integral, otherwise       takes e_c

Kp e_c = u_sat - I - (the other terms), so while e_c is taken during saturation I = D^(-lambda) Ki/Kp (u_sat - I - ...):
a fractional lag towards what the limit leaves over, of time constant (Kp/Ki)^(1/lambda). That is back-calculation with
that T_t, the usual one for lambda = 1. Why the filters: D^(-lambda) and D^(-1/n) remember, and forget only with a power
of time. A rule for the last integrator alone leaves s^(1 - lambda) before it with the memory of an error that was never
integrated; while that error falls the filter's output is negative, the integral ends with the wrong sign, and the
offset fades for minutes. A tilt filter that saw the whole error leaves as much.

In e_c, w is no more than the loop's own output u - u_ff, and zero when that is on the way back already: where the
feed-forward alone is too much, the loop has nothing to answer for and must not wind up against it. With Kp = 0 no error
would have given u_sat; then e_c = e, which is conditional integration.

Gains change without a bump: the integral takes up the difference. What of it is beyond the integral's limit, which may
have just shrunk, or is zero where there is no integral gain, is not cut off but fades with the time constant `FADE`.

Records instead of arguments: `LOOP` holds one loop's numbers, `BANK` the filter coefficients and states of all loops.
"""

import numpy as np

from fakevehicle.control.fractional import SECTIONS, run_sections, sections
from fakevehicle.jit import kernel
from fakevehicle.vocabulary import FloatArray

FADE = 1.5
"""Time constant with which an integral beyond its limit comes back to it [s]."""

LOOP = np.dtype(
    [
        ("kp", "f8"),
        ("kt", "f8"),
        ("ki", "f8"),
        ("ki0", "f8"),
        ("kd", "f8"),
        ("b", "f8"),  # setpoint weight of the proportional term
        ("period", "f8"),
        ("limit", "f8"),  # the integral stays within +-limit, in units of u, or comes back to it
        ("back", "f8"),  # 1 / Kp, 0 without Kp: from u to the error it stands for
        ("n_tilt", "i8"),
        ("n_integral", "i8"),
        ("n_derivative", "i8"),
        ("f_b", "f8"),  # F(s) = w/(s + w) by Tustin: y = f_b (x + x1) - f_a y1
        ("f_a", "f8"),
        ("f_x", "f8"),
        ("f_y", "f8"),
        ("integral", "f8"),  # output of the integrator, gains included
        ("driven", "f8"),  # its input at the last call
        ("setpoint", "f8"),  # r at the last call
        ("measured", "f8"),  # y at the last call
        ("t_out", "f8"),  # D^(-1/n) e_c, also while kt is 0: its memory is true whenever kt becomes something
        ("d_out", "f8"),  # -D^mu F y
        ("own", "f8"),  # u - u_ff of the last call
        ("whole", "f8"),  # w of F(s) where mu = 1, else 0: s F(s) = w (1 - F(s)), exactly
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
    loop.setpoint, loop.measured = setpoint, measured
    conditioned = setpoint - measured
    if pushed * loop.own < 0.0:
        conditioned += loop.back * (pushed if abs(pushed) < abs(loop.own) else -loop.own)
    bound = loop.limit
    if abs(loop.integral) > bound:
        bound += (1.0 - loop.period / FADE) * (abs(loop.integral) - bound)
    loop.t_out = run_sections(coefficients, states, 3 * i + TILT, loop.n_tilt, conditioned)
    if not pushed * conditioned < 0.0:
        driven = loop.ki * run_sections(coefficients, states, 3 * i + INTEGRAL, loop.n_integral, conditioned)
        driven += loop.ki0 * conditioned
        loop.integral += 0.5 * loop.period * (driven + loop.driven)
        loop.driven = driven
    loop.integral = min(max(loop.integral, -bound), bound)
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
        if loop.whole > 0.0:
            loop.d_out = loop.whole * (smooth - measured)
        else:
            loop.d_out = run_sections(coefficients, states, 3 * i + DERIVATIVE, loop.n_derivative, -smooth)
    loop.own = loop.kp * (loop.b * setpoint - measured) + loop.kt * loop.t_out + loop.integral + loop.kd * loop.d_out
    return forward + loop.own


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
        self, i: int, *, kp: float, kt: float, ki: float, ki0: float, kd: float, b: float, limit: float
    ) -> None:
        """Change loop `i`'s gains without a jump of its output: I takes up u_prev - (the other terms with new gains).

        All of them: Kt and Kd may come from 0, Ki and the limit may go there, and b counts as a gain. What I may not
        keep, because it is beyond `limit` or nothing feeds it any more, fades (`FADE`).

        Parameters
        ----------
        kp, kt, ki, ki0, kd, b : as in the law above.
        limit : bound of the integral, in units of u; taken for zero without Ki and Ki0.
        """
        loop = self.loops[i]
        before = self._without_integral(i) + loop["integral"]
        if loop["kd"] == 0.0:  # its filters stood still: let them begin anew, as if y had never changed
            loop["primed"], loop["d_out"] = 0.0, 0.0
        loop["kp"], loop["kt"], loop["ki"], loop["ki0"], loop["kd"], loop["b"] = kp, kt, ki, ki0, kd, b
        loop["limit"] = limit if ki + ki0 > 0.0 else 0.0
        loop["back"] = 1.0 / kp if kp > 0.0 else 0.0
        loop["integral"] = before - self._without_integral(i)

    def _without_integral(self, i: int) -> float:
        """The other terms of loop `i` at the last call, with the gains it has now."""
        loop = self.loops[i]
        proportional = loop["kp"] * (loop["b"] * loop["setpoint"] - loop["measured"])
        return float(proportional + loop["kt"] * loop["t_out"] + loop["kd"] * loop["d_out"])

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
            (DERIVATIVE, "n_derivative", mu if mu < 1.0 else 0.0),
        )
        for row, name, alpha in chains:
            chain = sections(alpha, band[0], band[1], period)
            loop[name] = len(chain)
            self.coefficients[3 * i + row, : len(chain)] = chain
        c = 2.0 / period
        loop["whole"] = derivative_cutoff if mu == 1.0 else 0.0
        loop["f_b"] = derivative_cutoff / (c + derivative_cutoff)
        loop["f_a"] = (derivative_cutoff - c) / (c + derivative_cutoff)
        self.clear(i)

    def clear(self, i: int) -> None:
        """Loop `i` as new: no memory, no trim."""
        loop = self.loops[i]
        self.states[3 * i : 3 * i + 3] = 0.0
        for name in ("f_x", "f_y", "integral", "driven", "setpoint", "measured", "t_out", "d_out", "own", "primed"):
            loop[name] = 0.0

    def rebase(self, i: int) -> None:
        """Forget the errors of the past but keep the trim: the integral takes over what the tilt term was giving."""
        loop = self.loops[i]
        if loop["ki"] + loop["ki0"] > 0.0:
            carried, most = loop["integral"] + loop["kt"] * loop["t_out"], max(loop["limit"], abs(loop["integral"]))
            loop["integral"] = min(max(carried, -most), most)
        self.states[3 * i : 3 * i + 2] = 0.0
        loop["driven"], loop["t_out"] = 0.0, 0.0
