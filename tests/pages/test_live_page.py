"""The live page in a browser, against a server of the tests: it appends, says when it is alone, and sends orders."""

import threading
import time
from collections.abc import Callable, Iterator

import pytest

from logs.report import contract, live_page
from tests.pages.browser import Browser, Page
from tests.pages.sockets import LiveServer

PAGE = "companionPage.page"
TOKEN = "only-here"


def start() -> dict:
    """The whole object as a flight begins: its columns are empty."""
    nothing = contract.Track([], [], [], [])
    return contract.Report(
        header=contract.Header("live flight", phase="connecting"),
        scene=contract.Scene(
            nothing, (contract.box((5, -2, 0), (6, 2, 3)),), ((-2, -10, 0), (20, 10, 5)), reference=nothing
        ),
        plots=(
            contract.Plot("error", "tracking", "Tracking error", "m", (contract.Series("distance", [], []),)),
            contract.Plot("speed", "path", "Speed", "m/s", (contract.Series("horizontal", [], []),)),
        ),
        histograms=(contract.Histogram("spacing", "setpoints", "Setpoint spacing", "ms", [0, 1, 2], [0, 0]),),
    ).to_json()


def moment(k: int) -> dict:
    """What is appended at the k-th twentieth of a second."""
    t, north = k / 20, k / 40
    return {
        "append": {
            "series": {"error": {"distance": [[t], [0.01 * (k % 7)]]}, "speed": {"horizontal": [[t], [0.5]]}},
            "path": [[t, north, 0.0, 1.5, 0.0, 0.0, 0.3]],
            "reference": [[t, north, 0.05, 1.5]],
            "pose": {"n": north, "e": 0.0, "u": 1.5, "roll": 0.0, "pitch": 0.0, "yaw": 0.3},
            "events": [{"t": t, "kind": "phase", "level": 6, "text": "preparing -> flying (ready)"}] if k == 5 else [],
            "header": {"phase": "flying"} if k == 5 else {},
        }
    }


@pytest.fixture(scope="module")
def serving() -> Iterator[LiveServer]:
    served = LiveServer(start())
    served.page = live_page("/live?key=a", TOKEN)
    yield served
    served.stop()


@pytest.fixture(scope="module")
def looking(browser: Browser, serving: LiveServer) -> Iterator[Page]:
    page = browser.page(f"http://127.0.0.1:{serving.port}/")
    page.until("window.companionPage?.ready && companionPage.link.state === 'connected'")
    yield page
    origins = ("http://127.0.0.1:", "ws://127.0.0.1:")
    assert all(url.startswith(origins) or url == "data:," for url in page.requests), page.requests
    page.close()


@pytest.fixture
def server(serving: LiveServer) -> LiveServer:
    serving.orders.clear()
    return serving


@pytest.fixture
def live(looking: Page, server: LiveServer) -> Page:
    """The page as another flight begins: all of it comes anew, as from a service that flies one after the other."""
    looking.js("document.querySelector('.page').remove()")
    server.send(server.first)
    looking.until("!!document.querySelector('.page') && companionPage.link.state === 'connected'")
    looking.complaints.clear()
    return looking


def wait(condition: Callable[[], object], timeout: float = 10.0) -> None:
    end = time.monotonic() + timeout
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.02)


def test_what_is_appended_is_drawn_and_the_newest_moment_is_followed(live: Page, server: LiveServer):
    for k in range(60):
        server.send(moment(k))
    live.until(f"{PAGE}.state.full[1] >= 2.95")
    live.settle()
    assert live.js(f"{PAGE}.state.cursor") == live.js(f"{PAGE}.state.full[1]")
    assert live.js(f"{PAGE}.scene.path.length") == 60
    assert live.js(f"{PAGE}.scene.craft.position.z") == pytest.approx(-59 / 40)
    assert live.js(f"{PAGE}.plots.find('error').lines[0].v.length") == 60
    assert live.js("document.querySelector('#plot-error .value').textContent") == "0.03"
    assert live.js("document.querySelector('.badge').textContent") == "flying"
    assert live.js("document.querySelectorAll('.event').length") == 1
    assert set(server.paths) == {"/live?key=a"}
    assert live.complaints == []


def test_histograms_tables_and_the_scene_are_replaced_and_movers_and_plans_added(live: Page, server: LiveServer):
    mover = {"id": "ball", "radius": 0.5, "t": [0.0], "n": [3.0], "e": [1.0], "u": [1.0]}
    plan = {"t": 0.0, "points": [0, 0, 1.5, 5, 1, 1.5, 10, 0, 1.5], "kind": "switch"}
    spacing = start()["histograms"][0] | {"counts": [3, 9]}
    server.send(moment(0))
    server.send({"append": {"movers": [mover], "plans": [plan], "histograms": [spacing]}})
    server.send(
        {"append": {"scene": {"obstacles": [contract.sphere((4, 4, 1), 1.0), contract.cells(0.5, [[1, 2, 3]])]}}}
    )
    live.until(f"{PAGE}.scene.drawn.movers === 1 && {PAGE}.scene.drawn.plans === 1")
    live.until(f"{PAGE}.scene.drawn.obstacles === 2 && {PAGE}.histograms[0].json.counts[1] === 9")
    assert live.js(f"{PAGE}.scene.path.length") == 1
    assert live.complaints == []


def test_the_ground_grows_with_a_flight_that_leaves_it(live: Page, server: LiveServer):
    server.send({"append": {"path": [[0.0, 0, 0, 1], [1.0, 5, 5, 1]]}})
    live.until(f"{PAGE}.scene.drawn.vertices === 2")
    assert live.js(f"{PAGE}.scene.floor.high[0]") == 20
    server.send({"append": {"path": [[2.0, 400, 30, 20]]}})
    live.until(f"{PAGE}.scene.floor.high[0] >= 400")
    x, y = live.js(f"{PAGE}.scene.cameras.screenOf([400, 30, 20])")
    left, top, width, height = live.box(".scene")
    assert left < x < left + width
    assert top < y < top + height


