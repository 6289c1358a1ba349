"""Queries of a program: expressions checked as if part of it, and evaluated after its run.

An expression becomes the only statement of a function in an internal module, together with
functions that return its subexpressions. That module can access LOCAL names of the program's
modules and is linked like one loaded at run time, so the usual checks and execution apply.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace

from rapidsim.analysis.literals import is_signal
from rapidsim.analysis.passes.checker import CheckOutcome, check
from rapidsim.analysis.program import (
    DataSymbol,
    LibrarySymbol,
    Program,
    RoutineSymbol,
    UnknownSymbol,
    does,
)
from rapidsim.analysis.tree_walk import descendants
from rapidsim.diagnostics import Diagnostic, Severity, Source, Span
from rapidsim.interpreter.codegen.names import free_name
from rapidsim.interpreter.limits import NotExecutableError
from rapidsim.interpreter.linking.loader import FatalError, Task
from rapidsim.interpreter.runtime.shared_persistents import may_be_shared
from rapidsim.language.annotations import ParameterMode
from rapidsim.language.errors import Stopped
from rapidsim.language.types import Type, resolved
from rapidsim.library.table import LibraryRoutine
from rapidsim.library.text import value_text
from rapidsim.library.traits import ONLY_LOOKS, Trait
from rapidsim.syntax import tree
from rapidsim.syntax.parser import Parsed, parse
from rapidsim.values import value_class

_ACTS = (
    Trait.MOVE
    | Trait.SEARCH
    | Trait.WAIT
    | Trait.ASK
    | Trait.OUTPUT
    | Trait.LEAVE
    | Trait.CALL_BY_NAME
    | Trait.CALL_ON_THE_WAY
    | Trait.LOAD
)
"""Traits of functions that may not be called after the end of the run."""
_SHOWN = frozenset(
    {"num", "dnum", "bool", "string", "pos", "orient", "pose", "robtarget", "jointtarget"}
)
"""Types of subexpressions whose values are shown."""
_NAME = "assertion"


class QueryError(Exception):
    """An expression that cannot be evaluated; the message has the reason."""


@value_class(frozen=True, slots=True)
class ExpressionQuery:
    """A checked expression of type bool."""

    text: str
    parts: tuple[tuple[str, str], ...]
    """Text and type of the data and function calls in it, without duplicates."""
    is_of_task: bool
    """Whether the answer may depend on the task that evaluates it."""


@value_class(frozen=True, slots=True)
class CheckedQuery:
    """Result of checking an expression; without a query if there are errors."""

    question: ExpressionQuery | None
    findings: tuple[Diagnostic, ...]
    """Errors and warnings, at positions of the expression."""


@value_class(frozen=True, slots=True)
class QueryResult:
    """The value of an expression after the program has run."""

    holds: bool
    values: tuple[tuple[str, str], ...] = ()
    """Text and value of its subexpressions."""
    error: str | None = None
    """Reason why it could not be evaluated."""


@value_class(frozen=True, slots=True)
class _Function:
    """A function of the internal module."""

    name: str
    type: str
    expression: str


def own_names(program: Program) -> frozenset[str]:
    """Folded names that a program declares outside routines; they hide figures."""
    return frozenset(
        item.name.key
        for module in program.modules
        for item in module.items
        if not isinstance(item, tree.InvalidStatement | tree.Placeholder)
    )


def check_query(text: str, label: str, program: Program, figures: Iterable[str]) -> CheckedQuery:
    """Check an expression against a program.

    Args:
        text: The expression.
        label: File name of the expression in findings.
        program: The program to query.
        figures: Names of additional numbers; names that the program declares are skipped.

    Raises:
        QueryError: If it is not a single expression, or has side effects.
    """
    text = text.strip()
    declared = dict.fromkeys(sorted(set(figures) - own_names(program)), 0.0)
    name = _free_name(program)
    parsed, (start,) = _module(declared, [_Function(name, "bool", text)])
    own = Source(label, text)
    findings = _placed(parsed.diagnostics, parsed, own, start)
    if any(one.severity is Severity.ERROR for one in findings):
        return CheckedQuery(None, findings)
    expression = _only_expression(parsed, name, start, start + len(text))
    checked = check(_files(program), cell=program.cell, visitor=parsed.file)
    findings += _placed(checked.diagnostics, parsed, own, start)
    if checked.program is None:
        if not findings:
            # The error is not in the expression: a program that may run may also be queried.
            raise QueryError("the program cannot be asked anything")
        return CheckedQuery(None, findings)
    _require_looking(expression, checked.program)
    question = ExpressionQuery(
        text,
        tuple(dict.fromkeys(_parts(expression, checked.program, text, start))),
        _is_of_task(expression, checked.program, parsed.file.modules[0]),
    )
    return CheckedQuery(question, findings)


def answers(
    task: Task, questions: Sequence[ExpressionQuery], figures: Mapping[str, float]
) -> tuple[QueryResult, ...]:
    """Evaluate expressions with the final values of a program.

    Args:
        task: The task, after its run.
        questions: Checked against the initial program.
        figures: The values of the numbers that the queries were checked with, by name.
    """
    program = task.program
    hidden = own_names(program)
    declared = {name: value for name, value in figures.items() if name not in hidden}
    stem = _free_name(program)
    functions = [
        [
            _Function(f"{stem}_{number}", "bool", question.text),
            *(
                _Function(f"{stem}_{number}_{place}", of, text)
                for place, (text, of) in enumerate(question.parts, 1)
            ),
        ]
        for number, question in enumerate(questions, 1)
    ]
    parsed, _ = _module(declared, [one for group in functions for one in group])
    checked = check(_files(program), cell=program.cell, visitor=parsed.file)
    if checked.program is None:
        # The query was checked against the initial program; unloading modules may have removed
        # names.
        return tuple(QueryResult(False, error=_first_error(checked)) for _ in questions)
    try:
        task.take(checked.program)
    except (FatalError, NotExecutableError) as error:
        return tuple(QueryResult(False, error=str(error)) for _ in questions)
    symbols = {
        routine.name.key: symbol
        for routine in parsed.file.modules[0].routines
        if isinstance(symbol := checked.program.symbol_of[routine], RoutineSymbol)
    }
    return tuple(
        _answer(task, [symbols[one.name] for one in group], question)
        for group, question in zip(functions, questions, strict=True)
    )


def _answer(
    task: Task, functions: Sequence[RoutineSymbol], question: ExpressionQuery
) -> QueryResult:
    whole, *parts = functions
    values = tuple(
        (text, told)
        for (text, _), part in zip(question.parts, parts, strict=True)
        if (told := _part_value(task, part)) is not None
    )
    try:
        return QueryResult(bool(task.call(whole)), values)
    except FatalError as error:
        return QueryResult(False, values, str(error.error))
    except Stopped as stop:
        return QueryResult(False, values, stop.reason)


def _part_value(task: Task, part: RoutineSymbol) -> str | None:
    """Value of a subexpression; None without one, as for an index out of bounds."""
    assert part.result is not None
    try:
        return value_text(task.call(part), part.result)
    except (FatalError, Stopped):
        return None


def _module(
    figures: Mapping[str, float], functions: Sequence[_Function]
) -> tuple[Parsed, list[int]]:
    """Build the internal module; return it with the offset of each function's expression."""
    taken = {one.name for one in functions}
    text = f"MODULE {free_name('rapidsim_asks', taken)}\n"
    for name, value in figures.items():
        text += f"LOCAL VAR num {name}:={value:.9G};\n"
    starts = []
    for one in functions:
        text += f"LOCAL FUNC {one.type} {one.name}()\nRETURN\n"
        starts.append(len(text))
        # On separate lines, so that a comment in the expression ends with it.
        text += f"{one.expression}\n;\nENDFUNC\n"
    return parse(Source("", f"{text}ENDMODULE\n")), starts


