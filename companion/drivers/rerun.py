"""A recording again: its inputs into a fresh core, tick by tick, and every output held against the recorded one."""

import json
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

from companion.core import Companion, CompanionConfig
from companion.drivers.changes import Changes, changed_config, changed_mission
from companion.drivers.recording import CONFIG_METADATA, MISSION_ATTACHMENT, compared, entries, tick_record, to_input
from companion.drivers.tick import Tick
from companion.drivers.worldfiles import recorded_mission
from companion.errors import MissionError, RerunError
from logs.compare import Comparison, Output, compare
from logs.errors import RecordingError
from logs.filter import SEAM
from logs.parts import PART
from logs.reader import FILTER, Recording
from logs.table import RecordedTick, ticks
from wire.datagram import Datagram

NOTHING: Changes = {}


@dataclass(frozen=True, slots=True)
class Rerun:
    """The outcome: the companion as it ended, how far it got, and how the outputs compare."""

    companion: Companion
    ticks: int
    simulated_s: float
    comparison: Comparison


def fresh_companion(recording: Recording, changes: Changes = NOTHING) -> Companion:
    """A companion set up as the recorded one was, but for `changes`.

    Raises
    ------
    RerunError : the recording has no mission or no configuration, or one that this version does not understand; or a
        change that it has no place for.
    MissionError : the changed mission is none.
    """
    attachment = recording.attachments.get(MISSION_ATTACHMENT)
    stored = recording.metadata.get(CONFIG_METADATA, {}).get("config")
    if attachment is None or stored is None:
        raise RerunError(f"{recording.path}: holds no mission and configuration: not a recording of a companion")
    try:
        values: dict[str, Any] = json.loads(stored)
        values = {key: tuple(value) if isinstance(value, list) else value for key, value in values.items()}
        config = CompanionConfig(**values)
    except (ValueError, TypeError) as error:
        raise RerunError(f"{recording.path}: its configuration is not one of this version: {error}") from error
    file = f"{recording.path}: {MISSION_ATTACHMENT}{' as changed' if changes else ''}"
    data = changed_mission(attachment.data, changes, file)
    try:
        mission = recorded_mission(recording, data, file)
    except MissionError as error:
        if data == attachment.data:
            raise
        # The numbers of lines are those of a text that nobody has seen.
        raise MissionError(file, [re.sub(r"^line \d+: ", "", problem) for problem in error.problems]) from error
    return Companion(mission, changed_config(config, changes) if changes else config)


def rerun(
    recording: Recording, progress: Callable[[Tick], None] = lambda tick: None, changes: Changes = NOTHING
) -> Rerun:
    """Feed the recorded inputs to a fresh companion and compare.

    Nothing is planned again: plans are inputs, and those that were recorded are flown, whatever `changes` say.

    Raises
    ------
    RerunError : not a recording of a companion; or a change that it has no place for.
    MissionError : the changed mission is none.
    RecordingError : ticks are missing or incomplete in the middle of the file.
    """
    companion = fresh_companion(recording, changes)
    recorded: list[Output] = []
    produced: list[Output] = []
    count, first_us, last_us = 0, 0, 0
    for row in _ticks(recording):
        tick = ticked(companion, row)
        inputs, outputs = tick.inputs, tick.outputs
        assert row.declared is not None  # `ticks` yields no row without it
        recorded.extend(compared(row.index, [row.declared, *(entry for _, entry in row.outputs)]))
        phase = companion.phase.value
        record = tick_record(tick, entries((item for _, item in inputs), phase))
        produced.extend(compared(row.index, [record, *entries(outputs, phase)]))
        progress(tick)
        first_us = row.now_us if count == 0 else first_us
        last_us, count = row.now_us, count + 1
    if not count:
        raise RerunError(f"{recording.path}: holds no whole tick, nothing to run again")
    return Rerun(companion, count, (last_us - first_us) / 1e6, compare(recorded, produced))


def _ticks(recording: Recording) -> Iterator[RecordedTick]:
    """The recorded ticks; of a part, or a filtered recording that lacks some, it is told what would do."""
    part = recording.metadata.get(PART, {})
    if len(recording.paths) == 1 and part.get("number", "1") != "1":
        raise RerunError(f"{recording.path}: is part {part['number']}; a re-run begins with {part.get('of')}")
    try:
        yield from ticks(recording)
    except RecordingError as error:
        if FILTER not in recording.metadata:
            raise
        kept = " ".join(f"--topic '{topic}'" for topic in SEAM)
        told = f"filtered from {recording.metadata[FILTER].get('of')} without what a re-run needs ({error.reason})"
        raise RerunError(f"{recording.path}: {told}; filter with {kept} and no --start") from error


def ticked(companion: Companion, row: RecordedTick) -> Tick:
    """Give a companion the inputs of one recorded tick."""
    inputs = [(stamp // 1000, item) for stamp, item in ((s, _input(entry)) for s, entry in row.inputs) if item]
    outputs = companion.step(row.now_us, [item for _, item in inputs])
    return Tick(row.index, row.now_us, inputs, outputs, row.now_us)


def _input(entry: Any) -> Any:
    return entry if isinstance(entry, Datagram) else to_input(entry)
