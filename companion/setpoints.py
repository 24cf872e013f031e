"""The stream of setpoints: only sound references leave, and the last sound place is held instead of others.

A reference that is sound by itself is not when it is farther from the one before than a vehicle can have come since:
whatever computed it, nobody has proved the straight way there. It is withheld, too, until a way is planned (`jump`).
"""

from typing import Any

import numpy as np

from companion.mission import Mission
from companion.offboard import SPARE, flaw, setpoint_message
from companion.seam import FloatArray, Level, Note, Reference

JUMP_M = 0.1
"""Less is no jump: so near a place the vehicle needs no way to it."""


class SetpointStream:
    """What was asked of the vehicle last.

    Parameters
    ----------
    mission : whose fence and limits no setpoint leaves.

    Attributes
    ----------
    reference : the last that was sent; None before the first.
    jump : why the way to the next must be planned first; empty otherwise.
    """

    def __init__(self, mission: Mission) -> None:
        limits = mission.limits
        self.fence = mission.geofence()
        self._fastest = max(limits.speed, limits.climb, *(step.speed or 0.0 for step in mission.steps))
        self._acceleration = limits.acceleration
        self._withheld = self.jump = ""
        self._sent_us = 0  # on the flight's clock
        self.reference: Reference | None = None

    @property
    def fence_m(self) -> float | None:
        """How far inside the fence's margin the last reference is [m]; None without a fence or a reference."""
        if self.fence is None or self.reference is None:
            return None
        return self.fence.inside(self.reference.position_m) - self.fence.margin

    def error_m(self, position_m: FloatArray) -> float:
        """Distance of a place from the last reference [m]; 0 before there was one."""
        return 0.0 if self.reference is None else float(np.linalg.norm(position_m - self.reference.position_m))

    def next(
        self, wanted: Reference, flight_us: int, anew: bool, origin_n: FloatArray, time_boot_ms: int, target: int
    ) -> tuple[Any, list[Note]]:
        """The setpoint of this tick, or None when there is nothing sound to send, and what is to be told.

        Parameters
        ----------
        wanted : where the vehicle should be, in the mission frame.
        flight_us : the time at which.
        anew : it is where the vehicle is, and need not follow from the one before.
        origin_n : (3,) that frame's origin in the vehicle's local frame [m].
        time_boot_ms, target : as in `offboard.setpoint_message`.
        """
        found, told, sound = flaw(wanted, self.fence, self._fastest, self._acceleration), list[Note](), wanted
        self.jump = "" if found or anew else self._jump(wanted, flight_us)
        found = found or self.jump
        if found:
            if found != self._withheld and not (self.jump and self._withheld):  # one of many, told already
                told.append(Note(Level.ERROR, f"a setpoint is withheld: {found}; the last place before it is held"))
            last = self.reference
            if last is None:
                self._withheld = found
                return None, told
            sound = Reference(last.position_m, np.zeros(3), np.zeros(3), last.yaw)
        self._withheld = found
        message = setpoint_message(sound, origin_n, time_boot_ms, target)
        if message is not None:
            self.reference, self._sent_us = sound, flight_us
        return message, told

    def _jump(self, wanted: Reference, flight_us: int) -> str:
        """How far a reference is from the one before, if no vehicle can have come so far since."""
        away_m = self.error_m(wanted.position_m)
        seconds = max(flight_us - self._sent_us, 0) / 1e6
        return f"the next is {away_m:.1f} m away" if away_m > JUMP_M + SPARE * self._fastest * seconds else ""
