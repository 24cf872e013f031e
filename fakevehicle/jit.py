"""The one way a numerical kernel of the vehicle is compiled.

numba keeps a compiled kernel as long as the file it stands in is unchanged. A kernel that calls another module's kernel
has that one's code inside it, so the stale copy would survive an edit there. `kernel` therefore stamps the cache with
the newest change of any kernel module, not of its own file only.
"""

from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

from numba import njit

F = TypeVar("F", bound=Callable[..., Any])

_ROOMS = ("physics", "sensors", "control", "estimator")


def _stamp() -> tuple[float, int]:
    """Newest modification time and total size of the modules that hold kernels, as numba's own stamp is (mtime, size)."""
    here = Path(__file__).parent
    files = [here / "tick.py", *(file for room in _ROOMS for file in sorted((here / room).glob("*.py")))]
    stats = [file.stat() for file in files if file.exists()]
    return max(stat.st_mtime for stat in stats), sum(stat.st_size for stat in stats)


_STAMP = _stamp()


def kernel(function: F) -> F:
    """Compile with numba in nopython mode, without the GIL, cached on disk; no fastmath, so results repeat bit for bit."""
    dispatcher = njit(cache=True, nogil=True)(function)
    # numba has no public way to add files to a cache's stamp; the test of this module notices when the name moves.
    dispatcher._cache._cache_file._source_stamp = _STAMP
    return dispatcher  # type: ignore[no-any-return]
