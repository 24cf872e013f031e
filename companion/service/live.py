"""The live page: html and a WebSocket on a port of this machine, for whoever has the token.

    http://127.0.0.1:PORT/?token=...          the page of `logs.report`
    ws://127.0.0.1:PORT/live?token=...        what it shows, at 20 Hz; and its orders, each with the token again

Nobody else gets in: the port is the loopback's alone; a Host that is not this address is refused (a name that somebody
made point here, DNS rebinding), and so is an Origin that is not the page's own (a foreign page in the same browser);
the token is drawn anew each time and compared in constant time. Every reader has threads of its own and none in the
flight loop's; a slow one is given less (`feed`), and one that takes nothing is hung up on. There are a few places for
callers; when all are taken, the one that has held its place longest without the token makes room for the next. So lines
held open in silence cost a bounded number of threads and descriptors, and do not keep the page away.
"""

import contextlib
import hmac
import json
import logging
import math
import secrets
import socket
import threading
import time
from collections import deque
from collections.abc import Iterator
from contextlib import contextmanager
from http import HTTPStatus
from typing import Any, ClassVar
from urllib.parse import parse_qs, urlsplit

from websockets.datastructures import Headers
from websockets.exceptions import ConnectionClosed
from websockets.frames import CloseCode
from websockets.http11 import Request, Response
from websockets.server import ServerProtocol
from websockets.sync.server import Server, ServerConnection, serve

from companion.errors import LinkError
from companion.seam import Order
from companion.service.feed import Answer, Asked, Feed, Seen
from logs.report import live_page

HOST = "127.0.0.1"
PERIOD_S, ALIVE_S = 0.05, 1.0
"""Time between two messages; and without anything to say, between two empty ones."""
MOST_READERS = 8
MOST_CALLERS = 32
"""Connections at once: readers, pages being fetched, and whoever only holds a line open."""
OPEN_S = 5.0
"""To say what is wanted."""
MOST_BYTES = 4096  # of an order
CLOSE_S = 1.0
MOST_UNSENT = 1 << 18
"""Bytes that a connection's socket may hold for a reader that does not take them."""
ORDERS = {"land": 0, "hold": 0, "resume": 0, "goto": 3}
"""What a page may ask for, and with how many values."""
SOURCE = "page"
HEADERS = {
    "Cache-Control": "no-store",
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Resource-Policy": "same-origin",
}

_quiet = logging.getLogger("companion.live")  # a reader that goes away is nobody's trouble
_quiet.addHandler(logging.NullHandler())
_quiet.propagate = False


@contextmanager
def served_live(port: int, feed: Feed, token: str = "") -> Iterator[str]:
    """Serve the live page as long as this lasts; yields its address, token included.

    Parameters
    ----------
    port : on 127.0.0.1; 0: one that is free.
    token : drawn by chance when empty.

    Raises
    ------
    LinkError : the port is taken.
    """
    door = _Door(feed, token or secrets.token_urlsafe(24))
    callers = type("Caller", (_Caller,), {"door": door})
    try:
        server = serve(
            door.talk,
            HOST,
            port,
            process_request=door.judge,
            create_connection=callers,
            compression=None,  # costs more than the loopback
            server_header=None,
            open_timeout=OPEN_S,
            close_timeout=CLOSE_S,
            max_size=MOST_BYTES,
            max_queue=8,
            logger=_quiet,
        )
    except OSError as error:
        raise LinkError(f"live page {HOST}:{port}: {error.strerror or error}") from error
    door.hosts = _hosts(server)
    thread = threading.Thread(target=server.serve_forever, name="live", daemon=True)
    thread.start()
    try:
        yield f"http://{door.hosts[0]}/?token={door.token}"
    finally:
        door.close(server)
        thread.join(CLOSE_S)


def _hosts(server: Server) -> tuple[str, str]:
    port = server.socket.getsockname()[1]
    return f"{HOST}:{port}", f"localhost:{port}"


