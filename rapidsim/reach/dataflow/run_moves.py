"""The moves of a run of alike statements, from its columns."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import fields
from functools import partial
from itertools import repeat
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from rapidsim.analysis.program import Program
from rapidsim.language.data import ConfData, ExtJoint, Orient, Pos, RobTarget
from rapidsim.language.moves import Move
from rapidsim.reach.dataflow.known_moves import KnownMove, MoveStatement
from rapidsim.reach.dataflow.written_moves import RunNotFollowedError
from rapidsim.syntax import tree

if TYPE_CHECKING:
    from rapidsim.syntax.tree.runs import Numbers

_PARTS: tuple[tuple[slice, Any], ...] = (
    (slice(0, 3), Pos),
    (slice(3, 7), Orient),
    (slice(7, 11), ConfData),
    (slice(11, 17), ExtJoint),
)


Runs: TypeAlias = Mapping[tree.Call, tuple[tree.Run, Sequence[tree.RunRow]]]
"""The runs of a program with their statements, by the statement in the tree before each."""


def runs_of(program: Program) -> Runs:
    """The runs of a program."""
    runs = (run for module in program.modules for run in module.runs)
    return {run.like: (run, tuple(run.rows())) for run in runs if isinstance(run.like, tree.Call)}


def with_rows(call: tree.Call, runs: Runs) -> tuple[MoveStatement, ...]:
    """A statement of the tree, and those of the run behind it that it stands for."""
    return (call, *runs[call][1]) if call in runs else (call,)


def moves_of_run(
    run: tree.Run, rows: Sequence[tree.RunRow], like: KnownMove, first: int
) -> Iterator[KnownMove]:
    """The moves of a run.

    Args:
        run: The run.
        rows: Its statements.
        like: The move of the statement before them.
        first: What the index of the first of them will be.

    Raises:
        RunNotFollowedError: If that move goes elsewhere than its statement says.
    """
    move = like.move
    went = np.array([number for part in move.to for number in part])
    if move.programmed is not None or not np.array_equal(run.numbers_of_like, went):
        raise RunNotFollowedError
    columns = (_part(run.numbers[:, part], kind) for part, kind in _PARTS)
    targets: Iterable[RobTarget] = map(RobTarget._make, zip(*columns, strict=False))
    return _moves(rows, targets, like, first)


def _part(numbers: Numbers, kind: Any) -> Iterable[Any]:
    """A part of each target; one for all where all are the same, as of external axes."""
    if (numbers == numbers[0]).all():
        return repeat(kind(*numbers[0].tolist()))
    return map(kind._make, numbers.tolist())


def _moves(
    rows: Iterable[tree.RunRow], targets: Iterable[RobTarget], like: KnownMove, first: int
) -> Iterator[KnownMove]:
    # As `replace` does, which takes several times as long.
    same = {one.name: getattr(like.move, one.name) for one in fields(Move)}
    move_to = partial(Move, **same)
    module, routine = like.module, like.routine
    settings, uncertain = like.settings, like.uncertain
    for index, (row, to) in enumerate(zip(rows, targets, strict=False), first):
        yield KnownMove(row, module, routine, move_to(to=to), settings, uncertain, index - 1)
