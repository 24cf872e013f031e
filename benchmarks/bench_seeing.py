"""Flights by what the vehicle sees.

    python -m benchmarks.bench_seeing [seeds] [family ...] [--pop-up] [--one] [--ardupilot]

Whole flights in lockstep of the companion and the bundled vehicle, wind-still, in the worlds of `planner.families`,
none of whose obstacles the planner is told of: all it has are the vehicle's OBSTACLE_DISTANCE messages. A flight counts
as reached when it lands as planned at the goal; touched when the vehicle's ball was in an obstacle, by the truth.
Mazes that are walled off on purpose are left out. `--pop-up`: a wall 6 m ahead of the hull at full speed
instead; `--one`: one process; `--ardupilot`: the vehicle shows ArduPilot's behaviour, else PX4's.
"""

import math
import re
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass

import numpy as np

from companion.cli.vehicle import LINK, build_vehicle
from companion.cli.worlds import mission_text
from companion.core import Companion, CompanionConfig
from companion.drivers.lockstep import fly_lockstep
from companion.drivers.planning import InlinePlanning
from companion.missionfile import parse_mission
from companion.phases import Phase
from companion.seam import Note
from companion.verdict import FlightMeter, judge
from fakevehicle.config import Autopilot
from planner import Box, World, replan, warm_up
from planner.families import FAMILIES, make

CLEARANCE = {"gap": 0.15, "L": 0.3, "H": 0.3, "U": 0.3, "Omega": 0.2, "forest": 0.15, "maze": 0.1}
"""Between hull and what is seen [m], by what the gaps of each family leave."""
SPEED = {"maze": 2.0}
"""Else 3 m/s."""
LIMIT_S = 180.0
POPUP = """\
name: pop-up {seed}
vehicle:
  start: {{north: 2, east: 10}}
world:
  bounds: {{north: [0, 40], east: [0, 20], altitude: [0, 4]}}
  popups:
    - {{within: 6.6, box: {{north: [{low}, {high}], east: [{left}, {right}], altitude: [0, 4]}}}}
limits: {{speed: 3, acceleration: 6, jerk: 60, clearance: 0.4}}
steps:
  - takeoff: {{altitude: 1.5}}
  - goto: {{north: 38, east: 10, altitude: 1.5}}
  - land
sensing: {{clearance: 0.3}}
"""


@dataclass(frozen=True, slots=True)
class Outcome:
    """One flight."""

    family: str
    seed: int
    reached: bool
    clearance: float  # of the hull [m], by the truth
    seconds: float  # in FLYING
    p95: float  # of the tracking error [m]
    asked: int
    switches: int
    stops: int
    scratch: int
    refused: int
    joint: float
    wall_s: float
    failure: str
    notes: tuple[str, ...]


def unknown(family: str, seed: int) -> str:
    """The family's world as a mission whose obstacles the planner is not told of."""
    text = mission_text(family, seed, make(family, seed))
    text = re.sub(r"- (box|cylinder): (\{.*\})", r"- {\1: \2, hidden: true}", text)
    text = text.replace("  speed: 3\n", f"  speed: {SPEED.get(family, 3.0):g}\n")
    text = re.sub(r"\n  clearance: .*\n", f"\n  clearance: {CLEARANCE[family]}\n", text)
    return f"{text}sensing: {{clearance: {CLEARANCE[family]}}}\n"


def pop_up(seed: int) -> str:
    """A wall across the way that is there from 6 m ahead of the hull on; the seed moves it."""
    rng = np.random.default_rng(seed)
    low, width, shift = rng.uniform(14.0, 24.0), rng.uniform(2.0, 8.0), rng.uniform(-1.0, 1.0)
    left, right = 10.0 + shift - width / 2.0, 10.0 + shift + width / 2.0
    return POPUP.format(
        seed=seed, low=round(low, 3), high=round(low + 0.5, 3), left=round(left, 3), right=round(right, 3)
    )


def fly(job: tuple[str, int, Autopilot]) -> Outcome:
    """One flight of a family, or of "pop-up"."""
    family, seed, autopilot = job
    mission = parse_mission((pop_up(seed) if family == "pop-up" else unknown(family, seed)).encode(), "bench.yaml")
    companion = Companion(mission, CompanionConfig(seed=seed))
    meter, notes, flying = FlightMeter(companion), [], []

    def tap(tick):
        flying.extend([tick.now_us] if companion.phase is Phase.FLYING else [])
        notes.extend(f"{tick.now_us / 1e6:.2f} {o.text}" for o in tick.outputs if isinstance(o, Note))

    began = time.perf_counter()
    planning = InlinePlanning(mission.planner_world())
    fly_lockstep(companion, build_vehicle(mission, seed, autopilot), LINK, planning, [meter, tap], limit_s=LIMIT_S)
    verdict, track, r = judge(companion, meter), meter.truth_track(), companion.replanning
    world = mission.whole_world()
    if family == "pop-up":
        b = mission.world.popups[0].box
        low, high = (b.north.low, b.east.low, -b.altitude.high), (b.north.high, b.east.high, -b.altitude.low)
        world = World(world.bounds, [Box(low, high)])
    gap = float(np.min(world.distance(track.aloft_m))) - mission.vehicle.radius if track is not None else math.nan
    return Outcome(
        family, seed, companion.phase is Phase.DONE and not companion.failure, gap,
        (flying[-1] - flying[0]) / 1e6 if flying else math.nan, verdict.tracking_error_p95_m or math.nan,
        r.asked, r.switches, r.stops, r.scratch, r.refused, r.worst_joint, time.perf_counter() - began,
        companion.failure or companion.phase.value, tuple(notes),
    )  # fmt: skip


def main() -> None:
    words = [word for word in sys.argv[1:] if not word.startswith("--")]
    count = int(words[0]) if words else 20
    families = words[1:] or list(FAMILIES)
    if "--pop-up" in sys.argv:
        families = ["pop-up"]
    autopilot: Autopilot = "ardupilot" if "--ardupilot" in sys.argv else "px4"
    warm_up()
    replan.warm_up()
    with ProcessPoolExecutor(1 if "--one" in sys.argv else 2) as pool:
        for family in families:
            seeds = [s for s in range(count) if family == "pop-up" or not make(family, s).closed]
            outcomes = list(pool.map(fly, [(family, seed, autopilot) for seed in seeds]))
            told(family, outcomes)


def told(family: str, outcomes: list[Outcome]) -> None:
    """A line for the family, and one for each flight that did not go well."""
    reached, touched = sum(o.reached for o in outcomes), sum(not o.clearance > 0.0 for o in outcomes)
    seconds = np.median([o.seconds for o in outcomes])
    worst, least = max(o.p95 for o in outcomes), min(o.clearance for o in outcomes)
    mean = {name: np.mean([getattr(o, name) for o in outcomes]) for name in ("stops", "scratch", "switches", "wall_s")}
    print(
        f"{family:8} reached {reached} of {len(outcomes)}, touched {touched}, least {least:.3f} m, {seconds:.1f} s, "
        f"p95 {worst:.3f} m, stops {mean['stops']:.1f}, from scratch {mean['scratch']:.1f}, "
        f"switches {mean['switches']:.1f}, joint {max(o.joint for o in outcomes):.0e}, {mean['wall_s']:.1f} s a flight",
        flush=True,
    )
    for o in outcomes:
        if not o.reached or not o.clearance > 0.0:
            print(
                f"    {o.seed}: {o.clearance:.3f} m, {o.seconds:.1f} s, {o.failure}; {'; '.join(o.notes[-4:])}",
                flush=True,
            )


if __name__ == "__main__":
    main()
