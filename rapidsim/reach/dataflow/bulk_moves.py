"""Moves of bulk statements, computed from their columns."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import fields
from functools import partial
from typing import TypeAlias

import numpy as np

from rapidsim.analysis.program import Program
from rapidsim.interpreter.runtime.bulk_execution import targets_of
from rapidsim.language.data import RobTarget
from rapidsim.language.moves import Move
from rapidsim.reach.dataflow.known_moves import KnownMove, MoveStatement
from rapidsim.reach.dataflow.written_moves import RunNotFollowedError
from rapidsim.syntax import tree

Runs: TypeAlias = Mapping[tree.Call, tuple[tree.BulkStatements, Sequence[tree.BulkRow]]]
"""Bulk statements of a program with their rows, by the statement in the tree before each."""


def runs_of(program: Program) -> Runs:
    """Return the bulk statements of a program."""
    runs = (run for module in program.modules for run in module.runs)
    return {run.like: (run, tuple(run.rows())) for run in runs if isinstance(run.like, tree.Call)}


def with_rows(call: tree.Call, runs: Runs) -> tuple[MoveStatement, ...]:
    """Return a statement of the tree, followed by the rows that it represents."""
    return (call, *runs[call][1]) if call in runs else (call,)


def moves_of_run(
    run: tree.BulkStatements, rows: Sequence[tree.BulkRow], like: KnownMove, first: int
) -> Iterator[KnownMove]:
    """Yield the moves of bulk statements.

    Args:
        run: The bulk statements.
        rows: Their rows.
        like: The move of the statement before them.
        first: Index of their first move.

    Raises:
        RunNotFollowedError: If the target of that move differs from the text of its statement.
    """
    move = like.move
    went = np.array([number for part in move.to for number in part])
    if move.programmed is not None or not np.array_equal(run.numbers_of_like, went):
        raise RunNotFollowedError
    return _moves(rows, targets_of(run.numbers), like, first)


def _moves(
    rows: Iterable[tree.BulkRow], targets: Iterable[RobTarget], like: KnownMove, first: int
) -> Iterator[KnownMove]:
    # Equivalent to `replace`, which takes several times as long.
    same = {one.name: getattr(like.move, one.name) for one in fields(Move)}
    move_to = partial(Move, **same)
    module, routine = like.module, like.routine
    settings, uncertain = like.settings, like.uncertain
    for index, (row, to) in enumerate(zip(rows, targets, strict=False), first):
        yield KnownMove(row, module, routine, move_to(to=to), settings, uncertain, index - 1)
