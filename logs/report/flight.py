"""A flight in one frame and on one clock: what every section of a report is made from.

Times are seconds since the first message. The frame is the mission's, NED metres. What the companion sends is its
reference in the vehicle's local frame, so setpoint - reference of the same tick is where the local frame lies: no
mission has to be known for it. Truth is taken relative to where it stood when the flight began, as the verdict does.
Without references the local frame stays as it is.
"""

import math
from dataclasses import dataclass, field

import numpy as np

from logs.report.columns import FloatArray, Rows
from logs.report.traffic import Traffic
from logs.schema import Note

_EARTH_A, _EARTH_E2 = 6_378_137.0, 6.694379990141e-3  # WGS84: semi-major axis [m], first eccentricity squared
_POSITION = 0b111
"""Of a setpoint's type_mask: set bits are ignored."""
_FRAMES_ABSOLUTE = (1, 5, 6, 11)  # MAV_FRAME_LOCAL_NED and GLOBAL_INT, RELATIVE_ALT_INT, TERRAIN_ALT_INT


@dataclass(frozen=True, slots=True)
class Motion:
    """Samples of a place: times (n,) [s], position (n, 3) and velocity (n, 3), NED [m], [m/s]."""

    t: FloatArray
    position: FloatArray
    velocity: FloatArray

    def at(self, t: FloatArray) -> FloatArray:
        """Positions (k, 3) between the samples; NaN before the first and after the last."""
        if not len(self.t):
            return np.full((len(t), 3), np.nan)
        columns = [np.interp(t, self.t, self.position[:, k], left=np.nan, right=np.nan) for k in range(3)]
        return np.stack(columns, axis=1)


NO_MOTION = Motion(np.empty(0), np.empty((0, 3)), np.empty((0, 3)))


@dataclass(slots=True)
class Flight:
    """What is known of a flight.

    Attributes
    ----------
    flown : as the vehicle's estimator tells it; truth : as the simulator does; reference : where it should have been.
    attitude : (n, 4) time, roll, pitch, yaw [rad].
    tracked : (from, until) of what counts for the tracking error [s]; aloft : of what counts for the clearance.
    origin_n : of the mission frame in the vehicle's local frame [m]; None: not known, the local frame is shown.
    source : message that `flown` is from.
    """

    traffic: Traffic
    t0_ns: int
    duration_s: float
    flown: Motion = NO_MOTION
    truth: Motion = NO_MOTION
    reference: Motion = NO_MOTION
    attitude: FloatArray = field(default_factory=lambda: np.empty((0, 4)))
    tracked: tuple[float, float] | None = None
    aloft: tuple[float, float] | None = None
    origin_n: FloatArray | None = None
    source: str = ""

    def times(self, rows: Rows) -> FloatArray:
        """When messages were, since the start [s]."""
        seconds: FloatArray = (rows["t"] - self.t0_ns) / 1e9
        return seconds

    def s(self, t_ns: float) -> float:
        """One time since the start [s]."""
        return (t_ns - self.t0_ns) / 1e9

    @property
    def notes(self) -> list[tuple[float, Note]]:
        """What the companion said, and when [s]."""
        return [(self.s(t), note) for t, _, note in self.traffic.records.get(Note, [])]

    def when(self, motion: Motion, span: tuple[float, float] | None) -> Motion:
        """The samples within a span of time."""
        if span is None:
            return NO_MOTION
        inside = (motion.t >= span[0]) & (motion.t <= span[1])
        return Motion(motion.t[inside], motion.position[inside], motion.velocity[inside])


def flight_of(traffic: Traffic) -> Flight:
    """Put what was read into one frame."""
    flight = Flight(traffic, traffic.first_ns, (traffic.last_ns - traffic.first_ns) / 1e9)
    rows = traffic.told(30)
    angles = [rows["m"][name].astype(np.float64) for name in ("roll", "pitch", "yaw")]
    flight.attitude = np.stack([flight.times(rows), *angles], axis=1)
    _spans(flight)
    _reference(flight)
    _flown(flight)
    _truth(flight)
    if not len(flight.reference.t):
        _setpoints_as_reference(flight)
    return flight


