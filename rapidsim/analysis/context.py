"""State shared by the passes of analysis: the side tables they fill, and the current scope.

An `Analysis` lasts for one check; a `Context` is the scope that a pass is analysing.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import field, replace
from typing import TypeAlias

from rapidsim.analysis.cell_names import NO_CELL, CellNames
from rapidsim.analysis.flow.graph import ControlFlowGraph
from rapidsim.analysis.parameters import Callee, ExpectedType
from rapidsim.analysis.program import RoutineSymbol, Symbol, UnknownSymbol
from rapidsim.analysis.suggestions import closest
from rapidsim.analysis.tree_walk import NodesByKind, nodes_by_kind
from rapidsim.diagnostics import Diagnostic, Edit, Fix, Related, Span, Violation
from rapidsim.language.types import Type
from rapidsim.syntax import tree
from rapidsim.values import value_class

MOST_COMPARED = 200
"""Maximum number of unknown names for which the nearest known one is searched."""


@value_class(frozen=True, slots=True)
class SymbolTable:
    """Names of one scope, by folded name, nested inside enclosing scopes."""

    names: dict[str, Symbol]
    outer: SymbolTable | None = None

    def find(self, key: str) -> Symbol | None:
        """Return the innermost symbol of a folded name."""
        scope: SymbolTable | None = self
        while scope is not None:
            found = scope.names.get(key)
            if found is not None:
                return found
            scope = scope.outer
        return None

    def symbols(self, until: SymbolTable | None = None) -> Iterator[Symbol]:
        """Yield all symbols from the innermost scope outwards, in order of declaration.

        Args:
            until: The enclosing scope before which the search ends; None for no end.
        """
        scope: SymbolTable | None = self
        while scope is not until and scope is not None:
            yield from scope.names.values()
            scope = scope.outer


@value_class(slots=True)
class UnitResults:
    """The results of one unit of a task: a routine, or all that is outside of routines."""

    diagnostics: list[Diagnostic] = field(default_factory=list)
    undeclared: list[tuple[tree.DataReference, Context]] = field(default_factory=list)
    """Uses of undeclared names that are or may be signals, in source order."""
    signals: dict[str, Type] = field(default_factory=dict)
    """Undeclared names that an instruction uses as a signal, with the first kind of signal."""
    unknown: dict[str, UnknownSymbol] = field(default_factory=dict)
    """Undeclared names, by folded name."""
    unread: dict[str, bool] = field(default_factory=dict)
    """Folded names, each with whether it occurs in unread text: the results depend on it."""


@value_class(slots=True)
class Analysis:
    """The results of one check so far."""

    cell: CellNames = NO_CELL
    """Names that the configuration of the cell declares."""
    symbol_of: dict[tree.Node, Symbol] = field(default_factory=dict)
    type_of: dict[tree.Node, Type] = field(default_factory=dict)
    unit: UnitResults = field(default_factory=UnitResults)
    """Receives the results of the unit that is being checked."""
    unknown_symbols: dict[str, UnknownSymbol] = field(default_factory=dict)
    """Symbols of undeclared names, one each."""
    unknown: dict[str, UnknownSymbol] = field(default_factory=dict)
    """Undeclared names of all units."""
    signals: dict[str, Type] = field(default_factory=dict)
    """Undeclared names of all units that are signals, with the first kind of signal."""
    unread_text: str = ""
    """Folded text that the parser could not read; names that it may declare are not reported."""
    loads_modules: bool = False
    """Whether the task calls Load or StartLoad, so that other modules may be added at run time."""
    shapeless: set[str] = field(default_factory=set)
    """Folded names of undeclared types."""
    runs: bool = True
    """False if the program has undeclared parts that can be checked but not executed: a component
    of an undeclared type, data of a module that cannot be read.
    """
    module_of: dict[Symbol, tree.Module] = field(default_factory=dict)
    """Module that declares each symbol of the user."""
    home_of: dict[tree.Module, Context] = field(default_factory=dict)
    """Context of each module, outside its routines."""
    callees: dict[Symbol, Callee] = field(default_factory=dict)
    """The user's routines as callees, created on the first call."""
    undeclared: list[tuple[tree.DataReference, Context]] = field(default_factory=list)
    """Uses in all units of undeclared names that are or may be signals, in source order."""
    wanted_of_undeclared: dict[tree.DataReference, ExpectedType] = field(default_factory=dict)
    """Expected type of such a use, if known: not all signals have a typical name."""

    graph_of: dict[tree.Node, ControlFlowGraph] = field(default_factory=dict)
    """Control-flow graphs of routines: see `control_flow`."""

    nodes: dict[tree.Node, NodesByKind] = field(default_factory=dict)
    """Nodes of routines by class: see `nodes_of`."""

    nearest: dict[tuple[object, ...], str | None] = field(default_factory=dict)
    """Nearest known name by unknown name and scope."""

    def find_nearest(self, name: tree.Name, scope: object, candidates: Iterable[str]) -> str | None:
        """Return the known name nearest to an unknown one, compared once, not at each use.

        Args:
            name: The unknown name.
            scope: Identifies the known names, such as the module that declares them.
            candidates: Produces the known names. Beyond `MOST_COMPARED` unknown names the search
                would take too long, and the result is None.
        """
        key = (name.key, scope)
        if key not in self.nearest:
            if len(self.nearest) >= MOST_COMPARED:
                return None
            self.nearest[key] = closest(name.text, candidates)
        return self.nearest[key]

    def nodes_of(self, routine: tree.Routine) -> NodesByKind:
        """Return the nodes of a routine by class, listed once for all passes and rules."""
        nodes = self.nodes.get(routine)
        if nodes is None:
            nodes = self.nodes[routine] = nodes_by_kind(routine)
        return nodes

    def may_be_unread(self, key: str) -> bool:
        """Whether a folded name occurs in text that the parser could not read."""
        is_unread = self.unit.unread[key] = self.is_unread(key)
        return is_unread

    def is_unread(self, key: str) -> bool:
        """Answer `may_be_unread` without recording the question for the current unit."""
        return bool(self.unread_text) and bool(
            re.search(rf"\b{re.escape(key)}\b", self.unread_text)
        )

    def unknown_symbol(self, name: str) -> UnknownSymbol:
        """Return the symbol of an undeclared name."""
        key = name.lower()
        symbol = self.unknown_symbols.get(key)
        if symbol is None:
            symbol = self.unknown_symbols[key] = UnknownSymbol(name)
        self.unit.unknown[key] = symbol
        return symbol


