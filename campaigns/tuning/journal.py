"""The folder of a tuning: every evaluation on disk as soon as it is known, so that nothing is flown twice.

    tune.json           what is tuned: the specification and the method
    evaluations.jsonl   a line for each candidate: its key, parameters and parts

A search is deterministic, so it is continued by running it again: what has been flown is read instead, as long as the
sources that fly are the same. A line is
written whole and brought to the disk; one cut short, by a kill or a full disk, is taken away at the next start.
"""

import hashlib
import json
import math
import os
from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

from campaigns.tuning.cost import Parts
from companion.errors import CompanionError

HEADER, LINES = "tune.json", "evaluations.jsonl"


def key(digest: str, values: Mapping[str, float]) -> str:
    """Of one candidate: the digest of its tuning and its parameters, as they are stored in the vehicle."""
    told = json.dumps([digest, sorted(values.items())])
    return hashlib.sha256(told.encode()).hexdigest()[:24]


class Journal:
    """Of one folder.

    Parameters
    ----------
    folder : made when it is not there.
    about : what is tuned; a folder belongs to one of them.
    resume : go on with what is there.

    Raises
    ------
    CompanionError : the folder has another tuning's evaluations, or some and `resume` is not given, or cannot be used.
    """

    def __init__(self, folder: Path, about: Mapping[str, Any], *, resume: bool) -> None:
        self.folder, self._lines = folder, folder / LINES
        self._known: dict[str, Parts] = {}
        header = folder / HEADER
        try:
            folder.mkdir(parents=True, exist_ok=True)
            if header.exists():
                _same(header, about)
                if not resume and self._lines.exists():
                    raise CompanionError(f"{folder}: has evaluations already; --resume goes on with them")
            else:
                if self._lines.exists():
                    raise CompanionError(f"{folder}: has {LINES} but no {HEADER}, expected both or none")
                write_whole(header, json.dumps(dict(about), indent=1, sort_keys=True) + "\n")
            self._read()
        except OSError as error:
            raise CompanionError(f"{folder}: {error.strerror or error}") from error

    def __len__(self) -> int:
        return len(self._known)

    def get(self, name: str) -> Parts | None:
        """What is known of a candidate by its key."""
        return self._known.get(name)

    def put(self, name: str, values: Mapping[str, float], parts: Parts) -> None:
        """Keep an evaluation.

        Raises
        ------
        CompanionError : the disk is full or gone; what was kept before stays.
        """
        told = {k: None if isinstance(v, float) and math.isinf(v) else v for k, v in asdict(parts).items()}
        line = json.dumps({"key": name, "values": dict(values), "parts": told}) + "\n"
        try:
            with self._lines.open("ab") as file:
                file.write(line.encode())
                file.flush()
                os.fsync(file.fileno())
        except OSError as error:
            raise CompanionError(f"{self._lines}: {error.strerror or error}; --resume goes on from here") from error
        self._known[name] = parts

    def _read(self) -> None:
        """Take in what is there, and cut off what is no whole line."""
        if not self._lines.exists():
            return
        data = self._lines.read_bytes()
        whole = data[: data.rfind(b"\n") + 1]
        for number, line in enumerate(whole.splitlines(), start=1):
            try:
                entry = json.loads(line)
                told: dict[str, Any] = {k: math.inf if v is None else v for k, v in entry["parts"].items()}
                self._known[str(entry["key"])] = Parts(**told)
            except (ValueError, KeyError, TypeError, AttributeError) as error:
                raise CompanionError(f"{self._lines}: line {number}: found no evaluation, expected one") from error
        if len(whole) < len(data):
            with self._lines.open("r+b") as file:
                file.truncate(len(whole))


def _same(header: Path, about: Mapping[str, Any]) -> None:
    """Refuse a folder of something else."""
    try:
        there = json.loads(header.read_text("utf-8"))
    except ValueError as error:
        raise CompanionError(f"{header}: found no JSON, expected what is tuned here") from error
    there = there if isinstance(there, dict) else {}
    for name, value in about.items():
        if there.get(name) != value:
            raise CompanionError(f"{header}: found other {name} than this tuning's, expected a folder of its own")


def write_whole(path: Path, text: str) -> None:
    """Write a file that is there as a whole or not at all."""
    part = path.with_name(path.name + ".part")
    with part.open("w", encoding="utf-8") as file:
        file.write(text)
        file.flush()
        os.fsync(file.fileno())
    part.replace(path)
