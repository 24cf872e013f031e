"""Any mission that is accepted is flown without a jump of what is asked for, and its items are reached in order."""

import itertools
import math
from typing import Any

import numpy as np
import pytest
from flight_double import PointMass
from vehicle_pilot import ACCEPTED, NAN, Pilot

import fakevehicle.vehicle
from fakevehicle.config import LinkConfig, VehicleConfig
from fakevehicle.plans import COMMANDS, Kind
from fakevehicle.vehicle import TICK_US, Vehicle
from wire.dialect import mavlink

m = mavlink
MISSION = (4, 4)
LATITUDE, LONGITUDE = 473977420, 85455940
"""Where the vehicle stands [1e-7 deg]."""
ENDS = (m.MAV_CMD_NAV_RETURN_TO_LAUNCH, m.MAV_CMD_NAV_LAND, m.MAV_CMD_NAV_LOITER_UNLIM)
FAVOURED = (m.MAV_CMD_NAV_WAYPOINT,) * 40 + (m.MAV_CMD_NAV_LOITER_TURNS, m.MAV_CMD_DO_SET_ROI_LOCATION) * 4
ACCELERATION = 3.0
"""MPC_ACC_HOR [m/s^2]."""


def drawn(rng: np.random.Generator, seq: int, count: int) -> Any:
    """An item of any kind that does not end the mission, on a grid coarse enough for places to coincide."""
    kinds = [*(number for number in COMMANDS[Kind.MISSION] if number not in ENDS), *FAVOURED]
    command = int(rng.choice(kinds))
    params = {
        m.MAV_CMD_NAV_WAYPOINT: (rng.choice([0, 0, 0, 1]), rng.choice([0, 0, 0.2, 2, 5]), 0),
        m.MAV_CMD_NAV_LOITER_TURNS: (rng.choice([0, 0.5, 2]), 0, rng.choice([0, -3, 1, 4])),
        m.MAV_CMD_DO_CHANGE_SPEED: (1, rng.choice([1, 3, 8]), 0),
        m.MAV_CMD_DO_JUMP: (rng.integers(count), rng.choice([1, 2]), 0),
        m.MAV_CMD_NAV_DELAY: (1, 0, 0),
        m.MAV_CMD_CONDITION_YAW: (90, 0, 1),
        m.MAV_CMD_DO_SET_ROI: (rng.choice([0, 3]), 0, 0),
    }.get(command, (0, 0, 0))
    north, east = rng.choice([0.0, 0.0, 5.0, 10.0, -7.3], 2)
    x, y = LATITUDE + round(north * 90.0), LONGITUDE + round(east * 132.0)
    yaw, up = rng.choice([NAN, 1.0]), rng.choice([3.0, 5.0, 5.0, 8.0])
    return m.MAVLink_mission_item_int_message(1, 1, seq, 6, command, 0, 1, *map(float, params), yaw, x, y, up, 0)


@pytest.mark.parametrize("seed", range(12))
def test_whatever_a_mission_asks_for_velocity_never_jumps(monkeypatch: pytest.MonkeyPatch, seed: int) -> None:
    monkeypatch.setattr(fakevehicle.vehicle, "FlightStack", PointMass)
    rng = np.random.default_rng(seed)
    pilot = Pilot(Vehicle(VehicleConfig(links=(LinkConfig("onboard", "gcs"),))))
    stack: Any = pilot.vehicle._stack
    pilot.run(1.0)
    count = int(rng.integers(4, 11))
    takeoff = m.MAVLink_mission_item_int_message(1, 1, 0, 6, m.MAV_CMD_NAV_TAKEOFF, 0, 1, 0, 0, 0, NAN, 0, 0, 5.0, 0)
    items = [takeoff, *(drawn(rng, seq, count) for seq in range(1, count))]
    pilot.send(m.MAVLink_mission_count_message(1, 1, count, 0))
    for item in items:
        pilot.tick()
        pilot.send(item)
    pilot.tick()
    assert pilot.last("MISSION_ACK").type == m.MAV_MISSION_ACCEPTED, pilot.texts()
    assert pilot.command(m.MAV_CMD_MISSION_START, 0, 0) == ACCEPTED
    dt, before = TICK_US * 1e-6, None
    while pilot.mode == MISSION or pilot.now_us < 3e6:
        pilot.tick()
        asked = stack.setpoint
        if not pilot.vehicle.flying.airborne or pilot.mode != MISSION:
            continue
        assert np.isfinite([*asked.position_n, *asked.velocity_n, *asked.acceleration_n, asked.yaw]).all()
        if before is not None:
            assert math.dist(asked.velocity_n, before.velocity_n) <= ACCELERATION * dt + 1e-6
            mean_n = 0.5 * (asked.velocity_n + before.velocity_n)
            assert math.dist(asked.position_n, before.position_n + dt * mean_n) < 1e-4
        before = asked
        assert pilot.now_us < 300e6
    order = [told.seq for told in pilot.of("MISSION_ITEM_REACHED")]
    flown = [seq for i, seq in enumerate(order) if i == 0 or seq != order[i - 1]]
    jumps = {item.seq: int(item.param1) for item in items if item.command == m.MAV_CMD_DO_JUMP}
    for seq, after in itertools.pairwise(flown):
        assert after in (seq + 1, jumps.get(seq, seq + 1))
    assert flown[-1] == count - 1
