"""What a vehicle is asked to stream, and what it makes of a refusal."""

import pytest

from companion.autopilots.base import stream_requests
from companion.autopilots.px4 import Px4
from companion.missionfile import load_mission
from companion.preparation import Preparation
from companion.seam import Level
from companion.seeing.sight import Sight
from companion.streams import Streams
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
    told = Preparation(Px4(), Telemetry(), 0, Streams({message_id: 10.0})).over(asked)
    assert told.level is level
    assert "refused to stream" in told.text


GLOBAL, ATTITUDE = mavlink.MAVLINK_MSG_ID_GLOBAL_POSITION_INT, mavlink.MAVLINK_MSG_ID_ATTITUDE


def test_of_several_rates_that_are_wanted_of_one_message_the_greatest_is_asked_for_once():
    for tables in (({GLOBAL: 10.0}, {GLOBAL: 5.0}), ({GLOBAL: 5.0}, {GLOBAL: 10.0})):
        (asked,) = Streams(*tables).requests()
        assert asked.parameters == (GLOBAL, 1e5)


def asked_again(streams, seconds, comes_hz):
    """(second, message id) of the requests put again while messages come at these rates."""
    found = []
    for second in range(seconds + 1):
        found += [(second, int(command.parameters[0])) for command in streams.missing(second * 1_000_000)]
        for message_id, hz in comes_hz.items():
            for _ in range(hz):
                streams.heard(message_id)
    return found


def test_only_what_is_far_from_its_rate_is_asked_for_again_and_less_and_less_often():
    streams = Streams({POSITION: 50.0, ATTITUDE: 50.0, GLOBAL: 5.0})
    again = asked_again(streams, 60, {POSITION: 30, GLOBAL: 1})
    assert again == [(second, kind) for second in (5, 10, 20, 40) for kind in (ATTITUDE, GLOBAL)]


def test_what_was_refused_is_not_asked_for_again_and_what_many_do_not_have_twice_at_most():
    ring = mavlink.MAVLINK_MSG_ID_OBSTACLE_DISTANCE
    streams = Streams({POSITION: 50.0, ring: 10.0})
    asked = streams.requests()[0]
    assert asked.due(0)
    asked.answered(Ack(mavlink.MAV_CMD_SET_MESSAGE_INTERVAL, mavlink.MAV_RESULT_UNSUPPORTED))
    streams.over(asked)
    assert [message_id for _, message_id in asked_again(streams, 300, {})] == [ring, ring]
