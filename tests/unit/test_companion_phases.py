"""Every (phase, event) pair has a written outcome, and nothing leaves a phase that is over."""

import itertools

import pytest

from companion.phases import AIRBORNE, OVER, TRANSITIONS, Event, Phase, after


@pytest.mark.parametrize(("phase", "event"), list(itertools.product(Phase, Event)))
def test_every_pair_of_phase_and_event_has_the_outcome_the_table_names_and_all_others_change_nothing(phase, event):
    expected = TRANSITIONS.get((phase, event), phase)
    assert after(phase, event) is expected
    if phase in OVER:
        assert expected is phase


@pytest.mark.parametrize("phase", [p for p in Phase if p not in OVER])
def test_an_operator_who_asks_for_land_is_heard_in_every_phase_but_the_landing(phase):
    if phase is not Phase.LANDING:
        called_off = {Phase.ARMING: Phase.DISARMING, Phase.DISARMING: Phase.DISARMING}.get(phase, Phase.FAILED)
        assert after(phase, Event.LAND_ASKED) is (Phase.LANDING if phase in AIRBORNE else called_off)


@pytest.mark.parametrize("phase", [Phase.PREPARING, Phase.PLANNING, Phase.ENGAGING])
def test_on_the_ground_a_vehicle_that_is_gone_or_boots_again_is_waited_for(phase):
    assert after(phase, Event.VEHICLE_SILENT) is Phase.CONNECTING
    assert after(phase, Event.REBOOTED) is Phase.CONNECTING


@pytest.mark.parametrize("phase", [Phase.TAKING_OFF, Phase.FLYING, Phase.REJOINING])
def test_in_the_air_a_silent_vehicle_is_spoken_to_and_one_that_boots_again_is_left_alone(phase):
    assert after(phase, Event.VEHICLE_SILENT) is Phase.LINK_LOST
    assert after(phase, Event.REBOOTED) is Phase.FAILED


def test_in_the_air_no_refusal_ends_the_flight_without_a_landing():
    assert after(Phase.FLYING, Event.REFUSED) is Phase.FLYING
    assert after(Phase.LANDING, Event.REFUSED) is Phase.LANDING
    assert after(Phase.HANDED_OVER, Event.REFUSED) is Phase.HANDED_OVER
