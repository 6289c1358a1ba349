"""The results of analysis: symbols, and side tables keyed by tree nodes.

Nothing is written to the tree. A `Program` is created from error-free modules only, so the
interpreter need not check again.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import field
from enum import Enum
from typing import Protocol, TypeAlias

from rapidsim.analysis.cell_names import NO_CELL, CellNames, ConfiguredSymbol
from rapidsim.analysis.flow.build import build_graph
from rapidsim.analysis.flow.graph import ControlFlowGraph
from rapidsim.language.annotations import ParameterMode
from rapidsim.language.types import Type
from rapidsim.library.table import LibraryRoutine
from rapidsim.library.traits import NO_TRAITS, Trait
from rapidsim.syntax import tree
from rapidsim.values import value_class


class Storage(Enum):
    """Lifetime and mutability of data."""

    VAR = "VAR"
    PERS = "PERS"
    CONST = "CONST"


class Scope(Enum):
    """Visibility of a name."""

    INSTALLED = "installed"
    """Predefined by the system; user names hide it."""
    GLOBAL = "global"
    """All modules of the task."""
    TASK = "task"
    """All modules of the task, never shared with other tasks."""
    LOCAL = "local"
    """One module."""
    ROUTINE = "routine"
    """One routine, loop or parameter list."""


@value_class(frozen=True, eq=False, slots=True)
class DataSymbol:
    """Declared data; predefined data such as `v100` have `value` set and no `node`."""

    name: str
    type: Type
    storage: Storage
    scope: Scope
    module: tree.Module | None
    node: tree.Data | None
    value: object = None


@value_class(frozen=True, eq=False, slots=True)
class ParameterSymbol:
    """A parameter of a user routine."""

    name: str
    type: Type
    mode: ParameterMode
    optional: bool
    is_switch: bool
    node: tree.ParameterDeclaration
    group: int
    """Parameters with the same number exclude each other; required ones have unique numbers."""


@value_class(frozen=True, eq=False, slots=True)
class CounterSymbol:
    """The counter of a FOR loop."""

    name: str
    node: tree.For


@value_class(frozen=True, eq=False, slots=True)
class RoutineSymbol:
    """A user routine with its signature; `result` is None unless it is a function."""

    name: str
    node: tree.Routine
    module: tree.Module
    scope: Scope
    parameters: tuple[ParameterSymbol, ...]
    result: Type | None


@value_class(frozen=True, eq=False, slots=True)
class LibrarySymbol:
    """An installed routine."""

    name: str
    routine: LibraryRoutine


@value_class(frozen=True, eq=False, slots=True)
class TypeSymbol:
    """A user-defined record or alias."""

    name: str
    type: Type
    node: tree.RecordType | tree.AliasType
    module: tree.Module


@value_class(frozen=True, eq=False, slots=True)
class UnknownSymbol:
    """An undeclared name, reported as a warning and skipped at run time.

    Programs call routines of add-ins and use signals of their cell that no module declares; a run
    reports them and continues.
    """

    name: str


Symbol: TypeAlias = (
    DataSymbol
    | ParameterSymbol
    | CounterSymbol
    | RoutineSymbol
    | LibrarySymbol
    | TypeSymbol
    | ConfiguredSymbol
    | UnknownSymbol
)


def does(symbol: Symbol | None) -> Trait:
    """Traits of a call of an installed routine; none for other symbols."""
    return symbol.routine.traits if isinstance(symbol, LibrarySymbol) else NO_TRAITS


@value_class(frozen=True, eq=False, slots=True)
class Program:
    """A task's modules with all names and types resolved."""

    modules: tuple[tree.Module, ...]
    symbol_of: Mapping[tree.Node, Symbol]
    """Symbol of each `Reference`, `FunctionCall`, `Call`, `Connect` (trap), `ConditionalArgument`
    (the parameter passed on) and declaration; a `For` declares its counter.
    """
    type_of: Mapping[tree.Node, Type]
    """Type of each expression; aggregates are typed by their context.

    Unknown types are replaced by the expected type: calls of unknown functions, placeholders. Names
    in the arguments of a call to an unknown routine may have none.
    """
    routines: Mapping[str, RoutineSymbol]
    """Global routines by folded name, for late binding and the entry."""
    loads_modules: bool = False
    """Whether other modules may be added while it runs."""
    cell: CellNames = NO_CELL
    """Names that the configuration declares in addition to the modules."""
    missing_data: Mapping[str, str | None] = field(default_factory=dict)
    """Undeclared data by folded name, which fail at their use: the reason why a run ends there;
    None for an error of the controller.
    """
    graph_of: dict[tree.Node, ControlFlowGraph] = field(default_factory=dict)
    """Control-flow graphs, those of the check included: see `control_flow`."""

    def routine_symbols(self) -> Iterator[RoutineSymbol]:
        """The routines of all modules, in the order of the text."""
        for module in self.modules:
            for routine in module.routines:
                symbol = self.symbol_of[routine]
                if isinstance(symbol, RoutineSymbol):
                    yield symbol


class FlowTables(Protocol):
    """The side tables of a check, or a program made from them."""

    @property
    def symbol_of(self) -> Mapping[tree.Node, Symbol]:
        """Symbols by node."""

    @property
    def graph_of(self) -> dict[tree.Node, ControlFlowGraph]:
        """Control-flow graphs built so far, by routine."""


def control_flow(
    tables: FlowTables,
    routine: tree.Routine,
    functions: Sequence[tree.FunctionCall] | None = None,
) -> ControlFlowGraph:
    """Return the control-flow graph of a routine, which is built once for all uses.

    Args:
        tables: Resolves names, and keeps the graph.
        routine: A checked routine.
        functions: The function calls in it, in source order, if they are listed already.
    """
    graph = tables.graph_of.get(routine)
    if graph is None:
        graph = tables.graph_of[routine] = build_graph(
            routine, lambda call: does(tables.symbol_of.get(call)), functions
        )
    return graph
