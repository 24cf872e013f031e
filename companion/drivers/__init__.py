"""Drivers give the core its clock and its bytes: real time over UDP, lockstep in memory, or a recording again.

They hold no decision about flight. Each calls `Companion.step` once a tick and hands a `Tick` to every tap (recorder,
verdict, progress line).
"""
