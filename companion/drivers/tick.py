"""One tick as the taps see it: everything that crossed the seam, in order."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from companion.seam import Input, Output


@dataclass(frozen=True, slots=True)
class Tick:
    """One call of `Companion.step`.

    Attributes
    ----------
    index : 0, 1, 2 ...
    now_us : the time the core was given.
    inputs : (when it arrived [us], what), in the order the core got them.
    outputs : what the core returned, in order.
    sent_us : when the last output had been handed to the sockets.
    """

    index: int
    now_us: int
    inputs: Sequence[tuple[int, Input]]
    outputs: Sequence[Output]
    sent_us: int


class Tap(Protocol):
    """Something that looks on: a recorder, a verdict, a progress line. It must not change what it sees."""

    def __call__(self, tick: Tick) -> None: ...
