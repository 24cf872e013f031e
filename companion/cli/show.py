"""What a person sees of any command: that it works, plain text, or one JSON object.

Nothing of flying is imported here, so that looking into a recording begins at once; of flights: `flight_show`.
"""

import json
import math
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import Any

from rich.console import Console
from rich.status import Status

TELL_S = 10.0
"""Between two words that something goes on, where there is no spinner [s]."""


def console() -> Console:
    """Progress and notes go to stderr; stdout is for results."""
    return Console(stderr=True, highlight=False)


@contextmanager
def working(out: Console, what: str) -> Iterator[Status | None]:
    """A spinner on a terminal; one plain line elsewhere."""
    if out.is_terminal:
        with out.status(what) as status:
            yield status
    else:
        out.print(what)
        yield None


@contextmanager
def waiting(out: Console, what: str) -> Iterator[Callable[[float], None]]:
    """`working` on what may take long: to be told how long it has taken [s], for people to see that it goes on.

    On the spinner every time, elsewhere a line every `TELL_S`.
    """
    told_s = 0.0

    def so_far(seconds: float) -> None:
        nonlocal told_s
        if status is not None:
            status.update(f"{what}: {seconds:.0f} s")
        elif seconds >= told_s + TELL_S:
            told_s = seconds
            out.print(f"{what}: {seconds:.0f} s")

    with working(out, what) as status:
        yield so_far


def plain(text: str) -> str:
    """Text from a peer, with nothing that the terminal or the markup would obey."""
    return "".join(c if c.isprintable() else "?" for c in text).replace("[", "\\[")


def print_json(value: Mapping[str, Any]) -> None:
    """Exactly one JSON object on stdout; a number that JSON cannot hold becomes null."""
    json.dump({key: _json_value(item) for key, item in value.items()}, sys.stdout, indent=2, allow_nan=False)
    sys.stdout.write("\n")


def _json_value(value: Any) -> Any:
    if isinstance(value, float):
        return round(value, 6) if math.isfinite(value) else None
    if isinstance(value, dict):
        return {key: _json_value(item) for key, item in value.items()}
    return [_json_value(item) for item in value] if isinstance(value, list | tuple) else value
