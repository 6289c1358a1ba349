"""Seeds of a search for joints: spread evenly over the limits, identical in every run."""

from __future__ import annotations

from math import pi

import numpy as np

from rapidsim.frames.transform import Array

_PRIMES = (2, 3, 5, 7, 11, 13, 17)
MOST_JOINTS = len(_PRIMES)


def spread_starts(lower: Array, upper: Array, count: int) -> Array:
    """Return joint vectors (count, n) [rad] between limits (n,), the middle first.

    Joints without limits, and those with more than one turn to a side, have seeds within one turn:
    beyond it the poses repeat.

    Source:
        Halton (1960), On the efficiency of certain quasi-random sequences of points.
    """
    low, high = np.maximum(lower, -pi), np.minimum(upper, pi)
    # Limits that lie entirely beyond half a turn are kept.
    low, high = np.where(low < high, low, lower), np.where(low < high, high, upper)
    shares = np.array([[_radical_inverse(i, p) for p in _PRIMES] for i in range(count)])
    shares[0] = 0.5
    starts: Array = low + shares[:, : len(low)] * (high - low)
    return starts


def _radical_inverse(number: int, base: int) -> float:
    """Digits of a number mirrored at the point: evenly spread over 0 to 1."""
    inverse, share = 0.0, 1.0 / base
    while number:
        number, digit = divmod(number, base)
        inverse += digit * share
        share /= base
    return inverse
