"""Whose recording it is, and what came of the flight: tables `run` and `outcome`. A report needs nothing else."""

import json
from dataclasses import asdict
from functools import cache
from importlib import metadata
from pathlib import Path
from typing import Any

from companion.core import Companion
from companion.meter import FlightMeter
from companion.mission import Expect
from companion.verdict import Verdict, checks, judge
from logs.recorder import Recorder

RUN, OUTCOME = "run", "outcome"
DISTRIBUTION = "mavlink-companion"
MOST_HEAD = 200_000
"""Bytes of git's list of references."""


def run_table(companion: Companion, clock: str, endpoints: dict[str, str]) -> dict[str, str]:
    """Version, git revision where there is one, seed, mission, endpoints, and the clock of the times.

    Parameters
    ----------
    clock : "unix" (since 1970), or "lockstep" (simulated, from 0).
    """
    table = {"version": version(), "revision": revision(Path(__file__).resolve().parents[2])}
    table |= {"mission": companion.mission.name, "seed": str(companion.config.seed), "clock": clock}
    table |= {"endpoints": ", ".join(f"{name} {url}" for name, url in endpoints.items())}
    return {key: value for key, value in table.items() if value}


def conclude(recorder: Recorder, companion: Companion, meter: FlightMeter, beside_m: float | None = None) -> None:
    """Put the verdict into the recording; `beside_m` as in `judge`."""
    recorder.metadata(OUTCOME, outcome_table(judge(companion, meter, beside_m), companion.mission.expect))


def outcome_table(verdict: Verdict, expect: Expect) -> dict[str, str]:
    """The verdict as JSON under the key `json`, with `checks`: name, value, expected, ok."""
    values: dict[str, Any] = {
        name: getattr(verdict, name) for name in Verdict.__dataclass_fields__ if name not in ("track", "seed")
    }
    values["checks"] = [asdict(check) for check in checks(verdict, expect)]
    return {"json": json.dumps(_finite(values), sort_keys=True, allow_nan=False)}


def _finite(value: Any) -> Any:
    """The same without what JSON cannot hold, to a millionth."""
    if isinstance(value, float):
        return round(value, 6) if abs(value) < float("inf") else None
    if isinstance(value, dict):
        return {key: _finite(item) for key, item in value.items()}
    return [_finite(item) for item in value] if isinstance(value, list) else value


@cache
def version() -> str:
    """Ours; empty where it was not installed."""
    try:
        return metadata.version(DISTRIBUTION)
    except metadata.PackageNotFoundError:
        return ""


@cache
def revision(folder: Path) -> str:
    """The commit that a folder's git says it is at, twelve digits; empty where there is none. Nothing is run for it."""
    try:
        git = folder / ".git"
        if git.is_file():  # a second working tree
            git = (folder / git.read_text().removeprefix("gitdir:").strip()).resolve()
        head = (git / "HEAD").read_text().strip()
        name = head.removeprefix("ref:").strip()
        if name != head:
            common = git / "commondir"
            base = (git / common.read_text().strip()).resolve() if common.is_file() else git
            head = _reference(base, name)
        return head[:12] if len(head) >= 40 and set(head) <= set("0123456789abcdef") else ""
    except (OSError, UnicodeDecodeError):
        return ""


def _reference(git: Path, name: str) -> str:
    """The commit of a branch, in a file of its own or in the list of packed ones."""
    loose = git / name
    if loose.is_file():
        return loose.read_text().strip()
    packed = (git / "packed-refs").read_text()[:MOST_HEAD].splitlines()
    return next((line.split()[0] for line in packed if line.endswith(f" {name}")), "")
