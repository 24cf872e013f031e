"""A reboot by command: the vehicle as at its start, with the parameters and plans there were."""

import pytest
from flight_double import PointMass
from vehicle_pilot import ACCEPTED, NAN, REJECTED, UNSUPPORTED, Pilot, position

import fakevehicle.vehicle
from fakevehicle.config import Autopilot, LinkConfig, VehicleConfig
from fakevehicle.vehicle import Vehicle
from wire.dialect import mavlink as m

REBOOT = 246
YEAR_US = 1_700_000_000_000_000


def stand(autopilot: Autopilot = "px4") -> Pilot:
    config = VehicleConfig(links=(LinkConfig("onboard"),), start_unix_us=YEAR_US, autopilot=autopilot)
    pilot = Pilot(Vehicle(config))
    pilot.run(4.0)
    return pilot


@pytest.fixture
def pilot(monkeypatch: pytest.MonkeyPatch) -> Pilot:
    monkeypatch.setattr(fakevehicle.vehicle, "FlightStack", PointMass)
    return stand()


def boot_ms(pilot: Pilot) -> int:
    pilot.send(m.MAVLink_command_long_message(1, 1, 512, 0, m.MAVLINK_MSG_ID_SYSTEM_TIME, 0, 0, 0, 0, 0, 0))
    pilot.tick()
    return int(pilot.last("SYSTEM_TIME").time_boot_ms)


@pytest.mark.parametrize("params", [(1,), (1, 1, 1, 1), (1, 0, 0, 0, 0, 0, 0)])
def test_time_begins_anew_and_the_clock_on_the_wall_goes_on(pilot: Pilot, params: tuple[int, ...]) -> None:
    assert pilot.command(REBOOT, *params) == ACCEPTED
    pilot.tick()
    begun_us = pilot.now_us
    assert boot_ms(pilot) == 4
    pilot.run(1.0)
    assert boot_ms(pilot) == (pilot.now_us - begun_us) // 1000 == 1008
    assert pilot.last("SYSTEM_TIME").time_unix_usec == YEAR_US + pilot.now_us - 4000
    assert "Rebooting by external command" in pilot.texts()


def test_parameters_and_plans_outlive_it_and_everything_else_does_not(pilot: Pilot) -> None:
    # GIVEN a flight with settings, home and streams of its own, that has ended elsewhere
    pilot.send(m.MAVLink_param_set_message(1, 1, b"MPC_XY_CRUISE", 7.0, 9))
    pilot.send(m.MAVLink_mission_count_message(1, 1, 1, 0))
    pilot.tick()
    pilot.send(m.MAVLink_mission_item_int_message(1, 1, 0, 6, 20, 0, 1, 0, 0, 0, NAN, 0, 0, 0, 0))
    assert pilot.command(511, m.MAVLINK_MSG_ID_HIGHRES_IMU, -1) == ACCEPTED
    pilot.send(position(3, 4, -3))
    pilot.tick()
    assert (pilot.command(176, 1, 6), pilot.command(400, 1)) == (ACCEPTED, ACCEPTED)
    pilot.fly(8.0, position(30, 40, -3))
    assert pilot.command(21) == ACCEPTED
    pilot.until(lambda: not pilot.armed, 20)
    rejected = pilot.vehicle.counters.rejected_commands
    assert pilot.command(7_000) == UNSUPPORTED
    # WHEN it is rebooted
    assert pilot.command(REBOOT, 1) == ACCEPTED
    pilot.run(4.0)
    # THEN it stands where it stood, in the first mode, and only what is stored has stayed
    assert abs(pilot.last("LOCAL_POSITION_NED").x) < 0.5
    assert (pilot.armed, pilot.mode) == (False, (4, 3))
    assert pilot.vehicle.parameters["MPC_XY_CRUISE"] == 7.0
    assert pilot.last("MISSION_CURRENT").total == 1
    assert [g for g in pilot.run(0.1) if g.get_type() == "HIGHRES_IMU"]
    assert pilot.vehicle.counters.rejected_commands == rejected + 1
    # and it flies again
    assert pilot.command(400, 1) == ACCEPTED


def test_what_is_armed_is_not_rebooted_and_nothing_is_switched_off(pilot: Pilot) -> None:
    for wanted, words in ((2, "ending the simulator"), (3, "bootloader"), (NAN, ""), (0, "")):
        assert pilot.command(REBOOT, wanted) == (UNSUPPORTED if words else ACCEPTED)
        assert not words or words in pilot.texts()[-1]
    assert pilot.command(REBOOT, 0, 1) == UNSUPPORTED
    assert pilot.command(400, 1) == ACCEPTED
    assert pilot.command(REBOOT, 1) == REJECTED
    assert pilot.texts()[-1] == "Reboot denied: it is armed"
    pilot.run(0.1)
    assert pilot.armed
    assert boot_ms(pilot) > 4_000


def test_ardupilot_boots_again(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(fakevehicle.vehicle, "FlightStack", PointMass)
    pilot = stand("ardupilot")
    assert pilot.command(176, 1, 4) == ACCEPTED
    assert pilot.command(REBOOT, 1) == ACCEPTED
    pilot.run(1.0)
    assert pilot.last("HEARTBEAT").system_status == m.MAV_STATE_BOOT
    pilot.run(3.0)
    assert (pilot.last("HEARTBEAT").custom_mode, pilot.texts().count("ArduPilot Ready")) == (0, 2)
    assert pilot.command(176, 1, 4) == pilot.command(400, 1) == ACCEPTED
    assert pilot.command(REBOOT, 1) == 4


def test_a_life_after_a_reboot_is_the_life_after_the_start() -> None:
    # with the whole flight stack: same seed, same noise
    pilot = Pilot(Vehicle(VehicleConfig(links=(LinkConfig("onboard"),))))

    def first_seconds() -> list[tuple[float, ...]]:
        heard = pilot.run(3.0)
        return [(g.time_usec, g.xacc, g.ygyro, g.abs_pressure) for g in heard if g.get_type() == "HIGHRES_IMU"]

    born = first_seconds()
    assert pilot.command(REBOOT, 1) == ACCEPTED
    assert len(born) > 100
    assert first_seconds() == born


@pytest.mark.parametrize(("autopilot", "major", "minor", "kind"), [("px4", 1, 16, 255), ("ardupilot", 4, 7, 0)])
def test_clients_that_go_by_the_version_see_the_one_that_is_imitated(
    monkeypatch: pytest.MonkeyPatch, autopilot: Autopilot, major: int, minor: int, kind: int
) -> None:
    monkeypatch.setattr(fakevehicle.vehicle, "FlightStack", PointMass)
    pilot = stand(autopilot)
    pilot.command(512, m.MAVLINK_MSG_ID_AUTOPILOT_VERSION)
    pilot.tick()
    version = pilot.last("AUTOPILOT_VERSION")
    assert version.flight_sw_version == major << 24 | minor << 16 | kind
    assert bytes(version.flight_custom_version) == b"sim0.1.0"
