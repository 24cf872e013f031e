"""Errors of `logs`.

LogsError
├── RecordingError         a recording cannot be read or written
└── SchemaVersionError     it was written by a newer version of our schemas
"""


class LogsError(Exception):
    """Root of every error raised by `logs`."""


class RecordingError(LogsError):
    """A recording cannot be read or written; one line that names the file and what is wrong.

    Attributes
    ----------
    path : the file, as it was given.
    reason : what is wrong with it.
    """

    def __init__(self, path: object, reason: str) -> None:
        super().__init__(f"{path}: {reason}")
        self.path = path
        self.reason = reason


class SchemaVersionError(LogsError):
    """The recording's schemas are newer than the ones known here."""

    def __init__(self, path: object, found: str, supported: int) -> None:
        super().__init__(f"{path}: schema version {found}; this version reads 1 to {supported}")
        self.path = path
        self.found = found
        self.supported = supported
