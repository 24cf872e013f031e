"""The companion: plans, streams setpoints to an autopilot over MAVLink, and records everything.

Way in: `companion.core.Companion.step` is one tick of the service, without clock or socket; `companion.drivers` give it
both, or neither. `companion.mission` is what people write; `companion.cli` is where everything is put together.

Frames. A mission is written in north, east and altitude from a world origin. Inside, everything is NED: the *mission
frame* m (origin at the world origin, z = -altitude) in which plans are made, and the vehicle's *local frame* n (origin
wherever its estimator put it). They differ by a translation, fixed when the vehicle is ready on the ground
(`companion.core`). SI and radians; degrees only in the mission file, on the command line and in MAVLink's own fields.
Time is an integer count of microseconds, handed in.
"""
