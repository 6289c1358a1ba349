"""Vectors as tuples of three: of floats, or of columns of any length."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:  # The library computes with floats and starts without NumPy.
    from rapidsim.frames.transform import Array

Number = TypeVar("Number", float, "Array")
Three = tuple[Number, Number, Number]


def plus(a: Three[Number], b: Three[Number]) -> Three[Number]:
    """Return a + b."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def minus(a: Three[Number], b: Three[Number]) -> Three[Number]:
    """Return a - b."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def scaled(a: Three[Number], factor: Number) -> Three[Number]:
    """Return a times a number."""
    return a[0] * factor, a[1] * factor, a[2] * factor


def dot(a: Three[Number], b: Three[Number]) -> Number:
    """Return a . b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def crossed(a: Three[Number], b: Three[Number]) -> Three[Number]:
    """Return a x b."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def length(a: Three[float]) -> float:
    """Return |a|."""
    return math.sqrt(dot(a, a))
