"""By-reference parameters that may be bound to a persistent.

Assigning to a persistent can raise its interrupts, so a routine must check for them wherever it
assigns to such a parameter. The calls in the text are complete, unless a routine is called by a
name known only at run time, or modules are loaded and unloaded.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from rapidsim.analysis.program import (
    CounterSymbol,
    DataSymbol,
    ParameterSymbol,
    Program,
    RoutineSymbol,
    Storage,
    Symbol,
)
from rapidsim.analysis.tree_walk import descendants
from rapidsim.interpreter.codegen.bound_arguments import BoundArgument, match_arguments
from rapidsim.interpreter.codegen.written_paths import bare, flat
from rapidsim.language.annotations import ParameterMode
from rapidsim.syntax import tree


def persistent_parameters(program: Program) -> frozenset[tree.Node]:
    """The parameters of all routines that may be bound to a persistent, by declaration."""
    routines = list(program.routine_symbols())
    parameters = [one for routine in routines for one in routine.parameters]
    lent: set[tree.Node] = {one.node for one in parameters if one.mode is ParameterMode.INOUT}
    found: set[tree.Node] = {one.node for one in parameters if one.mode is ParameterMode.PERS}
    if program.loads_modules:
        return frozenset(found | lent)
    takers: dict[tree.Node, set[tree.Node]] = {}
    """Parameters to which each parameter is passed on."""
    for routine in routines if lent else ():
        options = {one.name.lower(): one for one in routine.parameters}
        for node in descendants(routine.node):
            if isinstance(node, tree.LateCall) and node.arguments:
                return frozenset(found | lent)
            for taker, giver in _lent(node, options, program):
                match giver:
                    case ParameterSymbol(mode=ParameterMode.INOUT | ParameterMode.PERS, node=given):
                        takers.setdefault(given, set()).add(taker)
                    case (
                        DataSymbol(storage=Storage.VAR | Storage.CONST)
                        | ParameterSymbol()
                        | CounterSymbol()
                        | None
                    ):
                        pass
                    case _:
                        found.add(taker)
    waiting = list(found)
    while waiting:
        new = takers.get(waiting.pop(), set()) - found
        found |= new
        waiting += new
    return frozenset(found)


def _lent(
    node: tree.Node, options: Mapping[str, ParameterSymbol], program: Program
) -> Iterator[tuple[tree.Node, Symbol | None]]:
    """Data that a call passes to INOUT parameters of a user routine, by their declarations."""
    if not isinstance(node, tree.Call | tree.FunctionCall):
        return
    callee = program.symbol_of[node]
    if not isinstance(callee, RoutineSymbol):
        return
    given = match_arguments(node.arguments, callee.parameters)
    for parameter in callee.parameters:
        one = given.get(parameter.name.lower())
        if parameter.mode is ParameterMode.INOUT and one is not None:
            yield parameter.node, _giver(one, options, program)


def _giver(
    argument: BoundArgument, options: Mapping[str, ParameterSymbol], program: Program
) -> Symbol | None:
    """Data that an argument refers to; None for a temporary value."""
    if argument.caller_option is not None:
        return options.get(argument.caller_option.key)
    value = None if argument.value is None else bare(argument.value)
    if isinstance(value, tree.DataReference | tree.Index | tree.ComponentAccess):
        return program.symbol_of[flat(value).reference]
    return None
