"""Many flights: in a few processes, each started once, results as they come, in the order they were asked for."""

import traceback
from collections.abc import Iterable, Iterator
from multiprocessing import get_context

from companion.testing.flight import fly
from companion.testing.spec import FlightResult, FlightSpec


def fly_all(specs: Iterable[FlightSpec], jobs: int = 2) -> Iterator[FlightResult]:
    """Fly every spec, `jobs` at a time; 1 flies in this process.

    A fault of ours is the result of its flight, with its place, and not the end of the others.
    """
    if jobs == 1:
        yield from map(_flown, specs)
        return
    with get_context("spawn").Pool(jobs) as pool:  # a process pays once for its imports and kernels
        yield from pool.imap(_flown, specs)


def _flown(spec: FlightSpec) -> FlightResult:
    try:
        return fly(spec)
    except Exception as error:
        place = traceback.extract_tb(error.__traceback__)[-1]
        where = f"{place.filename.rpartition('/')[2]}:{place.lineno}"
        return FlightResult(spec, ok=False, cause=f"{type(error).__name__} at {where}: {error}")
