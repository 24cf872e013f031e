"""What the service flies: the mission as its file is when a start is asked, and not as it was."""

from pathlib import Path
from typing import Any

import pytest

from companion.config import ServiceConfig
from companion.core import CompanionConfig
from companion.seam import Order
from companion.service.choice import Choice
from companion.service.idle import Idle
from companion.service.jsonlog import Log
from companion.service.telling import Telling
from companion.vehiclelink import VEHICLE_LINK
from tests.conftest import HOP
from wire.datagram import Datagram
from wire.dialect import mavlink

MISSION, FENCE = mavlink.MAV_MISSION_TYPE_MISSION, mavlink.MAV_MISSION_TYPE_FENCE


class Chosen:
    """An idle companion under a vehicle that stands there, and what it would fly."""

    def __init__(self, **config: Any) -> None:
        self.idle, self.telling = Idle(CompanionConfig()), Telling(Log("json"))
        self.choice = Choice(ServiceConfig(master="udpin:1", **config), self.idle, self.telling)
        self.choice.look()
        self.now_us = 0
        self.run(1.5)

    def run(self, seconds: float) -> None:
        sender = mavlink.MAVLink(None, srcSystem=1, srcComponent=1)
        beat = mavlink.MAVLink_heartbeat_message(2, 12, 1, 0x3040000, 3, 3)
        for _ in range(round(seconds * 50)):
            self.now_us += 20_000
            self.idle.step(self.now_us, [Datagram(VEHICLE_LINK, bytes(beat.pack(sender)), ("127.0.0.1", 1))])

    @property
    def climb(self) -> float:
        assert self.choice.ready is not None
        takeoff = self.choice.ready.mission.steps[0].takeoff
        assert takeoff is not None
        return takeoff.altitude


@pytest.fixture
def file(tmp_path: Path) -> Path:
    file = tmp_path / "hop.yaml"
    file.write_text(HOP)
    return file


def test_a_file_that_was_edited_is_flown_as_it_is_when_the_start_is_asked(file: Path) -> None:
    chosen = Chosen(mission=file)
    file.write_text(HOP.replace("altitude: 1.5}\n  - goto", "altitude: 2.5}\n  - goto"))
    assert chosen.idle.obey(Order("start")) == ""
    assert chosen.idle.over
    assert chosen.climb == 2.5
    assert chosen.choice.ready is not None
    assert chosen.choice.ready.data == file.read_bytes()


def test_an_edit_after_a_flight_is_flown_the_next_time(file: Path) -> None:
    chosen = Chosen(mission=file)
    chosen.choice.flown(None)
    file.write_text(HOP.replace("altitude: 1.5}\n  - goto", "altitude: 2.5}\n  - goto"))
    assert chosen.idle.obey(Order("start")) == ""
    assert chosen.climb == 2.5


def test_a_file_that_became_bad_is_refused_by_its_line_and_flown_again_once_it_is_mended(file: Path) -> None:
    chosen = Chosen(mission=file)
    file.write_text(HOP.replace("name: hop", "nam: hop"))
    reason = chosen.idle.obey(Order("start"))
    assert reason.startswith(f"{file}: line 1: name: found nothing, expected a value")
    assert not chosen.idle.over
    assert (chosen.choice.ready, chosen.choice.missions.why_not) == (None, reason)
    file.unlink()
    assert chosen.idle.obey(Order("start")) == f"{file}: cannot be read: No such file or directory"
    file.write_text(HOP)
    assert chosen.idle.obey(Order("start")) == ""


def test_a_flight_that_begins_by_itself_is_of_the_file_as_it_is_then(file: Path) -> None:
    chosen = Chosen(mission=file)
    file.write_text(HOP.replace("altitude: 1.5}\n  - goto", "altitude: 2.5}\n  - goto"))
    chosen.idle.autostart = True
    chosen.run(0.1)
    assert chosen.idle.over
    assert chosen.climb == 2.5


def test_a_map_that_was_replaced_is_read_anew_when_the_start_is_asked(tmp_path: Path) -> None:
    import numpy as np

    def write(resolution: float) -> None:
        np.savez(tmp_path / "map.npz", occupied=np.ones((2, 2, 2), bool), origin=[8, 8, 0], resolution=resolution)

    write(0.1)
    file = tmp_path / "hop.yaml"
    file.write_text(HOP.replace("  obstacles:\n", "  obstacles:\n    - voxels: map.npz\n"))
    chosen = Chosen(mission=file)
    before = chosen.choice.ready
    chosen.choice.look()
    assert chosen.choice.ready is before  # as long as nobody starts, only the file's bytes are looked at
    write(0.2)
    assert chosen.idle.obey(Order("start")) == ""
    assert before is not None
    assert chosen.choice.ready is not None
    point = np.array([[8.3, 8.3, -0.3]])
    assert chosen.choice.ready.mission.planner_world().distance(point)[0] < 0.0
    assert before.mission.planner_world().distance(point)[0] > 0.0


def test_after_a_flight_that_was_called_off_the_next_is_begun_by_a_person_and_later_ones_by_themselves(
    tmp_path: Path,
) -> None:
    for name in ("a.yaml", "b.yaml", "c.yaml"):
        (tmp_path / name).write_text(HOP)
    chosen = Chosen(missions_dir=tmp_path, autostart=True)
    assert chosen.idle.autostart
    chosen.choice.called_off()
    chosen.choice.look()
    assert not chosen.idle.autostart
    assert chosen.idle.obey(Order("start")) == ""
    chosen.telling.last_flight = {"ok": True}
    chosen.choice.flown(None)
    chosen.choice.look()
    assert chosen.idle.autostart


def test_a_file_is_not_flown_past_a_fence_that_was_uploaded_until_that_is_cleared(file: Path) -> None:
    chosen = Chosen(mission=file)
    ours, station = (1, 191), mavlink.MAVLink(None, srcSystem=255, srcComponent=190)

    def upload(plan: int, *rows: tuple[Any, ...]) -> None:
        items = [mavlink.MAVLink_mission_item_int_message(*ours, k, *row, plan) for k, row in enumerate(rows)]
        for message in (mavlink.MAVLink_mission_count_message(*ours, len(rows), plan), *items):
            datagram = Datagram("out0", bytes(message.pack(station)), ("gcs", 1))
            chosen.idle.station.take(chosen.now_us, datagram, chosen.idle.obey)

    circle = (0, mavlink.MAV_CMD_NAV_FENCE_CIRCLE_INCLUSION, 0, 1, 50, 0, 0, 0, 473977420, 85455940, 0)
    upload(FENCE, circle)
    assert "a fence was uploaded" in chosen.idle.obey(Order("start"))
    assert not chosen.idle.over
    chosen.idle.telemetry.global_e7 = (473977420, 85455940, 488000)
    far = (3, mavlink.MAV_CMD_NAV_WAYPOINT, 0, 1, 0, 0, 0, 0, 473990000, 85455940, 5)
    upload(MISSION, far)  # beyond the fence: neither it nor the file is flown
    for _ in range(2):
        assert "item 0: steps.1.goto: found a place" in chosen.idle.obey(Order("start"))
    assert not chosen.idle.over
    upload(MISSION)
    upload(FENCE)
    assert chosen.idle.obey(Order("start")) == ""
