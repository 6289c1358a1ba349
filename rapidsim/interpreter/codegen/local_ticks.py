"""The ticks of compute-only loops, counted in a Python variable of their routine.

The clock's own count is an attribute, which costs as much as the rest of a small loop. Therefore a
loop takes the remaining ticks from the clock, counts down locally, and returns the unused ticks
when it ends, returns or fails, and before every statement in it that could read the clock. It does
so only if that costs less than it saves. The behaviour is unchanged: a loop requests new ticks in
the same iteration, and every observer reads the same time.

If all iterations of a FOR fit into the remaining ticks, they are subtracted at once.

An exception raised by the clock, or by a statement that could read it, leaves a correct count; a
negative count tells the loop that it has been returned already.
"""

from __future__ import annotations

import ast
from collections.abc import Collection, Iterator, Mapping, Sequence
from copy import deepcopy
from typing import TypeGuard

from rapidsim.interpreter.codegen.ast_builder import AstBuilder
from rapidsim.interpreter.runtime.idle_state import LEFT, TURNS
from rapidsim.values import value_class

COMPUTING = frozenset(
    {
        *("_checked_integer", "_count", "_double_integer", "_int", "_len", "_literal_quotient"),
        *("_magnitude", "_new", "_out_of_bounds", "_overflow", "_quotient", "_raised", "_range"),
        *("_remainder", "_root", "_single_integer", "_steps", "_ProgramReset", "_too_long"),
        *("_whole_quotient", "_whole_remainder", "_Box", "_Element", "_Component", "_not_present"),
    }
)
"""Functions of the namespace that are quick and do not read the clock."""
_MOST = 100
"""Maximum number of statements of a loop: during local counting its ticks cannot be revoked."""
_DEEPEST = 10
"""Maximum loop nesting: catching exceptions takes one more block of the 20 that CPython allows."""


@value_class(frozen=True, slots=True)
class _Plan:
    """Savings and costs of counting a loop's ticks in a variable."""

    ticks: int
    clock_reads: int
    """Statements that could read the clock."""
    statements: int

    @property
    def pays(self) -> bool:
        return self.ticks > self.clock_reads and self.statements <= _MOST


def count_locally(functions: Sequence[ast.FunctionDef], computing: Collection[str]) -> None:
    """Let the loops of a module's routines count locally where that pays.

    Requires a program that shares no data with other tasks, which would read the clock at any time.

    Args:
        functions: The routines' functions, changed in place.
        computing: Names of quick functions that do not read the clock, in addition to `COMPUTING`.
    """
    statements = dict.fromkeys((*computing, *COMPUTING), 0)
    installed = _Loops(statements)
    only_compute = {one.name: len(one.body) for one in functions if installed.none_in(one)}
    loops = _Loops(statements | only_compute)
    for function in functions:
        function.body = list(loops.at_depth(function.body))


