"""Missions: what a flight is, checked once, and turned into the planner's words.

Coordinates are named (north, east, altitude), never a bare triple whose sign must be guessed. `missionfile` reads the
YAML that people write.
"""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, PrivateAttr, field_validator, model_validator

from companion.mapfiles import DEFAULT_AXES, Axes, cloud_in_ned, voxels_in_ned
from companion.seam import Vector
from planner import Box, Cylinder, Limits, PointCloud, Prism, Sphere, VoxelGrid, World
from planner.errors import WorldFileError
from planner.prism import MOST_CORNERS
from planner.worlds import Obstacle as PlannerObstacle

MAX_MAP_FILES = 16
"""Voxel and cloud files of one mission."""

Coordinate = Annotated[float, Field(ge=-1e5, le=1e5)]  # [m]: local frames are flat that far, and floats are fine
Size = Annotated[float, Field(gt=0, le=1e5)]  # [m]
Finite = Annotated[float, Field(allow_inf_nan=False)]
Positive = Annotated[float, Field(gt=0, allow_inf_nan=False)]


class _Model(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, strict=True, allow_inf_nan=False)


class Range(_Model):
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


class Extent(_Model):
    """An axis-aligned block of space [m]."""

    north: Range
    east: Range
    altitude: Range


class Place(_Model):
    """A point [m] from the world origin."""

    north: Coordinate
    east: Coordinate
    altitude: Coordinate

    def ned(self) -> Vector:
        """The point in the mission frame, z down."""
        return (self.north, self.east, -self.altitude)


class CylinderShape(_Model):
    """An upright cylinder [m]."""

    north: Coordinate
    east: Coordinate
    radius: Size
    altitude: Range


class SphereShape(_Model):
    north: Coordinate
    east: Coordinate
    altitude: Coordinate
    radius: Size


class Corner(_Model):
    """A corner of an outline seen from above [m]."""

    north: Coordinate
    east: Coordinate


class PrismShape(_Model):
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


class MapFile(_Model):
    """A file of voxels, beside the mission file unless its path says otherwise."""

    file: Annotated[str, Field(min_length=1, max_length=1000, pattern=r"^[^\x00]+$")]
    axes: Axes = DEFAULT_AXES  # what its columns are
    sha256: Annotated[str, Field(pattern=r"^[0-9a-f]{64}$")] | None = None  # of its bytes, where that matters

    @model_validator(mode="before")
    @classmethod
    def _bare_name(cls, value: Any) -> Any:
        return {"file": value} if isinstance(value, str) else value


class CloudFile(MapFile):
    """A file of points."""

    resolution: Annotated[float, Field(ge=0.001, le=1000)] | None = None  # edge of its voxels [m]


class Obstacle(_Model):
    """Exactly one of box, cylinder, sphere, prism, voxels and cloud."""

    box: Extent | None = None
    cylinder: CylinderShape | None = None
    sphere: SphereShape | None = None
    prism: PrismShape | None = None
    voxels: MapFile | None = None
    cloud: CloudFile | None = None
    hidden: bool = False  # there, seen by the bundled vehicle and judged, but the planner is not told

    @model_validator(mode="after")
    def _exactly_one(self) -> "Obstacle":
        shapes = (self.box, self.cylinder, self.sphere, self.prism, self.voxels, self.cloud)
        if sum(shape is not None for shape in shapes) != 1:
            raise ValueError("expected exactly one of box, cylinder, sphere, prism, voxels, cloud")
        return self


class WorldModel(_Model):
    bounds: Extent
    obstacles: list[Obstacle] = Field(default_factory=list, max_length=100_000)

    @field_validator("obstacles")
    @classmethod
    def _few_files(cls, obstacles: list[Obstacle]) -> list[Obstacle]:
        files = sum(o.voxels is not None or o.cloud is not None for o in obstacles)
        if files > MAX_MAP_FILES:
            raise ValueError(f"found {files} voxel and cloud files, expected at most {MAX_MAP_FILES}")
        return obstacles


class StartPose(_Model):
    """Where the vehicle stands before the mission, on the ground at altitude 0, and where its nose points."""

    north: Coordinate
    east: Coordinate
    heading_deg: Annotated[float, Field(ge=-360, le=360)] = 0.0


