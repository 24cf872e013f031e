"""Whatever message it takes, with whatever numbers in it: the ArduPilot flavour answers and goes on."""

from typing import Any

import numpy as np
import pytest
from flight_double import PointMass
from vehicle_pilot import Pilot

import fakevehicle.vehicle
from fakevehicle.config import VehicleConfig
from fakevehicle.flavours.ardupilot_modes import BY_NUMBER
from fakevehicle.vehicle import Vehicle
from wire.dialect import mavlink

NUMBERS = (0.0, 1.0, -1.0, 4.0, 5.0, 9.0, 148.0, 245.0, 435.0, np.nan, np.inf, -np.inf, 1e30, 3e38)
COMMANDS = (16, 20, 21, 22, 92, 115, 176, 178, 179, 192, 207, 224, 300, 400, 401, 410, 420, 510, 511, 512, 520, 31999)
NAMES = (
    b"RTL_ALT",
    b"FENCE_ENABLE",
    b"SIM_GPS1_ENABLE",
    b"GUID_TIMEOUT",
    b"LAND_SPEED",
    b"SYSID_THISMAV",
    b"NONE",
    b"",
)
BITS = {"uint8_t": 8, "int8_t": 7, "char": 7, "uint16_t": 16, "int16_t": 15, "uint32_t": 32, "int32_t": 31}


def filled(rng: np.random.Generator, number: int) -> Any:
    """A message of one kind with numbers that are extreme as often as not; addressed to the vehicle."""
    kind = mavlink.mavlink_map[number]

    def one(name: str, type_: str) -> Any:
        if name in ("target_system", "target_component"):
            return 1
        if name == "command":
            return int(rng.choice(COMMANDS))
        if type_ in ("float", "double"):
            return float(rng.choice(NUMBERS)) if rng.random() < 0.7 else float(rng.normal(0.0, 10.0))
        return int(rng.integers(0, 12)) if rng.random() < 0.7 else int(rng.integers(0, 2 ** BITS.get(type_, 63)))

    values = []
    for name, type_ in zip(kind.fieldnames, kind.fieldtypes, strict=True):
        length = kind.array_lengths[kind.ordered_fieldnames.index(name)]
        if type_ == "char" and length:
            values.append(NAMES[int(rng.integers(0, len(NAMES)))])
        else:
            values.append([one(name, type_) for _ in range(length)] if length else one(name, type_))
    return kind(*values)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_any_message_with_any_numbers_is_survived_on_the_ground_and_in_the_air(
    monkeypatch: pytest.MonkeyPatch, seed: int
) -> None:
    monkeypatch.setattr(fakevehicle.vehicle, "FlightStack", PointMass)
    vehicle = Vehicle(VehicleConfig(autopilot="ardupilot"))
    pilot = Pilot(vehicle)
    pilot.run(3.5)
    rng = np.random.default_rng(seed)
    kinds = sorted(vehicle._handlers)
    flown = 0
    for step in range(2000):
        if step % 100 == 0:  # up again
            for command, value in ((176, 4.0), (400, 0.0), (22, 0.0)):
                pilot.send(mavlink.MAVLink_command_long_message(1, 1, command, 0, 1, value, 0, 0, 0, 0, 5))
        pilot.send(filled(rng, int(rng.choice(kinds))))
        pilot.tick()
        flown += vehicle.flying.airborne
        assert pilot.last("HEARTBEAT").custom_mode in BY_NUMBER
        assert np.all(np.isfinite(vehicle.truth.position_n))
    assert flown > 100
