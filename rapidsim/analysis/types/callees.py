"""Routines as callees: their parameters with the words that messages use."""

from __future__ import annotations

from functools import cache

from rapidsim.analysis.context import Context
from rapidsim.analysis.parameters import Callee, ExpectedType, Formal
from rapidsim.analysis.program import LibrarySymbol, RoutineSymbol, Symbol
from rapidsim.language.annotations import ParameterMode


def callee_of(symbol: Symbol | None, context: Context) -> Callee | None:
    """A symbol as a callee; None for unknown routines."""
    if isinstance(symbol, LibrarySymbol):
        is_open = symbol.routine.signature.is_open
        return None if is_open else callee_of_installed(symbol)
    if not isinstance(symbol, RoutineSymbol):
        return None
    callee = context.analysis.callees.get(symbol)
    if callee is None:
        callee = _of_user(symbol, context)
        context.analysis.callees[symbol] = callee
    return callee


def _of_user(symbol: RoutineSymbol, context: Context) -> Callee:
    groups = [parameter.group for parameter in symbol.parameters]
    formals = tuple(
        Formal(
            parameter.name,
            parameter.name.lower(),
            (parameter.type,),
            parameter.mode,
            parameter.optional,
            parameter.is_switch,
            parameter.group if groups.count(parameter.group) > 1 else 0,
            ExpectedType(
                parameter.type,
                f"parameter `{parameter.name}` of `{symbol.name}`",
                context.declaration(parameter),
            ),
        )
        for parameter in symbol.parameters
    )
    declared = context.declaration(symbol)
    return Callee(symbol.name, formals, symbol.result, declared, is_complete=True)


@cache
def callee_of_installed(symbol: LibrarySymbol) -> Callee:
    """An installed routine as a callee."""
    signature = symbol.routine.signature
    formals = tuple(
        Formal(
            parameter.name,
            parameter.name.lower(),
            parameter.types,
            # The mode may be too strict for a routine that is not simulated: some also accept
            # names in strings.
            ParameterMode.IN
            if parameter.mode is ParameterMode.REF and not symbol.routine.simulated
            else parameter.mode,
            parameter.optional,
            parameter.is_switch,
            parameter.group,
            ExpectedType(parameter.types[0], f"parameter `{parameter.name}` of `{symbol.name}`"),
            parameter.only,
            parameter.also,
        )
        for parameter in signature.parameters
    )
    return Callee(symbol.name, formals, signature.result, (), symbol.routine.simulated)
