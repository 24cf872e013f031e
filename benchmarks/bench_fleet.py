"""Vehicles that swap places on a circle: python -m benchmarks.bench_fleet [--seeds 20] [--vehicles 8] [--radius 10]

Whole flights: bundled vehicles with their estimators and wind-free physics, a companion each, in one lockstep. A seed
shifts the places on the circle and everybody's sensors. What is told: seeds in which all arrived, and the least
distance between two centres in the air.
"""

import argparse
import math
import time
from concurrent.futures import ProcessPoolExecutor

import numpy as np
import yaml

from companion.fleet.missions import Part, split
from companion.testing.many import ManyResult, fly_many


def swap(seed: int, vehicles: int, radius: float) -> list[Part]:
    """Missions of vehicles that fly to the place opposite."""
    rng = np.random.default_rng(seed)
    angles = np.arange(vehicles) * 2 * math.pi / vehicles + rng.normal(0, 0.02, vehicles)
    places = np.column_stack([radius * np.cos(angles), radius * np.sin(angles)]).round(3).tolist()
    entries = []
    for k, (north, east) in enumerate(places):
        goal = places[(k + vehicles // 2) % vehicles]
        goto = {"north": goal[0], "east": goal[1], "altitude": 3.0}
        steps = [{"takeoff": {"altitude": 3.0}}, {"goto": goto}, {"hold": {"seconds": 1}}, "land"]
        entries.append({"name": f"v{k + 1}", "start": {"north": north, "east": east}, "steps": steps})
    far = radius + 4.0
    world = {"bounds": {"north": [-far, far], "east": [-far, far], "altitude": [0.0, 6.0]}}
    limits = {"clearance": 0.15}
    document = {"name": "swap", "world": world, "limits": limits, "vehicles": entries}
    return split(yaml.safe_dump(document).encode(), "swap")


def fly(case: tuple[int, int, float, bool, float]) -> tuple[int, ManyResult, float]:
    """One seed, and the CPU time it took [s]."""
    seed, vehicles, radius, share, loss = case
    started = time.process_time()
    result = fly_many(swap(seed, vehicles, radius), seed=100 * seed, share=share, loss=loss)
    return seed, result, time.process_time() - started


def main() -> None:
    """Fly all seeds and tell."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--vehicles", type=int, default=8)
    parser.add_argument("--radius", type=float, default=10.0)
    parser.add_argument("--alone", action="store_true", help="nobody is told of the others")
    parser.add_argument("--loss", type=float, default=0.0, help="part of what they tell that does not arrive")
    parser.add_argument("-j", "--jobs", type=int, default=2)
    asked = parser.parse_args()
    setting = (asked.vehicles, asked.radius, not asked.alone, asked.loss)
    cases = [(seed, *setting) for seed in range(1, asked.seeds + 1)]
    arrived, least = 0, math.inf
    with ProcessPoolExecutor(asked.jobs) as pool:
        for seed, result, cpu_s in pool.map(fly, cases):
            ok = all(v.phase == "done" and not v.failure for v in result.verdicts)
            arrived, least = arrived + ok, min(least, result.separation_m)
            a, b, at_s = result.nearest
            near = f"{result.separation_m:.2f} m between {a} and {b} at {at_s:.1f} s"
            bad = next((v.failure for v in result.verdicts if v.failure), "")
            p95 = max(v.tracking_error_p95_m or 0.0 for v in result.verdicts)
            print(
                f"seed {seed:3}: {'arrived' if ok else 'FAILED ' + bad}, {result.simulated_s:.1f} s, {near}, "
                f"{result.stops} stops, tracking p95 at most {p95:.2f} m, {cpu_s:.1f} s CPU",
                flush=True,
            )
    print(f"{arrived} of {len(cases)} seeds arrived; least separation {least:.2f} m")


if __name__ == "__main__":
    main()
