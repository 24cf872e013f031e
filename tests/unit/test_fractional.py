"""The fractional operator and the FOPID-TID law against the frequency response and two closed forms in time."""

import math

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


@pytest.mark.parametrize("alpha", [-0.9, -0.5, -1 / 3, 0.1, 0.5, 0.9])
def test_the_operator_has_the_gain_and_phase_of_s_to_the_alpha_over_its_band(alpha: float) -> None:
    omega = np.geomspace(*BAND, 200)
    exact = (1j * omega) ** alpha
    ratio = response(sections(alpha, *BAND, PERIOD), omega, PERIOD) / exact
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
    made.set_gains(0, lam=lam, **full)
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
    for k, y in enumerate(measured):
        e = 1.0 - y
        integral += 0.5 * PERIOD * (e + before)
        before = e
        slope = ((c - w) * slope + c * w * (y - last)) / (c + w)
        last = y
        u = run(b, 1.0, float(y))
        if k > 100:
            assert u == pytest.approx(2.0 * e + 3.0 * integral - 0.5 * slope, abs=0.02)


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
    b.set_gains(0, kp=5.0, kt=0.1, ki=4.0, ki0=0.0, kd=0.0, b=1.0, lam=1.0, limit=1e9)
    assert run(b, 1.0, 0.4) == pytest.approx(u, abs=5e-3)


def test_a_rebase_keeps_the_output_where_the_error_is_small() -> None:
    b = bank(kp=2.0, ki=1.0, kt=0.5)
    for _ in range(500):
        run(b, 1.0, 0.4)
    settled = run(b, 1.0, 1.0)
    b.rebase(0)
    assert run(b, 1.0, 1.0) == pytest.approx(settled, abs=5e-3)


def test_nothing_winds_up_against_a_limit() -> None:
    # an integrator plant with |u| <= 1 and a setpoint far away; with wind-up it would overshoot by metres
    b = bank(kp=4.0, ki=4.0, lam=0.9)
    y, pushed, top = 0.0, 0.0, 0.0
    for _ in range(20_000):
        u = run(b, 5.0, y, pushed)
        allowed = min(max(u, -1.0), 1.0)
        pushed = allowed - u
        y += PERIOD * allowed
        top = max(top, y)
    assert top < 5.1
    assert y == pytest.approx(5.0, abs=0.1)  # the memory of the way there fades with a power of time
