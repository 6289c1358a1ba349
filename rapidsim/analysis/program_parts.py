"""The view of a program that rules use: files cut into parts, with the facts of analysis.

A part is one routine, or the declarations of a module outside its routines. Its nodes are listed
once, so that thirty rules do not traverse the tree thirty times.
"""

from __future__ import annotations

import re
from bisect import bisect_left
from collections.abc import Callable, ItemsView, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property, reduce
from operator import attrgetter, or_
from typing import Any, TypeVar

from rapidsim.analysis.context import Analysis
from rapidsim.analysis.flow.graph import ControlFlowGraph
from rapidsim.analysis.flow.returning import may_return, returning
from rapidsim.analysis.flow.summaries import components, summarise
from rapidsim.analysis.program import LibrarySymbol, RoutineSymbol, Symbol, control_flow, does
from rapidsim.analysis.tree_walk import NodesByKind, nodes_by_kind
from rapidsim.diagnostics import Diagnostic, Fix, Related, Span, Violation
from rapidsim.library.table import LibraryRoutine
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree

N = TypeVar("N", bound=tree.Node)
V = TypeVar("V")
ENTRY = "main"
_WORD = re.compile(r"\w+")
_start = attrgetter("start")


@dataclass(frozen=True, eq=False)
class ProgramPart:
    """One routine, or the declarations of a module; `routine` is None for the latter."""

    module: tree.Module
    routine: tree.Routine | None
    nodes: NodesByKind
    memo: dict[object, Any] = field(default_factory=dict)
    """Results of functions of this part alone, by function: see `Facts.of_part`."""

    def renew(self) -> None:
        """Read the part again after the body of the routine changed, or the value of data."""
        vars(self).pop("names", None)
        vars(self).pop("words", None)
        roots = _declarations(self.module) if self.routine is None else [self.routine]
        vars(self)["nodes"] = nodes_by_kind(*roots)
        self.memo.clear()

    def all(self, kind: type[N]) -> Sequence[N]:
        """The nodes of one class, in source order."""
        return self.nodes.all(kind)

    def inside(self, body: tree.Body, *kinds: type[N]) -> Iterator[N]:
        """Yield the nodes of some classes in a statement list of this part, class by class."""
        if body:
            start, end = body[0].start, body[-1].end
            for kind in kinds:
                nodes = self.all(kind)
                first = bisect_left(nodes, start, key=_start)
                yield from nodes[first : bisect_left(nodes, end, first, key=_start)]

    def finding(
        self, violation: Violation, node: tree.Node, *related: Related, fix: Fix | None = None
    ) -> Diagnostic:
        """A finding at a node of this part."""
        return self.finding_at(violation, self.module.span(node), *related, fix=fix)

    def finding_at(
        self, violation: Violation, span: Span, *related: Related, fix: Fix | None = None
    ) -> Diagnostic:
        """A finding at a source span of this part."""
        routine = None if self.routine is None else self.routine.name.text
        return Diagnostic(violation, span, related=related, fix=fix, routine=routine)

    def place(self, node: tree.Node, message: str) -> Related:
        """A related location in this part that explains a finding."""
        return Related(self.module.span(node), message)

    def contains(self, node: tree.Node) -> bool:
        """Whether a node of the same module is inside the routine."""
        return self.routine is not None and self.routine.start <= node.start < self.routine.end

    @property
    def calls(self) -> tuple[tree.Call | tree.FunctionCall, ...]:
        """The calls of this part: statements first, then functions."""
        return (*self.all(tree.Call), *self.all(tree.FunctionCall))

    @cached_property
    def words(self) -> frozenset[str]:
        """Folded words of the text of the routine, those in strings and comments included."""
        assert self.routine is not None
        text = self.module.source.text[self.routine.start : self.routine.end]
        return frozenset(_WORD.findall(text.lower()))

    @cached_property
    def names(self) -> frozenset[str]:
        """Folded names used here: data, routines, traps; not the names of parameters."""
        return frozenset(self._names())

    def _names(self) -> Iterator[str]:
        for node in (*self.all(tree.DataReference), *self.calls):
            yield node.name.key
        for passed_on in self.all(tree.ConditionalArgument):
            yield passed_on.present.key
        for connect in self.all(tree.Connect):
            if isinstance(connect.trap, tree.Name):
                yield connect.trap.key


