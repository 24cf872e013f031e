"""How the companion's few numerical kernels are compiled: nopython, without the GIL, cached on disk, no fastmath.

numba keeps a compiled kernel as long as the file it stands in is unchanged; so a kernel here calls only kernels of its
own file (the planner's have `planner.jit`).
"""

from collections.abc import Callable
from typing import Any, TypeVar

from numba import njit

F = TypeVar("F", bound=Callable[..., Any])


def kernel(function: F) -> F:
    """Compile it; results repeat bit for bit."""
    return njit(cache=True, nogil=True)(function)  # type: ignore[no-any-return]
