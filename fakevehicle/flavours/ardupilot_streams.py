"""ArduPilot's streams: nothing but HEARTBEAT until somebody asks, by message or by group.

REQUEST_DATA_STREAM names a group of messages and a rate; it is not acknowledged. The groups are ArduCopter's
(GCS_MAVLink_Copter's stream entries), as far as this vehicle has their messages.
"""

from collections.abc import Callable, Mapping

from fakevehicle.codec import Message
from fakevehicle.services.outbox import Sender
from fakevehicle.services.service import Handler, Service
from fakevehicle.services.streams import Streams
from wire.dialect import mavlink

_m = mavlink
RATES_HZ: Mapping[int, float] = {_m.MAVLINK_MSG_ID_HEARTBEAT: 1}
"""What a link starts with."""

FASTEST_HZ = 250
GROUPS: Mapping[int, tuple[int, ...]] = {
    _m.MAV_DATA_STREAM_RAW_SENSORS: (
        _m.MAVLINK_MSG_ID_RAW_IMU,
        _m.MAVLINK_MSG_ID_SCALED_IMU,
        _m.MAVLINK_MSG_ID_SCALED_PRESSURE,
    ),
    _m.MAV_DATA_STREAM_EXTENDED_STATUS: (
        _m.MAVLINK_MSG_ID_SYS_STATUS,
        _m.MAVLINK_MSG_ID_GPS_RAW_INT,
        _m.MAVLINK_MSG_ID_MISSION_CURRENT,
        _m.MAVLINK_MSG_ID_FENCE_STATUS,
        _m.MAVLINK_MSG_ID_POSITION_TARGET_GLOBAL_INT,
    ),
    _m.MAV_DATA_STREAM_RC_CHANNELS: (_m.MAVLINK_MSG_ID_SERVO_OUTPUT_RAW, _m.MAVLINK_MSG_ID_RC_CHANNELS),
    _m.MAV_DATA_STREAM_POSITION: (_m.MAVLINK_MSG_ID_GLOBAL_POSITION_INT, _m.MAVLINK_MSG_ID_LOCAL_POSITION_NED),
    _m.MAV_DATA_STREAM_EXTRA1: (_m.MAVLINK_MSG_ID_ATTITUDE,),
    _m.MAV_DATA_STREAM_EXTRA2: (_m.MAVLINK_MSG_ID_VFR_HUD,),
    _m.MAV_DATA_STREAM_EXTRA3: (
        _m.MAVLINK_MSG_ID_SYSTEM_TIME,
        _m.MAVLINK_MSG_ID_BATTERY_STATUS,
        _m.MAVLINK_MSG_ID_EKF_STATUS_REPORT,
        _m.MAVLINK_MSG_ID_VIBRATION,
        _m.MAVLINK_MSG_ID_DISTANCE_SENSOR,
        _m.MAVLINK_MSG_ID_AVAILABLE_MODES_MONITOR,
    ),
}


class StreamRequests(Service):
    """Answers REQUEST_DATA_STREAM by streaming, for the sender's link.

    Parameters
    ----------
    streams : the schedule.
    warn : tells people what was refused.
    """

    def __init__(self, streams: Streams, warn: Callable[[str, int], None]) -> None:
        self._streams = streams
        self._warn = warn

    def routes(self) -> Mapping[int, Handler]:
        """The one message."""
        return {_m.MAVLINK_MSG_ID_REQUEST_DATA_STREAM: self.request}

    def request(self, sender: Sender, message: Message, now_us: int) -> None:
        """Start (rate above 0 and start_stop 1) or stop a group; group 0 is all of them."""
        group, rate = message.req_stream_id, message.req_message_rate
        if group != _m.MAV_DATA_STREAM_ALL and group not in GROUPS:
            self._warn(f"No such stream {group}", now_us)
            return
        wanted = GROUPS.values() if group == _m.MAV_DATA_STREAM_ALL else (GROUPS[group],)
        running = bool(message.start_stop) and rate > 0
        interval_us = round(1e6 / min(rate, FASTEST_HZ)) if running else -1
        for numbers in wanted:
            for number in numbers:
                if self._streams.interval_us(sender.link, number) != interval_us:
                    self._streams.set_interval(sender.link, number, interval_us, now_us)  # those it has
