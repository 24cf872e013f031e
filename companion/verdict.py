"""How the flight went: measured from what crossed the seam, judged against the mission's `expect`.

`FlightMeter` is a tap: it looks at every tick and keeps references, the vehicle's own position and, where the vehicle
is a simulator that tells it, the truth (HIL_STATE_QUATERNION). `Verdict` is the table at the end.

Tracking error is |position - reference| at the time of each position sample, the reference interpolated between ticks.
It begins with FLYING, after the takeoff, which some vehicles fly by themselves. It is taken in the mission frame: the
estimate less the local origin that the companion fixed on the ground, and the truth relative to where it stood at that
moment. So what the estimator drifts from then on counts against the flight.
"""

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from companion.core import Companion
from companion.drivers.tick import Tick
from companion.fields import local_position_ned, truth_position
from companion.geodesy import local_ned
from companion.mission import Mission
from companion.phases import Phase
from companion.seam import FloatArray, Reference
from companion.vehiclelink import VEHICLE_LINK
from wire.datagram import Datagram
from wire.dialect import mavlink
from wire.framing import Framer

TRUTH = mavlink.MAVLINK_MSG_ID_HIL_STATE_QUATERNION
ESTIMATE = mavlink.MAVLINK_MSG_ID_LOCAL_POSITION_NED
SETPOINT = mavlink.MAVLINK_MSG_ID_SET_POSITION_TARGET_LOCAL_NED


TRUTH_ID, ESTIMATE_ID = (i.to_bytes(3, "little") for i in (TRUTH, ESTIMATE))


@dataclass(frozen=True, slots=True)
class ErrorStatistics:
    """Of |position - reference| [m]."""

    p50: float
    p95: float
    maximum: float


@dataclass(frozen=True, slots=True)
class Track:
    """What the verdict is made from, in the mission frame."""

    position_m: FloatArray  # (k, 3) truth where there is one, else the estimate
    error: FloatArray  # (k,) [m]
    aloft_m: FloatArray  # (j, 3) the same with the landing, until the vehicle disarmed


