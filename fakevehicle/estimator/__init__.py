"""Where the vehicle believes it is: an error-state Kalman filter on a delayed horizon, and an output predictor.

Way in: `horizon.Estimator` (feed samples, read the estimate at the newest IMU sample). Frames: n local NED from the
first GPS fix, b body FRD. The filter's error state is [dtheta, dv, dp, db_g, db_a] with q = q_hat * Exp(dtheta).
"""
