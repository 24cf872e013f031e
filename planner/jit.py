"""The one way a numerical kernel of the planner is compiled.

numba keeps a compiled kernel as long as the file it stands in is unchanged, but a kernel has the kernels it calls
inside it, and those may stand in other files. So `kernel` stamps the cache with the newest change of the package.
"""

from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

from numba import njit

F = TypeVar("F", bound=Callable[..., Any])


def _stamp() -> tuple[float, int]:
    """Newest modification time and total size of the package's modules, as numba's own stamp is (mtime, size)."""
    stats = [file.stat() for file in sorted(Path(__file__).parent.rglob("*.py"))]
    return max(stat.st_mtime for stat in stats), sum(stat.st_size for stat in stats)


_STAMP = _stamp()


def kernel(function: F) -> F:
    """Compile in nopython mode, without the GIL, cached on disk; no fastmath, so results repeat bit for bit."""
    return _compiled(function)


def leaf(function: F) -> F:
    """`kernel` for what makes no arrays and is called often: without counting references to those it is given.

    A call of a dozen arrays counts each of them up and down, atomically, which takes as long as hundreds of additions.
    numba has an option for that without a public name: it refuses to compile what does make an array.
    """
    return _compiled(function, _nrt=False)


def _compiled(function: F, **options: bool) -> F:
    dispatcher = njit(cache=True, nogil=True, **options)(function)
    # numba has no public way to add files to a cache's stamp; a test of this module notices when the name moves.
    dispatcher._cache._cache_file._source_stamp = _STAMP
    return dispatcher  # type: ignore[no-any-return]
