"""The airframe: a YAML file checked once, and the flat record the kernels read.

A file may say which values of the parameters it flies well with; they take the place of the defaults, and whoever asks
for other values gets them.

Frame: body FRD, origin at the centre of mass, SI units. Every number of a shipped file names its source.
"""

from collections.abc import Iterable, Mapping
from difflib import get_close_matches
from importlib import resources
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
import yaml
from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

from fakevehicle.airframe_check import AIR_DENSITY, Flaw, check
from fakevehicle.airframe_check import GRAVITY as GRAVITY  # others have it from here
from fakevehicle.battery import Pack
from fakevehicle.errors import AirframeError
from fakevehicle.params import Parameter
from fakevehicle.physics.ground import POINTS
from fakevehicle.vocabulary import FloatArray

BODY = np.dtype(
    [
        ("mass", "f8"),
        ("inertia", "f8", (3,)),
        ("rotor_position", "f8", (4, 3)),
        ("spin", "f8", (4,)),  # about +z_b, which points down: counter-clockwise from above is -1
        ("k", "f8"),  # thrust coefficient [N/(rad/s)^2]
        ("kappa", "f8"),  # torque over thrust [m]
        ("speed_max", "f8"),
        ("speed_idle", "f8"),
        ("tau_up", "f8"),
        ("tau_down", "f8"),
        ("c_d", "f8"),  # in-plane rotor drag [N/((rad/s)(m/s))]
        ("rotor_inertia", "f8"),
        ("radius", "f8"),
        ("drag_area", "f8", (3,)),
        ("air_density", "f8"),
        ("gravity", "f8"),
        ("contact", "f8", (POINTS, 3)),  # the feet, then the rotors' hubs
        ("ground", "f8"),  # z of the ground plane: the vehicle rests on it with its centre of mass at z = 0 [m]
        ("stiffness", "f8"),
        ("damping", "f8"),
        ("friction", "f8"),
        ("mix", "f8", (4, 4)),  # rotor thrusts from (tau_x, tau_y, tau_z, total thrust)
        ("effect", "f8", (4,)),  # what is left of each rotor, 0..1
        ("sag", "f8"),  # battery voltage over the one that full speed belongs to
        ("boost", "f8"),  # by which the mixer's speeds are raised against it
    ]
)
"""What the physics and the mixer know of the vehicle; one record."""

Positive = Annotated[float, Field(gt=0, allow_inf_nan=False)]
NotNegative = Annotated[float, Field(ge=0, allow_inf_nan=False)]
Real = Annotated[float, Field(allow_inf_nan=False)]
Lag = Annotated[float, Field(ge=0.001, le=1)]
"""A time constant [s]; a step of the integrator is 1 ms."""
Vector = tuple[Real, Real, Real]


