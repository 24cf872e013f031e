"""What every executor promises, and how it calls the work.

The work's own exceptions are results, since the same item would raise them again: they are told in `Outcome.error` and
never tried twice. What happens to the one who works (its process died, its machine is gone) says nothing about the
item: it is tried again, at most `retries` times, and then told in `Outcome.infrastructure`. An item that takes longer
than `timeout_s` is told there, too, but is not tried again: it would take as long.
"""

import traceback
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Generic, Protocol, TypeVar

MOST_TOLD = 500
"""Letters of an exception: it goes into a row of a table."""
T = TypeVar("T")
R = TypeVar("R")


@dataclass(frozen=True, slots=True)
class Outcome(Generic[T, R]):
    """What came of an item.

    Attributes
    ----------
    item : as it was given.
    result : of the work; None when it has none, for one of the two reasons that follow.
    error : what the work raised, with its place; empty: nothing.
    infrastructure : what kept the work from its end; empty: nothing.
    attempts : how often it was begun.
    """

    item: T
    result: R | None = None
    error: str = ""
    infrastructure: str = ""
    attempts: int = 1


class Executor(Protocol):
    """Where work is done."""

    def map(
        self, work: Callable[[T], R], items: Iterable[T], *, timeout_s: float | None = None, retries: int = 0
    ) -> Iterator[Outcome[T, R]]:
        """One outcome for each item, as they end, in any order.

        Parameters
        ----------
        work : a function at the top of a module, that depends on its item only.
        items : taken one by one, little more of them than are worked on.
        timeout_s : how long one may take [s]; None: as long as it likes.
        retries : how often an item is given to somebody else when its worker was lost.
        """
        ...

    def close(self) -> None:
        """End at once what is still going on; its results are dropped."""
        ...


@dataclass(frozen=True, slots=True)
class Answer(Generic[R]):
    """What a worker sends back: a result, or what was raised."""

    result: R | None = None
    error: str = ""


def answer(work: Callable[[T], R], item: T) -> Answer[R]:
    """Do the work; an exception becomes its name, place and text."""
    try:
        return Answer(work(item))
    except Exception as error:
        return Answer(error=told(error))


def told(error: Exception) -> str:
    """An exception in one line, with the place where it was raised."""
    places = traceback.extract_tb(error.__traceback__)
    where = f" at {places[-1].filename.rpartition('/')[2]}:{places[-1].lineno}" if places else ""
    return f"{type(error).__name__}{where}: {' '.join(str(error).split())[:MOST_TOLD]}"
