"""The vehicle put through what clients said to the real autopilots: every difference is in the tables of the document.

docs/side_by_side.md has one table a recording, and a row a difference: what was said, what the real one answered, what
this one answers, and why. Both directions are checked: no difference without a row, no row without a difference.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fnmatch import fnmatchcase
from functools import cache
from pathlib import Path

import pytest
from recorded_talk import Talk, Turn, play, recorded

from fakevehicle.config import Autopilot, LinkConfig, VehicleConfig
from fakevehicle.vehicle import Vehicle
from fakevehicle.vocabulary import Geodetic

ROOT = Path(__file__).parents[2]
LINKS = (LinkConfig("onboard", "onboard"),)


Row = tuple[str, str, str]
"""What was said, what the real one answered, what ours answered."""


def reasons(heading: str) -> dict[Row, str]:
    """One table of the document: each row's reason."""
    section = (ROOT / "docs/side_by_side.md").read_text().split(f"## `{heading}`")[1].split("\n## ")[0]
    cells = [
        [c.strip().strip("`") for c in line.strip("|").split("|")]
        for line in section.splitlines()
        if line.startswith("| `")
    ]
    assert all(len(row) == 4 and row[3] for row in cells), "every row has four cells and a reason"
    return {(said, theirs, ours): reason for said, theirs, ours, reason in cells}


def rows(heading: str) -> list[Row]:
    """The rows of one table, without their reasons."""
    return list(reasons(heading))


def differences(theirs: Talk, ours: Talk) -> list[Row]:
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


def unexplained(found: Sequence[Row], table: Sequence[Row]) -> list[Row]:
    return [f for f in found if not any(fits(f, row) for row in table)]


def unused(found: Sequence[Row], table: Sequence[Row]) -> list[Row]:
    return [row for row in table if not any(fits(f, row) for f in found)]


def fits(found: Row, row: Row) -> bool:
    """A row may leave a part open with a star, and writes silence as a dash."""
    return all(fnmatchcase(f or "-", r) for f, r in zip(found, row, strict=True))


@dataclass(frozen=True)
class Recording:
    """One recorded conversation: the autopilot, and how long after its boot the first packet came [s]."""

    name: str
    autopilot: Autopilot
    boot_s: float
    home: Geodetic

    def __str__(self) -> str:
        return self.name


ZURICH = Geodetic(math.radians(47.397742), math.radians(8.545594), 488.0)
CANBERRA = Geodetic(math.radians(-35.363261), math.radians(149.165230), 584.0)
PX4 = Recording("px4-offboard.tlog", "px4", 0.0, ZURICH)
SERVICES = Recording("arducopter-services.tlog", "ardupilot", 1.0, CANBERRA)
CIRCLE = Recording("arducopter-guided-circle.tlog", "ardupilot", 0.0, CANBERRA)
MAVPROXY = Recording("mavproxy-arducopter.tlog", "ardupilot", 0.4, CANBERRA)
RECORDINGS = (PX4, CIRCLE, MAVPROXY, pytest.param(SERVICES, marks=pytest.mark.slow))
AFTER_S = 30.0
"""Played on after the client's last word, for what is still to happen."""


@cache
def talks(recording: Recording) -> tuple[Talk, Talk]:
    """The real conversation, and ours."""
    theirs = recorded(ROOT / f"tests/data/{recording.name}.gz", round(recording.boot_s * 1e6))
    vehicle = Vehicle(VehicleConfig(autopilot=recording.autopilot, home=recording.home, links=LINKS))
    return theirs, play(theirs.turns, vehicle, seconds=AFTER_S)


@pytest.mark.parametrize("recording", RECORDINGS, ids=str)
def test_a_recorded_client_is_answered_as_it_was_but_for_what_the_table_says(recording: Recording) -> None:
    assert unexplained(differences(*talks(recording)), rows(recording.name)) == []


@pytest.mark.slow
@pytest.mark.parametrize("recording", RECORDINGS, ids=str)
def test_the_table_claims_no_difference_that_is_not_there(recording: Recording) -> None:
    assert unused(differences(*talks(recording)), rows(recording.name)) == []


RESTS = {
    152.3: (0.01, -0.01, -3.97),  # after a takeoff to 4 m
    163.5: (0.04, 5.01, -4.00),  # a position alone
    172.3: (0.00, -0.03, -4.00),
    182.7: (7.11, -0.03, -4.00),  # a velocity for 7.3 s; the last one flown until GUID_TIMEOUT
    195.0: (-0.23, -0.05, -4.00),  # a position with a yaw, after velocities in the body's frames
    207.5: (-0.17, -0.02, -4.00),  # a yaw rate alone with velocity zero, and a turn by command
    212.9: (0.01, -4.79, -4.00),  # a position on the way, then one with acceleration and no velocity: a stop
    215.9: (-0.01, -4.87, -4.00),  # a position in frame 3: a stop
    234.2: (1.57, 2.05, -4.00),  # position and velocity, carried on; then an offset of 2 m east
    243.5: (6.02, 1.99, -4.99),  # DO_REPOSITION
    249.3: (6.03, 1.99, -4.99),  # a position beyond the fence: not flown
    251.3: (6.02, 1.99, -4.99),  # a position above the fence: not flown
    284.0: (-0.04, -0.10, -4.01),  # back from the fence
    350.0: (0.00, -0.01, 0.01),  # a mission, a return, on the ground
    362.5: (0.01, -0.01, -9.96),  # a takeoff to 10 m
}
"""Where ArduCopter was in arducopter-services.tlog after each kind of setpoint: its LOCAL_POSITION_NED [m] at a time
[s] since the recording began."""


@pytest.mark.slow
def test_setpoints_lead_where_they_led_arducopter() -> None:
    _, ours = talks(SERVICES)
    track = {now_us: position for now_us, position in ours.track}
    apart = {at: math.dist(track[round((at + SERVICES.boot_s) * 10) * 100_000], place) for at, place in RESTS.items()}
    assert {at: round(d, 2) for at, d in apart.items() if d > 0.6} == {}


def test_the_recordings_say_enough_to_be_compared() -> None:
    """The comparison cannot pass for want of answers: the real autopilots gave this many."""
    answered = {}
    for recording in (PX4, SERVICES, CIRCLE, MAVPROXY):
        turns = recorded(ROOT / f"tests/data/{recording.name}.gz", 0).turns
        answered[recording.name] = sum(bool(turn.answers) for turn in turns)
    assert answered == {
        "px4-offboard.tlog": 53,
        "arducopter-services.tlog": 162,
        "arducopter-guided-circle.tlog": 14,
        "mavproxy-arducopter.tlog": 26,
    }


def test_a_difference_in_an_answer_a_result_an_order_or_a_mode_is_found() -> None:
    """The comparison itself, on a conversation that is not there."""

    def talk(*answers: str, story: str = "mode 4") -> Talk:
        return Talk([Turn(0, "LONG 400(1,0)", b"", list(answers))], [story])

    real = talk("ACK 400=4", "TEXT 2")
    assert differences(real, talk("ACK 400=4", "TEXT 2")) == []
    assert differences(real, talk("TEXT 2", "ACK 400=4")) != []
    assert differences(real, talk("ACK 400=0")) != []
    assert differences(real, talk()) != []
    assert differences(real, talk("ACK 400=4", "TEXT 2", story="mode 5")) != []
    assert differences(talk("ACK 400=4"), talk("ACK 400=4", "TEXT 2")) == []  # put into words here
    assert differences(talk("ACK 400=0"), talk("ACK 400=0", "TEXT 2")) != []
