"""The live page's server: who gets in, what orders become, and that a reader never holds up the writer."""

import base64
import contextlib
import http.client
import json
import math
import re
import socket
import threading
import time
from collections.abc import Iterator
from urllib.parse import parse_qs, urlsplit

import numpy as np
import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import ClientConnection, connect

from companion.cli.app import with_live_port
from companion.errors import LinkError
from companion.service import feed as feeds
from companion.service import live
from companion.service.feed import Answer, Asked, Feed, Seen, Way
from companion.service.live import served_live
from logs.report import contract

SCENE = contract.Scene(feeds.NOTHING, reference=feeds.NOTHING)


def row(t: float, **values: float) -> tuple[float, ...]:
    return (t, *(values.get(name, math.nan) for name in feeds.COLUMNS))


@pytest.fixture
def feed() -> Feed:
    made = Feed()
    made.begin(contract.Header("a flight", phase="flying"), SCENE)
    return made


@pytest.fixture
def served(feed: Feed) -> Iterator[str]:
    with served_live(0, feed) as address:
        yield address


def parts(address: str) -> tuple[str, str]:
    """Host with port, and token."""
    url = urlsplit(address)
    return url.netloc, parse_qs(url.query)["token"][0]


@contextlib.contextmanager
def reader(address: str, **more) -> Iterator[ClientConnection]:
    host, token = parts(address)
    more.setdefault("origin", f"http://{host}")
    with connect(f"ws://{host}/live?token={token}", compression=None, open_timeout=5, **more) as connection:
        yield connection


def get(address: str, path: str, **headers: str) -> http.client.HTTPResponse:
    host, _ = parts(address)
    asked = http.client.HTTPConnection(host, timeout=5)
    asked.request("GET", path, headers=headers)
    return asked.getresponse()


def take(connection: ClientConnection, key: str) -> dict:
    """The next message that has a key."""
    while True:
        message = json.loads(connection.recv(timeout=5))
        if key in message:
            return message[key]


def test_the_page_is_served_with_the_token_that_was_printed_and_listens_to_loopback_only(served: str):
    host, token = parts(served)
    assert host.startswith("127.0.0.1:")
    assert len(token) >= 32
    answer = get(served, f"/?token={token}")
    page = answer.read().decode()
    assert answer.status == 200
    assert "data-live=" in page
    assert answer.headers["X-Frame-Options"] == "DENY"
    assert answer.headers["Cache-Control"] == "no-store"
    assert get(served, f"/other?token={token}").status == 404


@pytest.mark.parametrize("query", ["", "?token=", "?token=wrong", "?token=%00", "?token=%F0%9F%98%80", "?other=1"])
def test_without_the_right_token_there_is_neither_page_nor_socket(served: str, query: str):
    host, token = parts(served)
    answer = get(served, f"/{query}")
    assert answer.status == 403
    assert token not in answer.read().decode()
    with pytest.raises(InvalidStatus, match="403"), connect(f"ws://{host}/live{query}", origin=f"http://{host}"):
        pass


def test_a_name_that_somebody_made_point_here_is_refused(served: str):
    host, token = parts(served)
    port = host.rpartition(":")[2]
    for name in (f"evil.example:{port}", "evil.example", "127.0.0.1", f"127.0.0.1.evil.example:{port}", ""):
        assert get(served, f"/?token={token}", Host=name).status == 403
    assert get(served, f"/?token={token}", Host=f"localhost:{port}").status == 200


def test_a_foreign_page_in_the_same_browser_gets_no_socket(served: str):
    host, token = parts(served)
    for origin in ("http://evil.example", "null", f"https://{host}", "http://127.0.0.1:1", None):
        with pytest.raises(InvalidStatus, match="403"), connect(f"ws://{host}/live?token={token}", origin=origin):
            pass


def test_a_reader_gets_the_whole_object_first_and_then_what_is_new(served: str, feed: Feed):
    feed.sample(row(0.0, n=1.0, e=2.0, u=3.0, roll=0.0, pitch=0.0, yaw=0.0))
    feed.event(contract.Event(0.0, "phase", 6, "a -> b"))
    feed.way(Way(0.0, lambda: [[0, 0, 1], [1, 0, 1]], "plan"))
    with reader(served) as connection:
        whole = json.loads(connection.recv(timeout=5))
        assert whole["version"] == contract.VERSION
        assert whole["header"]["title"] == "a flight"
        assert whole["scene"]["path"]["n"] == [1.0]
        assert whole["scene"]["plans"][0]["points"] == [0, 0, 1, 1, 0, 1]
        assert [event["text"] for event in whole["events"]] == ["a -> b"]
        assert whole["plots"][0]["series"][0]["v"] == [None]
        feed.sample(row(0.1, n=1.5, e=2.0, u=3.0, roll=0.0, pitch=0.0, yaw=0.3, rn=1.4, re=2.0, ru=3.0))
        more = take(connection, "append")
        assert more["path"] == [[0.1, 1.5, 2.0, 3.0, 0.0, 0.0, 0.3]]
        assert more["reference"] == [[0.1, 1.4, 2.0, 3.0]]
        assert more["pose"]["yaw"] == 0.3
        assert more["series"]["error"]["distance"] == [[0.1], [None]]
        feed.header(phase="landing")
        assert take(connection, "append")["header"]["phase"] == "landing"
        assert take(connection, "append") == {}  # nothing happens, and that is said
        feed.begin(contract.Header("another"), SCENE)
        assert take(connection, "header")["title"] == "another"


