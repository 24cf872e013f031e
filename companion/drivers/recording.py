"""The seam in recordings: our inputs and outputs as `logs.schema` records, and back.

`RecordingTap` writes every tick; `recorded_ticks` reads them again for a re-run. What was received is stamped with its
arrival, what left with the moment it had left; both carry the tick's number (docs/decisions/0008).
"""

import json
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import asdict
from typing import Any
from zlib import crc32

import numpy as np

from companion.core import Companion
from companion.drivers.mirroring import Mirroring
from companion.drivers.provenance import RUN, run_table
from companion.drivers.tick import Tick
from companion.drivers.worldfiles import world_attachments
from companion.recordedsettings import CONFIG_KEY
from companion.recordedsettings import CONFIG_METADATA as CONFIG_METADATA
from companion.recordedsettings import MISSION_ATTACHMENT as MISSION_ATTACHMENT
from companion.seam import (
    Flown,
    Input,
    Note,
    Order,
    Output,
    PlanReady,
    PlanWanted,
    Reference,
    ReplanReady,
    ReplanWanted,
)
from logs import schema
from logs.compare import Output as Compared
from logs.compare import OutputHash
from logs.container import Attachment, Direction
from logs.recorder import Recorder, RecorderCounters
from logs.table import Entry, inputs_digest
from planner import Trajectory
from wire.datagram import Datagram
from wire.udp import UdpLink


def to_record(item: Input | Output, phase: str) -> schema.Record:
    """One input or output, other than a datagram, as the record that keeps it."""
    match item:
        case PlanWanted():
            limits = item.limits
            return schema.PlanWanted(
                request_id=item.request_id,
                start=tuple(item.start_m),
                goal=tuple(item.goal_m),
                speed=limits.speed,
                acceleration=limits.acceleration,
                jerk=limits.jerk,
                radius=item.radius,
                seed=item.seed,
                method=item.method,
                via=tuple(x for point in item.via_m for x in point),
            )
        case PlanReady():
            trajectory = item.trajectory
            return schema.PlanReady(
                request_id=item.request_id,
                ok=trajectory is not None,
                error=item.error,
                text=item.text,
                control_points=() if trajectory is None else tuple(trajectory.control_points.ravel().tolist()),
                knots=() if trajectory is None else tuple(trajectory.knots.tolist()),
                length=item.length,
                clearance=item.clearance,
                certified=item.certified,
                cpu_ms=item.cpu_ms,
                method=item.method,
            )
        case ReplanWanted():
            return _replan_wanted(item)
        case ReplanReady():
            points, knots, start_us = _flat(item.flown)
            backup_points, backup_knots, backup_start_us = _flat(item.backup)
            return schema.ReplanReady(
                request_id=item.request_id,
                kind=item.kind,
                control_points=points,
                knots=knots,
                start_us=start_us,
                to_goal=item.flown is not None and item.flown.to_goal,
                certified=item.certified,
                clearance=item.clearance,
                backup_control_points=backup_points,
                backup_knots=backup_knots,
                backup_start_us=backup_start_us,
                reason=item.reason,
                cpu_ms=item.cpu_ms,
            )
        case Order():
            return schema.OperatorCommand(name=item.name, values=item.values, source=item.source)
        case Note():
            return schema.Note(level=item.level.value, phase=phase, text=item.text)
        case Reference():
            return schema.Reference(
                phase=phase,
                position=tuple(item.position_m.tolist()),
                velocity=tuple(item.velocity_m.tolist()),
                acceleration=tuple(item.acceleration_m.tolist()),
                yaw=item.yaw,
            )
        case Datagram():
            raise TypeError("a datagram is recorded as bytes, not as a record")


def to_input(record: schema.Record) -> Input | None:
    """The input that a record kept; None for a record of an output or a tick."""
    match record:
        case schema.PlanReady():
            trajectory = _trajectory(record.control_points, record.knots) if record.ok else None
            return PlanReady(
                request_id=record.request_id,
                trajectory=trajectory,
                error=record.error,
                text=record.text,
                length=record.length,
                clearance=record.clearance,
                certified=record.certified,
                cpu_ms=record.cpu_ms,
                method=record.method,
            )
        case schema.ReplanReady():
            return ReplanReady(
                request_id=record.request_id,
                kind=record.kind,
                flown=_flown(record.control_points, record.knots, record.start_us, record.to_goal),
                certified=record.certified,
                clearance=record.clearance,
                backup=_flown(record.backup_control_points, record.backup_knots, record.backup_start_us, False),
                reason=record.reason,
                cpu_ms=record.cpu_ms,
            )
        case schema.OperatorCommand():
            return Order(record.name, record.values, record.source)
    return None


def _replan_wanted(item: ReplanWanted) -> schema.ReplanWanted:
    points, knots, start_us = _flat(item.flown)
    limits, seen = item.limits, item.map
    return schema.ReplanWanted(
        request_id=item.request_id,
        now_us=item.now_us,
        switch_us=item.switch_us,
        period_us=item.period_us,
        goal=tuple(item.goal_m),
        speed=limits.speed,
        acceleration=limits.acceleration,
        jerk=limits.jerk,
        radius=item.radius,
        seed=item.seed,
        control_points=points,
        knots=knots,
        start_us=start_us,
        to_goal=item.flown.to_goal,
        fresh=item.fresh,
        map_version=-1 if seen is None else seen.version,
        map_crc32=0 if seen is None else crc32(np.ascontiguousarray(seen.runs).tobytes()),
        map_runs=0 if seen is None else len(seen.runs),
        movers=tuple(
            number for m in item.movers for number in (*m.centre, *m.velocity, m.radius, m.growth, m.stamp, m.until)
        ),
        cold=item.cold,
    )


