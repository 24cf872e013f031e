"""A sweep becomes runs: every combination of its axes, or a sample of them.

Drawn seeds are children of one `numpy.random.SeedSequence`, one stream for each purpose: the same file gives the same
runs, and a longer list of drawn seeds begins with the shorter one. Seeds that are written out are taken as they are.
"""

import hashlib
import math
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import yaml

from campaigns.runs import Run, Squall, digest_of
from campaigns.sweepfile import EXPECTED, MISSION, MOST_RUNS, Gains, SweepFile, Wind, read_sweep
from companion.cli.worlds import mission_text
from companion.errors import ConfigError, MissionError
from companion.fleet.missions import has_vehicles, split
from companion.mission import Mission
from companion.missionfile import MAX_FILE_BYTES, parse_mission, read_mission_file
from companion.planfiles import is_plan_file
from companion.yamlfile import line_of, read_yaml
from fakevehicle.airframe import load_airframe
from fakevehicle.config import Autopilot
from fakevehicle.control.gains import PRESETS
from fakevehicle.errors import VehicleError
from fakevehicle.overrides import parameters_of
from planner.families import make

FLIGHTS, WORLDS, SAMPLE, RECORDED = range(4)
"""The streams of drawn numbers: flights' seeds, worlds' seeds, which combinations, which recordings."""
FOR_ONE = ("winds", "faults", "links", "airframes", "gains")
"""Axes that missions of several vehicles cannot have."""


@dataclass(frozen=True, slots=True)
class Sweep:
    """A sweep, resolved.

    Attributes
    ----------
    file : its path, as given.  data : its bytes.
    name, timeout_s : as the file says.
    combinations : of all axes; `runs` are all of them, or the sample.
    runs : in the file's order, the last axis fastest.
    sampled : ids of those whose recordings are kept whatever comes of them.
    failures : how many recordings of failed flights are kept.
    """

    file: str
    data: bytes
    name: str
    timeout_s: float
    combinations: int
    runs: tuple[Run, ...]
    sampled: frozenset[str]
    failures: int

    @property
    def digest(self) -> str:
        """Of what is flown: the same runs, and the same recordings kept."""
        told = [*(run.run_id for run in self.runs), *sorted(self.sampled), str(self.failures)]
        return hashlib.sha256("\n".join(told).encode()).hexdigest()


@dataclass(frozen=True, slots=True)
class Scene:
    """A mission as it is planned: `Run`s are made of it by replacing the rest."""

    run: Run
    several: bool


def load_sweep(path: Path) -> Sweep:
    """Read a sweep, and everything that it names.

    Raises
    ------
    ConfigError : it, or what it names, cannot be read or cannot be; every problem has its own line.
    """
    asked, node, data = read_sweep(path)
    return _Resolving(path, asked, node).sweep(data)


class _Resolving:
    """Looks at everything the file names, once."""

    def __init__(self, path: Path, asked: SweepFile, node: yaml.MappingNode) -> None:
        self._path, self._asked, self._node = path, asked, node
        self._problems: list[str] = []

    def sweep(self, data: bytes) -> Sweep:
        asked = self._asked
        scenes = [*self._missions(), *self._worlds()]
        airframes = [self._airframe(k, name) for k, name in enumerate(asked.airframes)]
        gains = [self._parameters(k, gains) for k, gains in enumerate(asked.gains)]
        if any(scene.several for scene in scenes):
            for name in FOR_ONE:
                if name in asked.model_fields_set:
                    self._flaw([name], "found with a mission of several vehicles, expected with one vehicle only")
        if self._problems:
            raise ConfigError(str(self._path), self._problems)
        loads = (asked.links, asked.faults, asked.winds)
        axes: tuple[Sequence[Any], ...] = (scenes, asked.autopilots, airframes, gains, *loads, self._seeds())
        total = math.prod(len(axis) for axis in axes)
        chosen = self._chosen(total)
        runs = tuple(_run(asked, *(axis[k] for axis, k in zip(axes, _places(n, axes), strict=True))) for n in chosen)
        return Sweep(
            file=str(self._path),
            data=data,
            name=asked.name,
            timeout_s=asked.timeout_s,
            combinations=total,
            runs=runs,
            sampled=self._sampled(runs),
            failures=asked.recordings.failures,
        )

    def _flaw(self, keys: list[Any], text: str) -> None:
        self._problems.append(f"line {line_of(self._node, keys)}: {'.'.join(map(str, keys))}: {text}")

    def _seeds(self) -> list[int]:
        seeds = self._asked.seeds
        return seeds if isinstance(seeds, list) else drawn_seeds(self._asked.seed, FLIGHTS, seeds)

    def _chosen(self, total: int) -> Sequence[int]:
        """Which combinations are flown."""
        sample = self._asked.sample
        if sample is None or sample >= total:
            if total > MOST_RUNS:
                text = f"line 1: sweep: found {total} combinations, expected at most {MOST_RUNS}, or sample"
                raise ConfigError(str(self._path), [text])
            return range(total)
        if total > 2**62:
            raise ConfigError(str(self._path), [f"line 1: sweep: found {total} combinations, expected fewer than 2^62"])
        rng = np.random.default_rng([self._asked.seed, SAMPLE])
        return sorted(int(n) for n in rng.choice(total, sample, replace=False, shuffle=False))

    def _sampled(self, runs: Sequence[Run]) -> frozenset[str]:
        ids = [run.run_id for run in runs]
        if len(set(ids)) < len(ids):
            twice = runs[ids.index(Counter(ids).most_common(1)[0][0])]
            text = f"line 1: sweep: two runs are the same flight: {twice.mission}, seed {twice.seed}, {twice.autopilot}"
            raise ConfigError(str(self._path), [f"{text}; expected values that differ"])
        rng = np.random.default_rng([self._asked.seed, RECORDED])
        count = min(self._asked.recordings.sample, len(ids))
        return frozenset(ids[int(k)] for k in rng.choice(len(ids), count, replace=False))

    # ---- what is flown ------------------------------------------------------------------------------------------

    def _missions(self) -> Iterator[Scene]:
        for k, name in enumerate(self._asked.missions):
            file = (self._path.parent / name).resolve()
            try:
                data = read_mission_file(file)
                for method in self._asked.methods:
                    yield _scene(_with_method(data, method, str(file)), str(file))
            except MissionError as error:
                self._flaw(["missions", k], f"{error.file}: {error.problems[0]}")

    def _worlds(self) -> Iterator[Scene]:
        for k, worlds in enumerate(self._asked.worlds):
            seeds = worlds.seeds
            if not isinstance(seeds, list):
                seeds = drawn_seeds(self._asked.seed, WORLDS, seeds)
            for seed in seeds:
                file = f"{worlds.family}-{seed}.yaml"
                data = mission_text(worlds.family, seed, make(worlds.family, seed)).encode()
                try:
                    for method in self._asked.methods:
                        scene = _scene(_with_method(data, method, file), file)
                        yield replace(scene, run=replace(scene.run, family=worlds.family, world_seed=seed))
                except MissionError as error:
                    self._flaw(["worlds", k], f"{error.file}: {error.problems[0]}")

    def _airframe(self, k: int, name: str) -> tuple[str, str]:
        """As the vehicle takes it, and the digest of its file where it is one."""
        is_file = Path(name).suffix in (".yaml", ".yml")
        path = str((self._path.parent / name).resolve()) if is_file else name
        try:
            load_airframe(path)
            return path, digest_of(Path(path)) if is_file else ""
        except (VehicleError, OSError) as error:
            self._flaw(["airframes", k], str(error))
            return name, ""

    def _parameters(self, k: int, gains: Gains) -> tuple[str, dict[Autopilot, tuple[tuple[str, float], ...]]]:
        """What they are called, and the vehicle's parameters by autopilot."""
        found: dict[Autopilot, tuple[tuple[str, float], ...]] = {}
        files = [] if gains.file is None else [self._path.parent / gains.file]
        texts = [f"{name}={value!r}" for name, value in gains.set.items()]
        for autopilot in self._asked.autopilots:
            try:
                own, _ = parameters_of(files, texts, autopilot)
            except (VehicleError, ValueError) as error:
                self._flaw(["gains", k], f"{error} ({autopilot})")
                continue
            found[autopilot] = tuple(sorted({**PRESETS[gains.preset], **own}.items()))
        return gains.label, found


