"""A binary heap in two arrays, for the kernels of A* and JPS, and the distance that both are guided by.

`keys` decide, `items` are carried along; the first `size` entries count. Lengths are in cell widths.
"""

import math

import numpy as np

from planner.baselines.grid import IntArray
from planner.bspline import FloatArray
from planner.jit import kernel

FIRST = 4096
"""Entries that a heap has room for at first; it doubles."""
TIE = 1e-9
"""Lengths nearer than this are the same length; and of equal estimates the one further along is looked at first."""
STEPS = (1.0, math.sqrt(2.0), math.sqrt(3.0))
"""Length of a move along one, two and three axes."""


@kernel
def push(keys: FloatArray, items: IntArray, size: int, key: float, item: int) -> tuple[FloatArray, IntArray, int]:
    """Add an entry; the arrays may be new, larger ones."""
    if size == keys.shape[0]:
        keys, items = np.append(keys, np.empty_like(keys)), np.append(items, np.empty_like(items))
    i = size
    while i > 0 and keys[(i - 1) // 2] > key:
        keys[i], items[i] = keys[(i - 1) // 2], items[(i - 1) // 2]
        i = (i - 1) // 2
    keys[i], items[i] = key, item
    return keys, items, size + 1


@kernel
def pop(keys: FloatArray, items: IntArray, size: int) -> int:
    """Take the entry with the least key out: move the last one into its place. Read entry 0 before. The new size."""
    size -= 1
    key, item, i = keys[size], items[size], 0
    while 2 * i + 1 < size:
        child = 2 * i + 1
        if child + 1 < size and keys[child + 1] < keys[child]:
            child += 1
        if keys[child] >= key:
            break
        keys[i], items[i] = keys[child], items[child]
        i = child
    keys[i], items[i] = key, item
    return size


@kernel
def octile(dx: int, dy: int, dz: int) -> float:
    """Length of the shortest way over |dx|, |dy|, |dz| cells when none is blocked."""
    a, b, c = abs(dx), abs(dy), abs(dz)
    least, most = min(a, min(b, c)), max(a, max(b, c))
    between = a + b + c - least - most
    return STEPS[2] * least + STEPS[1] * (between - least) + (most - between)


@kernel
def estimate(cell: int, goal: int, stride_x: int, stride_y: int) -> float:
    """`octile` between two cells given by their flat indices."""
    dx = cell // stride_x - goal // stride_x
    dy = (cell % stride_x) // stride_y - (goal % stride_x) // stride_y
    return octile(dx, dy, cell % stride_y - goal % stride_y)