@dataclass(frozen=True, eq=False)
class Facts:
    """The modules of a task and the side tables of their check."""

    files: tuple[tree.File, ...]
    analysis: Analysis
    memo: dict[tree.Node, Any] = field(default_factory=dict)
    """The interpretation of calls, by call: see `rules/facts/instruction_questions.py`."""
    columns: dict[Callable[..., Any], dict[ProgramPart, Any]] = field(default_factory=dict)
    """Results of functions of one part that are not empty, by function: see `in_parts`."""

    def of_part(self, function: Callable[[ProgramPart, Facts], V], part: ProgramPart) -> V:
        """Return the result of a function of one part, computed once as long as the part stays.

        Args:
            function: Examines one part, its symbols and types, and the declarations outside of
                routines; no other routine and no other fact of the task.
            part: The part.
        """
        try:
            result: V = part.memo[function]
        except KeyError:
            result = part.memo[function] = function(part, self)
        return result

    def in_parts(
        self, function: Callable[[ProgramPart, Facts], V | None]
    ) -> ItemsView[ProgramPart, V]:
        """Return the results of a function of one part that are not empty, each with its part.

        Args:
            function: As in `of_part`.
        """
        column = self.columns.get(function)
        if column is None:
            results = ((part, self.of_part(function, part)) for part in self.parts)
            column = self.columns[function] = {part: one for part, one in results if one}
        return column.items()

    def _renew_columns(self, part: ProgramPart) -> None:
        """Put the results of a part that was read again in place of those before."""
        for function, column in list(self.columns.items()):
            result = self.of_part(function, part)
            if part in column and result:
                column[part] = result
            elif part in column:
                del column[part]
            elif result:
                # Its place is between others.
                del self.columns[function]

    def only(self, part: ProgramPart) -> Facts:
        """Return the facts as if the task had only one part."""
        facts = Facts((), self.analysis, self.memo)
        vars(facts)["parts"] = (part,)
        return facts

    def renewed(self, files: tuple[tree.File, ...], changed: Iterable[ProgramPart]) -> Facts:
        """Return the facts of the same task after the bodies of some routines changed.

        Args:
            files: The files.
            changed: The parts of these routines, which are read again.
        """
        facts = Facts(files, self.analysis, self.memo, self.columns)
        kept = dict(_FROM_PARTS)
        for part in changed:
            before = {one: part.memo.get(one) for of in kept.values() for one in of}
            part.renew()
            facts._renew_columns(part)
            # What follows from results that stay, stays.
            kept = {
                name: of
                for name, of in kept.items()
                if all(before[one] == facts.of_part(one, part) for one in of)
            }
        vars(facts).update((name, vars(self)[name]) for name in kept if name in vars(self))
        return facts

    def with_items(self, files: tuple[tree.File, ...]) -> Facts:
        """Return the facts of the same task after data and routines were replaced by others."""
        heads = {part.module: part for part in self.parts if part.routine is None}
        parts: list[ProgramPart] = []
        for file in files:
            for module in file.modules:
                parts.append(heads[module])
                parts += (
                    self.part_of.get(routine)
                    or ProgramPart(module, routine, self.analysis.nodes_of(routine))
                    for routine in module.routines
                )
        if tuple(parts) == self.parts:
            facts = Facts(files, self.analysis, self.memo, self.columns)
            vars(facts).update(
                (name, vars(self)[name]) for name in _FROM_PARTS if name in vars(self)
            )
            return facts
        facts = Facts(files, self.analysis, self.memo)
        vars(facts)["parts"] = tuple(parts)
        return facts

    @cached_property
    def parts(self) -> tuple[ProgramPart, ...]:
        """All parts, module by module: the declarations, then the routines."""
        return tuple(
            part
            for file in self.files
            for module in file.modules
            for part in self._parts_of(module)
        )

    def _parts_of(self, module: tree.Module) -> Iterator[ProgramPart]:
        yield ProgramPart(module, None, nodes_by_kind(*_declarations(module)))
        for routine in module.routines:
            yield ProgramPart(module, routine, self.analysis.nodes_of(routine))

    @cached_property
    def routine_parts(self) -> tuple[ProgramPart, ...]:
        """The parts that are routines."""
        return tuple(part for part in self.parts if part.routine is not None)

    @cached_property
    def part_of(self) -> Mapping[tree.Node, ProgramPart]:
        """The part of each routine node."""
        return {part.routine: part for part in self.routine_parts if part.routine is not None}

    @cached_property
    def call_graph(self) -> Mapping[ProgramPart, tuple[ProgramPart, ...]]:
        """The routines that each routine calls, each once."""
        part_of, called = self.part_of, dict(self.in_parts(_callees))
        return {
            part: tuple(part_of[one] for one in called.get(part, ()) if one in part_of)
            for part in self.routine_parts
        }

    @cached_property
    def bit_of(self) -> Mapping[ProgramPart, int]:
        """A bit for each routine: sets of routines are integers, which are quick to join."""
        return {part: 1 << number for number, part in enumerate(self.routine_parts)}

    @cached_property
    def components(self) -> Sequence[tuple[ProgramPart, ...]]:
        """The routines, callees first; those that call each other are in one component."""
        return components(self.routine_parts, self.call_graph.__getitem__)

    @cached_property
    def callers(self) -> Mapping[ProgramPart, Sequence[ProgramPart]]:
        """The routines that call each routine."""
        found: dict[ProgramPart, list[ProgramPart]] = {part: [] for part in self.routine_parts}
        for part, callees in self.call_graph.items():
            for callee in callees:
                found[callee].append(part)
        return found

    @cached_property
    def component_of(self) -> Mapping[ProgramPart, int]:
        """The number of the component of each routine, callees first."""
        return {part: number for number, one in enumerate(self.components) for part in one}

    @cached_property
    def recursive(self) -> int:
        """The bits of the routines that may cause themselves to run."""
        return self.bits_of(
            part
            for one in self.components
            for part in one
            if len(one) > 1 or part in self.call_graph[part]
        )

    @cached_property
    def calls_memo(self) -> dict[object, Any]:
        """Results that depend on callees, and whether routines can return, beside single parts."""
        return {}

    @cached_property
    def reached_from(self) -> Mapping[ProgramPart, int]:
        """The bits of all routines that each routine may cause to run, itself included."""

        def summary_of(part: ProgramPart, known: Mapping[ProgramPart, int]) -> int:
            return reduce(or_, (known[one] for one in self.call_graph[part]), self.bit_of[part])

        callees = self.call_graph.__getitem__
        return summarise(self.routine_parts, callees, 0, summary_of, self.components)

    @cached_property
    def returning(self) -> Mapping[tree.Routine, bool]:
        """Whether a call of each routine can return; a server with an endless loop cannot."""
        may_return_alone = dict(self.in_parts(_may_return))
        found = returning(
            self.routine_parts,
            self.call_graph.__getitem__,
            self.callee_of,
            self.flow,
            may_return_alone.__contains__,
            self.components,
        )
        return {part.routine: can for part, can in found.items() if part.routine is not None}

    def can_return(self, call: tree.Call | tree.FunctionCall) -> bool:
        """Whether control can continue past a call."""
        routine = self.routine_called(call)
        return routine is None or self.returning.get(routine, True)

    def callee_of(self, node: tree.Node) -> ProgramPart | None:
        """The routine of the task that a node calls; None for a CONNECT, which calls nothing."""
        if not isinstance(node, tree.Call | tree.FunctionCall):
            return None
        routine = self.routine_called(node)
        return None if routine is None else self.part_of.get(routine)

    def flow(self, part: ProgramPart) -> ControlFlowGraph:
        """The control-flow graph of a routine."""
        assert part.routine is not None
        return control_flow(self.analysis, part.routine, part.all(tree.FunctionCall))

    @cached_property
    def moving(self) -> int:
        """The bits of the routines with a move instruction."""
        return self.bits_of(part for part, _ in self.in_parts(_has_moves))

    def bits_of(self, parts: Iterable[ProgramPart]) -> int:
        """The bits of routines, joined."""
        return reduce(or_, (self.bit_of[part] for part in parts), 0)

    @cached_property
    def names(self) -> frozenset[str]:
        """Folded names used anywhere in the task."""
        return frozenset().union(*(names for _, names in self.in_parts(_names)))

    @cached_property
    def strings(self) -> frozenset[str]:
        """Folded texts of all strings: routines and data can be accessed by a name in a string."""
        return frozenset().union(*(texts for _, texts in self.in_parts(_strings)))

    @cached_property
    def entry(self) -> ProgramPart | None:
        """The routine `main`; without one, rules about the whole task do not apply."""
        for part in self.routine_parts:
            routine = part.routine
            if isinstance(routine, tree.Proc) and routine.name.key == ENTRY:
                return part
        return None

    @cached_property
    def is_whole(self) -> bool:
        """Whether all modules of the task seem to be here: main exists, and every call resolves."""
        analysis = self.analysis
        # No module declares a signal.
        leads_away = (
            analysis.loads_modules or not analysis.unknown.keys() <= analysis.signals.keys()
        )
        return self.entry is not None and not leads_away and self.is_read

    @property
    def is_read(self) -> bool:
        """Whether the parser could read all of the text."""
        return not self.analysis.unread_text

    def symbol(self, node: tree.Node | None) -> Symbol | None:
        """The symbol that a node refers to or declares, if known."""
        return None if node is None else self.analysis.symbol_of.get(node)

    def installed(self, call: tree.Node) -> LibraryRoutine | None:
        """The installed routine that a call invokes."""
        symbol = self.symbol(call)
        return symbol.routine if isinstance(symbol, LibrarySymbol) else None

    def does(self, call: tree.Node) -> Trait:
        """The effects of a call of an installed routine."""
        return does(self.symbol(call))

    def routine_called(self, node: tree.Node) -> tree.Routine | None:
        """The user routine that a call invokes."""
        symbol = self.symbol(node)
        return symbol.node if isinstance(symbol, RoutineSymbol) else None