class Rotor(BaseModel):
    """Where one rotor sits and which way it turns."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    position_b: Vector  # [m]
    spin: Literal[-1, 1]  # about +z_b (down); -1 is counter-clockwise seen from above


class Airframe(BaseModel):
    """One quadrotor's physical numbers.

    Raises
    ------
    pydantic.ValidationError : a number cannot be; `load_airframe` turns it into one `AirframeError`.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    name: str
    mass: Annotated[float, Field(ge=0.005, le=200)]  # [kg]
    inertia: tuple[Positive, Positive, Positive]  # principal, about the body axes [kg m^2]
    rotors: tuple[Rotor, Rotor, Rotor, Rotor]  # PX4 order
    thrust_coefficient: Positive
    moment_ratio: Annotated[float, Field(ge=1e-4, le=1)]
    max_rotor_speed: Positive
    idle_rotor_speed: NotNegative
    time_constant_up: Lag
    time_constant_down: Lag
    rotor_drag: NotNegative
    rotor_inertia: NotNegative
    propeller_radius: Annotated[float, Field(ge=0.005, le=2)]
    drag_area: tuple[NotNegative, NotNegative, NotNegative]
    contact_points_b: tuple[Vector, Vector, Vector, Vector]
    contact_stiffness: Positive
    contact_damping: NotNegative
    contact_friction: Annotated[float, Field(ge=0, le=10)]
    battery: Pack
    parameters: Mapping[str, Real] = {}  # that it flies well with, by name, where they differ from the defaults
    source: dict[str, str]

    @model_validator(mode="after")
    def _can_fly(self) -> "Airframe":
        check(self)
        unnamed = set(type(self).model_fields) - {"name", "parameters", "source"} - set(self.source)
        if unnamed:
            raise Flaw("source", f"none for {', '.join(sorted(unnamed))}", "a line for every field")
        return self

    def allocation(self) -> FloatArray:
        """(4, 4) matrix from the rotors' thrusts to (tau_x, tau_y, tau_z, T), [N m] and [N].

        A thrust T_i along -z_b at r_i makes the torque r_i x (0, 0, -T_i) = (-y_i, x_i, 0) T_i and the drag torque
        -s_i kappa T_i about z_b.
        """
        return np.array(
            [[-r.position_b[1], r.position_b[0], -r.spin * self.moment_ratio, 1.0] for r in self.rotors], dtype=float
        ).T

    @property
    def level_thrust(self) -> float:
        """The most the rotors can give together without a torque [N]: all of it, or what the busiest of them allows."""
        shares = np.linalg.inv(self.allocation())[:, 3]
        return float(self.thrust_coefficient * self.max_rotor_speed**2 / shares.max())

    @property
    def hover_speed(self) -> float:
        """Rotor speed at which the thrust balances the weight [rad/s]."""
        return float(np.sqrt(self.mass * GRAVITY / (4 * self.thrust_coefficient)))

    def values(self, file: str, known: Iterable[Parameter]) -> Mapping[str, float]:
        """The values its file asks for, each of one of the vehicle's `known` parameters and within its range.

        Raises
        ------
        AirframeError : a name that is not known, or a value out of range; `file` is what the message calls the file.
        """
        described = {p.name: p for p in known}
        for name, value in self.parameters.items():
            if name not in described:
                raise AirframeError(file, f"parameters.{name}", f"{value:g}", "a parameter of the vehicle's own names")
            low, high = described[name].minimum, described[name].maximum
            if not low <= value <= high:
                raise AirframeError(file, f"parameters.{name}", f"{value:g}", f"{low:g} to {high:g}")
        return self.parameters

    def record(self) -> np.ndarray[Any, np.dtype[np.void]]:
        """The (1,) array of `BODY` the kernels read."""
        body = np.zeros(1, BODY)
        b = body[0]
        b["mass"], b["inertia"] = self.mass, self.inertia
        b["rotor_position"] = [r.position_b for r in self.rotors]
        b["spin"] = [r.spin for r in self.rotors]
        b["k"], b["kappa"] = self.thrust_coefficient, self.moment_ratio
        b["speed_max"], b["speed_idle"] = self.max_rotor_speed, self.idle_rotor_speed
        b["tau_up"], b["tau_down"] = self.time_constant_up, self.time_constant_down
        b["c_d"], b["rotor_inertia"], b["radius"] = self.rotor_drag, self.rotor_inertia, self.propeller_radius
        b["drag_area"], b["air_density"], b["gravity"] = self.drag_area, AIR_DENSITY, GRAVITY
        b["contact"] = [*self.contact_points_b, *(r.position_b for r in self.rotors)]
        b["stiffness"], b["damping"] = self.contact_stiffness, self.contact_damping
        b["friction"] = self.contact_friction
        foot = float(np.mean([point[2] for point in self.contact_points_b]))
        b["ground"] = foot - self.mass * GRAVITY / (4 * self.contact_stiffness)
        b["mix"] = np.linalg.inv(self.allocation())
        b["effect"], b["sag"], b["boost"] = 1.0, 1.0, 1.0
        return body


def load_airframe(name: str) -> Airframe:
    """Read an airframe by the name of a shipped one, or by the path of a YAML file.

    Raises
    ------
    AirframeError : no such file, not YAML, or a field that cannot be; the message says file, field, found, expected.
    """
    shipped = resources.files("fakevehicle") / "airframes" / f"{name}.yaml"
    path = Path(name)
    try:
        text = path.read_text(encoding="utf-8") if path.suffix in (".yaml", ".yml") else shipped.read_text("utf-8")
    except OSError as error:
        listed = sorted(f.name[:-5] for f in (resources.files("fakevehicle") / "airframes").iterdir())
        raise AirframeError(name, "", error.strerror or "nothing", f"a file, or one of {', '.join(listed)}") from error
    try:
        content = yaml.safe_load(text)
    except yaml.YAMLError as error:
        problem = getattr(error, "problem", None) or "no YAML"
        mark = getattr(error, "problem_mark", None)
        raise AirframeError(name, f"line {mark.line + 1}" if mark else "", problem, "YAML") from error
    if not isinstance(content, dict):
        raise AirframeError(name, "", type(content).__name__, "a mapping of fields")
    try:
        return Airframe.model_validate(content)
    except ValidationError as error:
        raise _told(name, error) from error


def _told(name: str, error: ValidationError) -> AirframeError:
    """The first of pydantic's errors in the form of ours; unknown names come before missing ones."""
    first = min(error.errors(), key=lambda e: e["type"] != "extra_forbidden")
    flaw = first.get("ctx", {}).get("error")
    if isinstance(flaw, Flaw):
        return AirframeError(name, flaw.field, flaw.found, flaw.expected)
    field = ".".join(str(part) for part in first["loc"])
    if first["type"] == "missing":
        return AirframeError(name, field, "nothing", "a value")
    if first["type"] == "extra_forbidden":
        near = get_close_matches(str(first["loc"][-1]), Airframe.model_fields, 1)
        return AirframeError(name, field, repr(first["input"]), f"no such field{f'; {near[0]}?' if near else ''}")
    return AirframeError(name, field, repr(first["input"]), first["msg"].removeprefix("Input should be "))
