"""How sure the estimator is against how right it is: `python -m benchmarks.bench_estimator [flights]`.

Each flight is 40 s: a start at rest, a climb, a figure of eight of 4 x 2 m in wind, with the barometer's drift and
GPS's latency; the judge is the simulator's truth. ANEES is the mean over flights of the normalised squared error of all
fifteen states (15 when the filter is right about itself); NIS is of every measurement, per degree of freedom. "told" is
the position error that the filter's own covariance, 0.11 s older, tells of: where it is about what was found, no better
filter is to be had of these sensors.
"""

import math
import sys
from collections import deque
from dataclasses import dataclass, field

import numpy as np
from rich.console import Console
from rich.table import Table
from scipy.spatial.transform import Rotation
from scipy.stats import chi2

from fakevehicle.airframe import load_airframe
from fakevehicle.faults import parse_fault
from fakevehicle.flight import PARAMETERS, FlightStack
from fakevehicle.geodesy import to_local
from fakevehicle.params import ParameterSet
from fakevehicle.vocabulary import FloatArray, Geodetic, Setpoint

HOME = Geodetic(math.radians(47.397742), math.radians(8.545594), 488.0)
HOVER = np.array([0.0, 0.0, -5.0])


def noises(gyro: float, accel: float, place: float, speed: float, baro: float, mag: float) -> dict[str, float]:
    """Parameters of sensors that are as bad as this, and of an estimator that knows it."""
    known = {"GYR": gyro, "ACC": accel, "GPS_P": place, "GPS_V": speed, "BARO": baro, "MAG": mag}
    return {f"{whose}_{name}_NOISE": value for whose in ("SIM", "EKF2") for name, value in known.items()}


SETS: dict[str, dict[str, float]] = {
    "as shipped": {},
    "as PX4 takes them": noises(0.015, 0.35, 0.5, 0.5, 0.2, 0.05),
    "the same, IMU noise of 1 kHz samples": noises(0.0075, 0.175, 0.5, 0.5, 0.2, 0.05),
}


def lemniscate(t: float) -> Setpoint:
    """Up at 7 s, then a figure of eight of 4 x 2 m, its fastest 2.8 m/s."""
    rise = min(max(t - 8.0, 0.0) / 4.0, 1.0)
    phase = 0.5 * max(t - 14.0, 0.0)
    place = np.array([4.0 * math.sin(phase), 2.0 * math.sin(2.0 * phase), -3.0 * rise * rise * (3 - 2 * rise)])
    return Setpoint(position_n=place, yaw=0.5)


@dataclass
class Run:
    """One vehicle with its estimator, ticked by hand."""

    seed: int = 1
    wind: tuple[float, float, float] = (2.0, 1.0, 0.0)
    parameters: dict[str, float] = field(default_factory=dict)
    faults: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        self.stack = FlightStack(
            airframe=load_airframe("x500"),
            parameters=ParameterSet(PARAMETERS, self.parameters),
            home=HOME,
            heading=0.5,
            wind_n=np.array(self.wind),
            seed=self.seed,
            faults=[parse_fault(text) for text in self.faults],
        )
        self.now_us = 0
        self.told = self.stack.estimator.resets
        self.jumped: FloatArray = np.zeros(6)  # all jumps of position and velocity told so far
        self.past: deque[tuple[FloatArray, FloatArray]] = deque(maxlen=40)  # truth and biases, newest last

    @property
    def t(self) -> float:
        return self.now_us * 1e-6

    def tick(self, setpoint: Setpoint | None) -> None:
        self.now_us += 4000
        self.stack.tick(self.now_us, setpoint, setpoint is not None)
        resets = self.stack.estimator.resets
        if resets is not self.told:
            self.told = resets
            self.jumped += np.concatenate([resets.delta_position_n, resets.delta_velocity_n])
        imu = self.stack._imu[0]
        self.past.append((self.stack._x.copy(), np.concatenate([imu["gyro_bias"], imu["accel_bias"]])))

    def hover(self, seconds: float) -> None:
        for _ in range(round(seconds / 0.004)):
            self.tick(Setpoint(position_n=HOVER, velocity_n=np.zeros(3), acceleration_n=np.zeros(3), yaw=0.5))

    def take_off(self) -> None:
        """Stand for 7 s, then climb to 5 m and wait there until second 20."""
        while self.t < 7.0:
            self.tick(None)
        while self.t < 20.0:
            s = min((self.t - 7.0) / 5.0, 1.0)
            self.tick(Setpoint(position_n=HOVER * s * s * (3 - 2 * s), yaw=0.5))

    def error(self) -> FloatArray:
        """(15,) error state of the filter at its horizon."""
        estimator = self.stack.estimator
        assert estimator.filter is not None
        x, biases = self.past[-1 - (self.now_us - estimator.horizon_us) // 4000]
        n = estimator.filter.nominal
        believed, true = (Rotation.from_quat([q[1], q[2], q[3], q[0]]) for q in (n[6:10], x[6:10]))
        return np.concatenate(
            [(believed.inv() * true).as_rotvec(), x[3:6] - n[3:6], self.placed(x) - n[0:3], biases - n[10:16]]
        )

    def placed(self, x: FloatArray) -> FloatArray:
        """Truth's position in the estimator's frame, whose height begins where the vehicle stood."""
        origin = self.stack.estimator.origin
        assert origin is not None
        apart = to_local(HOME, origin)
        return x[0:3] + np.array([apart[0], apart[1], 0.0])

    def off(self) -> FloatArray:
        """(3,) truth less the estimate, both now [m]."""
        return self.placed(self.stack._x) - self.stack.estimator.out[0:3]

    def tilt_off(self) -> float:
        """Angle between the believed and the true vertical [rad]."""
        downs = []
        for q in (self.stack._x[6:10], self.stack.estimator.out[6:10]):
            w, x, y, z = q.tolist()
            downs.append([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)])
        return math.acos(min(1.0, float(np.dot(downs[0], downs[1]))))


