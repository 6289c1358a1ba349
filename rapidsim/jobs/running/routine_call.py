"""Call one routine of a program with values from Python, and return its results.

The call is an internal module added to the program: data for the arguments and the result, and a
procedure that makes the call. So the usual checks, conversions and execution apply.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from rapidsim.analysis.literals import Value, is_signal
from rapidsim.analysis.passes.checker import check
from rapidsim.analysis.program import ParameterSymbol, Program, RoutineSymbol
from rapidsim.analysis.types.operators import has_value
from rapidsim.diagnostics import Diagnostic, Severity, Source
from rapidsim.files import InputError, did_you_mean
from rapidsim.jobs.checking.load_tasks import LoadedTask
from rapidsim.jobs.inputs.job import Job
from rapidsim.jobs.running.run_files import (
    LoadedJob,
    ProgramRejectedError,
    executed,
    loaded,
    prepared,
)
from rapidsim.language.annotations import ParameterMode
from rapidsim.language.single_precision import single
from rapidsim.language.types import BOOL, DNUM, NUM, STRING, ArrayOf, Record, Type, resolved
from rapidsim.library.arithmetic import MAX_STRING
from rapidsim.library.text import source_text
from rapidsim.simulation.results.simulation import End, Simulation
from rapidsim.syntax import tree
from rapidsim.syntax.parser import parse
from rapidsim.values import value_class

_MODULE = "rapidsim_calls"
_OUT = (ParameterMode.INOUT, ParameterMode.VAR, ParameterMode.PERS)


class CallError(Exception):
    """A called routine did not finish; the message states the reason."""

    def __init__(self, message: str, diagnostics: tuple[Diagnostic, ...], run: Simulation) -> None:
        """Store the message, the findings and the run."""
        super().__init__(message, diagnostics, run)
        self.message = message
        self.diagnostics = diagnostics
        """Findings, with the active routines as related places, innermost first."""
        self.run = run

    def __str__(self) -> str:
        """The message."""
        return self.message


@value_class(frozen=True, slots=True)
class Returned:
    """The result of a routine."""

    result: Value | None
    """None if the routine is not a function."""
    outputs: tuple[Value, ...]
    """Values of the parameters by reference (INOUT, VAR, PERS), in their order."""
    is_function: bool


@value_class(frozen=True, slots=True)
class _Argument:
    """One argument as text: its declaration, and its text in the call."""

    name: str
    declaration: str
    passed: str
    is_output: bool


def call_routine(
    job: Job, name: str, arguments: Sequence[object], optional: Mapping[str, object]
) -> Returned:
    """Run one routine as `main` would run: with fresh data and the robot at its start.

    Args:
        job: The job whose program declares the routine.
        name: The routine's name, in any case; the first task that has it is used.
        arguments: The required arguments in order.
        optional: The optional arguments by name; True for a switch.

    Raises:
        InputError: If there is no such routine, or an argument does not fit.
        ProgramRejectedError: If the program has errors.
        CallError: If the routine stops with an error, or at a limit.
    """
    ready = loaded(job)
    if not ready.tasks:
        raise ProgramRejectedError(ready.diagnostics)
    task, routine = _find(ready.tasks, name)
    given = tuple(_arguments(routine, arguments, optional))
    entry, result = "rapidsim_calls_it", "rapidsim_result"
    text = _module(routine, given, entry, result)
    program = _with_call(task.program, text)
    only = LoadedJob(
        replace(ready.job, request=replace(job.request, entry=entry)),
        ready.robot,
        (replace(task, program=program),),
        ready.diagnostics,
    )
    finished = executed(prepared(only))
    run = finished.simulation
    if run.end is not End.ENDED:
        errors = [one for one in run.diagnostics if one.severity is Severity.ERROR]
        why = errors[-1].violation.message if errors else f"{name} did not finish"
        raise CallError(why, run.diagnostics, run)
    left = finished.tasks[task.name]
    return Returned(
        None if routine.result is None else left.value(result, _MODULE),
        tuple(left.value(one.name, _MODULE) for one in given if one.is_output),
        routine.result is not None,
    )


def _find(tasks: Sequence[LoadedTask], name: str) -> tuple[LoadedTask, RoutineSymbol]:
    names: list[str] = []
    for task in tasks:
        for symbol in _routines(task.program):
            if symbol.name.lower() == name.lower():
                return task, symbol
            names.append(symbol.name)
    raise InputError(f"the program has no routine `{name}`", did_you_mean(name, names))


def _routines(program: Program) -> Iterator[RoutineSymbol]:
    """Yield functions and procedures of all modules, global or local."""
    for module in program.modules:
        for node in module.routines:
            symbol = program.symbol_of.get(node)
            if isinstance(symbol, RoutineSymbol) and not isinstance(node, tree.Trap):
                yield symbol


def _arguments(
    routine: RoutineSymbol, arguments: Sequence[object], optional: Mapping[str, object]
) -> Iterator[_Argument]:
    required = [one for one in routine.parameters if not one.optional]
    if len(arguments) != len(required):
        names = ", ".join(f"{one.type.name} {one.name}" for one in required) or "none"
        raise InputError(
            f"`{routine.name}` takes {len(required)} required arguments ({names}), "
            f"and {len(arguments)} were given"
        )
    number = 0
    for parameter, value in zip(required, arguments, strict=True):
        number += 1
        yield _argument(routine, parameter, value, number, "")
    known = {one.name.lower(): one for one in routine.parameters if one.optional}
    for key, value in optional.items():
        found = known.get(key.lower())
        if found is None:
            cure = did_you_mean(key, [one.name for one in known.values()])
            raise InputError(f"`{routine.name}` has no optional argument `{key}`", cure)
        number += 1
        if not found.is_switch:
            yield _argument(routine, found, value, number, f"\\{found.name}:=")
        elif value:
            yield _Argument("", "", f"\\{found.name}", False)


def _argument(
    routine: RoutineSymbol, parameter: ParameterSymbol, value: object, number: int, before: str
) -> _Argument:
    what = f"`{routine.name}`, argument `{parameter.name}`"
    if is_signal(parameter.type):
        if not isinstance(value, str) or not value.isidentifier():
            raise InputError(f"{what}: the name of a signal is needed, not {value!r}")
        return _Argument("", "", before + value, False)
    if not has_value(parameter.type):
        raise InputError(f"{what}: data of type {parameter.type.name} cannot be passed in")
    name = f"rapidsim_argument_{number}"
    held = _to_rapid(value, parameter.type, what)
    storage = "PERS" if parameter.mode is ParameterMode.PERS else "VAR"
    sizes = "" if not isinstance(held, list) else f"{{{','.join(map(str, _sizes(held)))}}}"
    of = parameter.type.element if isinstance(parameter.type, ArrayOf) else parameter.type
    text = f"{storage} {of.name} {name}{sizes}:={source_text(held, parameter.type)};"
    return _Argument(name, text, before + name, parameter.mode in _OUT)


def _to_rapid(value: object, of: Type, subject: str) -> Value:
    """Convert a Python value to RAPID's representation.

    Raises:
        InputError: If it does not fit the type.
    """
    target = resolved(of)
    number = isinstance(value, int | float) or hasattr(value, "__float__")
    match target:
        case _ if target == BOOL and isinstance(value, bool):
            return value
        case _ if target in (NUM, DNUM) and number and not isinstance(value, bool):
            exact = float(value)  # type: ignore[arg-type]
            if math.isfinite(exact):
                return single(exact) if target == NUM else exact
        case _ if target == STRING and isinstance(value, str) and len(value) <= MAX_STRING:
            return value
        case Record(components=components, python=python) if _is_row(value, len(components)):
            parts = zip(components, value, strict=True)  # type: ignore[call-overload]
            return tuple.__new__(python, [_to_rapid(x, part.type, subject) for part, x in parts])
        case ArrayOf(element=element, dimensions=(size, *inner)) if _is_row(value, size):
            part: Type = ArrayOf(element, tuple(inner)) if inner else element
            return [_to_rapid(x, part, subject) for x in value]  # type: ignore[attr-defined]
    shown = repr(value)
    shown = shown if len(shown) < 60 else f"{shown[:57]}..."
    raise InputError(f"{subject}: {shown} is no {of.name}")


def _is_row(value: object, count: int | None) -> bool:
    if isinstance(value, str | bytes) or not hasattr(value, "__len__"):
        return False
    return count is None or len(value) == count


def _sizes(rows: object) -> Iterator[int]:
    while isinstance(rows, list):
        yield len(rows)
        rows = rows[0] if rows else None


def _module(routine: RoutineSymbol, bound: Sequence[_Argument], entry: str, result: str) -> str:
    passed = [one.passed for one in bound]
    required = [one for one in passed if not one.startswith("\\")]
    rest = "".join(one for one in passed if one.startswith("\\"))
    arguments = f"{','.join(required)}{rest}"
    lines = [one.declaration for one in bound if one.declaration]
    if routine.result is None:
        call = f"{routine.name} {arguments};"
    else:
        lines.append(f"VAR {routine.result.name} {result};")
        call = f"{result}:={routine.name}({arguments});"
    lines = [f"MODULE {_MODULE}", *lines, f"PROC {entry}()", call, "ENDPROC", "ENDMODULE"]
    return "\n".join(lines) + "\n"


def _with_call(program: Program, text: str) -> Program:
    visitor = parse(Source(f"<{_MODULE}>", text))
    files = [tree.File(module.source, (module,), ()) for module in program.modules]
    checked = check(files, visitor=visitor.file)
    if checked.program is None:
        found = (*visitor.diagnostics, *checked.diagnostics)
        error = next(one for one in found if one.severity is Severity.ERROR)
        raise InputError(f"the routine cannot be called: {error.violation.message}")
    return checked.program