class VehicleModel(_Model):
    start: StartPose
    radius: Annotated[float, Field(gt=0, le=100)] = 0.35  # [m] half the tip-to-tip diagonal of an X500


class LimitsModel(_Model):
    """What the trajectory may ask of the vehicle."""

    speed: Annotated[float, Field(ge=0.01, le=100)] = 3.0  # [m/s]
    acceleration: Annotated[float, Field(ge=0.01, le=1000)] = 6.0  # [m/s^2]
    jerk: Annotated[float, Field(ge=0.01, le=1e5)] = 60.0  # [m/s^3]
    climb: Annotated[float, Field(ge=0.3, le=20)] = 1.0  # [m/s] of the takeoff; slower is not seen as one (PX4 disarms)
    clearance: Annotated[float, Field(ge=0, le=100)] = 0.4  # [m] kept by plans between hull and obstacles


class Sensing(_Model):
    """Flying by what the vehicle sees on its way, beside what the world says."""

    use: bool = True
    resolution: Annotated[float, Field(ge=0.05, le=1)] = 0.1  # [m] edge of the map's cells
    clearance: Annotated[float, Field(ge=0.05, le=100)] | None = (
        None  # [m] hull to what is seen; None: limits.clearance
    )
    mover_radius: Annotated[float, Field(gt=0, le=50)] = 0.5  # [m] of what ADSB_VEHICLE tells of
    column: Literal["full"] | Annotated[float, Field(ge=0.1, le=100)] = "full"  # [m] above and below a hit; or all


class Takeoff(_Model):
    altitude: Size  # [m]


class Hold(_Model):
    seconds: Annotated[float, Field(ge=0, le=86_400)]


class Land(_Model):
    pass


class Step(_Model):
    """Exactly one of takeoff, goto, hold and land."""

    takeoff: Takeoff | None = None
    goto: Place | None = None
    hold: Hold | None = None
    land: Land | None = None

    @model_validator(mode="before")
    @classmethod
    def _bare_land(cls, value: Any) -> Any:
        return {"land": {}} if value == "land" or value == {"land": None} else value

    @model_validator(mode="after")
    def _exactly_one(self) -> "Step":
        if sum(kind is not None for kind in (self.takeoff, self.goto, self.hold, self.land)) != 1:
            raise ValueError("expected exactly one of takeoff, goto, hold, land")
        return self

    @property
    def kind(self) -> str:
        """Which of the four it is."""
        return next(name for name in ("takeoff", "goto", "hold", "land") if getattr(self, name) is not None)


class Wind(_Model):
    """Velocity of the air over ground [m/s]."""

    north: Annotated[float, Field(ge=-60, le=60)] = 0.0
    east: Annotated[float, Field(ge=-60, le=60)] = 0.0
    down: Annotated[float, Field(ge=-60, le=60)] = 0.0


class Expect(_Model):
    """What must be true of the flight; names and units are those of the verdict. None: not asked."""

    tracking_error_p95_m: Positive | None = None  # against truth where the vehicle tells it, else the estimate
    min_clearance_m: Finite | None = None
    duration_max_s: Positive | None = None
    setpoint_gap_p99_ms: Positive | None = None