@dataclass
class Belief:
    """What a set of flights says about the filter: a row a flight, a column an epoch, four a second from second 16."""

    nees: FloatArray
    nis: dict[str, float]
    position_rms: float
    position_told: float
    tilt_rms_deg: float


def believe(seeds: range, parameters: dict[str, float], seconds: float = 40.0) -> Belief:
    nees, places, tilts, told = [], [], [], []
    nis: dict[str, list[float]] = {"gps_position": [], "gps_velocity": [], "baro": [], "mag": []}
    for seed in seeds:
        run, row, last = Run(seed=seed, parameters=parameters), [], dict[str, object]()
        while run.t < seconds:
            run.tick(lemniscate(run.t) if run.t > 7.0 else None)
            for name, fusion in run.stack.estimator.fusions.items():
                if fusion is not last.get(name):
                    last[name] = fusion
                    nis[name].append(fusion.nis / fusion.dof)
            if run.t > 16.0 and run.now_us % 248_000 == 0:
                error, P = run.error(), run.stack.estimate.covariance
                row.append(float(error @ np.linalg.solve(P, error)))
                places.append(run.off())
                told.append(float(np.trace(P[6:9, 6:9])))
                tilts.append(run.tilt_off())
        nees.append(row)
    return Belief(
        np.array(nees),
        {name: float(np.mean(values)) for name, values in nis.items()},
        math.sqrt(float(np.mean(np.sum(np.square(places), axis=1)))),
        math.sqrt(float(np.mean(told))),
        math.degrees(math.sqrt(float(np.mean(np.square(tilts))))),
    )


def inside(belief: Belief) -> tuple[float, float, float]:
    """The 95 % band of ANEES (chi^2 of 15 N, over N) and the share of epochs within it."""
    n = len(belief.nees)
    low, high = chi2.ppf([0.025, 0.975], 15 * n) / n
    anees = belief.nees.mean(axis=0)
    return float(low), float(high), float(np.mean((anees > low) & (anees < high)))


def main() -> None:
    flights = int(sys.argv[1]) if len(sys.argv) > 1 else 50
    table = Table(title=f"Estimator over {flights} flights of 40 s", title_justify="left")
    for head in ("noises", "ANEES", "in band", "GPS place", "GPS speed", "baro", "mag", "RMS m", "told m", "tilt deg"):
        table.add_column(head, justify="left" if head == "noises" else "right")
    for name, parameters in SETS.items():
        belief = believe(range(500, 500 + flights), parameters)
        low, high, share = inside(belief)
        table.add_row(
            name,
            f"{belief.nees.mean():.2f} ({low:.2f}..{high:.2f})",
            f"{share:.0%}",
            *(f"{belief.nis[sensor]:.3f}" for sensor in ("gps_position", "gps_velocity", "baro", "mag")),
            f"{belief.position_rms:.3f}",
            f"{belief.position_told:.3f}",
            f"{belief.tilt_rms_deg:.3f}",
        )
    Console(width=120).print(table)


if __name__ == "__main__":
    main()