def drawn_seeds(seed: int, stream: int, count: int) -> list[int]:
    """(count,) seeds from 0 to 2^31 - 1, of independent children of one sequence."""
    children = np.random.SeedSequence([seed, stream]).spawn(count)
    return [int(child.generate_state(1)[0]) >> 1 for child in children]


def _places(n: int, axes: Sequence[Sequence[Any]]) -> list[int]:
    """The n-th combination: which value of each axis; the last axis counts fastest."""
    places = []
    for axis in reversed(axes):
        n, place = divmod(n, len(axis))
        places.append(place)
    return places[::-1]


def _run(
    asked: SweepFile,
    scene: Scene,
    autopilot: Autopilot,
    airframe: tuple[str, str],
    gains: tuple[str, dict[Autopilot, tuple[tuple[str, float], ...]]],
    link: Any,
    faults: list[str],
    wind: Wind,
    seed: int,
) -> Run:
    """One combination."""
    asked_wind = None if wind.of_mission else (wind.north, wind.east, wind.down)
    return replace(
        scene.run,
        seed=seed,
        autopilot=autopilot,
        blowing=scene.run.blowing if asked_wind is None else asked_wind,
        wind=asked_wind,
        squalls=tuple(Squall(g.at, g.rise, g.hold, (g.velocity[0], g.velocity[1], g.velocity[2])) for g in wind.gusts),
        faults=tuple(faults),
        link=link.faults(seed),
        airframe=airframe[0],
        airframe_sha=airframe[1],
        gains=gains[0],
        parameters=gains[1][autopilot],
        limit_s=asked.limit_s,
    )


def _scene(data: bytes, file: str) -> Scene:
    """A mission, checked.

    Raises
    ------
    MissionError : it is none.
    """
    several = has_vehicles(data)
    mission = split(data, file)[0].mission if several else parse_mission(data, file)
    wind = mission.wind
    run = Run(
        data=data,
        file=file,
        mission=mission.name,
        seed=0,
        maps=_maps(mission, Path(file).parent),
        method=mission.method,
        blowing=(wind.north, wind.east, wind.down),
    )
    return Scene(run, several)


def _with_method(data: bytes, method: str, file: str) -> bytes:
    """The mission, planned with another method.

    Raises
    ------
    MissionError : it is none, or none that has a method.
    """
    if method == MISSION:
        return data
    if is_plan_file(data, file):
        raise MissionError(file, ["found a ground station's plan, expected a mission file (YAML) where methods vary"])
    document, _ = read_yaml(data, file, MissionError, most_bytes=MAX_FILE_BYTES, expected=EXPECTED)
    return yaml.safe_dump({**document, "method": method}, sort_keys=False, allow_unicode=True).encode()


def _maps(mission: Mission, folder: Path) -> tuple[tuple[str, str], ...]:
    """Names and digests of the files of voxels and clouds that a mission names."""
    named = [o.voxels or o.cloud for o in mission.world.obstacles]
    return tuple((m.file, digest_of(folder / m.file)) for m in named if m is not None)
