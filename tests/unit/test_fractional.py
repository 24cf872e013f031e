"""The fractional operator and the FOPID-TID law against the frequency response and two closed forms in time."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from scipy.special import erfcx, gamma

from fakevehicle.control.fopid_tid import LoopBank, fopid_step
from fakevehicle.control.fractional import SECTIONS, run_sections, sections
from fakevehicle.vocabulary import FloatArray

BAND, PERIOD = (0.1, 300.0), 0.001


def response(chain: FloatArray, omega: FloatArray, period: float) -> FloatArray:
    """Frequency response of a chain, from its coefficients and z = exp(j w T)."""
    inverse = np.exp(-1j * omega * period)[:, None]
    return np.prod((chain[:, 0] + chain[:, 1] * inverse) / (1.0 + chain[:, 2] * inverse), axis=1)


@pytest.mark.parametrize(("band", "period"), [(BAND, PERIOD), ((0.05, 75.0), 0.004)], ids=["rates", "velocity"])
@pytest.mark.parametrize("alpha", [*(k / 20 for k in range(-19, 20) if k), -1 / 3])
def test_the_operator_has_the_gain_and_phase_of_s_to_the_alpha_over_its_band(
    alpha: float, band: tuple[float, float], period: float
) -> None:
    omega = np.geomspace(*band, 400)
    exact = (1j * omega) ** alpha
    ratio = response(sections(alpha, *band, period), omega, period) / exact
    assert float(np.abs(20 * np.log10(np.abs(ratio))).max()) < 0.08  # dB
    assert float(np.degrees(np.abs(np.angle(ratio))).max()) < 2.0


def test_order_zero_is_the_identity_and_wrong_orders_or_bands_are_refused() -> None:
    assert len(sections(0.0, *BAND, PERIOD)) == 0
    for bad in (
        (1.2, 0.1, 300.0, 0.001),
        (0.5, 0.1, 4000.0, 0.001),
        (0.5, 10.0, 1.0, 0.001),
        (0.5, 1e-5, 300.0, 0.001),
    ):
        with pytest.raises(ValueError, match=r"expected|room"):
            sections(*bad)


def bank(period: float = PERIOD, lam: float = 1.0, mu: float = 1.0, tilt_n: float = 3.0, **gains: float) -> LoopBank:
    made = LoopBank((period,))
    made.set_orders(0, lam=lam, mu=mu, tilt_n=tilt_n, band=(0.03, 100.0), derivative_cutoff=200.0)
    full = {"kp": 0.0, "kt": 0.0, "ki": 0.0, "ki0": 0.0, "kd": 0.0, "b": 1.0, "limit": 1e9} | gains
    made.set_gains(0, **full)
    return made


def run(b: LoopBank, setpoint: float, measured: float, pushed: float = 0.0, forward: float = 0.0) -> float:
    return float(fopid_step(b.loops, b.coefficients, b.states, 0, setpoint, measured, forward, pushed))


@pytest.mark.parametrize("lam", [0.3127, 0.7, 0.9])
def test_the_fractional_integral_of_a_step_is_the_power_law(lam: float) -> None:
    b = bank(lam=lam, ki=1.0)
    for k in range(1, 10_001):
        u = run(b, 1.0, 0.0)
        t = (k - 0.5) * PERIOD
        if k in (100, 1000, 5000, 10_000):
            assert u == pytest.approx(t**lam / gamma(1 + lam), rel=0.03)


def test_a_loop_around_half_an_integral_answers_a_step_as_erfcx_says() -> None:
    # plant s^-1/2 under unit feedback: 1/(1 + sqrt s), step response 1 - erfcx(sqrt t)
    chain, states = np.zeros((1, SECTIONS, 3)), np.zeros((1, SECTIONS))
    half = sections(-0.5, 0.01, 100.0, PERIOD)
    chain[0, : len(half)] = half
    y, worst = 0.0, 0.0
    for k in range(1, 10_001):
        y = run_sections(chain, states, 0, len(half), 1.0 - y)
        t = k * PERIOD
        if t > 0.1:
            worst = max(worst, abs(y - (1.0 - float(erfcx(math.sqrt(t))))))
    assert worst < 0.01


def test_orders_one_without_tilt_are_a_textbook_pid() -> None:
    b = bank(kp=2.0, ki=3.0, kd=0.5)
    t = PERIOD * np.arange(3000)
    measured = np.sin(3.0 * t) + 0.5 * np.cos(11.0 * t)
    # textbook: trapezoidal integral, derivative of the measurement through w/(s+w), all by Tustin
    integral, before, slope = 0.0, 0.0, 0.0
    c, w = 2.0 / PERIOD, 200.0
    last = measured[0]
    for y in measured:
        e = 1.0 - y
        integral += 0.5 * PERIOD * (e + before)
        before = e
        slope = ((c - w) * slope + c * w * (y - last)) / (c + w)
        last = y
        assert run(b, 1.0, float(y)) == pytest.approx(2.0 * e + 3.0 * integral - 0.5 * slope, abs=1e-11)


def test_tilt_alone_is_lurie_s_term() -> None:
    b = bank(kt=1.0, tilt_n=2.0)
    u = 0.0
    for _ in range(1000):
        u = run(b, 1.0, 0.0)
    assert u == pytest.approx(1.0 / gamma(1.5), rel=0.03)  # D^(-1/2) of a step at t = 1


def test_a_change_of_gains_does_not_bump_the_output() -> None:
    b = bank(kp=2.0, ki=1.0, kt=0.5)
    u = 0.0
    for _ in range(500):
        u = run(b, 1.0, 0.4)
    b.set_gains(0, kp=5.0, kt=0.1, ki=4.0, ki0=0.0, kd=0.0, b=1.0, limit=1e9)
    assert run(b, 1.0, 0.4) == pytest.approx(u, abs=5e-3)


@pytest.mark.parametrize(
    "gain",
    [
        {"b": 0.3},
        {"kp": 0.5, "b": 0.0},
        {"kt": 0.0},
        {"kd": 0.4},
        {"kd": 0.0},
        {"kp": 5.0, "kt": 0.1, "ki": 4.0, "ki0": 1.0, "kd": 1.0, "b": 0.6},
    ],
)
@pytest.mark.parametrize("before", [{"kt": 1.5, "kd": 0.2}, {"kt": 0.0, "kd": 0.0}])
def test_no_gain_bumps_the_output_not_even_the_setpoint_s_weight_or_a_term_that_was_off(
    before: dict[str, float], gain: dict[str, float]
) -> None:
    gains = {"kp": 2.0, "ki": 3.0, "ki0": 0.0, "b": 1.0, "limit": 1e9} | before
    b = bank(lam=0.9, mu=0.8, **gains)
    for k in range(3000):
        u = run(b, 1.0, 0.9 + 0.05 * math.sin(0.003 * k))
    b.set_gains(0, **(gains | {"kt": 1.5} | gain))
    y = 0.9 + 0.05 * math.sin(0.003 * 3000)
    # one sample of the slope there was (0.15 a second times the gains), not the tenths that the change is worth
    assert run(b, 1.0, y) == pytest.approx(u, abs=3e-3)


@pytest.mark.parametrize(("change", "kept"), [({"ki": 0.0}, 0.0), ({"limit": 0.5}, 0.5)])
def test_an_integral_that_may_not_stay_as_large_fades_instead_of_vanishing(
    change: dict[str, float], kept: float
) -> None:
    gains = {"kp": 2.0, "kt": 0.0, "ki": 3.0, "ki0": 0.0, "kd": 0.0, "b": 1.0, "limit": 1e9}
    b = bank(lam=0.9, **gains)
    for _ in range(2000):
        u = run(b, 1.0, 0.5)
    trim = float(b.loops[0]["integral"])
    assert trim > 2.0
    b.set_gains(0, **(gains | change))
    outputs = [u, *(run(b, 1.0, 1.0 - 0.5) for _ in range(9000))]
    # no jump: a sample takes no more than the excess over 1.5 s; after six of those little is left of it
    assert np.abs(np.diff(outputs)).max() < 1.1 * (trim - kept) * PERIOD / 1.5
    assert float(b.loops[0]["integral"]) == pytest.approx(kept, abs=0.01)


def test_a_derivative_that_was_off_begins_without_the_memory_of_when_it_was_on() -> None:
    gains = {"kp": 2.0, "ki": 3.0, "kt": 0.0, "ki0": 0.0, "b": 1.0, "limit": 1e9}
    b = bank(mu=0.8, kd=0.5, **gains)
    for _ in range(200):
        run(b, 1.0, 5.0)
    b.set_gains(0, kd=0.0, **gains)
    for _ in range(200):
        u = run(b, 1.0, 1.0)
    b.set_gains(0, kd=0.5, **gains)
    assert run(b, 1.0, 1.0) == pytest.approx(u, abs=0.02)


def test_a_rebase_keeps_the_output_where_the_error_is_small() -> None:
    b = bank(kp=2.0, ki=1.0, kt=0.5)
    for _ in range(500):
        run(b, 1.0, 0.4)
    settled = run(b, 1.0, 1.0)
    b.rebase(0)
    assert run(b, 1.0, 1.0) == pytest.approx(settled, abs=5e-3)


def saturated(
    lam: float, kp: float, ki: float, step: float, seconds: float, kt: float = 0.0
) -> tuple[FloatArray, LoopBank]:
    """Error of the plant 1/s under |u| <= 1 after a step of the setpoint, a row a millisecond."""
    b = bank(lam=lam, kp=kp, ki=ki, kt=kt)
    y, pushed, errors = 0.0, 0.0, []
    for _ in range(round(seconds / PERIOD)):
        u = run(b, step, y, pushed)
        allowed = min(max(u, -1.0), 1.0)
        pushed = allowed - u
        y += PERIOD * allowed
        errors.append(step - y)
    return np.array(errors), b


def from_laplace(transform: Callable[[complex], complex], t: float) -> float:
    """f(t) by Talbot's contour with 32 points (Abate & Valko 2004): no fractional operator in it."""
    m = 32
    theta = np.arange(1, m) * math.pi / m
    cot = 1.0 / np.tan(theta)
    s = np.concatenate([[2.0 * m / (5.0 * t)], 2.0 * m / (5.0 * t) * theta * (cot + 1j)])
    weights = np.concatenate([[0.5], 1.0 + 1j * (theta + (theta * cot - 1.0) * cot)])
    return float(
        2.0 / (5.0 * t) * np.sum([(w * np.exp(z * t) * transform(z)).real for z, w in zip(s, weights, strict=True)])
    )


