"""Determine which errors an ERROR clause answers before control reaches its end.

The end of a clause is the end of its routine, which returns as if it had succeeded. An error is
answered if a statement on the path to that end handles it; if none does, because no branch of the
clause is for that error, it falls through.

Source: Technical reference manual RAPID Overview, "Error recovery".
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

from rapidsim.analysis.tree_walk import blocks, descendants
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree
from rapidsim.values import value_class

ERRNO = "errno"
CHOICES = (tree.If, tree.CompactIf, tree.Test)
_NOTHING = (tree.Empty, tree.Label, tree.Data, tree.Placeholder, tree.InvalidStatement)

Effects = Callable[[tree.Node], Trait]
"""Returns the traits of a call of an installed routine."""


@value_class(frozen=True, slots=True)
class Answers:
    """The statements of an ERROR clause that answer an error."""

    every: bool
    """Whether each path to the end of the clause contains one of them."""
    statements: frozenset[tree.Node]


def answers(clause: tree.Body, effects: Effects) -> Answers:
    """Find the statements of a clause that answer an error.

    Args:
        clause: The statements of the clause.
        effects: The effects of calls.
    """
    found = frozenset(_answering(clause, effects))
    return Answers(not found.isdisjoint(clause), found)


def depends_on_error(choice: tree.Node) -> bool:
    """Whether an IF or TEST depends on ERRNO."""
    match choice:
        case tree.If(branches=branches):
            conditions = [branch.condition for branch in branches]
        case tree.CompactIf(condition=condition):
            conditions = [condition]
        case tree.Test(subject=subject):
            conditions = [subject]
        case _:
            return False
    return any(
        isinstance(node, tree.DataReference) and node.name.key == ERRNO
        for node in descendants(*conditions)
    )


def _answering(body: tree.Body, effects: Effects, *, is_last: bool = True) -> Iterator[tree.Node]:
    """Yield the answering statements of a body; `is_last` if no choice follows it."""
    choices = [number for number, statement in enumerate(body) if isinstance(statement, CHOICES)]
    last = choices[-1] if choices else -1
    for number, statement in enumerate(body):
        if isinstance(statement, CHOICES):
            # A text that is shown for every error, before the choice among them, answers none.
            counts = depends_on_error(statement) or (is_last and number == last)
            for block in blocks(statement):
                yield from _answering(block, effects, is_last=counts)
        elif isinstance(statement, _NOTHING):
            continue
        elif isinstance(statement, tree.Call) and Trait.TELL in effects(statement):
            if is_last and number > last:
                yield statement
        else:
            yield statement


def falls_through(clause: tree.Body, effects: Effects) -> bool:
    """Whether some path to the end of a clause answers no error."""
    return _is_passed(clause, answers(clause, effects).statements)


def _is_passed(body: tree.Body, answering: frozenset[tree.Node]) -> bool:
    """Whether a path to the end of a body contains no answering statement."""
    for statement in body:
        if statement in answering:
            return False
        if _is_complete(statement) and not any(
            _is_passed(block, answering) for block in blocks(statement)
        ):
            return False
    return True


def _is_complete(choice: tree.Node) -> bool:
    """Whether one of the branches of an IF or TEST is always taken."""
    match choice:
        case tree.If(otherwise=otherwise):
            return otherwise is not None
        case tree.Test(default=default):
            return default is not None
        case _:
            return False
