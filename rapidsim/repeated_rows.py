"""Rows of arrays repeated a number of times each: the loop in a loop of array code."""

from __future__ import annotations

from typing import TypeVar

import numpy as np
import numpy.typing as npt

from rapidsim.frames.transform import Array

Index = npt.NDArray[np.int64]
Values = TypeVar("Values", bound=np.generic)

_MANY = 500
"""Number of rows from which on it pays to look whether they are equal."""


def repeated(counts: Index) -> tuple[Index, Index]:
    """Return the row (n,) of each repetition, and its number (n,) among those of the row, from 0.

    Args:
        counts: Number of repetitions of each row (k,).
    """
    row = np.repeat(np.arange(len(counts)), counts)
    return row, np.arange(len(row)) - np.repeat(np.cumsum(counts) - counts, counts)


def shared_row(rows: npt.NDArray[Values]) -> npt.NDArray[Values]:
    """Return many equal rows (k, ...) as views of the first, read-only; else the rows themselves.

    They are compared by their bits, because 0 and -0 are equal but not identical.
    """
    if len(rows) < _MANY or not rows.flags.c_contiguous:
        return rows
    bits = rows.view(np.uint8).reshape(len(rows), -1)
    return np.broadcast_to(rows[:1].copy(), rows.shape) if (bits == bits[0]).all() else rows


def divided(edges: Array, counts: Index) -> Array:
    """Return edges (k,) with each interval divided into a number (k - 1,) of equal parts."""
    row, number = repeated(counts)
    return np.append(edges[row] + number * (np.diff(edges) / counts)[row], edges[-1])
