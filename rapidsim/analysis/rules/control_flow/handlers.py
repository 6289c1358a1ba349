"""Rules F407 and F408: ERROR clauses that do not handle the error."""

from __future__ import annotations

from collections.abc import Iterator

from rapidsim.analysis.program_parts import Facts
from rapidsim.analysis.rules.facts.instruction_questions import may_do
from rapidsim.diagnostics import Diagnostic, Violation
from rapidsim.library.traits import Does
from rapidsim.syntax import tree


class RetryWithoutChange(Violation, code="F407"):
    pass


class SwallowedError(Violation, code="F408"):
    pass


def find_careless_handlers(facts: Facts) -> Iterator[Diagnostic]:
    """ERROR clauses that retry or skip on every error."""
    for part in facts.routine_parts:
        handler = None if part.routine is None else part.routine.error
        if handler is None or handler.numbers is not None:
            continue
        said = False
        for statement in handler.body:
            match statement:
                case tree.Retry():
                    yield part.finding(RetryWithoutChange(), statement)
                case tree.TryNext() if not said:
                    yield part.finding(SwallowedError(), statement)
                case tree.Call() if Does.TELL in may_do(statement, facts):
                    said = True
                    continue
                case tree.Empty() | tree.Label():
                    continue
                case _:
                    pass
            break
