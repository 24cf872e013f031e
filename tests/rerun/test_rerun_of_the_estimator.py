"""Recorded sensors into a fresh estimator: the same estimate to the bit, and what other parameters would have made."""

import json
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import pytest

from companion.cli.rerun import rerun_log
from fakevehicle.config import VehicleConfig
from fakevehicle.estimator_rerun import EstimatorRerunError, rerun_estimator
from fakevehicle.faults import parse_fault
from fakevehicle.recordings import FlightLog
from fakevehicle.vehicle import Vehicle
from logs import schema
from logs.reader import Recording
from tests.vehicle_pilot import NAN, Pilot
from wire.datagram import Datagram
from wire.dialect import mavlink

FAULTS = ("gps:off@14-18", "baro:delay=0.2@12", "mag:noise=0.05,0.05,0.05@10-20", "gyro:bias=0.01,0,0@16")


class Recorded:
    """A vehicle whose every tick is recorded, with its sensors or without."""

    def __init__(self, vehicle: Vehicle, log: FlightLog) -> None:
        self._vehicle, self._log = vehicle, log

    def __getattr__(self, name: str):
        return getattr(self._vehicle, name)

    def step(self, now_us: int, inputs: Sequence[Datagram]) -> list[Datagram]:
        outputs = self._vehicle.step(now_us, inputs)
        self._log.tick(now_us, inputs, outputs, None)
        self._log.look(self._vehicle, now_us)
        return outputs


def flown(folder: Path, sensors: bool, autopilot="px4", faults=FAULTS) -> Path:
    """A takeoff, half a minute with faults, a parameter changed in flight, a landing by kill, and a reboot."""
    config = replace(VehicleConfig(), seed=5, autopilot=autopilot, faults=tuple(parse_fault(text) for text in faults))
    log = FlightLog(folder, config, {}, started_unix_s=0.0, threaded=False, sensors=sensors)
    pilot = Pilot(Recorded(Vehicle(config), log))
    pilot.run(8.0)
    name = b"EKF2_BARO_NOISE"
    if autopilot == "px4":
        pilot.command(mavlink.MAV_CMD_NAV_TAKEOFF, *[NAN] * 7)
        pilot.command(mavlink.MAV_CMD_COMPONENT_ARM_DISARM, 1)
        pilot.run(12.0)
        pilot.send(mavlink.MAVLink_param_set_message(1, 1, name, 0.5, mavlink.MAV_PARAM_TYPE_REAL32))
        pilot.run(4.0)
    pilot.command(mavlink.MAV_CMD_COMPONENT_ARM_DISARM, 0, 21196)
    pilot.run(2.0)
    pilot.command(mavlink.MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN, 1)
    pilot.run(3.0)
    log.close()
    return log.path


@pytest.fixture(scope="module")
def sensors(tmp_path_factory) -> Path:
    return flown(tmp_path_factory.mktemp("with"), sensors=True)


def test_the_same_sensors_give_the_same_estimate_to_the_bit_through_faults_a_changed_parameter_and_a_reboot(sensors):
    opened = Recording.open(sensors)
    begins = [
        schema.decode(schema.EstimatorBegin, m.data)
        for m in opened.messages(topics=(schema.TOPICS[schema.EstimatorBegin],))
    ]
    assert [begin.fresh for begin in begins] == [True, False, True]
    assert json.loads(begins[1].parameters)["EKF2_BARO_NOISE"] == 0.5
    again = rerun_estimator(opened)
    assert again.comparison.first is None
    assert again.comparison.equal == again.comparison.outputs > 250
    assert again.ticks * 0.004 == pytest.approx(again.simulated_s) == pytest.approx(29, abs=0.1)
    last = [
        schema.decode(schema.EstimatorState, m.data)
        for m in opened.messages(topics=(schema.TOPICS[schema.EstimatorState],))
    ]
    assert max(-state.position_n[2] for state in last) > 2.0  # it flew
    assert {"gps_position", "gps_velocity", "baro", "mag"} <= set(last[-1].sensors.split(","))


def test_another_noise_makes_another_estimate_and_the_list_says_which_fields(sensors, capsys):
    assert rerun_log(sensors, as_json=True, sets=["EKF2_GPS_P_NOISE=1.5"], estimator=True) == 0
    result = json.loads(capsys.readouterr().out)
    assert result["ok"]
    assert result["set"] == {"EKF2_GPS_P_NOISE": 1.5}
    listed = {change["what"]: change for change in result["changes"]}
    assert 0.01 < listed["EstimatorState.position_n"]["largest"] < 5.0
    assert listed["EstimatorState.nis"]["times"] > 100


def test_a_rerun_of_the_estimator_says_so_in_words_and_in_its_exit_code(sensors, capsys):
    assert rerun_log(sensors, as_json=False, sets=[], estimator=True) == 0
    assert "outputs the same" in capsys.readouterr().out


def test_a_recording_without_sensors_and_a_parameter_that_is_none_are_one_line(sensors, tmp_path):
    plain = flown(tmp_path, sensors=False, autopilot="ardupilot", faults=())
    assert plain.stat().st_size < sensors.stat().st_size
    with pytest.raises(EstimatorRerunError, match="holds no sensors, expected"):
        rerun_log(plain, as_json=False, sets=[], estimator=True)
    for text, told in (
        ("EKF2_GPS_P_NOIS=1", "did you mean EKF2_GPS_P_NOISE"),
        ("EKF2_GPS_P_NOISE=-1", "outside"),
        ("EKF2_GPS_P_NOISE=much", "EKF2_GPS_P_NOISE: found 'much', expected a number"),
        ("limits.speed=1", "no such parameter"),
    ):
        with pytest.raises(EstimatorRerunError, match=told):
            rerun_log(sensors, as_json=False, sets=[text], estimator=True)
