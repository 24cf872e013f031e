"""Closed loop, estimator in it: the stack flies on what it believes and is judged by truth.

Setpoints live in the estimator's frame, whose origin is the first fix; truth counts from home. The difference is taken
as the mean over the last two seconds at rest, as a companion would, and everything is compared after subtracting it.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
import pytest

from fakevehicle.airframe import load_airframe
from fakevehicle.control.gains import PAPER_GAINS, ControlTables
from fakevehicle.flight import PARAMETERS, FlightStack
from fakevehicle.params import ParameterSet
from fakevehicle.vocabulary import FloatArray, Geodetic, Setpoint

HOME = Geodetic(math.radians(47.397742), math.radians(8.545594), 488.0)
REST_S, HEIGHT = 8.0, 2.5


def still(position_n: FloatArray, yaw: float = math.nan) -> Setpoint:
    return Setpoint(position_n, np.zeros(3), np.zeros(3), yaw)


@dataclass
class Flight:
    """One vehicle, ticked by hand."""

    seed: int = 1
    wind: tuple[float, float, float] = (0.0, 0.0, 0.0)
    parameters: dict[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.set = ParameterSet(PARAMETERS, self.parameters)
        self.stack = FlightStack(
            airframe=load_airframe("x500"),
            parameters=self.set,
            home=HOME,
            heading=0.3,
            wind_n=np.array(self.wind, dtype=float),
            seed=self.seed,
        )
        self.now_us = 0
        self.offset = np.zeros(3)

    def fly(
        self, duration: float, setpoint: Callable[[float], Setpoint] | Setpoint | None, armed: bool = True
    ) -> FloatArray:
        """(n, 6): truth in the estimator's frame 0:3, setpoint 3:6, a row a tick; setpoints come at 50 Hz."""
        rows = []
        current = None
        for k in range(round(duration / 0.004)):
            if k % 5 == 0:
                current = setpoint(k * 0.004) if callable(setpoint) else setpoint
            self.now_us += FlightStack.TICK_US
            self.stack.tick(self.now_us, current, armed)
            wanted = current.position_n if current is not None else np.full(3, np.nan)
            rows.append(np.concatenate([self.stack._x[:3] + self.offset, wanted]))
        return np.array(rows)

    def rest(self) -> FloatArray:
        """Stand until the estimator has settled; returns where it believes to stand."""
        self.fly(REST_S - 2.0, None, armed=False)
        apart = []
        for _ in range(100):
            self.fly(0.02, None, armed=False)
            apart.append(self.stack.estimator.out[:3] - self.stack._x[:3])
        self.offset = np.mean(apart, axis=0)
        assert self.stack.estimate.position_valid
        assert self.stack.truth.on_ground
        return self.stack.estimate.position_n.copy()

    def climb(self) -> FloatArray:
        """Take off to `HEIGHT`; returns the point to hover at."""
        ground = self.rest()
        up = np.array([0.0, 0.0, -1.0])

        def leg(t: float) -> Setpoint:
            s = min(t / 4.0, 1.0)
            return Setpoint(
                ground + HEIGHT * s * s * (3 - 2 * s) * up,
                HEIGHT * 6 * s * (1 - s) / 4.0 * up,
                HEIGHT * (6 - 12 * s) / 16.0 * up if s < 1.0 else np.zeros(3),
                0.3,
            )

        self.fly(6.0, leg)
        assert not self.stack.truth.on_ground
        return ground + HEIGHT * up


def errors(rows: FloatArray) -> FloatArray:
    return rows[:, :3] - rows[:, 3:6]


def test_it_takes_off_and_holds_for_twenty_seconds() -> None:
    flight = Flight(seed=2)
    hover = flight.climb()
    e = errors(flight.fly(20.0, still(hover)))
    assert float(np.quantile(np.linalg.norm(e, axis=1), 0.95)) < 0.25
    assert float(np.abs(e[:, 2]).max()) < 0.3
    assert flight.stack.control.thrust == pytest.approx(0.59, abs=0.05)


def test_a_step_of_five_metres_is_flown_without_swinging_past_it() -> None:
    flight = Flight(seed=3)
    hover = flight.climb()
    there = hover + np.array([3.0, 4.0, 0.0])
    flight.stack.reset_control()
    rows = flight.fly(10.0, still(there))
    along = (rows[:, :3] - hover) @ np.array([0.6, 0.8, 0.0])
    assert float(along.max()) < 5.6
    assert float(np.linalg.norm(errors(rows)[-1])) < 0.35
    assert float(np.abs(errors(rows)[:, 2]).max()) < 0.4


