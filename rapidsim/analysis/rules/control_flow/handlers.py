"""Rules F407, F408, F430 and F431: ERROR clauses that do not handle the error."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rapidsim.analysis.can_fail import FAILING, FAILING_OPERATORS
from rapidsim.analysis.error_clauses import ERRNO, depends_on_error, falls_through
from rapidsim.analysis.program_parts import Facts, ProgramPart
from rapidsim.analysis.rules.facts.instruction_questions import arguments_of, may_do
from rapidsim.analysis.tree_walk import descendants
from rapidsim.diagnostics import Diagnostic, Violation
from rapidsim.library.traits import LIMITS, ONLY_LOOKS, Trait
from rapidsim.syntax import tree

_TIMEOUT = "err_wait_maxtime"
_HARMLESS = Trait.TELL | Trait.OUTPUT | Trait.MOVE | Trait.OFFSET | Trait.WAIT | ONLY_LOOKS
"""Traits of instructions and functions that raise no error but that of a time limit."""


class RetryWithoutChange(Violation, code="F407"):
    pass


class SwallowedError(Violation, code="F408"):
    effect: str
    errors: str


class ErrorFallsThrough(Violation, code="F430"):
    routine: str
    other_text: int = 0

    @property
    def is_reported_once(self) -> bool:
        """True: a program with one such clause tends to have many."""
        return True

    def with_others(self, merged: Sequence[Violation]) -> ErrorFallsThrough:
        """Merge the findings into this one, with their number."""
        return ErrorFallsThrough(self.routine, len(merged))

    @property
    def message(self) -> str:
        """Message with the first routine, and the number of others."""
        if not self.other_text:
            return super().message
        more = (
            "1 more ERROR clause"
            if self.other_text == 1
            else f"{self.other_text} more ERROR clauses"
        )
        return f"{super().message}; so do those of {more}"


class RaisedErrorFallsThrough(Violation, code="F431"):
    error: str
    routine: str


def find_careless_handlers(facts: Facts) -> Iterator[Diagnostic]:
    """Report ERROR clauses that retry or skip on every error."""
    for part in facts.routine_parts:
        handler = None if part.routine is None else part.routine.error
        if handler is None or handler.numbers is not None:
            continue
        place = _retried_at_once(handler.body, facts)
        if place is not None:
            yield part.finding(RetryWithoutChange(), place)
        yield from _swallowed(part, handler, facts)


def _retried_at_once(body: tree.Body, facts: Facts) -> tree.Node | None:
    """RETRY before which a clause changes nothing; None without one."""
    _, first = _first_effect(body, facts)
    return first if isinstance(first, tree.Retry) else None


def _first_effect(body: tree.Body, facts: Facts) -> tuple[bool, tree.Statement | None]:
    """Whether a text is shown first, and the first statement with another effect."""
    tells = False
    for statement in body:
        match statement:
            case tree.Call() if Trait.TELL in may_do(statement, facts):
                tells = True
            case tree.Empty() | tree.Label():
                pass
            case _:
                return tells, statement
    return tells, None


def _swallowed(part: ProgramPart, handler: tree.ErrorHandler, facts: Facts) -> Iterator[Diagnostic]:
    """Report the statement by which a clause silently drops every error, or every other one."""
    assert part.routine is not None
    tells, first = _first_effect(handler.body, facts)
    if tells:
        return
    if first is None:
        if not isinstance(part.routine, tree.Func):
            yield part.finding(
                SwallowedError("an empty ERROR clause drops", "every error"), handler
            )
        return
    if way := _silent_effect(first):
        yield part.finding(SwallowedError(way, "every error"), first)
        return
    for number, statement in enumerate(handler.body):
        if not depends_on_error(statement):
            if number and (way := _silent_effect(statement)):
                yield part.finding(SwallowedError(way, "every other error"), statement)
            if not isinstance(statement, tree.Empty):
                return
            continue
        tells, last = _first_effect(_else_body(statement), facts)
        if not tells and last is not None and (way := _silent_effect(last)):
            yield part.finding(SwallowedError(way, "every other error"), last)


def _else_body(choice: tree.Node) -> tree.Body:
    """Statements of an ELSE or DEFAULT."""
    match choice:
        case tree.If(otherwise=body) | tree.Test(default=body):
            return body or ()
        case _:
            return ()


def _silent_effect(statement: tree.Statement) -> str | None:
    """Description of a statement that drops an error silently; None for other statements."""
    match statement:
        case tree.TryNext():
            return "TRYNEXT skips"
        case tree.Return(value=None):
            return "RETURN drops"
        case _:
            return None


def find_errors_that_fall_through(facts: Facts) -> Iterator[Diagnostic]:
    """Report ERROR clauses with branches for some errors through which the others fall."""
    raised = _RaisedNumbers(facts)
    for part in facts.routine_parts:
        routine = part.routine
        handler = None if routine is None else routine.error
        if routine is None or handler is None or handler.numbers is not None:
            continue
        if isinstance(routine, tree.Func):
            # The end of a function without a value is reported separately.
            continue
        choices = [one for one in handler.body if depends_on_error(one)]
        if not choices or not falls_through(handler.body, facts.does):
            continue
        named = _named_errors(choices)
        lost = [] if named is None else [n for n in raised.by(part) if n.lower() not in named]
        if lost:
            yield part.finding(RaisedErrorFallsThrough(lost[0], routine.name.text), choices[-1])
        elif not (named and _TIMEOUT in named and _only_times_out(part, facts)):
            yield part.finding(ErrorFallsThrough(routine.name.text), choices[-1])


def _named_errors(choices: Sequence[tree.Node]) -> set[str] | None:
    """Folded names that are compared with ERRNO; None if it is compared with anything else."""
    names: set[str] = set()
    for choice in choices:
        match choice:
            case tree.If(branches=branches):
                asked: list[tree.Node] = [branch.condition for branch in branches]
            case tree.CompactIf(condition=condition):
                asked = [condition]
            case tree.Test(subject=subject, cases=cases):
                asked = [subject, *(value for case in cases for value in case.values)]
            case _:
                continue
        for node in descendants(*asked):
            if isinstance(node, tree.FunctionCall | tree.Index | tree.ComponentAccess):
                return None
            if isinstance(node, tree.DataReference):
                names.add(node.name.key)
    names.discard(ERRNO)
    return names


class _RaisedNumbers:
    """Names of error numbers that routines raise, including their callees."""

    def __init__(self, facts: Facts) -> None:
        self._facts = facts
        self._known: dict[ProgramPart, tuple[str, ...]] = {}

    def by(self, part: ProgramPart) -> tuple[str, ...]:
        """Names of the error numbers that reach the ERROR clause of a routine."""
        assert part.routine is not None
        return self._of(part.routine.body)

    def _out_of(self, part: ProgramPart) -> tuple[str, ...]:
        """Names of the error numbers that propagate out of a routine."""
        if part not in self._known:
            self._known[part] = ()
            assert part.routine is not None
            handler = part.routine.error
            self._known[part] = self._of(part.routine.body if handler is None else handler.body)
        return self._known[part]

    def _of(self, body: tree.Body) -> tuple[str, ...]:
        found: dict[str, None] = {}
        for node in descendants(*body):
            match node:
                case tree.Raise(number=tree.DataReference(name=name)):
                    found[name.text] = None
                case tree.Call() | tree.FunctionCall():
                    called = self._facts.routine_called(node)
                    if called is not None and called in self._facts.part_of:
                        found.update(dict.fromkeys(self._out_of(self._facts.part_of[called])))
                case _:
                    pass
        return tuple(found)


def _only_times_out(part: ProgramPart, facts: Facts) -> bool:
    """Whether the only error of a routine is that a wait reaches its time limit."""
    assert part.routine is not None
    return not any(_may_raise(node, facts) for node in descendants(*part.routine.body))


def _may_raise(node: tree.Node, facts: Facts) -> bool:
    match node:
        case tree.Call() | tree.FunctionCall():
            if facts.installed(node) is None:
                return True
            formals = {formal.key for formal, _ in arguments_of(node, facts) if formal}
            return not (_HARMLESS & facts.does(node) or LIMITS & formals)
        case tree.Binary(operator=operator):
            return operator in FAILING_OPERATORS
        case _:
            return isinstance(node, FAILING)
