"""Keys pressed while something runs: looked at without waiting, and only where a person sits at a terminal."""

import os
import select
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from logs.replay_driver import Key

KEYS: "dict[str, Key]" = {" ": "pause", "\x1b[C": "step", "\x1bOC": "step", "q": "quit", "Q": "quit"}
HELP = "space pauses, right arrow steps, q ends"


class Keyboard:
    """What was pressed since it was asked last.

    Attributes
    ----------
    there : whether there is a terminal to press keys at.
    """

    def __init__(self, descriptor: int | None) -> None:
        self._descriptor = descriptor
        self._rest = ""

    @property
    def there(self) -> bool:
        return self._descriptor is not None

    def __call__(self) -> "list[Key]":
        if self._descriptor is None:
            return []
        if select.select([self._descriptor], (), (), 0)[0]:
            data = os.read(self._descriptor, 256)
            if not data:  # the terminal is gone
                self._descriptor = None
            self._rest += data.decode("ascii", "replace")
        found: list[Key] = []
        while self._rest:
            for text, key in KEYS.items():
                if self._rest.startswith(text):
                    found.append(key)
                    self._rest = self._rest[len(text) :]
                    break
            else:
                if len(self._rest) < 3 and any(text.startswith(self._rest) for text in KEYS):
                    break  # an arrow, half of it
                self._rest = self._rest[1:]
        return found


@contextmanager
def keyboard() -> Iterator[Keyboard]:
    """Keys as they are pressed, without Enter and without an echo; Ctrl-C stays what it is. Elsewhere: none, ever."""
    try:
        import termios
        import tty

        descriptor = sys.stdin.fileno()
        before = termios.tcgetattr(descriptor)
        if os.getpgrp() != os.tcgetpgrp(descriptor):
            raise OSError("in the background: the terminal is somebody else's")
    except (ImportError, OSError, ValueError, AttributeError):  # no such system, no terminal, no stdin
        yield Keyboard(None)
        return
    except Exception as error:
        if type(error).__name__ != "error":  # termios.error has no better name
            raise
        yield Keyboard(None)
        return
    tty.setcbreak(descriptor)
    try:
        yield Keyboard(descriptor)
    finally:
        termios.tcsetattr(descriptor, termios.TCSADRAIN, before)
