"""The modes' tables: every pair has a written outcome, and each guard refuses with its own reason."""

from dataclasses import replace

import pytest

from fakevehicle.flavours.px4_modes import PX4_NUMBERS, custom_mode, event_for_custom_mode
from fakevehicle.modes import (
    GUARDS,
    TRANSITIONS,
    Conditions,
    Event,
    Mode,
    Refusal,
    Special,
    refusal,
)

FINE = Conditions(
    armed=False,
    airborne=False,
    attitude_valid=True,
    velocity_valid=True,
    position_valid=True,
    altitude_valid=True,
    home_known=True,
    setpoints_fresh=True,
    mode=Mode.HOLD,
)


@pytest.mark.parametrize("event", Event)
@pytest.mark.parametrize("mode", Mode)
def test_every_mode_and_event_has_a_written_outcome(mode: Mode, event: Event) -> None:
    assert isinstance(TRANSITIONS[event][mode], Mode | Special)
    assert event in GUARDS


@pytest.mark.parametrize("mode", PX4_NUMBERS)
def test_asking_for_a_mode_leads_to_that_mode_from_everywhere(mode: Mode) -> None:
    event = event_for_custom_mode(*PX4_NUMBERS[mode])
    assert event is not None
    elsewhere = [m for m in Mode if m is not Mode.GUIDED]  # which takes off by itself
    assert all(TRANSITIONS[event][before] is mode for before in elsewhere)


@pytest.mark.parametrize("mode", PX4_NUMBERS)
def test_custom_mode_is_main_at_bit_16_and_sub_at_bit_24(mode: Mode) -> None:
    main, sub = PX4_NUMBERS[mode]
    assert custom_mode(mode).to_bytes(4, "little") == bytes((0, 0, main, sub))


def test_custom_mode_of_hold_is_what_px4_sends() -> None:
    assert custom_mode(Mode.HOLD) == 50593792
    assert custom_mode(Mode.OFFBOARD) == 393216
    assert custom_mode(Mode.LAND) == 100925440


@pytest.mark.parametrize("mode", [Mode.LAND, Mode.RTL])
def test_arming_is_refused_in_modes_that_end_on_the_ground(mode: Mode) -> None:
    reason = refusal(Event.ASK_ARM, replace(FINE, mode=mode))
    assert reason is not None
    assert "Hold" in reason.value


@pytest.mark.parametrize(
    ("missing", "word"),
    [
        ("attitude_valid", "attitude"),
        ("velocity_valid", "velocity"),
        ("position_valid", "position"),
        ("altitude_valid", "altitude"),
        ("home_known", "home"),
    ],
)
def test_arming_names_what_the_estimate_lacks(missing: str, word: str) -> None:
    assert refusal(Event.ASK_ARM, FINE) is None
    reason = refusal(Event.ASK_ARM, replace(FINE, **{missing: False}))
    assert reason is not None
    assert word in reason.value


def test_offboard_without_a_stream_is_refused_only_when_armed() -> None:
    silent = replace(FINE, setpoints_fresh=False)
    assert refusal(Event.ASK_OFFBOARD, silent) is None
    assert refusal(Event.ASK_OFFBOARD, replace(silent, armed=True)) is not None
    assert refusal(Event.ASK_ARM, replace(silent, mode=Mode.OFFBOARD)) is not None


def test_only_a_kill_stops_the_motors_of_a_flying_vehicle() -> None:
    flying = replace(FINE, armed=True, airborne=True)
    assert refusal(Event.ASK_DISARM, flying) is Refusal.NOT_LANDED
    assert refusal(Event.ASK_KILL, flying) is None


def test_a_failsafe_never_undoes_what_a_more_severe_one_began() -> None:
    severity = [Mode.HOLD, Mode.RTL, Mode.LAND]
    for event, mode in zip((Event.FAIL_HOLD, Event.FAIL_RTL, Event.FAIL_LAND), severity, strict=True):
        for before in Mode:
            keeps = before in severity and severity.index(before) >= severity.index(mode)
            assert TRANSITIONS[event][before] is (Special.STAY if keeps else mode)


@pytest.mark.parametrize(("main", "sub"), [(1, 0), (4, 9), (5, 0), (0, 0), (-1, 0), (255, 255)])
def test_modes_this_vehicle_does_not_have_are_no_event(main: int, sub: int) -> None:
    assert event_for_custom_mode(main, sub) is None
