"""Parameters that somebody asks for, from files and one by one, as a vehicle of a flavour takes them."""

import difflib
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from fakevehicle.config import Autopilot
from fakevehicle.flavours import flavour_of
from fakevehicle.param_file import ParameterFile, load_parameter_file
from fakevehicle.params import Parameter, ParameterSet
from fakevehicle.vehicle import PARAMETERS, READ_ONLY


class Noted(ParameterSet):
    """Parameters that remember which were set: also to the default, which a preset may have changed."""

    def __init__(self, parameters: Iterable[Parameter], overrides: Mapping[str, float]) -> None:
        self.touched: set[str] = set()
        super().__init__(parameters, overrides)

    def set(self, name: str, value: float) -> None:
        super().set(name, value)
        self.touched.add(name)


def known_parameters(autopilot: Autopilot) -> tuple[Noted, ParameterSet]:
    """The parameters of a flavour under our names, and the same under its names."""
    flavour = flavour_of(autopilot)
    whole = Noted((*PARAMETERS, *flavour.parameters), flavour.defaults)
    return whole, flavour.named(whole)


def parameters_of(
    paths: Sequence[Path], texts: Sequence[str], autopilot: Autopilot
) -> tuple[dict[str, float], list[ParameterFile]]:
    """What files, in their order, and then texts set, under our names; and the files.

    Parameters
    ----------
    paths : as `load_parameter_file` reads them.
    texts : NAME=VALUE, under the flavour's names.

    Raises
    ------
    ParameterFileError : of a file.
    ValueError : a text is not of that form, its name does not exist or is fixed, or its value cannot be.
    """
    whole, named = known_parameters(autopilot)
    whole.touched.clear()
    files = [load_parameter_file(path, named, READ_ONLY) for path in paths]
    asked = [item for file in files for item in file.values.items()] + [_parameter(text, named) for text in texts]
    for name, value in asked:
        named.set(name, value)
    return {name: whole[name] for name in sorted(whole.touched)}, files


def _parameter(text: str, known: ParameterSet) -> tuple[str, float]:
    """Name and value; the name must exist."""
    name, separator, value = text.partition("=")
    if not separator:
        raise ValueError(f"{text}: expected NAME=VALUE")
    if name not in known:
        near = difflib.get_close_matches(name, known, n=1)
        raise ValueError(f"{text}: no parameter {name}" + (f", did you mean {near[0]}?" if near else ""))
    if name in READ_ONLY:
        raise ValueError(f"{text}: fixed at the start, by --instance")
    try:
        return name, float(known.describe(name).coerced(float(value)))
    except ValueError as error:
        raise ValueError(f"{text}: {error}") from error
