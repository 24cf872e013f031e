"""The pytest plug-in: missions as tests, flown in lockstep on the bundled vehicle, the same every time.

    @pytest.mark.mission("l_shape.yaml")          # beside the test's file; or as a path from the root
    @pytest.mark.autopilot("px4", "ardupilot")    # once with each
    @pytest.mark.seeds(1, 2, 3)                   # once with each
    @pytest.mark.wind(north=4, gust=3, at=12)     # m/s; a gust on top of it, at 12 s
    @pytest.mark.fault("gps:off@15-20")           # as `fakevehicle --fault` has them; several marks, several faults
    @pytest.mark.link(loss=0.3, jitter_ms=200)    # as `LinkFaults` has them
    def test_the_wall_is_flown_round(flight):
        result = flight.fly()
        assert result.ok, result.cause

Fixtures: `mission` (read and checked), `vehicle` and `companion` (what will be flown; to be set up before and looked at
after), `flight` (a `companion.testing.flight.Flight`; `fly()` gives a `FlightResult`). Every flight is recorded into
the test's temporary folder; when the test fails the recording is kept under `recordings/failed`, and the report names
it and tells what the companion said.
"""

import re
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from companion.errors import CompanionError

if TYPE_CHECKING:  # importing a vehicle takes a second, which tests without flights need not pay
    from companion.core import Companion
    from companion.mission import Mission
    from companion.testing.flight import Flight
    from companion.testing.spec import FlightSpec
    from fakevehicle.vehicle import Vehicle

MARKERS = (
    "mission(file): the mission to fly, beside the test's file or from the root",
    "autopilot(name, ...): whose behaviour the vehicle shows, px4 or ardupilot; several: once with each",
    "seeds(number, ...): of planner and sensors; several: once with each",
    "wind(north, east, down, gust, at, hold): of the air over ground [m/s]; a gust on top of it at a time [s]",
    "fault(text, ...): of a sensor or a motor on a schedule, as in gps:off@20-40",
    "link(loss, duplicate, reorder, jitter_ms, blackouts, garbage, shouting): what goes wrong on the link",
)
FAILED = Path("recordings/failed")
_KEPT_NOTES = 40

_flights: "pytest.StashKey[Flight]" = pytest.StashKey()


def pytest_configure(config: pytest.Config) -> None:
    """Register the markers."""
    for marker in MARKERS:
        config.addinivalue_line("markers", marker)


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """A test once for each seed and autopilot of its marks."""
    for mark, fixture in (("seeds", "flight_seed"), ("autopilot", "flight_autopilot")):
        marker = metafunc.definition.get_closest_marker(mark)
        if marker is not None and fixture in metafunc.fixturenames:
            metafunc.parametrize(fixture, marker.args, indirect=True)


@pytest.fixture
def flight_seed(request: pytest.FixtureRequest) -> int:
    """The seed of this flight."""
    return int(getattr(request, "param", 1))


@pytest.fixture
def flight_autopilot(request: pytest.FixtureRequest) -> str:
    """The flavour of this flight."""
    return str(getattr(request, "param", "px4"))


@pytest.fixture
def flight_spec(
    request: pytest.FixtureRequest, tmp_path: Path, flight_seed: int, flight_autopilot: str
) -> "FlightSpec":
    """What the marks of a test say."""
    from companion.testing.spec import FlightSpec

    link = request.node.get_closest_marker("link")
    wind = request.node.get_closest_marker("wind")
    with _in_one_line():
        return FlightSpec(
            mission=_file(request),
            autopilot=flight_autopilot,  # type: ignore[arg-type]  # checked where the vehicle is made
            seed=flight_seed,
            **({} if wind is None else _wind(**wind.kwargs)),
            faults=tuple(str(text) for mark in request.node.iter_markers("fault") for text in mark.args),
            link=None if link is None else _link(flight_seed, **link.kwargs),
            record=tmp_path / "flight.mcap",
        )


@pytest.fixture
def flight(request: pytest.FixtureRequest, flight_spec: "FlightSpec") -> Iterator["Flight"]:
    """The flight, ready to be flown."""
    from companion.testing.flight import Flight

    with _in_one_line():
        ready = request.node.stash[_flights] = Flight(flight_spec)
    yield ready
    del request.node.stash[_flights]


@pytest.fixture
def mission(flight: "Flight") -> "Mission":
    """The mission that is flown."""
    return flight.mission


@pytest.fixture
def companion(flight: "Flight") -> "Companion":
    """The companion that flies it."""
    return flight.companion


@pytest.fixture
def vehicle(flight: "Flight") -> "Vehicle":
    """The vehicle that is flown."""
    return flight.vehicle  # type: ignore[return-value]  # no mark makes it restart


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item: pytest.Item, call: pytest.CallInfo[Any]) -> Any:
    """Keep the recording of a flight whose test failed, and tell where it is and what was said in it."""
    report: pytest.TestReport = yield
    flown = item.stash.get(_flights, None)
    if call.when == "call" and report.failed and flown is not None:
        report.sections.append(("flight", _story(item, flown)))
    return report


def _story(item: pytest.Item, flown: "Flight") -> str:
    result, record = flown.result, flown.spec.record
    kept = _keep(item, record) if record is not None and record.exists() else None
    if result is None:
        return f"it was not flown to its end\nrecording: {kept or 'none'}"
    lines = result.story.splitlines()
    said = "\n".join(["...", *lines[-_KEPT_NOTES:]] if len(lines) > _KEPT_NOTES else lines)
    cause = result.cause or "none, as far as the mission's own expectations go"
    return f"cause: {cause}\nrecording: {kept or 'none'}\n{said}"


def _keep(item: pytest.Item, record: Path) -> Path | None:
    """Copy a recording to where it outlives the test."""
    name = re.sub(r"[^\w.-]+", "_", item.nodeid).strip("_")[-150:]
    kept = item.config.rootpath / FAILED / f"{name}.mcap"
    try:
        kept.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(record, kept)
    except OSError:
        return None
    return kept


@contextmanager
def _in_one_line() -> Iterator[None]:
    """A mission or a mark that cannot be is a failure in one line, without a way through our code."""
    try:
        yield
    except (CompanionError, TypeError, ValueError) as error:
        pytest.fail(str(error), pytrace=False)


def _file(request: pytest.FixtureRequest) -> Path:
    marker = request.node.get_closest_marker("mission")
    if marker is None or len(marker.args) != 1:
        pytest.fail('expected a mark that names one mission, as in @pytest.mark.mission("hop.yaml")', pytrace=False)
    name = str(marker.args[0])
    beside = request.path.parent / name
    return beside if beside.exists() else request.config.rootpath / name


def _wind(
    north: float = 0.0, east: float = 0.0, down: float = 0.0, gust: float = 0.0, at: float = 0.0, hold: float = 2.0
) -> dict[str, Any]:
    """Wind and gust of a mark; the gust blows the way of the wind, or from the south without one."""
    import math

    import numpy as np

    from fakevehicle.physics.wind import Gust

    speed = math.hypot(north, east)
    way = (north / speed, east / speed, 0.0) if speed > 0.0 else (1.0, 0.0, 0.0)
    gusts = (Gust(round(1e6 * at), 0.5, hold, gust * np.array(way)),) if gust else ()
    return {"wind": (north, east, down), "gusts": gusts}


def _link(seed: int, **faults: Any) -> Any:
    from companion.testing.wire import LinkFaults

    return LinkFaults(**{"seed": seed, **faults})
