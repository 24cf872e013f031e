"""The world the vehicle flies in: rigid body, rotors, air and ground, as pure functions.

Way in: `dynamics.derivative` (x' = f(x, u)) and `dynamics.step` (one RK4 step). Frames: n local NED from home, b body
FRD; quaternions wxyz, `q_nb` takes b-vectors to n. SI units.
"""
