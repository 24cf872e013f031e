"""Whole flights of the real vehicle in memory: it flies on its own estimate, and truth is the judge."""

import numpy as np
import pytest
from vehicle_pilot import ACCEPTED, HOLD, NAN, OFFBOARD, Pilot, position

from fakevehicle.config import LinkConfig, VehicleConfig
from fakevehicle.vehicle import Vehicle

ONBOARD = (LinkConfig("onboard"),)


@pytest.fixture
def pilot() -> Pilot:
    """On the onboard link of a vehicle that is ready to be armed."""
    pilot = Pilot(Vehicle(VehicleConfig(links=ONBOARD, seed=3)))
    pilot.until(lambda: pilot.vehicle.flying.why_not_armable(pilot.now_us) is None, 20)
    pilot.run(2.0)
    return pilot


def test_take_off_by_command_fly_offboard_and_land(pilot: Pilot) -> None:
    """GIVEN a standing vehicle WHEN it takes off, flies corners in OFFBOARD and lands THEN truth agrees."""
    offset_n = pilot.vehicle.truth.position_n - np.array(
        [getattr(pilot.last("LOCAL_POSITION_NED"), axis) for axis in "xyz"]
    )
    assert pilot.command(400, 1) == ACCEPTED
    assert pilot.command(22, NAN, NAN, NAN, NAN, NAN, NAN, NAN) == ACCEPTED
    pilot.until(lambda: pilot.mode == HOLD, 8)
    assert pilot.vehicle.truth.position_n[2] == pytest.approx(-2.5, abs=0.6)
    pilot.send(position(0, 0, -2))
    assert pilot.command(176, 1, 6) == ACCEPTED
    for corner in ((0.0, 0.0, -2.0), (0.0, 5.0, -2.0), (5.0, 5.0, -4.0)):
        pilot.fly(7.0, position(*corner))
        assert pilot.mode == OFFBOARD
        here = pilot.last("LOCAL_POSITION_NED")
        np.testing.assert_allclose((here.x, here.y, here.z), corner, atol=0.4)
        # Truth wanders from the estimate by the GPS's noise; a metre is its scale, not our accuracy.
        np.testing.assert_allclose(pilot.vehicle.truth.position_n - offset_n, corner, atol=1.3)
    assert pilot.command(21, 0, 0, 0, NAN, NAN, NAN, NAN) == ACCEPTED
    pilot.until(lambda: not pilot.armed, 20)
    assert pilot.vehicle.truth.on_ground
    assert abs(pilot.vehicle.truth.position_n[2]) < 0.05
    assert pilot.texts()[-2:] == ["Landing detected", "Disarmed by landing"]


def test_offboard_from_the_ground_and_back_lands_and_disarms(pilot: Pilot) -> None:
    pilot.send(position(0, 0, 0))
    assert (pilot.command(176, 1, 6), pilot.command(400, 1)) == (0, 0)
    pilot.fly(1.0, position(0, 0, 0))
    assert pilot.vehicle.truth.on_ground
    pilot.fly(4.0, position(0, 0, -1.5))
    assert pilot.vehicle.truth.position_n[2] < -1.0
    pilot.fly(8.0, position(0, 0, 1.0))  # a metre under the ground: the way to land by setpoints
    assert not pilot.armed
    assert pilot.vehicle.truth.on_ground


@pytest.mark.parametrize(("seed", "wind"), [(4, (8.0, 4.0, 0.0)), (9, (7.0, 7.0, 0.0))])
def test_a_landing_in_strong_wind_lets_go_on_the_ground_before_it_leans(
    seed: int, wind: tuple[float, float, float]
) -> None:
    """GIVEN 9 m/s of wind WHEN it lands THEN it idles at the touch of the ground and soon knows that it has landed."""
    pilot = Pilot(Vehicle(VehicleConfig(links=ONBOARD, seed=seed, wind_n=np.array(wind))))
    pilot.until(lambda: pilot.vehicle.flying.why_not_armable(pilot.now_us) is None, 20)
    assert pilot.command(400, 1) == ACCEPTED
    assert pilot.command(22, NAN, NAN, NAN, NAN, NAN, NAN, NAN) == ACCEPTED
    pilot.until(lambda: pilot.mode == HOLD, 8)
    pilot.run(3.0)
    assert pilot.command(21) == ACCEPTED
    pilot.until(lambda: pilot.vehicle.truth.on_ground, 10)
    touched_n = pilot.vehicle.truth.position_n
    assert pilot.until(lambda: not pilot.vehicle.flying.airborne, 3) > 1.0
    _, x, y, _ = pilot.vehicle.truth.q_nb
    assert 2 * np.hypot(x, y) < np.radians(1.0)
    np.testing.assert_allclose(pilot.vehicle.truth.position_n, touched_n, atol=0.2)


def test_a_lost_stream_in_wind_is_held_where_it_was_lost() -> None:
    pilot = Pilot(Vehicle(VehicleConfig(links=ONBOARD, seed=4, wind_n=np.array([4.0, -2.0, 0.0]))))
    pilot.until(lambda: pilot.vehicle.flying.why_not_armable(pilot.now_us) is None, 20)
    pilot.send(position(0, 0, 0))
    assert (pilot.command(176, 1, 6), pilot.command(400, 1)) == (0, 0)
    pilot.fly(6.0, position(0, 0, -3))
    pilot.until(lambda: pilot.mode == HOLD, 2)
    begin_n = pilot.vehicle.truth.position_n
    pilot.run(5.0)
    np.testing.assert_allclose(pilot.vehicle.truth.position_n, begin_n, atol=1.0)
    pilot.fly(0.5, position(0, 0, -3))
    assert pilot.mode == OFFBOARD


def test_one_seed_flies_the_same_flight_to_the_last_bit() -> None:
    def flight(seed: int) -> list[bytes]:
        vehicle = Vehicle(VehicleConfig(links=ONBOARD, seed=seed))
        return [d.data for tick in range(600) for d in vehicle.step(tick * 4000, [])]

    assert flight(1) == flight(1)
    assert flight(1) != flight(2)
