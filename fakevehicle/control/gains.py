"""The parameters of the control loops, and how they become the kernels' records.

Names are PX4's where PX4 has the same thing. Those of the FOPID-TID loops begin with FT_ and the loop: VXY and VZ
(velocity, 250 Hz), RXY and RZ (body rates, 1 kHz).
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from fakevehicle.airframe import Airframe
from fakevehicle.control.cascade import GAINS, LOOPS, RATE, VELOCITY
from fakevehicle.control.fopid_tid import LoopBank
from fakevehicle.params import Parameter, ParameterSet
from fakevehicle.vocabulary import FloatArray, Resets

OUTER_PERIOD, INNER_PERIOD = 0.004, 0.001


@dataclass(frozen=True, slots=True)
class LoopDefaults:
    """Defaults of one FOPID-TID loop; `unit` is the output's per unit of error."""

    name: str
    what: str
    unit: str
    kp: float
    kt: float
    ki: float
    ki0: float
    kd: float
    lam: float
    mu: float
    tilt_n: float
    limit: float
    cutoff: float  # of F(s) [rad/s]
    band: tuple[float, float]  # [rad/s]
    loops: tuple[int, ...]


FOPID_LOOPS = (
    LoopDefaults(
        name="VXY", what="horizontal velocity", unit="1/s", loops=(0, 1), band=(0.05, 75.0), cutoff=30.0,
        kp=5.0, kt=1.6, ki=3.0, ki0=0.0, kd=0.0, lam=0.9, mu=0.9, tilt_n=3.0, limit=6.0,
    ),
    LoopDefaults(
        name="VZ", what="vertical velocity", unit="1/s", loops=(2,), band=(0.05, 75.0), cutoff=30.0,
        kp=5.0, kt=1.0, ki=2.0, ki0=0.0, kd=0.0, lam=0.9, mu=0.9, tilt_n=3.0, limit=8.0,
    ),
    LoopDefaults(
        name="RXY", what="roll and pitch rate", unit="1/s", loops=(3, 4), band=(0.1, 300.0), cutoff=200.0,
        kp=22.0, kt=4.0, ki=20.0, ki0=0.0, kd=0.3, lam=0.95, mu=0.9, tilt_n=3.0, limit=6.0,
    ),
    LoopDefaults(
        name="RZ", what="yaw rate", unit="1/s", loops=(5,), band=(0.1, 300.0), cutoff=200.0,
        kp=6.0, kt=1.0, ki=2.0, ki0=0.0, kd=0.0, lam=0.95, mu=0.9, tilt_n=3.0, limit=2.0,
    ),
)  # fmt: skip
"""lambda stays at 0.85 or above: the paper's 0.3127 leaves a lateral offset in steady wind that fades for minutes. The
integrals' limits are a few times what wind and imbalance ask for, so that feet on the ground cannot wind them up."""

PAPER_GAINS: Mapping[str, float] = {
    f"FT_{loop}_{term}": value
    for loop in ("VXY", "VZ")
    for term, value in (("KP", 1.3254), ("KT", 0.0), ("KI", 0.4627), ("KD", 0.1892), ("LAMBDA", 0.3127), ("MU", 0.3419))
}
"""The paper's one set of FOPID gains (its section on results; the loop it belongs to is not said), as overrides of the
velocity loops. Kept for comparison, not for flying in wind."""


PRESETS: Mapping[str, Mapping[str, float]] = {
    "default": {},
    "paper": PAPER_GAINS,
    "fopid": {f"FT_{loop.name}_KT": 0.0 for loop in FOPID_LOOPS},
    "tid": {
        f"FT_{loop}_{term}": value
        for loop in ("VXY", "VZ")
        for term, value in (("KP", 0.0), ("KT", 8.5), ("LAMBDA", 1.0), ("MU", 1.0))
    },
    "pid": {
        f"FT_{loop.name}_{term}": value
        for loop in FOPID_LOOPS
        for term, value in (("KT", 0.0), ("LAMBDA", 1.0), ("MU", 1.0))
    }
    | {"FT_VXY_KP": 6.0, "FT_VXY_KI": 6.0},
}
"""Sets of the loops' gains by name, as overrides of the defaults: the law's special cases, which all fly. In `tid` the
velocity loops have s^(-1/3) instead of a proportional term, as much at 5 rad/s. `pid` was tuned like the default, by
as many trials on the same flights, and has the default's gain at 5 rad/s."""


