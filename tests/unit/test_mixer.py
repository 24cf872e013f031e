"""The mixer against linear programs, on even and uneven airframes, with full and sagging batteries."""

import numpy as np
import pytest
from scipy.optimize import linprog

from fakevehicle.airframe import GRAVITY, Airframe, load_airframe
from fakevehicle.control.allocation import allocate
from fakevehicle.control.gains import PARAMETERS, ControlTables
from fakevehicle.params import ParameterSet
from fakevehicle.vocabulary import FloatArray

X500 = load_airframe("x500")


def uneven(front: float = 0.20, rear: float = -0.15, left: float = 0.0) -> Airframe:
    """An X500 whose centre of mass is not in the middle of its rotors: 27 % of the way to the rear arms."""
    rotors = [
        {"position_b": [front if r.position_b[0] > 0 else rear, r.position_b[1] - left, -0.06], "spin": r.spin}
        for r in X500.rotors
    ]
    return Airframe.model_validate({**X500.model_dump(), "rotors": rotors})


FRAMES = {"x500": X500, "iris": load_airframe("iris"), "uneven": uneven(), "oblique": uneven(0.19, -0.16, 0.02)}


def mixed(frame: Airframe, wanted: FloatArray, boost: float = 1.0) -> tuple[bool, FloatArray, FloatArray]:
    """Whether something was given up, what was reached (tau, T) and what the mixer says it gave up."""
    body, command, pushed = frame.record()[0], np.zeros(4), np.zeros(4)
    body["boost"] = boost
    lost = allocate(body, *wanted, command, pushed)
    assert command.max() <= frame.max_rotor_speed / boost * (1.0 + 1e-12)
    assert command.min() >= frame.idle_rotor_speed * (1.0 - 1e-12)
    return lost, frame.allocation() @ (frame.thrust_coefficient * command**2), pushed


def best(frame: Airframe, wanted: FloatArray, boost: float) -> FloatArray:
    """The demand as far as it can be met: most of roll and pitch, then the nearest thrust, then most of yaw."""
    arms = frame.allocation()
    low = frame.thrust_coefficient * frame.idle_rotor_speed**2
    bounds = [(low, frame.thrust_coefficient * (frame.max_rotor_speed / boost) ** 2)] * 4
    scale = max(1.0, wanted[3])

    def solve(
        cost: list[float], equal: list[list[float]], right: list[float], more: list[tuple[float, float]]
    ) -> float:
        found = linprog(cost, A_eq=np.array(equal), b_eq=right, bounds=[*bounds, *more], method="highs")
        assert found.success
        return float(found.x[4])

    def row(axis: int, *more: float) -> list[float]:
        return [*arms[axis], *more]

    # T_1..4 and the share s; without yaw
    share = solve([0, 0, 0, 0, -1], [row(0, -wanted[0]), row(1, -wanted[1]), row(2, 0.0)], [0, 0, 0], [(0.0, 1.0)])
    kept = [share * wanted[0], share * wanted[1]]
    # T_1..4, the total, and how far it is over and under
    total = solve(
        [0, 0, 0, 0, 0, 1, 1],
        [row(0, 0, 0, 0), row(1, 0, 0, 0), row(2, 0, 0, 0), row(3, -1, 0, 0), [0, 0, 0, 0, 1, -1, 1]],
        [*(k * (1 - 1e-9) for k in kept), 0, 0, wanted[3]],
        [(0.0, 10 * scale), (0.0, 10 * scale), (0.0, 10 * scale)],
    )
    yaw = solve(
        [0, 0, 0, 0, -1],
        [row(0, 0), row(1, 0), row(2, -wanted[2]), row(3, 0)],
        [*(k * (1 - 1e-9) for k in kept), 0, total],
        [(0.0, 1.0)],
    )
    return np.array([*kept, yaw * wanted[2], total])


