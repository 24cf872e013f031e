"""Work that is kept as it is done: a stage is one function of many items, each item's result a file of its own.

A result's name is the hash of its stage, its item and the sources that made it, so that an interrupted run goes on
where it was, a changed item is done anew, and so is everything after a change of the code. A file is written beside its
place and then renamed: it is whole or not there.
"""

import hashlib
import importlib.util
import json
import os
from collections.abc import Callable, Iterable
from contextlib import suppress
from dataclasses import asdict, dataclass, is_dataclass
from functools import cache
from pathlib import Path
from typing import Any, Protocol

from campaigns.executors import Executor
from companion.errors import CompanionError

RETRIES = 2
"""How often an item is tried again whose worker was lost."""
Result = Any
"""What JSON can hold."""


class Progress(Protocol):
    """Hears how far it is."""

    def begin(self, stage: str, items: int, kept: int) -> None:
        """A stage begins; so many of its items were done before."""
        ...

    def done(self) -> None:
        """One item of it is done."""
        ...


@dataclass(frozen=True, slots=True)
class Stage:
    """One function of many items.

    Attributes
    ----------
    name : for people, and the folder of its results.
    work : of an item, at the top of a module; its result is what JSON can hold.
    items : frozen dataclasses, each another.
    packages : whose sources decide the result, beside the module of `work`.
    """

    name: str
    work: Callable[..., Result]
    items: tuple[Any, ...]
    packages: tuple[str, ...]


class Kept:
    """Results in a folder.

    Parameters
    ----------
    folder : made when something is kept.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def file(self, stage: Stage, item: Any) -> Path:
        """Where the result of an item is, or will be."""
        name = {"stage": stage.name, "item": plain(item), "sources": sources(*stage.packages, stage.work.__module__)}
        digest = hashlib.sha256(json.dumps(name, sort_keys=True).encode()).hexdigest()
        return self._folder / stage.name / f"{digest[:24]}.json"

    def get(self, stage: Stage, item: Any) -> Result | None:
        """The result, or None; what is no JSON any more is as if it was not there."""
        try:
            return json.loads(self.file(stage, item).read_text(encoding="utf-8"))
        except (FileNotFoundError, ValueError):
            return None
        except OSError as error:
            raise file_error(self.file(stage, item), error) from error

    def put(self, stage: Stage, item: Any, result: Result) -> None:
        """Keep one."""
        write(self.file(stage, item), json.dumps(result, allow_nan=False))


def run(stage: Stage, kept: Kept, executor: Executor, progress: Progress) -> list[Result]:
    """The results of a stage in the order of its items; those kept before are not done again.

    Raises
    ------
    CompanionError : work failed, its worker was lost again and again, or a result cannot be kept.
    """
    results = {k: kept.get(stage, item) for k, item in enumerate(stage.items)}
    missing = [k for k, result in results.items() if result is None]
    progress.begin(stage.name, len(results), len(results) - len(missing))
    numbers = {stage.items[k]: k for k in missing}
    for outcome in executor.map(stage.work, list(numbers), retries=RETRIES):
        trouble = outcome.error or outcome.infrastructure
        if trouble:
            raise CompanionError(f"{stage.name}: {outcome.item}: {trouble}")
        kept.put(stage, outcome.item, outcome.result)
        results[numbers[outcome.item]] = outcome.result
        progress.done()
    return list(results.values())


def whole(stage: Stage, work: Callable[[Any], Result], steps: int, kept: Kept, progress: Progress) -> Result:
    """The result of a stage of one item, whose `work` (the stage's own, with what it needs) has its own workers.

    Parameters
    ----------
    steps : of its work, for the progress, which the work itself tells.
    """
    (item,) = stage.items
    result = kept.get(stage, item)
    progress.begin(stage.name, steps, 0 if result is None else steps)
    if result is None:
        result = work(item)
        kept.put(stage, item, result)
    return result


def plain(item: Any) -> Any:
    """A dataclass as what JSON can hold, with its kind."""
    return {"kind": type(item).__name__, **asdict(item)} if is_dataclass(item) and not isinstance(item, type) else item


@cache
def sources(*modules: str) -> str:
    """Hash of the Python sources of packages (all that is in them) and modules, as they are now."""
    digest = hashlib.sha256()
    for name in modules:
        spec = importlib.util.find_spec(name)
        assert spec is not None, name
        places = [Path(p) for p in spec.submodule_search_locations or ()]
        files: Iterable[Path] = (
            sorted(f for p in places for f in p.rglob("*.py")) if places else [Path(spec.origin or "")]
        )
        for file in files:
            digest.update(f"{name} {file.name}\n".encode())
            digest.update(file.read_bytes())
    return digest.hexdigest()


def write(file: Path, text: str) -> None:
    """Write a file, whole or not at all.

    Raises
    ------
    CompanionError : it cannot be written, and why.
    """
    beside = file.with_name(f".{file.name}.{os.getpid()}")
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        beside.write_text(text, encoding="utf-8")
        beside.replace(file)
    except OSError as error:
        with suppress(OSError):
            beside.unlink()
        raise file_error(file, error) from error


def file_error(file: Path, error: OSError) -> CompanionError:
    """What is said of a file that cannot be read or written."""
    return CompanionError(f"{file}: {error.strerror or error}")