def test_a_moved_cursor_stays_where_it_is_until_live_is_pressed(live: Page, server: LiveServer):
    for k in range(40):
        server.send(moment(k))
    live.until(f"{PAGE}.state.full[1] >= 1.9")
    live.js(f"{PAGE}.state.setCursor(1)")
    for k in range(40, 60):
        server.send(moment(k))
    live.until(f"{PAGE}.state.full[1] >= 2.9")
    assert live.js(f"{PAGE}.state.cursor") == 1
    live.click_on("[data-live-follow]")
    assert live.js(f"{PAGE}.state.cursor") == live.js(f"{PAGE}.state.full[1]")


def test_a_lost_connection_is_said_plainly_and_mended_by_itself(live: Page, server: LiveServer):
    server.send(moment(0))
    live.until(f"{PAGE}.scene.path.length === 1")
    server.stop()
    live.until("!!document.querySelector('.link-badge.lost')")
    assert "Connection lost" in live.js("document.querySelector('.lost-notice:not([hidden])').textContent")
    assert live.js("document.querySelector('[data-order=land]').disabled")
    server.start()
    live.until("companionPage.link.state === 'connected'")
    live.until(f"{PAGE}.scene.path.length === 0")  # the whole object came anew
    assert not live.js("document.querySelector('[data-order=land]').disabled")
    assert len(live.js("[...document.querySelectorAll('.page')].map((p) => p.className)")) == 1
    live.press("?")
    assert live.js("document.querySelectorAll('dialog[open]').length") == 1  # not one for each page there was


def test_a_connection_that_ends_with_the_flight_is_no_alarm(live: Page, server: LiveServer):
    server.send({"append": {"header": {"ok": True, "phase": "done"}}})
    live.until("document.querySelector('.badge').textContent === 'passed'")
    server.stop()
    live.until("document.querySelector('.link-badge').textContent === 'ended'")
    assert live.js("document.querySelector('.lost-notice').hidden")
    assert not live.js("document.body.classList.contains('link-lost')")
    assert live.js("document.querySelector('[data-order=land]').disabled")
    server.start()
    live.until(
        "companionPage.link.state === 'connected' && document.querySelector('.link-badge').textContent === 'live'"
    )


def test_silence_on_a_standing_connection_is_said(live: Page, server: LiveServer):
    server.send(moment(0))
    live.until(f"{PAGE}.scene.path.length === 1")
    live.js("companionPage.link.heard -= 2500")  # so long ago
    live.until("!!document.querySelector('.link-badge.silent')")
    assert "Nothing heard for" in live.js("document.querySelector('.lost-notice:not([hidden])').textContent")
    server.send(moment(1))
    live.until("document.querySelector('.link-badge').textContent === 'live'")


def test_hold_and_resume_are_sent_at_once_and_answers_shown(live: Page, server: LiveServer):
    for order in ("hold", "resume"):
        live.click_on(f"[data-order={order}]")
    wait(lambda: len(server.orders) == 2)
    assert server.orders == [{"order": o, "values": [], "token": TOKEN} for o in ("hold", "resume")]
    server.send({"answer": {"order": "hold", "ok": False, "text": "not flying"}})
    live.until("document.querySelector('.toast.bad')?.textContent === 'hold: not flying'")


def test_land_is_sent_only_when_confirmed(live: Page, server: LiveServer):
    live.click_on("[data-order=land]")
    live.press("Escape", 27)
    assert not live.js("document.querySelector('dialog[open]')")
    live.click_on("[data-order=land]")
    assert server.orders == []
    live.click_on("[data-confirm=land]")
    wait(lambda: server.orders)
    assert server.orders == [{"order": "land", "values": [], "token": TOKEN}]


def test_a_goal_is_clicked_on_the_ground_and_sent_with_its_altitude(live: Page, server: LiveServer):
    server.send(moment(0))
    live.until(f"{PAGE}.scene.path.length === 1")
    live.click_on("[data-order=goto]")
    live.middle(".scene-canvas")
    x, y = live.js(f"{PAGE}.scene.cameras.screenOf([12, 3, 0])")
    live.click(x, y)
    live.js("(() => { const a = document.querySelector('.goal-bar input'); a.value = ''; a.focus(); })()")
    live.type("2.5")
    assert server.orders == []
    live.click_on("[data-confirm=goto]")
    wait(lambda: server.orders)
    (order,) = server.orders
    assert order["order"] == "goto"
    assert order["values"] == pytest.approx([12, 3, 2.5], abs=0.1)
    assert order["token"] == TOKEN
    assert live.js("document.querySelector('.goal-bar').hidden")


@pytest.mark.soak
def test_twenty_messages_a_second_are_drawn_at_ten_frames_a_second_or_better(live: Page, server: LiveServer):
    for k in range(1200):
        server.send(moment(k))
    live.until("companionPage.link.messages >= 1200")
    frames = live.js(f"{PAGE}.scene.drawn.frames")
    stop = threading.Event()

    def feed() -> None:
        for k in range(1200, 1300):
            server.send(moment(k))
            if stop.wait(0.05):
                return

    feeder = threading.Thread(target=feed)
    feeder.start()
    feeder.join()
    live.until(f"{PAGE}.state.full[1] >= 64.9")
    assert live.js(f"{PAGE}.scene.drawn.frames") - frames >= 50  # in five seconds
    assert live.complaints == []
