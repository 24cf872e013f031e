"""A command is repeated until it is answered, and given up after ten tries."""

import pytest

from companion.commands import REPEAT_US, TRIES, Command, Outcome, ParameterWrite, is_for
from companion.telemetry import Ack
from wire.dialect import mavlink

ARM = mavlink.MAV_CMD_COMPONENT_ARM_DISARM


def arm():
    return Command(ARM, (1.0,), "arm")


def test_it_is_sent_at_once_then_every_half_second_with_the_confirmation_counted_up():
    command, confirmations = arm(), []
    for now_us in range(0, 2_000_000, 20_000):
        if command.due(now_us):
            confirmations.append((now_us, command.message(1).confirmation))
    assert confirmations == [(0, 0), (500_000, 1), (1_000_000, 2), (1_500_000, 3)]


def test_it_is_given_up_after_ten_tries_and_says_so():
    command = arm()
    for k in range(TRIES + 1):
        command.due(k * REPEAT_US)
    assert command.outcome is Outcome.UNANSWERED
    assert "'arm' after 10 tries" in command.failure()


@pytest.mark.parametrize(
    ("result", "outcome"),
    [
        (mavlink.MAV_RESULT_ACCEPTED, Outcome.ACCEPTED),
        (mavlink.MAV_RESULT_TEMPORARILY_REJECTED, Outcome.PENDING),
        (mavlink.MAV_RESULT_IN_PROGRESS, Outcome.PENDING),
        (mavlink.MAV_RESULT_DENIED, Outcome.REFUSED),
        (mavlink.MAV_RESULT_UNSUPPORTED, Outcome.REFUSED),
        (mavlink.MAV_RESULT_FAILED, Outcome.REFUSED),
    ],
)
def test_an_answer_ends_it_unless_it_asks_to_wait(result, outcome):
    command = arm()
    command.due(0)
    command.answered(Ack(ARM, result))
    assert command.outcome is outcome


def test_the_answer_to_another_command_changes_nothing():
    command = arm()
    command.answered(Ack(mavlink.MAV_CMD_DO_SET_MODE, mavlink.MAV_RESULT_DENIED))
    assert command.outcome is Outcome.PENDING


def test_an_answer_from_before_it_was_sent_is_not_its_own():
    command = arm()
    command.answered(Ack(ARM, mavlink.MAV_RESULT_DENIED))
    assert command.outcome is Outcome.PENDING


@pytest.mark.parametrize(("target", "ours"), [((1, 191), True), ((0, 0), True), ((255, 190), False), ((1, 190), False)])
def test_an_answer_addressed_to_somebody_else_is_not_ours(target, ours):
    assert is_for(Ack(ARM, 0, *target), 1, 191) is ours


def test_a_parameter_is_written_until_the_vehicle_tells_its_value():
    write = ParameterWrite("COM_OBL_RC_ACT", 7e-45, mavlink.MAV_PARAM_TYPE_INT32, "5 (Hold)")  # 5 as PX4 writes it
    assert write.due(0)
    assert not write.due(100_000)
    write.echoed(bytes([0, 0, 0, 0]))
    assert write.due(REPEAT_US)
    write.echoed(bytes([5, 0, 0, 0]))
    assert write.outcome is Outcome.ACCEPTED


def test_a_parameter_without_an_echo_is_given_up_and_named():
    write = ParameterWrite("COM_OBL_RC_ACT", 7e-45, mavlink.MAV_PARAM_TYPE_INT32, "5 (Hold)")
    for k in range(TRIES + 1):
        write.due(k * REPEAT_US)
    assert write.outcome is Outcome.UNANSWERED
    assert write.failure() == "COM_OBL_RC_ACT was not set to 5 (Hold): no echo after 10 tries"


def test_a_refusal_names_the_result():
    command = arm()
    command.due(0)
    command.answered(Ack(ARM, mavlink.MAV_RESULT_DENIED))
    assert command.failure() == "the vehicle refused to arm: MAV_RESULT_DENIED"