@pytest.mark.parametrize("boost", [1.0, 1.15])
@pytest.mark.parametrize("name", FRAMES)
def test_what_the_mixer_reaches_is_what_linear_programs_say_can_be_reached(name: str, boost: float) -> None:
    frame, rng = FRAMES[name], np.random.default_rng(3)
    full = 4 * frame.thrust_coefficient * frame.max_rotor_speed**2
    given_up = 0
    for _ in range(60):
        strength = rng.choice([0.02, 0.3, 2.0])
        wanted = strength * full * rng.uniform(-1, 1, 4) * [0.15, 0.15, 0.02, 0.0]
        wanted[3] = full * rng.uniform(0.05, 1.0)
        lost, reached, pushed = mixed(frame, wanted, boost)
        tolerance = 1e-6 * full
        np.testing.assert_allclose(reached, best(frame, wanted, boost), atol=tolerance)
        np.testing.assert_allclose(pushed, reached - wanted, atol=tolerance)
        assert lost == bool(np.abs(reached - wanted).max() > tolerance)
        given_up += lost
    assert 15 < given_up < 55  # the draws cover both


def test_an_airframe_whose_centre_of_mass_is_off_gets_the_torques_and_the_thrust_it_asks_for() -> None:
    lost, reached, pushed = mixed(uneven(), np.array([0.0, 0.05, 0.0, 20.0]))
    assert not lost
    np.testing.assert_allclose(reached, [0.0, 0.05, 0.0, 20.0], atol=1e-12)
    assert not pushed.any()


def test_the_most_thrust_an_uneven_airframe_is_asked_for_is_what_it_gives_without_a_torque() -> None:
    frame = uneven()
    # the rear rotors carry 0.20 / 0.35 of the weight; when they are at full speed the front ones are at three quarters
    each = frame.thrust_coefficient * frame.max_rotor_speed**2
    assert frame.level_thrust == pytest.approx(2 * each * (1.0 + 0.75))
    assert X500.level_thrust == 4 * X500.thrust_coefficient * X500.max_rotor_speed**2
    tables = ControlTables(frame, ParameterSet(PARAMETERS))
    assert tables.gains[0]["thrust_max"] == pytest.approx(0.95 * frame.level_thrust)


def test_on_a_sagging_battery_the_mixer_gives_up_what_the_rotors_no_longer_reach_and_says_so() -> None:
    sag = 0.82
    most = 4 * X500.thrust_coefficient * (sag * X500.max_rotor_speed) ** 2
    assert most > X500.mass * GRAVITY
    lost, reached, pushed = mixed(X500, np.array([0.1, -0.2, 0.0, 1.1 * most]), 1.0 / sag)
    assert lost
    np.testing.assert_allclose(reached[:2], [0.1, -0.2], atol=1e-9)  # roll and pitch come first still
    assert reached[3] < most
    assert pushed[3] == pytest.approx(reached[3] - 1.1 * most)


def test_the_loops_ask_for_no_more_than_a_sagging_battery_lifts_whatever_parameter_is_read_again() -> None:
    parameters = ParameterSet(PARAMETERS)
    tables = ControlTables(X500, parameters)
    full = X500.level_thrust
    tables.weaken(1.0 / 0.99)  # MPC_THR_MAX leaves more than that
    assert tables.gains[0]["thrust_max"] == pytest.approx(0.95 * full)
    tables.weaken(1.0 / 0.9)
    assert tables.gains[0]["thrust_max"] == pytest.approx(0.81 * full)
    parameters.set("MPC_XY_P", 1.5)
    tables.update(parameters, at_rest=False)
    assert tables.gains[0]["thrust_max"] == pytest.approx(0.81 * full)
    parameters.set("MPC_THR_MAX", 0.8)
    tables.update(parameters, at_rest=False)
    assert tables.gains[0]["thrust_max"] == pytest.approx(0.8 * full)
    assert tables.gains[0]["thrust_full"] == full
