"""Who may do what, and what is flown now: the modes' tables brought to life.

`Supervisor.ask` is how peers' wishes come in; `Supervisor.look` notices at 50 Hz what happened; `Supervisor.setpoint`
turns the mode into one setpoint a tick. Everything is judged on the estimate. What people should know comes out in
`notes`, as (MAV_SEVERITY, text).
"""

import math
from dataclasses import dataclass

import numpy as np

from fakevehicle.guidance import (
    Leg,
    asks_to_climb,
    asks_to_sink,
    completed,
    descent,
    landing_speed,
    return_height,
    still,
    stopping_point,
    yaw_of,
)
from fakevehicle.landing import LandDetector
from fakevehicle.modes import TRANSITIONS, Conditions, Event, Mode, Refusal, Special, refusal
from fakevehicle.params import Parameter, ParameterSet, ParameterType
from fakevehicle.vocabulary import Estimate, FloatArray, Setpoint

CRITICAL, WARNING, INFO = 2, 4, 6
LIFT_PATIENCE_US = 2_000_000
"""A standing vehicle in OFFBOARD keeps its motors flying this long after the last setpoint that asked to climb."""
ARRIVED = 0.3
"""Height error [m] within which a takeoff is done."""
RETURN_ARRIVED = 2.0
"""Distance [m] from the end of a return's leg at which the next one begins."""
TAKEOFF_PATIENCE_S = 3.0
"""A takeoff that ends this long after its leg, wherever it got to [s]."""

_I = ParameterType.INT32
PARAMETERS: tuple[Parameter, ...] = (
    Parameter("MIS_TAKEOFF_ALT", 2.5, 0.5, 100.0, "m", "Height of a takeoff for which no altitude is given"),
    Parameter("MPC_TKO_SPEED", 1.5, 0.3, 5.0, "m/s", "Climb rate of a takeoff"),
    Parameter("MPC_LAND_SPEED", 0.7, 0.3, 3.0, "m/s", "Sink rate of a landing below 5 m"),
    Parameter("MPC_Z_V_AUTO_DN", 1.5, 0.5, 4.0, "m/s", "Sink rate of automatic modes"),
    Parameter("MPC_Z_V_AUTO_UP", 3.0, 0.5, 8.0, "m/s", "Climb rate of automatic modes"),
    Parameter("MPC_XY_CRUISE", 5.0, 1.0, 15.0, "m/s", "Speed of automatic modes over ground"),
    Parameter("MPC_ACC_HOR", 3.0, 1.0, 8.0, "m/s^2", "Acceleration of automatic modes"),
    Parameter("RTL_RETURN_ALT", 30.0, 0.0, 150.0, "m", "Highest height above home of a return"),
    Parameter("COM_OF_LOSS_T", 1.0, 0.1, 60.0, "s", "Setpoints missing for this long end OFFBOARD"),
    Parameter("COM_OBL_RC_ACT", 5, 3, 5, "", "What follows then: 3 return, 4 land, 5 hold", _I),
    Parameter("COM_DISARM_LAND", 2.0, -1.0, 20.0, "s", "Disarm this long after a landing; not above 0: never"),
    Parameter("COM_DISARM_PRFLT", 10.0, -1.0, 60.0, "s", "Disarm when nobody takes off; not above 0: never"),
)

_STREAM_LOST = {3: Event.FAIL_RTL, 4: Event.FAIL_LAND, 5: Event.FAIL_HOLD}


@dataclass(frozen=True, slots=True)
class Home:
    """Where a return ends: position in the estimator's frame (3,) [m], and the heading there [rad]."""

    position_n: FloatArray
    yaw: float


