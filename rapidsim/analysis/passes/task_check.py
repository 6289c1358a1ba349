"""Check of a task by units: the declarations outside of routines, each routine, undeclared names.

The results of a routine depend on its own text, on the declarations outside of routines, and on a
few facts of the task that the results record. So a routine whose text changed is checked again by
itself, as long as those facts stay.
"""

from __future__ import annotations

import sys
from collections.abc import Collection, Iterable, Iterator, Sequence
from contextlib import contextmanager

from rapidsim.analysis.cell_names import NO_CELL, CellNames
from rapidsim.analysis.context import Analysis, Context, UnitResults
from rapidsim.analysis.installed import installed_symbol
from rapidsim.analysis.names.name_violations import UnknownUnit
from rapidsim.analysis.passes.assumed_signals import compared_signals
from rapidsim.analysis.passes.control_flow import check_flow
from rapidsim.analysis.passes.declarations import (
    Accepted,
    declare_accepted,
    declare_locals,
    open_homes,
    redeclare,
    show_local_names,
    without_duplicates,
)
from rapidsim.analysis.passes.initial_values import check_circles, check_initial_value
from rapidsim.analysis.passes.statements import check_routine_body
from rapidsim.analysis.passes.undeclared import decide_undeclared
from rapidsim.analysis.program import DataSymbol, RoutineSymbol, does
from rapidsim.analysis.suggestions import closest
from rapidsim.analysis.tolerated_syntax import check_lenient_marks
from rapidsim.analysis.tree_walk import clauses, descendants, nodes_by_kind, statements
from rapidsim.diagnostics import Diagnostic
from rapidsim.language.types import Type
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree

_DEEPEST = 20_000
"""Maximum depth of Python calls while checking; the parser limits the nesting of programs."""


