"""Telemetry streams: which message goes out on which link how often, and MESSAGE_INTERVAL's two commands.

Every link has its own table, started from its profile. A stream's due time advances by its interval, so that rates hold
on average although a tick is 4 ms; a stream that fell behind skips what it missed. All begin together, so that what is
told in one tick is told of one estimate.
"""

from collections.abc import Mapping, Sequence
from heapq import heapify, heappop, heappush

from fakevehicle.codec import Message
from fakevehicle.config import LinkConfig, Profile
from fakevehicle.services.outbox import Outbox
from fakevehicle.services.service import Builder, Service
from wire.dialect import mavlink

SHORTEST_US = 4_000
"""One tick: no stream can be faster."""
LONGEST_US = 3_600_000_000

_m = mavlink
RATES_HZ: Mapping[Profile, Mapping[int, float]] = {
    "gcs": {
        _m.MAVLINK_MSG_ID_HEARTBEAT: 1,
        _m.MAVLINK_MSG_ID_ATTITUDE: 15,
        _m.MAVLINK_MSG_ID_ATTITUDE_QUATERNION: 10,
        _m.MAVLINK_MSG_ID_LOCAL_POSITION_NED: 1,
        _m.MAVLINK_MSG_ID_GLOBAL_POSITION_INT: 5,
        _m.MAVLINK_MSG_ID_SYS_STATUS: 1,
        _m.MAVLINK_MSG_ID_EXTENDED_SYS_STATE: 1,
        _m.MAVLINK_MSG_ID_BATTERY_STATUS: 0.5,
        _m.MAVLINK_MSG_ID_HOME_POSITION: 0.5,
        _m.MAVLINK_MSG_ID_VFR_HUD: 4,
        _m.MAVLINK_MSG_ID_ALTITUDE: 1,
        _m.MAVLINK_MSG_ID_POSITION_TARGET_LOCAL_NED: 1.5,
        _m.MAVLINK_MSG_ID_ATTITUDE_TARGET: 2,
        _m.MAVLINK_MSG_ID_GPS_RAW_INT: 5,
        _m.MAVLINK_MSG_ID_SYSTEM_TIME: 1,
        _m.MAVLINK_MSG_ID_ESTIMATOR_STATUS: 1,
        _m.MAVLINK_MSG_ID_SERVO_OUTPUT_RAW: 1,
        _m.MAVLINK_MSG_ID_CURRENT_MODE: 0.5,
    },
    "onboard": {
        _m.MAVLINK_MSG_ID_HEARTBEAT: 1,
        _m.MAVLINK_MSG_ID_ATTITUDE: 100,
        _m.MAVLINK_MSG_ID_ATTITUDE_QUATERNION: 50,
        _m.MAVLINK_MSG_ID_LOCAL_POSITION_NED: 50,  # 30 on hardware; PX4's simulations raise it
        _m.MAVLINK_MSG_ID_GLOBAL_POSITION_INT: 50,
        _m.MAVLINK_MSG_ID_ODOMETRY: 30,
        _m.MAVLINK_MSG_ID_HIGHRES_IMU: 50,
        _m.MAVLINK_MSG_ID_SYS_STATUS: 5,
        _m.MAVLINK_MSG_ID_EXTENDED_SYS_STATE: 5,
        _m.MAVLINK_MSG_ID_BATTERY_STATUS: 0.5,
        _m.MAVLINK_MSG_ID_HOME_POSITION: 0.5,
        _m.MAVLINK_MSG_ID_VFR_HUD: 10,
        _m.MAVLINK_MSG_ID_ALTITUDE: 10,
        _m.MAVLINK_MSG_ID_POSITION_TARGET_LOCAL_NED: 10,
        _m.MAVLINK_MSG_ID_ATTITUDE_TARGET: 10,
        _m.MAVLINK_MSG_ID_GPS_RAW_INT: 5,
        _m.MAVLINK_MSG_ID_SYSTEM_TIME: 1,
        _m.MAVLINK_MSG_ID_ESTIMATOR_STATUS: 1,
        _m.MAVLINK_MSG_ID_SERVO_OUTPUT_RAW: 5,
        _m.MAVLINK_MSG_ID_CURRENT_MODE: 0.5,
        _m.MAVLINK_MSG_ID_HIL_STATE_QUATERNION: 50,  # the simulator's truth, for judging a flight; no loop sees it
    },
}


class Streams(Service):
    """The schedule of all links.

    Parameters
    ----------
    outbox : where messages go.
    links : names and profiles.

    Attributes
    ----------
    table : builders of all services, by message id; set by the vehicle once all of them stand.
    """

    def __init__(self, outbox: Outbox, links: Sequence[LinkConfig]) -> None:
        self._outbox = outbox
        self.table: Mapping[int, Builder] = {}
        self._profile = {link.name: link.profile for link in links}
        self._intervals_us: dict[str, dict[int, int]] = {}
        self._queues: dict[str, list[tuple[int, int]]] = {}  # heaps of (due_us, message id)
        for link in links:
            intervals = {number: round(1e6 / rate) for number, rate in RATES_HZ[link.profile].items()}
            self._intervals_us[link.name] = intervals
            self._queues[link.name] = [(0, number) for number in sorted(intervals)]

    def knows(self, message_id: int) -> bool:
        """Whether the vehicle has this message at all."""
        return message_id in self.table

    def build(self, message_id: int) -> Message | None:
        """One message now; None when there is no such message, or nothing to say in it yet."""
        builder = self.table.get(message_id)
        return None if builder is None else builder()

    def interval_us(self, link: str, message_id: int) -> int:
        """Interval on one link [us]; -1 switched off, 0 not a message of this vehicle."""
        if message_id not in self.table:
            return 0
        return self._intervals_us[link].get(message_id, -1)

    def set_interval(self, link: str, message_id: int, interval_us: int, now_us: int) -> bool:
        """Set one link's interval [us]: below 0 off, 0 the profile's own. False: the vehicle has no such message.

        HEARTBEAT cannot be switched off.
        """
        if message_id not in self.table:
            return False
        if interval_us == 0 or (interval_us < 0 and message_id == mavlink.MAVLINK_MSG_ID_HEARTBEAT):
            rate = RATES_HZ[self._profile[link]].get(message_id, 0.0)
            interval_us = round(1e6 / rate) if rate else -1
        queue = self._queues[link] = [entry for entry in self._queues[link] if entry[1] != message_id]
        if interval_us < 0:
            self._intervals_us[link].pop(message_id, None)
        else:
            self._intervals_us[link][message_id] = min(max(interval_us, SHORTEST_US), LONGEST_US)
            queue.append((now_us, message_id))
        heapify(queue)
        return True

    def step(self, now_us: int) -> None:
        """Send what is due."""
        for link, queue in self._queues.items():
            intervals_us = self._intervals_us[link]
            while queue and queue[0][0] <= now_us:
                due_us, number = heappop(queue)
                builder = self.table.get(number)
                message = builder() if builder is not None else None
                if message is not None:
                    self._outbox.broadcast(link, message)
                interval_us = intervals_us[number]
                due_us += interval_us
                heappush(queue, (due_us if due_us > now_us else now_us + interval_us, number))
