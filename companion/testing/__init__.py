"""Scripted mission tests: a pytest plug-in, whole flights in memory, and a link with faults.

The one room beside the command line that knows the bundled vehicle.
"""
