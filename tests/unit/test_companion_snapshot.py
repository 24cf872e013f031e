"""The service between flights, its state, its page and its files."""

import http.client
import json
import os
import time
from pathlib import Path
from typing import Any

import pytest

from companion.core import Companion, CompanionConfig
from companion.geodesy import Geodetic
from companion.ground.protocol import MissionProtocol
from companion.ground.station import plan_file
from companion.missionfile import load_mission
from companion.planfiles.items import Item
from companion.seam import Level, Note, Order
from companion.service.http import MOST_THREADS, Board, served
from companion.service.idle import Idle
from companion.service.jsonlog import Log
from companion.service.page import render
from companion.service.queue import Missions, make_room, recording_file
from companion.service.snapshot import flight_state, idle_state, vehicle_state
from companion.vehiclelink import VEHICLE_LINK
from companion.verdict import FlightMeter
from logs.parts import part_path
from wire.datagram import Datagram
from wire.dialect import mavlink

MISSION = load_mission("missions/l_shape.yaml")
HERE = ("127.0.0.1", 1001)
ARMED = 0x80


def said(message: Any, link: str = VEHICLE_LINK, system: int = 1, component: int = 1) -> Datagram:
    sender = mavlink.MAVLink(None, srcSystem=system, srcComponent=component)
    return Datagram(link, bytes(message.pack(sender)), HERE)


def beat(base_mode: int = 1) -> Datagram:
    return said(mavlink.MAVLink_heartbeat_message(2, 12, base_mode, 0x3040000, 3, 3))


class Service:
    """An idle companion with a mission, and its clock."""

    def __init__(self, **config: Any) -> None:
        self.idle, self.now_us = Idle(CompanionConfig(**config)), 0
        self.idle.mission = "hop"

    def run(self, seconds: float, *every_second: Datagram) -> list[Any]:
        out = []
        for k in range(round(seconds * 50)):
            self.now_us += 20_000
            out += self.idle.step(self.now_us, list(every_second) if k % 50 == 0 else [])
        return out


def to_vehicle(out: list[Any]) -> list[Datagram]:
    return [o for o in out if isinstance(o, Datagram) and o.link == VEHICLE_LINK]


def test_between_flights_the_vehicle_gets_a_heartbeat_a_second_and_nothing_else() -> None:
    sent = to_vehicle(Service().run(10, beat()))
    assert 10 <= len(sent) <= 11
    assert all(d.data[7:10] == b"\0\0\0" and d.data[5:7] == bytes([1, 191]) for d in sent)


def test_a_vehicle_that_was_never_heard_is_not_spoken_to_unless_it_waits_to_be_called() -> None:
    assert not to_vehicle(Service().run(3))
    assert to_vehicle(Service(speaks_first=True).run(3))


def test_packets_are_forwarded_both_ways_between_flights() -> None:
    service = Service(ground_links=("out0",))
    question = said(mavlink.MAVLink_param_request_list_message(1, 1), "out0", 255, 190)
    out = service.run(1, beat(), question)
    assert Datagram(VEHICLE_LINK, question.data, HERE) in out
    assert Datagram("out0", beat().data) in out


def test_a_flight_begins_by_itself_when_the_vehicle_stands_there_and_not_while_it_is_armed() -> None:
    service = Service()
    service.idle.autostart = True
    service.run(5)
    assert not service.idle.over
    service.run(5, beat(1 | ARMED))
    assert not service.idle.over
    service.run(2, beat())
    assert service.idle.over


@pytest.mark.parametrize(
    ("mission", "why_not", "inputs", "reason"),
    [
        ("", "no mission is left", [beat()], "no mission is left"),
        ("", "", [beat()], "there is no mission"),
        ("hop", "", [], "the vehicle is not heard"),
        ("hop", "", [beat(1 | ARMED)], "the vehicle is armed: somebody else flies it"),
        ("hop", "", [beat()], ""),
    ],
)
def test_an_order_to_start_is_carried_out_or_refused_with_the_reason(
    mission: str, why_not: str, inputs: list[Datagram], reason: str
) -> None:
    service = Service()
    service.idle.mission, service.idle.why_not = mission, why_not
    service.run(1, *inputs)
    assert service.idle.obey(Order("start")) == reason
    assert service.idle.over == (not reason)
    assert service.idle.obey(Order("land")) == "there is no flight"