class Mission(_Model):
    """A flight: where, in what, how, and what counts as success."""

    name: Annotated[str, Field(min_length=1, max_length=100)]
    vehicle: VehicleModel
    world: WorldModel
    limits: LimitsModel = LimitsModel()
    method: Literal["haoaroa", "astar", "jps", "bezier", "lbsgf", "aoa", "roa"] = "haoaroa"  # planner.METHODS
    steps: Annotated[list[Step], Field(min_length=2, max_length=10_000)]
    wind: Wind = Wind()
    sensing: Sensing | None = None
    expect: Expect = Expect()

    _maps: dict[int, VoxelGrid | PointCloud] = PrivateAttr(default_factory=dict)  # by obstacle; see read_maps
    _world: World | None = PrivateAttr(default=None)
    _whole: World | None = PrivateAttr(default=None)

    @field_validator("steps")
    @classmethod
    def _flyable_order(cls, steps: list[Step]) -> list[Step]:
        for i, step in enumerate(steps):
            for kind, place, only in (("takeoff", "first", 0), ("land", "last", len(steps) - 1)):
                if (step.kind == kind) != (i == only):
                    raise ValueError(f"found {step.kind} as step {i}, expected {kind} as the {place} and only there")
        return steps

    def start_m(self) -> Vector:
        """Where the vehicle stands, in the mission frame."""
        return (self.vehicle.start.north, self.vehicle.start.east, 0.0)

    def heading(self) -> float:
        """Where its nose points [rad]."""
        return math.radians(self.vehicle.start.heading_deg)

    def planner_limits(self) -> Limits:
        return Limits(speed=self.limits.speed, acceleration=self.limits.acceleration, jerk=self.limits.jerk)

    def planner_radius(self) -> float:
        """Distance [m] the planned curve keeps from obstacles: the hull and the clearance."""
        return self.vehicle.radius + self.limits.clearance

    def senses(self) -> bool:
        """Whether the flight goes by what the vehicle sees, too."""
        return self.sensing is not None and self.sensing.use

    def seen_radius(self) -> float:
        """Distance [m] kept from what is seen on the way: the hull and `sensing.clearance`."""
        own = None if self.sensing is None else self.sensing.clearance
        return self.vehicle.radius + (self.limits.clearance if own is None else own)

    def planner_world(self) -> World:
        """What the planner is told of the world, in the mission frame."""
        if self._world is None:
            self._world = self._built(lambda obstacle: not obstacle.hidden)
        return self._world

    def whole_world(self) -> World:
        """The same with what is hidden from the planner: the bundled vehicle sees it and a flight is judged by it."""
        if not any(obstacle.hidden for obstacle in self.world.obstacles):
            return self.planner_world()
        if self._whole is None:
            self._whole = self._built(lambda obstacle: True)
        return self._whole

    def _built(self, told: Callable[[Obstacle], bool]) -> World:
        """The world in the mission frame: altitude intervals turned upside down into z."""

        def corners(e: Extent) -> tuple[Vector, Vector]:
            low = (e.north.low, e.east.low, -e.altitude.high)
            return low, (e.north.high, e.east.high, -e.altitude.low)

        obstacles: list[PlannerObstacle] = []
        for index, obstacle in enumerate(self.world.obstacles):
            if not told(obstacle):
                continue
            if obstacle.box is not None:
                obstacles.append(Box(*corners(obstacle.box)))
            elif obstacle.cylinder is not None:
                c = obstacle.cylinder
                z = (-c.altitude.high, -c.altitude.low)
                obstacles.append(Cylinder(centre=(c.north, c.east), radius=c.radius, z=z))
            elif obstacle.sphere is not None:
                s = obstacle.sphere
                obstacles.append(Sphere(centre=(s.north, s.east, -s.altitude), radius=s.radius))
            elif obstacle.prism is not None:
                obstacles.append(obstacle.prism.in_ned())
            else:
                obstacles.append(self._maps[index])
        return World(bounds=corners(self.world.bounds), obstacles=obstacles)

    def read_maps(self, folder: Path) -> list[tuple[list[Any], str]]:
        """Read the files that the world names, relative to a folder; problems as (keys, what is wrong).

        Done when the mission is parsed, so that nothing that holds a mission reads files.
        """
        problems: list[tuple[list[Any], str]] = []
        for index, obstacle in enumerate(self.world.obstacles):
            kind = "voxels" if obstacle.voxels is not None else "cloud"
            try:
                if obstacle.voxels is not None:
                    v = obstacle.voxels
                    self._maps[index] = voxels_in_ned(folder / v.file, v.axes, v.sha256)
                elif obstacle.cloud is not None:
                    c = obstacle.cloud
                    self._maps[index] = cloud_in_ned(folder / c.file, c.axes, c.resolution, c.sha256)
            except WorldFileError as error:
                problems.append((["world", "obstacles", index, kind], str(error)))
        if not problems:
            try:
                self.whole_world()
                self.planner_world()
            except ValueError as error:
                problems.append((["world", "obstacles"], str(error)))
        return problems
