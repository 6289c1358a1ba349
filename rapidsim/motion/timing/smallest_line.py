"""Inner loop of timing: the minimum of some lines and a cap, step after step.

    y[k + 1] = max(0, min(cap[k + 1], min over i of slope[k, i] y[k] + offset[k, i]))

Both passes of the solver have this form, so only this needs a faster kernel.
"""

from __future__ import annotations

from itertools import islice

import numpy as np

from rapidsim.frames.transform import Array

_LANE = 64
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

    A line that is above another one, or above the cap, at both ends of the range of y is never
    active: of most steps one line is left.
    """
    largest = np.append(max(first, 0.0), caps[1:-1])[:, None]
    ends = slopes * largest + offsets
    step = np.arange(len(ends))
    lowest, last = offsets.argmin(axis=1), ends.argmin(axis=1)
    others = (ends < ends[step, lowest][:, None]) & (offsets < offsets[step, last][:, None])
    others[step, lowest] = True
    others[step, last] = False
    others &= np.minimum(offsets, ends) < caps[1:, None]
    lines = zip(slopes[others].tolist(), offsets[others].tolist(), strict=True)
    steps = zip(
        slopes[step, last].tolist(),
        offsets[step, last].tolist(),
        caps[1:].tolist(),
        others.sum(axis=1).tolist(),
        strict=True,
    )
    result = [first]
    y = first
    for slope, offset, cap, count in steps:
        reached = slope * y + offset
        # Plain comparisons: a list for `min` would cost twice as much.
        if cap < reached:
            reached = cap
        if count:
            for own_slope, own_offset in islice(lines, count):
                other = own_slope * y + own_offset
                if other < reached:
                    reached = other
        y = 0.0 if reached < 0.0 else reached
        result.append(y)
    return np.array(result)
