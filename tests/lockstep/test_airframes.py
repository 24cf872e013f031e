"""Every shipped airframe flies with its own parameters, and every set of gains an X500; the estimator in the loop."""

import math
from importlib import resources
from typing import get_args

import numpy as np
import pytest
import yaml

from fakevehicle.airframe import load_airframe
from fakevehicle.config import Gains, VehicleConfig
from fakevehicle.errors import AirframeError
from fakevehicle.flight import PARAMETERS, FlightStack
from fakevehicle.geodesy import to_local
from fakevehicle.params import ParameterSet
from fakevehicle.vehicle import Vehicle
from fakevehicle.vocabulary import FloatArray, Geodetic, Setpoint
from tests.vehicle_pilot import NAN, Pilot
from wire.dialect import mavlink

AIRFRAMES = sorted(f.name[:-5] for f in (resources.files("fakevehicle") / "airframes").iterdir())
LANDED = mavlink.MAV_LANDED_STATE_ON_GROUND


def test_three_airframes_are_shipped() -> None:
    assert AIRFRAMES == ["crazyflie", "iris", "x500"]


@pytest.mark.parametrize("name", AIRFRAMES)
def test_an_airframe_can_hover_with_thrust_to_spare_and_a_source_for_every_number(name: str) -> None:
    frame = load_airframe(name)
    assert 0.3 < (frame.hover_speed / frame.max_rotor_speed) ** 2 < 0.7
    assert all(len(text) > 5 for text in frame.source.values())


@pytest.mark.parametrize(
    ("name", "gains"), [*((name, "default") for name in AIRFRAMES), *(("x500", kind) for kind in get_args(Gains)[1:])]
)
def test_it_takes_off_hovers_and_lands(name: str, gains: Gains) -> None:
    vehicle = Vehicle(VehicleConfig(airframe=name, gains=gains, wind_n=np.array([1.0, 0.5, 0.0])))
    assert vehicle.parameters["FT_VXY_KT"] == pytest.approx({"default": 1.6, "tid": 8.5}.get(gains, 0.0))
    pilot = Pilot(vehicle)
    pilot.run(8.0)
    # WHEN it is armed and asked to take off
    assert pilot.command(mavlink.MAV_CMD_COMPONENT_ARM_DISARM, 1) == mavlink.MAV_RESULT_ACCEPTED
    assert pilot.command(mavlink.MAV_CMD_NAV_TAKEOFF, *[NAN] * 7) == mavlink.MAV_RESULT_ACCEPTED
    pilot.run(8.0)
    # THEN it stands at the takeoff height and hardly moves
    start = vehicle.truth.position_n
    assert -start[2] == pytest.approx(2.5, abs=0.4)
    for _ in range(20):
        pilot.run(0.25)
        assert math.dist(vehicle.truth.position_n, start) < 0.4
        assert np.degrees(np.abs(vehicle.truth.omega_b).max()) < 20.0
    # WHEN it is asked to land THEN it comes down where it was and stops its motors
    assert pilot.command(mavlink.MAV_CMD_NAV_LAND, 0, 0, 0, 0, NAN, NAN, NAN) == mavlink.MAV_RESULT_ACCEPTED
    pilot.run(2.0)
    assert vehicle.truth.velocity_n[2] > 0.4
    pilot.until(lambda: not vehicle.flying.armed, 20)  # 7 s; the paper's loops take 12
    pilot.run(1.0)
    assert pilot.last("EXTENDED_SYS_STATE").landed_state == LANDED
    assert math.dist(vehicle.truth.position_n[:2], start[:2]) < 0.7
    assert vehicle.truth.rotor_speed.max() < 50.0


def test_an_airframes_parameters_are_the_vehicles_unless_somebody_asks_for_others() -> None:
    own = load_airframe("crazyflie").parameters
    assert own["FT_RXY_KD"] == 2.0
    assert Vehicle(VehicleConfig(airframe="crazyflie")).parameters["FT_RXY_KD"] == 2.0
    assert Vehicle(VehicleConfig(airframe="crazyflie"), {"FT_RXY_KD": 1.5}).parameters["FT_RXY_KD"] == 1.5
    assert Vehicle(VehicleConfig(airframe="crazyflie", gains="pid")).parameters["FT_VXY_KI"] == 6.0
    assert Vehicle(VehicleConfig(airframe="crazyflie", autopilot="ardupilot")).parameters["FT_RXY_KD"] == 2.0


