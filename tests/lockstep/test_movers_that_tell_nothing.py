"""GIVEN movers that only the obstacle sensor sees, WHEN they cross the way, THEN they are flown round."""

import numpy as np
import pytest

from companion.cli.vehicle import seen_world
from companion.phases import Phase
from companion.seeing.following import SEEN
from companion.testing.taps import surroundings
from tests.lockstep.test_a_silent_sensor import FLAVOURS
from wire.dialect import mavlink

WALKERS = """\
name: walkers
vehicle: {start: {north: 2, east: 10}}
world:
  bounds: {north: [0, 24], east: [0, 20], altitude: [0, 4]}
  movers:
    - {sphere: {north: 8, east: EAST, altitude: 1.5, radius: 0.45}, velocity: {north: 0, east: -1.2, up: 0}}
    - {sphere: {north: 12, east: 10, altitude: 1.5, radius: 0.45}, velocity: {north: 0, east: -1.4, up: 0}}
    - {sphere: {north: 16, east: 6, altitude: 1.5, radius: 0.45}, velocity: {north: 0, east: -1.0, up: 0}}
sensing: {use: true, resolution: 0.2, clearance: 0.3, mover_radius: 0.45}
limits: {speed: 3, acceleration: 6, jerk: 60}
steps:
  - takeoff: {altitude: 1.5}
  - goto: {north: 22, east: 10, altitude: 1.5}
  - land
"""
TELLS = mavlink.MAVLINK_MSG_ID_ADSB_VEHICLE.to_bytes(3, "little")


class Silent:
    """A vehicle without a receiver of what others tell of themselves."""

    def __init__(self, vehicle):
        self.vehicle, self.TICK_US = vehicle, vehicle.TICK_US

    @property
    def truth(self):
        return self.vehicle.truth

    def step(self, now_us, inputs):
        return [d for d in self.vehicle.step(now_us, inputs) if d.data[7:10] != TELLS]


class Watcher:
    """What is followed, held against where the walkers are; and what was touched."""

    def __init__(self):
        self.around = self.vehicle = self.companion = None
        self.errors = []

    def between(self, vehicle):
        self.vehicle = Silent(vehicle)
        return self.vehicle

    def operator(self, companion, now_us):
        if self.companion is None:
            self.companion, self.around = companion, surroundings(companion, self.vehicle)

    def __call__(self, tick):
        if self.around is None:
            return
        self.around(tick)
        if self.companion.phase is not Phase.FLYING or tick.now_us % 100_000:
            return
        balls = seen_world(self.companion.mission).movers.spheres(tick.now_us)[:, :3]
        balls = balls + np.array(self.companion.mission.start_m())
        for address, track in self.companion.seeing.tracks._tracks.items():
            assert address > SEEN
            age = (self.companion._flight_us - track.seen_us) / 1e6
            where = np.array(track.position_m) + age * np.array(track.velocity)
            self.errors.append(float(np.hypot(*(balls - where)[:, :2].T).min()))


@pytest.mark.parametrize("autopilot", FLAVOURS)
@pytest.mark.parametrize("east", [4.5, 5.5, pytest.param(6.5, marks=pytest.mark.slow)])
def test_walkers_that_tell_nothing_of_themselves_are_followed_and_flown_round(fly, autopilot, east):
    watcher = Watcher()
    flight = fly(
        WALKERS.replace("EAST", f"{east:g}"),
        autopilot=autopilot,
        between=watcher.between,
        operator=watcher.operator,
        taps=[watcher],
    )
    assert flight.companion.phase is Phase.DONE
    assert not flight.companion.failure
    assert not watcher.around.touched
    assert len(watcher.errors) > 20
    assert np.median(watcher.errors) < 0.4
