"""Refusals in words, for who asks over and over: the same ones for the same peer only after a while.

Words go to everybody, as STATUSTEXTs do, but what one peer has been told is no reason to leave another without.
"""

from collections.abc import Callable

from fakevehicle.services.outbox import Sender

QUIET_US = 10_000_000
"""The same words for the same peer are not said again before this, where they go beside an answer."""
ALONE_US = 3_000_000
"""Likewise, where they are the only answer there is."""
MAX_REMEMBERED = 128
"""Words remembered for that; some name what a peer asked for, so there is no end to them."""


class Words:
    """Says a refusal, if it has not just been said.

    Parameters
    ----------
    warn : tells people (a STATUSTEXT).
    now_us : the vehicle's clock.
    """

    def __init__(self, warn: Callable[[str], None], now_us: Callable[[], int]) -> None:
        self._warn = warn
        self._now_us = now_us
        self._said: dict[tuple[Sender, str], int] = {}

    def __call__(self, sender: Sender, text: str, quiet_us: int = QUIET_US) -> None:
        """Tell why `sender` is refused, at most once in `quiet_us` [us]."""
        key, now_us = (sender, text), self._now_us()
        said_us = self._said.get(key)
        if said_us is not None and now_us - said_us < quiet_us:
            return
        self._said.pop(key, None)
        while len(self._said) >= MAX_REMEMBERED:
            del self._said[next(iter(self._said))]  # said longest ago
        self._said[key] = now_us
        self._warn(text)
