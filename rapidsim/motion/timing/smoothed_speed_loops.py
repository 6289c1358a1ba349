"""Loop of `smoothed_speed_limits` for compilation; without it, columns are used."""

from __future__ import annotations

from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.curves import Index


def keep_below_lines(
    bounded: Array,
    places: Array,
    speeds: Array,
    slopes: Array,
    at: Index,
    first: Index,
    after: Index,
) -> None:
    """Lower speeds (k,) [m/s] to the lines through some of them (j,), each from first to after.

    Args:
        bounded: Shape (k,) [m/s], lowered in place.
        places: Shape (k,) [m].
        speeds: Shape (k,) [m/s], through which the lines go.
        slopes: Shape (j,) [1/s].
        at: The points of the lines, shape (j,).
        first: First point of each line, shape (j,).
        after: Point after its last, shape (j,).
    """
    for number in range(len(at)):
        middle, speed, slope = places[at[number]], speeds[at[number]], slopes[number]
        for other in range(first[number], after[number]):
            bounded[other] = min(bounded[other], speed + slope * (places[other] - middle))


def decide_by_lines(
    deciding: Index,
    lowest: Array,
    places: Array,
    speeds: Array,
    slopes: Array,
    at: Index,
    wanted: Index,
    first: Index,
    after: Index,
) -> None:
    """Lower speeds (w,) [m/s] at wanted points to lines, and note the lines that decide.

    Args:
        deciding: Points (w,) of the lines that decide so far; of equal ones the first decides.
        lowest: Lowest speeds (w,) [m/s] so far, lowered in place.
        places: Shape (k,) [m].
        speeds: Shape (k,) [m/s], through which the lines go.
        slopes: Shape (j,) [1/s].
        at: The points of the lines, shape (j,).
        wanted: Points, shape (w,).
        first: First wanted one of each line, shape (j,).
        after: Wanted one after its last, shape (j,).
    """
    for number in range(len(at)):
        line = at[number]
        middle, speed, slope = places[line], speeds[line], slopes[number]
        for other in range(first[number], after[number]):
            value = speed + slope * (places[wanted[other]] - middle)
            if value < lowest[other] or (value == lowest[other] and line < deciding[other]):
                lowest[other], deciding[other] = value, line


COMPILED = (keep_below_lines, decide_by_lines)
