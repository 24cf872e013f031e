"""What the estimator takes for true about its sensors, and the parameters it is told by.

The defaults are the simulated sensors' own noises, so that the filter is as sure as it is right: over many flights its
normalised errors and innovations have the mean they should (`tests/lockstep/test_estimator_runs.py`). A bias's walk of
w [unit/sqrt(s)] is, as a rate held for one tick, w / sqrt(dt): 1e-5 rad/s/sqrt(s) are 1.58e-4 rad/s^2 at 250 Hz. PX4's
own defaults (0.015 rad/s, 0.35 m/s^2, 0.5 m, 0.3 m/s) allow for much worse sensors and would let the position wander by
twice as much.
"""

from dataclasses import dataclass

from fakevehicle.params import Parameter, ParameterSet, ParameterType

_I = ParameterType.INT32
PARAMETERS: tuple[Parameter, ...] = (
    Parameter("EKF2_GYR_NOISE", 0.003, 1e-4, 0.1, "rad/s", "estimator: gyro noise of a 250 Hz sample"),
    Parameter("EKF2_ACC_NOISE", 0.07, 0.01, 1.0, "m/s^2", "estimator: accelerometer noise of a 250 Hz sample"),
    Parameter("EKF2_GYR_B_NOISE", 1.58e-4, 0, 0.01, "rad/s^2", "estimator: gyro bias walk"),
    Parameter("EKF2_ACC_B_NOISE", 1.58e-3, 0, 0.01, "m/s^3", "estimator: accelerometer bias walk"),
    Parameter("EKF2_GBIAS_INIT", 0.005, 0, 0.2, "rad/s", "estimator: gyro bias at the start"),
    Parameter("EKF2_ABIAS_INIT", 0.05, 0, 0.5, "m/s^2", "estimator: accelerometer bias at the start"),
    Parameter("EKF2_GPS_P_NOISE", 0.35, 0.01, 10, "m", "estimator: GPS position noise"),
    Parameter("EKF2_GPS_V_NOISE", 0.05, 0.01, 5, "m/s", "estimator: GPS velocity noise"),
    Parameter("EKF2_BARO_NOISE", 0.2, 0.01, 15, "m", "estimator: barometer noise"),
    Parameter("FT_EKF_BARO_DRFT", 0.1, 0, 5, "m", "estimator: drift of the barometer in the long run"),
    Parameter("FT_EKF_BARO_TAU", 300.0, 1, 10000, "s", "estimator: time in which the barometer's drift forgets"),
    Parameter("EKF2_MAG_NOISE", 0.03, 0.001, 1, "gauss", "estimator: magnetometer noise"),
    Parameter("EKF2_MAG_DECL", 3.4, -180, 180, "deg", "estimator: declination of the earth's field, read at the start"),
    Parameter("EKF2_GPS_DELAY", 110.0, 4, 300, "ms", "estimator: age of a fix when it arrives, read at the start"),
    Parameter("EKF2_REQ_GPS_H", 4.0, 0, 30, "s", "estimator: GPS must be good for this long before position is valid"),
    Parameter("EKF2_NOAID_TOUT", 5_000_000, 500_000, 10_000_000, "us", "estimator: refusal that ends in a reset", _I),
    Parameter("EKF2_PREDICT_US", 12_000, 4_000, 20_000, "us", "estimator: period of the filter, read at the start", _I),
    Parameter("EKF2_MCOEF", 0.12, 0, 1, "1/s", "estimator: rotor drag per mass, holds velocity without GPS; 0: unused"),
    Parameter("EKF2_TAU_POS", 0.25, 0.1, 1, "s", "estimator: time constant of the predicted position"),
    Parameter("EKF2_TAU_VEL", 0.25, 0.1, 1, "s", "estimator: time constant of the predicted velocity"),
    Parameter("FT_EKF_GATE", 0.999, 0.9, 0.999999, "", "estimator: chance of a good measurement to pass its gate"),
)


@dataclass(frozen=True, slots=True)
class EstimatorConfig:
    """Noises are 1 sigma each.

    Attributes
    ----------
    gyro_noise, accel_noise : of one 250 Hz sample [rad/s], [m/s^2].
    gyro_walk, accel_walk : of the biases' rates, held for one 250 Hz tick [rad/s^2], [m/s^3].
    gyro_bias, accel_bias : of the biases at the start [rad/s], [m/s^2].
    gps_position, gps_velocity, baro, mag : [m], [m/s], [m], [gauss].
    baro_drift, baro_drift_time : the barometer's Gauss-Markov drift in the long run [m] and its time constant [s].
    gps_delay_us : age of a fix when it arrives [us].
    gps_settling_us : position is not called valid before GPS has been accepted for this long [us].
    reset_after_us : a sensor that comes and is refused for this long is believed after all [us].
    predict_us : period of the filter [us], at least a tick.
    drag : in-plane specific force per airspeed [1/s]; 0 leaves the velocity unaided without GPS.
    gate_probability : a true measurement passes its gate with this probability.
    tau_position, tau_velocity : time constants of the output predictor [s].
    """

    gyro_noise: float
    accel_noise: float
    gyro_walk: float
    accel_walk: float
    gyro_bias: float
    accel_bias: float
    gps_position: float
    gps_velocity: float
    baro: float
    baro_drift: float
    baro_drift_time: float
    mag: float
    gps_delay_us: int
    gps_settling_us: int
    gate_probability: float
    tau_position: float
    tau_velocity: float
    reset_after_us: int = 5_000_000
    predict_us: int = 12_000
    drag: float = 0.0


def estimator_config(p: ParameterSet) -> EstimatorConfig:
    """What the values of (at least) `PARAMETERS` ask for."""
    return EstimatorConfig(
        gyro_noise=float(p["EKF2_GYR_NOISE"]),
        accel_noise=float(p["EKF2_ACC_NOISE"]),
        gyro_walk=float(p["EKF2_GYR_B_NOISE"]),
        accel_walk=float(p["EKF2_ACC_B_NOISE"]),
        gyro_bias=float(p["EKF2_GBIAS_INIT"]),
        accel_bias=float(p["EKF2_ABIAS_INIT"]),
        gps_position=float(p["EKF2_GPS_P_NOISE"]),
        gps_velocity=float(p["EKF2_GPS_V_NOISE"]),
        baro=float(p["EKF2_BARO_NOISE"]),
        baro_drift=float(p["FT_EKF_BARO_DRFT"]),
        baro_drift_time=float(p["FT_EKF_BARO_TAU"]),
        mag=float(p["EKF2_MAG_NOISE"]),
        gps_delay_us=round(1000 * p["EKF2_GPS_DELAY"]),
        gps_settling_us=round(1e6 * p["EKF2_REQ_GPS_H"]),
        gate_probability=float(p["FT_EKF_GATE"]),
        tau_position=float(p["EKF2_TAU_POS"]),
        tau_velocity=float(p["EKF2_TAU_VEL"]),
        reset_after_us=int(p["EKF2_NOAID_TOUT"]),
        predict_us=int(p["EKF2_PREDICT_US"]),
        drag=float(p["EKF2_MCOEF"]),
    )