class FlightMeter:
    """A tap that keeps what a verdict needs, and the numbers a progress line shows."""

    def __init__(self, companion: Companion) -> None:
        self._companion = companion
        self._framer = Framer()
        self._references: list[tuple[float, ...]] = []  # now_us, x, y, z
        self._estimates: list[tuple[float, ...]] = []  # received_us, x, y, z in n
        self._truths: list[tuple[float, ...]] = []  # received_us, lat_e7, lon_e7, alt_mm
        self._setpoints_us: list[int] = []
        self._phase: Phase | None = None
        self._stands_us: int | None = None  # when the local origin was fixed
        self._first_us: int | None = None
        self._last_us = 0
        self.airborne_us: list[int] = []  # [first, last] tick of Phase.FLYING
        self._aloft_from_us: int | None = None  # the takeoff and the landing belong to the clearance,
        self._aloft_until_us = 0  # not to the tracking error

    def __call__(self, tick: Tick) -> None:
        self._first_us = tick.now_us if self._first_us is None else self._first_us
        self._last_us = tick.now_us
        for received_us, item in tick.inputs:
            if isinstance(item, Datagram) and item.link == VEHICLE_LINK:
                self._hear(received_us, item)
        phase = self._companion.phase
        if phase is Phase.PLANNING and self._phase is not Phase.PLANNING:
            self._stands_us = tick.now_us
        self._phase = phase
        if phase in (Phase.TAKING_OFF, Phase.FLYING) and self._aloft_from_us is None:
            self._aloft_from_us = tick.now_us
        if phase is Phase.FLYING:
            self.airborne_us = [self.airborne_us[0] if self.airborne_us else tick.now_us, tick.now_us]
        if self._aloft_from_us is not None and self._companion.telemetry.armed:
            self._aloft_until_us = tick.now_us
        for output in tick.outputs:
            if isinstance(output, Reference):
                self._references.append((tick.now_us, *output.position_m))
                self._setpoints_us.append(tick.sent_us)

    def _hear(self, received_us: int, item: Datagram) -> None:
        if _is_one_packet(item.data) and item.data[7:10] not in (TRUTH_ID, ESTIMATE_ID):
            return  # nine datagrams in ten, at a tenth of the price of framing them
        for packet in self._framer.packets(item.data):
            if not self._companion.link.is_vehicle(packet, item.peer):
                continue
            if packet.message_id == ESTIMATE:
                position = local_position_ned(packet.payload)[:3]
                if all(map(math.isfinite, position)):
                    self._estimates.append((received_us, *position))
            elif packet.message_id == TRUTH:
                self._truths.append((received_us, *truth_position(packet.payload)))

    @property
    def tracking_error_now(self) -> float:
        """Distance [m] of the newest estimate from the newest reference; NaN before both are there."""
        if not self._references or not self._estimates:
            return float("nan")
        there = np.array(self._estimates[-1][1:]) - self._companion.origin_n
        return float(np.linalg.norm(there - self._references[-1][1:]))

    @property
    def setpoint_rate_now(self) -> float:
        """Over the last second [Hz]."""
        recent = self._setpoints_us[-51:]
        return (len(recent) - 1) * 1e6 / (recent[-1] - recent[0]) if len(recent) > 1 and recent[-1] > recent[0] else 0.0

    @property
    def duration_s(self) -> float:
        return 0.0 if self._first_us is None else (self._last_us - self._first_us) / 1e6

    def estimate_track(self) -> Track | None:
        """The flight as the vehicle's estimator saw it; None when it never flew."""
        return self._track(self._estimates, lambda rows: rows[:, 1:] - self._companion.origin_n)

    def truth_track(self) -> Track | None:
        """The flight as it was; None when the vehicle does not tell, or never flew."""
        start = self._companion.itinerary.start_m

        def to_mission_frame(rows: FloatArray) -> FloatArray:
            ned = local_ned(rows[:, 1], rows[:, 2], rows[:, 3])
            assert self._stands_us is not None
            standing = ned[rows[:, 0] <= self._stands_us]
            moved: FloatArray = ned - (standing[-1] if len(standing) else ned[0]) + start
            return moved

        return self._track(self._truths, to_mission_frame)

    def _track(self, samples: list[tuple[float, ...]], to_mission_frame: Any) -> Track | None:
        if not samples or not self.airborne_us or len(self._references) < 2:
            return None
        rows, references = np.array(samples), np.array(self._references)
        position = to_mission_frame(rows)
        first, last = self.airborne_us
        flown = (rows[:, 0] >= first) & (rows[:, 0] <= last)
        aloft = position[(rows[:, 0] >= (self._aloft_from_us or 0)) & (rows[:, 0] <= self._aloft_until_us)]
        if not flown.any():
            return None
        at, position = rows[flown, 0], position[flown]
        wanted = np.column_stack([np.interp(at, references[:, 0], references[:, k]) for k in (1, 2, 3)])
        return Track(
            position_m=position,
            error=np.linalg.norm(position - wanted, axis=1),
            aloft_m=aloft,
        )

    def setpoint_gaps_ms(self) -> FloatArray:
        """(n - 1,) spacing of the setpoints as they left [ms]."""
        return np.diff(np.array(self._setpoints_us, dtype=np.float64)) / 1e3


@dataclass(frozen=True, slots=True)
class Verdict:
    """The flight in numbers, and whether that is what the mission expects. None: not known."""

    ok: bool
    mission: str
    seed: int
    phase: str
    failure: str
    failed_expectations: list[str]
    duration_s: float
    path_length_m: float | None
    tracking_error_p50_m: float | None
    tracking_error_p95_m: float | None
    tracking_error_max_m: float | None
    tracking_error_source: str | None  # "truth" or "estimate"
    estimate_error_p50_m: float | None
    estimate_error_p95_m: float | None
    estimate_error_max_m: float | None
    min_clearance_m: float | None
    setpoint_rate_hz: float | None
    setpoint_gap_p99_ms: float | None
    setpoint_gap_max_ms: float | None
    track: Track | None = field(repr=False)


