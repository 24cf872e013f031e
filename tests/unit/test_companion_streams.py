"""What a vehicle is asked to stream, and what it makes of a refusal."""

import pytest

from companion.autopilots.base import stream_requests
from companion.autopilots.px4 import Px4
from companion.missionfile import load_mission
from companion.preparation import Preparation
from companion.seam import Level
from companion.seeing.sight import Sight
from companion.telemetry import Ack, Telemetry
from wire.dialect import mavlink

SCANS = {
    mavlink.MAVLINK_MSG_ID_OBSTACLE_DISTANCE,
    mavlink.MAVLINK_MSG_ID_OBSTACLE_DISTANCE_3D,
    mavlink.MAVLINK_MSG_ID_DISTANCE_SENSOR,
}
POSITION = mavlink.MAVLINK_MSG_ID_LOCAL_POSITION_NED


def test_a_mission_that_senses_asks_for_every_message_that_it_reads():
    asked = Sight(load_mission("missions/l_shape_unknown.yaml")).streams_hz()
    assert set(asked) >= SCANS | {mavlink.MAVLINK_MSG_ID_ADSB_VEHICLE}
    assert not Sight(load_mission("missions/l_shape.yaml")).streams_hz()


@pytest.mark.parametrize(
    ("message_id", "level"), [*((i, Level.INFO) for i in sorted(SCANS)), (POSITION, Level.WARNING)]
)
def test_a_refused_stream_that_many_vehicles_do_not_have_is_no_warning(message_id, level):
    (asked,) = stream_requests({message_id: 10.0})
    assert asked.due(0)
    asked.answered(Ack(mavlink.MAV_CMD_SET_MESSAGE_INTERVAL, mavlink.MAV_RESULT_DENIED))
    told = Preparation(Px4(), Telemetry(), 0, []).over(asked)
    assert told.level is level
    assert "refused to stream" in told.text
