"""Missions: what a flight is, checked once, and turned into the planner's words.

Coordinates are named (north, east, altitude), never a bare triple whose sign must be guessed. `missionfile` reads the
YAML that people write.
"""

import math
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import Field, PrivateAttr, field_validator, model_validator

from companion.geodesy import Geodetic
from companion.geofence import FenceModel, Geofence
from companion.mapfiles import DEFAULT_AXES, Axes, cloud_in_ned, voxels_in_ned
from companion.seam import Vector
from companion.shapes import (
    Coordinate,
    CylinderShape,
    Extent,
    Finite,
    Located,
    Model,
    Origin,
    Positive,
    PrismShape,
    Size,
    SphereShape,
)
from companion.steps import Step, flaw_in_order
from planner import Box, Cylinder, Limits, PointCloud, Prism, Sphere, VoxelGrid, World
from planner.errors import WorldFileError
from planner.worlds import Obstacle as PlannerObstacle

if TYPE_CHECKING:
    from companion.planfiles.items import GroundPlan

MAX_MAP_FILES = 16
"""Voxel and cloud files of one mission."""
MAX_KEPT_BYTES = 16_000_000
"""Of one of them, for a recording, at the start of whose every part it stands."""


class MapFile(Model):
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


class Obstacle(Model):
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


class PopUp(Obstacle):
    """A shape that is not there at first: from a time on, or once the vehicle is so near to it. Nobody is told."""

    at: Annotated[float, Field(ge=0, le=86_400)] | None = None  # [s] since the vehicle's start
    within: Size | None = None  # [m] from its centre

    @model_validator(mode="after")
    def _appears_somehow(self) -> "PopUp":
        if (self.at is None) == (self.within is None):
            raise ValueError("expected exactly one of at, within")
        if self.voxels is not None or self.cloud is not None:
            raise ValueError("expected a box, cylinder, sphere or prism")
        return self


class Velocity(Model):
    """[m/s] over ground."""

    north: Annotated[float, Field(ge=-60, le=60)] = 0.0
    east: Annotated[float, Field(ge=-60, le=60)] = 0.0
    up: Annotated[float, Field(ge=-60, le=60)] = 0.0


class Mover(Model):
    """A ball that flies about, reflected by the bounds; where it is at the vehicle's start, and its course."""

    sphere: SphereShape
    velocity: Velocity


class WorldModel(Model):
    bounds: Extent
    obstacles: list[Obstacle] = Field(default_factory=list, max_length=100_000)
    popups: list[PopUp] = Field(default_factory=list, max_length=1000)
    movers: list[Mover] = Field(default_factory=list, max_length=1000)

    @field_validator("obstacles")
    @classmethod
    def _few_files(cls, obstacles: list[Obstacle]) -> list[Obstacle]:
        files = sum(o.voxels is not None or o.cloud is not None for o in obstacles)
        if files > MAX_MAP_FILES:
            raise ValueError(f"found {files} voxel and cloud files, expected at most {MAX_MAP_FILES}")
        return obstacles

    @model_validator(mode="after")
    def _movers_are_inside(self) -> "WorldModel":
        for i, mover in enumerate(self.movers):
            ball = mover.sphere
            for key in ("north", "east", "altitude"):
                found, within = getattr(ball, key), getattr(self.bounds, key)
                if not within.low + ball.radius <= found <= within.high - ball.radius:
                    raise ValueError(f"mover {i}: found {key} {found:g}, expected it inside the bounds by its radius")
        return self


class StartPose(Located):
    """Where the vehicle stands before the mission, on the ground at altitude 0, and where its nose points."""

    north: Coordinate
    east: Coordinate
    heading_deg: Annotated[float, Field(ge=-360, le=360)] = 0.0
    anywhere: bool = False  # with an origin: the flight begins where the vehicle is found, however far from here


class VehicleModel(Model):
    start: StartPose
    radius: Annotated[float, Field(gt=0, le=100)] = 0.35  # [m] half the tip-to-tip diagonal of an X500


