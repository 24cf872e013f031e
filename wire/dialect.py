"""The one MAVLink dialect everything here speaks: pymavlink's generated ``all``.

``common`` lacks messages that PX4 and ArduPilot send today (CURRENT_MODE 436, AVAILABLE_MODES 435, SIM_STATE 164 ...);
``all`` is its superset. Importing the generated module directly gives MAVLink 2 without environment variables.
"""

from pymavlink.dialects.v20 import all as mavlink

__all__ = ["mavlink"]
