"""The person at the keyboard: the first Ctrl-C asks to land, the second one stops."""

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

from companion.seam import Order

STOPPED = "stopped by the operator without landing"


class Operator:
    """Ctrl-C: the first one asks to land, the second one stops."""

    def __init__(self) -> None:
        self.asked = 0
        self._told = 0

    @contextmanager
    def listening(self) -> Iterator[None]:
        """Catch SIGINT and SIGTERM as long as this lasts."""

        def hear(number: int, frame: FrameType | None) -> None:
            self.asked += 1

        before = {s: signal.signal(s, hear) for s in (signal.SIGINT, signal.SIGTERM)}
        try:
            yield
        finally:
            for number, handler in before.items():
                signal.signal(number, handler)

    def __call__(self, now_us: int) -> Order | None:
        if self.asked == 0 or self._told:
            return None
        self._told = 1
        return Order("land")

    def stop(self) -> bool:
        return self.asked > 1
