"""The one way a numerical kernel of the vehicle is compiled.

numba keeps a compiled kernel as long as the file it stands in is unchanged. A kernel that calls another module's kernel
has that one's code inside it, so the stale copy would survive an edit there. `kernel` therefore stamps the cache with
the newest change of any kernel module, not of its own file only.
"""

from collections.abc import Callable
from pathlib import Path
from typing import Any

from numba import njit

_ROOMS = ("physics", "sensors", "control", "estimator")


def _stamp() -> tuple[float, int]:
    """Newest change and total size of the modules that hold kernels, in the shape of numba's own stamp."""
    here = Path(__file__).parent
    files = [here / "tick.py", *(file for room in _ROOMS for file in sorted((here / room).glob("*.py")))]
    stats = [file.stat() for file in files if file.exists()]
    return max(stat.st_mtime for stat in stats), sum(stat.st_size for stat in stats)


_STAMP = _stamp()


def kernel(function: Callable[..., Any]) -> Callable[..., Any]:
    """Compile in nopython mode, without the GIL, cached on disk; no fastmath, so that results repeat bit for bit.

    A division by zero gives what IEEE 754 says, not an exception: whoever looks for divergence looks for that.
    """
    dispatcher = njit(cache=True, nogil=True, error_model="numpy")(function)
    # numba has no public way to add files to a cache's stamp; the test of this module notices when the name moves.
    dispatcher._cache._cache_file._source_stamp = _STAMP
    compiled: Callable[..., Any] = dispatcher
    return compiled