def test_an_order_with_the_token_reaches_the_flight_and_is_answered(served: str, feed: Feed):
    _, token = parts(served)
    with reader(served) as connection:
        connection.send(json.dumps({"order": "goto", "values": [1, 2.5, 3], "token": token}))
        asked = waited(feed)
        assert (asked.order.name, asked.order.values, asked.order.source) == ("goto", (1.0, 2.5, 3.0), "page")
        asked.answer(Answer("goto", False, "not while landing"))
        assert take(connection, "answer") == {"order": "goto", "ok": False, "text": "not while landing"}


def waited(feed: Feed) -> Asked:
    end = time.monotonic() + 5
    while (asked := feed.take_order()) is None:
        assert time.monotonic() < end
        time.sleep(0.01)
    return asked


@pytest.mark.parametrize(
    ("message", "told"),
    [
        ({"order": "land", "values": [], "token": "wrong"}, "the token is wrong"),
        ({"order": "land", "values": []}, "that is no order"),
        ({"order": "land", "values": [], "token": None}, "that is no order"),
        ({"order": "abort", "values": [], "token": "TOKEN"}, "expected one of land, hold"),
        ({"order": "goto", "values": [1, 2], "token": "TOKEN"}, "goto with north, east"),
        ({"order": "land", "values": [1], "token": "TOKEN"}, "expected one of"),
        ({"order": "goto", "values": [1, 2, "3"], "token": "TOKEN"}, "expected numbers"),
        ({"order": "goto", "values": [1, 2, True], "token": "TOKEN"}, "expected numbers"),
        ({"order": "goto", "values": [1, 2, math.nan], "token": "TOKEN"}, "expected numbers"),
        ({"order": "goto", "values": [1, 2, math.inf], "token": "TOKEN"}, "expected numbers"),
        ([1], "that is no order"),
        ("{", "that is no order"),
        ("[" * 2000, "that is no order"),
    ],
)
def test_what_is_no_order_is_answered_and_goes_nowhere(served: str, feed: Feed, message, told: str):
    text = message if isinstance(message, str) else json.dumps(message)
    with reader(served) as connection:
        connection.send(text.replace("TOKEN", parts(served)[1]))
        answer = take(connection, "answer")
    assert not answer["ok"]
    assert told in answer["text"]
    assert feed.take_order() is None


def test_an_order_is_refused_when_nothing_flies_and_when_too_many_wait(served: str, feed: Feed):
    _, token = parts(served)
    order = json.dumps({"order": "hold", "values": [], "token": token})
    with reader(served) as connection:
        for _ in range(feeds.MOST_ORDERS + 1):
            connection.send(order)
        assert take(connection, "answer")["text"] == "too many orders wait"
        feed.end()
        assert take(connection, "answer")["text"] == "the flight is over"
        connection.send(order)
        while (text := take(connection, "answer")["text"]) == "the flight is over":
            pass
        assert text == "no flight is under way"


def test_a_message_too_long_for_an_order_ends_the_connection(served: str):
    with reader(served) as connection:
        connection.send("x" * 10_000)
        with pytest.raises(ConnectionClosed):
            drained(connection)


def drained(connection: ClientConnection) -> None:
    while True:
        connection.recv(timeout=5)


def test_readers_beyond_the_eighth_are_refused_and_a_place_is_free_again_after_one_left(served: str):
    with contextlib.ExitStack() as stack:
        for _ in range(8):
            stack.enter_context(reader(served)).recv(timeout=5)
        with pytest.raises(InvalidStatus, match="503"), reader(served):
            pass
    end = time.monotonic() + 5
    while True:
        try:
            with reader(served):
                return
        except InvalidStatus:
            assert time.monotonic() < end
            time.sleep(0.05)


@pytest.mark.parametrize("path", ["//[", "/?" + "a=1&" * 9, "/live?" + "token=x&" * 20])
def test_an_address_that_is_none_is_refused_as_any_other(served: str, path: str):
    assert get(served, path).status == 400


def test_many_that_come_at_once_are_no_more_readers_than_one_after_the_other(served: str, monkeypatch):
    parse, meet = live.parse_qs, threading.Barrier(12, timeout=5)

    def all_at_once(*arguments, **more):
        meet.wait()
        return parse(*arguments, **more)

    monkeypatch.setattr(live, "parse_qs", all_at_once)
    told: list[bool] = []

    def look() -> None:
        try:
            with reader(served) as connection:
                told.append("version" in connection.recv(timeout=5))
                end.wait(5)
        except (ConnectionClosed, InvalidStatus):
            told.append(False)

    end = threading.Event()
    threads = [threading.Thread(target=look) for _ in range(12)]
    for thread in threads:
        thread.start()
    until = time.monotonic() + 10
    while len(told) < 12 and time.monotonic() < until:
        time.sleep(0.01)
    end.set()
    for thread in threads:
        thread.join()
    assert sorted(told) == [False] * 4 + [True] * 8


