"""Trajectories that are proved not to touch anything.

    from planner import Box, Limits, World, plan

    world = World(bounds=((0, 0, 0), (20, 20, 4)), obstacles=[Box((9, 6, 0), (10, 15, 4))])
    p = plan(world, start=(1, 10, 1.5), goal=(19, 10, 1.5), limits=Limits(speed=3, acceleration=6, jerk=60), radius=0.3)
    p.trajectory.position(1.0)

The way in is `plan.plan`; what it does is told there in one line. Underneath: `bspline` (curves), `worlds` and
`distance` (what to miss), `cost` (what is good), `seeds`, `search`, `descent`, `guide` and `lattice` (how to find it),
`enclosure` (why there is none), `families` (worlds to try it on), `certificate` and `limits` (how to prove it),
`timing`, `finer`, `intervals` and `barrier` (how fast to fly it), `trajectory` (the result), `errors` (what can go
wrong, by how much); `movers` and `among` (what moves), `replan`, `warm`, `timed` and `backup` (planning in flight);
`baselines` (HAOAROA's rivals).
`plot` draws a plan and `plot_methods` several; they are imported by their own names, since they bring matplotlib.

Frame: any Cartesian one, left- or right-handed, as long as everything is given in it; cylinders stand along its z axis.
Points are (3,), SI units throughout, time starts at 0 at the start of a trajectory. The walls of the map are solid: the
curve keeps the radius from them as from any obstacle.

The first plan of a fresh installation compiles its kernels, which takes seconds; `warm_up` does so on purpose.
"""

from planner.errors import (
    BlockedByMovers,
    EndpointError,
    GoalInCollision,
    GoalOutOfBounds,
    InfeasibleLimits,
    KnotError,
    NoPathFound,
    NoTimingFound,
    PlannerError,
    StartInCollision,
    StartOutOfBounds,
    StateBeyondLimits,
    ViaInCollision,
    ViaOutOfBounds,
)
from planner.limits import Limits
from planner.movers import MovingBox, MovingSphere
from planner.plan import METHODS, Plan, Report, plan, warm_up
from planner.replan import Replanner
from planner.trajectory import State, Trajectory
from planner.worlds import Box, Cylinder, PointCloud, Prism, Sphere, VoxelGrid, World

__all__ = [
    "METHODS",
    "BlockedByMovers",
    "Box",
    "Cylinder",
    "EndpointError",
    "GoalInCollision",
    "GoalOutOfBounds",
    "InfeasibleLimits",
    "KnotError",
    "Limits",
    "MovingBox",
    "MovingSphere",
    "NoPathFound",
    "NoTimingFound",
    "Plan",
    "PlannerError",
    "PointCloud",
    "Prism",
    "Replanner",
    "Report",
    "Sphere",
    "StartInCollision",
    "StartOutOfBounds",
    "State",
    "StateBeyondLimits",
    "Trajectory",
    "ViaInCollision",
    "ViaOutOfBounds",
    "VoxelGrid",
    "World",
    "plan",
    "warm_up",
]
