"""What can go wrong for the caller.

CompanionError
├── MissionError    a mission file that cannot be read or does not say what it must (file, where, found, expected)
├── ConfigError     a configuration of the service that says something else than it must
├── LinkError       no port, no vehicle, or no vehicle any more
└── RerunError      a recording that cannot be re-run (not one of ours, or incomplete where it matters)

What a peer does wrong is never an exception: it is counted, noted, or answered (see `companion.core`).
"""


class CompanionError(Exception):
    """Root of everything the companion raises; its text is one line for a person."""


class MissionError(CompanionError):
    """A mission file is unreadable or invalid.

    Attributes
    ----------
    file : the path as given.
    problems : one line each, `line N: key: found ..., expected ...`.
    """

    def __init__(self, file: str, problems: list[str]) -> None:
        self.file = file
        self.problems = problems
        super().__init__("\n".join(f"{file}: {problem}" for problem in problems))

    def __reduce__(self) -> tuple[type, tuple[str, list[str]]]:  # so that it comes whole out of another process
        return type(self), (self.file, self.problems)


class ConfigError(CompanionError):
    """The configuration of the service is unreadable or invalid; fields as in `MissionError`."""

    def __init__(self, file: str, problems: list[str]) -> None:
        self.file = file
        self.problems = problems
        super().__init__("\n".join(f"{file}: {problem}" for problem in problems))

    def __reduce__(self) -> tuple[type, tuple[str, list[str]]]:  # so that it comes whole out of another process
        return type(self), (self.file, self.problems)


class LinkError(CompanionError):
    """The link to the vehicle cannot be opened, or nobody answers on it."""


class RerunError(CompanionError):
    """A recording does not hold what a re-run needs."""
