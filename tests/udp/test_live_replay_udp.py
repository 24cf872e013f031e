"""`companion replay --live`: the page shows the recorded flight at the replay's pace, and takes no orders."""

import json
import re
import subprocess
import sys
from pathlib import Path
from urllib.parse import parse_qs, urlsplit

import pytest
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from companion.testing.flight import Flight
from companion.testing.spec import FlightSpec
from tests.vehicle_process import free_port

pytestmark = pytest.mark.udp
RATE = 8.0


@pytest.fixture(scope="module")
def recording(tmp_path_factory) -> Path:
    file = tmp_path_factory.mktemp("recordings") / "hop.mcap"
    assert Flight(FlightSpec(Path("missions/hop.yaml"), record=file)).fly().ok
    return file


def test_a_replay_is_shown_at_its_own_pace_from_its_first_phase_to_its_verdict(recording):
    command = [sys.executable, "-m", "companion", "replay", str(recording), "--rate", str(RATE), "--json"]
    command += ["--to", f"udpout:127.0.0.1:{free_port()}", "--live", "0"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert process.stderr is not None
    while not (found := re.search(r"live page: (http://\S+)", line := process.stderr.readline())):
        assert line, process.wait()
    url = urlsplit(found.group(1))
    token = parse_qs(url.query)["token"][0]
    rows, messages, answers, header = [], 0, [], {}
    with connect(f"ws://{url.netloc}/live?{url.query}", origin=f"http://{url.netloc}", max_size=None) as connection:
        whole = json.loads(connection.recv(timeout=5))
        assert ["replay of", str(recording)] in whole["header"]["facts"]
        connection.send(json.dumps({"order": "land", "values": [], "token": token}))
        try:
            while True:
                message = json.loads(connection.recv(timeout=10))
                answers += [message["answer"]] if "answer" in message else []
                more = message.get("append", {})
                rows += more.get("path", [])
                header |= more.get("header", {})
                messages += 1
        except ConnectionClosed:
            pass
    out, _ = process.communicate(timeout=10)
    result = json.loads(out)
    assert process.returncode == 0
    assert result["ok"]
    assert messages / result["duration_s"] >= 9  # nearly ten a second, and each has what is new
    times = [row[0] for row in rows]
    assert times == sorted(times)
    assert times[-1] > 0.9 * RATE * result["duration_s"]
    assert len(times) > 100
    assert header["phase"] == "done"
    assert header["ok"] is True
    assert answers == [{"order": "land", "ok": False, "text": "no flight is under way"}]
    assert result["spacing_error_p99_ms"] < 10  # the page beside it does not hold the replay up
