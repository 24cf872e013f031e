"""CPU time of a plan, for the report. The only clock in this package; nothing decides by it."""

import time


class Stopwatch:
    """Counts the CPU time of this thread from its making."""

    __slots__ = ("_start",)

    def __init__(self) -> None:
        self._start = time.thread_time()

    def elapsed_ms(self) -> float:
        """CPU time spent by this thread since then [ms]."""
        return 1e3 * (time.thread_time() - self._start)
