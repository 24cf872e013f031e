"""Requests and orders of services this vehicle does not have: each is answered in words, so that nobody wonders.

Some clients send a few of them over and over without asking for an answer (REQUEST_DATA_STREAM, joystick positions):
those are put into words once in `SELDOM_US` for each peer, the others whenever somebody asks again (`Words`). Where the
protocol has an answer of its own, that is sent every time. What is meant for other devices than an autopilot (cameras'
reports, CAN frames) needs none.
"""

from collections.abc import Mapping

from fakevehicle.codec import Message
from fakevehicle.services.outbox import Outbox, Sender
from fakevehicle.services.service import Handler, Service
from fakevehicle.services.streams import Streams
from fakevehicle.services.words import ALONE_US, Words
from wire.dialect import mavlink

_m = mavlink
_NO_GIMBAL = "this vehicle has no gimbal"
_NO_CAMERA = "this vehicle has no camera"
_NO_EXTENDED = "there are no extended parameters"
_NO_STICKS = "it is flown by modes and setpoints, not by sticks"
_BY_MISSIONS = "fences and rally points are loaded by the mission protocol"
REASONS: Mapping[int, str] = {
    _m.MAVLINK_MSG_ID_CHANGE_OPERATOR_CONTROL: "whoever speaks to it is obeyed",
    _m.MAVLINK_MSG_ID_REQUEST_DATA_STREAM: "ask for messages by MAV_CMD_SET_MESSAGE_INTERVAL",
    _m.MAVLINK_MSG_ID_MANUAL_CONTROL: _NO_STICKS,
    _m.MAVLINK_MSG_ID_RC_CHANNELS_OVERRIDE: _NO_STICKS,
    _m.MAVLINK_MSG_ID_PARAM_MAP_RC: _NO_STICKS,
    _m.MAVLINK_MSG_ID_MANUAL_SETPOINT: _NO_STICKS,
    _m.MAVLINK_MSG_ID_SET_ACTUATOR_CONTROL_TARGET: "motors are not driven one by one",
    _m.MAVLINK_MSG_ID_SAFETY_SET_ALLOWED_AREA: _BY_MISSIONS,
    _m.MAVLINK_MSG_ID_FENCE_POINT: _BY_MISSIONS,
    _m.MAVLINK_MSG_ID_FENCE_FETCH_POINT: _BY_MISSIONS,
    _m.MAVLINK_MSG_ID_RALLY_POINT: _BY_MISSIONS,
    _m.MAVLINK_MSG_ID_RALLY_FETCH_POINT: _BY_MISSIONS,
    _m.MAVLINK_MSG_ID_RESOURCE_REQUEST: "files are read by MAVLink FTP",
    _m.MAVLINK_MSG_ID_SET_MAG_OFFSETS: "offsets are parameters",
    _m.MAVLINK_MSG_ID_DIGICAM_CONFIGURE: _NO_CAMERA,
    _m.MAVLINK_MSG_ID_DIGICAM_CONTROL: _NO_CAMERA,
    _m.MAVLINK_MSG_ID_GOPRO_GET_REQUEST: _NO_CAMERA,
    _m.MAVLINK_MSG_ID_GOPRO_SET_REQUEST: _NO_CAMERA,
    _m.MAVLINK_MSG_ID_MOUNT_CONFIGURE: _NO_GIMBAL,
    _m.MAVLINK_MSG_ID_MOUNT_CONTROL: _NO_GIMBAL,
    _m.MAVLINK_MSG_ID_GIMBAL_CONTROL: _NO_GIMBAL,
    _m.MAVLINK_MSG_ID_GIMBAL_MANAGER_SET_ATTITUDE: _NO_GIMBAL,
    _m.MAVLINK_MSG_ID_GIMBAL_MANAGER_SET_PITCHYAW: _NO_GIMBAL,
    _m.MAVLINK_MSG_ID_GIMBAL_MANAGER_SET_MANUAL_CONTROL: _NO_GIMBAL,
    _m.MAVLINK_MSG_ID_LED_CONTROL: "this vehicle has no lights",
    _m.MAVLINK_MSG_ID_PLAY_TUNE: "this vehicle has no buzzer",
    _m.MAVLINK_MSG_ID_SETUP_SIGNING: "signatures are neither made nor checked",
    _m.MAVLINK_MSG_ID_COMMAND_INT_STAMPED: "send COMMAND_INT",
    _m.MAVLINK_MSG_ID_COMMAND_LONG_STAMPED: "send COMMAND_LONG",
    _m.MAVLINK_MSG_ID_PARAM_EXT_REQUEST_LIST: _NO_EXTENDED,
    _m.MAVLINK_MSG_ID_PARAM_EXT_REQUEST_READ: _NO_EXTENDED,
}
"""Why each is refused."""
OVER_AND_OVER = frozenset(
    {
        _m.MAVLINK_MSG_ID_REQUEST_DATA_STREAM,
        _m.MAVLINK_MSG_ID_MANUAL_CONTROL,
        _m.MAVLINK_MSG_ID_RC_CHANNELS_OVERRIDE,
        _m.MAVLINK_MSG_ID_MANUAL_SETPOINT,
        _m.MAVLINK_MSG_ID_SET_ACTUATOR_CONTROL_TARGET,
        _m.MAVLINK_MSG_ID_GIMBAL_MANAGER_SET_ATTITUDE,
        _m.MAVLINK_MSG_ID_GIMBAL_MANAGER_SET_PITCHYAW,
        _m.MAVLINK_MSG_ID_GIMBAL_MANAGER_SET_MANUAL_CONTROL,
    }
)
"""Kinds that clients send in streams."""
SELDOM_US = 60_000_000


