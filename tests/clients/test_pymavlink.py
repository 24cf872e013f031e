"""pymavlink's own clients against the vehicle's process: `mavutil`, `mavparm`, `mavwp`, `mavftp`."""

import time
import zlib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from pymavlink import mavparm, mavutil, mavwp
from pymavlink.mavftp import MAVFTP
from vehicle_process import VehicleProcess, free_port

pytestmark = pytest.mark.udp


@pytest.fixture(scope="module")
def connection(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Any]:
    """What `mavutil.mavlink_connection` makes of a vehicle that calls it and records itself."""
    port = free_port()
    folder = tmp_path_factory.mktemp("record")
    patch = pytest.MonkeyPatch()
    patch.setenv("MAVLINK20", "1")
    mavutil.set_dialect("common")
    with VehicleProcess("--connect", f"udpout:127.0.0.1:{port}", "--record", str(folder)):
        found = mavutil.mavlink_connection(f"udpin:127.0.0.1:{port}", source_system=255, source_component=190)
        try:
            assert found.wait_heartbeat(timeout=10) is not None
            yield found
        finally:
            found.close()
            patch.undo()


def ask(connection: Any, send: Callable[[], object], kind: str) -> Any:
    """Send, and the first answer of a kind."""
    while connection.recv_match(blocking=False):
        pass
    send()
    answer = connection.recv_match(type=kind, blocking=True, timeout=3)
    assert answer is not None, kind
    return answer


def test_every_parameter_comes_by_list_by_index_and_by_name(connection: Any) -> None:
    connection.param_fetch_all()
    listed: dict[str, tuple[float, int, int]] = {}
    deadline = time.monotonic() + 5
    count, hashed = None, False
    while count is None or len(listed) < count or not hashed:
        assert time.monotonic() < deadline, f"{len(listed)} of {count}"
        message = connection.recv_match(type="PARAM_VALUE", blocking=True, timeout=1)
        if message is not None and message.param_index == 65535:
            hashed = message.param_id == "_HASH_CHECK"
        elif message is not None:
            listed[message.param_id] = (message.param_value, message.param_type, message.param_index)
            count = message.param_count
    assert sorted(index for _, _, index in listed.values()) == list(range(len(listed)))
    for name in ("MPC_LAND_SPEED", "COM_OBL_RC_ACT"):
        value, kind, index = listed[name]
        by_name = ask(connection, lambda name=name: connection.param_fetch_one(name), "PARAM_VALUE")
        by_index = ask(connection, lambda index=index: connection.param_fetch_one(index), "PARAM_VALUE")
        for one in (by_name, by_index):
            assert (one.param_id, one.param_value, one.param_type, one.param_index) == (name, value, kind, index)
    assert ask(connection, lambda: connection.param_fetch_one("NO_SUCH"), "STATUSTEXT").text.startswith("Parameter")


def test_mavparm_sets_floats_and_integers(connection: Any) -> None:
    parameters = mavparm.MAVParmDict()
    assert parameters.mavset(connection, "MPC_LAND_SPEED", 0.8)
    got = ask(connection, lambda: connection.param_fetch_one("MPC_LAND_SPEED"), "PARAM_VALUE")
    assert got.param_value == pytest.approx(0.8)
    assert parameters.mavset(connection, "COM_OBL_RC_ACT", 4, parm_type=mavutil.mavlink.MAV_PARAM_TYPE_INT32)
    packed = connection_file(connection, "@PARAM/param.pck")
    assert {name: value for name, value, _ in MAVFTP.ftp_param_decode(packed).params}[b"COM_OBL_RC_ACT"] == 4


def connection_file(connection: Any, name: str) -> bytes:
    """A whole file by mavftp, into memory."""
    data = MAVFTP(connection, 1, 1).read(name, 1 << 20)
    assert data is not None, name
    return bytes(data)


