"""Calls of undeclared routines that a module loaded at run time may declare."""

from __future__ import annotations

from typing import TypeGuard

from rapidsim.analysis.program import Program, UnknownSymbol
from rapidsim.analysis.tree_walk import descendants
from rapidsim.syntax import tree


def may_be_loaded(node: tree.Node, program: Program) -> TypeGuard[tree.Call | tree.FunctionCall]:
    """Whether a node is such a call, with arguments that are typed without a declaration."""
    return (
        program.loads_modules
        and isinstance(node, tree.Call | tree.FunctionCall)
        and isinstance(program.symbol_of[node], UnknownSymbol)
        and all(_has_value(argument, program) for argument in node.arguments)
    )


def _has_value(argument: tree.Argument, program: Program) -> bool:
    """Whether an argument has a value without its parameter: aggregates take their type from it."""
    if isinstance(argument, tree.ConditionalArgument) or argument.value is None:
        return True
    return all(
        part in program.type_of
        for part in descendants(argument.value)
        if isinstance(part, tree.DataReference | tree.Aggregate | tree.LiteralAggregate)
    )