@value_class(frozen=True, slots=True)
class Context:
    """A scope in the program: its visible names, and the receiver of findings."""

    analysis: Analysis
    module: tree.Module
    scope: SymbolTable
    routine: RoutineSymbol | None = None

    def inside(self, scope: SymbolTable) -> Context:
        """Return the context with an inner scope."""
        return replace(self, scope=scope)

    def report(
        self, violation: Violation, node: tree.Node, *related: Related, fix: Fix | None = None
    ) -> None:
        """Report a finding at a node of this module."""
        self.report_at(violation, self.module.span(node), *related, fix=fix)

    def report_at(
        self, violation: Violation, span: Span, *related: Related, fix: Fix | None = None
    ) -> None:
        """Report a finding at a source span."""
        routine = self.routine.name if self.routine else None
        self.analysis.unit.diagnostics.append(
            Diagnostic(violation, span, related=related, fix=fix, routine=routine)
        )

    def respelling(self, name: tree.Name, nearest: str | None) -> Fix | None:
        """Return the fix that replaces an unknown name by the nearest known one."""
        if nearest is None:
            return None
        edit = Edit(self.module.span(name), nearest)
        return Fix(f"replace it by `{nearest}`", (edit,), safe=False)

    def declaration(self, symbol: Symbol | None) -> tuple[Related, ...]:
        """Declaration of a symbol as a related location; empty for predefined symbols."""
        if symbol is None or symbol not in self.analysis.module_of:
            return ()
        module = self.analysis.module_of[symbol]
        node = getattr(symbol, "node", None)
        if not isinstance(node, tree.Node):
            return ()
        name = getattr(node, "name", None)
        shown = name if isinstance(name, tree.Name) else node
        return (Related(module.span(shown), f"`{symbol.name}` is declared here"),)


TypeOf: TypeAlias = Callable[[tree.Expression, Context, ExpectedType | None], Type | None]
"""Determines the types of an expression and its subexpressions.

The expected type guides literals and aggregates; it is not compared with the result. The result is
None if the type is unknown, for a reason that has been reported.
"""
