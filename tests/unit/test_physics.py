"""Rigid body, rotors, ground and wind against closed forms and conservation laws."""

import math
from typing import Any

import numpy as np
import pytest
from numba import njit
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from fakevehicle.airframe import GRAVITY, Airframe, load_airframe
from fakevehicle.battery import Battery
from fakevehicle.control.allocation import allocate
from fakevehicle.errors import AirframeError
from fakevehicle.physics.dynamics import STATE, derivative, step
from fakevehicle.physics.ground import settle
from fakevehicle.physics.wind import Gust, gust_table, scheduled, turbulence
from fakevehicle.vocabulary import FloatArray

X500 = load_airframe("x500")
CALM = np.zeros(3)
HIGH = -1000.0  # far above the ground [m, down]


def at(altitude_z: float = HIGH, speed: float = 0.0) -> FloatArray:
    """A level state at rest with all rotors at `speed` [rad/s]."""
    x = np.zeros(STATE)
    x[2], x[6], x[13:17] = altitude_z, 1.0, speed
    return x


def fly(
    x: FloatArray, command: FloatArray, duration: float, dt: float = 0.001, airframe: Airframe = X500
) -> FloatArray:
    """`x` after `duration` seconds in calm air; in place."""
    body, work, anchor = airframe.record()[0], np.zeros((6, STATE)), np.zeros((4, 3))
    for _ in range(round(duration / dt)):
        step(x, command, CALM, anchor, body, dt, work)
    return x


def changed(**fields: object) -> Airframe:
    return X500.model_copy(update=fields)


def test_without_drag_and_thrust_it_falls_as_galileo_says() -> None:
    x = fly(at(), np.zeros(4), 2.0, airframe=changed(drag_area=(0.0, 0.0, 0.0)))
    assert x[5] == pytest.approx(2.0 * GRAVITY, rel=1e-12)
    assert x[2] - HIGH == pytest.approx(0.5 * GRAVITY * 2.0**2, rel=1e-9)


def test_rotor_drag_decays_sideways_speed_exponentially() -> None:
    # rotors at constant speed in the plane of the centre of mass: drag is linear and makes no torque about x or y
    flat = [{"position_b": (*r.position_b[:2], 0.0), "spin": r.spin} for r in X500.rotors]
    frame = Airframe.model_validate({**X500.model_dump(), "rotors": flat, "drag_area": (0.0, 0.0, 0.0)})
    speed = 600.0
    x = at(speed=speed)
    x[3] = 5.0
    fly(x, np.full(4, speed), 3.0, airframe=frame)
    rate = 4 * frame.rotor_drag * speed / frame.mass
    assert x[3] == pytest.approx(5.0 * math.exp(-rate * 3.0), rel=1e-9)
    assert x[0] == pytest.approx(5.0 / rate * (1.0 - math.exp(-rate * 3.0)), rel=1e-9)


def test_body_drag_ends_in_the_terminal_speed() -> None:
    x = fly(at(-2000.0), np.zeros(4), 40.0, dt=0.004)
    area = X500.drag_area[2]
    assert x[5] == pytest.approx(math.sqrt(2 * X500.mass * GRAVITY / (1.225 * area)), rel=1e-3)


def test_wind_is_the_velocity_of_the_air_so_drag_acts_on_the_difference() -> None:
    body, anchor = X500.record()[0], np.zeros((4, 3))
    drifting, standing = at(speed=700.0), at(speed=700.0)
    drifting[3:6] = [4.0, -3.0, 1.0]
    command = np.full(4, 700.0)
    a, b = np.zeros(STATE), np.zeros(STATE)
    derivative(drifting, command, drifting[3:6].copy(), anchor, body, a)
    derivative(standing, command, CALM, anchor, body, b)
    np.testing.assert_allclose(a[3:6], b[3:6], atol=1e-12)


def momentum_n(state: FloatArray, body: Any) -> FloatArray:
    """Angular momentum of frame and rotors in n, (3,) [N m s]; scipy turns it."""
    w, i, j, k = state[6:10]
    inner = body["inertia"] * state[10:13]
    inner[2] += float(body["rotor_inertia"] * body["spin"] @ state[13:17])
    turned: FloatArray = Rotation.from_quat([i, j, k, w]).apply(inner)
    return turned


def drifting(inertia: tuple[float, float, float]) -> Any:
    """A body that only gravity acts on: no air for frame or rotors."""
    body = X500.record()[0]
    body["inertia"], body["k"], body["c_d"], body["drag_area"] = inertia, 0.0, 0.0, 0.0
    return body


