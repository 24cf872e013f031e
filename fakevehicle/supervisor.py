"""Who may do what, and what is flown now: the modes' tables brought to life.

`Supervisor.ask` is how peers' wishes come in; `Supervisor.look` notices at 50 Hz what happened; `Supervisor.setpoint`
turns the mode into one setpoint a tick. Everything is judged on the estimate. What people should know comes out in
`notes`, as (MAV_SEVERITY, text). Where the automatic modes fly is the navigator's business, what a failsafe does the
failsafe table's, and what either means for the mode the modes' table's.
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from fakevehicle import course, failsafes, fence, flip, mission_check, mission_runner, navigator, setpoint_stream
from fakevehicle.failsafes import EVENTS, Action, Failsafes, Trigger, Tripped, battery_triggers
from fakevehicle.fence import FenceMonitor
from fakevehicle.flip import FlipDetector
from fakevehicle.landing import LandDetector
from fakevehicle.mission_check import MissionCheck
from fakevehicle.mission_runner import MissionRunner
from fakevehicle.modes import TRANSITIONS, Conditions, Event, Mode, Refusal, Special, refusal
from fakevehicle.navigator import ARRIVED, Navigator
from fakevehicle.params import Parameter, ParameterSet, ParameterType
from fakevehicle.places import Places
from fakevehicle.plans import PlanStore
from fakevehicle.setpoint_stream import SetpointStream
from fakevehicle.vocabulary import FloatArray, Glance, Setpoint
from fakevehicle.waypoints import ring_of

CRITICAL, WARNING, INFO = 2, 4, 6

_I = ParameterType.INT32
PARAMETERS: tuple[Parameter, ...] = (
    *course.PARAMETERS,
    *navigator.PARAMETERS,
    *mission_check.PARAMETERS,
    *mission_runner.PARAMETERS,
    *fence.PARAMETERS,
    *failsafes.PARAMETERS,
    *flip.PARAMETERS,
    *setpoint_stream.PARAMETERS,
    Parameter("COM_DISARM_LAND", 2.0, -1.0, 20.0, "s", "Disarm this long after a landing; not above 0: never"),
    Parameter("COM_DISARM_PRFLT", 10.0, -1.0, 60.0, "s", "Disarm when nobody takes off; not above 0: never"),
)

_FLY_BLIND = (Mode.LAND, Mode.STABILIZED, Mode.ALTITUDE)
"""Modes that a lost position does not end."""


@dataclass(frozen=True, slots=True)
class Home:
    """Where a return ends: position in the estimator's frame (3,) [m], and the heading there [rad]."""

    position_n: FloatArray
    yaw: float


