"""When the vehicle thinks it touches the ground, flies or has landed: worked by hand on made-up flights."""

import math

import numpy as np
import pytest

from fakevehicle.guidance import asks_to_sink
from fakevehicle.landing import LandDetector
from fakevehicle.vocabulary import Glance, Setpoint

LOOK_US = 20_000


class Tale:
    """A detector that flies at 5 m, and what is told to it fifty times a second."""

    def __init__(self) -> None:
        self.detector = LandDetector(hover=0.59, airborne=True)
        self.now_us = 0

    def tell(self, seconds: float, sink: float, thrust: float, sinking: bool = True, drift: float = 0.0) -> bool:
        """Whether it was touching at any time."""
        touched = False
        for _ in range(round(seconds * 1e6 / LOOK_US)):
            self.now_us += LOOK_US
            self.detector.step(self.now_us, self.glance(sink, drift, thrust), True, sinking)
            touched = touched or self.detector.touching
        return touched

    def glance(self, sink: float, drift: float, thrust: float) -> Glance:
        return Glance(self.now_us, 0.0, 0.0, -5.0, drift, 0.0, sink, 0.0, thrust, True, True, True, True, 0)


@pytest.mark.parametrize(
    "flight",
    [
        {"sink": 0.0, "thrust": 0.59, "sinking": False},  # hovering
        {"sink": 0.7, "thrust": 0.57},  # sinking as asked
        {"sink": 0.0, "thrust": 0.57},  # held up by a gust: the thrust is a hover's
        {"sink": 0.0, "thrust": 0.4, "drift": 3.0},  # held up while it slows down
        {"sink": 0.3, "thrust": 0.05},  # beginning to fall
        {"sink": 0.0, "thrust": 0.4, "sinking": False},  # carried by rising air, holding its height
    ],
)
def test_nothing_that_happens_in_the_air_looks_like_the_ground(flight: dict[str, float]) -> None:
    tale = Tale()
    assert not tale.tell(5.0, **flight)  # type: ignore[arg-type]
    assert tale.detector.airborne


def test_the_ground_is_felt_after_two_fifths_of_a_second_and_called_a_landing_a_second_after_the_thrust_has_gone() -> (
    None
):
    tale = Tale()
    assert not tale.tell(0.40, sink=0.02, thrust=0.4)
    assert tale.tell(0.04, sink=0.02, thrust=0.4)
    assert tale.detector.airborne
    tale.tell(0.1, sink=0.28, thrust=0.02)  # it falls back on its feet when the motors let go
    assert tale.detector.touching
    tale.tell(0.88, sink=0.0, thrust=0.02)
    assert tale.detector.airborne
    tale.tell(0.06, sink=0.0, thrust=0.02)
    assert not tale.detector.airborne
    tale.tell(0.02, sink=0.0, thrust=0.02)
    assert not tale.detector.touching


def test_a_false_touch_ends_with_the_first_sinking() -> None:
    tale = Tale()
    assert tale.tell(0.5, sink=0.0, thrust=0.4)
    assert tale.tell(0.02, sink=0.59, thrust=0.02)
    tale.tell(0.02, sink=0.61, thrust=0.02)
    assert not tale.detector.touching
    assert not tale.tell(0.38, sink=0.0, thrust=0.4)  # and it has to be felt anew


def test_a_setpoint_leads_down_by_its_height_or_else_by_its_speed() -> None:
    nothing, still = np.full(3, math.nan), np.zeros(3)
    assert asks_to_sink(Setpoint(position_n=np.array([0.0, 0.0, -4.0])), -5.0)
    assert not asks_to_sink(Setpoint(position_n=np.array([0.0, 0.0, -4.9])), -5.0)
    assert not asks_to_sink(Setpoint(position_n=np.array([0.0, 0.0, -6.0]), velocity_n=np.array([0, 0, 0.7])), -5.0)
    assert asks_to_sink(Setpoint(position_n=nothing, velocity_n=np.array([0.0, 0.0, 0.3])), -5.0)
    assert not asks_to_sink(Setpoint(velocity_n=still), -5.0)
    assert not asks_to_sink(Setpoint(acceleration_n=np.array([0.0, 0.0, 1.0])), -5.0)


def test_a_false_velocity_does_not_keep_a_blind_vehicle_from_landing() -> None:
    """GIVEN feet on the ground and no velocity WHEN the guess of it is 2 m/s THEN it knows that it has landed."""
    for known, landed in ((True, False), (False, True)):
        detector = LandDetector(hover=0.59, airborne=True)
        for i in range(150):
            seen = Glance(i * LOOK_US, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.05, True, known, known, True, 0)
            detector.step(i * LOOK_US, seen, True, True)
        assert detector.airborne is not landed