@pytest.mark.parametrize("spinning", [False, True])
def test_without_air_momentum_and_energy_stay_for_a_minute(spinning: bool) -> None:
    # rotors that spin at a constant speed turn the body about (gyroscopic torque) but do no work on it
    body, work, anchor = drifting((0.02, 0.03, 0.05)), np.zeros((6, STATE)), np.zeros((4, 3))
    x = at(-30_000.0)
    x[3:6], x[10:13] = [2.0, -1.0, 0.0], [3.0, 0.2, 1.0]
    command = np.array([700.0, 900.0, 600.0, 800.0]) if spinning else np.zeros(4)
    x[13:17] = command
    before = momentum_n(x, body)
    spin = 0.5 * float(body["inertia"] @ x[10:13] ** 2)
    total = 0.5 * body["mass"] * float(x[3:6] @ x[3:6]) - body["mass"] * body["gravity"] * x[2] + spin
    for _ in range(60_000):
        step(x, command, CALM, anchor, body, 0.001, work)
    np.testing.assert_allclose(momentum_n(x, body), before, rtol=0, atol=1e-9 * float(np.linalg.norm(before)))
    assert 0.5 * float(body["inertia"] @ x[10:13] ** 2) == pytest.approx(spin, rel=1e-9)
    ended = 0.5 * body["mass"] * float(x[3:6] @ x[3:6]) - body["mass"] * body["gravity"] * x[2]
    assert ended + 0.5 * float(body["inertia"] @ x[10:13] ** 2) == pytest.approx(total, rel=1e-9)
    np.testing.assert_allclose(x[3:6], [2.0, -1.0, 60.0 * GRAVITY], rtol=1e-9)  # linear momentum: the impulse of g


def test_rotors_that_change_speed_take_their_momentum_from_the_body() -> None:
    body, work, anchor = drifting((0.02, 0.03, 0.05)), np.zeros((6, STATE)), np.zeros((4, 3))
    x = at(-30_000.0)
    x[10:13] = [1.0, -0.5, 0.3]
    before = momentum_n(x, body)
    for k in range(60_000):  # both time constants, over and over
        command = np.array([900.0, 100.0, 500.0, 0.0]) if k // 500 % 2 else np.array([100.0, 800.0, 0.0, 600.0])
        step(x, command, CALM, anchor, body, 0.001, work)
    np.testing.assert_allclose(momentum_n(x, body), before, rtol=0, atol=1e-9 * float(np.linalg.norm(before)))


def test_rotors_that_speed_up_together_turn_the_body_against_their_momentum() -> None:
    # one pair only: its spin-up must be paid for by the body, on top of the air's drag torque
    body, anchor, dx = X500.record()[0], np.zeros((4, 3)), np.zeros(STATE)
    x = at(speed=0.0)
    derivative(x, np.array([500.0, 500.0, 0.0, 0.0]), CALM, anchor, body, dx)
    # both spin counter-clockwise from above (-z_b); momentum is conserved, so the body turns about +z_b
    momentum = -2 * X500.rotor_inertia * 500.0 / X500.time_constant_up
    assert dx[12] == pytest.approx(-momentum / X500.inertia[2], rel=1e-12)


def test_it_hovers_at_the_hover_speed() -> None:
    speed = X500.hover_speed
    assert speed == pytest.approx(769.0, abs=1.0)
    x = fly(at(speed=speed), np.full(4, speed), 5.0)
    np.testing.assert_allclose(x[0:6] - at()[0:6], 0.0, atol=1e-6)


def test_rotors_follow_faster_up_than_down() -> None:
    x = fly(at(speed=500.0), np.array([600.0, 400.0, 500.0, 500.0]), 0.025)
    assert x[13] == pytest.approx(600.0 - 100.0 * math.exp(-2.0), rel=1e-6)
    assert x[14] == pytest.approx(400.0 + 100.0 * math.exp(-1.0), rel=1e-6)


def test_runge_kutta_is_of_fourth_order_and_agrees_with_another_integrator() -> None:
    body, anchor = X500.record()[0], np.zeros((4, 3))
    start = at(speed=760.0)
    start[3:6], start[10:13] = [3.0, -1.0, 0.5], [1.0, -2.0, 0.7]
    command = np.array([790.0, 775.0, 795.0, 800.0])  # every rotor speeds up: no switch of time constant

    def f(_: float, state: FloatArray) -> FloatArray:
        dx = np.zeros(STATE)
        derivative(state, command, CALM, anchor, body, dx)
        return dx

    exact = solve_ivp(f, (0.0, 0.2), start, method="DOP853", rtol=1e-13, atol=1e-13).y[:, -1]
    errors = [float(np.abs(fly(start.copy(), command, 0.2, dt) - exact)[:13].max()) for dt in (0.004, 0.002, 0.001)]
    assert math.log2(errors[0] / errors[1]) == pytest.approx(4.0, abs=0.3)
    assert errors[2] < 1e-8


