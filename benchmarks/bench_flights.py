"""Whole flights in lockstep, scored: `python -m benchmarks.bench_flights [known movers links] [--seeds N] [--jobs N]`.

known : the worlds of `planner.families`, map known, both autopilots. A flight counts when it lands as planned at the
    goal, keeps the clearance its mission asks of the plan to within what tracking costs, and tracks at p95 <= 0.25 m.
movers : twenty balls of 0.3 to 0.5 m that cross the room at up to 2 m/s and are reflected by its walls; the vehicle
    is told of none of them, hears ADSB_VEHICLE and sees by its obstacle sensor. Counted are touches, by the truth.
links : the L-shaped wall over links with faults; counted is how the flights end.
"""

import argparse
import math
import sys
import time
from collections import Counter
from collections.abc import Iterable
from dataclasses import replace
from itertools import count as count_from
from pathlib import Path

import numpy as np

from companion.cli.worlds import CLEARANCE, mission_text
from companion.missionfile import parse_mission
from companion.testing.campaign import fly_all
from companion.testing.spec import FlightResult, FlightSpec
from companion.testing.wire import LinkFaults
from fakevehicle.config import Autopilot
from planner import NoPathFound, plan
from planner.families import make

FAMILIES = ("L", "H", "U", "Omega", "forest", "maze")
TRACKING_M = 0.25
L_SHAPE = Path(__file__).parents[1] / "missions" / "l_shape.yaml"
AUTOPILOTS: tuple[Autopilot, ...] = ("px4", "ardupilot")
REBOOT_S = 14.0
LINKS: dict[str, LinkFaults | None] = {
    "30 % loss": LinkFaults(loss=0.3),
    "20 % duplicates": LinkFaults(duplicate=0.2),
    "reordering": LinkFaults(reorder=0.2),
    "200 ms jitter": LinkFaults(jitter_ms=200),
    "5 s blackout": LinkFaults(blackouts=((12.0, 17.0),)),
    "another system shouting": LinkFaults(shouting=True),
    "garbage, 50 a second": LinkFaults(garbage=50),
    "all of it": LinkFaults(0.3, 0.2, 0.1, 200, ((12.0, 17.0),), 20, True),
    f"the vehicle boots again at {REBOOT_S:g} s": None,
}


def known(asked: argparse.Namespace) -> None:
    """Item: the map is known."""
    print(
        "| family | autopilot | reached | least clearance m | asked | p95 m, worst | p95 m, median | CPU s a flight |"
    )
    print("|---|---|---|---|---|---|---|---|")
    for family in asked.families:
        for autopilot in AUTOPILOTS:
            results = list(fly_all(known_specs(family, autopilot, asked.seeds), asked.jobs))
            done = [r for r in results if r.phase == "done" and not r.failure]
            p95 = [r.verdict.tracking_error_p95_m for r in done]
            clear = min((r.min_clearance_m for r in done), default=math.nan)
            cpu = np.mean([r.cpu_s for r in results])
            row = f"| {family} | {autopilot} | {len(done)}/{len(results)} | {clear:.2f} | {CLEARANCE[family]:g} "
            print(f"{row}| {max(p95):.3f} | {np.median(p95):.3f} | {cpu:.2f} |", flush=True)
            failed(r for r in results if r.failure or not r.ok or r.verdict.tracking_error_p95_m > TRACKING_M)


def known_specs(family: str, autopilot: Autopilot, count: int) -> list[FlightSpec]:
    """Flights of the first worlds of a family, from seed 1 on, that have a way at the clearance they are written with.

    Left out are those that are walled off: on purpose, or by the planner's proof (one maze in four).
    """
    specs: list[FlightSpec] = []
    for seed in count_from(1):
        scenario = make(family, seed)
        text = mission_text(family, seed, scenario).encode()
        if not scenario.closed and not walled_off(text):
            specs.append(FlightSpec(text, autopilot=autopilot, seed=seed))
        if len(specs) == count:
            return specs
    raise AssertionError("seeds do not end")


def walled_off(text: bytes) -> bool:
    """Whether the planner proves that a mission's first leg has no way."""
    mission = parse_mission(text, "world.yaml")
    start = (*mission.start_m()[:2], -next(s.takeoff.altitude for s in mission.steps if s.takeoff is not None))
    goal = next(s.goto.ned() for s in mission.steps if s.goto is not None)
    try:
        plan(mission.planner_world(), start, goal, mission.planner_limits(), mission.planner_radius())
    except NoPathFound as error:
        return error.proved
    return False


