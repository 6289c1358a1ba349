"""Lines of a RAPID file with an executable statement, for coverage and breakpoints.

A statement counts on its first line, an ELSEIF or CASE on the line of its condition.
Headers, ends, labels and declarations of module data do not count: they take effect when the
program is loaded. Nor do BACKWARD clauses: the simulator never runs backwards.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import assert_never

from rapidsim.analysis.tree_walk import descendants
from rapidsim.diagnostics import Source, Span
from rapidsim.language.moves import Place
from rapidsim.syntax import tree
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class RoutineLines:
    """The lines of one routine."""

    name: str
    """Name in RAPID's spelling."""
    first: int
    """Line of the header, from 1."""
    last: int
    """Line of the end."""
    executable: frozenset[int]


def routine_lines(file: tree.File) -> tuple[RoutineLines, ...]:
    """The routines of a file in source order, each with its executable lines."""
    return tuple(
        _lines_of(routine, file.source) for module in file.modules for routine in module.routines
    )


def places_to_stop(module: tree.Module) -> dict[int, Place]:
    """Return the first statement on each line, where a program can be halted, by line number.

    Declarations are excluded, because a running program does not execute them. A compound statement
    ends there at the end of its first line.
    """
    source, places = module.source, dict[int, Place]()
    for routine in module.routines:
        outermost: dict[int, tree.Node] = {}
        for node in descendants(routine):
            outermost.setdefault(node.start, node)
        for offset in _offsets(routine):
            (line, column), node = source.position(offset), outermost[offset]
            if line in places or isinstance(node, tree.Data):
                continue
            rest = source.line(line)[column - 1 :].rstrip()
            holds = isinstance(node, tree.If | tree.For | tree.While | tree.Test)
            end = offset + len(rest) if holds else node.end
            places[line] = Place(Span(source, offset, end), routine.name.text)
    return places


def _lines_of(routine: tree.Routine, source: Source) -> RoutineLines:
    return RoutineLines(
        routine.name.text,
        source.position(routine.start)[0],
        source.position(routine.end - 1)[0],
        frozenset(source.position(offset)[0] for offset in _offsets(routine)),
    )


def _offsets(routine: tree.Routine) -> Iterator[int]:
    """Yield the offsets of executable statements, in source order."""
    for body in (routine.body, routine.error.body if routine.error else (), routine.undo or ()):
        yield from _in_body(body)


def _in_body(body: tree.Body) -> Iterator[int]:
    for statement in body:
        yield from _in_statement(statement)


def _in_statement(statement: tree.Statement) -> Iterator[int]:
    """Yield the offsets of a statement and the statements in it."""
    match statement:
        case tree.If(branches=branches, otherwise=otherwise):
            # The first condition counts on the line of the IF, even if it is on another line.
            yield statement.start
            for number, branch in enumerate(branches):
                if number:
                    yield branch.condition.start
                yield from _in_body(branch.body)
            yield from _in_body(otherwise or ())
        case tree.CompactIf(statement=inner):
            yield statement.start
            yield from _in_statement(inner)
        case tree.For(body=body) | tree.While(body=body):
            yield statement.start
            yield from _in_body(body)
        case tree.Test(cases=cases, default=default):
            yield statement.start
            for case in cases:
                yield case.values[0].start
                yield from _in_body(case.body)
            yield from _in_body(default or ())
        case tree.Data(storage=storage):
            if storage == "VAR":
                yield statement.start
        case tree.Label() | tree.InvalidStatement():
            pass
        case (
            tree.Assignment()
            | tree.Call()
            | tree.LateCall()
            | tree.Goto()
            | tree.Return()
            | tree.Raise()
            | tree.Exit()
            | tree.Retry()
            | tree.TryNext()
            | tree.Connect()
            | tree.Empty()
            | tree.Placeholder()
        ):
            yield statement.start
        case _:
            assert_never(statement)