def test_each_rotor_pushes_the_way_its_place_and_spin_say() -> None:
    # PX4 order; signs worked by hand: a rotor in front pitches up (+y), one on the right rolls left (-x),
    # one that spins counter-clockwise turns the body clockwise (+z)
    signs = np.sign(X500.allocation())
    np.testing.assert_array_equal(signs[0], [-1, 1, 1, -1])
    np.testing.assert_array_equal(signs[1], [1, -1, 1, -1])
    np.testing.assert_array_equal(signs[2], [1, 1, -1, -1])
    np.testing.assert_array_equal(signs[3], [1, 1, 1, 1])
    assert np.linalg.matrix_rank(X500.allocation()) == 4


def test_dynamics_and_allocation_agree_on_torque_and_thrust() -> None:
    body, anchor, dx = X500.record()[0], np.zeros((4, 3)), np.zeros(STATE)
    command, pushed = np.zeros(4), np.zeros(4)
    wanted = np.array([0.2, -0.15, 0.02, 22.0])
    assert not allocate(body, *wanted, command, pushed)
    x = at()
    x[13:17] = command
    derivative(x, command, CALM, anchor, body, dx)
    np.testing.assert_allclose(dx[10:13] * X500.inertia, wanted[:3], rtol=1e-6)
    assert (GRAVITY - dx[5]) * X500.mass == pytest.approx(wanted[3], rel=1e-6)


@pytest.mark.parametrize(
    ("wanted", "kept", "given_up"),
    [
        ((0.1, -0.1, 3.0, 20.0), (0, 1, 3), (2,)),  # too much yaw: only yaw suffers
        ((1.0, 0.5, 0.0, 33.0), (0, 1), (3,)),  # roll and pitch near full thrust: thrust gives way
        ((8.0, 0.0, 0.5, 20.0), (), (0,)),  # more roll than there is
    ],
)
def test_the_mixer_gives_up_the_least_important_axis_first(
    wanted: tuple[float, ...], kept: tuple[int, ...], given_up: tuple[int, ...]
) -> None:
    body, command, pushed = X500.record()[0], np.zeros(4), np.zeros(4)
    assert allocate(body, *wanted, command, pushed)
    reached = X500.allocation() @ (X500.thrust_coefficient * command**2)
    np.testing.assert_allclose(reached - wanted, pushed, atol=1e-9)
    for axis in kept:
        assert reached[axis] == pytest.approx(wanted[axis], abs=1e-9)
    for axis in given_up:
        assert abs(pushed[axis]) > 1e-3
    assert command.max() <= X500.max_rotor_speed + 1e-9
    assert command.min() >= X500.idle_rotor_speed - 1e-9


def test_a_battery_sags_under_load_and_empties() -> None:
    pack = X500.battery
    battery = Battery(pack)
    assert battery.voltage == pytest.approx(16.8)
    assert battery.sag == 1.0
    for _ in range(50 * 600):  # ten minutes of hover
        battery.draw(0.769**3, 0.02)
    # 190 W at 15.5 V or so for 600 s, of 18000 C
    assert battery.remaining == pytest.approx(1.0 - 190.0 / 15.5 * 600.0 / 18000.0, abs=0.02)
    resting = 4 * (3.5 + 0.7 * battery.remaining)
    assert battery.voltage == pytest.approx(resting - pack.resistance * battery.current)
    for _ in range(50 * 1800):
        battery.draw(1.0, 0.02)
    assert battery.remaining == 0.0
    assert math.isfinite(battery.current)
    assert battery.voltage > 7.0


def test_it_rests_on_the_ground_without_drifting_even_in_wind() -> None:
    body, work = X500.record()[0], np.zeros((6, STATE))
    anchor = np.array(X500.contact_points_b)
    x, wind = at(0.0), np.array([6.0, 3.0, 0.0])
    for _ in range(5000):
        step(x, np.zeros(4), wind, anchor, body, 0.001, work)
        assert settle(x, anchor, body)
    settled = x.copy()
    for _ in range(5000):
        step(x, np.zeros(4), wind, anchor, body, 0.001, work)
        settle(x, anchor, body)
    np.testing.assert_allclose(x[:6], settled[:6], atol=1e-9)
    assert float(np.abs(x[:3]).max()) < 2e-3