class Others(Service):
    """Refuses what has no service, and answers what has an answer all the same.

    Parameters
    ----------
    outbox : where answers go.
    streams : builds AUTOPILOT_VERSION.
    refuse : puts a refusal into words.
    """

    def __init__(self, outbox: Outbox, streams: Streams, refuse: Words) -> None:
        self._outbox = outbox
        self._streams = streams
        self._say = refuse

    def routes(self) -> Mapping[int, Handler]:
        """Every kind in `REASONS`, and three with answers of their own; a real service for one goes before."""
        found: dict[int, Handler] = dict.fromkeys(REASONS, self._refuse)
        found[_m.MAVLINK_MSG_ID_PARAM_EXT_SET] = self._param_ext_set
        found[_m.MAVLINK_MSG_ID_AUTOPILOT_VERSION_REQUEST] = self._version
        found[_m.MAVLINK_MSG_ID_TERRAIN_CHECK] = self._terrain
        return found

    def _refuse(self, sender: Sender, message: Message, _now_us: int) -> None:
        number = type(message).id
        text = f"{message.get_type()} refused: {REASONS[number]}"
        self._say(sender, text, SELDOM_US if number in OVER_AND_OVER else ALONE_US)

    def _param_ext_set(self, sender: Sender, message: Message, _now_us: int) -> None:
        """PARAM_EXT_ACK, failed."""
        self._outbox.answer(
            sender,
            mavlink.MAVLink_param_ext_ack_message(
                message.param_id.encode("ascii", "replace"),
                message.param_value.encode("ascii", "replace"),
                message.param_type,
                mavlink.PARAM_ACK_FAILED,
            ),
        )
        self._say(sender, f"PARAM_EXT_SET refused: {_NO_EXTENDED}")

    def _version(self, sender: Sender, _message: Message, _now_us: int) -> None:
        """AUTOPILOT_VERSION_REQUEST, which came before MAV_CMD_REQUEST_MESSAGE."""
        version = self._streams.build(mavlink.MAVLINK_MSG_ID_AUTOPILOT_VERSION)
        if version is not None:
            self._outbox.answer(sender, version)

    def _terrain(self, sender: Sender, message: Message, _now_us: int) -> None:
        """TERRAIN_CHECK, by TERRAIN_REPORT: a spacing of 0 says that the height there is not known."""
        self._outbox.answer(sender, mavlink.MAVLink_terrain_report_message(message.lat, message.lon, 0, 0, 0, 0, 0))
