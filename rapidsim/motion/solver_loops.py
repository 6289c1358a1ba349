"""The solver's loops over cells, written out to be compiled; see `problem` and `solver`.

Without numba the same is done in columns of NumPy arrays (`problem`) and in lanes (`sweep`).
"""

from __future__ import annotations

import numpy as np

from rapidsim.frames.transform import Array


def widest(slack: Array, tilt: Array, span: Array, largest: float, result: Array) -> None:
    """Fill in the largest x (c,) for which some u keeps every row (c, r) and stays above zero."""
    for k in range(len(span)):
        x = largest
        for i in range(slack.shape[1]):
            for j in range(i + 1, slack.shape[1]):
                room = slack[k, i] + slack[k, j]
                x = min(x, room / max(abs(tilt[k, i] - tilt[k, j]), room / largest))
            falls = span[k] * tilt[k, i] - 1.0
            if falls > 1e-12:
                x = min(x, span[k] * slack[k, i] / falls)
        result[k] = x


def both_passes(
    first: float, slack: Array, tilt: Array, span: Array, steep: float, caps: Array, x: Array
) -> float:
    """Fill in x (c + 1,) from `first` on under caps (c + 1,).

    Returns:
        The largest x at the first node from which the rest can be driven.
    """
    count = len(span)
    x[count] = 0.0
    for k in range(count - 1, -1, -1):
        reached = caps[k]
        for i in range(slack.shape[1]):
            keeps = 1.0 - span[k] * tilt[k, i]
            if keeps > steep:
                reached = min(reached, 1.0 / keeps * x[k + 1] + span[k] * slack[k, i] / keeps)
        x[k] = max(0.0, reached)
    fastest: float = x[0]
    x[0] = first
    for k in range(count):
        reached = x[k + 1]
        for i in range(slack.shape[1]):
            reached = min(reached, (1.0 - span[k] * tilt[k, i]) * x[k] + span[k] * slack[k, i])
        x[k + 1] = max(0.0, reached)
    return fastest


def least_around(times: Array, speeds: Array, window: float, result: Array) -> None:
    """Fill in the least of speeds (k,) [m/s] within a window [s] before and after each.

    Times ascend. One that a slower one follows can be the least of no window that holds both, so
    those that can, kept on a stack, become faster towards its top; once from either side.
    """
    count = len(times)
    stack = np.empty(count, np.int64)
    for direction in (1, -1):
        height = 0
        k = 0 if direction == 1 else count - 1
        for _ in range(count):
            while height > 0 and speeds[stack[height - 1]] >= speeds[k]:
                height -= 1
            stack[height] = k
            height += 1
            edge = times[k] - window if direction == 1 else times[k] + window
            low, high = 0, height - 1
            while low < high:
                middle = (low + high) // 2
                at = times[stack[middle]]
                if (at >= edge) if direction == 1 else (at <= edge):
                    high = middle
                else:
                    low = middle + 1
            least = speeds[stack[low]]
            result[k] = least if direction == 1 else min(least, result[k])
            k += direction


COMPILED = (widest, both_passes, least_around)
"""All functions, each after those that it calls."""