def test_a_fall_from_a_metre_ends_upright_at_rest() -> None:
    body, work = X500.record()[0], np.zeros((6, STATE))
    anchor = np.array(X500.contact_points_b)
    x = at(-1.0)
    x[3] = 0.5
    highest = 0.0
    for _ in range(6000):
        step(x, np.zeros(4), CALM, anchor, body, 0.001, work)
        settle(x, anchor, body)
        highest = max(highest, float(np.abs(x[3:6]).max()))
    assert highest < 4.6  # sqrt(2 g h) = 4.43 and nothing faster
    np.testing.assert_allclose(x[3:6], 0.0, atol=1e-3)
    assert x[2] == pytest.approx(0.0, abs=1e-3)
    assert x[6] > 0.99


@pytest.mark.parametrize("name", ["x500", "iris", "crazyflie"])
@pytest.mark.parametrize("roll", [3.0, 1.7, 0.05])
def test_however_it_falls_it_comes_to_lie_on_the_ground_and_not_in_it(name: str, roll: float) -> None:
    frame = load_airframe(name)
    body, work = frame.record()[0], np.zeros((6, STATE))
    anchor = body["contact"].copy()
    x = at(-0.3)
    x[6:10] = [math.cos(0.5 * roll), math.sin(0.5 * roll), 0.0, 0.0]
    for _ in range(8000):
        step(x, np.zeros(4), CALM, anchor, body, 0.001, work)
        settle(x, anchor, body)
    corners = np.array([*frame.contact_points_b, *(r.position_b for r in frame.rotors)])
    w, i, j, k = x[6:10]
    depth = x[2] + Rotation.from_quat([i, j, k, w]).apply(corners)[:, 2] - float(body["ground"])
    sunk = frame.mass * GRAVITY / (2 * frame.contact_stiffness)  # twice as deep as on four feet, if it lies on two
    assert depth.max() < 1.1 * sunk
    assert (depth > 0.0).sum() >= 2
    assert np.abs(x[3:6]).max() < 1e-3
    if roll == 3.0:  # on its back
        assert 1.0 - 2.0 * (i * i + j * j) < -0.99
        assert (depth[4:] > 0.0).all()
    elif roll == 0.05:
        assert (depth[:4] > 0.0).all()


def sigmas(strength: float, height: float) -> FloatArray:
    """Standard deviations of u, v, w that MIL-F-8785C gives below 1000 ft."""
    feet = height / 0.3048
    w = 0.1 * strength
    u = w / (0.177 + 0.000823 * feet) ** 0.4
    return np.array([u, u, w])