def _spans(flight: Flight) -> None:
    """When it flew: by the companion's phases, else by the vehicle's armed flag."""
    armed = flight.traffic.told(0)
    on = flight.times(armed)[(armed["m"]["base_mode"] & 128) != 0]
    phases = [(t, note.phase) for t, note in flight.notes]
    aloft = [t for t, phase in phases if phase in ("taking off", "flying")]
    flying = [t for t, phase in phases if phase == "flying"]
    if aloft:
        after = [t for t, phase in phases if t > aloft[-1] and phase in ("done", "failed")]
        last = after[0] if after else flight.duration_s
        flight.aloft = (aloft[0], last)
        if flying:
            left = [t for t, phase in phases if t > flying[-1] and phase != "flying"]
            flight.tracked = (flying[0], left[0] if left else last)
    elif len(on) and not flight.traffic.companions:
        flight.aloft = flight.tracked = (float(on[0]), float(on[-1]))


def _reference(flight: Flight) -> None:
    """References, and where the local frame lies by the setpoints of the same ticks."""
    rows = flight.traffic.references
    if not len(rows):
        return
    flight.reference = Motion((rows[:, 0] - flight.t0_ns) / 1e9, rows[:, 2:5], rows[:, 5:8])
    offsets = []
    for _, sent in flight.traffic.asked(84):
        usable = sent[(sent["m"]["coordinate_frame"] == 1) & (sent["m"]["type_mask"] & _POSITION == 0)]
        _, ours, theirs = np.intersect1d(rows[:, 1].astype(np.int64), usable["tick"], return_indices=True)
        there = np.stack([usable["m"][name][theirs] for name in "xyz"], axis=1)
        offsets.append(there - rows[ours, 2:5])
    found = np.concatenate(offsets) if offsets else np.empty((0, 3))
    found = found[np.isfinite(found).all(axis=1)]
    if len(found):
        flight.origin_n = np.median(found, axis=0)


def _flown(flight: Flight) -> None:
    """Where the vehicle says it was: locally, else by latitude and longitude."""
    rows = flight.traffic.told(32)
    if len(rows):
        m = rows["m"]
        position = np.stack([m[name].astype(np.float64) for name in "xyz"], axis=1)
        velocity = np.stack([m[f"v{name}"].astype(np.float64) for name in "xyz"], axis=1)
        flight.source = "LOCAL_POSITION_NED"
    else:
        rows = flight.traffic.told(33)
        if not len(rows):
            return
        m = rows["m"]
        valid = (m["lat"] != 0) | (m["lon"] != 0)
        rows = rows[valid]
        if not len(rows):
            return
        m = rows["m"]
        position = _local(m["lat"] / 1e7, m["lon"] / 1e7, m["alt"] / 1e3)
        position[:, 2] = -m["relative_alt"] / 1e3
        velocity = np.stack([m[name] / 100.0 for name in ("vx", "vy", "vz")], axis=1)
        flight.source = "GLOBAL_POSITION_INT"
    good = np.isfinite(position).all(axis=1)
    t, position, velocity = flight.times(rows)[good], position[good], velocity[good]
    if flight.origin_n is not None and flight.source == "LOCAL_POSITION_NED":
        position = position - flight.origin_n
    order = np.argsort(t, kind="stable")
    flight.flown = Motion(t[order], position[order], velocity[order])


def _truth(flight: Flight) -> None:
    """The simulator's truth: its own records, or HIL_STATE_QUATERNION; moved to where the vehicle stood."""
    rows = flight.traffic.truths
    if len(rows):
        t, position, velocity = (rows[:, 0] - flight.t0_ns) / 1e9, rows[:, 1:4], rows[:, 4:7]
    else:
        told = _told_truth(flight)
        if told is None:
            return
        t, position, velocity = told
    if len(flight.flown.t):
        stood_s = next((s for s, note in flight.notes if note.phase == "planning"), None)
        if stood_s is None:
            stood_s = max(float(flight.flown.t[0]), float(t[0]))
            if flight.aloft is not None:
                stood_s = max(stood_s, flight.aloft[0] - 0.5)
        here = Motion(t, position, velocity).at(np.array([stood_s]))[0]
        said = flight.flown.at(np.array([stood_s]))[0]
        if np.isfinite(here).all() and np.isfinite(said).all():
            position = position - here + said
    flight.truth = Motion(t, position, velocity)