class _Loops:
    def __init__(self, computing: Mapping[str, int]) -> None:
        """Take the functions that do not read the clock, with their numbers of statements."""
        self._computing = computing

    def none_in(self, function: ast.FunctionDef) -> bool:
        """Whether a routine has no loops and calls no other routine, so that it is quick."""
        parts = (ast.For, ast.While, ast.FunctionDef)
        return not self._reads_clock(function) and not any(
            isinstance(part, parts) for statement in function.body for part in ast.walk(statement)
        )

    def at_depth(self, body: Sequence[ast.stmt], depth: int = 0) -> Iterator[ast.stmt]:
        """Statements at loop nesting `depth`, with the loops among and below them rewritten."""
        for statement in body:
            plan = self._plan(statement, depth) if _is_loop(statement) else None
            # Nested loops are entered often, and most have few iterations.
            if plan is not None and plan.pays and (plan.ticks > 1 or not depth):
                yield from self._region(statement)
                continue
            for inner in _bodies(statement):
                inner[:] = self.at_depth(inner, depth + _is_loop(statement))
            yield statement

    def _plan(self, loop: ast.stmt, outer: int) -> _Plan | None:
        """Plan of a loop; None if it cannot count locally."""
        ticks, looks, statements = 0, 0, 0
        waiting = [(loop, outer)]
        while waiting:
            statement, depth = waiting.pop()
            statements += 1
            if _is_block(statement):
                decides = statement.iter if isinstance(statement, ast.For) else statement.test
                statements += self._called(decides)
                if isinstance(decides, ast.Attribute) and decides.attr == "watches":
                    continue  # It seldom reads the clock.
                if self._reads_clock(decides) or depth > _DEEPEST:
                    return None
                ticks += _is_loop(statement)
                depth += _is_loop(statement)
                waiting += [(inner, depth) for inner in (*statement.body, *statement.orelse)]
            elif not _is_tick(statement):
                looks += self._reads_clock(statement)
                statements += self._called(statement)
        return _Plan(ticks, looks, statements)

    def _reads_clock(self, node: ast.AST) -> bool:
        """Whether a part of a program could read the clock, or takes long."""
        for part in ast.walk(node):
            if isinstance(part, ast.Call):
                function = part.func
                if not (isinstance(function, ast.Name) and function.id in self._computing):
                    return True
            elif isinstance(part, ast.Lambda | ast.Try):
                return True
        return False

    def _called(self, node: ast.AST) -> int:
        """Number of statements of the routines that a part of a program calls."""
        calls = (part.func for part in ast.walk(node) if isinstance(part, ast.Call))
        return sum(self._computing.get(one.id, 0) for one in calls if isinstance(one, ast.Name))

    def _all_at_once(self, loop: ast.For) -> bool:
        """Whether the ticks of all iterations may be subtracted at once, if enough remain."""
        parts = [part for statement in loop.body[2:] for part in ast.walk(statement)]
        return isinstance(loop.iter, ast.Call) and not any(
            isinstance(part, ast.For | ast.While | ast.Break | ast.Return)
            or (isinstance(part, ast.Attribute) and part.attr == "watches")
            or (isinstance(part, ast.Call) and self._reads_clock(part))
            for part in parts
        )

    def _turns(self, loop: ast.For) -> Iterator[ast.stmt]:
        """Yield the loop twice: without ticks if enough remain, and with them."""
        at = _place(loop)
        counter = loop.target
        assert isinstance(counter, ast.Name)
        plain = at.each(counter, at.name(TURNS), deepcopy(loop.body[2:]))
        taken = at.call("_turns_taken", [at.name(TURNS), at.constant(counter.id)])
        again = [at.minus(LEFT, taken), at.throw()]
        yield at.set(TURNS, loop.iter)
        fits = at.compare(at.call("_turns_of", [at.name(TURNS)]), (ast.LtE(), at.name(LEFT)))
        loop.iter = at.name(TURNS)
        self._count(loop)
        yield at.when(
            fits,
            [
                at.attempt([plain], at.name("_BaseException"), None, again),
                at.minus(LEFT, at.call("_len", [at.name(TURNS)])),
            ],
            [loop],
        )

    def _region(self, loop: ast.stmt) -> Iterator[ast.stmt]:
        at = _place(loop)
        counting = list(self._counting(loop))
        unused = at.compare(at.name(LEFT), (ast.GtE(), at.constant(0)))
        back = at.when(unused, [_give(at)])
        yield _take(at)
        yield at.attempt(counting, at.name("_BaseException"), None, [back, at.throw()])
        yield _give(at)

    def _count(self, statement: ast.stmt) -> None:
        for body in _bodies(statement):
            body[:] = [new for old in body for new in self._counting(old)]

    def _counting(self, statement: ast.stmt) -> Iterator[ast.stmt]:
        """Rewrite a statement of a loop that counts locally."""
        at = _place(statement)
        match statement:
            case ast.AugAssign() if _is_tick(statement):
                yield at.minus(LEFT, at.constant(1))
            case ast.If() if _is_tick(statement):
                serve = at.set(LEFT, at.call("_served", [at.name(LEFT)]))
                below = at.compare(at.name(LEFT), (ast.Lt(), at.constant(0)))
                yield at.when(below, [serve])
            case ast.For() if self._all_at_once(statement):
                yield from self._turns(statement)
            case _ if _is_block(statement):
                self._count(statement)
                yield statement
            case ast.Return(value=value):
                if value is not None and not self._reads_clock(value):
                    yield at.set("_value", value)
                    statement.value = at.name("_value")
                yield _give(at)
                yield at.set(LEFT, at.constant(-1))
                yield statement
            case _ if self._reads_clock(statement):
                yield _give(at)
                yield at.set(LEFT, at.constant(-1))
                yield statement
                yield _take(at)
            case _:
                yield statement


def _is_tick(statement: ast.stmt) -> bool:
    """Whether a statement is one of the two that take a tick."""
    match statement:
        case ast.AugAssign(target=ast.Attribute(value=ast.Name(id="_clock"), attr="ticks_left")):
            return True
        case ast.If(test=ast.Compare(left=ast.Attribute(ast.Name(id="_clock"), "ticks_left"))):
            return True
        case _:
            return False


def _is_loop(statement: ast.stmt) -> TypeGuard[ast.For | ast.While]:
    """Whether a statement is a loop of the program, and therefore takes ticks."""
    return isinstance(statement, ast.For | ast.While) and _is_tick(statement.body[0])


def _is_block(statement: ast.stmt) -> TypeGuard[ast.If | ast.For | ast.While]:
    """Whether its parts are handled one by one, as in a loop around statements that may raise."""
    if isinstance(statement, ast.While):
        return _is_loop(statement)
    return isinstance(statement, ast.If | ast.For) and not _is_tick(statement)


def _bodies(statement: ast.stmt) -> Iterator[list[ast.stmt]]:
    for name in ("body", "orelse", "finalbody"):
        yield getattr(statement, name, [])
    for handler in getattr(statement, "handlers", ()):
        yield handler.body


def _take(at: AstBuilder) -> ast.stmt:
    """`_left = _clock.left`."""
    return at.set(LEFT, at.attribute("_clock", "ticks_left"))


def _give(at: AstBuilder) -> ast.stmt:
    """`_clock.left = _left`."""
    return at.assign(at.store_attribute("_clock", "ticks_left"), at.name(LEFT))


def _place(statement: ast.stmt) -> AstBuilder:
    return AstBuilder(statement.lineno, statement.col_offset, statement.end_col_offset or 0)
