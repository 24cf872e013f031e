"""What becomes of a flight when the link to the vehicle fails, in both flavours: as docs/safety.md says."""

from pathlib import Path

import pytest

from companion.cli.vehicle import build_vehicle
from companion.drivers.rerun import rerun
from companion.missionfile import parse_mission
from companion.phases import Phase
from logs.reader import Recording
from tests.conftest import HOP
from wire.datagram import Datagram
from wire.dialect import mavlink

FLAVOURS = ("px4", "ardupilot")
ON_A_LEG_S = {"px4": 10.0, "ardupilot": 8.5}


class Blackout:
    """Nothing passes between `start_s` and `end_s`: neither way, or only not `up` to or `down` from the vehicle."""

    def __init__(self, vehicle, start_s, end_s, way="both"):
        self.vehicle, self.TICK_US = vehicle, vehicle.TICK_US
        self.start_us, self.end_us, self.way = start_s * 1e6, end_s * 1e6, way

    def step(self, now_us, inputs):
        dark = self.start_us < now_us < self.end_us
        out = self.vehicle.step(now_us, [] if dark and self.way != "down" else inputs)
        return [] if dark and self.way != "up" else out


@pytest.mark.parametrize("autopilot", FLAVOURS)
def test_after_a_blackout_of_five_seconds_on_a_leg_the_mission_is_flown_to_its_end(fly, autopilot):
    flight = fly(
        autopilot=autopilot,
        between=lambda vehicle: Blackout(vehicle, ON_A_LEG_S[autopilot], ON_A_LEG_S[autopilot] + 5.0),
    )
    phases = [note.split(" (")[0] for note in flight.notes if " -> " in note]
    at = phases.index("flying -> link lost")
    assert phases[at : at + 3] == ["flying -> link lost", "link lost -> rejoining", "rejoining -> flying"]
    assert flight.companion.phase is Phase.DONE
    assert flight.verdict.ok, flight.verdict.failure


@pytest.mark.parametrize("way", ["up", "down"])
@pytest.mark.parametrize("autopilot", FLAVOURS)
def test_a_link_that_is_dead_one_way_for_three_seconds_does_not_end_the_mission(fly, autopilot, way):
    flight = fly(
        autopilot=autopilot,
        between=lambda vehicle: Blackout(vehicle, ON_A_LEG_S[autopilot], ON_A_LEG_S[autopilot] + 3.0, way),
    )
    assert flight.companion.phase is Phase.DONE
    assert not flight.companion.failure
    assert flight.verdict.min_clearance_m > 0.1


@pytest.mark.parametrize("autopilot", FLAVOURS)
def test_a_blackout_in_the_takeoff_ends_in_the_mission_or_in_a_landing(fly, autopilot):
    flight = fly(autopilot=autopilot, between=lambda vehicle: Blackout(vehicle, 6.5, 11.5))
    assert flight.companion.phase is Phase.DONE
    if autopilot == "px4":  # it never left the ground: it waits in Hold, and nothing leads from there to the path
        assert flight.companion.failure.startswith("no way back to the mission: the start")
    else:  # it climbs by itself
        assert not flight.companion.failure


def test_ardupilot_is_told_to_stop_a_second_after_the_last_setpoint(fly):
    flight = fly(autopilot="ardupilot")
    assert "GUID_TIMEOUT set to 1 s" in flight.notes


class Old:
    """Every HEARTBEAT of the vehicle's comes again once, 200 ms late, when its mode or arming has changed."""

    def __init__(self, vehicle):
        self.vehicle, self.TICK_US, self.last, self.late = vehicle, vehicle.TICK_US, None, []

    def step(self, now_us, inputs):
        out = self.vehicle.step(now_us, inputs)
        for datagram in out:
            if datagram.data[7:10] == bytes([mavlink.MAVLINK_MSG_ID_HEARTBEAT, 0, 0]):
                if self.last is not None and self.last.data[10:] != datagram.data[10:]:
                    self.late.append((now_us + 200_000, self.last))
                self.last = datagram
        out = out + [d for at, d in self.late if at <= now_us]
        self.late = [(at, d) for at, d in self.late if at > now_us]
        return out


@pytest.mark.parametrize("autopilot", FLAVOURS)
def test_a_heartbeat_that_comes_late_with_an_old_mode_hands_nothing_over(fly, autopilot):
    flight = fly(autopilot=autopilot, between=Old)
    assert flight.verdict.ok, flight.verdict.failure


class Shuffled:
    """Every second datagram of the vehicle's comes twice, the second time 100 ms late."""

    def __init__(self, vehicle):
        self.vehicle, self.TICK_US, self.late, self.count = vehicle, vehicle.TICK_US, [], 0

    def step(self, now_us, inputs):
        out = self.vehicle.step(now_us, inputs)
        for datagram in out:
            self.count += 1
            if self.count % 2:
                self.late.append((now_us + 100_000, datagram))
        out = out + [d for at, d in self.late if at <= now_us]
        self.late = [(at, d) for at, d in self.late if at > now_us]
        return out


