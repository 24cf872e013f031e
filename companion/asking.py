"""The one thing asked of the vehicle at a time: sent until it is answered, given again while it has no effect.

An accepted command is not a fact yet: what it should bring about shows in telemetry later, or not at all.
"""

from collections.abc import Callable, Iterable
from typing import Any

from companion.commands import Command, Outcome, ParameterWrite, is_for
from companion.telemetry import Ack, Telemetry
from companion.vehiclelink import COMPONENT_ID

CONFIRM_US = 2_000_000
"""An accepted command whose effect does not show after this is given again; PX4's HEARTBEAT is up to 1 s late."""
CONFIRM_TRIES = 5

Question = Command | ParameterWrite


class Asking:
    """What is under way.

    Attributes
    ----------
    question : a command or a parameter to write; None: nothing.
    """

    def __init__(self) -> None:
        self.question: Question | None = None
        self._tries = 0

    def forget(self) -> None:
        """Nothing is under way any more, and what was tried counts no longer."""
        self.question, self._tries = None, 0

    @property
    def open(self) -> bool:
        """Whether it may still change what the vehicle does."""
        return self.question is not None and self.question.outcome in (Outcome.PENDING, Outcome.ACCEPTED)

    def take_acks(self, now_us: int, acks: Iterable[Ack], target: int) -> None:
        """Read the acknowledgements that came since; ours are addressed to system `target`."""
        for ack in acks:
            if isinstance(self.question, Command) and is_for(ack, target, COMPONENT_ID):
                self.question.answered(ack, now_us)

    def take_answers(self, now_us: int, telemetry: Telemetry, target: int) -> None:
        """Read the acknowledgements and echoes that came since."""
        self.take_acks(now_us, telemetry.acks, target)
        if isinstance(self.question, ParameterWrite):
            self.question.echoed(telemetry.parameters.get(self.question.name, b""))

    def message(self, now_us: int, target: int) -> Any | None:
        """What to send now, if something is due."""
        question = self.question
        return question.message(target) if question is not None and question.due(now_us) else None

    def no_effect(self, now_us: int) -> bool:
        """Whether a command was accepted long enough ago to show."""
        question = self.question
        accepted = isinstance(question, Command) and question.outcome is Outcome.ACCEPTED
        return accepted and isinstance(question, Command) and now_us - question.answered_us >= CONFIRM_US

    def failure(self, now_us: int, again: Callable[[], Command] | None) -> str:
        """Why a command has come to nothing, or nothing; without an effect it is given `again`, some times."""
        command = self.question
        if not isinstance(command, Command) or command.outcome is Outcome.PENDING:
            return ""
        if command.outcome is not Outcome.ACCEPTED:
            return command.failure()
        if again is None or not self.no_effect(now_us):
            return ""
        self._tries += 1
        if self._tries < CONFIRM_TRIES:
            self.question = again()
            return ""
        return f"the vehicle accepted to {command.what}, and does not"
