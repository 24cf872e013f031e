"""The vehicle's MAVLink services, one a file: what each answers, refuses and sends by itself.

A service is a class (or a few functions) that takes decoded messages and puts answers into the `Outbox`; `vehicle.py`
says which message goes to which. Services read and steer the vehicle through `Supervisor` and `ParameterSet` only.

Units on the wire are MAVLink's (degrees e7, millimetres, centimetres a second); they are turned into SI at the edge.
"""