def test_mavftp_lists_reads_and_checks(connection: Any) -> None:
    ftp = MAVFTP(connection, 1, 1)
    for setting in (["read_retry_time", "0.2"], ["idle_detection_time", "0.4"]):  # it sits a refusal out that long
        assert ftp.cmd_set(setting).error_code == 0
    found = {entry.name: entry.is_dir for entry in ftp.cmd_list(["/"]).directory_listing}
    assert found == {"@PARAM": True, "etc": True, "fs": True, "log": True}
    (recording,) = ftp.cmd_list(["/log"]).directory_listing
    assert recording.size_b > 0
    assert recording.name.endswith(".mcap")
    start = connection_file(connection, f"/log/{recording.name}")
    assert len(start) >= recording.size_b
    assert start.startswith(b"\x89MCAP0\r\n")
    described = connection_file(connection, "/etc/extras/parameters.json")
    assert zlib.crc32(described) == zlib.crc32(connection_file(connection, "etc/extras/parameters.json"))
    assert ftp.cmd_crc(["etc/extras/parameters.json"]).error_code == 0
    assert ftp.cmd_list(["/nowhere"]).error_code == 10  # no such file
    assert ftp.cmd_mkdir(["/log/new"]).error_code == 9  # protected
    assert ftp.cmd_rm([f"/log/{recording.name}"]).error_code == 9


def test_a_lossy_link_costs_time_and_no_byte(connection: Any) -> None:
    """mavftp drops a tenth of what it gets; gaps are read again."""
    ftp = MAVFTP(connection, 1, 1)
    for setting in (["pkt_loss_rx", "10"], ["retry_time", "0.2"], ["read_retry_time", "0.2"]):
        assert ftp.cmd_set(setting).error_code == 0
    data = ftp.read("etc/extras/parameters.json", 1 << 20)
    assert data is not None
    assert bytes(data) == connection_file(connection, "etc/extras/parameters.json")


def test_a_mission_is_loaded_and_read_back(connection: Any, tmp_path: Path) -> None:
    """As MAVProxy and scripts do it: count, items as they are asked for, then the list back, one by one."""
    m = mavutil.mavlink
    loader = mavwp.MAVWPLoader(target_system=1, target_component=1)
    for number, (command, north) in enumerate(((22, 0.0), (16, 1e-4), (16, 2e-4), (21, 2e-4))):
        item = m.MAVLink_mission_item_message(
            1, 1, number, m.MAV_FRAME_GLOBAL_RELATIVE_ALT, command, 0, 1, 0, 0, 0, 0, 47.3977 + north, 8.5456, 5.0
        )
        loader.add(item)
    file = tmp_path / "mission.txt"
    loader.save(str(file))
    again = mavwp.MAVWPLoader(target_system=1, target_component=1)
    assert again.load(str(file)) == 4
    message = ask(
        connection, lambda: connection.waypoint_count_send(again.count()), ["MISSION_REQUEST", "MISSION_REQUEST_INT"]
    )
    for _ in range(20):
        if message.get_type() == "MISSION_ACK":
            break
        connection.mav.send(again.wp(message.seq))
        message = connection.recv_match(
            type=["MISSION_REQUEST", "MISSION_REQUEST_INT", "MISSION_ACK"], blocking=True, timeout=3
        )
        assert message is not None
    assert message.type == m.MAV_MISSION_ACCEPTED
    assert ask(connection, connection.waypoint_request_list_send, "MISSION_COUNT").count == 4
    for number in range(4):
        got = ask(connection, lambda number=number: connection.waypoint_request_send(number), "MISSION_ITEM")
        want = again.wp(number)
        assert (got.seq, got.command, got.frame) == (number, want.command, want.frame)
        assert (got.x, got.y, got.z) == pytest.approx((want.x, want.y, want.z), abs=2e-5)
    assert ask(connection, connection.waypoint_clear_all_send, "MISSION_ACK").type == m.MAV_MISSION_ACCEPTED
    assert ask(connection, connection.waypoint_request_list_send, "MISSION_COUNT").count == 0
