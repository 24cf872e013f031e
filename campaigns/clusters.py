"""Why flights failed, gathered: causes that differ in numbers and names only are one kind."""

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from campaigns.show import Row, labels, varying

_FIRST_INNOVATION = re.compile(r" \(first innovation refused: [^)]*\)$")
_QUOTED = re.compile(r"'[^']*'|\"[^\"]*\"")
_FILE = re.compile(r"(?<!\S)\.{0,2}/\S+|\S+\.(?:ya?ml|py|mcap|params?)\b")
_NUMBER = re.compile(r"(?<![\w.])[-+−]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")


@dataclass(frozen=True, slots=True)
class Cluster:
    """Failures of one kind.

    Attributes
    ----------
    kind : the cause without its numbers and names.
    example : one cause as it was told.
    run_ids : of all its flights, in the order of the rows.
    common : what all of them share and others do not, by axis; empty for a single one.
    """

    kind: str
    example: str
    run_ids: tuple[str, ...]
    common: dict[str, str]


def kind_of(cause: str) -> str:
    """A cause without its numbers (#) and names (…), and without what an estimator refused along the way."""
    kind = _FIRST_INNOVATION.sub("", cause)
    for pattern, instead in ((_QUOTED, "…"), (_FILE, "…"), (_NUMBER, "#")):
        kind = pattern.sub(instead, kind)
    return kind


def clusters(rows: Sequence[Row]) -> list[Cluster]:
    """The failures among rows by kind, the commonest first; runs that could not be flown are among them."""
    axes = {axis: labels(rows, axis) for axis in varying(rows)}
    members: dict[str, list[int]] = {}
    for i, row in enumerate(rows):
        if not row["ok"]:
            members.setdefault(kind_of(row["cause"]), []).append(i)
    found = []
    for kind, those in members.items():
        shared = {axis: {values[i] for i in those} for axis, values in axes.items()} if len(those) > 1 else {}
        found.append(
            Cluster(
                kind=kind,
                example=Counter(rows[i]["cause"] for i in those).most_common(1)[0][0],
                run_ids=tuple(rows[i]["run_id"] for i in those),
                common={axis: next(iter(values)) for axis, values in shared.items() if len(values) == 1},
            )
        )
    return sorted(found, key=lambda cluster: (-len(cluster.run_ids), cluster.kind))
