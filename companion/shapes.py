"""Places and shapes as a mission file writes them: named (north, east, altitude), never a bare triple.

A place is local (`north`, `east` [m] from the world's origin) or geodetic (`latitude`, `longitude` [deg]); the second
needs the file's `origin` and is turned into the first where it is read, so that nobody behind this module meets it.
"""

from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field, ValidationInfo, model_validator

from companion.geodesy import Geodetic, to_local
from companion.seam import Vector
from planner import Prism
from planner.prism import MOST_CORNERS

Coordinate = Annotated[float, Field(ge=-1e5, le=1e5)]  # [m]: local frames are flat that far, and floats are fine
Size = Annotated[float, Field(gt=0, le=1e5)]  # [m]
Finite = Annotated[float, Field(allow_inf_nan=False)]
Positive = Annotated[float, Field(gt=0, allow_inf_nan=False)]
Latitude = Annotated[float, Field(ge=-89, le=89)]  # [deg]: at the poles there is no east
Longitude = Annotated[float, Field(ge=-180, le=180)]  # [deg]

ORIGIN = "origin"
"""The validation context's key of the `Geodetic` that geodetic places are relative to."""


class Model(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, strict=True, allow_inf_nan=False)


class Origin(Model):
    """Where on the earth the mission frame's origin is."""

    latitude: Latitude
    longitude: Longitude
    altitude: Annotated[float, Field(ge=-1000, le=20_000)] = 0.0  # of the ground there, above mean sea level [m]

    def geodetic(self) -> Geodetic:
        return Geodetic(self.latitude, self.longitude, self.altitude)


class Located(Model):
    """Something at a `north` and an `east`, which may be written as a latitude and a longitude."""

    @model_validator(mode="before")
    @classmethod
    def _from_geodetic(cls, value: Any, info: ValidationInfo) -> Any:
        if not isinstance(value, dict) or not ("latitude" in value or "longitude" in value):
            return value
        origin = (info.context or {}).get(ORIGIN)
        if origin is None:
            raise ValueError(
                "found a latitude and longitude, expected the key origin in the mission, or north and east"
            )
        if "north" in value or "east" in value:
            raise ValueError("found two ways to name a place, expected north and east, or latitude and longitude")
        ends = {"latitude": 89.0, "longitude": 180.0}
        for key, most in ends.items():
            found = value.get(key)
            if isinstance(found, bool) or not isinstance(found, int | float) or not abs(found) <= most:
                raise ValueError(f"found {key} {found!r}, expected degrees from -{most:g} to {most:g}")
        north, east = to_local(origin, float(value["latitude"]), float(value["longitude"]))
        return {**{k: v for k, v in value.items() if k not in ends}, "north": north, "east": east}


class Range(Model):
    """A closed interval, written `[low, high]` [m]."""

    low: Coordinate
    high: Coordinate

    @model_validator(mode="before")
    @classmethod
    def _from_pair(cls, value: Any) -> Any:
        if isinstance(value, list | tuple) and len(value) == 2:
            return {"low": value[0], "high": value[1]}
        raise ValueError("expected a pair [low, high]")

    @model_validator(mode="after")
    def _ordered(self) -> "Range":
        if self.low >= self.high:
            raise ValueError(f"expected low < high, found [{self.low:g}, {self.high:g}]")
        return self


class Extent(Model):
    """An axis-aligned block of space [m]."""

    north: Range
    east: Range
    altitude: Range


class Place(Located):
    """A point [m] from the world origin."""

    north: Coordinate
    east: Coordinate
    altitude: Coordinate

    def ned(self) -> Vector:
        """The point in the mission frame, z down."""
        return (self.north, self.east, -self.altitude)


class CylinderShape(Located):
    """An upright cylinder [m]."""

    north: Coordinate
    east: Coordinate
    radius: Size
    altitude: Range


class SphereShape(Located):
    north: Coordinate
    east: Coordinate
    altitude: Coordinate
    radius: Size


class Corner(Located):
    """A corner of an outline seen from above [m]."""

    north: Coordinate
    east: Coordinate


class PrismShape(Model):
    """An upright prism over a simple polygon, convex or not [m]."""

    corners: Annotated[list[Corner], Field(min_length=3, max_length=MOST_CORNERS)]
    altitude: Range

    @model_validator(mode="after")
    def _simple(self) -> "PrismShape":
        self.in_ned()
        return self

    def in_ned(self) -> Prism:
        """The planner's prism; ValueError unless the corners are those of a simple polygon."""
        corners = [(corner.north, corner.east) for corner in self.corners]
        return Prism(corners, (-self.altitude.high, -self.altitude.low))