def test_steady_wind_is_trimmed_out() -> None:
    flight = Flight(seed=4, wind=(4.0, -3.0, 0.0))
    hover = flight.climb()
    flight.fly(6.0, still(hover))
    e = errors(flight.fly(10.0, still(hover)))
    assert float(np.linalg.norm(e.mean(axis=0))) < 0.2


def test_the_paper_s_orders_fly_but_cannot_trim_a_steady_wind() -> None:
    calm = Flight(seed=4, parameters=dict(PAPER_GAINS))
    hover = calm.climb()
    assert float(np.linalg.norm(errors(calm.fly(8.0, still(hover)))[-1])) < 0.4

    def offset(parameters: dict[str, float]) -> float:
        """How far downwind it stays, by its own belief, so that the estimator's error does not count."""
        flight = Flight(seed=4, wind=(8.0, 0.0, 0.0), parameters=parameters)
        hover = flight.climb()
        flight.fly(12.0, still(hover))
        seen = []
        for _ in range(100):
            flight.fly(0.02, still(hover))
            seen.append(float(flight.stack.estimator.out[0] - hover[0]))
        return float(np.mean(seen))

    assert offset(dict(PAPER_GAINS)) > 3 * abs(offset({}))


def lemniscate(centre: FloatArray, period: float) -> Callable[[float], Setpoint]:
    """Figure eight of 8 x 4 m, started smoothly over four seconds; position, velocity, acceleration."""
    w = 2 * math.pi / period

    def at(t: float) -> Setpoint:
        if t < 4.0:
            u = t / 4.0
            a, b, c = 4 * w * (u**3 - u**4 / 2), w * (3 * u * u - 2 * u**3), w * (6 * u - 6 * u * u) / 4
        else:
            a, b, c = 2 * w + w * (t - 4), w, 0.0
        s = np.array([4 * math.sin(a), 2 * math.sin(2 * a), 0.0])
        d = np.array([4 * math.cos(a), 4 * math.cos(2 * a), 0.0])
        dd = np.array([-4 * math.sin(a), -8 * math.sin(2 * a), 0.0])
        return Setpoint(centre + s, b * d, b * b * dd + c * d, 0.3)

    return at


@pytest.mark.parametrize(("seed", "wind"), [(1, (0.0, 0.0, 0.0)), (2, (0.0, 0.0, 0.0)), (3, (5.0, 0.0, 0.0))])
def test_a_smooth_flight_at_three_metres_a_second_is_followed(seed: int, wind: tuple[float, float, float]) -> None:
    flight = Flight(seed=seed, wind=wind)
    hover = flight.climb()
    e = errors(flight.fly(24.0, lemniscate(hover, period=10.5)))
    assert float(np.quantile(np.linalg.norm(e, axis=1), 0.95)) < 0.25
    assert float(np.abs(e[:, 2]).max()) < 0.3


def test_turbulence_is_ridden_out() -> None:
    flight = Flight(seed=5, wind=(6.0, 0.0, 0.0), parameters={"SIM_WIND_GUST": 6.0})
    hover = flight.climb()
    e = errors(flight.fly(12.0, still(hover)))
    assert float(np.linalg.norm(e, axis=1).max()) < 0.6
    assert float(np.std(e[:, 0])) > 0.0


def test_it_lands_and_stands_still() -> None:
    flight = Flight(seed=6)
    hover = flight.climb()
    down = Setpoint(np.array([hover[0], hover[1], np.nan]), np.array([0.0, 0.0, 0.7]), np.zeros(3))
    flight.fly(7.0, down)
    assert flight.stack.truth.on_ground
    assert flight.stack.control.thrust < 0.3
    flight.fly(1.0, None, armed=False)
    np.testing.assert_allclose(flight.stack.truth.velocity_n, 0.0, atol=1e-3)


def test_velocity_and_acceleration_setpoints_are_followed_where_no_position_is_given() -> None:
    flight = Flight(seed=7)
    hover = flight.climb()
    flight.fly(3.0, Setpoint(np.array([np.nan, np.nan, hover[2]]), np.array([2.0, 0.0, 0.0])))
    assert float(flight.stack.truth.velocity_n[0]) == pytest.approx(2.0, abs=0.25)
    before = flight.stack.truth.velocity_n.copy()
    flight.fly(1.0, Setpoint(np.array([np.nan, np.nan, hover[2]]), acceleration_n=np.array([0.0, 1.5, 0.0])))
    assert float(flight.stack.truth.velocity_n[1] - before[1]) == pytest.approx(1.3, abs=0.4)


