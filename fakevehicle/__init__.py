"""A simulated quadrotor that behaves like PX4 on the wire: physics, sensors, estimator, control, MAVLink.

The way in is `Vehicle(config).step(now_us, datagrams) -> datagrams`: a pure step machine of 4 ms ticks, without sockets
and without a clock. `python -m fakevehicle` drives one in real time over UDP.

Frames: n is local NED, b is body FRD; quaternions are wxyz and take b to n. SI and radians inside; MAVLink's own units
on the wire only.
"""

from fakevehicle.config import LinkConfig, VehicleConfig
from fakevehicle.errors import VehicleError
from fakevehicle.vehicle import Vehicle, VehicleCounters
from fakevehicle.vocabulary import Geodetic, Truth

__all__ = ["Geodetic", "LinkConfig", "Truth", "Vehicle", "VehicleConfig", "VehicleCounters", "VehicleError"]