def test_a_plan_is_uploaded_between_flights_and_the_vehicle_is_asked_where_it_stands() -> None:
    service = Service(ground_links=("out0",))
    service.run(2, beat())
    plan = [(22, 3, 47.397742, 8.545594, 5.0), (16, 3, 47.3979, 8.5458, 6.0), (20, 2, 0.0, 0.0, 0.0)]
    service.run(0.02, said(mavlink.MAVLink_mission_count_message(1, 191, len(plan), 0), "out0", 255, 190))
    for k, (command, frame, latitude, longitude, altitude) in enumerate(plan):
        place = (round(latitude * 1e7), round(longitude * 1e7), altitude)
        item = mavlink.MAVLink_mission_item_int_message(1, 191, k, frame, command, 0, 1, 0, 0, 0, 0, *place, 0)
        service.run(0.02, said(item, "out0", 255, 190))
    assert service.idle.station.missions.uploads == 1
    service.idle.place_wanted = True
    asked = [d for d in to_vehicle(service.run(3, beat())) if d.data[7:10] == b"\x4c\0\0"]
    assert 2 <= len(asked) <= 4
    where = mavlink.MAVLink_global_position_int_message(100, 473977418, 85455939, 488_000, 0, 0, 0, 0, 0)
    service.run(1, beat(), said(where))
    assert not [d for d in to_vehicle(service.run(3, beat())) if d.data[7:10] == b"\x4c\0\0"]


def test_a_flight_that_is_prepared_can_be_called_off() -> None:
    service = Service()
    service.run(1, beat())
    service.idle.preparing = True
    assert service.idle.obey(Order("abort")) == ""
    assert service.idle.cancelled


def test_a_vehicle_that_falls_silent_and_comes_back_from_another_port_is_taken_up_again() -> None:
    service = Service()
    service.run(2, beat())
    assert service.idle.heard
    notes = [o.text for o in service.run(5) if isinstance(o, Note)]
    assert notes == ["nothing heard from the vehicle for 3 s"]
    assert not service.idle.heard
    sent = to_vehicle(service.run(2, Datagram(VEHICLE_LINK, beat().data, ("127.0.0.1", 2002))))
    assert {d.peer for d in sent} == {("127.0.0.1", 2002)}


def test_the_state_has_the_same_keys_before_anything_is_known_and_later_and_is_json() -> None:
    service = Service()
    before = idle_state(0, service.idle)
    position = said(mavlink.MAVLink_local_position_ned_message(100, 1.0, 2.0, -3.0, 0.5, 0.0, 0.0))
    service.run(1, beat(), position)
    after = idle_state(service.now_us, service.idle)
    assert before.keys() == after.keys()
    assert (before["heard"], before["position_m"], after["heard"]) == (False, None, True)
    assert after["position_m"] == [1.0, 2.0, -3.0]
    companion = Companion(MISSION, CompanionConfig())
    flight = flight_state(companion, FlightMeter(companion))
    vehicle = vehicle_state(0, companion.link, companion.telemetry)
    json.dumps([before, after, flight, vehicle], allow_nan=False)
    assert vehicle.keys() == after.keys()


def ask(place: tuple[str, int], path: str, method: str = "GET", **headers: str) -> tuple[int, str]:
    connection = http.client.HTTPConnection(*place, timeout=5)
    try:
        connection.request(method, path, headers=headers)
        answer = connection.getresponse()
        return answer.status, answer.read().decode()
    finally:
        connection.close()


def test_the_page_the_state_and_the_health_are_served_to_this_machine_only() -> None:
    board = Board()
    with served(("127.0.0.1", 0), board) as place:
        assert ask(place, "/health") == (503, '{\n  "ok": false,\n  "reason": "the loop hangs"\n}\n')
        assert ask(place, "/ready")[0] == 503
        board.put({"state": "idle", "vehicle": {"heard": False}})
        assert ask(place, "/health")[0] == 200  # a vehicle that is off is no reason to restart the companion
        assert ask(place, "/ready") == (503, '{\n  "ok": false,\n  "reason": "the vehicle is not heard"\n}\n')
        board.put({"state": "idle", "vehicle": {"heard": True}, "mission": "<b>hop</b>"})
        assert ask(place, "/health")[0] == ask(place, "/ready")[0] == 200
        assert json.loads(ask(place, "/state.json")[1])["mission"] == "<b>hop</b>"
        status, page = ask(place, "/")
        assert status == 200
        assert "&lt;b&gt;hop&lt;/b&gt;" in page
        assert ask(place, "/", "HEAD") == (200, "")
        assert ask(place, "/elsewhere")[0] == 404
        assert ask(place, "/", "POST")[0] == 501
        assert ask(place, "/state.json", Host="evil.example")[0] == 403
        held = [http.client.HTTPConnection(*place, timeout=5) for _ in range(2 * MOST_THREADS)]
        for connection in held:
            connection.connect()
        for connection in held:
            connection.close()
        end_s = time.monotonic() + 5
        while time.monotonic() < end_s:
            try:
                assert ask(place, "/state.json")[0] == 200
                break
            except OSError:
                continue
        else:
            pytest.fail("the page is not served any more after many held it open")


