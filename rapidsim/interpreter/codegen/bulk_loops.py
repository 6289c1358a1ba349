"""Statement lists with bulk moves: which of their statements one loop executes.

Of lines that differ only in the target, the parser keeps the first two and the last one in the
tree, and some between. A loop executes all of them as rows, so that they are resolved together.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import chain, groupby

from rapidsim.syntax import tree
from rapidsim.syntax.tree.bulk_statements import TARGET_SHAPE, TARGET_WIDTH


def with_loops(
    body: tree.Body, runs: Mapping[tree.Node, tree.BulkStatements], text: str
) -> Iterator[tree.Statement | tree.BulkStatements]:
    """Yield the statements of a list, and the bulk moves among them.

    Args:
        body: The list.
        runs: Bulk moves, by the statement before each that they repeat.
        text: The source text.
    """
    if not runs:
        yield from body
        return
    for around, group in groupby(body, lambda statement: _around_target(statement, text)):
        statements = tuple(group)
        if around is not None and not runs.keys().isdisjoint(statements):
            yield _joined(statements, runs)
            continue
        for statement in statements:
            yield statement
            if (run := runs.get(statement)) is not None:
                yield run


def _around_target(statement: tree.Statement, text: str) -> tuple[str, str] | None:
    """Return the text of a call before and behind the numbers of its target; None without any."""
    match statement:
        case tree.Call(
            arguments=(
                tree.RequiredArgument(value=tree.LiteralAggregate(value=parts) as target),
                *_,
            )
        ) if tuple(len(part) if isinstance(part, tuple) else 0 for part in parts) == TARGET_SHAPE:
            return text[statement.start : target.start], text[target.end : statement.end]
        case _:
            return None


def _joined(
    calls: Sequence[tree.Statement], runs: Mapping[tree.Node, tree.BulkStatements]
) -> tree.BulkStatements:
    """Return calls that differ only in their target, with the bulk moves behind them, as one."""
    # Most programs have no bulk moves.
    import numpy as np  # noqa: PLC0415

    parts = [part for call in calls for part in (_alone(call), runs.get(call)) if part is not None]
    run = next(runs[call] for call in calls if call in runs)
    return tree.BulkStatements(
        calls[0].start,
        parts[-1].end,
        run.like,
        np.concatenate([part.starts for part in parts]),
        np.concatenate([part.ends for part in parts]),
        np.concatenate([part.numbers for part in parts]),
        run.numbers_of_like,
        between=tuple(_between(parts)),
    )


def _between(parts: Iterable[tree.BulkStatements]) -> Iterator[tree.RepeatedCall]:
    """Yield the calls between bulk moves, counted from the first of all moves."""
    before = 0
    for part in parts:
        for call in part.between:
            yield replace(call, moves_before=call.moves_before + before)
        before += len(part)


def _alone(call: tree.Statement) -> tree.BulkStatements:
    """Return a call as bulk statements by itself."""
    import numpy as np  # noqa: PLC0415

    assert isinstance(call, tree.Call)
    assert isinstance(call.arguments[0], tree.RequiredArgument)
    target = call.arguments[0].value
    assert isinstance(target, tree.LiteralAggregate)
    numbers = np.array([*chain.from_iterable(target.value)], dtype=np.float32)  # type: ignore[arg-type]
    place = np.array([call.start]), np.array([call.end])
    return tree.BulkStatements(
        call.start, call.end, call, *place, numbers.reshape(1, TARGET_WIDTH), numbers
    )
