"""What a rule gives: a verdict, figures, and a sentence with them.

`reproduced` and `not reproduced` come from what was measured here, `impossible` from arithmetic on what is printed, and
`not testable` from what a test would need and the paper does not tell.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from campaigns.paper import printed

Results = Mapping[str, Any]
Figures = dict[str, Any]


class Verdict(StrEnum):
    """What came of a claim."""

    REPRODUCED = "reproduced"
    NOT = "not reproduced"
    IMPOSSIBLE = "impossible"
    UNTESTABLE = "not testable"


@dataclass(frozen=True, slots=True)
class Finding:
    """What a rule says: a verdict, figures, and a sentence with them."""

    verdict: Verdict
    why: str
    figures: Figures


Rule = Callable[[Results], Finding]


def held(fact: bool) -> Verdict:
    """Of a claim that a measurement can bear out."""
    return Verdict.REPRODUCED if fact else Verdict.NOT


def refuted(fact: bool) -> Verdict:
    """Of a claim that arithmetic can refute: impossible when it does."""
    return Verdict.IMPOSSIBLE if fact else Verdict.REPRODUCED


def of_equations(
    figures: Callable[[], Mapping[str, Any]], wrong: Callable[[Mapping[str, Any]], bool], why: str
) -> Rule:
    """A rule from an equation alone."""

    def rule(results: Results) -> Finding:
        found = dict(figures())
        return Finding(refuted(wrong(found)), why, found)

    return rule


def needs(*wanted: str) -> Rule:
    """A rule: not testable, as long as anything that a test needs is not told.

    Raises
    ------
    ValueError : everything is told: then there is a test to be written.
    """
    missing = [name for name in wanted if name not in printed.TOLD]
    if not missing:
        raise ValueError(f"{', '.join(wanted)}: told, so there is something to test")

    def rule(results: Results) -> Finding:
        return Finding(Verdict.UNTESTABLE, "not told: " + ", ".join(missing), {})

    return rule