def _callees(part: ProgramPart, facts: Facts) -> tuple[tree.Routine, ...]:
    """The routines of the user that a part calls, each once."""
    called = (facts.routine_called(call) for call in part.calls)
    return tuple(dict.fromkeys(routine for routine in called if routine is not None))


def _may_return(part: ProgramPart, facts: Facts) -> bool:
    """Whether a routine can return if all its callees do."""
    return part.routine is None or may_return(facts.flow(part))


def _has_moves(part: ProgramPart, facts: Facts) -> bool:
    return any(Trait.MOVE in facts.does(call) for call in part.all(tree.Call))


def _names(part: ProgramPart, facts: Facts) -> frozenset[str]:
    del facts
    return part.names


def _strings(part: ProgramPart, facts: Facts) -> frozenset[str]:
    del facts
    return frozenset(node.value.lower() for node in part.all(tree.StringLiteral))


_OF_CALLS = ("call_graph", "components", "callers", "component_of", "recursive", "reached_from")
_FROM_PARTS: Mapping[str, tuple[Callable[[ProgramPart, Facts], object], ...]] = {
    **dict.fromkeys(("parts", "routine_parts", "part_of", "bit_of", "entry"), ()),
    **dict.fromkeys(_OF_CALLS, (_callees,)),
    **dict.fromkeys(("returning", "calls_memo"), (_callees, _may_return)),
    "moving": (_has_moves,),
    "names": (_names,),
    "strings": (_strings,),
}
"""Facts of a task that has the same routines, with the results of parts from which they follow."""


def _declarations(module: tree.Module) -> list[tree.Node]:
    """The items of a module that are no routines."""
    return [item for item in module.items if not isinstance(item, tree.RoutineNode)]