@pytest.mark.parametrize(
    ("name", "value", "words"),
    [
        ("FT_RXY_KPP", 1.0, r"parameters\.FT_RXY_KPP: found 1, expected a parameter"),
        ("FT_RXY_KP", -1.0, r"parameters\.FT_RXY_KP: found -1, expected 0 to 200"),
        ("FT_RXY_KP", "much", r"parameters\.FT_RXY_KP: found 'much', expected .*number"),
    ],
)
def test_a_parameter_that_cannot_be_is_one_clear_error(tmp_path, name, value, words) -> None:  # type: ignore[no-untyped-def]
    content = load_airframe("x500").model_dump(mode="json") | {"parameters": {name: value}}
    (tmp_path / "mine.yaml").write_text(yaml.safe_dump(content))
    with pytest.raises(AirframeError, match=rf"mine\.yaml: {words}"):
        Vehicle(VehicleConfig(airframe=str(tmp_path / "mine.yaml")))


HOME = Geodetic(0.82, 0.15, 488.0)
DT = FlightStack.TICK_US * 1e-6


def eight(centre_n: FloatArray, t: float) -> Setpoint:
    """(4 sin a, 2 sin 2a) about a centre, a = w (t - 2) with 3 m/s at the crossing; from rest within 4 s."""
    w, u = 3.0 / math.hypot(4.0, 4.0), min(t / 4.0, 1.0)
    a = 4.0 * w * (u**3 - u**4 / 2.0) + w * max(t - 4.0, 0.0)
    b = w * (3.0 * u * u - 2.0 * u**3)
    c = w * 6.0 * u * (1.0 - u) / 4.0
    d_n = np.array([4.0 * math.cos(a), 4.0 * math.cos(2.0 * a), 0.0])
    bent_n = np.array([-4.0 * math.sin(a), -8.0 * math.sin(2.0 * a), 0.0])
    place_n = centre_n + np.array([4.0 * math.sin(a), 2.0 * math.sin(2.0 * a), 0.0])
    return Setpoint(place_n, b * d_n, b * b * bent_n + c * d_n, 0.0)


@pytest.mark.parametrize("wind", [0.0, 5.0])
@pytest.mark.parametrize("name", AIRFRAMES)
def test_it_hovers_steps_and_flies_an_eight(name: str, wind: float) -> None:
    frame = load_airframe(name)
    stack = FlightStack(
        airframe=frame,
        parameters=ParameterSet(PARAMETERS, {**frame.parameters, "SIM_WIND_GUST": wind}),
        home=HOME,
        heading=0.0,
        wind_n=np.array([wind, 0.0, 0.0]),
        seed=7,
    )
    now_us, track, rates = 0, [], []

    def fly(setpoint: Setpoint | None) -> None:
        nonlocal now_us
        now_us += FlightStack.TICK_US
        stack.tick(now_us, setpoint, setpoint is not None)
        track.append(stack.truth.position_n)
        rates.append(stack.truth.omega_b)

    for _ in range(2000):
        fly(None)
    estimate = stack.estimate
    assert estimate.origin is not None
    moved = to_local(HOME, estimate.origin)  # truth is from home
    ground_n = estimate.position_n
    moved[2] = ground_n[2] - stack.truth.position_n[2]
    hover_n = ground_n + np.array([0.0, 0.0, -2.5])
    still = np.zeros(3)
    for k in range(1500):
        fly(Setpoint(ground_n + np.array([0.0, 0.0, max(-2.5, -0.002 * k)]), still, still, 0.0))
    # WHEN it hovers THEN within GPS's own wander it stands, and hardly turns about its axes
    for _ in range(1000):
        fly(Setpoint(hover_n, still, still, 0.0))
    off = np.array(track[-1000:]) + moved - hover_n
    assert np.sqrt((off[:, :2] ** 2).sum(axis=1).mean()) < 0.15
    assert np.degrees(np.array(rates[-1000:])[:, :2].std()) < (5.0 if wind == 0.0 else 12.0)
    # WHEN it is sent 5 m away at once THEN it is there within 3.1 s and passes by 3 % at most
    goal_n = hover_n + np.array([3.0, 4.0, 0.0])
    for _ in range(1500):
        fly(Setpoint(goal_n, still, still, 0.0))
    away = np.array(track[-1500:]) + moved - goal_n
    late = np.flatnonzero(np.linalg.norm(away, axis=1) > 0.4)[-1] * DT
    assert late < 3.1
    assert (away @ [0.6, 0.8, 0.0]).max() < (0.15 if wind == 0.0 else 0.4)
    # WHEN an eight is asked for THEN it is followed
    for _ in range(1500):
        fly(Setpoint(hover_n, still, still, 0.0))
    errors = []
    for k in range(4000):
        asked = eight(hover_n, (k + 1) * DT)
        fly(asked)
        errors.append(track[-1] + moved - asked.position_n)
    level = np.linalg.norm(np.array(errors[1000:])[:, :2], axis=1)
    rms = math.sqrt((level**2).mean())
    print(f"{name}, wind {wind:g} m/s: 5 m in {late:.2f} s; eight {rms:.3f} m RMS, {level.max():.3f} m at most")
    assert rms < 0.10
    assert level.max() < 0.3
