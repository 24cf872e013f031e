"""Places to look at and to fly round, by command: DO_SET_ROI_LOCATION, DO_SET_ROI_NONE, DO_SET_ROI, DO_ORBIT.

What is looked at counts in the modes that fly by themselves, until it is taken back or the mode changes. An orbit is
flown in Hold (or Guided) and ends with it.
"""

import math
from collections.abc import Mapping
from dataclasses import replace

from fakevehicle.modes import Refusal
from fakevehicle.places import Places
from fakevehicle.plans import GLOBAL_FRAMES, RELATIVE_FRAMES
from fakevehicle.services.commands import FASTEST, MAX_GOTO, SLOWEST
from fakevehicle.services.outbox import Sender
from fakevehicle.services.service import ACCEPTED, Command, CommandSpec, Service, Verdict, denied, judged
from fakevehicle.supervisor import Supervisor
from fakevehicle.vocabulary import FloatArray, Geodetic
from fakevehicle.waypoints import TURN_RADIUS
from wire.dialect import mavlink

_m = mavlink
SMALLEST, LARGEST = 1.0, 1000.0
"""Radius of an orbit [m]."""
FOR_EVER = 10_000.0
"""Turns of an orbit that is to go on; a day and more."""
_TO_CENTRE, _AS_IT_WAS = (
    (_m.ORBIT_YAW_BEHAVIOUR_HOLD_FRONT_TO_CIRCLE_CENTER,),
    (
        _m.ORBIT_YAW_BEHAVIOUR_HOLD_INITIAL_HEADING,
        _m.ORBIT_YAW_BEHAVIOUR_UNCONTROLLED,
    ),
)


class Circling(Service):
    """Commands about a place.

    Parameters
    ----------
    supervisor, places : as everywhere.
    """

    def __init__(self, supervisor: Supervisor, places: Places) -> None:
        self._supervisor = supervisor
        self._places = places

    def commands(self) -> Mapping[int, CommandSpec]:
        """In the order of their numbers."""
        return {
            _m.MAV_CMD_DO_ORBIT: CommandSpec(self._orbit, "Orbit", (1, 2, 3, 4, 5, 6, 7)),
            _m.MAV_CMD_DO_SET_ROI_LOCATION: CommandSpec(self._look_at, "Look at", (1, 5, 6, 7)),
            _m.MAV_CMD_DO_SET_ROI_NONE: CommandSpec(self._look_away, "Look away", (1,)),
            _m.MAV_CMD_DO_SET_ROI: CommandSpec(self._old_look_at, "Look at", (1, 2, 3, 5, 6, 7)),
        }

    def _look_at(self, _sender: Sender, command: Command, _now_us: int) -> Verdict:
        """The place in 5, 6 and 7; parameter 1 is the gimbal, of which there is none."""
        place_n = self._place(command)
        if not isinstance(place_n, Verdict):
            self._supervisor.look_at(place_n)
            return ACCEPTED
        return place_n

    def _look_away(self, _sender: Sender, _command: Command, _now_us: int) -> Verdict:
        self._supervisor.look_at(None)
        return ACCEPTED

    def _old_look_at(self, sender: Sender, command: Command, now_us: int) -> Verdict:
        """Parameter 1 says whether there is a place: MAV_ROI."""
        if command.params[0] == _m.MAV_ROI_NONE:
            return self._look_away(sender, command, now_us)
        if command.params[0] == _m.MAV_ROI_LOCATION:
            return self._look_at(sender, command, now_us)
        return denied(f"param1 is {command.params[0]:g}, expected 0 (nothing) or 3 (a place)")

    def _orbit(self, _sender: Sender, command: Command, now_us: int) -> Verdict:
        """Radius (below zero: counter-clockwise), speed, where the nose points, how far round [rad], and the centre.

        NaN keeps what is: 10 m, MPC_XY_CRUISE, to the centre, for ever, here, this height. The height is above sea
        level in every frame: so PX4 reads it, and so MAVSDK means it, in a frame relative to home.
        """
        radius, speed, nose, angle = command.params[:4]
        radius = TURN_RADIUS if math.isnan(radius) else radius
        if not SMALLEST <= abs(radius) <= LARGEST:
            return denied(f"param1 is {radius:g}, expected a radius of {SMALLEST:g}..{LARGEST:g} m")
        if not math.isnan(speed) and not SLOWEST <= speed <= FASTEST:
            return denied(f"param2 is {speed:g}, expected {SLOWEST:g}..{FASTEST:g} m/s")
        if not math.isnan(nose) and nose not in _TO_CENTRE + _AS_IT_WAS:
            return denied(f"param3 is {nose:g}, expected 0 (to the centre), 1 or 2")
        if math.isinf(angle):
            return denied(f"param4 is {angle:g}, expected an angle")
        frame = _m.MAV_FRAME_GLOBAL if command.frame in RELATIVE_FRAMES else command.frame
        centre_n = self._place(replace(command, frame=frame))
        if isinstance(centre_n, Verdict):
            return centre_n
        turns = FOR_EVER if math.isnan(angle) or angle == 0.0 else min(abs(angle) / (2.0 * math.pi), FOR_EVER)
        own = None if math.isnan(speed) else speed
        facing = math.isnan(nose) or nose in _TO_CENTRE
        return judged(self._supervisor.ask_orbit(now_us, centre_n, radius, own, turns, facing=facing))

    def _place(self, command: Command) -> FloatArray | Verdict:
        """The place a command names, (3,) local NED [m], what is NaN as it is here; or why there is none."""
        if command.frame not in GLOBAL_FRAMES + RELATIVE_FRAMES:
            return denied(f"frame {command.frame}, expected a global one")
        here_n, home, origin = self._supervisor.position_n, self._supervisor.home, self._places.origin
        if here_n is None or home is None or origin is None:
            return judged(Refusal.NO_POSITION)
        place_n = here_n.copy()
        latitude, longitude, altitude = command.latitude_deg, command.longitude_deg, command.params[4]
        if not (math.isnan(latitude) or math.isnan(longitude)):
            if not (abs(latitude) <= 90.0 and abs(longitude) <= 180.0):
                return denied(f"latitude {latitude}, longitude {longitude}: not on the globe")
            local_n = self._places.local(Geodetic(math.radians(latitude), math.radians(longitude), origin.altitude))
            if local_n is None:
                return judged(Refusal.NO_POSITION)
            place_n[:2] = local_n[:2]
        if math.isfinite(altitude):
            base = float(home.position_n[2]) if command.frame in RELATIVE_FRAMES else origin.altitude
            place_n[2] = base - altitude
        away = math.dist(place_n, here_n)
        return place_n if away <= MAX_GOTO else denied(f"{away / 1000:.1f} km away, expected {MAX_GOTO / 1000:g} km")
