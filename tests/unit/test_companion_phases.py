"""Every (phase, event) pair has a written outcome, and nothing leaves a phase that is over."""

import itertools

import pytest

from companion.phases import OVER, TRANSITIONS, Event, Phase, after


@pytest.mark.parametrize(("phase", "event"), list(itertools.product(Phase, Event)))
def test_every_pair_of_phase_and_event_has_the_outcome_the_table_names_and_all_others_change_nothing(phase, event):
    expected = TRANSITIONS.get((phase, event), phase)
    assert after(phase, event) is expected
    if phase in OVER:
        assert expected is phase


@pytest.mark.parametrize("phase", [p for p in Phase if p not in OVER])
def test_a_vehicle_that_falls_silent_or_an_operator_who_asks_for_land_is_heard_in_every_phase_but_the_landing(phase):
    if phase is not Phase.CONNECTING:
        assert after(phase, Event.VEHICLE_SILENT) is Phase.FAILED
    if phase is not Phase.LANDING:
        assert after(phase, Event.LAND_ASKED) is (Phase.LANDING if phase is Phase.FLYING else Phase.FAILED)


def test_in_the_air_no_refusal_ends_the_flight_without_a_landing():
    assert after(Phase.FLYING, Event.REFUSED) is Phase.FLYING
    assert after(Phase.LANDING, Event.REFUSED) is Phase.LANDING
    assert after(Phase.HANDED_OVER, Event.REFUSED) is Phase.HANDED_OVER
