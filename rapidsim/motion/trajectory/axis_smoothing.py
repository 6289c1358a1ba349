"""Smoothing of each axis by itself: the mean of its commanded angle over the window.

What is seen then leaves the path a little: it rounds corners, as recorded arms do. A mean is never
faster and never accelerates more than what it is the mean of, so axes keep the speeds and
accelerations that the command keeps.

The integral is Gauss's, over parts that end where the command changes its acceleration (the nodes
of the timing) and in between every few milliseconds. Windows of neighbouring samples overlap, so
each part is worked out once; the cost is that of the time that all windows cover.
"""

from __future__ import annotations

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.trajectory.command import MotionCommand
from rapidsim.motion.trajectory.filter_windows import Windows

_AT_ONCE = 2_000
"""So many samples share their parts, which bounds the memory."""
_LONGEST_PART_S = 0.016
_PLACES, _WEIGHTS = np.polynomial.legendre.leggauss(3)
_NOTHING_S = 1e-12
"""Parts shorter than this come from rounding."""


def mean_joints(command: MotionCommand, windows: Windows, times: Array) -> tuple[Array, Array]:
    """Visible joints and their rates.

    Args:
        command: At least one piece.
        windows: The width of the smoothing.
        times: Instants (k,) [s], in any order.

    Returns:
        Joints of the arm and external axes (k, n + e) [rad, m], within 1e-9 on the paths of the
        tests, and their rates.
    """
    order = np.argsort(times, kind="stable")
    joints = np.empty((len(times), command.piece(1).path.axis_count))
    rates = np.empty_like(joints)
    for at in np.array_split(order, len(order) // _AT_ONCE + 1):
        now = times[at]
        window, widening, floor = windows.at(now)
        before = np.maximum(now - window, floor)
        new, old = command.joints_at(now), command.joints_at(before)
        mean = _means(command, before, now)
        # Before the earliest instant that counts the arm stood.
        mean = old + ((now - before) / window)[:, None] * (mean - old)
        change = (1.0 - widening)[:, None] * (new - old) + widening[:, None] * (new - mean)
        # Where the command stands all the while, the arm stands there to the last digit.
        still = (command.place_at(now) == command.place_at(before))[:, None]
        joints[at] = np.where(still, new, mean)
        rates[at] = np.where(still, 0.0, change / window[:, None])
    return joints, rates


def _means(command: MotionCommand, before: Array, times: Array) -> Array:
    """Means (k, n + e) of the commanded joints between instants (k,) [s], both ascending."""
    if not len(times):
        return command.joints_at(times)
    nodes = command.nodes_between(before[0], times[-1])
    ends = np.unique(np.concatenate([times, before, nodes]))
    middle = 0.5 * (ends[1:] + ends[:-1])
    # The next window to end covers a part, if any does: windows end in the order they start.
    next_end = np.searchsorted(times, middle)
    covered = np.flatnonzero(next_end < len(times))
    covered = covered[before[next_end[covered]] < middle[covered]]
    covered = covered[np.diff(ends)[covered] > _NOTHING_S]
    if not len(covered):
        return command.joints_at(times)
    width = np.diff(ends)[covered]
    count = np.maximum(np.ceil(width / _LONGEST_PART_S), 1.0).astype(np.int64)
    first = np.cumsum(count) - count
    number = np.arange(count.sum()) - np.repeat(first, count)
    half = np.repeat(0.5 * width / count, count)
    centre = np.repeat(ends[covered], count) + half * (2.0 * number + 1.0)
    joints = command.joints_at((centre[:, None] + half[:, None] * _PLACES).ravel())
    joints = joints.reshape(len(centre), len(_PLACES), -1)
    # Less those at the first place, so that angles that hardly change lose no digits.
    origin = joints[0, 0]
    parts = half[:, None] * np.einsum("kgn,g->kn", joints - origin, _WEIGHTS)
    integral = np.zeros((len(ends), parts.shape[1]))
    np.add.at(integral, np.repeat(covered, count) + 1, parts)
    integral = np.cumsum(integral, axis=0)
    over = integral[np.searchsorted(ends, times)] - integral[np.searchsorted(ends, before)]
    mean: Array = origin + over / np.maximum(times - before, _NOTHING_S)[:, None]
    return mean
