"""Coverage of a check: the lines on how many moves were checked."""

from __future__ import annotations

from collections.abc import Iterator

from rapidsim.reach.checked_moves import Coverage

_SHOWN = 3


def coverage_lines(coverage: Coverage, robot: str) -> Iterator[str]:
    """A line of counts, one if main was not run, one for each of the first moves not checked.

    Args:
        coverage: The counts of checked moves.
        robot: The arm, and why it was taken.
    """
    if coverage.moves:
        yield _counts(coverage, robot)
    if coverage.main_left_out:
        yield f"No whole trial run: {coverage.main_left_out}."
    for what, moves in (("", coverage.unchecked), ("path ", coverage.unchecked_paths)):
        for move in moves[:_SHOWN]:
            yield f"  {what}not checked: {move.span.file}:{move.span.line}: {move.reason}"
        if (more := len(moves) - _SHOWN) > 0:
            yield f"  ... and {more} more (--format json lists all)"


def _counts(coverage: Coverage, robot: str) -> str:
    how = ""
    if coverage.by_run:
        by_value = f"{coverage.by_value} by value, " if coverage.by_value else ""
        how = f": {by_value}{coverage.by_run} by a run of main"
    moves = "1 move" if coverage.moves == 1 else f"{coverage.moves} moves"
    if coverage.checked < coverage.moves:
        moves = f"{coverage.checked} of {moves}"
    elif coverage.moves > 1:
        moves = f"all {moves}"
    paths = ""
    if coverage.unchecked_paths:
        paths = f"; the path of {coverage.paths_checked} of {coverage.paths} lines and arcs"
    return f"Reach checked for {moves} on {robot}{how}{paths}."
