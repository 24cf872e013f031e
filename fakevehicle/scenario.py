"""A scenario: what happens to a vehicle in one flight, as a YAML file.

faults: ["gps:off@20-40", "motor2:bias=0.65@30"]
gusts: [{at: 15, rise: 1, hold: 3, velocity: [0, 6, 0]}]      # s, s, s, m/s north, east, down
world:                                                        # local NED from home [m]
  boxes: [[3, -1, -4, 5, 2, 0]]                               # low and high corner
  spheres: [[0, 5, -2, 1.5]]                                  # centre, radius
  cylinders: [[-4, 1, 0.7, -6, 0]]                            # north, east, radius, upper and lower end
  walls: [[4, -1, 4, 1, -3, 0]]                               # two ends on the ground, upper and lower edge
  movers:                                                     # balls that fly about, reflected by a block's walls
    block: [-10, -10, -4, 10, 10, 0]                          # low and high corner; none: they fly straight on
    balls: [[5, 0, -2, 0, 1.5, 0, 0.4]]                       # centre at the start, velocity [m/s], radius
  popups:                                                     # solids that are there from a time [s] on, or once the
    - {at: 12, boxes: [[8, -2, -4, 8.3, 2, 0]]}               # vehicle is so near to them [m]; and then stay
    - {within: 6, cylinders: [[3, 9, 0.5, -4, 0]]}
"""

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import yaml
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from fakevehicle.errors import ScenarioError
from fakevehicle.faults import MOST, Fault, parse_fault
from fakevehicle.physics.wind import Gust
from fakevehicle.sensors.movers import MOST as MOST_HAPPENINGS
from fakevehicle.sensors.movers import Movers, PopUp
from fakevehicle.sensors.obstacles import World
from fakevehicle.vocabulary import FloatArray

MOST_SOLIDS = 100_000
MOST_BYTES = 32_000_000

Number = Annotated[float, Field(allow_inf_nan=False)]
Rows = Annotated[list[list[Number]], Field(max_length=MOST_SOLIDS)]


class _Model(BaseModel):
    model_config = ConfigDict(extra="forbid")


class _GustModel(_Model):
    at: Annotated[Number, Field(ge=0)]
    rise: Annotated[Number, Field(ge=0)] = 0.5
    hold: Annotated[Number, Field(ge=0)] = 2.0
    velocity: Annotated[list[Number], Field(min_length=3, max_length=3)]


class _SolidsModel(_Model):
    boxes: Rows = Field(default_factory=list)
    spheres: Rows = Field(default_factory=list)
    cylinders: Rows = Field(default_factory=list)
    walls: Rows = Field(default_factory=list)


class _PopUpModel(_SolidsModel):
    at: Annotated[Number, Field(ge=0)] | None = None
    within: Annotated[Number, Field(gt=0)] | None = None


class _MoversModel(_Model):
    block: Annotated[list[Number], Field(min_length=6, max_length=6)] | None = None
    balls: Annotated[list[list[Number]], Field(max_length=MOST_HAPPENINGS)]


class _WorldModel(_SolidsModel):
    movers: _MoversModel | None = None
    popups: Annotated[list[_PopUpModel], Field(max_length=MOST_HAPPENINGS)] = Field(default_factory=list)


class _ScenarioModel(_Model):
    faults: Annotated[list[str], Field(max_length=MOST)] = Field(default_factory=list)
    gusts: Annotated[list[_GustModel], Field(max_length=1000)] = Field(default_factory=list)
    world: _WorldModel | None = None


@dataclass(frozen=True, slots=True)
class Scenario:
    """What `VehicleConfig` takes of a scenario."""

    faults: tuple[Fault, ...] = ()
    gusts: tuple[Gust, ...] = ()
    world: World | None = None


def load_scenario(path: Path) -> Scenario:
    """Read a scenario's file.

    Raises
    ------
    ScenarioError : it cannot be read or is no scenario; the message says file, place and what was expected.
    """
    try:
        with path.open("rb") as file:
            data = file.read(MOST_BYTES + 1)
    except OSError as error:
        raise ScenarioError(str(path), "", error.strerror or "it cannot be read") from error
    if len(data) > MOST_BYTES:
        raise ScenarioError(str(path), "", f"more than {MOST_BYTES // 1_000_000} MB")
    try:
        content = yaml.load(data, getattr(yaml, "CSafeLoader", yaml.SafeLoader))  # the fast one where it was built
        model = _ScenarioModel.model_validate({} if content is None else content)
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        raise ScenarioError(str(path), "", getattr(error, "problem", None) or "no YAML") from error
    except ValidationError as error:
        first = error.errors()[0]
        place = ".".join(str(part) for part in first["loc"])
        raise ScenarioError(str(path), place, first["msg"]) from error
    try:
        return Scenario(
            faults=tuple(parse_fault(text) for text in model.faults),
            gusts=tuple(Gust(round(1e6 * g.at), g.rise, g.hold, np.array(g.velocity)) for g in model.gusts),
            world=None if model.world is None else _world(model.world),
        )
    except ValueError as error:
        raise ScenarioError(str(path), "", str(error)) from error


def _world(model: _WorldModel) -> World:
    solids = _solids("world", model)
    popups = tuple(
        PopUp(_solids(f"world.popups.{k}", p), None if p.at is None else round(1e6 * p.at), p.within)
        for k, p in enumerate(model.popups)
    )
    movers = None
    if model.movers is not None:
        block = model.movers.block
        walls = () if block is None else (np.array(block[:3]), np.array(block[3:]))
        movers = Movers(_rows("world.movers.balls", model.movers.balls, 7), *walls)
    return replace(solids, movers=movers, popups=popups)


def _solids(name: str, model: _SolidsModel) -> World:
    return World(
        _rows(f"{name}.boxes", model.boxes, 6),
        _rows(f"{name}.spheres", model.spheres, 4),
        _rows(f"{name}.cylinders", model.cylinders, 5),
        _rows(f"{name}.walls", model.walls, 6),
    )


def _rows(name: str, found: list[list[float]], width: int) -> FloatArray:
    wrong = [len(row) for row in found if len(row) != width]
    if wrong:
        raise ValueError(f"{name}: a row of {wrong[0]} numbers, expected {width}")
    return np.array(found, dtype=float).reshape(-1, width)


def world_text(world: World) -> str:
    """A scenario's file with nothing but this world in it."""
    content: dict[str, Any] = _solid_rows(world)
    if world.movers is not None:
        balls, block = world.movers.balls.tolist(), [*world.movers.low_n.tolist(), *world.movers.high_n.tolist()]
        content["movers"] = {"balls": balls, **({"block": block} if np.isfinite(block).all() else {})}
    if world.popups:
        content["popups"] = [
            {**({"within": p.within} if p.at_us is None else {"at": p.at_us * 1e-6}), **_solid_rows(p.solids)}
            for p in world.popups
        ]
    text: str = yaml.safe_dump({"world": content}, sort_keys=False)
    return text


def _solid_rows(world: World) -> dict[str, Any]:
    solids = {name: getattr(world, name).tolist() for name in ("boxes", "spheres", "cylinders", "walls")}
    return {name: rows for name, rows in solids.items() if rows}
