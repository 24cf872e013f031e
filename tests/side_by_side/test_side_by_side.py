"""The vehicle put through what clients said to the real autopilots: every difference is in the tables of the document.

docs/side_by_side.md has one table a recording, and a row a difference: what was said, what the real one answered, what
this one answers, and why. Both directions are checked: no difference without a row, no row without a difference.
"""

from collections.abc import Sequence
from fnmatch import fnmatchcase
from functools import cache
from pathlib import Path

import pytest
from recorded_talk import Talk, Turn, play, recorded

from fakevehicle.config import LinkConfig, VehicleConfig
from fakevehicle.vehicle import Vehicle

ROOT = Path(__file__).parents[2]
LINKS = (LinkConfig("onboard", "onboard"),)


def rows(heading: str) -> list[tuple[str, str, str]]:
    """(said, theirs, ours) of one table of the document."""
    section = (ROOT / "docs/side_by_side.md").read_text().split(f"## `{heading}`")[1].split("\n## ")[0]
    cells = [
        [c.strip().strip("`") for c in line.strip("|").split("|")]
        for line in section.splitlines()
        if line.startswith("| `")
    ]
    assert all(len(row) == 4 and row[3] for row in cells), "every row has four cells and a reason"
    return [(said, theirs, ours) for said, theirs, ours, _ in cells]


def differences(theirs: Talk, ours: Talk) -> list[tuple[str, str, str]]:
    """Turns that were answered otherwise, and the story where it went otherwise; each kind once, in order."""
    found = dict.fromkeys(
        (real.said, " ".join(real.answers), " ".join(here.answers))
        for real, here in zip(theirs.turns, ours.turns, strict=True)
        if not same(real, here)
    )
    if theirs.story != ours.story:
        found["story", ", ".join(theirs.story), ", ".join(ours.story)] = None
    return list(found)


def same(real: Turn, here: Turn) -> bool:
    """Whether two turns were answered alike; a refusal that is put into words here only counts as alike."""
    if real.answers == here.answers:
        return True
    silent = not any(word.startswith("TEXT") for word in real.answers)
    refused = any(
        word.startswith(("ACK ", "MISSION_ACK ")) and not word.endswith(("=0", " 0")) for word in here.answers
    )
    return silent and refused and real.answers == [word for word in here.answers if not word.startswith("TEXT")]


def unexplained(found: Sequence[tuple[str, str, str]], table: Sequence[tuple[str, str, str]]) -> list[tuple[str, ...]]:
    return [f for f in found if not any(_fits(f, row) for row in table)]


def unused(found: Sequence[tuple[str, str, str]], table: Sequence[tuple[str, str, str]]) -> list[tuple[str, ...]]:
    return [row for row in table if not any(_fits(f, row) for f in found)]


def _fits(found: tuple[str, str, str], row: tuple[str, str, str]) -> bool:
    """A row may leave a part open with a star, and writes silence as a dash."""
    return all(fnmatchcase(f or "-", r) for f, r in zip(found, row, strict=True))


@cache
def px4() -> tuple[Talk, Talk]:
    theirs = recorded(ROOT / "tests/data/px4-offboard.tlog.gz", 0)
    theirs.turns = [turn for turn in theirs.turns if turn.at_us < 91_000_000]
    theirs.story = theirs.story[: theirs.story.index("disarmed") + 1]
    return theirs, play(theirs.turns, Vehicle(VehicleConfig(links=LINKS)), seconds=15.0)


def test_px4s_client_is_answered_as_px4_did_but_for_what_the_table_says() -> None:
    found = differences(*px4())
    table = rows("px4-offboard.tlog")
    assert unexplained(found, table) == []


@pytest.mark.slow
def test_the_table_claims_no_difference_to_px4_that_is_not_there() -> None:
    assert unused(differences(*px4()), rows("px4-offboard.tlog")) == []
