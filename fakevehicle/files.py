"""Files as the core sees them: names and bytes that somebody hands in. The core opens nothing.

A `Files` is a read-only tree. The driver brings one over a folder on disk (`fakevehicle.disk`); the vehicle mounts it
beside what it makes itself, such as the parameter file, in one `Tree`. Paths are as clients write them: parts between
slashes, a leading slash or none, ``.`` and empty parts without meaning, ``..`` refused. What follows a ``?`` is a
query, for made files only.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Protocol

MAX_READ = 65_536
"""Most bytes one `read` is asked for."""


@dataclass(frozen=True, slots=True)
class Entry:
    """One name in a folder: its size [bytes] and when it was last written [s, Unix time]; 0 where there is none."""

    name: str
    size: int = 0
    is_dir: bool = False
    time_unix_s: int = 0


class Files(Protocol):
    """A read-only tree of files. No method raises for a path, whatever it is."""

    def listing(self, path: str) -> list[Entry] | None:
        """Everything in a folder, by name; None: there is no such folder."""

    def size(self, path: str) -> int | None:
        """Bytes in a file now; None: there is no such file."""

    def read(self, path: str, offset: int, size: int) -> bytes | None:
        """At most `size` bytes from `offset`, fewer at the end; None: there is no such file."""


class MemoryFiles:
    """Files held in memory, by path; for tests and for vehicles without a disk.

    >>> files = MemoryFiles({"log/a.mcap": b"abc"})
    >>> files.listing("/"), files.read("/log/a.mcap", 1, 9)
    ([Entry(name='log', size=0, is_dir=True, time_unix_s=0)], b'bc')
    """

    def __init__(self, contents: Mapping[str, bytes] | None = None) -> None:
        self.contents = dict(contents or {})

    def listing(self, path: str) -> list[Entry] | None:
        return _listing(parts(path), {name: len(data) for name, data in self.contents.items()})

    def size(self, path: str) -> int | None:
        data = self._find(path)
        return None if data is None else len(data)

    def read(self, path: str, offset: int, size: int) -> bytes | None:
        data = self._find(path)
        return None if data is None else data[offset : offset + size]

    def _find(self, path: str) -> bytes | None:
        split = parts(path)
        return None if split is None else self.contents.get("/".join(split))


@dataclass(frozen=True, slots=True)
class OpenFile:
    """A file that is being read: what it holds does not change while it is open, and its size is fixed.

    Attributes
    ----------
    size : [bytes] as it was when opened.
    fetch : (offset, size) -> bytes, or None when the file has gone since.
    """

    size: int
    fetch: Callable[[int, int], bytes | None]

    def read(self, offset: int, size: int) -> bytes | None:
        """At most `size` bytes from `offset` [bytes], none behind the end; None: it has gone."""
        return self.fetch(offset, max(0, min(size, self.size - offset)))


class Tree:
    """One tree of made files and mounted ones, for the file service.

    Parameters
    ----------
    made : by path: from the query (the text behind a ``?``) to the whole content. Called at each opening.
    mounts : by folder; the same files may be under several.

    Raises
    ------
    ValueError : a name is claimed twice.
    """

    def __init__(
        self, made: Mapping[str, Callable[[str], bytes]] | None = None, mounts: Mapping[str, Files] | None = None
    ) -> None:
        self._made = dict(made or {})
        self._mounts = dict(mounts or {})
        claimed = {path for path in self._made for mount in self._mounts if f"{path}/".startswith(f"{mount}/")}
        if claimed:
            raise ValueError(f"claimed twice: {', '.join(sorted(claimed))}")

    def listing(self, path: str) -> list[Entry] | None:
        """Everything in a folder, by name; None: there is no such folder."""
        split = parts(path)
        mounted = None if split is None else self._mounted(split)
        if mounted is not None:
            files, inner = mounted
            return files.listing(inner)
        folders = {f"{mount}/": 0 for mount in self._mounts}  # a nameless file in each makes it a folder
        return _listing(split, {**dict.fromkeys(self._made), **folders}, self._size_of_made)

    def open(self, path: str) -> OpenFile | None:
        """Open for reading; None: there is no such file."""
        name, _, query = path.partition("?")
        split = parts(name)
        if not split:
            return None
        make = self._made.get("/".join(split))
        if make is not None:
            data = make(query)
            return OpenFile(len(data), lambda offset, size: data[offset : offset + size])
        mounted = self._mounted(split)
        if mounted is None:
            return None
        files, inner = mounted
        size = files.size(inner)
        return None if size is None else OpenFile(size, lambda offset, count: files.read(inner, offset, count))

    def _mounted(self, split: list[str]) -> tuple[Files, str] | None:
        """The mount a path leads into, and the way on from there."""
        for mount, files in self._mounts.items():
            names = mount.split("/")
            if split[: len(names)] == names:
                return files, "/".join(split[len(names) :])
        return None

    def _size_of_made(self, path: str) -> int:
        return len(self._made[path](""))


def parts(path: str) -> list[str] | None:
    """The names in a path, from the root; None for one that leaves its tree.

    >>> parts("/log//./a.mcap"), parts("log/../../etc")
    (['log', 'a.mcap'], None)
    """
    names = [part for part in path.split("/") if part not in ("", ".")]
    return None if ".." in names or "\0" in path else names


def _listing(
    folder: list[str] | None,
    paths: Mapping[str, int | None],
    size_of: Callable[[str], int] = lambda _path: 0,
) -> list[Entry] | None:
    """What lies in a folder of a flat table of paths, by name; a size of None is asked of `size_of`."""
    if folder is None:
        return None
    found: dict[str, Entry] = {}
    for path, size in paths.items():
        names = path.split("/")
        if names[: len(folder)] != folder or len(names) <= len(folder):
            continue
        name = names[len(folder)]
        if len(names) > len(folder) + 1:
            found[name] = Entry(name, is_dir=True)
        else:
            found[name] = Entry(name, size_of(path) if size is None else size)
    if not found and folder:
        return None
    return [found[name] for name in sorted(found)]