def test_no_acceleration_asked_for_in_a_trimmed_hover_neither_sinks_nor_climbs() -> None:
    flight = Flight(seed=7)
    ground = flight.rest()
    flight.fly(12.0, still(ground - [0.0, 0.0, 3.0]))  # at full climb rate, so that there is trim to be lost
    before = flight.stack.truth.velocity_n.copy()
    flight.fly(3.0, Setpoint(acceleration_n=np.zeros(3)))
    drift = (flight.stack.truth.velocity_n - before) / 3.0
    assert abs(float(drift[2])) < 0.06  # [m/s^2]


def test_gains_change_in_flight_without_a_bump() -> None:
    flight = Flight(seed=8)
    hover = flight.climb()
    flight.fly(2.0, still(hover))
    before = flight.stack.control.attitude_setpoint_q_nb
    flight.set.set("FT_VXY_KP", 2.5)
    flight.set.set("FT_VZ_KP", 3.0)
    flight.fly(0.004, still(hover))
    np.testing.assert_allclose(flight.stack.control.attitude_setpoint_q_nb, before, atol=0.01)
    e = errors(flight.fly(5.0, still(hover)))
    assert float(np.linalg.norm(e, axis=1).max()) < 0.4


@pytest.mark.parametrize(("name", "value"), [("FT_VXY_KI", 0.0), ("FT_VXY_ILIM", 0.5)])
def test_taking_the_trim_away_in_wind_does_not_jolt_it(name: str, value: float) -> None:
    flight = Flight(seed=8, wind=(8.0, 0.0, 0.0))
    hover = flight.climb()
    flight.fly(8.0, still(hover))
    before, motors = flight.stack.control.attitude_setpoint_q_nb, flight.stack.control.motor
    flight.set.set(name, value)
    flight.fly(0.004, still(hover))
    np.testing.assert_allclose(flight.stack.control.attitude_setpoint_q_nb, before, atol=0.005)
    np.testing.assert_allclose(flight.stack.control.motor, motors, atol=0.01)


def test_orders_asked_for_in_flight_are_those_of_the_next_flight() -> None:
    flight = Flight()
    hover = flight.climb()
    first = flight.stack._control.bank.coefficients.copy()
    flight.set.set("FT_VXY_LAMBDA", 0.7)
    flight.fly(0.1, still(hover))
    np.testing.assert_array_equal(flight.stack._control.bank.coefficients, first)
    flight.fly(0.004, None, armed=False)
    wanted = ControlTables(load_airframe("x500"), flight.set).bank.coefficients
    assert (wanted != first).any()
    np.testing.assert_array_equal(flight.stack._control.bank.coefficients, wanted)


@pytest.mark.parametrize("value", [1e30, -1e308, math.inf, -math.inf])
def test_absurd_setpoints_neither_break_the_numbers_nor_the_limits(value: float) -> None:
    flight = Flight(seed=9)
    hover = flight.climb()
    wild = np.array([value, -value, math.nan])
    for absurd in (
        Setpoint(wild, np.zeros(3), yaw=value),
        Setpoint(velocity_n=wild, yaw_rate=value),
        Setpoint(acceleration_n=wild),
    ):
        flight.fly(0.5, absurd)
        truth = flight.stack.truth
        assert np.isfinite(truth.position_n).all()
        assert float(np.linalg.norm(truth.velocity_n)) < 13.0
    flight.fly(6.0, still(hover))
    assert float(np.linalg.norm(flight.stack.truth.velocity_n)) < 3.0


def test_the_same_seed_gives_the_same_flight_bit_for_bit_and_another_seed_another() -> None:
    def end(seed: int) -> bytes:
        flight = Flight(seed=seed, wind=(1.0, 0.0, 0.0), parameters={"SIM_WIND_GUST": 3.0})
        flight.fly(3.0, None, armed=False)
        flight.fly(3.0, Setpoint(velocity_n=np.array([0.5, 0.0, -1.0])))
        return bytes(flight.stack._x.tobytes() + flight.stack.estimator.out.tobytes())

    assert end(3) == end(3)
    assert end(3) != end(4)
