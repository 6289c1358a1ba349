"""Time of a run by routine and by line: the sums of its moves and waits.

A wait while the robot is still moving counts for both lines, so that shares may add up to more than
the run.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import TypeAlias

import numpy as np

from rapidsim.controller.journal.events import Wait
from rapidsim.controller.moves.executed_move import ExecutedMove
from rapidsim.controller.moves.executed_moves import ExecutedMoves
from rapidsim.language.moves import Place
from rapidsim.values import value_class

Step: TypeAlias = ExecutedMove | Wait
"""A move or a wait: what takes time."""

_ROUNDING_S = 1e-6
_FIRST_WORD = re.compile(r"\w*")


@value_class(frozen=True, slots=True)
class Share:
    """The steps of one routine, or of one line."""

    task: str
    place: Place
    """Position of the first step."""
    instruction: str
    """Instruction of the first step."""
    goal: str
    """Target of the first move, or condition of the first wait."""
    is_wait: bool
    """Whether all steps are waits."""
    seconds: float
    length_mm: float
    """Along the programmed path."""
    times: int
    """Number of executions."""
    moves: tuple[int, ...]
    """Numbers of the moves among the steps."""

    @property
    def line(self) -> str:
        """File and line of the first step, without folders."""
        return f"{Path(self.place.span.file).name}:{self.place.span.line}"


def by_routine(steps: Iterable[Step]) -> tuple[Share, ...]:
    """Return the time in each routine of each task, the longest first."""
    return _added_up(steps, lambda step: (step.task, step.place.span.file, step.place.routine))


def by_line(steps: Iterable[Step]) -> tuple[Share, ...]:
    """Return the time in each line of each task, the longest first."""
    return _added_up(steps, lambda step: (step.task, step.place.span.file, step.place.span.start))


def slowest_lines(moves: ExecutedMoves, most: int) -> tuple[Share, ...]:
    """Return the first of `by_line`, at most so many, without adding up the others exactly."""
    columns = moves.columns
    numbers: dict[tuple[str, str], int] = {}
    texts = zip(columns.tasks, columns.sources, strict=True)
    text = np.array(
        [numbers.setdefault((task, source.file), len(numbers)) for task, source in texts],
        dtype=np.int64,
    )
    apart = int(columns.starts.max(initial=0)) + 1
    line = np.unique(text * apart + columns.starts, return_inverse=True)[1]
    seconds = np.bincount(line, columns.end_s - columns.start_s)
    # Rounding depends on the order of the sum; a tie is won by the line that comes first.
    least = np.partition(seconds, -most)[-most] if len(seconds) > most else 0.0
    rows = np.flatnonzero(seconds[line] >= least - _ROUNDING_S)
    return by_line(moves[at] for at in rows.tolist())[:most]


def instruction_of(step: Step) -> str:
    """The instruction, as the program spells it."""
    if isinstance(step, ExecutedMove):
        return step.move.instruction
    found = _FIRST_WORD.match(step.place.span.text)
    return found[0] if found else ""


def goal_of(step: Step) -> str:
    """Name of the target of a move; the condition of a wait."""
    return end_point(step.place) if isinstance(step, ExecutedMove) else step.awaited


def argument(place: Place, *names: str) -> str | None:
    """Source text of the first argument of a call among names; None if it has none of them."""
    given = (place.arguments.get(name) for name in names)
    return next((text for text in given if text is not None), None)


def end_point(place: Place) -> str:
    """Name in the program of the target of the move at a place; its position if written there.

    The position is the first aggregate of the target; of a joint target, the axes.
    """
    text = "".join((argument(place, "topoint", "tojointpos") or "*").split())
    return text[1:].partition("]")[0] + "]" if text.startswith("[[") else text


def _added_up(
    steps: Iterable[Step], key_of: Callable[[Step], tuple[object, ...]]
) -> tuple[Share, ...]:
    groups: dict[tuple[object, ...], list[Step]] = {}
    for step in steps:
        groups.setdefault(key_of(step), []).append(step)
    return tuple(sorted(map(_share, groups.values()), key=lambda share: -share.seconds))


def _share(steps: list[Step]) -> Share:
    first = steps[0]
    moves = [step for step in steps if isinstance(step, ExecutedMove)]
    return Share(
        task=first.task,
        place=first.place,
        instruction=instruction_of(first),
        goal=goal_of(first),
        is_wait=not moves,
        seconds=sum(step.end_s - step.start_s for step in steps),
        length_mm=1000.0 * sum(move.length_m for move in moves),
        times=len(steps),
        moves=tuple(move.index for move in moves),
    )
