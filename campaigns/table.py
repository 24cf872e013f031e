"""The tables of a campaign: `runs.parquet`, what came of each run, and `costs.parquet`, what it took.

The first holds nothing but what the runs decide, so that the same campaign is the same file, byte for byte, however and
in how many pieces it was flown. Wants the package pyarrow.
"""

import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from campaigns.errors import CampaignError
from campaigns.flying import FIGURES

RUNS, COSTS = "runs.parquet", "costs.parquet"
WORDS = (
    *("run_id", "mission", "mission_sha", "family", "autopilot", "gusts", "faults", "link", "airframe", "gains"),
    *("method", "status", "phase", "failure", "cause", "innovation", "recording"),
)
NUMBERS = ("wind_north", "wind_east", *FIGURES)
COLUMNS = (
    *("run_id", "mission", "mission_sha", "family", "world_seed", "autopilot", "seed", "wind_north", "wind_east"),
    *("gusts", "faults", "link", "airframe", "gains", "method", "status", "ok", "phase", "failure", "cause"),
    *FIGURES,
    *("innovation", "recording"),
)
COST_COLUMNS = {"run_id": "string", "cpu_s": "double", "wall_s": "double", "host": "string", "attempts": "int32"}
WANTED = "Parquet wants the package pyarrow: pip install 'mavlink-companion[parquet]'"


def check_parquet(folder: Path) -> None:
    """Before anything is flown.

    Raises
    ------
    CampaignError : pyarrow is not installed.
    """
    _arrow(folder)


def write_tables(folder: Path, rows: Iterable[Mapping[str, Any]], costs: Iterable[Mapping[str, Any]]) -> None:
    """Write both, each whole or not at all.

    Parameters
    ----------
    rows : with every one of COLUMNS, in the order in which they are to be.
    costs : with every one of COST_COLUMNS.

    Raises
    ------
    CampaignError : pyarrow is not installed.
    OSError : they cannot be written.
    """
    arrow = _arrow(folder)
    types = {name: arrow.string() for name in WORDS} | {name: arrow.float64() for name in NUMBERS}
    types |= {"ok": arrow.bool_(), "seed": arrow.int64(), "world_seed": arrow.int64()}
    _write(arrow, folder / RUNS, rows, {name: types[name] for name in COLUMNS})
    _write(arrow, folder / COSTS, costs, {name: arrow.type_for_alias(kind) for name, kind in COST_COLUMNS.items()})


def whole(row: Mapping[str, Any]) -> bool:
    """Whether it has every column, each of its kind."""
    if not row.keys() >= set(COLUMNS) or not isinstance(row["ok"], bool):
        return False
    words, numbers = (row[name] for name in WORDS), (row[name] for name in NUMBERS)
    return all(isinstance(v, str) for v in words) and all(v is None or isinstance(v, float | int) for v in numbers)


def _write(arrow: Any, path: Path, rows: Iterable[Mapping[str, Any]], types: Mapping[str, Any]) -> None:
    from pyarrow import parquet

    lines = list(rows)
    schema = arrow.schema(list(types.items()))
    columns = [arrow.array([line[name] for line in lines], kind) for name, kind in types.items()]
    partial = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        parquet.write_table(arrow.Table.from_arrays(columns, schema=schema), partial, compression="zstd")
        os.replace(partial, path)
    finally:
        partial.unlink(missing_ok=True)


def _arrow(folder: Path) -> Any:
    try:
        import pyarrow
        import pyarrow.parquet
    except ImportError as error:
        raise CampaignError(f"{folder}: {WANTED}") from error
    return pyarrow
