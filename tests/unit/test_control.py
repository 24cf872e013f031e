"""The cascade's geometry against scipy's rotations, its limits, and the cache of its compiled form."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from fakevehicle import jit
from fakevehicle.airframe import GRAVITY, load_airframe
from fakevehicle.control.cascade import NAVIGATION, SETPOINT, outer_loops
from fakevehicle.control.gains import PARAMETERS, ControlTables
from fakevehicle.params import ParameterSet
from fakevehicle.tick import advance
from fakevehicle.vocabulary import FloatArray

X500 = load_airframe("x500")
PLAIN = {f"FT_{loop}_{term}": 0.0 for loop in ("VXY", "VZ") for term in ("KT", "KI", "KD")}


def rotation(q: FloatArray) -> Rotation:
    w, x, y, z = q
    return Rotation.from_quat([x, y, z, w])


def run(
    velocity: object = (0, 0, 0),
    acceleration: object = (0, 0, 0),
    yaw: float = 0.0,
    at: Rotation | None = None,
    **over: float,
) -> ControlTables:
    """One pass of the outer loops from a vehicle that stands still at attitude `at`."""
    tables = ControlTables(X500, ParameterSet(PARAMETERS, PLAIN | over))
    tables.rest(0.0)
    setpoint, nav = np.full(SETPOINT, np.nan), np.zeros(NAVIGATION)
    setpoint[3:6], setpoint[6:9], setpoint[9] = velocity, acceleration, yaw
    x, y, z, w = (at or Rotation.identity()).as_quat()
    nav[6:10] = [w, x, y, z]
    bank, body = tables.bank, X500.record()[0]
    args = (bank.loops, bank.coefficients, bank.states, 0.004)
    outer_loops(setpoint, nav, tables.gains[0], tables.status[0], body, *args)
    return tables


def test_hovering_asks_for_a_level_attitude_with_the_yaw_and_the_weight() -> None:
    status = run(yaw=2.5).status[0]
    np.testing.assert_allclose(rotation(status["q_sp"]).as_euler("ZYX"), [2.5, 0.0, 0.0], atol=1e-9)
    assert status["thrust"] == pytest.approx(X500.mass * GRAVITY)


@pytest.mark.parametrize("yaw", [0.0, 1.0, 3.1, -2.2])
def test_thrust_points_where_the_acceleration_needs_it(yaw: float) -> None:
    wanted = np.array([3.0, -2.0, -1.0])
    status = run(acceleration=wanted, yaw=yaw).status[0]
    turned = rotation(status["q_sp"])
    direction = wanted - [0.0, 0.0, GRAVITY]
    np.testing.assert_allclose(-turned.apply([0.0, 0.0, 1.0]), direction / np.linalg.norm(direction), atol=1e-9)
    nose = turned.apply([1.0, 0.0, 0.0])
    # the nose lies in the vertical plane of the yaw, or as near as the tilt allows: no part of y_b along it
    assert float(turned.apply([0.0, 1.0, 0.0]) @ [math.cos(yaw), math.sin(yaw), 0.0]) == pytest.approx(0.0, abs=1e-9)
    assert float(nose @ [math.cos(yaw), math.sin(yaw), 0.0]) > 0.0


def test_going_north_means_nose_down_going_east_means_right_side_down() -> None:
    assert rotation(run(velocity=(1, 0, 0)).status[0]["q_sp"]).as_euler("ZYX")[1] < -0.05
    assert rotation(run(velocity=(0, 1, 0)).status[0]["q_sp"]).as_euler("ZYX")[2] > 0.05


def test_rates_turn_the_body_towards_the_setpoint_tilt_first_yaw_gently() -> None:
    at = Rotation.from_euler("ZYX", [0.1, 0.05, -0.08])
    status = run(at=at).status[0]
    wanted = (at.inv() * rotation(status["q_sp"])).as_rotvec()
    np.testing.assert_allclose(status["rate_sp"][:2], 10.0 * wanted[:2], rtol=0.1)
    assert status["rate_sp"][2] == pytest.approx(2.5 * wanted[2], rel=0.1)


def test_tilt_rates_and_speeds_are_limited() -> None:
    status = run(velocity=(50, 0, 0), MPC_TILTMAX_AIR=20.0).status[0]
    tilt = math.acos(float(rotation(status["q_sp"]).apply([0.0, 0.0, 1.0])[2]))
    assert math.degrees(tilt) == pytest.approx(20.0, abs=1e-6)
    assert status["followed"][3] == pytest.approx(12.0)
    assert status["pushed_a"][0] < 0.0
    upside = run(at=Rotation.from_euler("x", 3.0)).status[0]
    assert float(np.abs(upside["rate_sp"]).max()) <= math.radians(220.0) + 1e-9


def test_full_thrust_goes_to_height_first() -> None:
    status = run(velocity=(0, 0, -3), acceleration=(5.0, 0.0, -20.0)).status[0]
    assert status["thrust"] <= 0.95 * 4 * X500.thrust_coefficient * X500.max_rotor_speed**2 + 1e-9
    assert status["pushed_a"][2] > 0.0
    assert status["pushed_a"][0] < 0.0


def test_an_acceleration_alone_keeps_all_of_the_trim_the_velocity_loop_had_found() -> None:
    tables = ControlTables(X500, ParameterSet(PARAMETERS))
    tables.rest(0.0)
    setpoint, nav = np.full(SETPOINT, np.nan), np.zeros(NAVIGATION)
    nav[6] = 1.0
    args = (X500.record()[0], tables.bank.loops, tables.bank.coefficients, tables.bank.states, 0.004)
    setpoint[3:6], setpoint[9] = 0.0, 0.0
    nav[5] = 0.05  # it sinks a little for two seconds, then stands still: what stays is the trim
    for k in range(600):
        nav[5] = 0.05 if k < 500 else 0.0
        outer_loops(setpoint, nav, tables.gains[0], tables.status[0], *args)
    held = float(tables.status[0]["thrust"])
    assert held > 1.02 * X500.mass * GRAVITY
    setpoint[3:6], setpoint[6:9] = np.nan, 0.0
    for _ in range(50):
        outer_loops(setpoint, nav, tables.gains[0], tables.status[0], *args)
        assert tables.status[0]["thrust"] == pytest.approx(held, rel=1e-3)


@pytest.mark.parametrize(("away", "speed"), [(1.0, 2.0), (10.0, math.sqrt(2 * 5.0 * (10.0 - 0.5 * 5.0 / 2.0**2)))])
def test_a_place_is_approached_in_proportion_when_near_and_with_a_constant_deceleration_from_far(
    away: float, speed: float
) -> None:
    over = {"MPC_XY_P": 2.0, "MPC_ACC_BRAKE": 5.0, "MPC_XY_VEL_MAX": 20.0}
    tables = ControlTables(X500, ParameterSet(PARAMETERS, PLAIN | over))
    setpoint, nav = np.full(SETPOINT, np.nan), np.zeros(NAVIGATION)
    nav[6], setpoint[:3] = 1.0, [0.6 * away, -0.8 * away, 0.0]
    bank, body = tables.bank, X500.record()[0]
    outer_loops(
        setpoint, nav, tables.gains[0], tables.status[0], body, bank.loops, bank.coefficients, bank.states, 0.004
    )
    np.testing.assert_allclose(tables.status[0]["followed"][3:5], [0.6 * speed, -0.8 * speed], rtol=1e-12)


def test_an_acceleration_that_grows_is_looked_ahead_of_by_the_lead_and_one_that_comes_anew_makes_no_jump() -> None:
    tables = ControlTables(X500, ParameterSet(PARAMETERS, PLAIN | {"MPC_ACC_LEAD": 0.08}))
    tables.rest(0.0)
    setpoint, nav = np.full(SETPOINT, np.nan), np.zeros(NAVIGATION)
    nav[6], body, bank = 1.0, X500.record()[0], tables.bank
    seen = []
    for k in range(200):
        wanted = 1.0 + 2.0 * 0.004 * k  # 2 m/s^3, to the north
        setpoint[3:6], setpoint[6:9] = 0.0, [wanted, 0.0, 0.0]
        outer_loops(
            setpoint, nav, tables.gains[0], tables.status[0], body, bank.loops, bank.coefficients, bank.states, 0.004
        )
        ahead = tables.status[0]["ahead"]
        seen.append(float(ahead[0]) - wanted)
        assert list(ahead[1:]) == [0.0, 0.0]
    assert seen[0] == 0.0
    assert seen[-1] == pytest.approx(2.0 * 0.08)


def test_orders_wait_for_the_motors_to_rest() -> None:
    parameters = ParameterSet(PARAMETERS)
    tables = ControlTables(X500, parameters)
    before = tables.bank.coefficients.copy()
    parameters.set("FT_RXY_LAMBDA", 0.7)
    tables.update(parameters, at_rest=False)
    np.testing.assert_array_equal(tables.bank.coefficients, before)
    tables.update(parameters, at_rest=True)
    assert (tables.bank.coefficients != before).any()


def test_a_cached_kernel_is_stale_when_any_kernel_module_has_changed() -> None:
    assert advance._cache._cache_file._source_stamp == jit._STAMP  # type: ignore[attr-defined]
    newest, size = jit._STAMP
    assert newest > 0
    assert size > 10_000
