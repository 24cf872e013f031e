"""Whatever a peer sends, the companion neither raises nor obeys; and the same inputs give the same outputs."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from companion.core import Companion, CompanionConfig
from companion.itinerary import Itinerary
from companion.missionfile import load_mission
from companion.phases import Phase
from companion.seam import Note, Order, PlanReady, Reference
from companion.vehiclelink import VEHICLE_LINK
from planner import Trajectory
from wire.datagram import Datagram
from wire.dialect import mavlink

MISSION = load_mission("missions/l_shape.yaml")


def packets_of(system: int, component: int, messages: list) -> list[bytes]:
    mav = mavlink.MAVLink(None, srcSystem=system, srcComponent=component)
    return [bytes(m.pack(mav)) for m in messages]


heartbeat = st.builds(
    mavlink.MAVLink_heartbeat_message,
    st.just(2),
    st.sampled_from([3, 8, 12]),
    st.integers(0, 255),
    st.sampled_from([0, 0x60000, 0x6040000]),
    st.integers(0, 8),
    st.just(3),
)
floats = st.floats(width=32)
position = st.builds(mavlink.MAVLink_local_position_ned_message, st.integers(0, 2**32 - 1), *[floats] * 6)
ack = st.builds(mavlink.MAVLink_command_ack_message, st.sampled_from([176, 400, 511, 31_999]), st.integers(0, 6))
text = st.builds(
    mavlink.MAVLink_statustext_message, st.integers(0, 7), st.binary(max_size=50), st.integers(0, 3), st.integers(0, 5)
)
message = st.one_of(heartbeat, position, ack, text)
well_formed = st.builds(
    lambda m, sysid, compid: packets_of(sysid, compid, [m])[0],
    message, st.integers(0, 255), st.sampled_from([0, 1, 100, 191]),
)  # fmt: skip
mangled = st.builds(
    lambda data, at, bits: bytes(b ^ bits if i == at % len(data) else b for i, b in enumerate(data)),
    well_formed, st.integers(0, 300), st.integers(1, 255),
)  # fmt: skip
datagram = st.builds(
    Datagram,
    st.sampled_from([VEHICLE_LINK, "out0", "nowhere"]),
    st.one_of(st.binary(max_size=300), well_formed, mangled),
)
refusal = st.builds(PlanReady, st.integers(-1, 9), st.none(), st.text(max_size=20), st.text(max_size=20))
tick = st.lists(st.one_of(datagram, refusal, st.just(Order("land"))), max_size=5)


@settings(max_examples=150, deadline=None)
@given(ticks=st.lists(tick, max_size=30))
def test_any_inputs_give_outputs_never_an_exception_and_twice_the_same(ticks):
    config = CompanionConfig(ground_links=("out0",))
    first, second = Companion(MISSION, config), Companion(MISSION, config)
    for k, inputs in enumerate(ticks):
        now_us = k * 200_000
        assert repr(first.step(now_us, inputs)) == repr(second.step(now_us, inputs))


@settings(max_examples=100, deadline=None)
@given(
    places=st.lists(st.lists(floats, min_size=6, max_size=6), min_size=12, max_size=40),
    modes=st.lists(st.sampled_from([0x3040000, 0x60000, 0x60000, 0x60000, 0x6040000]), min_size=40, max_size=40),
    armed_from=st.integers(5, 40),
)
def test_a_ready_vehicle_that_is_anywhere_in_any_mode_never_makes_the_companion_raise(places, modes, armed_from):
    companion = Companion(MISSION, CompanionConfig())
    (wanted,) = Itinerary(MISSION, 0).wanted()
    there = np.linspace(wanted.start_m, wanted.goal_m, 8)
    plan = PlanReady(2, Trajectory(there, np.array([0, 0, 0, 0, 1, 2, 3, 4, 5, 5, 5, 5.0])), certified=True)
    for k, (place, mode) in enumerate(zip(places, modes, strict=False)):
        beat = mavlink.MAVLink_heartbeat_message(2, 12, 0x81 if k >= armed_from else 0x01, mode, 4, 3)
        health = mavlink.MAVLink_sys_status_message(0, 0, 2**28, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0)
        estimator = mavlink.MAVLink_estimator_status_message(0, 0x3FF, *[0.0] * 8)
        attitude = mavlink.MAVLink_attitude_message(k * 250, 0, 0, place[5], 0, 0, 0)
        acks = [mavlink.MAVLink_command_ack_message(c, 0) for c in (511, 176, 400)]
        position = mavlink.MAVLink_local_position_ned_message(k * 250, *place)
        said = packets_of(1, 1, [beat, health, estimator, attitude, position, *acks])
        out = companion.step(k * 250_000, [*(Datagram(VEHICLE_LINK, data) for data in said), plan])
        assert all(np.isfinite(o.position_m).all() for o in out if isinstance(o, Reference))


@settings(max_examples=60, deadline=None)
@given(data=st.lists(st.builds(lambda m: packets_of(9, 1, [m])[0], message), max_size=30))
def test_another_vehicle_than_the_configured_one_is_not_obeyed_whatever_it_says(data):
    companion = Companion(MISSION, CompanionConfig(system_id=1))
    for k, item in enumerate(data):
        out = companion.step(k * 20_000, [Datagram(VEHICLE_LINK, item)])
        assert not [o for o in out if isinstance(o, Note)]
    assert companion.phase is Phase.CONNECTING
    assert companion.link.foreign_packets == len(data)