def _only_expression(parsed: Parsed, name: str, start: int, end: int) -> tree.Expression:
    """Return the expression; raise unless the text is exactly one expression."""
    modules = parsed.file.modules
    routines = modules[0].routines if len(modules) == 1 else ()
    if len(routines) == 1 and routines[0].name.key == name and len(routines[0].body) == 1:
        statement = routines[0].body[0]
        if isinstance(statement, tree.Return) and statement.value is not None:
            value = statement.value
            if start <= value.start and value.end <= end:
                return value
    raise QueryError("one expression is expected, without `;` and without statements")


def _files(program: Program) -> list[tree.File]:
    return [tree.File(module.source, (module,), ()) for module in program.modules]


def _free_name(program: Program) -> str:
    return free_name(_NAME, set(own_names(program)))


def _placed(
    findings: Iterable[Diagnostic], parsed: Parsed, own: Source, start: int
) -> tuple[Diagnostic, ...]:
    """Errors and warnings about the expression, at their positions in it."""
    return tuple(
        replace(one, span=_moved(one.span, own, start), related=(), fix=None, routine=None)
        for one in findings
        if one.severity is not Severity.NOTE
        and one.span is not None
        and one.span.source is parsed.file.source
    )


def _moved(span: Span, own: Source, start: int) -> Span:
    last = max(len(own.text) - 1, 0)
    first = min(max(span.start - start, 0), last)
    return Span(own, first, max(min(span.end - start, len(own.text)), first + 1))