def movers_text(seed: int, count: int = 20, speed: float = 2.0) -> str:
    """A room of 24 x 20 x 4 m in which `count` balls cross the way, at speeds evenly from half of `speed` up to it."""
    rng = np.random.default_rng([4, seed])
    rows = []
    while len(rows) < count:
        radius = rng.uniform(0.3, 0.5)
        place = rng.uniform([4.0, radius, radius + 0.3], [21.0, 20.0 - radius, 3.7 - radius])
        angle, rate = rng.uniform(-math.pi, math.pi), rng.uniform(0.5 * speed, speed)
        north, east, up = 0.5 * math.cos(angle), math.copysign(1.0, math.sin(angle)), 0.2 * rng.standard_normal()
        north, east, up = (rate * v / math.hypot(north, east, up) for v in (north, east, up))
        ball = f"north: {place[0]:.3f}, east: {place[1]:.3f}, altitude: {place[2]:.3f}, radius: {radius:.3f}"
        rows.append(f"    - {{sphere: {{{ball}}}, velocity: {{north: {north:.3f}, east: {east:.3f}, up: {up:.3f}}}}}")
    return f"""\
name: movers {seed}
vehicle: {{start: {{north: 2, east: 10}}}}
world:
  bounds: {{north: [0, 24], east: [0, 20], altitude: [0, 4]}}
  movers:
{chr(10).join(rows)}
sensing: {{use: true, resolution: 0.2, clearance: 0.3, mover_radius: 0.5}}
limits: {{speed: 3, acceleration: 6, jerk: 60}}
steps:
  - takeoff: {{altitude: 1.5}}
  - goto: {{north: 22, east: 10, altitude: 1.5}}
  - land
"""


def movers(asked: argparse.Namespace) -> None:
    """Item: twenty movers that cross."""
    print("| autopilot | flights | without a touch | landed at the goal | nearest m | median m | CPU s a flight |")
    print("|---|---|---|---|---|---|---|")
    for autopilot in AUTOPILOTS:
        specs = [FlightSpec(movers_text(s).encode(), autopilot=autopilot, seed=s) for s in range(1, asked.seeds + 1)]
        results = list(fly_all(specs, asked.jobs))
        near = [math.nan if r.min_clearance_m is None else r.min_clearance_m for r in results]
        clear, done = sum(n > 0.0 for n in near), sum(r.phase == "done" and not r.failure for r in results)
        cpu = np.mean([r.cpu_s for r in results])
        row = f"| {autopilot} | {len(results)} | {clear} | {done} | {np.nanmin(near):.2f} | {np.nanmedian(near):.2f} "
        print(f"{row}| {cpu:.2f} |", flush=True)
        failed(r for r in results if not r.ok)


def links(asked: argparse.Namespace) -> None:
    """Item: links with faults."""
    print("| link | autopilot | flights | mission completed | otherwise ended by | seconds, median |")
    print("|---|---|---|---|---|---|")
    for name, faults in LINKS.items():
        for autopilot in AUTOPILOTS:
            seeds = range(1, asked.seeds + 1)
            if faults is None:
                specs = [FlightSpec(L_SHAPE, autopilot=autopilot, seed=s, reboot_s=REBOOT_S) for s in seeds]
            else:
                specs = [FlightSpec(L_SHAPE, autopilot=autopilot, seed=s, link=replace(faults, seed=s)) for s in seeds]
            results = list(fly_all(specs, asked.jobs))
            done = [r for r in results if r.phase == "done" and not r.failure]
            rest = Counter(r.failure or r.cause for r in results if r not in done)
            ends = "; ".join(f"{n} x {text}" for text, n in rest.most_common(3))
            seconds = np.median([r.simulated_s for r in results])
            row = f"| {name} | {autopilot} | {len(results)} | {len(done)} | {ends or 'none'} "
            print(f"{row}| {seconds:.1f} |", flush=True)


def failed(results: Iterable[FlightResult]) -> None:
    """Name what did not count, on stderr."""
    for result in results:
        p95 = None if result.verdict is None else result.verdict.tracking_error_p95_m
        print(f"  seed {result.spec.seed} {result.spec.autopilot}: {result.cause} p95 {p95}", file=sys.stderr)


CAMPAIGNS = {"known": known, "movers": movers, "links": links}


def main() -> None:
    """Fly the campaigns that are asked for, or all."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("campaigns", nargs="*", choices=[*CAMPAIGNS, []], default=[])
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--families", nargs="*", default=list(FAMILIES), choices=FAMILIES, help="of known")
    asked = parser.parse_args()
    for name in asked.campaigns or CAMPAIGNS:
        started = time.perf_counter()
        CAMPAIGNS[name](asked)
        print(f"\n{name}: {time.perf_counter() - started:.0f} s\n", flush=True)


if __name__ == "__main__":
    main()
