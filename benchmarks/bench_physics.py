"""Our plant beside RotorPy's, aerodynamics off: `python -m benchmarks.bench_physics [seconds]`.

RotorPy (Folk, Paulos & Kumar 2023) is written independently: z up and quaternions xyzw, scipy's solve_ivp where ours is
a fixed RK4 step of 1 ms. It knows no spin of rotors about their axes and one time constant of the motors, so ours is
given neither; the numbers are otherwise each airframe's own. Both start alike and get the same rotor commands, which
change every 0.2 s and turn the vehicle well about all three axes. RotorPy's tolerance is set tight for the agreement,
and left as it comes for its speed.
"""

import sys
import time
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fakevehicle.airframe import GRAVITY, Airframe, load_airframe
from fakevehicle.jit import kernel
from fakevehicle.physics.dynamics import STATE, step

try:
    from rotorpy.vehicles.multirotor import Multirotor
except ImportError:
    Multirotor = None

WITHOUT_ROTORPY = "rotorpy not installed: make bench-peers"
AIRFRAMES = ("x500", "iris", "crazyflie")
HOLD = 200
"""Steps for which a command stands."""
UP = np.array([1.0, -1.0, -1.0])
"""From our axes (north-east-down, front-right-down) to RotorPy's (x, y left, z up) and back."""

Array = NDArray[np.float64]


def bare(name: str) -> Airframe:
    """An airframe without what RotorPy does not have."""
    frame = load_airframe(name)
    return frame.model_copy(
        update={
            "rotor_inertia": 0.0,
            "rotor_drag": 0.0,
            "drag_area": (0.0, 0.0, 0.0),
            "time_constant_down": frame.time_constant_up,
        }
    )


def commands(frame: Airframe, seconds: float) -> Array:
    """(n, 4) rotor speeds near the hover's, one a HOLD [rad/s]; each is answered by its mirror, so it stays upright."""
    rng = np.random.default_rng(3)
    n = round(seconds * 1000 / HOLD)
    pushes = 0.02 * rng.standard_normal((n // 2 + 1, 4)).repeat(2, axis=0)[:n]
    pushes[1::2] *= -1.0
    speeds: Array = frame.hover_speed * (1.0 + pushes)
    return speeds


@kernel
def run(x, speeds, hold, wind, anchor, body_, dt, work, rows):
    """Every state of a flight under `speeds`, at `dt`, into `rows`."""
    k = 0
    for c in range(speeds.shape[0]):
        for _ in range(hold):
            step(x, speeds[c], wind, anchor, body_[0], dt, work)
            for i in range(17):
                rows[k, i] = x[i]
            k += 1


def ours(frame: Airframe, speeds: Array) -> tuple[Array, float]:
    """States at 1 kHz, (n, 17), and the CPU time for a simulated second [ms]."""
    rows = np.zeros((len(speeds) * HOLD, STATE))
    for _ in range(2):  # the first compiles
        x = np.zeros(STATE)
        x[2], x[6], x[13:17] = -1000.0, 1.0, frame.hover_speed
        body = frame.record()
        body["ground"] = 1e9  # no ground effect
        begin = time.process_time()
        run(x, speeds, HOLD, np.zeros(3), np.zeros((4, 3)), body, 0.001, np.zeros((6, STATE)), rows)
        took = time.process_time() - begin
    return rows, 1e6 * took / len(rows)


def theirs(frame: Airframe, speeds: Array, **integrator: Any) -> tuple[Array, float]:
    """The same by RotorPy, in our axes and order."""
    ixx, iyy, izz = frame.inertia
    plant = Multirotor(
        {
            **{"mass": frame.mass, "Ixx": ixx, "Iyy": iyy, "Izz": izz, "Ixy": 0.0, "Ixz": 0.0, "Iyz": 0.0},
            **{"num_rotors": 4, "rotor_speed_min": 0.0, "rotor_speed_max": frame.max_rotor_speed},
            "rotor_pos": {f"r{i}": UP * r.position_b for i, r in enumerate(frame.rotors)},
            "rotor_directions": np.array([r.spin for r in frame.rotors]),  # drag torque about z up
            **{"k_eta": frame.thrust_coefficient, "k_m": frame.moment_ratio * frame.thrust_coefficient},
            "tau_m": frame.time_constant_up,
        },
        aero=False,
        integrator_kwargs={"method": "RK45", **integrator},
    )
    plant.weight = np.array([0.0, 0.0, -frame.mass * GRAVITY])  # it has g = 9.81
    state: dict[str, Array] = {
        **{"x": np.array([0.0, 0.0, 1000.0]), "v": np.zeros(3), "q": np.array([0.0, 0.0, 0.0, 1.0]), "w": np.zeros(3)},
        **{"wind": np.zeros(3), "rotor_speeds": np.full(4, frame.hover_speed)},
    }
    rows = np.zeros((len(speeds) * HOLD, STATE))
    begin = time.process_time()
    for k in range(len(rows)):
        state = plant.step(state, {"cmd_motor_speeds": speeds[k // HOLD]}, 0.001)
        q = state["q"]
        rows[k] = np.concatenate(
            [UP * state["x"], UP * state["v"], [q[3], q[0], -q[1], -q[2]], UP * state["w"], state["rotor_speeds"]]
        )
    return rows, 1e6 * (time.process_time() - begin) / len(rows)


def apart(a: Array, b: Array) -> tuple[float, float, float, float, float]:
    """Largest differences: position [m], velocity [m/s], attitude [deg], body rate [deg/s], rotor speed [rad/s]."""
    cosine = np.minimum(np.abs(np.sum(a[:, 6:10] * b[:, 6:10], axis=1)), 1.0)
    sine = np.linalg.norm(a[:, 6:10] * np.sign(np.sum(a[:, 6:10] * b[:, 6:10], axis=1))[:, None] - b[:, 6:10], axis=1)
    d = np.abs(a - b)
    angle = np.degrees(2.0 * np.arctan2(sine, cosine))
    return d[:, :3].max(), d[:, 3:6].max(), angle.max(), np.degrees(d[:, 10:13].max()), d[:, 13:].max()


def main() -> None:
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 6.0
    print("\n## Plant, 1 kHz, aerodynamics off")
    if Multirotor is None:
        print(WITHOUT_ROTORPY)
        return
    print("\n| airframe | flown m | turned deg/s | apart m | m/s | deg | deg/s | rad/s | ours ms/s | RotorPy | ratio |")
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    for name in AIRFRAMES:
        frame = bare(name)
        speeds = commands(frame, seconds)
        mine, fast = ours(frame, speeds)
        tight, _ = theirs(frame, speeds, rtol=1e-9, atol=1e-12)
        _, slow = theirs(frame, speeds)
        flown = float(np.linalg.norm(mine[-1, :3] - [0.0, 0.0, -1000.0]))
        differences = " | ".join(f"{d:.1e}" for d in apart(mine, tight))
        turned = np.degrees(np.abs(mine[:, 10:13]).max())
        print(f"| {name} | {flown:.1f} | {turned:.0f} | {differences} | {fast:.2f} | {slow:.0f} | {slow / fast:.0f} |")


if __name__ == "__main__":
    main()