def test_lines_held_open_without_a_word_take_few_threads_and_keep_nobody_out(served: str):
    host, token = parts(served)
    before = threading.active_count()
    with contextlib.ExitStack() as stack, reader(served) as early:
        idle = [stack.enter_context(socket.create_connection(host.split(":"))) for _ in range(200)]
        idle[0].settimeout(live.OPEN_S / 2)
        assert idle[0].recv(1) == b""  # hung up on for those that came after it
        assert threading.active_count() - before <= 5 * live.MOST_CALLERS
        assert get(served, f"/?token={token}").status == 200
        with reader(served) as late:
            assert "version" in json.loads(late.recv(timeout=5))
        early.recv(timeout=5)
    end = time.monotonic() + 5
    while threading.active_count() > before:
        assert time.monotonic() < end
        time.sleep(0.05)


def test_what_a_server_of_another_version_has_inside_is_not_needed(feed: Feed, monkeypatch):
    def older(*arguments, create_connection, **more):
        def bare(sock, protocol, *server, **how):
            return create_connection(sock, protocol, *(object() for _ in server), **how)

        return serve(*arguments, create_connection=bare, **more)

    serve = live.serve
    monkeypatch.setattr(live, "serve", older)
    with served_live(0, feed) as address:
        assert get(address, f"/?token={parts(address)[1]}").status == 200


def test_a_reader_that_takes_nothing_holds_up_neither_the_writer_nor_the_end(feed: Feed):
    values = dict.fromkeys(feeds.COLUMNS, 1.234567)
    with served_live(0, feed) as address, socket.create_connection(urlsplit(address).netloc.split(":")) as deaf:
        host, token = parts(address)
        deaf.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        lines = (
            f"GET /live?token={token} HTTP/1.1",
            *(f"Host: {host}", f"Origin: http://{host}", "Upgrade: websocket", "Connection: Upgrade"),
            *("Sec-WebSocket-Version: 13", "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==", "", ""),
        )
        deaf.sendall("\r\n".join(lines).encode())
        slowest = 0.0
        for k in range(8000):
            began = time.perf_counter()
            feed.sample(row(k / 20, **values))
            slowest = max(slowest, time.perf_counter() - began)
            if k % 200 == 0:
                time.sleep(0.01)
        ends = time.monotonic()
    assert time.monotonic() - ends < 15
    assert slowest < 2.0  # it would wait for ever; what else this machine does is not judged here


def test_a_long_flight_keeps_its_beginning_its_end_and_no_more_rows_than_that(feed: Feed):
    for k in range(100_000):
        feed.sample(row(k / 20))
    column = feed.since(Seen())["plots"][0]["series"][0]["t"]
    times = np.frombuffer(base64.b64decode(column["f32"]), "<f4")
    assert len(times) <= feeds.MOST_ROWS
    assert times[0] == 0.0
    assert times[-1] == pytest.approx((100_000 - 1) / 20)
    assert (np.diff(times) > 0).all()


def test_of_a_long_flight_the_newest_five_to_seven_and_a_half_minutes_are_kept_at_20_hz(feed: Feed):
    whole_s = []
    for k in range(30_001):
        feed.sample(row(k / 20))
        if k > feeds.MOST_ROWS and k % 500 == 0:
            column = feed.since(Seen())["plots"][0]["series"][0]["t"]
            times = np.frombuffer(base64.b64decode(column["f32"]), "<f4")
            coarse = np.flatnonzero(np.diff(times) > 0.075)
            whole_s.append(times[-1] - times[coarse[-1] + 1])
    assert 300 - 0.1 <= min(whole_s) < 330
    assert 420 < max(whole_s) <= 450 + 0.1


def test_a_reader_that_was_slow_gets_evenly_less_and_nothing_twice(feed: Feed):
    seen = Seen()
    feed.since(seen)
    for k in range(5000):
        feed.sample(row(k / 20, n=float(k), e=0.0, u=0.0))
    path = feed.since(seen)["append"]["path"]
    assert 100 <= len(path) <= feeds.MOST_AT_ONCE
    assert feed.since(seen) is None


def test_a_taken_port_is_one_line(served: str, feed: Feed):
    port = int(parts(served)[0].rpartition(":")[2])
    with pytest.raises(LinkError, match=re.escape(f"live page 127.0.0.1:{port}: ")), served_live(port, feed):
        pass


def test_a_bare_live_gets_the_usual_port():
    assert with_live_port(["fly", "a.yaml", "--live"]) == ["fly", "a.yaml", "--live", "8790"]
    assert with_live_port(["demo", "--live", "--json"]) == ["demo", "--live", "8790", "--json"]
    assert with_live_port(["demo", "--live", "0"]) == ["demo", "--live", "0"]
    assert with_live_port(["demo", "--live=9000"]) == ["demo", "--live=9000"]