@pytest.mark.parametrize("autopilot", FLAVOURS)
def test_telemetry_that_comes_again_100_ms_late_is_not_flown_by(fly, autopilot):
    flight = fly(autopilot=autopilot, between=Shuffled)
    assert flight.verdict.ok, flight.verdict.failure
    assert flight.companion.clock.rate == 1.0


class OtherClient:
    """A ground station's answers go to us as well: refusals of the commands that we are about to send, too."""

    def __init__(self, vehicle):
        self.vehicle, self.TICK_US = vehicle, vehicle.TICK_US
        mav = mavlink.MAVLink(None, srcSystem=1, srcComponent=1)
        refusals = [mavlink.MAVLink_command_ack_message(c, 4, 0, 0, 255, 190) for c in (511, 176, 400, 22)]
        self.refusals = [bytes(m.pack(mav)) for m in refusals]

    def step(self, now_us, inputs):
        out = self.vehicle.step(now_us, inputs)
        return out + [Datagram("onboard", data, None) for data in self.refusals if now_us % 100_000 == 0]


@pytest.mark.parametrize("autopilot", FLAVOURS)
def test_answers_to_another_client_are_not_taken_for_ours(fly, autopilot):
    flight = fly(autopilot=autopilot, between=OtherClient)
    assert flight.verdict.ok, flight.verdict.failure


@pytest.mark.parametrize("autopilot", FLAVOURS)
def test_after_a_blackout_a_mission_that_sees_is_planned_anew_by_what_it_sees(fly, autopilot):
    unknown = Path("missions/l_shape_unknown.yaml").read_text(encoding="utf-8")
    flight = fly(unknown, autopilot=autopilot, between=lambda vehicle: Blackout(vehicle, 12.0, 17.0))
    assert flight.companion.phase is Phase.DONE
    assert not flight.companion.failure
    assert flight.verdict.min_clearance_m > 0.0
    assert any(note.startswith("rejoining -> flying") for note in flight.notes)


def test_a_px4_that_would_not_hold_without_setpoints_is_told_to(fly):
    mission = parse_mission(HOP.encode(), "hop.yaml")
    flight = fly(between=lambda _: build_vehicle(mission, 1, parameters={"COM_OBL_RC_ACT": 3}))
    assert "COM_OBL_RC_ACT set to 5 (Hold)" in flight.notes
    assert flight.verdict.ok
    assert not [note for note in fly().notes if "COM_OBL_RC_ACT" in note]  # 5 already


@pytest.mark.parametrize("autopilot", FLAVOURS)
def test_a_flight_with_a_blackout_runs_again_from_its_recording_output_for_output(fly, autopilot, tmp_path):
    start_s = ON_A_LEG_S[autopilot]
    file = tmp_path / "flight.mcap"
    flight = fly(autopilot=autopilot, record=file, between=lambda vehicle: Blackout(vehicle, start_s, start_s + 5.0))
    again = rerun(Recording.open(file))
    assert again.comparison.first is None
    assert again.comparison.equal == again.comparison.outputs > 1000
    assert again.companion.phase is flight.companion.phase is Phase.DONE


class Forgetful:
    """The first request for each of these messages is answered, and forgotten."""

    def __init__(self, vehicle, forgotten):
        self.vehicle, self.TICK_US, self.left = vehicle, vehicle.TICK_US, set(forgotten)
        self.mav, self.decoder = mavlink.MAVLink(None, srcSystem=1, srcComponent=1), mavlink.MAVLink(None)

    def step(self, now_us, inputs):
        kept, answers = [], []
        for datagram in inputs:
            m = self.decoder.decode(bytearray(datagram.data))
            if m.get_type() == "COMMAND_LONG" and m.command == 511 and int(m.param1) in self.left:
                self.left.discard(int(m.param1))
                ack = mavlink.MAVLink_command_ack_message(511, 0, 0, 0, m.get_srcSystem(), m.get_srcComponent())
                answers.append(Datagram("onboard", bytes(ack.pack(self.mav)), None))
            else:
                kept.append(datagram)
        return self.vehicle.step(now_us, kept) + answers


def test_a_stream_that_was_acknowledged_and_does_not_come_is_asked_for_again(fly):
    flight = fly(autopilot="ardupilot", between=lambda vehicle: Forgetful(vehicle, (245, 193, 30)))
    assert flight.verdict.ok, flight.verdict.failure


@pytest.mark.parametrize("autopilot", FLAVOURS)
def test_in_the_air_nothing_is_asked_for_that_comes(fly, autopilot):
    flight = fly(autopilot=autopilot)
    decoder, asked = mavlink.MAVLink(None), []
    for tick in flight.ticks:
        for o in tick.outputs:
            if isinstance(o, Datagram) and o.data[7:10] == bytes([76, 0, 0]):
                asked.append((tick.now_us, decoder.decode(bytearray(o.data)).command))
    armed_us = next(at for at, command in asked if command == 400)
    assert 511 not in [command for at, command in asked if at > armed_us]
