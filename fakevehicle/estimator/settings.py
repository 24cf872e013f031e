"""The estimator's parameters, and how they become its configuration."""

from fakevehicle.estimator.horizon import EstimatorConfig
from fakevehicle.params import Parameter, ParameterSet

# The filter believes its sensors to be a little worse than the simulated ones are (NIS a little below its mean) and
# their biases to wander a little faster: in a tick 8.0e-7 rad/s where SIM_GYR_WALK gives 6.3e-7, and 8.0e-6 m/s^2 where
# SIM_ACC_WALK gives 6.3e-6 (were it the other way round, long flights would make it ever more certain and ever more
# wrong). The simulated noises are a good receiver's (u-blox M9N: 0.05 m/s) and a MEMS IMU's with some vibration; PX4's
# own defaults (0.015 rad/s, 0.35 m/s^2, 0.5 m, 0.3 m/s) allow for much worse and would let the position wander by twice
# as much.
PARAMETERS: tuple[Parameter, ...] = (
    Parameter("EKF2_GYR_NOISE", 0.004, 1e-4, 0.1, "rad/s", "estimator: gyro noise"),
    Parameter("EKF2_ACC_NOISE", 0.09, 0.01, 1.0, "m/s^2", "estimator: accelerometer noise"),
    Parameter("EKF2_GYR_B_NOISE", 2e-4, 0, 0.01, "rad/s^2", "estimator: gyro bias walk"),
    Parameter("EKF2_ACC_B_NOISE", 2e-3, 0, 0.01, "m/s^3", "estimator: accelerometer bias walk"),
    Parameter("EKF2_GBIAS_INIT", 0.01, 0, 0.2, "rad/s", "estimator: gyro bias at the start"),
    Parameter("EKF2_ABIAS_INIT", 0.1, 0, 0.5, "m/s^2", "estimator: accelerometer bias at the start"),
    Parameter("EKF2_GPS_P_NOISE", 0.4, 0.01, 10, "m", "estimator: GPS position noise"),
    Parameter("EKF2_GPS_V_NOISE", 0.06, 0.01, 5, "m/s", "estimator: GPS velocity noise"),
    Parameter("EKF2_BARO_NOISE", 0.25, 0.01, 15, "m", "estimator: barometer noise"),
    Parameter("FT_EKF_BARO_DRFT", 0.1, 0, 5, "m", "estimator: drift of the barometer in the long run"),
    Parameter("FT_EKF_BARO_TAU", 300.0, 1, 10000, "s", "estimator: time in which the barometer's drift forgets"),
    Parameter("EKF2_MAG_NOISE", 0.04, 0.001, 1, "gauss", "estimator: magnetometer noise"),
    Parameter("EKF2_GPS_DELAY", 110.0, 4, 300, "ms", "estimator: age of a fix when it arrives, read at the start"),
    Parameter("EKF2_REQ_GPS_H", 4.0, 0, 30, "s", "estimator: GPS must be good for this long before position is valid"),
    Parameter("EKF2_TAU_POS", 0.25, 0.1, 1, "s", "estimator: time constant of the predicted position"),
    Parameter("EKF2_TAU_VEL", 0.25, 0.1, 1, "s", "estimator: time constant of the predicted velocity"),
    Parameter("FT_EKF_GATE", 0.999, 0.9, 0.999999, "", "estimator: chance of a good measurement to pass its gate"),
)


def estimator_config(p: ParameterSet) -> EstimatorConfig:
    """The configuration that (at least) `PARAMETERS` ask for."""
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
    )