def _flat(flown: Flown | None) -> tuple[tuple[float, ...], tuple[float, ...], int]:
    """Control points, knots and start as records keep them; empty for nothing."""
    if flown is None:
        return (), (), 0
    trajectory = flown.trajectory
    return tuple(trajectory.control_points.ravel().tolist()), tuple(trajectory.knots.tolist()), flown.start_us


def _flown(points: tuple[float, ...], knots: tuple[float, ...], start_us: int, to_goal: bool) -> Flown | None:
    return Flown(_trajectory(points, knots), start_us, to_goal) if knots else None


def _trajectory(points: tuple[float, ...], knots: tuple[float, ...]) -> Trajectory:
    return Trajectory(np.array(points, dtype=np.float64).reshape(-1, 3), np.array(knots, dtype=np.float64))


def header(companion: Companion, mission_file: bytes, **more: Mapping[str, str]) -> dict[str, Any]:
    """What a recording begins with, as keyword arguments of `Recorder`: the mission and what else a re-run needs."""
    config = {CONFIG_KEY: json.dumps(asdict(companion.config), sort_keys=True)}
    clock = more.get("clock", {}).get("epoch", "lockstep")
    run = run_table(companion, clock, dict(more.get("endpoints", {})))
    return {
        "metadata": {CONFIG_METADATA: config, RUN: run, **more},
        "attachments": [
            Attachment(MISSION_ATTACHMENT, "application/yaml", mission_file),
            *world_attachments(companion.mission),
        ],
    }


def unix_clock() -> dict[str, str]:
    """Table `clock` of a flight in real time: Unix time, and how far ahead of the monotonic clock it is [ns]."""
    return {"epoch": "unix", "ahead_of_monotonic_ns": str(time.time_ns() - time.monotonic_ns())}


def total(counters: RecorderCounters) -> int:
    """Messages in the file, of every kind."""
    return sum(counters.rx.values()) + sum(counters.tx.values()) + counters.decoded + counters.messages


def socket_losses(links: Mapping[str, UdpLink]) -> Callable[[], dict[str, int]]:
    """What is lost at the sockets, for `Recorder`: by the kernel on the way in, and what it would not send."""

    def losses() -> dict[str, int]:
        values: dict[str, int] = {}
        for name, link in links.items():
            counters = link.counters
            values |= {f"{name}.kernel_drops": counters.drops, f"{name}.send_errors": counters.send_errors}
        return values

    return losses


class RecordingTap:
    """Writes every tick to a recorder, if there is one: inputs, the tick itself, outputs, and what viewers are shown.

    Parameters
    ----------
    tell : takes what a person should know of the recording: that the disk fills up, is full, has room again.

    Attributes
    ----------
    outputs : hash of all outputs so far.
    """

    def __init__(
        self, companion: Companion, recorder: Recorder | None, tell: Callable[[str], None] = lambda text: None
    ) -> None:
        self._companion, self._recorder, self._tell = companion, recorder, tell
        self._mirroring = None if recorder is None else Mirroring(companion)
        self.outputs = OutputHash()

    def __call__(self, tick: Tick) -> None:
        phase = self._companion.phase.value
        outputs = entries(tick.outputs, phase)
        for output in compared(tick.index, outputs):
            self.outputs.add(output)
        if self._recorder is None:
            return
        inputs = entries((item for _, item in tick.inputs), phase)
        for (received_us, _), entry in zip(tick.inputs, inputs, strict=True):
            _write(self._recorder, tick, "rx", received_us, entry)
        for entry in (tick_record(tick, inputs), *outputs):
            _write(self._recorder, tick, "tx", tick.sent_us, entry)
        if self._mirroring is not None:
            self._mirror(self._recorder, self._mirroring, tick)
        for notice in self._recorder.notices():
            self._tell(notice)

    def _mirror(self, recorder: Recorder, mirroring: Mirroring, tick: Tick) -> None:
        """What viewers are shown; a fault in it costs the rest of it, not the recording."""
        try:
            for shown in mirroring(tick):
                at: dict[str, int] = {"log_time_ns": tick.sent_us * 1000, "now_us": tick.now_us, "tick": tick.index}
                if isinstance(shown, schema.Tracking):
                    recorder.message(schema.TOPICS[schema.Tracking], shown, **at)
                else:
                    recorder.mirror(shown, **at)
        except Exception as error:
            self._mirroring = None
            self._tell(f"viewers are shown no more of this flight: {type(error).__name__}: {error}")


def _write(recorder: Recorder, tick: Tick, direction: Direction, stamp_us: int, entry: Entry) -> None:
    at: dict[str, int] = {"log_time_ns": stamp_us * 1000, "now_us": tick.now_us, "tick": tick.index}
    if isinstance(entry, Datagram):
        recorder.datagram(entry.link, direction, entry.data, peer=entry.peer, **at)
    else:
        recorder.message(schema.TOPICS[type(entry)], entry, **at)


def entries(items: Iterable[Input | Output], phase: str) -> list[Entry]:
    """Inputs or outputs as a recording keeps them."""
    return [item if isinstance(item, Datagram) else to_record(item, phase) for item in items]


def tick_record(tick: Tick, inputs: Sequence[Entry]) -> schema.Tick:
    """The tick's own record; `inputs` as `entries` gives them."""
    return schema.Tick(tick.now_us, len(tick.inputs), len(tick.outputs), inputs_digest(inputs))


def compared(index: int, outputs: Sequence[Entry]) -> list[Compared]:
    """A tick's outputs as two runs are compared by: datagrams by their link, records by their schema's name."""
    return [
        Compared(index, entry.link, entry.data)
        if isinstance(entry, Datagram)
        else Compared(index, schema.schema_name(type(entry)), schema.encode(entry))
        for entry in outputs
    ]