class Supervisor:
    """Mode, arming and landing of one vehicle.

    Parameters
    ----------
    parameters : the vehicle's.
    store : the plans that are loaded.
    places : turns places into points.
    hover : collective thrust of a hover, 0..1 of the maximum.

    Attributes
    ----------
    mode : what is flown.
    intended : what was asked for; differs from `mode` only in a failsafe.
    armed, failsafe : as they sound.
    home : None until the estimate is good; taken again at every arming, as PX4 does, unless somebody has set it.
    notes : texts for people since somebody last emptied the list.
    entered : counts mode changes and armings, so that the loops can be told to begin anew.
    remaining : charge of the battery, 0..1; told by the vehicle.
    navigator, fence : where automatic modes fly, and where nobody may.
    """

    def __init__(self, parameters: ParameterSet, store: PlanStore, places: Places, hover: float) -> None:
        self._parameters = parameters
        self._store = store
        self.navigator = Navigator(store, parameters, places)
        self.fence = FenceMonitor(store, parameters, places)
        self._check = MissionCheck(store, parameters, places, self.fence)
        self._failsafes = Failsafes(parameters)
        self.mode = Mode.HOLD
        self.intended = Mode.HOLD
        self.armed = False
        self.failsafe = False
        self.home: Home | None = None
        self._home_set = False  # by somebody
        self.notes: list[tuple[int, str]] = []
        self.entered = 0
        self.remaining = 1.0
        self._glance: Glance | None = None
        self._ground = LandDetector(hover)
        self._flip = FlipDetector(parameters)
        self._flown = False  # since it was armed
        self._changed_us = 0  # when it was armed or last stood down
        self._stream = SetpointStream(parameters, hover)
        self._stream_lost = False  # a lost stream has led to this mode
        self._station_us: int | None = None  # newest heartbeat of a ground station
        self._position_us: int | None = None  # when position was good last, since it was armed

    @property
    def airborne(self) -> bool:
        """Whether it flies, by its own judgement."""
        return self._ground.airborne

    @property
    def landing(self) -> bool:
        """Whether it is on its way to the ground by itself."""
        return self.airborne and (self.mode is Mode.LAND or self.navigator.descending)

    @property
    def taking_off(self) -> bool:
        """Whether it climbs to the height of a takeoff."""
        return self.mode is Mode.TAKEOFF or self.navigator.climbing

    @property
    def battery_good(self) -> bool:
        """Whether the charge is enough to arm with."""
        return self.remaining >= self._parameters["BAT_CRIT_THR"]

    @property
    def runner(self) -> MissionRunner:
        """The mission's progress."""
        return self.navigator.runner

    @property
    def position_n(self) -> FloatArray | None:
        """Where it believes to be, (3,) local NED [m]; None while it does not know."""
        g = self._glance
        return np.array([g.x, g.y, g.z]) if g is not None and g.position_valid else None

    @property
    def yaw(self) -> float | None:
        """Heading [rad]; None while it does not know."""
        return self._glance.yaw if self._glance is not None and self._glance.attitude_valid else None

    @property
    def asked(self) -> Setpoint | None:
        """The newest setpoint of a peer; None when something else has taken its place."""
        return self._stream.newest

    def conditions(self, now_us: int) -> Conditions:
        """What the guards look at, now."""
        g = self._glance
        return Conditions(
            armed=self.armed,
            airborne=self.airborne,
            attitude_valid=g is not None and g.attitude_valid,
            velocity_valid=g is not None and g.velocity_valid,
            position_valid=g is not None and g.position_valid,
            altitude_valid=g is not None and g.altitude_valid,
            home_known=self.home is not None,
            setpoints_fresh=self.setpoints_fresh(now_us),
            mode=self.mode,
            mission_loaded=bool(self._store.mission),
            battery_good=self.battery_good,
            fence_kept=self.fence.breach is None,
            upright=not self._flip.fallen,
        )

    def setpoints_fresh(self, now_us: int) -> bool:
        """Whether an OFFBOARD setpoint came within COM_OF_LOSS_T."""
        return self._stream.fresh(now_us)

    def why_not_armable(self, now_us: int) -> Refusal | None:
        """The reason arming would be refused, None when it would not: the PREARM bit of SYS_STATUS."""
        return refusal(Event.ASK_ARM, self.conditions(now_us))

    def why_mission_unfit(self) -> Refusal | None:
        """Why the mission that is loaded cannot be flown from this home, None when it can."""
        return None if self.home is None else self._check.refusal(self.home.position_n)

    def why_not_startable(self, now_us: int) -> Refusal | None:
        """Why the mission cannot be begun now, armed for it if need be; None when it can."""
        conditions = self.conditions(now_us)
        reason = refusal(Event.ASK_MISSION, conditions) or self.why_mission_unfit()
        if reason is None and not self.armed:
            reason = refusal(Event.ASK_ARM, replace(conditions, mode=Mode.MISSION))
        return reason

    # What peers ask for

    def ask(self, event: Event, now_us: int) -> Refusal | None:
        """A peer's wish. None: done (or already so). Otherwise the reason why not, and nothing has changed."""
        if (event is Event.ASK_ARM and self.armed) or (event in (Event.ASK_DISARM, Event.ASK_KILL) and not self.armed):
            return None
        reason = refusal(event, self.conditions(now_us))
        if reason is not None:
            return reason
        if event is Event.ASK_MISSION or (event is Event.ASK_ARM and self.mode is Mode.MISSION):
            unfit = self.why_mission_unfit()
            if unfit is not None:
                return unfit
        match event:
            case Event.ASK_ARM:
                self._arm(now_us)
            case Event.ASK_DISARM:
                self._disarm(now_us, "external command")
            case Event.ASK_KILL:
                self._disarm(now_us, "external command, by force")
            case _:
                outcome = TRANSITIONS[event][self.mode]
                if isinstance(outcome, Mode):
                    self.failsafe = self._stream_lost = False
                    self.intended = outcome
                    self._enter(outcome)
        return None

    def ask_takeoff(self, now_us: int, z: float | None) -> Refusal | None:
        """Take off to a down coordinate [m], or to MIS_TAKEOFF_ALT above the ground when it is None."""
        if z is not None and self._glance is not None and z > self._glance.z - ARRIVED:
            return Refusal.BELOW
        if self.mode is Mode.GUIDED and (not self.armed or self.airborne):
            return Refusal.NOT_LANDED if self.armed else Refusal.NOT_ARMED
        flying = self.armed and self.airborne
        reason = self.ask(Event.ASK_TAKEOFF, now_us)
        if reason is None:
            if flying:
                self.notes.append((INFO, "Takeoff in flight: climbs from here, never sinks"))
            self.navigator.takeoff_z = z
            if self.mode is Mode.GUIDED:
                self._stream.newest = None
                self.navigator.take_off(now_us, z, None if self.home is None else self.home.position_n)
        return reason

    def ask_goto(self, now_us: int, position_n: FloatArray, yaw: float, speed: float | None = None) -> Refusal | None:
        """Fly to a point and hold there; (3,) [m], yaw [rad] or NaN for the present one, speed [m/s] or None."""
        if self._leaves([position_n]):
            return Refusal.OUTSIDE_FENCE
        reason = self.ask(Event.ASK_GOTO, now_us)
        if reason is None:
            if self.mode is Mode.GUIDED:
                self._stream.newest = None
            self.navigator.go_to(now_us, position_n, yaw, speed)
        return reason

    def ask_orbit(
        self, now_us: int, centre_n: FloatArray, radius: float, speed: float | None, turns: float, *, facing: bool
    ) -> Refusal | None:
        """Fly circles about a point, as `Navigator.orbit` has it, and hold where they end."""
        if self._leaves(ring_of(centre_n, abs(radius))):
            return Refusal.OUTSIDE_FENCE
        reason = self.ask(Event.ASK_GOTO, now_us)
        if reason is None:
            if self.mode is Mode.GUIDED:
                self._stream.newest = None
            self.navigator.orbit(now_us, centre_n, radius, speed, turns, facing=facing)
        return reason

    def look_at(self, place_n: FloatArray | None) -> None:
        """Point the nose at a place, (3,) [m], in the modes that fly by themselves, until the mode changes."""
        self.navigator.look_at(place_n)

    def _leaves(self, points: list[FloatArray]) -> bool:
        """Whether the fence keeps from one of some points, (3,) [m] each."""
        home = self.home
        if home is None or not self.fence.holding:
            return False
        return any(self.fence.breach_at(n, home.position_n) is not None for n in points)

    def ask_speed(self, speed: float | None) -> None:
        """Fly automatic modes at another speed over ground [m/s] until the mode changes; None: MPC_XY_CRUISE again."""
        self.navigator.course.cruise = speed

    def ask_home(self, position_n: FloatArray | None, yaw: float) -> Refusal | None:
        """Put home to a point (3,) [m], or to where the vehicle is; yaw [rad], NaN: the vehicle's."""
        here_n = self.position_n
        if here_n is None or self._glance is None:
            return Refusal.NO_POSITION
        yaw = self._glance.yaw if math.isnan(yaw) else yaw
        self.home = Home(here_n if position_n is None else position_n, yaw)
        self._home_set = position_n is not None
        return None

    def offboard(self, now_us: int, setpoint: Setpoint) -> None:
        """A setpoint from a peer. It is flown in OFFBOARD and GUIDED only, but keeps the stream fresh in any mode."""
        self._stream.take(now_us, setpoint)

    def ground_station(self, now_us: int) -> None:
        """A heartbeat of a ground station: the data link stands."""
        self._station_us = now_us

    # What happens by itself

    def look(self, now_us: int, glance: Glance) -> None:
        """Notice what happened since the last look; to be called at 50 Hz.

        Parameters
        ----------
        now_us : [us].
        glance : the estimate's newest.
        """
        self._glance = glance
        if self.home is None and glance.position_valid and glance.altitude_valid:
            self._take_home(glance)
        self._flip.step(now_us, glance)
        was_airborne = self.airborne
        self._ground.step(now_us, glance, self.armed, self._sinking(glance))
        if self.airborne is not was_airborne:
            self._changed_us = now_us
            self._flown = self._flown or self.airborne
            self._stream.settle()
            self.notes.append((INFO, "Takeoff detected" if self.airborne else "Landing detected"))
        if self.home is not None and glance.position_valid:
            self.fence.step(now_us, np.array([glance.x, glance.y, glance.z]), self.home.position_n)
        if glance.position_valid:
            self._position_us = now_us
        for tripped in self._failsafes.step(self._triggers(now_us, glance)):
            self._trip(tripped, now_us)
        if self.armed:
            back = self.setpoints_fresh(now_us) and (self.airborne or not self._flown)
            if self._stream_lost and back:
                self._notice(Event.STREAM_BACK)
            self._watch_ground(now_us)

    def setpoint(self, now_us: int) -> Setpoint | None:
        """Where to fly in this tick. None: motors at rest, or idling when armed, as when it touches the ground."""
        if not self.armed or self._glance is None or self._ground.touching:
            return None
        if self.mode is Mode.OFFBOARD:
            return self._stream.offboard(now_us, self._glance.z, self.airborne)
        if self.mode is Mode.GUIDED and self.airborne and not self.navigator.climbing:
            flying, asked = self._stream.newest is not None, self._stream.guided(now_us)
            if asked is not None:
                return asked
            if flying:  # until now: it has grown too old
                self.navigator.course.stop(self._glance, moving=True)
        home_n = self.navigator.course.anchor_n if self.home is None else self.home.position_n
        flown = self.navigator.setpoint(self.mode, now_us, self._glance, self.airborne, self._flown, home_n)
        if self.runner.notes:
            self.notes += [(INFO, text) for text in self.runner.notes]
            self.runner.notes.clear()
        if isinstance(flown, Event):
            self._notice(flown)
            return self.navigator.course.setpoint(now_us) if self.airborne else None
        return flown

    def _sinking(self, glance: Glance) -> bool:
        """Whether what is flown now leads downwards."""
        if self.mode is Mode.OFFBOARD:
            return self._stream.sinks(glance.z)
        return self.landing

    def _triggers(self, now_us: int, glance: Glance) -> list[Trigger]:
        """What is wrong now; nothing is while it is disarmed, but a battery."""
        triggers = list(battery_triggers(self.remaining, self._parameters))
        if not self.armed:
            return triggers
        if self._flip.fallen:
            flown_s = (now_us - self._changed_us) * 1e-6 if self.airborne else 0.0
            leaving = flown_s <= self._parameters["COM_LKDOWN_TKO"]
            triggers.append(Trigger.FALLEN_AT_TAKEOFF if leaving else Trigger.FALLEN)
        offboard = self.mode is Mode.OFFBOARD or self._stream_lost
        if offboard and not self.setpoints_fresh(now_us):
            triggers.append(Trigger.STREAM_LOST)
        if self.mode is Mode.MISSION and self.why_mission_unfit() is not None:
            triggers.append(Trigger.MISSION_UNFIT)
        if not self.airborne:
            return triggers
        silent_s = 0.0 if self._station_us is None else (now_us - self._station_us) * 1e-6
        if silent_s > self._parameters["COM_DL_LOSS_T"]:
            triggers.append(Trigger.LINK_LOST)
        blind = self.mode in _FLY_BLIND or (self.mode is Mode.OFFBOARD and self._stream.by_thrust)
        blind_s = 0.0 if self._position_us is None else (now_us - self._position_us) * 1e-6
        if blind_s > self._parameters["COM_POS_FS_DELAY"] and not blind:
            triggers.append(Trigger.POSITION_LOST)
        if self.fence.breach is not None:
            triggers.append(Trigger.FENCE_BREACHED)
        return triggers

    def _trip(self, tripped: Tripped, now_us: int) -> None:
        """Do what a failsafe wants: what was asked for stays what is intended."""
        why, action = tripped.trigger.value, tripped.action
        unfit = self.why_mission_unfit() if tripped.trigger is Trigger.MISSION_UNFIT else None
        if unfit is not None:
            why = f"{why}, {unfit.value}"
        if action is Action.WARN or not self.armed:
            self.notes.append((WARNING, f"{why[0].upper()}{why[1:]}"))
            return
        if action is Action.MOTORS_OFF:
            self.notes.append((CRITICAL, f"Failsafe activated: {why}, motors off"))
            self._disarm(now_us, "failsafe")
            return
        if self._glance is not None and not self._glance.position_valid:
            action = Action.LAND
        outcome = TRANSITIONS[EVENTS[action]][self.mode]
        if isinstance(outcome, Mode):
            self.failsafe = True
            self._stream_lost = tripped.trigger is Trigger.STREAM_LOST
            self.notes.append((CRITICAL, f"Failsafe activated: {why}, {outcome.title}"))
            self._enter(outcome)

    def _watch_ground(self, now_us: int) -> None:
        """Stop the motors of a vehicle that stands for long enough."""
        if self.airborne:
            return
        stood_s = (now_us - self._changed_us) * 1e-6
        name, text = ("COM_DISARM_LAND", "landing") if self._flown else ("COM_DISARM_PRFLT", "preflight disarming")
        patience_s = self._parameters[name]
        if 0 < patience_s <= stood_s:
            self._disarm(now_us, text)

    def _notice(self, event: Event) -> None:
        """An event of the vehicle's own; the table says what follows."""
        outcome = TRANSITIONS[event][self.mode]
        if outcome is Special.RESUME:
            self.failsafe = self._stream_lost = False
            self.notes.append((INFO, "Setpoints are back: Offboard"))
            self._enter(self.intended)
        elif isinstance(outcome, Mode):
            arrived_n = self.navigator.course.anchor_n
            self.intended = outcome
            self.failsafe = self._stream_lost = False
            self._enter(outcome)
            if self.airborne and outcome is Mode.HOLD:
                self.navigator.course.anchor_n = arrived_n  # where the way ended, not where noise has it

    def _take_home(self, glance: Glance) -> None:
        self.home = Home(np.array([glance.x, glance.y, glance.z]), glance.yaw)

    def _arm(self, now_us: int) -> None:
        self.armed = True
        self._flown = False
        self._position_us = None
        self._changed_us = now_us
        self.notes.append((INFO, "Armed by external command"))
        if self._glance is not None and not self._home_set:
            self._take_home(self._glance)
        self._enter(self.mode)

    def _disarm(self, now_us: int, why: str) -> None:
        self.armed = False
        self.notes.append((INFO, f"Disarmed by {why}"))
        self._notice(Event.DISARMED)

    # What is flown

    def _enter(self, mode: Mode) -> None:
        """Begin a mode."""
        self.mode = mode
        self.entered += 1
        self._stream.settle()
        self.navigator.begin(mode, self._glance, self.airborne)
