"""Expressions that a debugger evaluates at the position of a frame: `n > 2 AND doGrip = 1`.

Names are resolved as if the expression stood there in the program. Its value is computed from the
data of the frame, with RAPID's arithmetic, without running a statement. A call of a function is not
computed here: it could change data or let time pass; `CallNeededError` says so.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from types import FrameType

from rapidsim.analysis.cell_names import ConfiguredSymbol
from rapidsim.analysis.context import Analysis, Context, UnitResults
from rapidsim.analysis.evaluation import NOT_STATIC, Evaluator, Known, NotStatic
from rapidsim.analysis.literals import is_signal
from rapidsim.analysis.names.user_types import UserTypes
from rapidsim.analysis.passes.declarations import declare_locals, declare_task
from rapidsim.analysis.program import Program, RoutineSymbol, UnknownSymbol
from rapidsim.analysis.tree_walk import descendants
from rapidsim.analysis.types.expressions import type_of_expression
from rapidsim.diagnostics import Severity, Source
from rapidsim.interpreter.tools.inspection import (
    NotShownError,
    data_of,
    module_of,
    program_of,
    routine_of,
)
from rapidsim.language.types import BOOL, NUM, Type, resolved
from rapidsim.library.text import value_text
from rapidsim.syntax import tree
from rapidsim.syntax.parser import parse
from rapidsim.values import value_class

_BEFORE = "MODULE expression\nFUNC num f()\nRETURN\n"
_AFTER = "\n;\nENDFUNC\nENDMODULE\n"


class CallNeededError(NotShownError):
    """The value depends on a function call."""


@value_class(frozen=True, slots=True)
class FrameValue:
    """The value of an expression."""

    value: object
    type: Type

    @property
    def text(self) -> str:
        """The value in source notation.

        Raises:
            NotShownError: If values of its type have none.
        """
        try:
            return value_text(self.value, self.type)
        except TypeError as error:
            raise NotShownError(str(error)) from error


@value_class(frozen=True, slots=True)
class FrameExpression:
    """An expression, checked at the position of a frame."""

    text: str
    type: Type
    _node: tree.Expression
    _analysis: Analysis
    _signal: Callable[[str], float]

    def value(self, frame: FrameType) -> FrameValue:
        """Return the value in a frame of the routine for which it was checked.

        Raises:
            CallNeededError: If it calls a function.
            NotShownError: If it has no value now, with the reason.
        """
        symbol_of = self._analysis.symbol_of

        def read(reference: tree.DataReference) -> Known:
            symbol = symbol_of.get(reference)
            of = self._analysis.type_of.get(reference)
            if isinstance(symbol, ConfiguredSymbol | UnknownSymbol) and of and is_signal(of):
                return self._signal(reference.name.text)
            return data_of(reference.name.text, frame)[0]

        found = Evaluator(self._analysis, read).value(self._node, self.type)
        if isinstance(found, NotStatic):
            calls = (tree.FunctionCall, tree.LateFunctionCall)
            if any(isinstance(node, calls) for node in descendants(self._node)):
                raise CallNeededError(f"`{self.text}` calls a function")
            reason = "it has no value here" if found is NOT_STATIC else found.reason
            raise NotShownError(f"`{self.text}`: {reason}")
        return FrameValue(found, self.type)


class FrameExpressions:
    """Checks expressions against the program of a run; declarations are analysed once."""

    def __init__(self, signal: Callable[[str], float] = lambda name: 0.0) -> None:
        """Create it.

        Args:
            signal: Returns the value of a signal by name.
        """
        self._signal = signal
        self._declared: dict[Program, tuple[Analysis, UserTypes, dict[tree.Module, Context]]] = {}

    def checked(self, text: str, frame: FrameType) -> FrameExpression:
        """Check an expression at the position of a frame.

        Raises:
            NotShownError: If it is no expression there, with the first error.
        """
        node, parsed = _parsed(text)
        context = self._context(frame, parsed)
        of = type_of_expression(node, context, None)
        errors = [
            one for one in context.analysis.unit.diagnostics if one.severity is Severity.ERROR
        ]
        unknown = _undeclared(node, context.analysis)
        if errors:
            raise NotShownError(errors[0].violation.message)
        if of is None:
            name = f"`{unknown[0]}` is not the name of data here" if unknown else f"`{text}`?"
            raise NotShownError(name)
        # A signal is compared as its value.
        return FrameExpression(
            text.strip(), NUM if is_signal(of) else of, node, context.analysis, self._signal
        )

    def condition(self, text: str, frame: FrameType) -> FrameExpression:
        """Check an expression of type bool; see `checked`."""
        found = self.checked(text, frame)
        if resolved(found.type) != BOOL:
            raise NotShownError(f"`{text}` is {found.type.name}, a condition is bool")
        return found

    def _context(self, frame: FrameType, file: tree.File) -> Context:
        """Return the scope at a frame, with side tables of its own for an expression."""
        program = program_of(frame)
        if program not in self._declared:
            analysis = Analysis(program.cell)
            homes, user_types = declare_task(program.modules, analysis)
            by_module = {home.module: home for home in homes}
            self._declared[program] = analysis, user_types, by_module
        analysis, user_types, homes_of = self._declared[program]
        home = homes_of[module_of(frame)]
        own = replace(analysis, unit=UnitResults(), undeclared=[], unknown={}, signals={})
        home = replace(home, analysis=own, module=file.modules[0])
        routine = routine_of(frame)
        if routine is None:
            return home
        symbol = homes_of[module_of(frame)].analysis.symbol_of.get(routine.node)
        assert isinstance(symbol, RoutineSymbol)
        inside = declare_locals(symbol, replace(home, module=module_of(frame)), user_types)
        for node in descendants(routine.node):
            if isinstance(node, tree.For):
                counter = program.symbol_of[node]
                inside.scope.names.setdefault(node.counter.key, counter)
        own.unit.diagnostics.clear()
        return replace(inside, module=file.modules[0])


def _parsed(text: str) -> tuple[tree.Expression, tree.File]:
    parsed = parse(Source("", f"{_BEFORE}{text}{_AFTER}"))
    errors = [one for one in parsed.diagnostics if one.severity is Severity.ERROR]
    if errors:
        raise NotShownError(f"`{text}` is no expression: {errors[0].violation.message}")
    routines = [routine for module in parsed.file.modules for routine in module.routines]
    body: Sequence[tree.Statement] = routines[0].body if len(routines) == 1 else ()
    if len(body) == 1 and isinstance(body[0], tree.Return) and body[0].value is not None:
        return body[0].value, parsed.file
    raise NotShownError(f"`{text}` is no single expression")


def _undeclared(node: tree.Expression, analysis: Analysis) -> list[str]:
    return [
        part.name.text
        for part in descendants(node)
        if isinstance(part, tree.DataReference | tree.FunctionCall)
        and isinstance(analysis.symbol_of.get(part), UnknownSymbol | None)
    ]
