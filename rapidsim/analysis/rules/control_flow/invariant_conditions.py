"""Rule F418: loops and waits whose condition depends on data that nothing changes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TypeAlias

from rapidsim.analysis.program import (
    CounterSymbol,
    DataSymbol,
    ParameterSymbol,
    Scope,
    Storage,
    Symbol,
)
from rapidsim.analysis.program_parts import Facts, ProgramPart
from rapidsim.analysis.rules.facts.changed_data import CHANGES, changed_by, changed_in
from rapidsim.analysis.rules.facts.instruction_questions import arguments_of, may_do
from rapidsim.analysis.rules.facts.known_values import known_value
from rapidsim.analysis.rules.facts.reached_routines import mask_of, may_leave, may_move, reached
from rapidsim.analysis.tree_walk import descendants
from rapidsim.analysis.types.operators import ORDERING
from rapidsim.diagnostics import Diagnostic, Violation
from rapidsim.language import types
from rapidsim.language.annotations import ParameterMode
from rapidsim.language.types import ArrayOf, Record, resolved
from rapidsim.library.predefined import TYPES
from rapidsim.library.traits import LIMITS, Trait
from rapidsim.syntax import tree

_FOR_EVER_S = 60.0
_VALUES = (types.NUM, types.DNUM, types.BOOL, types.STRING)
_TASK = TYPES["taskid"]
_KNOWN = (
    *(
        tree.NumberLiteral,
        tree.StringLiteral,
        tree.BoolLiteral,
        tree.DataReference,
        tree.Index,
        tree.ComponentAccess,
        tree.Unary,
    ),
    *(tree.Binary, tree.Parenthesised, tree.FunctionCall, tree.RequiredArgument),
)
"""Nodes of conditions whose value depends on their data only."""


class UnchangingCondition(Violation, code="F418"):
    subject: str
    data: str


def find_unchanging_conditions(facts: Facts) -> Iterator[Diagnostic]:
    """Report loops that cannot end once entered, and waits that cannot end once begun."""
    task = _Task(facts)
    for part, (loops, waits) in facts.in_parts(_lasting):
        for loop in loops:
            inside = list(part.inside(loop.body, *CHANGES))
            works = may_move(inside, facts)
            data = task.unchanging(loop.condition, [loop.condition, *inside], works=works)
            if data is not None:
                keyword = tree.Node(loop.start, loop.condition.end)
                yield part.finding(UnchangingCondition("this loop", data), keyword)
        for call, condition in waits:
            data = task.unchanging(condition, [condition])
            if data is not None:
                yield part.finding(UnchangingCondition(call.name.text, data), condition)


_Loops: TypeAlias = "list[tree.While]"
_Waits: TypeAlias = "list[tuple[tree.Call, tree.Expression]]"


def _lasting(part: ProgramPart, facts: Facts) -> tuple[_Loops, _Waits] | None:
    """Loops and waits of a routine that only their condition can end; None without one."""
    if part.routine is None or part.routine.error is not None:
        # The ERROR clause may be the exit of the loop.
        return None
    found = _lasting_loops(part, facts), _lasting_waits(part, facts)
    return found if any(found) else None


def _lasting_loops(part: ProgramPart, facts: Facts) -> _Loops:
    """Loops that only their condition can end."""
    return [
        loop
        for loop in part.all(tree.While)
        if not (may_leave(loop.body, part, facts) or _is_halt(loop, facts))
    ]


def _lasting_waits(part: ProgramPart, facts: Facts) -> _Waits:
    """Waits without a time limit, with their conditions."""
    waits = [(call, _awaited(call, facts)) for call in part.all(tree.Call)]
    return [(call, condition) for call, condition in waits if condition is not None]


@dataclass(frozen=True, eq=False)
class _Task:
    """Data of a task that other parts of it may change during a loop."""

    facts: Facts

    @cached_property
    def _traps(self) -> int:
        """Bits of the routines that may run in between."""
        bits = 0
        for part in self.facts.routine_parts:
            if isinstance(part.routine, tree.Trap):
                bits |= self.facts.reached_from[part]
        return bits

    @cached_property
    def _changing(self) -> Mapping[Symbol, int]:
        """Bits of the routines that change each datum."""
        found: dict[Symbol, int] = {}
        for part, changed in self.facts.in_parts(changed_in):
            for symbol in changed:
                found[symbol] = found.get(symbol, 0) | self.facts.bit_of[part]
        return found

    @cached_property
    def _leading_away(self) -> int:
        """Bits of the routines that call unknown code."""
        return mask_of(_has_unknown_calls, self.facts)

    @cached_property
    def _is_open(self) -> bool:
        """Whether data may be changed by name, or by modules that are not available."""
        if not self.facts.is_read or self.facts.analysis.loads_modules:
            return True
        return bool(self.facts.in_parts(_writes_by_name))

    def unchanging(
        self, condition: tree.Expression, meanwhile: Iterable[tree.Node], *, works: bool = False
    ) -> str | None:
        """Text of the data of a condition if nothing changes any of them; else None.

        Args:
            condition: Condition of a loop or a wait.
            meanwhile: The condition, and the nodes of the loop.
            works: Whether the robot moves in the loop. A loop that only waits may wait for a
                client that changes a persistent; one that works counts its iterations.
        """
        if self._is_open:
            return None
        is_ordering = any(
            isinstance(node, tree.Binary) and node.operator in ORDERING
            for node in descendants(condition)
        )
        found = self._variables(condition, persistents=works and is_ordering)
        if not found:
            return None
        if self._changing.keys().isdisjoint(found) and not is_ordering:
            # A flag that nothing ever changes is an alternative notation of TRUE.
            return None
        nodes = list(meanwhile)
        changed = set(changed_by(nodes, self.facts))
        if not changed.isdisjoint(found):
            return None
        if any(not _is_local(symbol) for symbol in found):
            if any(_leads_away(node, self.facts) for node in nodes):
                return None
            between = self._traps | reached([*descendants(condition), *nodes], self.facts)
            if between & self._leading_away:
                return None
            if any(between & self._changing.get(symbol, 0) for symbol in found):
                return None
        return " or ".join(f"`{name}`" for name in sorted({symbol.name for symbol in found}))

    def _variables(
        self, condition: tree.Expression, *, persistents: bool
    ) -> set[DataSymbol | ParameterSymbol]:
        """Variables of a condition; empty if it reads anything else."""
        found: set[DataSymbol | ParameterSymbol] = set()
        for node in descendants(condition):
            if not isinstance(node, _KNOWN):
                return set()
            if isinstance(node, tree.FunctionCall) and not self._is_pure(node):
                return set()
            if not isinstance(node, tree.DataReference):
                continue
            match self.facts.symbol(node):
                case CounterSymbol() | DataSymbol(storage=Storage.CONST):
                    pass
                case DataSymbol(storage=Storage.VAR) as symbol if _has_value(symbol):
                    found.add(symbol)
                case DataSymbol(storage=Storage.PERS) as symbol if (
                    persistents and _has_value(symbol) and not self._is_shared(symbol)
                ):
                    found.add(symbol)
                case ParameterSymbol(mode=ParameterMode.IN, is_switch=False) as symbol if (
                    _has_value(symbol)
                ):
                    found.add(symbol)
                case _:
                    return set()
        return found

    def _is_shared(self, symbol: DataSymbol) -> bool:
        """Whether another task of the cell may declare the same persistent."""
        configured = self.facts.analysis.cell.symbols.values()
        tasks = sum(one.type == _TASK for one in configured)
        return tasks > 1 and symbol.scope is not Scope.LOCAL

    def _is_pure(self, call: tree.FunctionCall) -> bool:
        """Whether a function computes from its arguments only."""
        row = self.facts.installed(call)
        return row is not None and row.simulated and not row.signature.takes_controller


def _has_unknown_calls(part: ProgramPart, facts: Facts) -> bool:
    calls = (*part.calls, *part.all(tree.LateCall))
    return any(_leads_away(call, facts) for call in calls)


def _writes_by_name(part: ProgramPart, facts: Facts) -> bool:
    return any(Trait.WRITE_BY_NAME in may_do(call, facts) for call in part.calls)


def _leads_away(node: tree.Node, facts: Facts) -> bool:
    """Whether a node calls unknown code."""
    if isinstance(node, tree.LateCall):
        return True
    if not isinstance(node, tree.Call | tree.FunctionCall):
        return False
    if facts.routine_called(node) is not None:
        return False
    row = facts.installed(node)
    return row is None or bool((Trait.CALL_BY_NAME | Trait.CALL_ON_THE_WAY) & row.traits)


def _is_halt(loop: tree.While, facts: Facts) -> bool:
    """Whether a loop only waits for minutes, which is an intended halt."""
    match loop.body:
        case (tree.Call(arguments=(tree.RequiredArgument(value=time),)) as call,):
            seconds = known_value(time, facts)
            is_long = isinstance(seconds, float) and seconds >= _FOR_EVER_S
            return is_long and Trait.WAIT in facts.does(call)
        case _:
            return False


def _awaited(call: tree.Call, facts: Facts) -> tree.Expression | None:
    """Condition that an instruction waits for without a time limit."""
    if Trait.WAIT not in facts.does(call):
        return None
    given = {formal.key: value for formal, value in arguments_of(call, facts) if formal is not None}
    return None if LIMITS & given.keys() else given.get("cond")


def _is_local(symbol: DataSymbol | ParameterSymbol) -> bool:
    """Whether only the routine itself can change data."""
    return isinstance(symbol, ParameterSymbol) or symbol.scope is Scope.ROUTINE


def _has_value(symbol: DataSymbol | ParameterSymbol) -> bool:
    of = resolved(symbol.type)
    if isinstance(of, ArrayOf):
        of = resolved(of.element)
    return isinstance(of, Record) or of in _VALUES
