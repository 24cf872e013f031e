"""Several companions and bundled vehicles in one lockstep, each told of the others, and how near they came."""

from collections.abc import Callable, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from companion.cli.vehicle import LINK, build_vehicle
from companion.core import Companion, CompanionConfig
from companion.drivers.lockstep import Pair, fly_lockstep_many
from companion.drivers.planning import InlinePlanning
from companion.drivers.provenance import conclude
from companion.drivers.recording import RecordingTap, header
from companion.drivers.tick import Tap
from companion.fleet.missions import Part
from companion.phases import AIRBORNE
from companion.verdict import FlightMeter, Verdict, judge
from fakevehicle.config import Autopilot
from fakevehicle.recordings import parameters_of
from logs.parts import Rotation
from logs.recorder import Recorder

LIMIT_S = 300.0


@dataclass(frozen=True, slots=True)
class ManyResult:
    """What came of it.

    Attributes
    ----------
    verdicts : of each flight, in the order of the vehicles.
    separation_m : least distance between the centres of two vehicles in the air, as the physics had it; inf: never two.
    nearest : which two that were, from 1, and when [s].
    stops : proved stops that were flown instead of a way on, of all.
    simulated_s : how long it took.
    """

    verdicts: tuple[Verdict, ...]
    separation_m: float
    nearest: tuple[int, int, float]
    stops: int
    simulated_s: float


def fly_many(
    parts: Sequence[Part],
    seed: int = 1,
    autopilot: Autopilot = "px4",
    *,
    share: bool = True,
    loss: float = 0.0,
    record: Path | None = None,
    rotation: Rotation | None = None,
    limit_s: float = LIMIT_S,
    stop: Callable[[], bool] = lambda: False,
    taps: Callable[[Companion, FlightMeter], Sequence[Tap]] = lambda companion, meter: (),
) -> ManyResult:
    """Fly the parts of a mission at once.

    Parameters
    ----------
    seed : of the first vehicle; the others count up from it.
    share : tell each other; False: each flies as if it were alone.
    loss : part of what they tell that does not arrive, 0 to 1.
    record : a folder for a recording of each. rotation : when a part of one ends.
    taps : more that look on at each.
    """
    companions, vehicles, meters, pairs = [], [], [], []
    recorders: list[Recorder] = []
    with ExitStack() as stack:
        for k, part in enumerate(parts):
            config = CompanionConfig(seed=seed + k, fleet_number=k + 1 if share else 0)
            companion = Companion(part.mission, config)
            vehicle, meter = build_vehicle(part.mission, seed + k, autopilot), FlightMeter(companion)
            own: list[Tap] = [meter, *taps(companion, meter)]
            if record is not None:
                record.mkdir(parents=True, exist_ok=True)
                file = record / f"{k + 1}.mcap"
                start = header(companion, part.data)
                start["attachments"].append(parameters_of(vehicle))
                recorder = stack.enter_context(Recorder(file, threaded=False, rotation=rotation, **start))
                own.append(RecordingTap(companion, recorder))
                recorders.append(recorder)
            pairs.append(Pair(companion, vehicle, LINK, InlinePlanning(part.mission.planner_world()), own))
            companions.append(companion)
            vehicles.append(vehicle)
            meters.append(meter)
        starts = np.array([part.mission.start_m() for part in parts])
        least, nearest = np.inf, (0, 0, 0.0)

        def look(now_us: int) -> None:
            nonlocal least, nearest
            aloft = [k for k, c in enumerate(companions) if c.phase in AIRBORNE]
            if len(aloft) < 2:
                return
            places = np.array([vehicles[k].truth.position_n for k in aloft]) + starts[aloft]
            apart = np.linalg.norm(places[:, None] - places[None], axis=2)
            apart[np.diag_indices(len(aloft))] = np.inf
            if apart.min() < least:
                least = float(apart.min())
                a, b = np.unravel_index(int(apart.argmin()), apart.shape)
                nearest = (aloft[int(a)] + 1, aloft[int(b)] + 1, now_us / 1e6)

        lost = np.random.default_rng(seed)
        carried = lambda now_us, sender, hearer: loss == 0.0 or lost.random() >= loss  # noqa: E731
        end_us = fly_lockstep_many(pairs, limit_s=limit_s, look=look, stop=stop, carried=carried)
        for companion in companions:
            if not companion.over and not stop():
                companion.failure = companion.failure or f"not over after {limit_s:g} s of simulated time"
        for recorder, companion, meter in zip(recorders, companions, meters, strict=False):
            conclude(recorder, companion, meter)
    return ManyResult(
        verdicts=tuple(judge(c, m) for c, m in zip(companions, meters, strict=True)),
        separation_m=least,
        nearest=nearest,
        stops=sum(getattr(c.replanning, "stops", 0) for c in companions),
        simulated_s=end_us / 1e6,
    )
