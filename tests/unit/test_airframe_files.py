"""Airframe files that cannot be are told by file, field, found and expected; those at the edge of what can be, fly."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml

from fakevehicle.airframe import load_airframe
from fakevehicle.errors import AirframeError
from fakevehicle.physics.dynamics import STATE, step
from fakevehicle.physics.ground import settle

SHIPPED = ("x500", "iris", "crazyflie")


def written(folder: Path, changes: dict[str, Any], base: str = "x500") -> str:
    """An airframe's file with other values; None takes a field away."""
    content = load_airframe(base).model_dump(mode="json") | changes
    path = folder / "mine.yaml"
    path.write_text(yaml.safe_dump({k: v for k, v in content.items() if v is not None}))
    return str(path)


def rotors(*places: tuple[float, float], spins: tuple[int, ...] = (-1, -1, 1, 1)) -> list[dict[str, Any]]:
    return [{"position_b": [x, y, -0.06], "spin": s} for (x, y), s in zip(places, spins, strict=True)]


AHEAD = rotors((0.4, 0.2), (0.1, -0.2), (0.4, -0.2), (0.1, 0.2))
ALIKE = rotors((0.2, 0.2), (-0.2, -0.2), (0.2, -0.2), (-0.2, 0.2), spins=(1, 1, 1, 1))


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"masss": 3, "mass": None}, r"masss: found 3, expected no such field; mass\?"),
        ({"mass": None}, r"mass: found nothing, expected a value"),
        ({"mass": 1e-9}, r"mass: found 1e-09, expected greater than or equal to 0\.005"),
        ({"moment_ratio": 0.0}, r"moment_ratio: found 0\.0, expected greater than"),
        ({"source": {"mass": "a scale"}}, r"source: found none for battery, .*, expected a line for every field"),
        ({"idle_rotor_speed": 1500.0}, r"idle_rotor_speed: found 1500, .* expected at most 544\.1"),
        ({"max_rotor_speed": 1e5}, r"max_rotor_speed: found a full thrust of 1\.69e\+04 times .* expected 1\.2 to 10"),
        ({"mass": 3.4}, r"max_rotor_speed: found a full thrust of 1\.03 times .* expected 1\.2 to 10 times"),
        ({"inertia": [0.02, 0.02, 4.4]}, r"inertia: found 4\.4 .*expected none larger than the other two together"),
        ({"inertia": [2e-6, 2e-6, 3e-6]}, r"inertia: found .* expected 0\.00062 to"),
        ({"time_constant_up": 1e-9}, r"time_constant_up: found 1e-09, expected greater than or equal to 0\.001"),
        ({"contact_stiffness": 2.5e7}, r"contact_stiffness: found 2\.5e\+07, expected 101 to"),
        ({"contact_damping": 4000.0}, r"contact_damping: found 4000, expected at most"),
        ({"rotor_drag": 0.1}, r"rotor_drag: found 0\.1, expected at most"),
        ({"rotor_inertia": 1.0}, r"rotor_inertia: found 1, expected at most"),
        ({"drag_area": [0.1, 0.1, 90.0]}, r"drag_area: found 90, expected at most"),
        ({"rotors": AHEAD}, r"rotors: found one that carries -\d+ % of the weight"),
        ({"rotors": ALIKE}, r"rotors: found places and spins, expected three torques and a thrust"),
        ({"contact_points_b": [[0.1, 0.1, -0.2]] * 4}, r"contact_points_b: found a foot at z = -0\.2"),
        ({"contact_points_b": [[0.1, 0.1, 0.2]] * 4}, r"contact_points_b: found all feet on one side"),
    ],
)
def test_a_file_that_cannot_be_is_one_line_with_field_found_and_expected(
    tmp_path: Path, changes: dict[str, Any], words: str
) -> None:
    path = written(tmp_path, changes)
    with pytest.raises(AirframeError, match=rf"mine\.yaml: {words}") as told:
        load_airframe(path)
    assert "\n" not in str(told.value)


def test_a_battery_that_breaks_down_in_a_hover_is_named(tmp_path: Path) -> None:
    pack = load_airframe("x500").battery.model_dump() | {"resistance": 2.0}
    with pytest.raises(AirframeError, match=r"battery\.resistance: found 2, .* expected 75 % at least"):
        load_airframe(written(tmp_path, {"battery": pack}))


@pytest.mark.parametrize("base", SHIPPED)
@pytest.mark.parametrize("field", ["contact_stiffness", "contact_damping", "time_constant_up", "rotor_drag"])
def test_what_is_just_accepted_can_be_computed_at_a_millisecond(tmp_path: Path, base: str, field: str) -> None:
    # WHEN a field is as extreme as the message says it may be, and feet or rotors are put to work
    try:
        load_airframe(written(tmp_path, {field: 1e9 if field != "time_constant_up" else 1e-9}, base))
        pytest.fail("accepted")
    except AirframeError as error:
        bound = float(error.expected.split(" for ")[0].split(" to ")[-1].split()[-1])
    frame = load_airframe(written(tmp_path, {field: 0.99 * bound if field != "time_constant_up" else bound}, base))
    body, work, anchor, x = frame.record()[0], np.zeros((6, STATE)), np.zeros((4, 3)), np.zeros(STATE)
    x[2], x[6], x[7] = -0.02, 0.9998, 0.02
    anchor[:] = frame.contact_points_b
    for k in range(4000):
        # THEN after a fall of 2 cm it stands still, and rotors that turn on and off keep to their speeds
        command = np.full(4, frame.idle_rotor_speed if k % 400 < 200 else 0.0)
        step(x, command, np.zeros(3), anchor, body, 0.001, work)
        settle(x, anchor, body)
        assert x[13:17].max() <= frame.idle_rotor_speed * 1.0001
    assert np.abs(x[0:3]).max() < 0.05
    assert np.abs(x[3:6]).max() < 0.01
