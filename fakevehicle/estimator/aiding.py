"""Which sensor helps, since when, and what follows when one is silent, stuck or refused: bookkeeping, no arithmetic.

sensor is        for longer than      then
---------------------------------------------------------------------------------------------------------
not accepted     STALE_US             what it alone gives is not valid
silent           STALE_US             its next word is believed whatever it is, if nothing else knows better (GPS)
refused          `reset_after_us`     its next word is believed whatever it is: a reset
stuck in flight  STUCK_US             as if it were silent: real sensors never say exactly the same for so long
"""

STALE_US = 800_000
"""A quantity whose sensor has not been accepted for this long is no longer valid [us]."""
STUCK_US = 400_000
"""A sensor that repeats itself exactly for this long is stuck [us]."""
RESETTLE_US = 500_000
"""After an outage position is valid again when GPS has been accepted for this long [us]."""


class Aid:
    """One sensor's standing.

    Attributes
    ----------
    accepted_us : when it was last accepted; None before the first time.
    since_us : since when it has been accepted without a gap longer than STALE_US.
    """

    __slots__ = ("_refused_us", "_repeats_us", "_seen_us", "_word", "accepted_us", "since_us")

    def __init__(self) -> None:
        self.accepted_us: int | None = None
        self.since_us = 0
        self._seen_us: int | None = None
        self._refused_us: int | None = None
        self._word: bytes = b""
        self._repeats_us = 0

    def fresh(self, now_us: int) -> bool:
        """Whether it has been accepted lately."""
        return self.accepted_us is not None and now_us - self.accepted_us <= STALE_US

    def stuck(self, word: bytes, now_us: int) -> bool:
        """Whether the newest word (its numbers as bytes) is what it has been saying for too long."""
        if word != self._word:
            self._word, self._repeats_us = word, now_us
        return now_us - self._repeats_us >= STUCK_US

    def returns(self, now_us: int) -> bool:
        """Note a word; whether it is the first after a silence."""
        before, self._seen_us = self._seen_us, now_us
        return before is not None and now_us - before > STALE_US

    def overdue(self, now_us: int, reset_after_us: int) -> bool:
        """Whether it has been refused for so long that it must be right."""
        return self._refused_us is not None and now_us - self._refused_us >= reset_after_us

    def accept(self, now_us: int) -> None:
        """It was taken in."""
        if not self.fresh(now_us):
            self.since_us = now_us
        self.accepted_us, self._refused_us = now_us, None

    def refuse(self, now_us: int) -> None:
        """It came and was not believed."""
        if self._refused_us is None:
            self._refused_us = now_us
