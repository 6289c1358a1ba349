"""Loops of the solver over cells, for compilation; see `stages` and `two_pass`.

Without numba, operations on columns of NumPy arrays (`stages`) and on lanes (`smallest_line`) are
used instead.
"""

from __future__ import annotations

from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.curves import Index

_NEARLY = 1.0 + 1e-9
"""Factor that covers rounding where a result is compared before it is computed."""


def parabola(start: float, middle: float, end: float, share: float) -> float:
    """Return the value at a share of a cell; see `stages.weights_of`."""
    rest = 1.0 - share
    return (
        start * (rest * (1.0 - 2.0 * share))
        + middle * (4.0 * share * rest)
        + end * (share * (2.0 * share - 1.0))
    )


def limit_stages(
    rows: tuple[Index, Array, Array],
    parts: tuple[Index, Array, Array, Array],
    which: tuple[float, Index],
    limits: tuple[Array, Array, Array],
) -> None:
    """Fill in slack and tilt (m, 2 r) and widest (m,) of some stages (j,); see `stages`.

    Args:
        rows: Points (c, 3) of the cells, slopes and bends (k, r) at the points.
        parts: The cells (j,) of the stages, their start and end within the cells, and span.
        which: An x that is never reached; and the indices of the stages among all (m,).
        limits: Slack, tilt and widest, filled in.
    """
    at, slopes, bends = rows
    cell, begin, end, span = parts
    largest, new = which
    slack, tilt, widest = limits
    own = slopes.shape[1]
    for j in range(len(new)):
        k = new[j]
        a, b, c = at[cell[j], 0], at[cell[j], 1], at[cell[j], 2]
        steepest = 0.0
        for i in range(own):
            first = parabola(slopes[a, i], slopes[b, i], slopes[c, i], begin[j])
            last = parabola(slopes[a, i], slopes[b, i], slopes[c, i], end[j])
            tilt[k, i] = parabola(bends[a, i], bends[b, i], bends[c, i], begin[j])
            tilt[k, own + i] = parabola(bends[a, i], bends[b, i], bends[c, i], end[j])
            slack[k, i], slack[k, own + i] = first, last + span[j] * tilt[k, own + i]
            steepest = max(steepest, abs(first), abs(slack[k, own + i]))
        for i in range(2 * own):
            least = 1e-9 * (steepest + span[j] * abs(tilt[k, i])) + 1e-300
            inverse = 1.0 / (slack[k, i] if abs(slack[k, i]) > least else least)
            slack[k, i], tilt[k, i] = abs(inverse), tilt[k, i] * inverse
        widest[k] = widest_of(slack[k], tilt[k], span[j], largest)


def widest_of(slack: Array, tilt: Array, span: float, largest: float) -> float:
    """Return the largest x for which some u keeps every row (r,) and stays above zero."""
    x = largest
    while True:
        above, below = 0, 0
        for i in range(1, len(slack)):
            if slack[i] - tilt[i] * x < slack[above] - tilt[above] * x:
                above = i
            if slack[i] + tilt[i] * x < slack[below] + tilt[below] * x:
                below = i
        room = slack[above] + slack[below]
        crossing = room / max(tilt[above] - tilt[below], room / largest)
        if not crossing < x:
            break
        x = crossing
    for i in range(len(slack)):
        falls = span * tilt[i] - 1.0
        if falls > 1e-12:
            x = min(x, span * slack[i] / falls)
    return x


def both_passes(
    first: float, slack: Array, tilt: Array, span: Array, steep: float, caps: Array, x: Array
) -> float:
    """Fill in x (c + 1,) from `first` on under caps (c + 1,).

    Returns:
        The largest x at the first node from which the rest is feasible.
    """
    count = len(span)
    x[count] = 0.0
    for k in range(count - 1, -1, -1):
        reached = caps[k]
        for i in range(slack.shape[1]):
            keeps = 1.0 - span[k] * tilt[k, i]
            # Divide only where that can be the smallest.
            if keeps > steep and x[k + 1] + span[k] * slack[k, i] < keeps * reached * _NEARLY:
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


def load_stages(
    rows: tuple[Index, Array, Array],
    cell: Index,
    middle: Array,
    u: Array,
    square: Array,
    load: Array,
) -> None:
    """Fill in the most constraining share (m,) of an acceleration in mid-stage; see `loads`."""
    at, slopes, bends = rows
    for k in range(len(cell)):
        a, b, c = at[cell[k], 0], at[cell[k], 1], at[cell[k], 2]
        largest = 0.0
        for i in range(slopes.shape[1]):
            slope = parabola(slopes[a, i], slopes[b, i], slopes[c, i], middle[k])
            bend = parabola(bends[a, i], bends[b, i], bends[c, i], middle[k])
            largest = max(largest, abs(slope * u[k] + bend * square[k]))
        load[k] = largest


def fast_stages(
    at: Index, slowness: Array, cell: Index, begin: Array, end: Array, speeds: Array
) -> None:
    """Fill in maximum speeds (m, 3) [m/s] at start, middle and end of stages; see `fastest`."""
    for k in range(len(cell)):
        a, b, c = at[cell[k], 0], at[cell[k], 1], at[cell[k], 2]
        start, middle, last = slowness[a], slowness[b], slowness[c]
        for i in range(3):
            share = begin[k] if i == 0 else end[k] if i == 2 else 0.5 * (begin[k] + end[k])
            of_end = max(2.0 * share - 1.0, 0.0)
            of_middle = 2.0 * (share - of_end)
            straight = start * (1.0 - of_middle - of_end) + middle * of_middle + last * of_end
            speeds[k, i] = 1.0 / max(parabola(start, middle, last, share), straight)


COMPILED = (
    parabola,
    widest_of,
    limit_stages,
    both_passes,
    load_stages,
    fast_stages,
)
"""All functions, each after its callees."""
