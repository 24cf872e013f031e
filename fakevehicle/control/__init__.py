"""The control loops: fractional operators, the FOPID-TID law, the cascade and the mixer.

Way in: `cascade.outer_loops` (position, velocity, attitude) and `cascade.rate_loop`. Frames: n local NED, b body FRD;
accelerations and torques in SI units, so that gains do not depend on the airframe.
"""
