"""`FlightMeter`, a tap: it keeps references, the vehicle's own position and, where a simulator tells it, the truth
(HIL_STATE_QUATERNION), for the verdict at the end.

Tracking error is |position - reference| at the time of each position sample, the reference interpolated between ticks.
It begins with FLYING, after the takeoff, which some vehicles fly by themselves. It is taken in the mission frame: the
estimate less the local origin that the companion fixed on the ground, and the truth relative to where it stood at that
moment. So what the estimator drifts from then on counts against the flight.

The last `MOST_ROWS` samples of each kind are kept, 12 minutes at 50 Hz: a flight that is no longer is measured exactly.
Of a longer one older samples are counted (`tally`): its percentiles are told to 1 mm and 0.1 ms, all else still
exactly. What was dropped after FLYING (somebody else flies, for hours) counts for the clearance only.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from companion.core import Companion
from companion.drivers.tick import Tick
from companion.fields import local_position_ned, truth_position
from companion.geodesy import local_ned
from companion.mission import Mission
from companion.phases import Phase
from companion.seam import FloatArray, Reference
from companion.tally import PathLength, Rows, Tally
from companion.vehiclelink import VEHICLE_LINK
from wire.datagram import Datagram
from wire.dialect import mavlink
from wire.framing import Framer

BoolArray = NDArray[np.bool_]
TRUTH = mavlink.MAVLINK_MSG_ID_HIL_STATE_QUATERNION
ESTIMATE = mavlink.MAVLINK_MSG_ID_LOCAL_POSITION_NED
TRUTH_ID, ESTIMATE_ID = (i.to_bytes(3, "little") for i in (TRUTH, ESTIMATE))
MOST_ROWS = 36_000
CHUNK = 1000
"""So many are counted at once: 20 s at 50 Hz, in less than a millisecond."""
ERROR_M, GAP_MS, CLASSES = 0.001, 0.1, 10_001
"""Widths of the classes, and how many there are: to 10 m and 1 s."""


@dataclass(slots=True)
class Counted:
    """What is known of samples that are not kept any more."""

    error: Tally = field(default_factory=lambda: Tally(ERROR_M, CLASSES))  # [m]
    path: PathLength = field(default_factory=PathLength)
    clearance_m: float = math.inf  # least, of the hull


@dataclass(frozen=True, slots=True)
class Track:
    """What the verdict is made from, in the mission frame."""

    position_m: FloatArray  # (k, 3) truth where there is one, else the estimate
    error: FloatArray  # (k,) [m]
    aloft_m: FloatArray  # (j, 3) the same with the landing, until the vehicle disarmed
    counted: Counted  # what came before these

    def percentiles(self, wanted: list[float]) -> list[float]:
        """Of the tracking error [m]."""
        return self.counted.error.percentiles(wanted, self.error)

    def greatest(self) -> float:
        """The greatest tracking error [m]."""
        return float(max(self.error.max(initial=0.0), self.counted.error.greatest))

    def length(self) -> float:
        """Of the path [m]."""
        path = self.counted.path
        if len(self.position_m):
            path = path.copy()
            path.add(self.position_m)
        return path.length()


class FlightMeter:
    """A tap that keeps what a verdict needs, and the numbers a progress line shows."""

    def __init__(self, companion: Companion) -> None:
        self._companion = companion
        self._framer = Framer()
        self._references = Rows(4)  # now_us, x, y, z
        self._estimates = Rows(4)  # received_us, x, y, z in n
        self._truths = Rows(4)  # received_us, lat_e7, lon_e7, alt_mm
        self._sent = Rows(1)  # when each setpoint left [us]
        self._of_estimates, self._of_truths = Counted(), Counted()
        self._gaps = Tally(GAP_MS, CLASSES)
        self._first_truth: FloatArray | None = None  # once the beginning is not kept any more: the first one,
        self._standing: FloatArray | None = None  # and the one of where it stood
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
            self._stands_us, self._standing = tick.now_us, None
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
                self._sent.append((tick.sent_us,))
        if max(len(self._references), len(self._estimates), len(self._truths)) > MOST_ROWS:
            self._count_oldest()

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
        if not len(self._references) or not len(self._estimates):
            return float("nan")
        there = self._estimates.last()[0, 1:] - self._companion.origin_n
        return float(np.linalg.norm(there - self._references.last()[0, 1:]))

    @property
    def setpoint_rate_now(self) -> float:
        """Over the last second [Hz]."""
        recent = self._sent.last(51)[:, 0]
        if len(recent) < 2 or recent[-1] <= recent[0]:
            return 0.0
        return float((len(recent) - 1) * 1e6 / (recent[-1] - recent[0]))

    @property
    def duration_s(self) -> float:
        return 0.0 if self._first_us is None else (self._last_us - self._first_us) / 1e6

    def estimate_track(self) -> Track | None:
        """The flight as the vehicle's estimator saw it; None when it never flew."""
        return self._track(self._estimates, self._of_estimates, self._estimate_to_mission)

    def truth_track(self) -> Track | None:
        """The flight as it was; None when the vehicle does not tell, or never flew."""
        return self._track(self._truths, self._of_truths, self._truth_to_mission)

    def aloft_path(self) -> FloatArray:
        """(n, 4) when [us] and where in the mission frame [m], by the truth if it is told; what is kept of it."""
        places = ((self._truths, self._truth_to_mission), (self._estimates, self._estimate_to_mission))
        for samples, to_mission_frame in places:
            if len(samples):
                rows = samples.all()
                path: FloatArray = np.column_stack([rows[:, 0], to_mission_frame(rows)])[self._aloft(rows)]
                return path
        return np.empty((0, 4))

    def setpoint_gaps_ms(self) -> FloatArray:
        """(n - 1,) spacing of the setpoints that are kept, as they left [ms]."""
        gaps: FloatArray = np.diff(self._sent.all()[:, 0]) / 1e3
        return gaps

    def setpoint_gap_ms(self) -> tuple[float, float, float] | None:
        """99th percentile, greatest and mean spacing of all setpoints [ms]; None where there are not two."""
        kept, counted = self.setpoint_gaps_ms(), self._gaps
        if not len(kept):
            return None
        greatest = max(float(kept.max()), counted.greatest)
        mean = (counted.total + float(kept.sum())) / (counted.count + len(kept)) if counted.count else kept.mean()
        return counted.percentiles([99.0], kept)[0], greatest, float(mean)

    def _estimate_to_mission(self, rows: FloatArray) -> FloatArray:
        moved: FloatArray = rows[:, 1:] - self._companion.origin_n
        return moved

    def _truth_to_mission(self, rows: FloatArray) -> FloatArray:
        first, standing = self._truth_anchors(rows)
        ned = local_ned(*np.concatenate([first, standing, rows])[:, 1:].T)
        moved: FloatArray = ned[2:] - ned[1] + self._companion.itinerary.start_m
        return moved

    def _truth_anchors(self, rows: FloatArray) -> tuple[FloatArray, FloatArray]:
        """(1, 4) the first truth of all, and that of where it stood when the origin was fixed."""
        first = rows[:1] if self._first_truth is None else self._first_truth
        if self._standing is not None:
            return first, self._standing
        before = rows[rows[:, 0] <= (self._stands_us or 0)]
        return first, before[-1:] if len(before) else first

    def _track(
        self, samples: Rows, counted: Counted, to_mission_frame: Callable[[FloatArray], FloatArray]
    ) -> Track | None:
        if not len(samples) or not self.airborne_us or (len(self._references) < 2 and not counted.error.count):
            return None
        rows = samples.all()
        position = to_mission_frame(rows)
        flown, aloft = self._flown(rows), position[self._aloft(rows)]
        if not flown.any() and not counted.error.count:
            return None
        position = position[flown]
        return Track(position, self._errors(rows[flown, 0], position), aloft, counted)

    def _flown(self, rows: FloatArray) -> BoolArray:
        """Which samples are of Phase.FLYING, or between two of them."""
        first, last = self.airborne_us
        flown: BoolArray = (rows[:, 0] >= first) & (rows[:, 0] <= last)
        return flown

    def _aloft(self, rows: FloatArray) -> BoolArray:
        aloft: BoolArray = (rows[:, 0] >= (self._aloft_from_us or 0)) & (rows[:, 0] <= self._aloft_until_us)
        return aloft

    def _errors(self, at_us: FloatArray, position_m: FloatArray) -> FloatArray:
        references = self._references.all()
        wanted = np.column_stack([np.interp(at_us, references[:, 0], references[:, k]) for k in (1, 2, 3)])
        errors: FloatArray = np.linalg.norm(position_m - wanted, axis=1)
        return errors

    def _count_oldest(self) -> None:
        """Count the oldest samples, and drop them."""
        longest = max((self._references, self._estimates, self._truths), key=len)
        until_us = float(longest.all()[CHUNK, 0])
        if self._stands_us is not None and self._standing is None and len(self._truths):
            self._first_truth, self._standing = self._truth_anchors(self._truths.all())
        elif self._first_truth is None and len(self._truths):
            self._first_truth = self._truths.all()[:1]
        frames = (
            (self._estimates, self._of_estimates, self._estimate_to_mission),
            (self._truths, self._of_truths, self._truth_to_mission),
        )
        for samples, counted, to_mission_frame in frames:
            rows = samples.take(int(np.searchsorted(samples.all()[:, 0], until_us)))
            if len(rows) and self._aloft_from_us is not None:
                self._count(rows, to_mission_frame(rows), counted)
        spent = int(np.searchsorted(self._references.all()[:, 0], until_us)) - 1  # one stays, to go on from
        self._references.take(max(spent, 0))
        spent = max(len(self._sent) - MOST_ROWS, 0)
        if spent:
            self._gaps.add(np.diff(self._sent.all()[: spent + 1, 0]) / 1e3)
            self._sent.take(spent)

    def _count(self, rows: FloatArray, position_m: FloatArray, counted: Counted) -> None:
        if self.airborne_us and len(self._references) > 1:
            flown = self._flown(rows)
            if flown.any():
                counted.path.add(position_m[flown])
                counted.error.add(self._errors(rows[flown, 0], position_m[flown]))
        aloft = position_m[self._aloft(rows)]
        if len(aloft):
            least = least_clearance(self._companion.mission, aloft)
            counted.clearance_m = min(counted.clearance_m, math.inf if least is None else least)


def least_clearance(mission: Mission, position_m: FloatArray) -> float | None:
    """Least distance [m] between the vehicle's hull (a ball) and an obstacle; None in an empty world."""
    world = mission.whole_world()
    if not world.obstacles:
        return None
    return float(np.min(world.distance(position_m))) - mission.vehicle.radius


def _is_one_packet(data: bytes) -> bool:
    """Whether a datagram looks like one unsigned MAVLink 2 packet and nothing else."""
    return len(data) >= 12 and data[0] == 0xFD and len(data) == data[1] + 12
