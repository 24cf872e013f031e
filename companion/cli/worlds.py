"""`companion worlds`: a world of one of the planner's families, written as a mission that can be planned and flown."""

import sys
from pathlib import Path

from companion.errors import CompanionError
from planner.families import FAMILIES, Scenario, make
from planner.worlds import Box, Cylinder, Obstacle

VEHICLE_RADIUS = 0.35
"""Half the tip-to-tip diagonal of an X500 [m]."""
CLEARANCE = {"gap": 0.25, "L": 0.4, "H": 0.4, "U": 0.4, "Omega": 0.4, "forest": 0.2, "maze": 0.25}
"""Between hull and obstacles [m], by what the gaps of each family leave."""
WORDS = {
    "gap": "a wall with one gap",
    "L": "an L across the way, its short arm toward the start",
    "H": "an H across the way",
    "U": "a pocket open toward the start",
    "Omega": "a ring of posts open toward the start, with a neck",
    "forest": "fifty trees",
    "maze": "corridors between thin walls",
}


def write_world(family: str, seed: int, file: Path | None, force: bool) -> int:
    """Write the world to `file`, or to stdout when None; returns the exit code. A file is replaced only by `force`.

    Raises
    ------
    CompanionError : the file exists already, or cannot be written.
    """
    if family not in FAMILIES:
        print(f"companion: family: expected one of {', '.join(FAMILIES)}, found {family!r}", file=sys.stderr)
        return 2
    text = mission_text(family, seed, make(family, seed))
    if file is None:
        sys.stdout.write(text)
        return 0
    try:
        with file.open("w" if force else "x", encoding="utf-8") as out:
            out.write(text)
    except FileExistsError as error:
        raise CompanionError(f"{file}: exists already; --force replaces it") from error
    except OSError as error:
        raise CompanionError(f"{file}: cannot be written: {error.strerror or error}") from error
    return 0


def mission_text(family: str, seed: int, scenario: Scenario) -> str:
    """The mission as YAML: take off, go to the goal, land. Planner x, y, z become north, east, altitude."""
    (x0, y0, z0), (x1, y1, z1) = scenario.world.bounds
    start, goal = scenario.start, scenario.goal
    shut = "\n# Walled off on purpose: planning it ends with the proof that there is no way." if scenario.closed else ""
    obstacles = "\n".join(f"    - {_shape(obstacle)}" for obstacle in scenario.world.obstacles)
    return f"""\
# {family}, seed {seed}: {WORDS[family]}. Written by `companion worlds {family} --seed {seed}`.{shut}
name: {family} {seed}
vehicle:
  start: {{north: {_number(start[0])}, east: {_number(start[1])}, heading_deg: 0}}
  radius: {VEHICLE_RADIUS}          # half the tip-to-tip diagonal of an X500
world:
  bounds: {{north: {_range(x0, x1)}, east: {_range(y0, y1)}, altitude: {_range(z0, z1)}}}
  obstacles:
{obstacles}
limits:
  speed: 3
  acceleration: 6
  jerk: 60
  climb: 1
  clearance: {CLEARANCE[family]}        # between the vehicle's hull and every obstacle, in the plan
steps:
  - takeoff: {{altitude: {_number(start[2])}}}
  - goto: {{north: {_number(goal[0])}, east: {_number(goal[1])}, altitude: {_number(goal[2])}}}
  - land
expect:
  tracking_error_p95_m: 0.35
  min_clearance_m: 0.05
"""


def _shape(obstacle: Obstacle) -> str:
    if isinstance(obstacle, Box):
        (x0, y0, z0), (x1, y1, z1) = obstacle.lower, obstacle.upper
        return f"box: {{north: {_range(x0, x1)}, east: {_range(y0, y1)}, altitude: {_range(z0, z1)}}}"
    if isinstance(obstacle, Cylinder):
        (x, y), radius, (z0, z1) = obstacle.centre, obstacle.radius, obstacle.z
        where = f"north: {_number(x)}, east: {_number(y)}"
        return f"cylinder: {{{where}, radius: {_number(radius)}, altitude: {_range(z0, z1)}}}"
    raise TypeError(f"obstacle: expected a Box or a Cylinder, found {obstacle!r}")


def _range(low: float, high: float) -> str:
    return f"[{_number(low)}, {_number(high)}]"


def _number(value: float) -> str:
    """To the millimetre, without needless zeros."""
    return f"{round(value, 3) + 0.0:g}"
