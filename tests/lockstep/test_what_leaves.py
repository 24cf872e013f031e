"""What leaves the companion in each phase, as bytes decoded by the dialect: for both autopilots, in one table."""

import numpy as np
import pytest

from companion.phases import OVER, Phase
from companion.vehiclelink import VEHICLE_LINK
from tests.conftest import HOP
from wire.datagram import Datagram
from wire.dialect import mavlink

COMMANDS = {511: "streams", 176: "mode", 400: "arm", 22: "takeoff"}
SENT = {
    "px4": {
        Phase.PREPARING: {"HEARTBEAT", "streams", "PARAM_REQUEST_READ"},
        Phase.PLANNING: {"HEARTBEAT", "setpoint"},
        Phase.ENGAGING: {"HEARTBEAT", "setpoint", "mode"},
        Phase.ARMING: {"HEARTBEAT", "setpoint", "arm"},
        Phase.TAKING_OFF: {"HEARTBEAT", "setpoint"},
        Phase.FLYING: {"HEARTBEAT", "setpoint"},
        Phase.LANDING: {"HEARTBEAT", "setpoint", "mode"},
        Phase.DONE: set(),
    },
    "ardupilot": {
        Phase.PREPARING: {"HEARTBEAT", "streams", "PARAM_REQUEST_READ", "PARAM_SET"},
        Phase.PLANNING: {"HEARTBEAT"},
        Phase.ENGAGING: {"HEARTBEAT", "mode"},
        Phase.ARMING: {"HEARTBEAT", "arm"},
        Phase.TAKING_OFF: {"HEARTBEAT", "takeoff"},
        Phase.FLYING: {"HEARTBEAT", "setpoint"},
        Phase.LANDING: {"HEARTBEAT", "mode"},
        Phase.DONE: set(),
    },
}
"""Nothing else may leave in a phase."""
ORDER = {
    "px4": ["streams", "mode 6 0", "arm 1", "mode 4 6"],
    "ardupilot": ["streams", "mode 4 0", "arm 1", "takeoff", "mode 9 0"],
}


def said(flight, phases):
    """(time [s], phase, message) of everything sent to the vehicle."""
    mav = mavlink.MAVLink(None)
    return [
        (tick.now_us / 1e6, phase, mav.decode(bytearray(output.data)))
        for tick, phase in zip(flight.ticks, phases, strict=True)
        for output in tick.outputs
        if isinstance(output, Datagram) and output.link == VEHICLE_LINK
    ]


def kind(m):
    if m.get_type() == "COMMAND_LONG":
        return COMMANDS[m.command]
    return {"SET_POSITION_TARGET_LOCAL_NED": "setpoint"}.get(m.get_type(), m.get_type())


@pytest.fixture(params=["px4", "ardupilot"])
def flown(request, fly):
    phases, companions = [], []

    def operator(companion, now_us):
        companions.append(companion)

    def tap(tick):
        phases.append(companions[0].phase)

    flight = fly(autopilot=request.param, operator=operator, taps=[tap])
    assert flight.verdict.ok, flight.verdict.failure
    return request.param, flight, said(flight, phases)


def test_each_phase_sends_what_its_row_says_in_the_order_and_form_that_the_autopilot_wants(flown):
    autopilot, _, sent = flown
    for phase, allowed in SENT[autopilot].items():
        found = {kind(m) for _, p, m in sent if p is phase}
        assert found <= allowed, phase
        assert allowed - {"HEARTBEAT"} <= found, phase  # a phase may be shorter than a second

    commands = [m for _, _, m in sent if m.get_type() == "COMMAND_LONG"]
    assert all((m.target_system, m.target_component) == (1, 1) for m in commands)
    words = []
    for m in commands:
        word = kind(m)
        word += f" {m.param2:g} {m.param3:g}" if word == "mode" else f" {m.param1:g}" if word == "arm" else ""
        words += [word] if word not in words else []
    assert words == ORDER[autopilot]
    assert all(m.param1 == mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED for m in commands if kind(m) == "mode")
    assert all(m.param2 == 0 for m in commands if kind(m) == "arm")  # never forced
    assert [m.param7 for m in commands if kind(m) == "takeoff"] in ([], [1.5])

    setpoints = [(t, m) for t, _, m in sent if kind(m) == "setpoint"]
    assert {(m.type_mask, m.coordinate_frame, m.target_system, m.target_component) for _, m in setpoints} == {
        (0x800, mavlink.MAV_FRAME_LOCAL_NED, 1, 1)
    }
    np.testing.assert_allclose(np.diff([t for t, _ in setpoints]), 0.02, atol=1e-9)
    numbers = [(m.x, m.y, m.z, m.vx, m.vy, m.vz, m.afx, m.afy, m.afz, m.yaw) for _, m in setpoints]
    assert np.isfinite(numbers).all()

    beats = [(t, m) for t, _, m in sent if m.get_type() == "HEARTBEAT"]
    np.testing.assert_allclose(np.diff([t for t, _ in beats]), 1.0, atol=1e-9)
    assert {(m.type, m.autopilot, m.base_mode, m.get_srcSystem(), m.get_srcComponent()) for _, m in beats} == {
        (18, 8, 0, 1, 191)
    }


