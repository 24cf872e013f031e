"""A WebSocket server as small as it can be, for tests of the live page: text frames, one thread a client (RFC 6455)."""

import base64
import contextlib
import hashlib
import json
import socket
import struct
import threading
from typing import Any

_GUID = b"258EAFA5-E914-47DA-95CA-C5AB0DC85B11"  # RFC 6455, section 1.3


class LiveServer:
    """Serves one html page over HTTP, and `first` and whatever is sent over WebSocket at any path with an upgrade."""

    def __init__(self, first: dict[str, Any]) -> None:
        self.first = first
        self.page = ""
        self.orders: list[dict[str, Any]] = []
        self.paths: list[str] = []
        self._clients: list[socket.socket] = []
        self._lock = threading.Lock()
        self.port = 0
        self.start()

    def start(self) -> None:
        """Listen; on the port of before, if there was one."""
        self._listener = socket.create_server(("127.0.0.1", self.port))
        self.port = self._listener.getsockname()[1]
        self._accepting = threading.Thread(target=self._accept, daemon=True)
        self._accepting.start()

    def stop(self) -> None:
        """Hang up on everybody, and listen no longer."""
        with contextlib.suppress(OSError):
            self._listener.shutdown(socket.SHUT_RDWR)
        self._listener.close()
        self._accepting.join(5)
        with self._lock:
            for client in self._clients:
                with contextlib.suppress(OSError):
                    client.shutdown(socket.SHUT_RDWR)
                client.close()
            self._clients.clear()

    def send(self, message: dict[str, Any]) -> None:
        """To every page."""
        with self._lock:
            for client in self._clients:
                with contextlib.suppress(OSError):
                    client.sendall(_frame(json.dumps(message).encode()))

    def _accept(self) -> None:
        while True:
            try:
                client, _ = self._listener.accept()
            except OSError:
                return
            threading.Thread(target=self._serve, args=(client,), daemon=True).start()

    def _serve(self, client: socket.socket) -> None:
        with contextlib.suppress(OSError):
            head = b""
            while b"\r\n\r\n" not in head:
                more = client.recv(4096)
                if not more:
                    return client.close()
                head += more
            lines = head.decode("latin-1").split("\r\n")
            headers = {k.lower(): v for k, _, v in (line.partition(": ") for line in lines[1:])}
            if "sec-websocket-key" not in headers:
                body = self.page.encode()
                answer = "HTTP/1.1 200 OK\r\nContent-Type: text/html; charset=utf-8\r\nConnection: close\r\n"
                client.sendall(f"{answer}Content-Length: {len(body)}\r\n\r\n".encode() + body)
                return client.close()
            self.paths.append(lines[0].split()[1])
            accept = base64.b64encode(hashlib.sha1(headers["sec-websocket-key"].encode() + _GUID).digest()).decode()
            upgrade = "HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
            client.sendall(f"{upgrade}Sec-WebSocket-Accept: {accept}\r\n\r\n".encode())
            with self._lock:
                client.sendall(_frame(json.dumps(self.first).encode()))
                self._clients.append(client)
            while (text := _read(client)) is not None:
                self.orders.append(json.loads(text))
        return None


def _frame(payload: bytes) -> bytes:
    """A text frame of a server: unmasked."""
    size = len(payload)
    if size < 126:
        return struct.pack("!BB", 0x81, size) + payload
    if size < 1 << 16:
        return struct.pack("!BBH", 0x81, 126, size) + payload
    return struct.pack("!BBQ", 0x81, 127, size) + payload


def _exactly(client: socket.socket, count: int) -> bytes:
    data = b""
    while len(data) < count:
        more = client.recv(count - len(data))
        if not more:
            raise ConnectionError
        data += more
    return data


def _read(client: socket.socket) -> bytes | None:
    """The next text frame of a client, unmasked; None when it hangs up."""
    try:
        first, second = _exactly(client, 2)
        size = second & 0x7F
        if size == 126:
            (size,) = struct.unpack("!H", _exactly(client, 2))
        mask = _exactly(client, 4)
        payload = bytes(b ^ mask[k % 4] for k, b in enumerate(_exactly(client, size)))
    except (OSError, ConnectionError):
        return None
    return payload if first & 0x0F == 1 else None
