"""A vehicle that falls over: motors off at takeoff, a warning or motors off in flight, and no arming on its back."""

import math
from typing import Any

import pytest

from fakevehicle.config import LinkConfig, VehicleConfig
from fakevehicle.faults import Fault, FaultKind, Sensor
from fakevehicle.flip import PARAMETERS, FlipDetector
from fakevehicle.params import ParameterSet
from fakevehicle.vehicle import Vehicle
from fakevehicle.vocabulary import Glance
from tests.vehicle_pilot import NAN, Pilot
from wire.dialect import mavlink as m

ACCEPTED = m.MAV_RESULT_ACCEPTED
BACK = m.MAVLink_set_attitude_target_message(0, 1, 1, 0b111, [0.0, 1.0, 0.0, 0.0], 0.0, 0.0, 0.0, 0.5)


def ready(**parameters: float) -> Pilot:
    pilot = Pilot(Vehicle(VehicleConfig(links=(LinkConfig("onboard", "gcs"),), seed=3), parameters))
    pilot.until(lambda: pilot.vehicle.flying.why_not_armable(pilot.now_us) is None, 20)
    return pilot


def risen(height: float = 12.0, **parameters: float) -> Pilot:
    pilot = ready(MIS_TAKEOFF_ALT=height, **parameters)
    assert pilot.command(400, 1) == ACCEPTED
    assert pilot.command(22, *[NAN] * 7) == ACCEPTED
    pilot.run(8.0)
    return pilot


def lean(pilot: Pilot) -> float:
    """Truth's tilt [deg]."""
    _, x, y, _ = pilot.vehicle.truth.q_nb.tolist()
    return math.degrees(2.0 * math.asin(min(math.hypot(x, y), 1.0)))


def fail_motor(pilot: Pilot, after_s: float) -> None:
    pilot.vehicle._stack.inject(Fault(Sensor.MOTOR, FaultKind.OFF, pilot.now_us + round(1e6 * after_s)))


def test_it_does_not_arm_on_its_back_and_lies_on_the_ground_not_in_it() -> None:
    pilot = risen(4.0)
    pilot.send(BACK)
    assert pilot.command(176, 1, 6) == ACCEPTED
    # WHEN it is turned on its back and pushed to the ground
    for _ in range(400):
        pilot.fly(0.05, BACK)
        if not pilot.armed:
            break
    assert not pilot.armed
    pilot.run(3.0)
    # THEN it lies there: the ground is 0.22 m below home's level, the rotors' hubs 0.06 m from its middle
    assert lean(pilot) > 175.0
    assert pilot.vehicle.truth.position_n[2] == pytest.approx(0.22 - 0.06, abs=0.01)
    # WHEN it is asked to arm THEN it says why not, and so does the bit for that
    assert pilot.command(176, 1, 4, 3) == ACCEPTED
    before = len(pilot.texts())
    assert pilot.command(400, 1) == m.MAV_RESULT_TEMPORARILY_REJECTED
    assert any("leaning too far" in text for text in pilot.texts()[before:])
    pilot.run(2.0)
    assert not pilot.last("SYS_STATUS").onboard_control_sensors_health & m.MAV_SYS_STATUS_PREARM_CHECK


def test_a_motor_that_fails_at_takeoff_ends_it() -> None:
    pilot = ready()
    fail_motor(pilot, 2.0)
    assert pilot.command(400, 1) == ACCEPTED
    assert pilot.command(22, *[NAN] * 7) == ACCEPTED
    pilot.until(lambda: not pilot.armed, 6)
    assert any("attitude failure at takeoff, motors off" in text for text in pilot.texts())


@pytest.mark.parametrize("breaker", [0, 121212])
def test_later_in_flight_it_is_a_warning_unless_the_circuit_breaker_is_off(breaker: int) -> None:
    pilot = risen(CBRK_FLIGHTTERM=breaker)
    fail_motor(pilot, 0.0)
    pilot.run(1.5)
    assert pilot.armed == (breaker != 0)
    wanted = "Attitude failure" if breaker else "Failsafe activated: attitude failure, motors off"
    assert wanted in pilot.texts()


def seen(roll_deg: float, **changed: Any) -> Glance:
    half = math.radians(roll_deg) / 2.0
    fine = Glance(0, *[0.0] * 8, True, True, True, True, 0, (math.cos(half), math.sin(half), 0.0, 0.0))
    return fine._replace(**changed)


def test_it_has_fallen_when_roll_is_beyond_the_limit_for_long_enough_and_no_longer() -> None:
    parameters = ParameterSet(PARAMETERS)
    flip = FlipDetector(parameters)
    flip.step(0, seen(61.0))
    flip.step(280_000, seen(61.0))
    assert not flip.fallen
    flip.step(320_000, seen(-61.0))
    assert flip.fallen
    flip.step(340_000, seen(59.0))
    assert not flip.fallen
    for k, (angle, changed) in enumerate(((180.0, {"attitude_valid": False}), (10.0, {}))):
        flip.step(1_000_000 * k + 1_000_000, seen(angle, **changed))
        flip.step(1_000_000 * k + 1_900_000, seen(angle, **changed))
        assert not flip.fallen
    parameters.set("FD_FAIL_R", 0)
    flip.step(4_000_000, seen(180.0))
    flip.step(5_000_000, seen(180.0))
    assert not flip.fallen
