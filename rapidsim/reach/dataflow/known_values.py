"""The environment of expressions in an abstract interpretation: its state, and calls.

Pure functions of the library are called as in a run, so a target known here is bit for bit the one
that a run computes.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import islice
from typing import Any, Protocol

from rapidsim.analysis.evaluation import NOT_STATIC, Evaluator, Known, NotStatic
from rapidsim.analysis.program import LibrarySymbol, Program, RoutineSymbol, Symbol
from rapidsim.interpreter.codegen.bound_arguments import BoundArgument, match_arguments
from rapidsim.interpreter.codegen.special_forms import SPECIAL_FORMS
from rapidsim.language import types
from rapidsim.language.annotations import ParameterMode
from rapidsim.library import arithmetic
from rapidsim.library.table import LibraryRoutine
from rapidsim.syntax import tree


class ProgramState(Protocol):
    """The state of a program at a statement."""

    def read(self, symbol: Symbol) -> Known:
        """The value of data."""
        ...

    def call(self, symbol: RoutineSymbol, arguments: Sequence[tree.Argument]) -> Known:
        """The result of a function of the program."""
        ...


def evaluator_of(program: Program, state: ProgramState) -> Evaluator:
    """Return the evaluator of a program's expressions in a state, which may change."""

    def read(reference: tree.DataReference) -> Known:
        symbol = program.symbol_of.get(reference)
        return NOT_STATIC if symbol is None else state.read(symbol)

    def call(call: tree.FunctionCall, evaluator: Evaluator) -> Known:
        match program.symbol_of.get(call):
            case LibrarySymbol(routine=routine) if is_pure(routine):
                return _library_result(routine, call, evaluator)
            case RoutineSymbol() as symbol:
                return state.call(symbol, call.arguments)
            case _:
                return NotStatic(f"`{call.name.text}` returns it only while the program runs")

    return Evaluator(program, read, call)


def rounds(bounds: Sequence[Known], most: int) -> list[float]:
    """Return the first values of the counter of a FOR; none if its bounds are unknown."""
    known = [bound for bound in bounds if isinstance(bound, float)]
    return list(islice(arithmetic.steps(*known), most)) if len(known) == len(bounds) else []


def argument_values(
    parameters: Sequence[Any], bound: Mapping[str, BoundArgument], evaluator: Evaluator
) -> dict[str, Known] | NotStatic:
    """The argument values of a call by folded parameter name, or why one is not static."""
    values: dict[str, Known] = {}
    for parameter in parameters:
        key = parameter.name.lower()
        argument = bound.get(key)
        if argument is None:
            continue
        if argument.caller_option is not None:
            return NotStatic(f"`{argument.caller_option.text}` is passed on from the caller")
        value = True if argument.value is None else evaluator.value(argument.value)
        if isinstance(value, NotStatic):
            return value
        values[key] = value
    return values


def _library_result(
    routine: LibraryRoutine, call: tree.FunctionCall, evaluator: Evaluator
) -> Known:
    signature = routine.signature
    bound = match_arguments(call.arguments, signature.parameters)
    values = argument_values(signature.parameters, bound, evaluator)
    if isinstance(values, NotStatic):
        return values
    present = [p for p in signature.parameters if p.name.lower() in values]
    options = {p.python: values[p.name.lower()] for p in present if p.by_keyword}
    for keyword, parameter in signature.types_of:
        argument = bound.get(parameter.name.lower())
        written = None if argument is None else argument.value
        of = None if written is None else evaluator.tables.type_of.get(written)
        options[keyword] = of or types.NUM
    return routine.body(*(values[p.name.lower()] for p in present if not p.by_keyword), **options)


def is_pure(routine: LibraryRoutine) -> bool:
    """Whether an installed function depends on its arguments alone."""
    if not routine.simulated or routine.name.lower() in SPECIAL_FORMS:
        return False
    signature = routine.signature
    return (
        signature.result is not None
        and not signature.takes_controller
        and all(p.mode is ParameterMode.IN and not p.deferred for p in signature.parameters)
    )
