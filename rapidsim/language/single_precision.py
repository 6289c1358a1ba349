"""RAPID's `num`: a single-precision number, stored in a Python float.

Source: IEEE 754 binary32; the splitting constant is Veltkamp's, 2**29 + 1, which keeps the 24 of
the 53 bits of a double that a single has, rounded to nearest, ties to even.
"""

from __future__ import annotations

from typing import Final

from rapidsim.language.error_numbers import ERR_OVERFLOW, rapid_error

LARGEST_SINGLE: Final = 3.4028234663852886e38
LARGEST_EXACT_INTEGER: Final = 8388608.0
"""2**23: the controller counts and converts whole `num` numbers up to here."""
SPLIT: Final = 536870913.0


def single(x: float) -> float:
    """The nearest single-precision number.

    Raises:
        RapidError: ERR_OVERFLOW, if it is not finite or beyond the range of `num`.
    """
    if not -LARGEST_SINGLE <= x <= LARGEST_SINGLE:
        raise rapid_error(
            ERR_OVERFLOW, f"the result {x:g} is beyond the range of num, ±3.40282E+38"
        )
    return nearest_single(x)


def nearest_single(x: float) -> float:
    """The nearest single-precision number, without the check of the range."""
    t = x * SPLIT
    return t - (t - x)