class LimitsModel(Model):
    """What the trajectory may ask of the vehicle."""

    speed: Annotated[float, Field(ge=0.01, le=100)] = 3.0  # [m/s]
    acceleration: Annotated[float, Field(ge=0.01, le=1000)] = 6.0  # [m/s^2]
    jerk: Annotated[float, Field(ge=0.01, le=1e5)] = 60.0  # [m/s^3]
    climb: Annotated[float, Field(ge=0.3, le=20)] = 1.0  # [m/s] of the takeoff; slower is not seen as one (PX4 disarms)
    clearance: Annotated[float, Field(ge=0, le=100)] = 0.4  # [m] kept by plans between hull and obstacles
    reach: Annotated[float, Field(ge=1, le=1e7)] = 5000.0  # [m] no place farther from the start: a typo, not a flight


class Sensing(Model):
    """Flying by what the vehicle sees on its way, beside what the world says."""

    use: bool = True
    resolution: Annotated[float, Field(ge=0.05, le=1)] = 0.1  # [m] edge of the map's cells
    clearance: Annotated[float, Field(ge=0.05, le=100)] | None = (
        None  # [m] hull to what is seen; None: limits.clearance
    )
    mover_radius: Annotated[float, Field(gt=0, le=50)] = 0.5  # [m] of what ADSB_VEHICLE tells of
    column: Literal["full"] | Annotated[float, Field(ge=0.1, le=100)] = "full"  # [m] above and below a hit; or all


class Wind(Model):
    """Velocity of the air over ground [m/s]."""

    north: Annotated[float, Field(ge=-60, le=60)] = 0.0
    east: Annotated[float, Field(ge=-60, le=60)] = 0.0
    down: Annotated[float, Field(ge=-60, le=60)] = 0.0


class Expect(Model):
    """What must be true of the flight; names and units are those of the verdict. None: not asked."""

    tracking_error_p95_m: Positive | None = None  # against truth where the vehicle tells it, else the estimate
    min_clearance_m: Finite | None = None
    duration_max_s: Positive | None = None
    setpoint_gap_p99_ms: Positive | None = None
    setpoint_gap_max_ms: Positive | None = None
    phase: Literal["done", "failed", "handed over"] = "done"  # how it ends: a mission may be there to be refused


