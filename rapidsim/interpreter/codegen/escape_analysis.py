"""Escape analysis: local data that are passed by reference must live in a cell."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from rapidsim.analysis.literals import is_signal
from rapidsim.analysis.program import (
    DataSymbol,
    LibrarySymbol,
    ParameterSymbol,
    Program,
    RoutineSymbol,
    Scope,
    Storage,
    Symbol,
)
from rapidsim.interpreter.codegen.bound_arguments import BoundArgument, match_arguments
from rapidsim.interpreter.codegen.data_access import by_reference
from rapidsim.interpreter.codegen.inlined_instructions import assigned_in_place
from rapidsim.interpreter.codegen.written_paths import bare, flat
from rapidsim.interpreter.runtime.loaded_calls import may_be_loaded
from rapidsim.language.annotations import ParameterMode
from rapidsim.language.types import ArrayOf, resolved
from rapidsim.library.table import Parameter
from rapidsim.syntax import tree

_Parameters = tuple[ParameterSymbol, ...] | tuple[Parameter, ...]


def lent_symbols(
    routine: RoutineSymbol, nodes: Sequence[tree.Node], program: Program
) -> Iterator[Symbol]:
    """Local scalars that are passed by reference, some of them listed several times.

    Args:
        routine: The routine whose locals are examined.
        nodes: All nodes of the routine.
        program: Resolves names.
    """
    if not routine.parameters and not any(isinstance(node, tree.Data) for node in nodes):
        return
    options = {parameter.name.lower(): parameter for parameter in routine.parameters}
    takers: dict[Symbol, frozenset[str]] = {}
    for node in nodes:
        if isinstance(node, tree.Data):
            # A signal is read through a reference that names it.
            declared = program.symbol_of[node]
            if isinstance(declared, DataSymbol) and is_signal(declared.type):
                yield declared
        elif isinstance(node, tree.LateCall) or may_be_loaded(node, program):
            yield from _lent_to_any(node.arguments, options, program)
        elif isinstance(node, tree.Call) and assigned_in_place(node, program):
            continue
        elif isinstance(node, tree.Call | tree.FunctionCall):
            callee = program.symbol_of[node]
            parameters = _parameters(callee)
            taking = takers.get(callee)
            if taking is None:
                taking = takers[callee] = frozenset(_taking_references(parameters))
            if taking:
                arguments = match_arguments(node.arguments, parameters)
                given = [argument for name, argument in arguments.items() if name in taking]
                yield from _lent_by(given, options, program)


def _lent_to_any(
    arguments: Sequence[tree.Argument], options: Mapping[str, ParameterSymbol], program: Program
) -> Iterator[Symbol]:
    """Data that a call may lend, if only a run shows which parameters take references."""
    given = (
        BoundArgument(None, argument.present)
        if isinstance(argument, tree.ConditionalArgument)
        else BoundArgument(argument.value)
        for argument in arguments
    )
    return _lent_by(given, options, program)


def _lent_by(
    arguments: Iterable[BoundArgument], options: Mapping[str, ParameterSymbol], program: Program
) -> Iterator[Symbol]:
    """Data that arguments for references lend, also those passed on as options."""
    for argument in arguments:
        if argument.value is not None:
            yield from _lendable(argument.value, program)
        elif argument.caller_option is not None:
            option = options.get(argument.caller_option.key)
            if option is not None and _lives_in_variable(option):
                yield option


def _parameters(callee: Symbol) -> _Parameters:
    match callee:
        case RoutineSymbol(parameters=parameters):
            return parameters
        case LibrarySymbol(routine=routine):
            return routine.signature.parameters
        case _:
            return ()


def _taking_references(parameters: _Parameters) -> Iterator[str]:
    """Folded names of the parameters that take references."""
    for parameter in parameters:
        # REF parameters read the name of the argument, not its value.
        if by_reference(parameter.mode) and parameter.mode is not ParameterMode.REF:
            yield parameter.name.lower()


def _lendable(expression: tree.Expression, program: Program) -> Iterator[Symbol]:
    path = bare(expression)
    if isinstance(path, tree.DataReference | tree.Index | tree.ComponentAccess):
        symbol = program.symbol_of[flat(path).reference]
        if isinstance(symbol, DataSymbol) and symbol.scope is Scope.ROUTINE:
            if symbol.storage is Storage.VAR and not isinstance(resolved(symbol.type), ArrayOf):
                yield symbol
        elif isinstance(symbol, ParameterSymbol) and _lives_in_variable(symbol):
            yield symbol


def _lives_in_variable(parameter: ParameterSymbol) -> bool:
    """Whether the routine has its own copy of the argument, not a reference or a list."""
    is_array = isinstance(resolved(parameter.type), ArrayOf)
    return not (
        by_reference(parameter.mode) or is_array or parameter.is_switch or is_signal(parameter.type)
    )