@pytest.mark.parametrize(("lam", "kp", "ki"), [(1.0, 2.0, 2.0), (0.9, 2.0, 2.0), (0.9, 4.0, 4.0), (0.7, 2.0, 2.0)])
def test_after_a_long_saturation_a_loop_goes_on_as_if_it_began_where_the_limit_let_go(
    lam: float, kp: float, ki: float
) -> None:
    """Plant 1/s, |u| <= 1, setpoint 10 away: the linear loop takes over at e = 1/Kp with an empty integral.

    From there e' = -Kp e - Ki D^(-lambda) e, so E(s) = e0 / (s + Kp + Ki s^-lambda).
    """
    e, _ = saturated(lam, kp, ki, 10.0, 24.0)
    free = int(np.argmax(e < 1.0 / kp))
    assert free == pytest.approx((10.0 - 1.0 / kp) / PERIOD, abs=80)  # full speed up to there
    for t in (0.3, 1.0, 2.0, 4.0, 8.0, 12.0):
        exact = from_laplace(lambda s: 1.0 / kp / (s + kp + ki * s**-lam), t)
        assert e[free + round(t / PERIOD)] == pytest.approx(exact, abs=0.012)


@pytest.mark.parametrize("lam", [1.0, 0.9, 0.7, 0.3127])
def test_no_offset_stays_behind_after_a_long_saturation_whatever_the_order(lam: float) -> None:
    e, b = saturated(lam, 2.0, 2.0, 10.0, 20.0)
    assert abs(float(e[-1])) < 2e-3
    assert float(e.min()) > -0.11  # lambda = 1, where the theory is classical, passes by 0.106
    assert b.loops[0]["integral"] > -0.02  # it never pulled the wrong way


