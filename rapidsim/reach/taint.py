"""Taint analysis of external values: inputs, sockets, answers, files, cameras, messages.

In the run of a check nothing sets them, which may differ from the cell: a target that depends on
them would be checked with values that no controller may ever have.

The tainted data are determined without regard to order and branches: once tainted, always tainted.
"""

from __future__ import annotations

from collections.abc import Iterator

from rapidsim.analysis.literals import is_signal
from rapidsim.analysis.program import LibrarySymbol, Program, RoutineSymbol, Symbol
from rapidsim.analysis.tree_walk import descendants
from rapidsim.analysis.types.data_paths import root_of
from rapidsim.language.annotations import ParameterMode
from rapidsim.language.types import SIGNAL_AI, SIGNAL_DI, SIGNAL_GI, resolved
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree

_OUTSIDE = frozenset({"signals", "sockets", "operator", "files", "cameras", "messages"})
"""Concerns of a controller that return external values."""
_NOT_THERE = frozenset({"files", "texts", "sockets", "cameras"})
"""Concerns of a controller that behave differently in a check and in a run."""
_INPUTS = (SIGNAL_DI, SIGNAL_GI, SIGNAL_AI)
_PATHS = (tree.DataReference, tree.Index, tree.ComponentAccess)


def tainted_calls(program: Program) -> frozenset[tree.Call]:
    """Return the calls of installed instructions whose arguments depend on external values."""
    return _TaintSearch(program).calls()


def reads_inputs(program: Program) -> bool:
    """Whether a program refers to an input."""
    return any(resolved(one) in _INPUTS for one in program.type_of.values())


def reads_external_state(program: Program) -> bool:
    """Whether a program uses services that a check lacks: files, clients, cameras, modules."""
    installed = (one for one in program.symbol_of.values() if isinstance(one, LibrarySymbol))
    return any(
        one.routine.signature.concern in _NOT_THERE or Trait.LOAD in one.routine.traits
        for one in installed
    )


def is_set_externally(program: Program) -> bool:
    """Whether other programs set its persistents: some are declared without an initial value."""
    return any(
        isinstance(item, tree.Data) and item.storage == "PERS" and item.value is None
        for module in program.modules
        for item in module.items
    )


class _TaintSearch:
    """Search for the data, parameters and functions that external values reach, by symbol."""

    def __init__(self, program: Program) -> None:
        self._program = program
        self._reached: set[Symbol] = set()
        self._nodes = [
            (routine, node)
            for module in program.modules
            for routine in module.routines
            for node in descendants(routine)
            if isinstance(node, tree.Assignment | tree.Call | tree.FunctionCall | tree.Return)
        ]

    def calls(self) -> frozenset[tree.Call]:
        count = -1
        while count < len(self._reached):
            count = len(self._reached)
            for routine, node in self._nodes:
                self._reached.update(self._reaches(routine, node))
        return frozenset(
            node
            for _, node in self._nodes
            if isinstance(node, tree.Call)
            and isinstance(self._program.symbol_of.get(node), LibrarySymbol)
            and any(map(self._is_external, _values(node)))
        )

    def _reaches(self, routine: tree.RoutineNode, node: tree.Node) -> Iterator[Symbol]:
        """Yield the symbols to which a node passes external values."""
        match node:
            case tree.Assignment(target=target, value=value) if isinstance(target, _PATHS):
                if self._is_external(value):
                    yield from self._root(target)
            case tree.Return(value=value) if value is not None and self._is_external(value):
                if (symbol := self._program.symbol_of.get(routine)) is not None:
                    yield symbol
            case tree.Call() | tree.FunctionCall():
                yield from self._passed_on(node)
            case _:
                pass

    def _passed_on(self, call: tree.Call | tree.FunctionCall) -> Iterator[Symbol]:
        """Yield the symbols tainted by a call: parameters of a routine, data that it changes."""
        symbol = self._program.symbol_of.get(call)
        given = list(_values(call))
        outside = any(self._is_external(value) for value in given if not self._is_signal(value))
        changes = False
        if isinstance(symbol, RoutineSymbol):
            if outside:
                yield from symbol.parameters
            by_reference = [p for p in symbol.parameters if p.mode is not ParameterMode.IN]
            changes = any(parameter in self._reached for parameter in by_reference)
        elif isinstance(symbol, LibrarySymbol):
            signature = symbol.routine.signature
            changes = outside or signature.concern in _OUTSIDE
            changes &= any(
                p.mode in (ParameterMode.VAR, ParameterMode.INOUT) for p in signature.parameters
            )
        if changes:
            for value in given:
                if isinstance(value, _PATHS) and not self._is_signal(value):
                    yield from self._root(value)

    def _root(self, path: tree.DataPath) -> Iterator[Symbol]:
        if (symbol := self._program.symbol_of.get(root_of(path))) is not None:
            yield symbol

    def _is_external(self, value: tree.Node) -> bool:
        """Whether an expression depends on external values."""
        return any(map(self._gives, descendants(value)))

    def _gives(self, node: tree.Node) -> bool:
        if isinstance(node, tree.DataReference):
            return self._program.symbol_of.get(node) in self._reached or self._is_signal(node)
        if not isinstance(node, tree.FunctionCall):
            return False
        symbol = self._program.symbol_of.get(node)
        if isinstance(symbol, LibrarySymbol):
            return symbol.routine.signature.concern in _OUTSIDE
        return symbol in self._reached

    def _is_signal(self, value: tree.Node) -> bool:
        of = self._program.type_of.get(value)
        return of is not None and is_signal(of)


def _values(call: tree.Call | tree.FunctionCall) -> Iterator[tree.Expression]:
    for argument in call.arguments:
        if (
            isinstance(argument, tree.RequiredArgument | tree.OptionalArgument)
            and argument.value is not None
        ):
            yield argument.value