class _Caller(ServerConnection):
    """A connection that has a place at the door as long as it is read from.

    Attributes
    ----------
    known : whether it has shown the token.
    leaving : whether it was hung up on.
    """

    door: ClassVar["_Door"]

    def __init__(self, sock: socket.socket, protocol: ServerProtocol, *server: Server, **more: Any) -> None:
        self.socket, self.known, self.leaving = sock, False, False
        self.door.admit(self)
        try:
            super().__init__(sock, protocol, *server, **more)  # a server since websockets 17
        except BaseException:  # no thread to be had
            self.door.gone(self)
            raise

    def recv_events(self) -> None:
        """Read from it until it goes; in a thread of its own."""
        try:
            super().recv_events()
        finally:
            self.door.gone(self)

    def hang_up(self) -> None:
        """Whoever reads or writes it finds it closed."""
        self.leaving = True
        with contextlib.suppress(OSError):
            self.socket.shutdown(socket.SHUT_RDWR)


class _Door:
    """Who comes in, and what is said to them.

    Attributes
    ----------
    hosts : what a Host may be.
    """

    def __init__(self, feed: Feed, token: str) -> None:
        self.feed, self.token, self.hosts = feed, token, ("", "")
        self._closing = threading.Event()
        self._callers: dict[_Caller, None] = {}  # the oldest first
        self._readers: set[ServerConnection] = set()
        self._lock = threading.Lock()

    def admit(self, caller: _Caller) -> None:
        """Give a place to a caller; when all are taken, that of the oldest who has not shown the token.

        Raises
        ------
        ConnectionRefusedError : there is none to be had; the server hangs up.
        """
        with self._lock:
            if self._closing.is_set():
                raise ConnectionRefusedError
            held = [other for other in self._callers if not other.leaving]
            if len(held) >= MOST_CALLERS:
                silent = next((other for other in held if not other.known), None)
                if silent is None or len(self._callers) >= 2 * MOST_CALLERS:  # those that leave hold threads yet
                    raise ConnectionRefusedError
                silent.hang_up()
            self._callers[caller] = None

    def gone(self, caller: _Caller) -> None:
        """Its place is free."""
        with self._lock:
            self._callers.pop(caller, None)

    def judge(self, connection: ServerConnection, request: Request) -> Response | None:
        """What a request is answered with; None: it may talk."""
        try:
            url = urlsplit(request.path)
            token = parse_qs(url.query, max_num_fields=8).get("token", [""])[0]
        except ValueError:
            return _said(HTTPStatus.BAD_REQUEST, "that is no address\n")
        if request.headers.get_all("Host") not in [[host] for host in self.hosts]:
            return _said(HTTPStatus.FORBIDDEN, "this page is for this machine only\n")
        if url.path not in ("/", "/live"):
            return _said(HTTPStatus.NOT_FOUND, "there is the page at / and nothing else\n")
        if not self._knows(token):
            return _said(HTTPStatus.FORBIDDEN, "the token is missing or wrong: open the address that was printed\n")
        if isinstance(connection, _Caller):
            connection.known = True
        if url.path == "/":
            page = live_page(f"/live?token={self.token}", self.token, "live")
            return _said(HTTPStatus.OK, page, "text/html")
        if request.headers.get_all("Origin") not in [[f"http://{host}"] for host in self.hosts]:
            return _said(HTTPStatus.FORBIDDEN, "not from another page\n")
        if len(self._readers) >= MOST_READERS:
            return _said(HTTPStatus.SERVICE_UNAVAILABLE, f"{MOST_READERS} pages look on already\n")
        return None

    def talk(self, connection: ServerConnection) -> None:
        """One reader, from its coming to its going."""
        answers: deque[Answer] = deque(maxlen=16)
        with self._lock:
            full = len(self._readers) >= MOST_READERS  # several came at once
            if not full:
                self._readers.add(connection)
        if full:
            return connection.close(CloseCode.TRY_AGAIN_LATER, f"{MOST_READERS} pages look on already")
        connection.socket.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, MOST_UNSENT)
        teller = threading.Thread(target=self._tell, args=(connection, answers), name="live page", daemon=True)
        teller.start()
        try:
            for message in connection:
                answer = self._ordered(message, answers)
                if answer is not None:
                    answers.append(answer)
        except ConnectionClosed:
            pass
        finally:
            with self._lock:
                self._readers.discard(connection)
        return None

    def _tell(self, connection: ServerConnection, answers: deque[Answer]) -> None:
        """Send what is new until it goes."""
        seen, said_s, last = Seen(), time.monotonic(), False
        with contextlib.suppress(ConnectionClosed, OSError):
            while not last:
                last = self._closing.wait(PERIOD_S)  # what came just before the end is told yet
                while answers:
                    connection.send(json.dumps(answers.popleft().to_json()))
                more = self.feed.since(seen)
                if more is None and time.monotonic() - said_s > ALIVE_S:
                    more = {"append": {}}
                if more is not None:
                    connection.send(_json(more))
                    said_s = time.monotonic()
                with self._lock:
                    last = last or connection not in self._readers
            connection.close(CloseCode.GOING_AWAY)

    def _ordered(self, message: str | bytes, answers: deque[Answer]) -> Answer | None:
        """Take an order; the answer where it is refused at once."""
        try:
            told = json.loads(message)
            name, values, token = told["order"], told["values"], told["token"]
            if not (isinstance(name, str) and isinstance(values, list) and isinstance(token, str)):
                raise ValueError("not an order")
        except (ValueError, KeyError, TypeError, RecursionError):
            return Answer("order", False, "that is no order")
        if not self._knows(token):
            return Answer(name[:20], False, "the token is wrong")
        if name not in ORDERS or len(values) != ORDERS[name]:
            return Answer(name[:20], False, f"expected one of {', '.join(ORDERS)}, goto with north, east and altitude")
        if not all(isinstance(v, int | float) and not isinstance(v, bool) and abs(v) < 1e7 for v in values):
            return Answer(name, False, f"found {str(values)[:60]}, expected numbers of metres")
        order = Order(name, tuple(float(value) for value in values), SOURCE)
        reason = self.feed.order(Asked(order, answers.append))
        return Answer(name, False, reason) if reason else None

    def _knows(self, token: str) -> bool:
        return hmac.compare_digest(token.encode("utf-8", "replace"), self.token.encode())

    def close(self, server: Server) -> None:
        """Say what there is to say, and hang up on everybody, on those that take nothing too."""
        self._closing.set()
        until_s = time.monotonic() + 2 * CLOSE_S
        while self._readers and time.monotonic() < until_s:  # each is told, and closed, by its own thread
            time.sleep(PERIOD_S)
        with self._lock:
            for caller in self._callers:
                caller.hang_up()
        ending = threading.Thread(target=server.shutdown, name="live ends", daemon=True)
        ending.start()
        ending.join(CLOSE_S)


def _json(message: dict[str, Any]) -> str:
    try:
        return json.dumps(message, separators=(",", ":"), allow_nan=False)
    except ValueError:
        return json.dumps(_finite(message), separators=(",", ":"), allow_nan=False)


def _finite(value: Any) -> Any:
    """The same with null for what JSON has no number for."""
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, dict):
        return {key: _finite(item) for key, item in value.items()}
    return [_finite(item) for item in value] if isinstance(value, list | tuple) else value


def _said(status: HTTPStatus, text: str, kind: str = "text/plain") -> Response:
    body = text.encode()
    headers = Headers(HEADERS)
    headers["Content-Type"], headers["Content-Length"] = f"{kind}; charset=utf-8", str(len(body))
    headers["Connection"] = "close"
    return Response(status.value, status.phrase, headers, body)