def test_the_page_needs_nothing_from_elsewhere_and_takes_any_state() -> None:
    for state in ({}, {"vehicle": {"heard": True, "battery": 0.5, "position_m": [1.0, 2.0, 3.0]}, "up_s": 4000}):
        page = render(state, "")
        assert "http://" not in page
        assert "https://" not in page
    assert "50 %" in page
    assert "position NED" in page
    nothing, something = ({"routing": {"routed": n, "ours": 0}} for n in (0, 3))
    assert "Packets routed" not in render(nothing, "")
    assert "Packets routed" in render(something, "")
    told = render({"notes": [{"time": "2026-11-23T19:46:28.355Z", "level": "warning", "text": "<i>"}]}, "")
    assert '<span class="warn">&lt;i&gt;</span>' in told
    assert "1 h 6 min" in page


def test_an_entry_of_the_log_is_one_line_of_json_whatever_its_text(capsys: pytest.CaptureFixture[str]) -> None:
    Log("json").write(Level.WARNING, "flying", "two\nlines \x1b[31m", ok=False)
    Log("text").write(Level.ERROR, "flying", "two\nlines \x1b[31m")
    first, second = capsys.readouterr().err.splitlines()
    entry = json.loads(first)
    assert (entry["level"], entry["phase"], entry["text"], entry["ok"]) == (
        "warning",
        "flying",
        "two\nlines \x1b[31m",
        False,
    )
    assert "\x1b" not in second


def test_the_missions_of_a_folder_come_once_each_by_name_and_a_file_again_and_again(tmp_path: Path) -> None:
    text = Path("missions/l_shape.yaml").read_text()
    for name in ("b.yaml", "a.yaml"):
        (tmp_path / name).write_text(text)
    (tmp_path / "notes.txt").write_text("no mission")
    missions, flown = Missions(folder=tmp_path), []
    missions.look()
    while missions.ready is not None:
        flown.append(Path(missions.ready.file).name)
        missions.done()
    assert flown == ["a.yaml", "b.yaml"]
    assert missions.why_not == "no mission is left"
    again = Missions(file=tmp_path / "a.yaml")
    again.look()
    again.done()
    assert again.ready is not None
    broken = Missions(file=tmp_path / "notes.txt")
    broken.look()
    assert "found 'no mission', expected a mapping" in broken.why_not


def test_of_a_file_with_several_vehicles_the_part_of_our_number_is_flown(tmp_path: Path) -> None:
    file = Path("missions/swap.yaml")
    missions = Missions(file=file, number=2)
    missions.look()
    assert missions.ready is not None
    assert missions.ready.mission.start_m() == (0, 6, 0)
    alone = Missions(file=file)
    alone.look()
    assert "expected fleet.number to say which is ours" in alone.why_not


def test_an_uploaded_plan_is_flown_before_the_files_until_it_is_cleared() -> None:
    missions = Missions(file=Path("missions/l_shape.yaml"))
    missions.look()
    items = [Item(22, 3, (0.0,) * 4 + (47.397742, 8.545594, 5.0)), Item(20, 2, (0.0,) * 7)]
    missions.upload(plan_file(MissionProtocol(items), Geodetic(47.397742, 8.545594, 488.0)))
    for _ in range(2):
        assert missions.ready is not None
        assert missions.ready.file == Missions.UPLOADED
        missions.done()
    missions.upload(None)
    assert missions.ready is not None
    assert missions.ready.mission.name == "L-shaped wall"
    missions.upload(b"no plan")
    assert missions.ready is None
    assert missions.why_not.startswith("uploaded.plan: ")


def test_a_folder_that_cannot_be_read_is_told_and_looked_at_again(tmp_path: Path) -> None:
    missions = Missions(folder=tmp_path / "later")
    missions.look()
    assert missions.why_not.endswith("cannot be read: No such file or directory")
    (tmp_path / "later").mkdir()
    (tmp_path / "later" / "a.yaml").write_text(Path("missions/l_shape.yaml").read_text())
    missions.look()
    assert missions.ready is not None


def test_the_oldest_of_our_recordings_make_room_and_other_files_stay(tmp_path: Path) -> None:
    files = [recording_file(tmp_path, MISSION) for _ in range(3)]
    for age, file in enumerate(files):
        file.write_bytes(bytes(600_000))
        os.utime(file, (1e9 + age, 1e9 + age))
    part = part_path(files[0], 2)
    part.write_bytes(bytes(10))
    os.utime(part, (1e9 + 0.5, 1e9 + 0.5))
    (tmp_path / "mine.mcap").write_bytes(bytes(5_000_000))
    assert make_room(tmp_path, 1.0) == [files[0], part, files[1]]
    assert sorted(p.name for p in tmp_path.iterdir()) == sorted([files[2].name, "mine.mcap"])
