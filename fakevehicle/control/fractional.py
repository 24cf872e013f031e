# mypy: disable-error-code="no-untyped-def"
# kernels: numba types them by their arguments, which the docstrings name
"""The fractional operator s^alpha, |alpha| <= 1, as a chain of first-order filters.

Oustaloup's recursive approximation over [w_b, w_h] with n sections (Oustaloup et al., IEEE TCAS-I 47(1), 2000):

    s^alpha ~ w_h^alpha prod_k (s + z_k) / (s + p_k),   rho = w_h / w_b,
    z_k = w_b rho^((k + (1 - alpha)/2) / n),   p_k = w_b rho^((k + (1 + alpha)/2) / n),   k = 0 .. n-1

each section discretised by Tustin's rule, c = 2/T:  b0 = (c + z)/(c + p),  b1 = (z - c)/(c + p),  a1 = (p - c)/(c + p).
The operator is wanted on [band_low, band_high]; w_b and w_h stand `GUARD` times further out, because the phase at an
edge is wrong by about 57 alpha / guard degrees, while the density of sections sets the ripple.
"""

import math

import numpy as np

from fakevehicle.jit import kernel
from fakevehicle.vocabulary import FloatArray

GUARD = 30.0
DENSITY = 1.5
"""Sections a decade of [w_b, w_h]."""
SECTIONS = 12
"""Room for this many sections in every loop's record."""


def sections(alpha: float, band_low: float, band_high: float, period: float) -> FloatArray:
    """Coefficients of s^alpha on a band.

    Parameters
    ----------
    alpha : order, -1..1.
    band_low, band_high : where the operator is to be accurate [rad/s].
    period : sampling period [s].

    Returns
    -------
    (n, 3) : b0, b1, a1 of each section; the overall gain w_h^alpha is spread over them evenly. (0, 3) when alpha is 0.

    Raises
    ------
    ValueError : an order outside -1..1, a band that is empty or reaches beyond half the sampling rate, or one so wide
        that more than `SECTIONS` sections are needed.
    """
    if not -1.0 <= alpha <= 1.0:
        raise ValueError(f"fractional order {alpha}: expected -1..1")
    if not 0.0 < band_low < band_high < math.pi / period:
        raise ValueError(f"band {band_low}..{band_high} rad/s: expected 0 < low < high < {math.pi / period:g}")
    if alpha == 0.0:
        return np.zeros((0, 3))
    w_b, w_h = band_low / GUARD, band_high * GUARD
    rho = w_h / w_b
    n = math.ceil(DENSITY * math.log10(rho))
    if n > SECTIONS:
        raise ValueError(f"band {band_low}..{band_high} rad/s needs {n} sections, room for {SECTIONS}")
    k = np.arange(n)
    z = w_b * rho ** ((k + (1.0 - alpha) / 2.0) / n)
    p = w_b * rho ** ((k + (1.0 + alpha) / 2.0) / n)
    c = 2.0 / period
    gain = w_h ** (alpha / n)
    return np.stack([gain * (c + z) / (c + p), gain * (z - c) / (c + p), (p - c) / (c + p)], axis=1)


@kernel
def run_sections(coefficients, states, row, count, value):
    """Pass one sample through a chain (transposed direct form II).

    Parameters
    ----------
    coefficients : (rows, SECTIONS, 3) b0, b1, a1.
    states : (rows, SECTIONS), updated in place.
    row : which chain.
    count : how many of its sections are used; 0 is the identity.
    value : the sample.
    """
    for k in range(count):
        out = coefficients[row, k, 0] * value + states[row, k]
        states[row, k] = coefficients[row, k, 1] * value - coefficients[row, k, 2] * out
        value = out
    return value
