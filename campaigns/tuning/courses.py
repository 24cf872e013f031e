"""Whole flights that a set of gains is judged by, the estimator in the loop.

A vehicle rests, while its estimate settles, climbs gently to `HEIGHT` and hovers; then comes one of

    Eight   a figure of eight, x = 4 sin a, y = 2 sin 2a, its speed at the crossing given; counted after START_S
    Step    the place that is asked for jumps north, nothing else is asked for
    Hover   nothing is asked for but to stay

Setpoints come every tick, in the estimator's frame, and truth is held against the setpoint of the same moment. The
frame's origin is told as latitude and longitude, and truth is moved by where that is, so that the choice of an origin
does not count, nor its error; heights are from where the vehicle stood by its own belief.
"""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from fakevehicle.airframe import load_airframe
from fakevehicle.errors import DivergedError
from fakevehicle.flight import FlightStack
from fakevehicle.geodesy import to_local
from fakevehicle.params import ParameterSet
from fakevehicle.physics.wind import Gust
from fakevehicle.vocabulary import FloatArray, Geodetic, Setpoint

HOME = Geodetic(math.radians(47.397742), math.radians(8.545594), 488.0)
AMPLITUDES = (4.0, 2.0)
REST_S, CLIMB_S, START_S = 8.0, 6.0, 4.0
HEIGHT, YAW = 2.5, 0.3
TOO_FAR = 8.0
"""Farther from where it is meant to be than this [m] it counts as lost, beside the length of a step."""
SQUALL_AT, SQUALL_RISE, SQUALL_HOLD = 2.0, 0.5, 3.0
"""When a squall comes, from the beginning of what counts, how fast it rises and falls, and how long it blows [s]."""
TICK_S = FlightStack.TICK_US * 1e-6


@dataclass(frozen=True, slots=True)
class Eight:
    """A figure of eight at `speed` [m/s] over its crossing, counted for `seconds`."""

    speed: float
    seconds: float = 24.0


@dataclass(frozen=True, slots=True)
class Step:
    """A jump of the place asked for by `metres` to the north, counted for `seconds` from then on."""

    metres: float
    seconds: float = 6.0


@dataclass(frozen=True, slots=True)
class Hover:
    """Standing still, counted for `seconds`."""

    seconds: float = 10.0


Course = Eight | Step | Hover


@dataclass(frozen=True, slots=True)
class Wind:
    """What blows: `mean` from the south, Dryden turbulence of a wind of `gusts`, a squall from the west [m/s]."""

    mean: float = 0.0
    gusts: float = 0.0
    squall: float = 0.0


@dataclass(frozen=True, slots=True)
class Flown:
    """What was flown, every tick of what counts, n of them.

    Attributes
    ----------
    course : that was asked for.
    error_n : (n, 3) truth less setpoint, NED [m].
    belief_n : (n, 3) estimate less setpoint [m]; `error_n - belief_n` is the estimator's own error.
    rotor_speed : (n, 4) [rad/s].
    lost : why it ended early, empty when it did not.
    share : of the course that was flown, 0..1.
    """

    course: Course
    error_n: FloatArray
    belief_n: FloatArray
    rotor_speed: FloatArray
    lost: str
    share: float


