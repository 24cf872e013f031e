"""What an airframe's numbers must fulfil together, so that it can fly and its flight can be computed.

One row a rule: the field that is named, what was found there and what is expected. Bounds are wide; they keep out what
no quadrotor is, or what the integrator's step of 1 ms cannot follow. Where a rule is about motion a foot moves the mass
m_f = 1/(1/m + r^2/J) it feels at its distance r, J the least moment of inertia.
"""

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from fakevehicle.airframe import Airframe

GRAVITY = 9.80665
"""Standard gravity [m/s^2]."""
AIR_DENSITY = 1.225
"""International standard atmosphere at sea level [kg/m^3]."""
LEAST_LIFT, MOST_LIFT = 1.2, 10.0
"""Full thrust over weight. MPC_THR_MAX and what is kept for leaning take 10 %; MPC_THR_MIN carries 80 % at ten."""
FASTEST, MOST_DAMPED = 500.0, 500.0
"""Of a foot on its spring: the highest angular frequency and the highest damping over mass [1/s]."""


class Flaw(ValueError):
    """A number that cannot be: field, found and expected, as `errors.AirframeError` has them."""

    def __init__(self, field: str, found: str, expected: str) -> None:
        super().__init__(f"{field}: found {found}, expected {expected}")
        self.field, self.found, self.expected = field, found, expected


def check(frame: "Airframe") -> None:
    """Hold an airframe whose fields are each in range against what they must be together.

    Raises
    ------
    Flaw : the first rule that does not hold.
    """
    for flaw in _flaws(frame):
        raise flaw


def _flaws(f: "Airframe") -> Iterator[Flaw]:
    weight, inertia = f.mass * GRAVITY, sorted(f.inertia)
    if inertia[2] > 1.001 * (inertia[0] + inertia[1]):
        yield Flaw(
            "inertia", f"{inertia[2]:.3g} above the sum of the others", "none larger than the other two together"
        )
    arm = max(math.hypot(*r.position_b[:2]) for r in f.rotors)
    if not 0.005 * f.mass * arm**2 <= inertia[0] <= inertia[2] <= 10.0 * f.mass * arm**2:
        expected = f"{0.005 * f.mass * arm**2:.2g} to {10.0 * f.mass * arm**2:.2g} for this mass and these arms"
        yield Flaw("inertia", str(f.inertia), expected)
    arms = f.allocation()
    if np.linalg.matrix_rank(arms) < 4:
        yield Flaw("rotors", "places and spins", "three torques and a thrust that are independent")
        return
    least = float(np.linalg.inv(arms)[:, 3].min())
    if least < 0.1:
        yield Flaw(
            "rotors", f"one that carries {100 * least:.0f} % of the weight", "10 % at least: mass amid the rotors"
        )
    lift = f.level_thrust / weight
    if not LEAST_LIFT <= lift <= MOST_LIFT:
        found = f"a full thrust of {lift:.3g} times the weight, with thrust_coefficient and mass"
        yield Flaw("max_rotor_speed", found, f"{LEAST_LIFT:g} to {MOST_LIFT:g} times")
    if f.idle_rotor_speed > math.sqrt(0.5) * f.hover_speed:
        found = f"{f.idle_rotor_speed:g}, {(f.idle_rotor_speed / f.hover_speed) ** 2:.2g} of the weight"
        yield Flaw("idle_rotor_speed", found, f"at most {math.sqrt(0.5) * f.hover_speed:.4g}, half of it")
    slowing = 4 * f.rotor_drag * f.max_rotor_speed / f.mass
    if slowing > 10.0:
        yield Flaw("rotor_drag", f"{f.rotor_drag:g}", f"at most {10.0 * f.rotor_drag / slowing:.2g} for this mass")
    if f.rotor_inertia > 0.1 * f.inertia[2]:
        yield Flaw("rotor_inertia", f"{f.rotor_inertia:g}", f"at most {0.1 * f.inertia[2]:.2g}, a tenth of the frame's")
    widest = 2.0 * weight / (AIR_DENSITY * 2.0**2)
    if max(f.drag_area) > widest:
        yield Flaw("drag_area", f"{max(f.drag_area):g}", f"at most {widest:.2g}, with which it would fall at 2 m/s")
    yield from _on_its_feet(f, weight, inertia[0])
    pack = f.battery
    full = 4.2 * pack.cells
    hover_power = pack.idle_power + pack.full_power * (f.hover_speed / f.max_rotor_speed) ** 3
    left = 1.0 - pack.resistance * hover_power / full**2
    if left < 0.75:
        found = f"{pack.resistance:g}, with {hover_power:.3g} W in a hover {100 * max(left, 0):.0f} % of the voltage"
        yield Flaw("battery.resistance", found, "75 % at least")


def _on_its_feet(f: "Airframe", weight: float, inertia: float) -> Iterator[Flaw]:
    feet = np.array(f.contact_points_b)
    if feet[:, 2].min() <= 0.0:
        yield Flaw("contact_points_b", f"a foot at z = {feet[:, 2].min():g}", "all below the centre of mass, z above 0")
    if feet[:, :2].min(axis=0).max() >= 0.0 or feet[:, :2].max(axis=0).min() <= 0.0:
        yield Flaw("contact_points_b", "all feet on one side", "the centre of mass amid them")
    felt = 1.0 / (1.0 / f.mass + float((feet**2).sum(axis=1).max()) / inertia)
    softest, stiffest = weight / (4 * 0.05), FASTEST**2 * felt
    if not softest <= f.contact_stiffness <= stiffest:
        yield Flaw("contact_stiffness", f"{f.contact_stiffness:g}", f"{softest:.3g} to {stiffest:.3g} for this mass")
    if f.contact_damping > MOST_DAMPED * felt:
        yield Flaw("contact_damping", f"{f.contact_damping:g}", f"at most {MOST_DAMPED * felt:.3g} for this mass")
