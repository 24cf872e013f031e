"""A point that follows its setpoint without noise, in place of the flight stack: for tests of what is said on the wire.

It shares no code with the flight stack; what it cannot show (loops, noise, estimation) is tested in tests/lockstep.
"""

from typing import Any

import numpy as np

from fakevehicle.battery import Battery, Pack
from fakevehicle.faults import Fault, Sensor
from fakevehicle.vocabulary import (
    BaroSample,
    ControlStatus,
    Estimate,
    Geodetic,
    Glance,
    GpsSample,
    ImuSample,
    MagSample,
    Setpoint,
    Truth,
)

READY_US = 400_000
"""The double knows where it is from here on."""
HOVER = 0.59


class PointMass:
    """Follows position (first order, 0.3 s) and velocity; stands on the ground at down = 0."""

    def __init__(self, *, home: Geodetic, heading: float, **_others: Any) -> None:
        self.home = home
        self.now_us = 0
        self.p = np.zeros(3)
        self.v = np.zeros(3)
        self.q = np.array([np.cos(heading / 2), 0.0, 0.0, np.sin(heading / 2)])
        self.thrust = 0.0
        self.setpoint = Setpoint()
        self.position_known = True
        self.resets = 0
        self.battery = Battery(Pack(cells=4, capacity=5.0, resistance=0.02, idle_power=8.0, full_power=400.0))
        self.faults: list[Fault] = []
        self.range = self.clearance = None
        self.obstacles = None
        self.wind = None

    def inject(self, fault: Fault) -> None:
        self.faults.append(fault)

    def mend(self, sensor: Sensor, now_us: int, index: int | None = None) -> None:
        self.faults = [f for f in self.faults if f.sensor is not sensor or index not in (None, f.index)]

    def reset_control(self) -> None:
        self.resets += 1

    def tick(self, now_us: int, setpoint: Setpoint | None, armed: bool) -> None:
        self.now_us = now_us
        self.setpoint = setpoint or Setpoint()
        dt = 0.004
        if setpoint is None or not armed:
            wanted = np.array([0.0, 0.0, 5.0])
            self.thrust = 0.05 if armed else 0.0
        else:
            wanted = np.where(np.isnan(setpoint.velocity_n), 0.0, setpoint.velocity_n)
            wanted = np.where(
                np.isnan(setpoint.position_n), wanted, wanted + np.clip((setpoint.position_n - self.p) / 0.3, -5, 5)
            )
            self.thrust = HOVER
        if now_us % 20_000 == 0:
            self.battery.draw(max(self.thrust, 0.0) ** 1.5 if armed else 0.0, 0.02)
        self.v += np.clip((wanted - self.v) / 0.1, -9.8, 9.8) * dt
        self.p += self.v * dt
        if self.p[2] >= 0.0:  # on the ground; a loop that still wants down lets go of the thrust
            self.p[2] = 0.0
            if wanted[2] > 0.0:
                self.thrust = 0.05
            self.v[:] = 0.0

    @property
    def estimate(self) -> Estimate:
        known = self.now_us >= READY_US
        return Estimate(
            now_us=self.now_us,
            position_n=self.p.copy(),
            velocity_n=self.v.copy(),
            acceleration_n=np.zeros(3),
            q_nb=self.q,
            omega_b=np.zeros(3),
            gyro_bias=np.zeros(3),
            accel_bias=np.zeros(3),
            covariance=np.eye(15) * 0.01,
            test_ratio={"gps_position": 0.1, "gps_velocity": 0.1, "baro": 0.1, "mag": 0.1},
            attitude_valid=known,
            velocity_valid=known,
            position_valid=known and self.position_known,
            altitude_valid=known,
            origin=self.home if known else None,
        )

    @property
    def origin(self) -> Geodetic | None:
        return self.home if self.now_us >= READY_US else None

    @property
    def glance(self) -> Glance:
        known = self.now_us >= READY_US
        w, x, y, z = self.q.tolist()
        return Glance(
            self.now_us,
            *self.p.tolist(),
            *self.v.tolist(),
            2.0 * float(np.arctan2(z, w)),
            self.thrust,
            known,
            known,
            known and self.position_known,
            known,
            0,
            (w, x, y, z),
        )

    @property
    def truth(self) -> Truth:
        return Truth(
            now_us=self.now_us,
            position_n=self.p.copy(),
            velocity_n=self.v.copy(),
            acceleration_n=np.zeros(3),
            q_nb=self.q,
            omega_b=np.zeros(3),
            rotor_speed=np.zeros(4),
            wind_n=np.zeros(3),
            on_ground=self.p[2] >= 0.0,
        )

    @property
    def imu(self) -> ImuSample:
        return ImuSample(self.now_us, np.zeros(3), np.array([0.0, 0.0, -9.81]))

    @property
    def gps(self) -> GpsSample | None:
        if self.now_us < READY_US:
            return None
        return GpsSample(self.now_us, self.now_us, self.home, self.v.copy(), 0.5, 0.8, 0.3, 3, 12)

    @property
    def baro(self) -> BaroSample:
        return BaroSample(self.now_us, 488.0, 95600.0, 15.0)

    @property
    def mag(self) -> MagSample:
        return MagSample(self.now_us, np.array([0.21, 0.0, 0.43]))

    @property
    def control(self) -> ControlStatus:
        return ControlStatus(self.setpoint, self.q, np.zeros(3), self.thrust, np.full(4, self.thrust), False)