def judge(companion: Companion, meter: FlightMeter, beside_m: float | None = None) -> Verdict:
    """Measure a flight and hold it against `mission.expect`.

    Parameters
    ----------
    beside_m : least clearance to what appears and moves, from somebody who sees it [m]; None: nobody does.
    """
    mission = companion.mission
    truth, estimate = meter.truth_track(), meter.estimate_track()
    track = truth if truth is not None else estimate
    flown, believed = _statistics(track), _statistics(estimate)
    gaps = meter.setpoint_gaps_ms()
    beside = least_clearance(mission, track.aloft_m) if track else None
    numbers: dict[str, float | None] = {
        "tracking_error_p95_m": flown.p95 if flown else None,
        "min_clearance_m": min((m for m in (beside, beside_m) if m is not None), default=None),
        "duration_max_s": meter.duration_s,
        "setpoint_gap_p99_ms": float(np.percentile(gaps, 99)) if len(gaps) else None,
        "setpoint_gap_max_ms": float(gaps.max()) if len(gaps) else None,
    }
    wanted = mission.expect.phase
    failed = failed_expectations(mission, numbers)
    if numbers["min_clearance_m"] is not None and numbers["min_clearance_m"] < 0.0:
        failed.append(f"the hull was {-numbers['min_clearance_m']:.3f} m inside an obstacle")
    if companion.phase.value != wanted and wanted != Phase.DONE.value:
        failed.insert(0, f"phase: found {companion.phase.value}, expected {wanted}")
    return Verdict(
        ok=companion.phase.value == wanted and not failed and not (companion.failure and wanted == Phase.DONE.value),
        mission=mission.name,
        seed=companion.config.seed,
        phase=companion.phase.value,
        failure=companion.failure,
        failed_expectations=failed,
        duration_s=meter.duration_s,
        path_length_m=_length(track.position_m) if track else None,
        tracking_error_p50_m=flown.p50 if flown else None,
        tracking_error_p95_m=flown.p95 if flown else None,
        tracking_error_max_m=flown.maximum if flown else None,
        tracking_error_source=None if track is None else "truth" if truth is not None else "estimate",
        estimate_error_p50_m=believed.p50 if believed else None,
        estimate_error_p95_m=believed.p95 if believed else None,
        estimate_error_max_m=believed.maximum if believed else None,
        min_clearance_m=numbers["min_clearance_m"],
        setpoint_rate_hz=float(1e3 / gaps.mean()) if len(gaps) else None,
        setpoint_gap_p99_ms=numbers["setpoint_gap_p99_ms"],
        setpoint_gap_max_ms=numbers["setpoint_gap_max_ms"],
        track=track,
    )


def failed_expectations(mission: Mission, numbers: dict[str, float | None]) -> list[str]:
    """One line for each expectation that is not met: name, found, expected."""
    failed = []
    for name, bound in mission.expect.model_dump(exclude_none=True, exclude={"phase"}).items():
        value = numbers[name]
        at_least = name == "min_clearance_m"
        sign = "at least" if at_least else "at most"
        if value is None:
            failed.append(f"{name}: not measured, expected {sign} {bound:g}")
        elif value < bound if at_least else value > bound:
            failed.append(f"{name}: found {value:.3f}, expected {sign} {bound:g}")
    return failed


def least_clearance(mission: Mission, position_m: FloatArray) -> float | None:
    """Least distance [m] between the vehicle's hull (a ball) and an obstacle; None in an empty world."""
    world = mission.whole_world()
    if not world.obstacles:
        return None
    return float(np.min(world.distance(position_m))) - mission.vehicle.radius


def _is_one_packet(data: bytes) -> bool:
    """Whether a datagram looks like one unsigned MAVLink 2 packet and nothing else."""
    return len(data) >= 12 and data[0] == 0xFD and len(data) == data[1] + 12


def _statistics(track: Track | None) -> ErrorStatistics | None:
    if track is None:
        return None
    p50, p95 = np.percentile(track.error, [50, 95])
    return ErrorStatistics(float(p50), float(p95), float(track.error.max()))


def _length(position_m: FloatArray) -> float:
    """Length [m] of the path through the samples, thinned to a step of 0.1 m so that noise does not add to it."""
    total, here = 0.0, position_m[0]
    for there in position_m[1:]:
        step = float(np.linalg.norm(there - here))
        if step >= 0.1:
            total, here = total + step, there
    return total + float(np.linalg.norm(position_m[-1] - here))