def fly(course: Course, wind: Wind, seed: int, parameters: ParameterSet, airframe: str = "x500") -> Flown:
    """Fly a course once; the same arguments give the same flight bit for bit.

    Parameters
    ----------
    parameters : of (at least) `fakevehicle.flight.PARAMETERS`; the turbulence of `wind` is set in them.
    airframe : a shipped one by name, or a file.
    """
    parameters.set("SIM_WIND_GUST", wind.gusts)
    begin_s = REST_S + CLIMB_S + (START_S if isinstance(course, Eight) else 0.0)
    west = np.array([0.0, wind.squall, 0.0])
    squall = Gust(round(1e6 * (begin_s + SQUALL_AT)), SQUALL_RISE, SQUALL_HOLD, west)
    stack = FlightStack(
        airframe=load_airframe(airframe),
        parameters=parameters,
        home=HOME,
        heading=YAW,
        wind_n=np.array([wind.mean, 0.0, 0.0]),
        seed=seed,
        gusts=(squall,) if wind.squall else (),
    )
    dt = FlightStack.TICK_US
    now = 0
    for _ in range(round(REST_S / TICK_S)):
        now += dt
        stack.tick(now, None, False)
    estimate = stack.estimate
    track, skip = _setpoints(course)
    total = len(track) - skip
    if not estimate.position_valid or estimate.origin is None:
        return _flown(course, [], [], [], "no position before the start", 0.0)
    ground = estimate.position_n.copy()
    offset = to_local(HOME, estimate.origin)
    offset[2] = ground[2] - stack.truth.position_n[2]
    errors, beliefs, rotors = [], [], []
    limit = TOO_FAR + (course.metres if isinstance(course, Step) else 0.0)
    lost = ""
    try:
        for place, velocity, acceleration in climb():
            now += dt
            stack.tick(now, Setpoint(ground + place, velocity, acceleration, YAW), True)
        for k, (place, velocity, acceleration) in enumerate(track):
            now += dt
            asked = ground + place
            stack.tick(now, Setpoint(asked, velocity, acceleration, YAW), True)
            truth = stack.truth
            error = truth.position_n + offset - asked
            if truth.on_ground or math.hypot(error[0], error[1], error[2]) > limit:
                lost = "on the ground" if truth.on_ground else f"more than {limit:g} m off"
                break
            if k >= skip:
                errors.append(error)
                beliefs.append(stack.estimator.out[:3] - asked)
                rotors.append(truth.rotor_speed)
    except DivergedError as error:
        lost = str(error)
    return _flown(course, errors, beliefs, rotors, lost, len(errors) / total)


def _flown(
    course: Course, errors: list[FloatArray], beliefs: list[FloatArray], rotors: list[FloatArray], lost: str, f: float
) -> Flown:
    """The lists as arrays, right also when they are empty."""
    shaped = (np.array(rows).reshape(-1, n) for rows, n in ((errors, 3), (beliefs, 3), (rotors, 4)))
    error_n, belief_n, rotor_speed = shaped
    return Flown(course, error_n, belief_n, rotor_speed, lost, f)


Row = tuple[FloatArray, FloatArray, FloatArray]
"""Place from where it stood at first, velocity and acceleration, (3,) each."""


@lru_cache(maxsize=32)
def _setpoints(course: Course) -> tuple[tuple[Row, ...], int]:
    """Every tick's setpoint after the climb, and how many of them do not count yet."""
    if isinstance(course, Eight):
        skip = round(START_S / TICK_S)
        return tuple(eight(course.speed, (k + 1) * TICK_S) for k in range(skip + round(course.seconds / TICK_S))), skip
    north = course.metres if isinstance(course, Step) else 0.0
    row = (np.array([north, 0.0, -HEIGHT]), np.zeros(3), np.zeros(3))
    return (row,) * round(course.seconds / TICK_S), 0


def eight(speed: float, t: float) -> Row:
    """The figure of eight `t` [s] after the start at its crossing; full speed after START_S."""
    ax, ay = AMPLITUDES
    w = speed / math.hypot(ax, 2.0 * ay)
    if t < START_S:
        u = t / START_S
        a, b, c = START_S * w * (u**3 - u**4 / 2.0), w * (3.0 * u * u - 2.0 * u**3), w * 6.0 * u * (1.0 - u) / START_S
    else:
        a, b, c = w * (t - START_S / 2.0), w, 0.0
    s = np.array([ax * math.sin(a), ay * math.sin(2.0 * a), -HEIGHT])
    d = np.array([ax * math.cos(a), 2.0 * ay * math.cos(2.0 * a), 0.0])
    dd = np.array([-ax * math.sin(a), -4.0 * ay * math.sin(2.0 * a), 0.0])
    return s, b * d, b * b * dd + c * d


@lru_cache(maxsize=1)
def climb() -> tuple[Row, ...]:
    """From the ground to HEIGHT in two thirds of CLIMB_S, and hover."""
    up, long = np.array([0.0, 0.0, -HEIGHT]), 2.0 * CLIMB_S / 3.0
    rows = []
    for k in range(round(CLIMB_S / TICK_S)):
        s = min((k + 1) * TICK_S / long, 1.0)
        slowing = (6.0 - 12.0 * s) / long**2 if s < 1.0 else 0.0
        rows.append((s * s * (3.0 - 2.0 * s) * up, 6.0 * s * (1.0 - s) / long * up, slowing * up))
    return tuple(rows)