def _require_looking(expression: tree.Expression, program: Program) -> None:
    """Reject calls with side effects, and functions of the program that are not pure."""
    for node in descendants(expression):
        if isinstance(node, tree.LateFunctionCall):
            raise QueryError("it calls a function by a name that only a run knows")
        if not isinstance(node, tree.FunctionCall):
            continue
        symbol = program.symbol_of.get(node)
        if isinstance(symbol, UnknownSymbol):
            continue  # There is a finding already.
        if isinstance(symbol, RoutineSymbol):
            _require_computing(symbol, program)
        elif not isinstance(symbol, LibrarySymbol) or not _is_read_only(symbol.routine):
            raise QueryError(f"`{node.name.text}` does more than look, or is not simulated")


def _require_computing(function: RoutineSymbol, program: Program) -> None:
    """Reject a function of the program that, also indirectly, moves, waits or asks the operator."""
    waiting, seen = [function], {function}
    while waiting:
        for node in descendants(waiting.pop().node):
            symbol = program.symbol_of.get(node)
            if isinstance(node, tree.LateFunctionCall | tree.LateCall) or _ACTS & does(symbol):
                text = f"`{symbol.name}`" if isinstance(symbol, LibrarySymbol) else "a late call"
                raise QueryError(
                    f"`{function.name}` has effects: it reaches {text}; "
                    "an assertion may call functions that compute"
                )
            if isinstance(symbol, RoutineSymbol) and symbol not in seen:
                seen.add(symbol)
                waiting.append(symbol)


def _is_read_only(routine: LibraryRoutine) -> bool:
    if ONLY_LOOKS & routine.traits:
        return True
    signature = routine.signature
    computes = not signature.takes_controller and routine.simulated
    return computes and all(one.mode is ParameterMode.IN for one in signature.parameters)


def _is_of_task(expression: tree.Expression, program: Program, own: tree.Module) -> bool:
    """Whether an expression contains data that each task has separately."""
    for node in descendants(expression):
        symbol = program.symbol_of.get(node)
        if Trait.READ_TASK in does(symbol):
            return True
        if not isinstance(symbol, DataSymbol) or symbol.module in (None, own):
            continue
        if not may_be_shared(symbol):
            return True
    return False


def _parts(
    expression: tree.Expression, program: Program, text: str, start: int
) -> Iterator[tuple[str, str]]:
    """Yield text and type of the data and calls in an expression whose values can be shown."""
    paths: set[tree.Node] = set()
    arguments: set[tree.Node | None] = set()
    for node in descendants(expression):
        match node:
            case tree.Index(array=path) | tree.ComponentAccess(record=path):
                paths.add(path)
            case tree.FunctionCall(arguments=given):
                arguments |= {
                    one.value for one in given if not isinstance(one, tree.ConditionalArgument)
                }
            case tree.DataReference():
                pass
            case _:
                continue
        of = program.type_of.get(node)
        if of is None or node in paths:
            continue
        # Functions such as DOutput read a signal among their arguments; their value shows it.
        shown = _shown_type(of) if not is_signal(of) else None if node in arguments else "num"
        if shown is not None:
            yield text[node.start - start : node.end - start], shown


def _shown_type(of: Type) -> str | None:
    """Type name of a displayed subexpression; None if its value is not shown."""
    name = resolved(of).name.lower()
    return name if name in _SHOWN else None


def _first_error(checked: CheckOutcome) -> str:
    errors = (one for one in checked.diagnostics if one.severity is Severity.ERROR)
    first = next(errors, None)
    return first.violation.message if first else "the program has changed"
