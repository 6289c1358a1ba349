"""Side effects of routines: data that they may write, moves, and data that may change any time.

All results are conservative: data not listed as written certainly keep their value.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import field
from functools import cached_property
from typing import TypeGuard

from rapidsim.analysis.flow.summaries import summarise
from rapidsim.analysis.program import (
    CounterSymbol,
    DataSymbol,
    LibrarySymbol,
    ParameterSymbol,
    Program,
    RoutineSymbol,
    Storage,
    Symbol,
    does,
)
from rapidsim.analysis.tree_walk import clauses, descendants, statements
from rapidsim.interpreter.codegen.bound_arguments import BoundArgument, match_arguments
from rapidsim.interpreter.codegen.data_access import by_reference
from rapidsim.interpreter.codegen.written_paths import bare
from rapidsim.language.annotations import ParameterMode
from rapidsim.language.moves import MotionSettings
from rapidsim.library.table import LibraryRoutine
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree
from rapidsim.values import value_class

_CALLS_BY_NAME = Trait.CALL_BY_NAME | Trait.CALL_ON_THE_WAY


@value_class(slots=True)
class _DirectEffects:
    """Effects of statements themselves, without those of the routines that they call."""

    writes: set[Symbol] = field(default_factory=set)
    calls: set[RoutineSymbol] = field(default_factory=set)
    gives: list[tuple[Symbol, RoutineSymbol, ParameterSymbol]] = field(default_factory=list)
    """Data passed by reference, with the routine and its parameter."""
    settings: set[str] = field(default_factory=set)
    """Fields of `MotionSettings` that its instructions set."""
    moves: bool = False
    calls_anything: bool = False
    """Whether it calls a routine whose name is known only at run time."""


@value_class(frozen=True, slots=True)
class Effects:
    """Possible effects of a part of a program, including all routines that it calls."""

    writes: frozenset[Symbol]
    settings: frozenset[str]
    moves: bool


@value_class(frozen=True, eq=False)
class ProgramEffects:
    """Effects of all routines of a program."""

    program: Program
    _locals: dict[RoutineSymbol, frozenset[Symbol]] = field(default_factory=dict)
    _of_body: dict[int, tuple[tree.Body, Effects]] = field(default_factory=dict)
    """Effects by identity, with the bodies: some are slices of others, and must stay alive."""

    @cached_property
    def routines(self) -> tuple[RoutineSymbol, ...]:
        """All routines, in source order."""
        return tuple(
            symbol
            for module in self.program.modules
            for node in module.routines
            if isinstance(symbol := self.program.symbol_of.get(node), RoutineSymbol)
        )

    @cached_property
    def everything(self) -> Effects:
        """Combined effects of all routines."""
        found = [self._routine_effects[routine] for routine in self.routines]
        return _united(found)

    @cached_property
    def volatile(self) -> frozenset[Symbol]:
        """Data that may change at any statement: traps, error handlers and similar write them."""
        aside: list[Effects] = [self.everything] if self._has_named_call else []
        for routine in self.routines:
            node = routine.node
            if isinstance(node, tree.Trap):
                aside.append(self.of_routine(routine))
            for body in list(clauses(node))[1:]:
                aside.append(self.of_bodies(body))
        return _united(aside).writes

    @cached_property
    def _has_named_call(self) -> bool:
        """Whether a move calls a procedure, by its name, somewhere on the path."""
        called = (
            self.program.symbol_of.get(node)
            for routine in self.routines
            for node in statements(*clauses(routine.node))
        )
        return any(Trait.CALL_ON_THE_WAY in does(one) for one in called)

    def of_routine(self, routine: RoutineSymbol) -> Effects:
        """Return the effects of calling a routine, including those on its parameters."""
        return self._routine_effects[routine]

    def of_bodies(self, *bodies: tree.Body) -> Effects:
        """Return the effects of lists of statements."""
        return self._with_calls(self._direct(statements(*bodies)), self._routine_effects)

    def of_body(self, body: tree.Body) -> Effects:
        """Return the effects of a list of statements, computed once."""
        known = self._of_body.get(id(body))
        if known is None:
            known = self._of_body[id(body)] = body, self.of_bodies(body)
        return known[1]

    def of_calls(self, expression: tree.Expression) -> Effects:
        """Return the effects of the calls in an expression."""
        found = _DirectEffects()
        for node in descendants(expression):
            if isinstance(node, tree.FunctionCall):
                self._add_call(node, found)
        return self._with_calls(found, self._routine_effects)

    def locals_of(self, routine: RoutineSymbol) -> frozenset[Symbol]:
        """Return the parameters of a routine, and the data and counters declared in it."""
        if routine not in self._locals:
            found: set[Symbol] = set(routine.parameters)
            for node in statements(*clauses(routine.node)):
                symbol = self.program.symbol_of.get(node)
                if isinstance(symbol, DataSymbol | CounterSymbol):
                    found.add(symbol)
            self._locals[routine] = frozenset(found)
        return self._locals[routine]

    def variables_in(self, expressions: Iterable[tree.Expression]) -> list[Symbol]:
        """Return the non-constant data that expressions read."""
        found: list[Symbol] = []
        for node in descendants(*expressions):
            if isinstance(node, tree.DataReference):
                symbol = self.program.symbol_of.get(node)
                if isinstance(symbol, DataSymbol) and symbol.storage is Storage.CONST:
                    continue
                if isinstance(symbol, DataSymbol | ParameterSymbol | CounterSymbol):
                    found.append(symbol)
        return found

    def is_written(self, symbol: Symbol) -> bool:
        """Whether the program may write the data."""
        return symbol in self.everything.writes

    def callees(self, routine: RoutineSymbol) -> Sequence[RoutineSymbol]:
        """Return the routines that a routine calls by name."""
        return tuple(self._by_routine[routine].calls)

    @cached_property
    def called(self) -> frozenset[RoutineSymbol]:
        """Routines that another routine calls by name."""
        return frozenset(one for direct in self._by_routine.values() for one in direct.calls)

    @cached_property
    def _by_routine(self) -> dict[RoutineSymbol, _DirectEffects]:
        """Effects of each routine without those of the routines that it calls."""
        return {
            routine: self._direct(statements(*clauses(routine.node))) for routine in self.routines
        }

    @cached_property
    def _routine_effects(self) -> dict[RoutineSymbol, Effects]:
        direct = self._by_routine

        def callees(routine: RoutineSymbol) -> Iterable[RoutineSymbol]:
            return self.routines if direct[routine].calls_anything else direct[routine].calls

        def effects_of(routine: RoutineSymbol, known: Mapping[RoutineSymbol, Effects]) -> Effects:
            return self._with_calls(direct[routine], known)

        nothing = Effects(frozenset(), frozenset(), moves=False)
        return summarise(self.routines, callees, nothing, effects_of)

    def _with_calls(
        self, direct: _DirectEffects, effects: Mapping[RoutineSymbol, Effects]
    ) -> Effects:
        calls = self.routines if direct.calls_anything else direct.calls
        called = map(effects.__getitem__, calls)
        below = _united(called)
        given = {
            symbol
            for symbol, routine, parameter in direct.gives
            if parameter in effects[routine].writes
        }
        return Effects(
            frozenset(direct.writes | given | below.writes),
            frozenset(direct.settings | below.settings),
            direct.moves or below.moves,
        )

    def _direct(self, body: Iterable[tree.Statement]) -> _DirectEffects:
        found = _DirectEffects()
        for statement in body:
            if isinstance(statement, tree.Assignment | tree.Connect):
                target = statement.target if isinstance(statement, tree.Assignment) else None
                written = target or getattr(statement, "interrupt", None)
                if isinstance(written, tree.DataReference | tree.Index | tree.ComponentAccess):
                    found.writes.update(self._root(written))
            for node in _own_calls(statement):
                self._add_call(node, found)
        return found

    def _add_call(self, node: tree.Node, effects: _DirectEffects) -> None:
        callee = self.program.symbol_of.get(node)
        if self.program.loads_modules and not isinstance(callee, RoutineSymbol | LibrarySymbol):
            # The routine may be in a module that is loaded at run time.
            effects.writes.update(self._all_data)
            effects.settings.update(MotionSettings.__dataclass_fields__)
            effects.moves = True
        if isinstance(node, tree.LateCall):
            effects.calls_anything = True
            for argument in node.arguments:
                effects.writes.update(self._given_data(argument))
            return
        assert isinstance(node, tree.Call | tree.FunctionCall)
        match callee:
            case RoutineSymbol() as routine:
                effects.calls.add(routine)
                given = match_arguments(node.arguments, routine.parameters)
                for parameter in routine.parameters:
                    for symbol in self._referred(parameter.mode, given.get(parameter.name.lower())):
                        effects.gives.append((symbol, routine, parameter))
            case LibrarySymbol(routine=library):
                self._add_library_call(library, node.arguments, effects)
            case _:
                for argument in node.arguments:
                    effects.writes.update(self._given_data(argument))

    def _add_library_call(
        self, library: LibraryRoutine, arguments: Sequence[tree.Argument], effects: _DirectEffects
    ) -> None:
        effects.settings.update(library.sets)
        effects.moves |= Trait.MOVE in library.traits
        if _CALLS_BY_NAME & library.traits:
            effects.calls_anything = True
        if Trait.WRITE_BY_NAME in library.traits:
            effects.writes.update(self._all_data)
        parameters = library.signature.parameters
        # Tools and work objects are PERS parameters and only read.
        written = [
            one for one in parameters if one.mode in (ParameterMode.INOUT, ParameterMode.VAR)
        ]
        given = match_arguments(arguments, parameters) if written else {}
        for parameter in written:
            effects.writes.update(self._referred(parameter.mode, given.get(parameter.name.lower())))

    def _referred(self, mode: ParameterMode, given: BoundArgument | None) -> Iterator[Symbol]:
        if given is not None and given.value is not None and by_reference(mode):
            value = bare(given.value)
            if isinstance(value, tree.DataReference | tree.Index | tree.ComponentAccess):
                yield from self._root(value)

    def _given_data(self, argument: tree.Argument) -> Iterator[Symbol]:
        value = None if isinstance(argument, tree.ConditionalArgument) else argument.value
        inner = None if value is None else bare(value)
        if isinstance(inner, tree.DataReference | tree.Index | tree.ComponentAccess):
            yield from self._root(inner)

    def _root(self, path: tree.DataPath) -> Iterator[Symbol]:
        symbol = self.program.symbol_of.get(root_of(path))
        if isinstance(symbol, ParameterSymbol) or _can_change(symbol):
            yield symbol

    @cached_property
    def _all_data(self) -> frozenset[Symbol]:
        return frozenset(
            symbol
            for module in self.program.modules
            for item in module.items
            if isinstance(item, tree.Data)
            and _can_change(symbol := self.program.symbol_of.get(item))
        )


def _can_change(symbol: Symbol | None) -> TypeGuard[DataSymbol]:
    """Whether the symbol is writable data; predefined data such as `v200` and `tool0` are not."""
    if not isinstance(symbol, DataSymbol):
        return False
    return symbol.node is not None and symbol.storage is not Storage.CONST


def root_of(path: tree.DataPath) -> tree.DataReference:
    """Return the name at the start of a path."""
    while not isinstance(path, tree.DataReference):
        path = path.array if isinstance(path, tree.Index) else path.record
    return path


def _own_calls(statement: tree.Statement) -> Iterator[tree.Node]:
    """Yield the calls of a statement, without those of statements inside it."""
    match statement:
        case tree.If(branches=branches):
            roots: list[tree.Node] = [branch.condition for branch in branches]
        case tree.CompactIf(condition=condition) | tree.While(condition=condition):
            roots = [condition]
        case tree.For(first=first, last=last, step=step):
            roots = [first, last, *([] if step is None else [step])]
        case tree.Test(subject=subject, cases=cases):
            roots = [subject, *(value for case in cases for value in case.values)]
        case _:
            roots = [statement]
    for node in descendants(*roots):
        if isinstance(node, tree.Call | tree.FunctionCall | tree.LateCall):
            yield node


def _united(effects: Iterable[Effects]) -> Effects:
    writes: set[Symbol] = set()
    settings: set[str] = set()
    moves = False
    for one in effects:
        writes |= one.writes
        settings |= one.settings
        moves |= one.moves
    return Effects(frozenset(writes), frozenset(settings), moves)