@pytest.mark.parametrize(("lam", "kp", "ki"), [(1.0, 2.0, 2.0), (0.9, 3.5, 1.0), (0.9, 2.0, 2.0), (0.3127, 2.0, 2.0)])
def test_the_tilt_term_s_memory_of_a_long_saturation_leaves_no_offset_either(lam: float, kp: float, ki: float) -> None:
    e, _ = saturated(lam, kp, ki, 10.0, 20.0, kt=0.8)
    assert abs(float(e[-1])) < 0.015
    assert float(e.min()) > -0.15


@pytest.mark.parametrize(("lam", "kp", "ki"), [(1.0, 2.0, 3.0), (0.5, 2.0, 3.0), (0.5, 5.0, 1.0)])
def test_an_integral_at_odds_with_the_limit_comes_to_it_as_a_fractional_lag(lam: float, kp: float, ki: float) -> None:
    # b = 0 and r = y = -2/Kp: no error and an output of 2 where 1 is allowed, so the integral must come to -1.
    # I = -(1 - E(-(Ki/Kp) t^lambda)) with Mittag-Leffler's E: exp for lambda = 1, erfcx(sqrt) for 1/2
    b = bank(lam=lam, kp=kp, ki=ki, b=0.0)
    pushed = 0.0
    for k in range(1, 5001):
        u = run(b, -2.0 / kp, -2.0 / kp, pushed)
        pushed = min(u, 1.0) - u
        t = k * PERIOD
        if k in (200, 1000, 5000):
            left = math.exp(-ki / kp * t) if lam == 1.0 else float(erfcx(ki / kp * math.sqrt(t)))
            assert u - 2.0 == pytest.approx(left - 1.0, abs=0.02)


