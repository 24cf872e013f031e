"""What the vehicle can measure: IMU, GPS, barometer, magnetometer, one file each, with noise, bias and delay.

Every sensor takes truth and a numpy Generator (or draws made with one) and returns what its chip would say. Frames: n
local NED from home, b body FRD.
"""
