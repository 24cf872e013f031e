"""The rows of a campaign at any moment: of what is done by now, and of what its last command could not fly."""

from pathlib import Path

from campaigns.flying import FLOWN, Row
from campaigns.store import Store
from campaigns.table import RUNS, whole


def rows_so_far(store: Store) -> list[Row]:
    """In the campaign's order; what is damaged is left out, and its id put to `Store.unreadable`.

    The table is read as far as it goes, since one file is read faster than many, and results for the rest.
    """
    known = {str(row["run_id"]): row for row in _table(store.folder / RUNS)}
    done, rows = store.done(), []
    for run_id in store.run_ids:
        row = known.get(run_id)
        if run_id in done and (row is None or row["status"] != FLOWN):
            found = store.read(run_id)
            row = None if found is None else {**found.row, "recording": store.recording(run_id)}
        if row is not None:
            rows.append(row)
    return rows


def _table(path: Path) -> list[Row]:
    """Of the last command that came to its end; none where there is none that can be read."""
    try:
        from pyarrow import parquet

        rows: list[Row] = parquet.read_table(path).to_pylist()
    except (ImportError, OSError, ValueError):  # pyarrow's errors are ValueErrors
        return []
    return [row for row in rows if whole(row)]
