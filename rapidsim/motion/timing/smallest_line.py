"""Inner loop of timing: the minimum of some lines and a cap, step after step.

    y[k + 1] = max(0, min(cap[k + 1], min over i of slope[k, i] y[k] + offset[k, i]))

Both passes of the solver have this form, so only this needs a faster kernel.
"""

from __future__ import annotations

from itertools import islice

import numpy as np

from rapidsim.frames.transform import Array

_LANE = 256
_WORTH_LANES = 1024


def sweep(first: float, slopes: Array, offsets: Array, caps: Array) -> Array:
    """Run the recurrence.

    Args:
        first: y[0].
        slopes: Shape (k, r).
        offsets: Shape (k, r).
        caps: Shape (k + 1,); caps[0] is not applied. No result is negative.

    Returns:
        y, shape (k + 1,).
    """
    count = len(slopes)
    if count < _WORTH_LANES:
        return _one_by_one(first, slopes, offsets, caps)
    # Long rows are cut into lanes that run in parallel. The entry of a lane is first assumed to be
    # its cap, then it is the exit of the previous lane, until no entry changes: then the result
    # equals that of one lane. At every active cap a lane becomes independent of its entry, so few
    # rounds suffice.
    lanes = -(-count // _LANE)
    padding = lanes * _LANE - count
    rows = slopes.shape[1]
    a = np.concatenate([slopes, np.ones((padding, rows))]).reshape(lanes, _LANE, rows)
    b = np.concatenate([offsets, np.zeros((padding, rows))]).reshape(lanes, _LANE, rows)
    cap = np.concatenate([caps[1:], np.full(padding, np.inf)]).reshape(lanes, _LANE)
    entry = np.concatenate([[first], cap[:-1, -1]])
    y = np.empty((lanes, _LANE))
    changed = np.arange(lanes)
    while len(changed):
        now = entry[changed]
        for k in range(_LANE):
            now = np.minimum((a[changed, k] * now[:, None] + b[changed, k]).min(axis=1), 1e300)
            now = np.maximum(np.minimum(now, cap[changed, k]), 0.0)
            y[changed, k] = now
        exits = np.concatenate([[first], y[:-1, -1]])
        changed = np.flatnonzero(exits != entry)
        entry = exits
    return np.concatenate([[first], y.ravel()[:count]])


def _one_by_one(first: float, slopes: Array, offsets: Array, caps: Array) -> Array:
    """Run the recurrence step by step, for short rows.

    Lines above the cap at both ends of the range of y are never active; most are.
    """
    largest = np.append(max(first, 0.0), caps[1:-1])[:, None]
    met = np.minimum(offsets, slopes * largest + offsets) < caps[1:, None]
    lines = zip(slopes[met].tolist(), offsets[met].tolist(), strict=True)
    result = [first]
    y = first
    for count, cap in zip(met.sum(axis=1).tolist(), caps[1:].tolist(), strict=True):
        reached = cap
        # Plain comparisons: a list for `min` would cost twice as much.
        for slope, offset in islice(lines, count):
            other = slope * y + offset
            if other < reached:
                reached = other
        y = 0.0 if reached < 0.0 else reached
        result.append(y)
    return np.array(result)