class Supervisor:
    """Mode, arming and landing of one vehicle.

    Attributes
    ----------
    mode : what is flown.
    intended : what was asked for; differs from `mode` only in a failsafe.
    armed, failsafe : as they sound.
    home : None until the estimate is good; taken again at every arming, as PX4 does.
    notes : texts for people since somebody last emptied the list.
    entered : counts mode changes and armings, so that the loops can be told to begin anew.
    """

    def __init__(self, parameters: ParameterSet) -> None:
        self._parameters = parameters
        self.mode = Mode.HOLD
        self.intended = Mode.HOLD
        self.armed = False
        self.failsafe = False
        self.home: Home | None = None
        self.notes: list[tuple[int, str]] = []
        self.entered = 0
        self._estimate: Estimate | None = None
        self._ground = LandDetector()
        self._flown = False  # since it was armed
        self._changed_us = 0  # when it was armed or last stood down
        self._asked: Setpoint | None = None  # newest OFFBOARD setpoint
        self._asked_us = 0
        self._climb_us: int | None = None  # newest OFFBOARD setpoint that asked a standing vehicle to climb
        self._anchor_n: FloatArray = np.zeros(3)
        self._yaw = 0.0
        self._leg: Leg | None = None
        self._takeoff_z: float | None = None
        self._descending = False  # RTL has arrived over home

    @property
    def airborne(self) -> bool:
        """Whether it flies, by its own judgement."""
        return self._ground.airborne

    @property
    def landing(self) -> bool:
        """Whether it is on its way to the ground by itself."""
        return self.airborne and (self.mode is Mode.LAND or (self.mode is Mode.RTL and self._descending))

    @property
    def position_n(self) -> FloatArray | None:
        """Where it believes to be, (3,) local NED [m]; None while it does not know."""
        return self._estimate.position_n if self._estimate is not None and self._estimate.position_valid else None

    @property
    def attitude_q_nb(self) -> FloatArray | None:
        """(4,) wxyz; None while it does not know."""
        return self._estimate.q_nb if self._estimate is not None and self._estimate.attitude_valid else None

    def conditions(self, now_us: int) -> Conditions:
        """What the guards look at, now."""
        e = self._estimate
        return Conditions(
            armed=self.armed,
            airborne=self.airborne,
            attitude_valid=e is not None and e.attitude_valid,
            velocity_valid=e is not None and e.velocity_valid,
            position_valid=e is not None and e.position_valid,
            altitude_valid=e is not None and e.altitude_valid,
            home_known=self.home is not None,
            setpoints_fresh=self.setpoints_fresh(now_us),
            mode=self.mode,
        )

    def setpoints_fresh(self, now_us: int) -> bool:
        """Whether an OFFBOARD setpoint came within COM_OF_LOSS_T."""
        return self._asked is not None and now_us - self._asked_us < self._parameters["COM_OF_LOSS_T"] * 1e6

    def why_not_armable(self, now_us: int) -> Refusal | None:
        """The reason arming would be refused, None when it would not: the PREARM bit of SYS_STATUS."""
        return refusal(Event.ASK_ARM, self.conditions(now_us))

    # What peers ask for

    def ask(self, event: Event, now_us: int) -> Refusal | None:
        """A peer's wish. None: done (or already so). Otherwise the reason why not, and nothing has changed."""
        if (event is Event.ASK_ARM and self.armed) or (event in (Event.ASK_DISARM, Event.ASK_KILL) and not self.armed):
            return None
        reason = refusal(event, self.conditions(now_us))
        if reason is not None:
            return reason
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
                    self.failsafe = False
                    self.intended = outcome
                    self._enter(outcome, now_us)
        return None

    def ask_takeoff(self, now_us: int, z: float | None) -> Refusal | None:
        """Take off to a down coordinate [m], or to MIS_TAKEOFF_ALT above the ground when it is None."""
        estimate = self._estimate
        if z is not None and estimate is not None and z > float(estimate.position_n[2]) - ARRIVED:
            return Refusal.BELOW
        reason = self.ask(Event.ASK_TAKEOFF, now_us)
        if reason is None:
            self._takeoff_z = z
        return reason

    def ask_goto(self, now_us: int, position_n: FloatArray, yaw: float) -> Refusal | None:
        """Fly to a point and hold there; (3,) [m], yaw [rad] or NaN for the present one."""
        reason = self.ask(Event.ASK_GOTO, now_us)
        if reason is None:
            self._leg = self._leg_to(now_us, position_n)
            self._yaw = self._yaw if math.isnan(yaw) else yaw
        return reason

    def offboard(self, now_us: int, setpoint: Setpoint) -> None:
        """A setpoint from a peer. It is flown in OFFBOARD only, but keeps the stream fresh in any mode."""
        self._asked = completed(setpoint)
        self._asked_us = now_us

    # What happens by itself

    def look(self, now_us: int, estimate: Estimate, thrust: float) -> None:
        """Notice what happened since the last look; to be called at 50 Hz.

        Parameters
        ----------
        now_us : [us].
        estimate : the estimator's newest.
        thrust : collective the loops command now, 0..1.
        """
        self._estimate = estimate
        if self.home is None and estimate.position_valid and estimate.altitude_valid:
            self.home = Home(estimate.position_n.copy(), yaw_of(estimate.q_nb))
        was_airborne = self.airborne
        self._ground.step(now_us, estimate, thrust, self.armed, self._sinking(estimate))
        if self.airborne is not was_airborne:
            self._changed_us = now_us
            self._flown = self._flown or self.airborne
            self._climb_us = None
            self.notes.append((INFO, "Takeoff detected" if self.airborne else "Landing detected"))
        if self.armed:
            self._watch_stream(now_us)
            self._watch_ground(now_us)

    def setpoint(self, now_us: int) -> Setpoint | None:
        """Where to fly in this tick. None: motors at rest, or idling when armed, as when it touches the ground."""
        if not self.armed or self._estimate is None or self._ground.touching:
            return None
        return self._setpoint(now_us, self._estimate)

    def _sinking(self, estimate: Estimate) -> bool:
        """Whether what is flown now leads downwards."""
        if self.mode is Mode.OFFBOARD:
            return self._asked is not None and asks_to_sink(self._asked, float(estimate.position_n[2]))
        return self.landing

    def _watch_stream(self, now_us: int) -> None:
        """Lose OFFBOARD when the setpoints stop, and regain it when they return."""
        if self.mode is Mode.OFFBOARD:
            if not self.setpoints_fresh(now_us):
                self._fail(_STREAM_LOST[int(self._parameters["COM_OBL_RC_ACT"])], "setpoints stopped", now_us)
        elif self.failsafe and self.setpoints_fresh(now_us) and (self.airborne or not self._flown):
            self._notice(Event.STREAM_BACK, now_us)

    def _watch_ground(self, now_us: int) -> None:
        """Stop the motors of a vehicle that stands for long enough."""
        if self.airborne:
            return
        stood_s = (now_us - self._changed_us) * 1e-6
        name, text = ("COM_DISARM_LAND", "landing") if self._flown else ("COM_DISARM_PRFLT", "preflight disarming")
        patience_s = self._parameters[name]
        if 0 < patience_s <= stood_s:
            self._disarm(now_us, text)

    def _notice(self, event: Event, now_us: int) -> None:
        """An event of the vehicle's own; the table says what follows."""
        outcome = TRANSITIONS[event][self.mode]
        if outcome is Special.RESUME:
            self.failsafe = False
            self.notes.append((INFO, "Setpoints are back: Offboard"))
            self._enter(self.intended, now_us)
        elif isinstance(outcome, Mode):
            self.intended = outcome
            self.failsafe = False
            self._enter(outcome, now_us)

    def _fail(self, event: Event, why: str, now_us: int) -> None:
        """A failsafe's wish: what was asked for stays what is intended."""
        outcome = TRANSITIONS[event][self.mode]
        if isinstance(outcome, Mode):
            self.failsafe = True
            self.notes.append((CRITICAL, f"Failsafe activated: {why}, {outcome.title}"))
            self._enter(outcome, now_us)

    def _arm(self, now_us: int) -> None:
        self.armed = True
        self._flown = False
        self._changed_us = now_us
        self._climb_us = None
        self.notes.append((INFO, "Armed by external command"))
        if self._estimate is not None:
            self.home = Home(self._estimate.position_n.copy(), yaw_of(self._estimate.q_nb))
        self._enter(self.mode, now_us)

    def _disarm(self, now_us: int, why: str) -> None:
        self.armed = False
        self.notes.append((INFO, f"Disarmed by {why}"))
        self._notice(Event.DISARMED, now_us)

    # Where each mode flies

    def _enter(self, mode: Mode, now_us: int) -> None:
        """Begin a mode: brake to a stop from here, unless the mode says otherwise."""
        if mode is not self.mode:
            self._takeoff_z = None
        self.mode = mode
        self.entered += 1
        self._leg = None
        self._descending = False
        self._climb_us = None
        if self._estimate is not None:
            e = self._estimate
            self._anchor_n = (
                stopping_point(e.position_n, e.velocity_n, self._parameters["MPC_ACC_HOR"])
                if self.airborne
                else e.position_n.copy()
            )
            self._yaw = yaw_of(e.q_nb)

    def _leg_to(self, now_us: int, end_n: FloatArray) -> Leg:
        """A straight leg from the anchor, within the cruise speed and the climb and sink rates."""
        p = self._parameters
        length = math.dist(self._anchor_n, end_n)
        rise = float(self._anchor_n[2] - end_n[2])
        vertical = p["MPC_Z_V_AUTO_UP"] if rise > 0.0 else p["MPC_Z_V_AUTO_DN"]
        speed = min(p["MPC_XY_CRUISE"], vertical * length / abs(rise)) if rise else p["MPC_XY_CRUISE"]
        return Leg(now_us, self._anchor_n, end_n, speed, p["MPC_ACC_HOR"])

    def _setpoint(self, now_us: int, estimate: Estimate) -> Setpoint | None:
        match self.mode:
            case Mode.OFFBOARD:
                return self._offboard_setpoint(now_us, estimate)
            case Mode.TAKEOFF:
                return self._takeoff_setpoint(now_us, estimate)
            case _ if not self.airborne:
                return None
            case Mode.LAND:
                return self._landing_setpoint(estimate)
            case Mode.RTL:
                return self._return_setpoint(now_us, estimate)
            case _:
                return self._leg.setpoint(now_us, self._yaw) if self._leg else still(self._anchor_n, self._yaw)

    def _offboard_setpoint(self, now_us: int, estimate: Estimate) -> Setpoint | None:
        """The peer's setpoint; a standing vehicle idles until one asks to climb."""
        asked = self._asked
        if asked is None or self.airborne:
            return asked
        if asks_to_climb(asked, float(estimate.position_n[2])):
            self._climb_us = now_us
        lifting = self._climb_us is not None and now_us - self._climb_us < LIFT_PATIENCE_US
        return asked if lifting else None

    def _takeoff_setpoint(self, now_us: int, estimate: Estimate) -> Setpoint | None:
        leg = self._leg
        if leg is None:
            if self._flown and not self.airborne:
                return None  # it came down again: wait to be disarmed
            z = self._takeoff_z
            if z is None:
                ground = float(self.home.position_n[2]) if self.home is not None else float(self._anchor_n[2])
                z = ground - self._parameters["MIS_TAKEOFF_ALT"]
            top = self._anchor_n.copy()
            top[2] = min(z, float(top[2]))
            leg = Leg(now_us, self._anchor_n, top, self._parameters["MPC_TKO_SPEED"], self._parameters["MPC_ACC_HOR"])
            self._leg = leg
        late_s = (now_us - leg.start_us) * 1e-6 - leg.duration_s
        if late_s >= 0.0 and self.airborne:
            arrived = abs(float(estimate.position_n[2] - leg.end_n[2])) < ARRIVED
            if arrived or late_s > TAKEOFF_PATIENCE_S:
                self._notice(Event.TAKEOFF_DONE, now_us)
                self._anchor_n = leg.end_n if arrived else self._anchor_n
                return still(self._anchor_n, self._yaw)
        return leg.setpoint(now_us, self._yaw)

    def _landing_setpoint(self, estimate: Estimate) -> Setpoint:
        ground = float(self.home.position_n[2]) if self.home is not None else 0.0
        height = ground - float(estimate.position_n[2])
        p = self._parameters
        return descent(self._anchor_n, landing_speed(height, p["MPC_LAND_SPEED"], p["MPC_Z_V_AUTO_DN"]), self._yaw)

    def _return_setpoint(self, now_us: int, estimate: Estimate) -> Setpoint:
        """Climb, fly home, sink: each leg from the end of the one before."""
        if self.home is None:  # the guards keep this away
            return self._landing_setpoint(estimate)
        if self._descending:
            return self._landing_setpoint(estimate)
        home_n = self.home.position_n
        leg = self._leg
        if leg is None:
            distance = math.dist(home_n[:2], self._anchor_n[:2])
            height = return_height(float(home_n[2] - self._anchor_n[2]), distance, self._parameters["RTL_RETURN_ALT"])
            leg = self._leg = self._leg_to(now_us, np.array([*self._anchor_n[:2], home_n[2] - height]))
        flown = now_us - leg.start_us >= leg.duration_s * 1e6
        if flown and math.dist(estimate.position_n, leg.end_n) < RETURN_ARRIVED:
            over_home = np.array([home_n[0], home_n[1], leg.end_n[2]])
            self._anchor_n = leg.end_n
            if math.dist(over_home, leg.end_n) < 1e-6:
                self._descending = True
                return self._landing_setpoint(estimate)
            leg = self._leg = self._leg_to(now_us, over_home)
        return leg.setpoint(now_us, self._yaw)
