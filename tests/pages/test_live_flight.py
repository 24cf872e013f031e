"""The live page of a real flight: the bundled vehicle over UDP, the companion's own server, a browser."""

import json
import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from companion.drivers.rerun import rerun
from logs import schema
from logs.reader import Recording
from tests.pages.browser import Browser

PAGE = "companionPage.page"


@pytest.fixture
def demo(tmp_path: Path) -> Iterator[tuple[subprocess.Popen[str], str]]:
    """`companion demo --live`, and the address it prints."""
    command = [sys.executable, "-m", "companion", "demo", "--live", "0", "--json", "--record", str(tmp_path)]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert process.stderr is not None
    address = ""
    while not address:
        line = process.stderr.readline()
        assert line, process.wait()
        found = re.search(r"live page: (http://\S+)", line)
        address = found.group(1) if found else ""
    yield process, address
    if process.poll() is None:
        for _ in range(2):
            os.kill(process.pid, signal.SIGINT)
            time.sleep(0.2)
    process.communicate(timeout=20)


@pytest.mark.udp
def test_the_page_follows_a_flight_at_ten_hertz_and_its_land_button_lands_it(demo, browser: Browser):
    process, address = demo
    page = browser.page(address)
    page.until("window.companionPage?.ready && companionPage.link.state === 'connected'")
    page.until("document.querySelector('.badge').textContent === 'flying'", timeout=40)
    before, began_s = page.js("companionPage.link.messages"), time.monotonic()
    time.sleep(1.5)
    messages, seconds = page.js("companionPage.link.messages") - before, time.monotonic() - began_s
    assert messages / seconds >= 10
    assert page.js(f"{PAGE}.scene.path.length") > 100
    assert page.js(f"{PAGE}.scene.drawn.obstacles") >= 1
    assert page.js(f"{PAGE}.scene.drawn.plans") >= 1
    assert 1.0 < page.js(f"{PAGE}.scene.craft.position.y") < 2.0
    assert page.js(f"{PAGE}.plots.find('error').lines[0].v.length") > 100
    page.click_on("[data-order=land]")
    page.click_on("[data-confirm=land]")
    page.until("document.querySelector('.toast')?.textContent === 'land: told to the flight'")
    page.until("document.querySelector('.badge').textContent === 'landing'")
    out, _ = process.communicate(timeout=40)
    result = json.loads(out)
    assert result["failure"] == "cancelled by the operator"
    assert "cancelled by the operator" in page.js("document.querySelector('#verdict').innerText")
    page.until("companionPage.link.state === 'lost'")
    origin = address.partition("?")[0]
    assert all(url.startswith((origin, origin.replace("http", "ws"), "data:")) for url in page.requests), page.requests
    lost = "WebSocket connection to"  # which it tries again, and says so
    assert [text for text in page.complaints if lost not in text] == []
    page.close()
    recording = Recording.open(Path(result["recording"]))
    orders = [m for m in recording.messages(topics=(schema.TOPICS[schema.OperatorCommand],))]
    assert [recording.decode(m).source for m in orders] == ["page"]
    again = rerun(recording)
    assert again.comparison.first is None, again.comparison.first
    states = [recording.decode(m) for m in recording.messages(topics=("/mavlink/1/1/EXTENDED_SYS_STATE",))]
    assert states[-1].landed_state == 1