@pytest.mark.parametrize("forward", [1.5, 40.0, 1e30])
def test_a_feed_forward_beyond_the_limit_winds_nothing_up(forward: float) -> None:
    b, pushed = bank(lam=0.9, kp=2.0, ki=2.0, kt=0.8), 0.0
    for _ in range(5000):
        u = run(b, 0.1, 0.0, pushed, forward)
        pushed = min(u, 1.0) - u
    assert run(b, 0.0, 0.0) == pytest.approx(0.0, abs=0.03)


def test_an_integral_alone_waits_at_the_limit_and_leaves_it_with_the_error_s_sign() -> None:
    b = bank(ki=2.0)  # no Kp: there is no error that would have given u_sat
    pushed = 0.0
    for _ in range(2000):
        u = run(b, 1.0, 0.0, pushed)
        pushed = min(u, 1.0) - u
    assert u == pytest.approx(1.0, abs=0.01)
    for _ in range(100):
        u = run(b, -1.0, 0.0, min(u, 1.0) - u)
    assert u == pytest.approx(0.8, abs=0.01)


def test_nothing_winds_up_against_a_limit() -> None:
    # an integrator plant with |u| <= 1 and a setpoint far away; with wind-up it would overshoot by metres
    e, _ = saturated(0.9, 4.0, 4.0, 5.0, 20.0)
    assert float(e.min()) > -0.1
    assert float(e[-1]) == pytest.approx(0.0, abs=0.002)
