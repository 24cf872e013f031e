"""The steps of a mission, as its file writes them."""

import math
from typing import Annotated, Any, Literal

from pydantic import Field, model_validator

from companion.seam import Vector
from companion.shapes import Coordinate, Located, Model, Place, Size

MOST_VIA = 25
"""Points on the way of one leg; the planner takes no more."""
PLANNED = ("goto", "orbit", "return_home")
"""Steps whose way is planned: they may have a speed and a clearance of their own."""


class Takeoff(Model):
    altitude: Size  # [m]


class Hold(Model):
    seconds: Annotated[float, Field(ge=0, le=86_400)]


class Orbit(Located):
    """Round a point, from where its circle is nearest and back to there if the turns are whole."""

    north: Coordinate
    east: Coordinate
    altitude: Coordinate
    radius: Annotated[float, Field(ge=0.1, le=1e4)]  # [m]
    turns: Annotated[float, Field(gt=0, le=1000)] = 1.0
    clockwise: bool = True  # seen from above

    def centre(self) -> Vector:
        """In the mission frame, z down."""
        return (self.north, self.east, -self.altitude)

    def ring(self, count: int = 360) -> list[Vector]:
        """Points of the circle, likewise."""
        turns = [2.0 * math.pi * k / count for k in range(count)]
        r = self.radius
        return [(self.north + r * math.cos(t), self.east + r * math.sin(t), -self.altitude) for t in turns]


class Yaw(Model):
    """Turn the nose on the spot, the short way; it stays there for the steps that follow."""

    heading_deg: Annotated[float, Field(ge=-360, le=360)]  # clockwise from north
    rate_deg: Annotated[float, Field(ge=1, le=360)] = 45.0  # greatest [deg/s]


Percent = Annotated[float, Field(ge=0, le=100)]


class Wait(Model):
    """Hold the place until something is so."""

    for_: Literal["order", "battery above", "movers clear"] = Field(alias="for")
    percent: Percent | None = None  # of the battery
    radius: Size | None = None  # [m] between the vehicle's centre and what moves; None: what plans keep
    at_most: Annotated[float, Field(ge=0, le=86_400)] | None = None  # then the mission goes on [s]; None: for ever

    @model_validator(mode="after")
    def _percent_with_battery(self) -> "Wait":
        if (self.percent is None) == (self.for_ == "battery above"):
            raise ValueError("expected percent with battery above, and only there")
        if self.radius is not None and self.for_ != "movers clear":
            raise ValueError("expected radius with movers clear only")
        return self


class Return(Model):
    """Back to above the start."""

    altitude: Size | None = None  # [m]; None: as high as the step before


class Land(Model):
    pass


KINDS = ("takeoff", "goto", "via", "orbit", "yaw", "hold", "wait", "return", "land")
_BARE: dict[str, str] = {"land": "land", "return": "return"}


class Step(Model):
    """Exactly one of `KINDS`."""

    takeoff: Takeoff | None = None
    goto: Place | None = None
    via: Annotated[list[Place], Field(min_length=1, max_length=MOST_VIA)] | None = None  # passed by the next goto
    orbit: Orbit | None = None
    yaw: Yaw | None = None
    hold: Hold | None = None
    wait: Wait | None = None
    return_home: Return | None = Field(default=None, alias="return")
    land: Land | None = None
    speed: Annotated[float, Field(ge=0.01, le=100)] | None = None  # [m/s] on the way of this step
    clearance: Annotated[float, Field(ge=0, le=100)] | None = None  # [m] likewise

    @model_validator(mode="before")
    @classmethod
    def _bare(cls, value: Any) -> Any:
        if isinstance(value, str) and value in _BARE:
            return {value: {}}
        if isinstance(value, dict):
            return {k: {} if k in _BARE and v is None else v for k, v in value.items()}
        return value

    @model_validator(mode="after")
    def _exactly_one(self) -> "Step":
        found = [name for name in FIELDS if getattr(self, name) is not None]
        if len(found) != 1:
            raise ValueError(f"expected exactly one of {', '.join(KINDS)}")
        if found[0] not in PLANNED and (self.speed is not None or self.clearance is not None):
            raise ValueError(f"found speed or clearance at {self.kind}, expected them at goto, orbit and return")
        return self

    @property
    def kind(self) -> str:
        """Which of `KINDS` it is."""
        return next(k for k, name in zip(KINDS, FIELDS, strict=True) if getattr(self, name) is not None)


FIELDS = tuple("return_home" if kind == "return" else kind for kind in KINDS)


def flaw_in_order(steps: list[Step]) -> str:
    """Why a list of steps cannot be flown in its order, or nothing."""
    kinds = [step.kind for step in steps]
    last = len(kinds) - 1
    for i, kind in enumerate(kinds):
        if (kind == "takeoff") != (i == 0):
            return f"found {kind} as step {i}, expected takeoff as the first and only there"
        if kind == "land" and i != last:
            return f"found land as step {i}, expected land as the last and only there"
        if i == last and kind not in ("land", "return"):
            return f"found {kind} as step {i}, expected land as the last, or return, which lands too"
        if kind == "via" and kinds[i + 1 : i + 2] not in (["goto"], ["via"]):
            return f"found {kinds[i + 1]} after via as step {i + 1}, expected the goto that it is on the way to"
    return ""
