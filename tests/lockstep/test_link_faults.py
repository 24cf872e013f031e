"""A bad link: the mission completes, or ends in a state that the safety table names; never an exception."""

import hashlib
import re
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from companion.drivers.tick import Tick
from companion.testing.flight import Flight, fly
from companion.testing.spec import FlightResult, FlightSpec
from companion.testing.wire import LinkFaults

HOP = Path(__file__).parents[2] / "missions" / "hop.yaml"

NAMED = re.compile(
    "|".join(
        (
            "no position from the vehicle for .*: landing",
            "the vehicle is .* m from its reference for .*: landing",
            "nothing heard from the vehicle for .*",
            "the vehicle booted again in the air: nothing more is sent",
            "the vehicle disarmed in the air, or never left the ground",
            "not in the air .* after the takeoff began: landing",
            "no way back to the mission.*",
            ".* not fought for",
            "the vehicle is not ready after .*",
            "no HEARTBEAT from a vehicle in .*",
            ".*: (refused|no answer).*",
            "no answer to .*",
            "no safe way for .*",
            "nothing seen for .*: landing",
        )
    )
)
"""What `companion.safety` and the phases before the flight say; a failure in other words is a new one."""


def ends_as_it_may(result: FlightResult) -> None:
    assert result.phase in ("done", "failed"), result.story
    if result.failure:
        assert NAMED.fullmatch(result.failure), result.story
    if result.verdict.min_clearance_m is not None:
        assert result.verdict.min_clearance_m > 0.0, result.story


@pytest.mark.parametrize("autopilot", ["px4", "ardupilot"])
@pytest.mark.parametrize(
    "link",
    [
        pytest.param(LinkFaults(loss=0.3), id="loss"),
        pytest.param(LinkFaults(duplicate=0.2), id="duplicates"),
        pytest.param(LinkFaults(reorder=0.2), id="reordering"),
        pytest.param(LinkFaults(jitter_ms=200), id="jitter"),
        pytest.param(LinkFaults(garbage=50), id="garbage"),
        pytest.param(LinkFaults(shouting=True), id="a second vehicle that shouts commands"),
    ],
)
def test_the_mission_completes(link: LinkFaults, autopilot: str) -> None:
    result = fly(FlightSpec(HOP, autopilot=autopilot, link=link))
    assert result.phase == "done", result.story
    assert not result.failure


def test_a_takeoff_whose_answer_was_lost_is_not_called_off_when_its_repeat_is_refused_in_the_air() -> None:
    result = fly(FlightSpec(HOP.parent / "l_shape.yaml", autopilot="ardupilot", seed=9, link=LinkFaults(0.3, seed=9)))
    assert result.phase == "done", result.story
    assert not result.failure


def test_a_blackout_of_five_seconds_in_the_air_is_survived_and_the_mission_goes_on() -> None:
    result = fly(FlightSpec(HOP, link=LinkFaults(blackouts=((9.5, 14.5),))))
    assert result.phase == "done", result.story
    assert not result.failure
    assert result.said("link lost")
    assert result.said("rejoin")


@pytest.mark.slow
@pytest.mark.parametrize("autopilot", ["px4", "ardupilot"])
@pytest.mark.parametrize("start", [1.0, 5.2, 6.5, 8.0, 11.0, 13.0])
def test_a_blackout_at_any_time_ends_in_a_state_that_has_a_name(start: float, autopilot: str) -> None:
    ends_as_it_may(fly(FlightSpec(HOP, autopilot=autopilot, link=LinkFaults(blackouts=((start, start + 5.0),)))))


@pytest.mark.parametrize("autopilot", ["px4", "ardupilot"])
def test_a_vehicle_that_restarts_on_the_ground_is_flown_all_the_same(autopilot: str) -> None:
    result = fly(FlightSpec(HOP, autopilot=autopilot, reboot_s=3.0))
    assert result.phase == "done", result.story


@pytest.mark.parametrize("autopilot", ["px4", "ardupilot"])
def test_a_vehicle_that_restarts_in_the_air_gets_no_more_commands(autopilot: str) -> None:
    flight, sent = Flight(FlightSpec(HOP, autopilot=autopilot, reboot_s=9.0)), []

    def tap(tick: Tick) -> None:
        sent.extend((tick.now_us, o.data[7]) for o in tick.outputs if hasattr(o, "data"))

    result = flight.fly(taps=[tap])
    assert result.phase == "failed", result.story
    ends_as_it_may(result)
    boot_us = 9_000_000 + 2_000_000
    commands = {76: "COMMAND_LONG", 75: "COMMAND_INT", 84: "SET_POSITION_TARGET_LOCAL_NED"}
    assert not [(at, commands[kind]) for at, kind in sent if kind in commands and at > boot_us + 100_000]


def test_everything_at_once_is_the_same_flight_each_time() -> None:
    faults = LinkFaults(0.3, 0.2, 0.1, 200, ((9.0, 14.0),), 20, True, seed=3)

    def whole() -> str:
        digest = hashlib.sha256()

        def tap(tick: Tick) -> None:
            for _, item in tick.inputs:
                digest.update(getattr(item, "data", b""))
            for output in tick.outputs:
                digest.update(getattr(output, "data", b""))

        ends_as_it_may(Flight(FlightSpec(HOP, link=faults)).fly(taps=[tap]))
        return digest.hexdigest()

    assert whole() == whole()


@pytest.mark.slow
@settings(max_examples=8, deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow])
@given(
    faults=st.builds(
        LinkFaults,
        loss=st.floats(0, 0.6),
        duplicate=st.floats(0, 1),
        reorder=st.floats(0, 1),
        jitter_ms=st.floats(0, 600),
        blackouts=st.lists(st.tuples(st.floats(0, 20), st.floats(0.1, 8)), max_size=3).map(
            lambda rows: tuple((start, start + length) for start, length in rows)
        ),
        garbage=st.floats(0, 200),
        shouting=st.booleans(),
        seed=st.integers(0, 1000),
    ),
    autopilot=st.sampled_from(["px4", "ardupilot"]),
)
def test_no_link_however_bad_raises_and_every_end_has_a_name(faults: LinkFaults, autopilot: str) -> None:
    ends_as_it_may(fly(FlightSpec(HOP, autopilot=autopilot, link=faults)))
