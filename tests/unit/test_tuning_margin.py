"""The linear model of the loops, held against closed forms, the running filters, and flights at its limit."""

import math

import numpy as np
import pytest

from campaigns.tuning.courses import Hover, Wind, fly
from campaigns.tuning.margin import UNSTABLE, law, margin, margins
from fakevehicle.airframe import load_airframe
from fakevehicle.control.fopid_tid import fopid_step
from fakevehicle.control.gains import PRESETS, ControlTables
from fakevehicle.flight import PARAMETERS
from fakevehicle.params import ParameterSet


def parameters(preset="default", **more):
    return ParameterSet(PARAMETERS, {**PRESETS[preset], **more})


@pytest.mark.parametrize("product", [0.2, 0.5, 1.0, 1.5])
def test_an_integrator_with_delay_is_stable_up_to_half_pi_and_its_sensitivity_is_the_closed_forms(product):
    # |1 + (k/jw) exp(-jwT)|^2 = 1 + (k/w)^2 - 2 (k/w) sin(wT), T = 1
    w = np.linspace(1e-2, 60.0, 400_000)
    closed = 1.0 / np.sqrt((1.0 + (product / w) ** 2 - 2.0 * product / w * np.sin(w)).min())
    found = margin(lambda s: product * np.exp(-s) / s, 1.0)
    assert found.ms == pytest.approx(closed, rel=5e-3)
    gain, phase = found.ms / (found.ms - 1.0), 2.0 * math.asin(0.5 / found.ms)  # what Ms promises at least
    assert gain <= math.pi / 2.0 / product
    assert phase <= math.pi / 2.0 - product


def test_an_integrator_with_more_delay_than_half_pi_is_unstable():
    assert margin(lambda s: 1.6 * np.exp(-s) / s, 1.0).ms == UNSTABLE
    assert margin(lambda s: 8.0 * np.exp(-s) / s, 1.0).ms == UNSTABLE


def test_a_damped_double_integrator_peaks_as_a_second_order_high_pass_does():
    # S = s^2/(s^2 + s + 1): 1/(2 zeta sqrt(1 - zeta^2)), zeta = 1/2
    assert margin(lambda s: (1.0 + s) / s**2, 2.0).ms == pytest.approx(2.0 / math.sqrt(3.0), rel=1e-4)


@pytest.mark.parametrize(("gain", "stable"), [(1.0, True), (5.6, True), (6.1, False), (60.0, False)])
def test_a_third_order_loop_is_stable_up_to_a_gain_of_six(gain, stable):
    # s^3 + 3 s^2 + 2 s + K: Routh
    assert (margin(lambda s: gain / (s * (s + 1.0) * (s + 2.0)), 1.0).ms < UNSTABLE) is stable


def test_a_fractional_integrator_comes_as_near_to_minus_one_as_its_phase_says():
    # s^-1.5 lies on a ray 45 degrees from the negative axis
    assert margin(lambda s: s**-1.5, 1.5).ms == pytest.approx(math.sqrt(2.0), rel=1e-4)
    assert margin(lambda s: s**-2.2, 2.2).ms == UNSTABLE


@pytest.mark.parametrize("preset", ["default", "pid", "tid", "fopid"])
def test_the_law_has_the_gain_and_phase_of_the_filters_that_run(preset):
    values = parameters(preset, FT_VXY_KD=0.3)
    bank = ControlTables(load_airframe("x500"), values).bank
    w, period = 5.0, 0.004
    t = period * np.arange(round(60.0 / period))
    setpoint = np.sin(w * t)
    out = np.array([fopid_step(bank.loops, bank.coefficients, bank.states, 0, r, 0.0, 0.0, 0.0) for r in setpoint])
    whole = t >= t[-1] - 10 * 2.0 * math.pi / w
    basis = np.stack([np.sin(w * t), np.cos(w * t), np.ones_like(t)], axis=1)[whole]
    (real, imaginary, _), *_ = np.linalg.lstsq(basis, out[whole], rcond=None)
    on_r = law(values, "VXY", np.array([1j * w]))[1][0]
    assert complex(real, imaginary) == pytest.approx(on_r, rel=0.03)


def test_flights_begin_to_swing_at_the_gain_where_the_model_says_and_as_fast():
    airframe = load_airframe("x500")

    def unstable(gain):
        return margins(airframe, parameters("pid", FT_VXY_KP=gain)).tilt.ms >= UNSTABLE

    low, high = 6.0, 30.0
    assert not unstable(low)
    assert unstable(high)
    while high - low > 0.05:
        low, high = (0.5 * (low + high), high) if not unstable(0.5 * (low + high)) else (low, 0.5 * (low + high))
    swings = {}
    for share in (0.88, 1.15):
        quiet = {"SIM_GPS_P_NOISE": 0.02, "SIM_GPS_V_NOISE": 0.02, "FT_VXY_KP": share * low}
        flown = fly(Hover(4.0), Wind(), 3, parameters("pid", **quiet))
        speed = flown.rotor_speed - flown.rotor_speed.mean(axis=0)
        swings[share] = float(np.sqrt((speed**2).mean()))
        power = np.abs(np.fft.rfft(speed[:, 0])) ** 2
    assert swings[1.15] > 5.0 * swings[0.88]
    fastest = 2.0 * math.pi * np.argmax(power) / 4.0
    predicted = margins(airframe, parameters("pid", FT_VXY_KP=low)).tilt.frequency
    assert fastest == pytest.approx(predicted, rel=0.25)


def test_more_gain_in_the_velocity_loop_leaves_less_margin():
    airframe = load_airframe("x500")
    found = [margins(airframe, parameters("pid", FT_VXY_KP=gain)).ms for gain in (4.0, 6.0, 8.0)]
    assert found == sorted(found)
