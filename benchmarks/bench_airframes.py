"""The shipped airframes side by side: `python -m benchmarks.bench_airframes [seeds]`.

Default sensors (GPS 0.35 m, 110 ms late), estimator in the loop, truth held against the setpoint as in
`bench_tracking`. A step of 5 m from a hover, its time until the place is within 0.3 m in space for good; the figure of
eight of 4 x 2 m, horizontal RMS; the RMS of roll and pitch rates in a hover. Wind of 8 m/s comes with Dryden gusts.
Every airframe flies with its own file's parameters and with the defaults.
"""

import math
import sys
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass

import numpy as np

from benchmarks.bench_tracking import FIRST_UNSEEN, WIND
from campaigns.tuning import courses
from campaigns.tuning.courses import HEIGHT, HOME, YAW, Eight, Wind, climb
from fakevehicle.airframe import load_airframe
from fakevehicle.flight import PARAMETERS, FlightStack
from fakevehicle.geodesy import to_local
from fakevehicle.params import ParameterSet
from fakevehicle.vocabulary import Setpoint

DT = FlightStack.TICK_US * 1e-6


@dataclass(frozen=True)
class Job:
    """One flight: which airframe with whose parameters, in how much wind, doing what (a step, an eight, a hover)."""

    airframe: str
    own: bool
    what: str
    speed: float
    wind: float
    seed: int


def fly(job: Job) -> float:
    """The figure of one flight: [s] of a step, [m] of an eight, [deg/s] of a hover."""
    frame = load_airframe(job.airframe)
    parameters = ParameterSet(PARAMETERS, {**(frame.parameters if job.own else {}), "SIM_WIND_GUST": job.wind})
    if job.what == "eight":
        flown = courses.fly(Eight(job.speed), Wind(job.wind, job.wind), job.seed, parameters, job.airframe)
        return math.sqrt((flown.error_n[:, :2] ** 2).sum(axis=1).mean())
    wind_n = np.array([job.wind, 0.0, 0.0])
    stack = FlightStack(airframe=frame, parameters=parameters, home=HOME, heading=YAW, wind_n=wind_n, seed=job.seed)
    now_us = 0

    def tick(setpoint: Setpoint | None) -> None:
        nonlocal now_us
        now_us += FlightStack.TICK_US
        stack.tick(now_us, setpoint, setpoint is not None)

    for _ in range(round(8.0 / DT)):
        tick(None)
    estimate = stack.estimate
    assert estimate.origin is not None
    ground, moved = estimate.position_n.copy(), to_local(HOME, estimate.origin)
    moved[2] = ground[2] - stack.truth.position_n[2]
    for place, velocity, acceleration in climb():
        tick(Setpoint(ground + place, velocity, acceleration, YAW))
    hover, still, found = ground + np.array([0.0, 0.0, -HEIGHT]), np.zeros(3), []
    if job.what == "hover":
        for _ in range(round(20.0 / DT)):
            tick(Setpoint(hover, still, still, YAW))
            found.append(float((stack.truth.omega_b[:2] ** 2).mean()))
        return math.degrees(math.sqrt(np.mean(found)))
    for _ in range(round(4.0 / DT)):
        tick(Setpoint(hover, still, still, YAW))
    goal = hover + np.array([3.0, 4.0, 0.0])
    for _ in range(round(6.0 / DT)):
        tick(Setpoint(goal, still, still, YAW))
        found.append(math.dist(stack.truth.position_n + moved, goal))
    return DT * float(np.flatnonzero(np.array(found) > 0.3)[-1] + 1)


COLUMNS = (("step", 0.0, 0.0), ("eight", 3.0, 0.0), ("eight", 5.0, 0.0), ("eight", 3.0, WIND), ("hover", 0.0, WIND))


def main() -> None:
    seeds = int(sys.argv[1]) if len(sys.argv) > 1 else 8
    print(f"Mean of {seeds} unseen seeds\n")
    print("| airframe | parameters | 5 m step s | eight, 3 m/s | 5 m/s | 3 m/s in wind | hover in wind deg/s |")
    print("|---|---|---|---|---|---|---|")
    with ProcessPoolExecutor(2) as pool:
        for name in ("x500", "iris", "crazyflie"):
            for own in (True, False) if load_airframe(name).parameters else (True,):
                means = []
                for what, speed, wind in COLUMNS:
                    jobs = [Job(name, own, what, speed, wind, FIRST_UNSEEN + k) for k in range(seeds)]
                    means.append(float(np.mean(list(pool.map(fly, jobs)))))
                row = " | ".join(f"{mean:.{digits}f}" for mean, digits in zip(means, (2, 3, 3, 3, 0), strict=True))
                print(f"| {name} | {'its own' if own else 'defaults'} | {row} |", flush=True)


if __name__ == "__main__":
    main()