@njit(cache=False)  # type: ignore[untyped-decorator]
def _blown(rng: np.random.Generator, dt: float, n: int, every: int) -> FloatArray:
    """Every so many of `n` samples of the turbulence 3 m over ground at 20 m/s."""
    state, noise, seen = np.zeros(5), np.zeros(5), np.zeros((n // every, 3))
    for k in range(n):
        for i in range(5):
            noise[i] = rng.standard_normal()
        u, v, w = turbulence(state, 10.0, 3.0, 20.0, dt, noise)
        if k % every == 0:
            seen[k // every] = u, v, w
    return seen


@pytest.mark.slow
@pytest.mark.parametrize("dt", [pytest.param(0.001, marks=pytest.mark.soak), 0.002, 0.005, 0.01])
def test_turbulence_has_the_standards_variance_whatever_the_step(dt: float) -> None:
    # L_u / V = 1 s at 3 m and 20 m/s: a variance known to 5 % at four sigma needs 2 (4 / 0.05)^2 = 12800 of them
    seen = _blown(np.random.default_rng(7), dt, round(14_000.0 / dt), round(0.05 / dt))
    np.testing.assert_allclose(seen.var(axis=0), sigmas(10.0, 3.0) ** 2, rtol=0.05)


def test_a_step_of_turbulence_keeps_its_stationary_covariance_exactly() -> None:
    # P = Phi P Phi^T + Q from the kernel's own response to unit states and unit draws, for the states' P of the theory
    P = np.zeros((5, 5))
    P[0, 0] = 1.0
    for i in (1, 3):
        P[i : i + 2, i : i + 2] = [[0.5, 0.25], [0.25, 0.25]]
    for dt in (0.001, 0.002, 0.005, 0.01, 0.1, 1.0):
        Phi, G = np.zeros((5, 5)), np.zeros((5, 5))
        for i in range(5):
            for matrix, state, noise in ((Phi, np.eye(5)[i], np.zeros(5)), (G, np.zeros(5), np.eye(5)[i])):
                turbulence(state, 9.0, 10.0, 8.0, dt, noise)
                matrix[:, i] = state
        np.testing.assert_allclose(Phi @ P @ Phi.T + G @ G.T, P, atol=1e-12)


def test_turbulence_has_the_standards_spectrum() -> None:
    # the response of the discrete filter to one unit draw, against |H|^2 of the forming filters far below 1/dt
    dt, n, speed, height = 0.002, 60_000, 20.0, 3.0
    feet = height / 0.3048
    shape = 0.177 + 0.000823 * feet
    s = 2j * np.pi * np.array([0.02, 0.1, 0.3, 1.0, 3.0])
    k = np.arange(n)
    for axis, first in ((0, 0), (1, 1), (2, 3)):
        response = np.zeros((2, n))
        for draw in range(1 if axis == 0 else 2):
            state, noise = np.zeros(5), np.zeros(5)
            noise[first + draw] = 1.0
            for j in range(n):
                response[draw, j] = turbulence(state, 10.0, height, speed, dt, noise)[axis]
                noise[:] = 0.0
        T = height / (shape**1.2 if axis < 2 else 1.0) / speed
        wanted = sigmas(10.0, height)[axis] ** 2 * T / np.abs(1 + T * s) ** 2
        wanted = 2.0 * wanted if axis == 0 else wanted * np.abs((1 + 3**0.5 * T * s) / (1 + T * s)) ** 2
        found = [dt * sum(abs(np.sum(r * np.exp(-w * k * dt))) ** 2 for r in response) for w in s]
        np.testing.assert_allclose(found, wanted, rtol=0.01)


def test_a_scheduled_gust_rises_holds_and_falls() -> None:
    table = gust_table((Gust(2_000_000, 1.0, 3.0, np.array([4.0, 0.0, -1.0])), Gust(3_000_000, 0.0, 1.0, np.ones(3))))
    seen = {}
    for now in (1.9, 2.5, 2.75, 3.5, 5.9, 6.5, 7.1):
        wind = np.array([1.0, 2.0, 0.0])
        scheduled(table, now, wind)
        seen[now] = (wind - [1.0, 2.0, 0.0]).tolist()
    assert seen[1.9] == seen[7.1] == [0.0, 0.0, 0.0]
    assert seen[2.5] == pytest.approx([2.0, 0.0, -0.5])
    assert seen[6.5] == pytest.approx([2.0, 0.0, -0.5])
    assert seen[2.75][0] == pytest.approx(4.0 * math.sin(0.375 * math.pi) ** 2)
    assert seen[3.5] == pytest.approx([5.0, 1.0, 0.0])
    assert seen[5.9] == [4.0, 0.0, -1.0]
    with pytest.raises(ValueError, match="gust"):
        Gust(0, -1.0, 0.0, np.zeros(3))


def test_a_torn_rotor_gives_its_share_of_thrust_and_torque() -> None:
    body, anchor = X500.record()[0], np.zeros((4, 3))
    whole, torn = np.zeros(STATE), np.zeros(STATE)
    derivative(at(speed=600.0), np.full(4, 600.0), CALM, anchor, body, whole)
    body["effect"][2] = 0.65
    derivative(at(speed=600.0), np.full(4, 600.0), CALM, anchor, body, torn)
    lost = 0.35 * X500.thrust_coefficient * 600.0**2
    x, y, _ = X500.rotors[2].position_b
    assert (torn - whole)[5] == pytest.approx(lost / X500.mass)
    inertia = np.array(X500.inertia)
    torque = [lost * y, -lost * x, X500.rotors[2].spin * X500.moment_ratio * lost]
    np.testing.assert_allclose((torn - whole)[10:13] * inertia, torque, rtol=1e-8)


def test_motors_on_a_flat_battery_stop_short_of_the_speed_they_are_asked_for() -> None:
    body, work, x = X500.record()[0], np.zeros((6, STATE)), at()
    body["sag"] = 0.9
    for _ in range(300):
        step(x, np.full(4, 800.0), CALM, np.zeros((4, 3)), body, 0.001, work)
    np.testing.assert_allclose(x[13:17], 720.0, rtol=1e-6)


def test_a_bad_airframe_file_is_one_clear_error(tmp_path) -> None:  # type: ignore[no-untyped-def]
    text = (X500.model_dump_json()).replace('"mass":2.06432', '"mass":-1')
    (tmp_path / "bad.yaml").write_text(text)
    with pytest.raises(AirframeError, match=r"bad\.yaml: mass: found -1, expected greater than or equal to 0\.005"):
        load_airframe(str(tmp_path / "bad.yaml"))
    with pytest.raises(AirframeError, match="x500"):
        load_airframe("no_such_thing")
