"""Rows of arrays repeated a number of times each: the loop in a loop of array code."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from rapidsim.frames.transform import Array

Index = npt.NDArray[np.int64]


def repeated(counts: Index) -> tuple[Index, Index]:
    """Return the row (n,) of each repetition, and its number (n,) among those of the row, from 0.

    Args:
        counts: Number of repetitions of each row (k,).
    """
    row = np.repeat(np.arange(len(counts)), counts)
    return row, np.arange(len(row)) - np.repeat(np.cumsum(counts) - counts, counts)


def divided(edges: Array, counts: Index) -> Array:
    """Return edges (k,) with each interval divided into a number (k - 1,) of equal parts."""
    row, number = repeated(counts)
    return np.append(edges[row] + number * (np.diff(edges) / counts)[row], edges[-1])