class TaskCheck:
    """The check of one task, with the results of each unit."""

    def __init__(
        self,
        files: Sequence[tree.File],
        cell: CellNames = NO_CELL,
        visitor: tree.File | None = None,
    ) -> None:
        """Check all units.

        Args:
            files: The files of the task, including the visitor.
            cell: Names that the configuration declares in addition to the modules.
            visitor: One of the files that can also access the LOCAL names of the others.
        """
        self.modules = tuple(module for file in files for module in file.modules)
        self.unread: dict[tree.Item, str] = {}
        """Folded text that the parser skipped, by routine or other item."""
        self.loading: set[tree.Item] = set()
        """Routines that add modules to the program."""
        for module in self.modules:
            for item in module.items:
                self.read_item(item, module)
        self.analysis = Analysis(
            cell, unread_text="\n".join(self.unread.values()), loads_modules=bool(self.loading)
        )
        self.declarations = self.analysis.unit
        """Results of all text outside of routines but values and duplicate names."""
        self.duplicates = UnitResults()
        self.values: dict[tree.Data, UnitResults] = {}
        """Results of the values of data outside of routines."""
        self.circles = UnitResults()
        self.units: dict[tree.Routine, UnitResults] = {}
        """Results of each routine, in the order of the files."""
        self._decisions: dict[tree.Item | None, _Decisions] = {}
        """Decisions about undeclared names in each unit, which depend on all units."""
        with deep_recursion():
            self._check_declarations(visitor)
            for module in self.modules:
                for routine in module.routines:
                    self.check_routine(routine, module)
            self.decide()

    def diagnostics(self) -> Iterator[Diagnostic]:
        """Yield the findings of all units; those reported once per name at its first use."""
        for found in self._by_unit():
            yield from found
        for one in self._decisions.values():
            yield from one.results.diagnostics

    def _by_unit(self) -> Iterator[list[Diagnostic]]:
        seen: set[str] = set()
        yield self.duplicates.diagnostics
        for unit in (self.declarations, *self.values.values(), self.circles, *self.units.values()):
            if unit.unknown:
                yield [one for one in unit.diagnostics if _unit_name(one) not in seen]
                seen.update(unit.unknown)
            elif unit.diagnostics:
                yield unit.diagnostics

    def read_item(self, item: tree.Item, module: tree.Module) -> None:
        """Record whether an item has text that the parser skipped, and whether it adds modules."""
        unread: list[str] = []
        self.loading.discard(item)
        for part in statements(*clauses(item)) if isinstance(item, tree.RoutineNode) else (item,):
            if isinstance(part, tree.InvalidStatement):
                unread.append(module.span(part).text.lower())
            elif isinstance(part, tree.Call) and _loads(part):
                self.loading.add(item)
        self.unread.pop(item, None)
        if unread:
            self.unread[item] = "\n".join(unread)

    def _check_declarations(self, visitor: tree.File | None) -> None:
        self._homes = open_homes(self.modules, self.analysis)
        self._accepted = self._find_accepted()
        self.analysis.unit = self.declarations
        self.types = declare_accepted(self._accepted, self._homes)
        if visitor is not None:
            show_local_names(visitor.modules, self._homes)
        others = tree.RoutineNode | tree.Data
        for home in self._homes:
            items = (item for item in home.module.items if not isinstance(item, others))
            check_lenient_marks(nodes_by_kind(*items), home)
            for item in home.module.items:
                if isinstance(item, tree.Data):
                    self.check_data(item, home.module)
        self.check_circles()

    def _find_accepted(self) -> Accepted:
        """Find the declarations without those whose name another one before has."""
        self.analysis.unit = self.duplicates = UnitResults()
        return without_duplicates(self._homes)

    def change_items(
        self, module: tree.Module, removed: Collection[tree.Item], added: Collection[tree.Item]
    ) -> set[str] | None:
        """Replace data and routines of a module whose types are declared, but check no new one.

        Returns:
            The folded names that mean something else than before; None if more than that depends
            on the change, and the check is unusable.
        """
        for item in removed:
            self._remove(item)
        old = set(removed)
        items = [*(item for item in module.items if item not in old), *added]
        module.take_items(tuple(sorted(items, key=lambda item: item.start)))
        for item in added:
            self.read_item(item, module)
        self.analysis.unread_text = "\n".join(self.unread.values())
        before = {node for _, node in self._accepted} - old
        self._accepted = self._find_accepted()
        if {node for _, node in self._accepted}.difference(added) != before:
            # A declaration is, or is no longer, the first one of its name.
            return None
        self.analysis.unit = self.declarations
        names = redeclare(self._accepted, self._homes, self.types)
        for item in added:
            if isinstance(item, tree.Data):
                self.values[item] = UnitResults()
            elif isinstance(item, tree.Routine):
                self.units[item] = UnitResults()
        items = [item for home in self.modules for item in home.items]
        self.values = {item: self.values[item] for item in items if isinstance(item, tree.Data)}
        self.units = {item: self.units[item] for item in items if isinstance(item, tree.Routine)}
        return names

    def _remove(self, item: tree.Item) -> None:
        """Remove what is known of data or a routine."""
        analysis = self.analysis
        symbol = analysis.symbol_of.get(item)
        nodes = list(descendants(item))
        if isinstance(item, tree.Routine):
            self.forget(item, nodes)
            analysis.nodes.pop(item, None)
            del self.units[item]
        else:
            self.forget_nodes(nodes)
        if isinstance(item, tree.Data):
            del self.values[item]
        if symbol is not None:
            analysis.module_of.pop(symbol, None)
            analysis.callees.pop(symbol, None)
        self.unread.pop(item, None)
        self.loading.discard(item)

    def forget_nearest(self, names: Collection[str]) -> set[str]:
        """Remove the nearest known names that may be others now.

        Args:
            names: Folded names that mean something else than before.

        Returns:
            The unknown names, folded.
        """
        nearest = self.analysis.nearest
        stale = [
            key
            for key, known in nearest.items()
            if (known is not None and known.lower() in names)
            or closest(str(key[0]), names) is not None
        ]
        for key in stale:
            del nearest[key]
        return {str(key[0]) for key in stale}

    def check_data(self, data: tree.Data, module: tree.Module) -> None:
        """Check the value of one declaration outside of routines."""
        home = self.analysis.home_of[module]
        self.analysis.unit = self.values[data] = UnitResults()
        symbol = self.analysis.symbol_of.get(data)
        if isinstance(symbol, DataSymbol):
            check_initial_value(symbol, home)
        check_lenient_marks(nodes_by_kind(data), home)

    def check_circles(self) -> None:
        """Check that no constant outside of routines is defined by itself."""
        self.analysis.unit = self.circles = UnitResults()
        symbols = [(self.analysis.symbol_of.get(data), data) for data in self.values]
        check_circles(
            (symbol, self.analysis.home_of[symbol.module])
            for symbol, _ in symbols
            if isinstance(symbol, DataSymbol) and symbol.module is not None
        )

    def check_routine(self, routine: tree.Routine, module: tree.Module) -> None:
        """Check one routine; of two routines with one name only the notation of the second."""
        home = self.analysis.home_of[module]
        self.analysis.unit = self.units[routine] = UnitResults()
        self.analysis.nodes.pop(routine, None)
        check_lenient_marks(self.analysis.nodes_of(routine), home)
        symbol = self.analysis.symbol_of.get(routine)
        if not isinstance(symbol, RoutineSymbol):
            return
        context = declare_locals(symbol, home, self.types)
        data = list(_local_data(routine, context))
        for local, _ in data:
            check_initial_value(local, context)
        check_routine_body(routine, context)
        check_flow(routine, context)
        check_circles(data)

    def decide(self) -> set[tree.Routine | None]:
        """Decide what undeclared names are, from their uses in all units.

        Returns:
            The routines with a use that was decided differently before; None for declarations.
        """
        analysis = self.analysis
        analysis.signals, analysis.unknown, analysis.undeclared = {}, {}, []
        units: dict[tree.Item | None, UnitResults] = {None: self.declarations}
        units.update(self.values.items())
        units.update(self.units.items())
        for unit in units.values():
            for name, of in unit.signals.items():
                analysis.signals.setdefault(name, of)
            if unit.unknown:
                analysis.unknown |= unit.unknown
            if unit.undeclared:
                analysis.undeclared += unit.undeclared
        compared = compared_signals(analysis) if analysis.cell.assumes else frozenset[str]()
        reported: set[str] = set()
        before, self._decisions = self._decisions, {}
        changed: set[tree.Routine | None] = set()
        for item, unit in units.items():
            if not unit.undeclared:
                continue
            old = before.pop(item, None)
            if old is None or not old.holds(unit, analysis, reported):
                if old is not None:
                    old.withdraw(analysis)
                new = self._decisions[item] = _Decisions(unit, analysis, reported, compared)
                if new.types != ({} if old is None else old.types):
                    changed.add(item if isinstance(item, tree.Routine) else None)
            else:
                self._decisions[item] = old
                reported |= old.reported
            analysis.unknown |= self._decisions[item].results.unknown
        for old in before.values():
            old.withdraw(analysis)
        return changed

    def forget(self, routine: tree.Routine, nodes: Iterable[tree.Node]) -> None:
        """Remove what is known of the body of a routine.

        Args:
            routine: The routine, which keeps its header.
            nodes: All nodes of its body.
        """
        analysis = self.analysis
        self.forget_nodes(nodes)
        analysis.graph_of.pop(routine, None)
        own = analysis.symbol_of.get(routine)
        scopes = (own, (own, "label"))
        for key in [key for key in analysis.nearest if key[1] in scopes]:
            del analysis.nearest[key]

    def forget_nodes(self, nodes: Iterable[tree.Node]) -> None:
        """Remove what is known of nodes."""
        analysis = self.analysis
        for node in nodes:
            symbol = analysis.symbol_of.pop(node, None)
            if symbol is not None and isinstance(node, tree.Data | tree.For):
                analysis.module_of.pop(symbol, None)
            analysis.type_of.pop(node, None)
            if isinstance(node, tree.DataReference):
                analysis.wanted_of_undeclared.pop(node, None)


