"""What tests of the paper share: an executor in this process, silent progress, and the numbers of a page."""

import re
from bisect import bisect_left
from collections.abc import Mapping

from campaigns.executors.base import Outcome, answer


class Here:
    """An executor in this process that counts what it was given."""

    def __init__(self) -> None:
        self.given: list[object] = []

    def map(self, work, items, *, timeout_s=None, retries=0):
        for item in items:
            self.given.append(item)
            done = answer(work, item)
            yield Outcome(item, done.result, done.error)

    def close(self) -> None:
        """Nothing to end."""


class Silent:
    """Progress that nobody sees."""

    def begin(self, stage: str, items: int, kept: int) -> None: ...

    def done(self) -> None: ...


def numbers_of(value: object) -> list[float]:
    """Every number in what JSON holds."""
    if isinstance(value, bool) or value is None or isinstance(value, str):
        return []
    if isinstance(value, Mapping):
        value = list(value.values())
    return [n for item in value for n in numbers_of(item)] if isinstance(value, list | tuple) else [float(value)]


def strange_numbers(text: str, results: dict) -> list[str]:
    """The numbers of a page that no result rounds to, but for those in names and formulas, which are results, too."""
    quoted = [*results["paper"]["places"].values(), *results["laws"]["winds"], *map(str, results["made"].values())]
    quoted += [row["formula"] for row in results["functions"]]
    for words in sorted(filter(None, quoted), key=len, reverse=True):
        text = text.replace(words, " ")
    known = sorted(numbers_of(results))
    strange = []
    for token in re.findall(r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?", text):
        mantissa, _, exponent = token.partition("e")
        unit = 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))
        reach = 0.5 * unit * (1.0 + 1e-6)
        at = bisect_left(known, float(token) - reach)
        if at == len(known) or known[at] > float(token) + reach:
            strange.append(token)
    return strange
