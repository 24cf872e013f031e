"""What can go wrong in the vehicle.

VehicleError
├── AirframeError      an airframe file that cannot be used: file, field, found, expected
├── ScenarioError      a scenario file that cannot be used: file, place
├── ParameterFileError a file of parameters that cannot be used: file, line
└── DivergedError      the simulation left the range where its numbers mean anything
"""


class VehicleError(Exception):
    """Root of every error the vehicle raises on purpose."""


class AirframeError(VehicleError):
    """An airframe file cannot be used.

    Attributes
    ----------
    file : the file as it was named.
    field : dotted path of the field, or "" when the file as a whole is meant.
    found, expected : what stood there and what was wanted.
    """

    def __init__(self, file: str, field: str, found: str, expected: str) -> None:
        place = f"{file}: {field}" if field else file
        super().__init__(f"{place}: found {found}, expected {expected}")
        self.file, self.field, self.found, self.expected = file, field, found, expected


class ScenarioError(VehicleError):
    """A scenario file cannot be used.

    Attributes
    ----------
    file : the file as it was named.
    place : dotted path of the entry, or "" when the file as a whole is meant.
    """

    def __init__(self, file: str, place: str, why: str) -> None:
        super().__init__(f"{file}: {place}: {why}" if place else f"{file}: {why}")
        self.file, self.place = file, place


class ParameterFileError(VehicleError):
    """A file of parameters cannot be used.

    Attributes
    ----------
    file : the file as it was named.
    line : from 1; 0 when the file as a whole is meant.
    """

    def __init__(self, file: str, line: int, why: str) -> None:
        super().__init__(f"{file}, line {line}: {why}" if line else f"{file}: {why}")
        self.file, self.line = file, line


class DivergedError(VehicleError):
    """A state became non-finite or absurd.

    Attributes
    ----------
    now_us : when it was seen [us].
    what : which state.
    """

    def __init__(self, now_us: int, what: str) -> None:
        super().__init__(f"simulation diverged at {now_us * 1e-6:.3f} s: {what}")
        self.now_us, self.what = now_us, what