class _Decisions:
    """Decisions about the undeclared names in one unit, which may depend on other units."""

    def __init__(
        self, unit: UnitResults, analysis: Analysis, reported: set[str], compared: frozenset[str]
    ) -> None:
        """Decide them; see `decide_undeclared`."""
        self._unit = unit
        self._keys = list(dict.fromkeys(reference.name.key for reference, _ in unit.undeclared))
        self._known = self._knowledge(analysis, reported)
        open_uses = {
            reference: reference in analysis.type_of
            for reference, _ in unit.undeclared
            if reference not in analysis.symbol_of
        }
        before = set(reported)
        analysis.unit = self.results = UnitResults()
        decide_undeclared(unit.undeclared, analysis, reported, compared)
        self.reported = reported - before
        self.types = {
            reference: (analysis.type_of[reference], has_type)
            for reference, has_type in open_uses.items()
            if reference in analysis.symbol_of
        }
        """Types of the uses of signals, each with whether it was known before."""

    def holds(self, unit: UnitResults, analysis: Analysis, reported: set[str]) -> bool:
        """Whether a unit has the same uses, all of signals, and knows the same of them as before.

        What else a name may be depends on more of the task.
        """
        kinds = self._known[0]
        is_same = unit is self._unit and self._known == self._knowledge(analysis, reported)
        return is_same and None not in kinds

    def withdraw(self, analysis: Analysis) -> None:
        """Remove the decisions from the tables."""
        for reference, (_, has_own_type) in self.types.items():
            analysis.symbol_of.pop(reference, None)
            if not has_own_type:
                analysis.type_of.pop(reference, None)

    def _knowledge(
        self, analysis: Analysis, reported: set[str]
    ) -> tuple[list[Type | None], list[bool]]:
        """The kinds of signals that are known from their use, and whether they were reported."""
        kinds = [analysis.signals.get(key) for key in self._keys]
        return kinds, [key in reported for key in self._keys]


def _unit_name(finding: Diagnostic) -> str | None:
    """Folded name of an unknown mechanical unit, which is reported once; None without one."""
    violation = finding.violation
    return violation.unit.lower() if isinstance(violation, UnknownUnit) else None


def _local_data(routine: tree.Routine, context: Context) -> Iterator[tuple[DataSymbol, Context]]:
    for node in context.analysis.nodes_of(routine).all(tree.Data):
        symbol = context.analysis.symbol_of.get(node)
        if isinstance(symbol, DataSymbol):
            yield symbol, context


def _loads(call: tree.Call) -> bool:
    """Whether an instruction adds modules to the program; names have no symbols yet."""
    # Few instructions have such a name, so most are not looked up.
    key = call.name.key
    return key.endswith("load") and Trait.LOAD in does(installed_symbol(key))


@contextmanager
def deep_recursion() -> Iterator[None]:
    """Allow deep recursion, for trees are traversed recursively."""
    limit = sys.getrecursionlimit()
    sys.setrecursionlimit(max(limit, _DEEPEST))
    try:
        yield
    finally:
        sys.setrecursionlimit(limit)