def _loop_parameters(loop: LoopDefaults) -> tuple[Parameter, ...]:
    name, what, unit = f"FT_{loop.name}_", loop.what, loop.unit
    return (
        Parameter(name + "KP", loop.kp, 0, 200, unit, f"{what}: proportional gain"),
        Parameter(name + "KT", loop.kt, 0, 200, unit, f"{what}: tilt gain, of D^(-1/n)"),
        Parameter(name + "KI", loop.ki, 0, 500, unit, f"{what}: integral gain, of D^(-lambda)"),
        Parameter(name + "KI0", loop.ki0, 0, 500, unit, f"{what}: gain of a plain integral beside it"),
        Parameter(name + "KD", loop.kd, 0, 20, unit, f"{what}: derivative gain, of D^mu"),
        Parameter(name + "LAMBDA", loop.lam, 0.05, 1, "", f"{what}: order of the integral, taken up at rest"),
        Parameter(name + "MU", loop.mu, 0.05, 1, "", f"{what}: order of the derivative, taken up at rest"),
        Parameter(name + "TILTN", loop.tilt_n, 1, 20, "", f"{what}: n of the tilt term, taken up at rest"),
        Parameter(name + "B", 1.0, 0, 1, "", f"{what}: setpoint weight of the proportional term"),
        Parameter(name + "ILIM", loop.limit, 0, 200, "", f"{what}: bound of the integral"),
    )


PARAMETERS: tuple[Parameter, ...] = (
    Parameter("MPC_XY_P", 2.0, 0, 5, "1/s", "horizontal position gain"),
    Parameter("MPC_Z_P", 1.2, 0, 5, "1/s", "vertical position gain"),
    Parameter("MPC_ACC_BRAKE", 5.0, 0.5, 15, "m/s^2", "deceleration sideways that a place far off is approached with"),
    Parameter(
        "MPC_ACC_LEAD", 0.07, 0, 0.5, "s", "how far ahead acceleration asked for sideways is looked: attitude's lag"
    ),
    Parameter("MPC_XY_VEL_MAX", 12.0, 0.5, 20, "m/s", "highest horizontal speed the position loop asks for"),
    Parameter("MPC_Z_VEL_MAX_UP", 3.0, 0.5, 8, "m/s", "highest climb rate the position loop asks for"),
    Parameter("MPC_Z_VEL_MAX_DN", 1.5, 0.5, 4, "m/s", "highest sink rate the position loop asks for"),
    Parameter("MPC_TILTMAX_AIR", 45.0, 5, 70, "deg", "highest tilt"),
    Parameter("MPC_THR_MIN", 0.08, 0, 0.5, "norm", "least collective thrust in flight, of the full"),
    Parameter("MPC_THR_MAX", 0.95, 0.5, 1, "norm", "most collective thrust, of the full"),
    Parameter("MC_ROLL_P", 10.0, 0, 20, "1/s", "roll attitude gain"),
    Parameter("MC_PITCH_P", 10.0, 0, 20, "1/s", "pitch attitude gain"),
    Parameter("MC_YAW_P", 2.5, 0, 10, "1/s", "yaw attitude gain"),
    Parameter("MC_ROLLRATE_MAX", 220.0, 0, 1800, "deg/s", "highest roll rate asked for"),
    Parameter("MC_PITCHRATE_MAX", 220.0, 0, 1800, "deg/s", "highest pitch rate asked for"),
    Parameter("MC_YAWRATE_MAX", 90.0, 0, 1800, "deg/s", "highest yaw rate asked for"),
    Parameter("IMU_GYRO_CUTOFF", 60.0, 10, 300, "Hz", "low pass of the gyro before the rate loops"),
    *(parameter for loop in FOPID_LOOPS for parameter in _loop_parameters(loop)),
)