class Mission(Model):
    """A flight: where, in what, how, and what counts as success."""

    name: Annotated[str, Field(min_length=1, max_length=100)]
    vehicle: VehicleModel
    world: WorldModel
    limits: LimitsModel = LimitsModel()
    method: Literal["haoaroa", "astar", "jps", "bezier", "lbsgf", "aoa", "roa"] = "haoaroa"  # planner.METHODS
    origin: Origin | None = None
    fence: FenceModel | None = None
    steps: Annotated[list[Step], Field(min_length=2, max_length=10_000)]
    wind: Wind = Wind()
    sensing: Sensing | None = None
    expect: Expect = Expect()

    _ground_plan: Any = PrivateAttr(default=None)
    _maps: dict[int, VoxelGrid | PointCloud] = PrivateAttr(default_factory=dict)  # by obstacle; see read_maps
    _map_files: dict[str, bytes] = PrivateAttr(default_factory=dict)  # by the name that the mission has for them
    _world: World | None = PrivateAttr(default=None)
    _whole: World | None = PrivateAttr(default=None)

    @field_validator("steps")
    @classmethod
    def _flyable_order(cls, steps: list[Step]) -> list[Step]:
        flaw = flaw_in_order(steps)
        if flaw:
            raise ValueError(flaw)
        return steps

    @model_validator(mode="after")
    def _anywhere_has_an_origin(self) -> "Mission":
        if self.vehicle.start.anywhere and self.origin is None:
            raise ValueError("found vehicle.start.anywhere, expected the key origin with it")
        return self

    @model_validator(mode="after")
    def _movers_are_seen(self) -> "Mission":
        if any(s.wait is not None and s.wait.for_ == "movers clear" for s in self.steps) and not self.senses():
            raise ValueError("found a wait for movers clear, expected the key sensing with it")
        return self

    @property
    def ground_plan(self) -> "GroundPlan | None":
        """The ground station's plan that this mission was read from, if it was."""
        plan: GroundPlan | None = self._ground_plan
        return plan

    @property
    def map_files(self) -> Mapping[str, bytes]:
        """The files of voxels and clouds that it was read from, but for those of more than `MAX_KEPT_BYTES`."""
        return self._map_files

    def keep_ground_plan(self, plan: "GroundPlan") -> None:
        """Remember the plan that it was read from."""
        self._ground_plan = plan

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

    def kept(self) -> float:
        """Distance [m] that every way of the mission keeps from what is told, the fence included.

        A way planned anew by what is seen may keep as little as the hull.
        """
        if self.senses():
            return self.vehicle.radius
        own = [step.clearance for step in self.steps if step.clearance is not None]
        return self.vehicle.radius + min([self.limits.clearance, *own])

    def seen_radius(self) -> float:
        """Distance [m] kept from what is seen on the way: the hull and `sensing.clearance`."""
        own = None if self.sensing is None else self.sensing.clearance
        return self.vehicle.radius + (self.limits.clearance if own is None else own)

    def planner_world(self) -> World:
        """What the planner is told of the world, in the mission frame; the fence is solid to it."""
        if self._world is None:
            world, fence = self._built(lambda obstacle: not obstacle.hidden), self.geofence()
            if fence is not None:
                (n, e, top), high = world.bounds
                low = (n, e, max(top, -fence.ceiling))
                world = World(bounds=(low, high), obstacles=[*world.obstacles, *fence.solids((low, high))])
            self._world = world
        return self._world

    def geofence(self) -> Geofence | None:
        """Where the mission may fly, if it says so."""
        return None if self.fence is None else self.fence.geofence(self.kept())

    def geodetic_origin(self) -> Geodetic | None:
        """Where on the earth the mission frame is, if it is known."""
        return None if self.origin is None else self.origin.geodetic()

    def whole_world(self) -> World:
        """The same with what is hidden from the planner: the bundled vehicle sees it and a flight is judged by it."""
        if self.fence is None and not any(obstacle.hidden for obstacle in self.world.obstacles):
            return self.planner_world()
        if self._whole is None:
            self._whole = self._built(lambda obstacle: True)
        return self._whole

    def _built(self, told: Callable[[Obstacle], bool]) -> World:
        """The world in the mission frame."""
        obstacles: list[PlannerObstacle] = []
        for index, obstacle in enumerate(self.world.obstacles):
            if told(obstacle):
                obstacles.append(self.solid(index))
        return World(bounds=_corners(self.world.bounds), obstacles=obstacles)

    def beyond_reach(self) -> list[tuple[list[Any], str]]:
        """Places of the mission farther from its start than `limits.reach`, as (keys, by how much).

        A digit wrong in a latitude is a flight of kilometres that no battery ends: half a degree is 55 km.
        """
        start, reach, found = self.start_m(), self.limits.reach, []
        for i, step in enumerate(self.steps):
            named: list[tuple[list[Any], list[Vector]]] = []
            if step.goto is not None:
                named = [(["goto"], [step.goto.ned()])]
            elif step.via is not None:
                named = [(["via", k], [place.ned()]) for k, place in enumerate(step.via)]
            elif step.orbit is not None:
                named = [(["orbit"], step.orbit.ring())]
            for keys, places in named:
                far = max(math.dist(start[:2], place[:2]) for place in places)
                if far > reach:
                    told = f"found a place {far:.0f} m from the start, expected at most {reach:g} m (limits.reach)"
                    found.append((["steps", i, *keys], told))
        return found

    def beyond_the_fence(self) -> list[tuple[list[Any], str]]:
        """Places of the mission that its fence does not allow, as (keys, by how much)."""
        fence = self.geofence()
        if fence is None:
            return []
        if fence.margin > self.kept():
            why = "vehicle.radius, all that ways by what is seen keep" if self.senses() else "what every way keeps"
            return [(["fence", "margin"], f"found {fence.margin:g}, expected at most {self.kept():g} ({why})")]
        places: list[tuple[list[Any], Vector]] = []
        if not self.vehicle.start.anywhere:
            places.append((["vehicle", "start"], self.start_m()))
        for i, step in enumerate(self.steps):
            if step.goto is not None:
                places.append((["steps", i, "goto"], step.goto.ned()))
            elif step.via is not None:
                places.extend((["steps", i, "via", k], place.ned()) for k, place in enumerate(step.via))
            elif step.orbit is not None:
                places.append((["steps", i, "orbit"], min(step.orbit.ring(), key=fence.inside)))
            elif step.takeoff is not None and fence.ceiling < step.takeoff.altitude + self.planner_radius():
                places.append((["steps", i, "takeoff"], (*self.start_m()[:2], -step.takeoff.altitude)))
        told = ((keys, fence.told(place, self.planner_radius())) for keys, place in places)
        return [(keys, f"found a place {text}, expected one inside") for keys, text in told if text]

    def solid(self, index: int) -> PlannerObstacle:
        """One obstacle of the world as the planner's, in the mission frame."""
        solid = solid_of(self.world.obstacles[index])
        return self._maps[index] if solid is None else solid

    def read_maps(self, folder: Path, known: Mapping[str, Path]) -> list[tuple[list[Any], str]]:
        """Read the files that the world names, `known` ones or relative to a folder; problems as (keys, what is wrong).

        Done when the mission is parsed, so that nothing that holds a mission reads files.
        """
        problems: list[tuple[list[Any], str]] = []
        for index, obstacle in enumerate(self.world.obstacles):
            kind = "voxels" if obstacle.voxels is not None else "cloud"
            named = obstacle.voxels or obstacle.cloud
            if named is None:
                continue
            path = known.get(named.file, folder / named.file)
            try:
                if obstacle.voxels is not None:
                    self._maps[index] = voxels_in_ned(path, named.axes, named.sha256)
                elif obstacle.cloud is not None:
                    self._maps[index] = cloud_in_ned(path, named.axes, obstacle.cloud.resolution, named.sha256)
                if path.stat().st_size <= MAX_KEPT_BYTES:
                    self._map_files[named.file] = path.read_bytes()
            except OSError as error:
                problems.append((["world", "obstacles", index, kind], f"{path}: {error.strerror or error}"))
            except WorldFileError as error:
                problems.append((["world", "obstacles", index, kind], str(error)))
        if not problems:
            try:
                self.whole_world()
                self.planner_world()
            except ValueError as error:
                problems.append((["world", "obstacles"], str(error)))
        problems.extend(self.beyond_reach() or self.beyond_the_fence())
        return problems


def _corners(e: Extent) -> tuple[Vector, Vector]:
    """In the mission frame: altitude intervals are turned upside down into z."""
    low = (e.north.low, e.east.low, -e.altitude.high)
    return low, (e.north.high, e.east.high, -e.altitude.low)


def solid_of(obstacle: Obstacle) -> Box | Cylinder | Sphere | Prism | None:
    """The planner's solid of one obstacle, in the mission frame; None for a file of voxels or points."""
    if obstacle.box is not None:
        return Box(*_corners(obstacle.box))
    if obstacle.cylinder is not None:
        c = obstacle.cylinder
        return Cylinder(centre=(c.north, c.east), radius=c.radius, z=(-c.altitude.high, -c.altitude.low))
    if obstacle.sphere is not None:
        s = obstacle.sphere
        return Sphere(centre=(s.north, s.east, -s.altitude), radius=s.radius)
    return None if obstacle.prism is None else obstacle.prism.in_ned()