def on_the_map(flight: Flight, latitude: FloatArray, longitude: FloatArray, altitude: FloatArray) -> FloatArray | None:
    """Places on the earth [deg, deg, m] in the flight's frame (n, 3); None where the vehicle told no such place."""
    rows = flight.traffic.told(33)
    rows = rows[(rows["m"]["lat"] != 0) | (rows["m"]["lon"] != 0)]
    here = flight.flown.at(flight.times(rows))
    known = np.flatnonzero(np.isfinite(here).all(axis=1))
    if not len(known):
        return None
    k = known[len(known) // 2]  # in mid-flight, when the estimator has settled
    m = rows["m"][k]
    first = (m["lat"] / 1e7, m["lon"] / 1e7, m["alt"] / 1e3)
    columns = (
        np.insert(column, 0, start) for column, start in zip((latitude, longitude, altitude), first, strict=True)
    )
    places: FloatArray = _local(*columns)[1:] + here[k]
    return places


def _told_truth(flight: Flight) -> tuple[FloatArray, FloatArray, FloatArray] | None:
    """Times, positions and velocities of HIL_STATE_QUATERNION, or of ArduPilot's SIM_STATE with whole degrees 1e-7."""
    rows = flight.traffic.told(115)
    if len(rows):
        m = rows["m"]
        position = _local(m["lat"] / 1e7, m["lon"] / 1e7, m["alt"] / 1e3)
        velocity = np.stack([m[name] / 100.0 for name in ("vx", "vy", "vz")], axis=1)
        return flight.times(rows), position, velocity
    rows = flight.traffic.told(108)
    rows = rows[(rows["m"]["lat_int"] != 0) | (rows["m"]["lon_int"] != 0)]
    if not len(rows):
        return None
    m = rows["m"]
    position = _local(m["lat_int"] / 1e7, m["lon_int"] / 1e7, m["alt"].astype(np.float64))
    velocity = np.stack([m[name].astype(np.float64) for name in ("vn", "ve", "vd")], axis=1)
    return flight.times(rows), position, velocity


def _setpoints_as_reference(flight: Flight) -> None:
    """Without a companion's records: the positions that somebody asked the vehicle for."""
    found = [rows for _, rows in flight.traffic.asked(84)]
    if not found:
        return
    rows = np.concatenate(found)
    rows = rows[np.argsort(rows["t"], kind="stable")]
    m = rows["m"]
    rows = rows[(m["type_mask"] & _POSITION == 0) & (m["coordinate_frame"] == 1)]
    if len(rows) < 2:
        return
    m = rows["m"]
    position = np.stack([m[name].astype(np.float64) for name in "xyz"], axis=1)
    velocity = np.stack([m[f"v{name}"].astype(np.float64) for name in "xyz"], axis=1)
    flight.reference = Motion(flight.times(rows), position, velocity)
    flight.tracked = (float(flight.reference.t[0]), float(flight.reference.t[-1]))


def _local(latitude: FloatArray, longitude: FloatArray, altitude: FloatArray) -> FloatArray:
    """NED (n, 3) [m] from the first place [deg, deg, m]: tangent plane by WGS84's two radii of curvature."""
    phi = math.radians(float(latitude[0]))
    w = 1.0 - _EARTH_E2 * math.sin(phi) ** 2
    meridian, normal = _EARTH_A * (1.0 - _EARTH_E2) / w**1.5, _EARTH_A / math.sqrt(w)
    north = np.radians(latitude - latitude[0]) * (meridian + altitude[0])
    east = np.radians(longitude - longitude[0]) * (normal + altitude[0]) * math.cos(phi)
    return np.stack([north, east, -(altitude - altitude[0])], axis=1)
