"""Statement lists with bulk moves: which of their statements one loop executes.

Of lines that differ only in the target, the parser keeps the first two and the last one in the
tree, and some between. A loop executes all of them as rows, so that they are resolved together.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import chain

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
    group: list[tree.Call] = []
    for statement in body if runs else ():
        if group and not (isinstance(statement, tree.Call) and _repeats(statement, group[0], text)):
            yield from _joined(group, runs)
            group = []
        if isinstance(statement, tree.Call) and (group or _target(statement) is not None):
            group.append(statement)
            continue
        yield statement
        if (run := runs.get(statement)) is not None:
            yield run
    yield from _joined(group, runs) if runs else body


def _target(call: tree.Call) -> tree.LiteralAggregate | None:
    """Return the numbers of a target that is the first argument of a call."""
    match call.arguments:
        case (tree.RequiredArgument(value=tree.LiteralAggregate(value=parts) as target), *_) if (
            tuple(len(part) if isinstance(part, tuple) else 0 for part in parts) == TARGET_SHAPE
        ):
            return target
        case _:
            return None


def _repeats(call: tree.Call, first: tree.Call, text: str) -> bool:
    """Whether a call differs from another only in the numbers of its target."""
    target, like = _target(call), _target(first)
    return (
        target is not None
        and like is not None
        and text[call.start : target.start] == text[first.start : like.start]
        and text[target.end : call.end] == text[like.end : first.end]
    )


def _joined(
    group: Sequence[tree.Call], runs: Mapping[tree.Node, tree.BulkStatements]
) -> Iterator[tree.Statement | tree.BulkStatements]:
    """Yield consecutive calls that repeat each other, as one if any has bulk moves behind it."""
    found = {call: runs[call] for call in group if call in runs}
    if not found:
        yield from group
        return
    # Most programs have no bulk moves.
    import numpy as np  # noqa: PLC0415

    parts = [part for call in group for part in (_alone(call), runs.get(call)) if part is not None]
    like = next(iter(found))
    yield tree.BulkStatements(
        group[0].start,
        parts[-1].end,
        like,
        np.concatenate([part.starts for part in parts]),
        np.concatenate([part.ends for part in parts]),
        np.concatenate([part.numbers for part in parts]),
        found[like].numbers_of_like,
    )


def _alone(call: tree.Call) -> tree.BulkStatements:
    """Return a call as bulk statements by itself."""
    import numpy as np  # noqa: PLC0415

    target = _target(call)
    assert target is not None
    numbers = np.array([*chain.from_iterable(target.value)], dtype=np.float32)  # type: ignore[arg-type]
    place = np.array([call.start]), np.array([call.end])
    return tree.BulkStatements(
        call.start, call.end, call, *place, numbers.reshape(1, TARGET_WIDTH), numbers
    )