def test_confirmation_is_waited_for(flown):
    """The mode shows before arming is asked for, arming before anything climbs."""
    autopilot, flight, sent = flown
    first = {}
    for t, phase, m in sent:
        first.setdefault(kind(m) if kind(m) != "setpoint" else f"setpoint in {phase.value}", t)
    mav = mavlink.MAVLink(None)
    heard = [
        (tick.now_us / 1e6, mav.decode(bytearray(item.data)))
        for tick in flight.ticks
        for _, item in tick.inputs
        if isinstance(item, Datagram) and item.data[7:10] in (b"\0\0\0", bytes([0xB4, 0x01, 0]))  # HEARTBEAT, 436
    ]
    ours = {"px4": 6 << 16, "ardupilot": 4}[autopilot]
    mode = next(t for t, m in heard if m.custom_mode == ours)
    armed = next(t for t, m in heard if m.get_type() == "HEARTBEAT" and m.base_mode & 128)
    assert first["mode"] < mode <= first["arm"] < armed
    if autopilot == "ardupilot":
        assert armed <= first["takeoff"] < first["setpoint in flying"]
        assert "setpoint in landing" not in first
    else:
        assert first["setpoint in planning"] + 0.5 <= first["mode"]


class Pilot:
    """Takes another mode at `at_s`, by a command from a ground station's address."""

    def __init__(self, vehicle, at_s, mode):
        self.vehicle, self.TICK_US, self.at_us = vehicle, vehicle.TICK_US, at_s * 1e6
        message = mavlink.MAVLink_command_long_message(1, 1, mavlink.MAV_CMD_DO_SET_MODE, 0, 1, *mode, 0, 0, 0, 0)
        data = bytes(message.pack(mavlink.MAVLink(None, srcSystem=255, srcComponent=190)))
        self.takes = Datagram("onboard", data, ("pilot", 1))

    def step(self, now_us, inputs):
        takes = [self.takes] if now_us == self.at_us else []
        return [d for d in self.vehicle.step(now_us, [*inputs, *takes]) if d.peer != ("pilot", 1)]


@pytest.mark.parametrize(("autopilot", "mode", "at_s"), [("px4", (4, 3), 10.4), ("ardupilot", (5, 0), 8.4)])
def test_after_a_pilot_took_the_mode_nothing_but_a_heartbeat_leaves(fly, autopilot, mode, at_s):
    flight = fly(autopilot=autopilot, between=lambda vehicle: Pilot(vehicle, at_s, mode), limit_s=25)
    assert flight.companion.phase is Phase.HANDED_OVER
    handed = next(t.now_us for t in flight.ticks if any("-> handed over" in str(o) for o in t.outputs)) / 1e6
    assert handed < at_s + 1.6
    sent = said(flight, [None] * len(flight.ticks))
    assert {m.get_type() for t, _, m in sent if t > handed} == {"HEARTBEAT"}
    assert not [m for t, _, m in sent if t > at_s and m.get_type() == "COMMAND_LONG"]


def test_a_reference_that_is_no_place_is_not_sent_and_the_last_one_is_held(fly, monkeypatch):
    import companion.core as core

    true, bad = core.Companion._asked_for, []

    def asked(self, now_us):
        reference = true(self, now_us)
        if 10_500_000 < now_us < 11_000_000:
            bad.append(now_us)
            reference.position_m[0] = np.nan if now_us % 40_000 else 1e9
        return reference

    monkeypatch.setattr(core.Companion, "_asked_for", asked)
    flight = fly()
    assert bad
    assert flight.companion.phase in OVER
    mav = mavlink.MAVLink(None)
    kept = [
        (t.now_us, mav.decode(bytearray(o.data)))
        for t in flight.ticks
        for o in t.outputs
        if isinstance(o, Datagram) and o.data[7] == mavlink.MAVLINK_MSG_ID_SET_POSITION_TARGET_LOCAL_NED
    ]
    held = [m for now_us, m in kept if 10_500_000 < now_us < 11_000_000]
    assert len(held) == len(bad)  # the stream goes on
    assert len({(m.x, m.y, m.z) for m in held}) == 1
    assert all((m.vx, m.vy, m.vz) == (0, 0, 0) for m in held)
    assert sum("a setpoint is withheld" in note for note in flight.notes) == 1


@pytest.mark.parametrize("autopilot", ["px4", "ardupilot"])
def test_a_high_takeoff_takes_its_time(fly, autopilot):
    high = HOP.replace("altitude: [0, 4]", "altitude: [0, 40]").replace("altitude: 1.5", "altitude: 30")
    flight = fly(high, autopilot=autopilot, limit_s=200)
    assert flight.companion.phase is Phase.DONE
    assert not flight.companion.failure