class ControlTables:
    """The records the control kernels read, kept in step with the parameters.

    Attributes
    ----------
    bank : three velocity and three rate loops.  gains : (1,) of `GAINS`.  status : (1,) of `LOOPS`.
    boost : how far rotor speeds are raised against a falling voltage, as far as the loops know; told by `weaken`.
    """

    def __init__(self, airframe: Airframe, parameters: ParameterSet) -> None:
        self.bank = LoopBank((OUTER_PERIOD,) * 3 + (INNER_PERIOD,) * 3)
        self.gains = np.zeros(1, GAINS)
        self.status = np.zeros(1, LOOPS)
        self.status["q_sp"][0, 0] = 1.0
        self.status["followed"] = self.status["asked"] = np.nan
        self._full = 4 * airframe.thrust_coefficient * airframe.max_rotor_speed**2
        self._level = airframe.level_thrust
        self.boost, self._most = 1.0, 0.0
        self._orders: dict[str, tuple[float, float, float]] = {}
        self.update(parameters, at_rest=True)

    def update(self, parameters: ParameterSet, *, at_rest: bool) -> None:
        """Read every parameter again; gains change without a bump, orders only when the motors are at rest."""
        p = parameters
        g = self.gains[0]
        g["position_p"] = [p["MPC_XY_P"], p["MPC_XY_P"], p["MPC_Z_P"]]
        g["attitude_p"] = [p["MC_ROLL_P"], p["MC_PITCH_P"], p["MC_YAW_P"]]
        g["rate_max"] = np.radians([p["MC_ROLLRATE_MAX"], p["MC_PITCHRATE_MAX"], p["MC_YAWRATE_MAX"]])
        g["lead"], g["brake"] = p["MPC_ACC_LEAD"], p["MPC_ACC_BRAKE"]
        g["speed_xy"], g["speed_up"] = p["MPC_XY_VEL_MAX"], p["MPC_Z_VEL_MAX_UP"]
        g["speed_down"] = p["MPC_Z_VEL_MAX_DN"]
        g["tan_tilt"] = math.tan(math.radians(p["MPC_TILTMAX_AIR"]))
        g["thrust_full"] = self._full
        g["thrust_min"], self._most = p["MPC_THR_MIN"] * self._full, p["MPC_THR_MAX"] * self._level
        self.weaken(self.boost)
        self.status["gyro_gain"] = 1.0 - math.exp(-2.0 * math.pi * p["IMU_GYRO_CUTOFF"] * INNER_PERIOD)
        for loop in FOPID_LOOPS:
            name = f"FT_{loop.name}_"
            orders = (float(p[name + "LAMBDA"]), float(p[name + "MU"]), float(p[name + "TILTN"]))
            if at_rest and orders != self._orders.get(loop.name):
                self._orders[loop.name] = orders
                for i in loop.loops:
                    self.bank.set_orders(
                        i, lam=orders[0], mu=orders[1], tilt_n=orders[2], band=loop.band, derivative_cutoff=loop.cutoff
                    )
            for i in loop.loops:
                self.bank.set_gains(
                    i,
                    kp=float(p[name + "KP"]),
                    kt=float(p[name + "KT"]),
                    ki=float(p[name + "KI"]),
                    ki0=float(p[name + "KI0"]),
                    kd=float(p[name + "KD"]),
                    b=float(p[name + "B"]),
                    limit=float(p[name + "ILIM"]),
                )

    def weaken(self, boost: float) -> None:
        """Ask for no more thrust than the rotors give when their speeds must be raised by `boost` (1: a full pack)."""
        self.boost = boost
        self.gains[0]["thrust_max"] = min(self._most, self._level / boost**2)

    def rest(self, yaw: float) -> None:
        """The loops as new: nothing remembered, holding this yaw [rad]. While the motors do not obey them."""
        for i in range(RATE + 3):
            self.bank.clear(i)
        s = self.status[0]
        s["yaw"], s["thrust"], s["saturated"] = yaw, 0.0, 0.0
        s["pushed_a"], s["pushed_m"], s["rate_sp"] = 0.0, 0.0, 0.0
        s["followed"], s["asked"], s["shift"] = np.nan, np.nan, 0.0
        s["q_sp"] = [math.cos(0.5 * yaw), 0.0, 0.0, math.sin(0.5 * yaw)]

    def rebase(self) -> None:
        """Forget the setpoints there were, keep the trim: for a change of mode."""
        for i in range(VELOCITY, VELOCITY + 3):
            self.bank.rebase(i)
        self.status[0]["asked"] = np.nan
        self.status[0]["shift"][:3] = 0.0  # new setpoints begin at the estimate as it is

    def follow(self, resets: Resets) -> None:
        """Take the estimate's newest jump for what it is, no motion."""
        shift = self.status[0]["shift"]
        shift[0:3] += resets.delta_position_n
        shift[3:6] += resets.delta_velocity_n
        shift[6] += resets.delta_yaw

    @property
    def motor(self) -> FloatArray:
        """(4,) rotor speed setpoints [rad/s], a view."""
        command: FloatArray = self.status["command"][0]
        return command
