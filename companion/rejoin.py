"""Back to the mission from wherever the vehicle is: hold there, plan a way to where the mission waits, fly it.

    begin()  settle() ...  wanted()  take(plan)  go()  reference() ... until it is not under_way()

Until the vehicle obeys, the point to hold is where it says it is; then it is where it can come to rest. Once it stands
there, a way is planned through the mission's world, from rest to rest. Everything is in the mission frame (NED).
"""

import numpy as np

from companion.hooks import Pose
from companion.mission import Mission
from companion.seam import FloatArray, Flown, PlanReady, PlanWanted, Reference, Vector

REQUESTS = 2_000_000
"""Plans of ways back are numbered from here; steps and errands have lower numbers."""
SLOW = 0.5
"""[m/s]"""
BRAKING = 4.0
"""[m/s^2], if the mission allows it."""
NEAR = 0.5
"""A vehicle that stands farther from where it was to stop stays where it stands [m]."""
SAME_PLACE = 0.05
"""No way is needed to a place nearer than this [m]."""
AT_REST = 1e-3
"""[m/s]"""


class Rejoin:
    """Attributes
    ----------
    ready : there is a way back, or none is needed.
    refusal : why there is none; empty otherwise.
    """

    def __init__(self, mission: Mission, seed: int) -> None:
        self._mission, self._seed = mission, seed
        self._here: FloatArray = np.zeros(3)
        self._fixed = False
        self._braking = min(BRAKING, mission.planner_limits().acceleration)
        self._asked: PlanWanted | None = None
        self._requests = 0
        self._way: Flown | None = None
        self.ready = False
        self.refusal = ""

    def begin(self, pose: Pose) -> None:
        """Hold where the vehicle is."""
        self._here, self._asked, self._way = pose.position_m, None, None
        self._fixed = False
        self.ready, self.refusal = False, ""

    def settle(self, pose: Pose, obeys: bool) -> bool:
        """Once a tick: whether the vehicle stands where it holds; `obeys`: it follows our setpoints."""
        if self._asked is not None or self.ready:
            return True
        speed = float(np.linalg.norm(pose.velocity_m))
        slow = speed <= SLOW
        if not obeys:
            self._here, self._fixed = pose.position_m, False
        elif not self._fixed:
            self._here = pose.position_m + pose.velocity_m * (speed / (2.0 * self._braking))
            self._fixed = True
        elif slow and float(np.linalg.norm(pose.position_m - self._here)) > NEAR:
            self._here = pose.position_m
        return obeys and slow

    def wanted(self, target: Reference) -> PlanWanted | None:
        """The plan of a way to where the mission waits, if it is time to ask for it; only once it stands."""
        if self._asked is not None or self.ready:
            return None
        if float(np.linalg.norm(target.velocity_m)) > AT_REST:
            return None  # it still comes to rest
        if float(np.linalg.norm(target.position_m - self._here)) < SAME_PLACE:
            self.ready = True
            return None
        self._requests += 1
        self._asked = PlanWanted(
            request_id=REQUESTS + self._requests,
            start_m=_vector(self._here),
            goal_m=_vector(target.position_m),
            limits=self._mission.planner_limits(),
            radius=self._mission.planner_radius(),
            seed=self._seed,
            method=self._mission.method,
        )
        return self._asked

    def take(self, ready: PlanReady) -> bool:
        """An answer; False when it is to something else."""
        if self._asked is None or ready.request_id != self._asked.request_id:
            return False
        if ready.trajectory is None or not ready.certified:
            self.refusal = ready.text or ready.error or "not certified"
        else:
            self._way, self.ready = Flown(ready.trajectory, 0), True
        return True

    def go(self, flight_us: int) -> None:
        """Set out."""
        if self._way is not None:
            self._way = Flown(self._way.trajectory, flight_us)

    def under_way(self, flight_us: int) -> bool:
        """Whether the way back is being flown."""
        way = self._way
        return way is not None and flight_us < way.start_us + round(way.trajectory.duration * 1e6)

    def hold(self, yaw: float) -> Reference:
        """At rest where the vehicle is, or was when it began to obey."""
        return Reference(self._here, np.zeros(3), np.zeros(3), yaw)

    def reference(self, flight_us: int, yaw: float) -> Reference:
        """Where it should be on the way back."""
        assert self._way is not None
        state = self._way.trajectory.state((flight_us - self._way.start_us) / 1e6)
        return Reference(state.position, state.velocity, state.acceleration, yaw)


def _vector(a: FloatArray) -> Vector:
    return (float(a[0]), float(a[1]), float(a[2]))
