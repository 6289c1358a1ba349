"""Inference of the nums of a program that are integers: locals, parameters, function results.

A num is an integer if every value assigned to it is: integer literals and constants, counters,
sums, differences and products of integers, results of DIV and MOD on them, lengths and sizes, and
the arguments of all calls. The inference also yields bounds, by iterating to a fixed point.
Generated code uses Python integers of any size, which no program can observe: see `intervals`.

Values that other code may change or supply stay floats: module data, elements, components, data
passed by reference, options, and parameters of routines called by a name known only at run time.
If modules are loaded and unloaded while the program runs, so do all parameters and functions.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace

from rapidsim.analysis.literals import Value, literal
from rapidsim.analysis.program import (
    CounterSymbol,
    DataSymbol,
    LibrarySymbol,
    ParameterSymbol,
    Program,
    RoutineSymbol,
    Storage,
)
from rapidsim.analysis.tree_walk import clauses, descendants, statements
from rapidsim.interpreter.codegen.bound_arguments import match_arguments
from rapidsim.interpreter.codegen.conditions import narrowed, never_shows
from rapidsim.interpreter.codegen.constant_tables import bounds_of, constant_table
from rapidsim.interpreter.codegen.data_access import whole_number
from rapidsim.interpreter.codegen.escape_analysis import lent_symbols
from rapidsim.interpreter.codegen.inlined_instructions import assigned_in_place, step_in_place
from rapidsim.interpreter.codegen.intervals import (
    ONE,
    Interval,
    combined,
    counted,
    hull,
    negated,
    rounded,
    step_direction,
    widened,
)
from rapidsim.interpreter.codegen.written_paths import declaration, flat
from rapidsim.language.annotations import ParameterMode
from rapidsim.language.types import NUM, Type, resolved
from rapidsim.library.arithmetic import MAX_INTEGER
from rapidsim.syntax import tree

_SMALL = 3000
"""Maximum number of nodes of a routine whose initial values are checked for being observed."""
_SELDOM = 3
"""Number of times that bounds grow step by step before they are widened."""
_NEVER = Interval(1, 0)
"""Empty interval of an expression that is never executed, as far as known."""
_INSTALLED = {"dim": Interval(1, MAX_INTEGER), "strlen": Interval(0, MAX_INTEGER)}
"""Installed functions whose values are integers, by folded name."""

_Source = Callable[[], Interval | None]
"""Value that flows to a target, from the current intervals; None if it may be a fraction."""


def integers_of(
    program: Program, constant_value: Callable[[DataSymbol], Value]
) -> Mapping[tree.Node, Interval]:
    """Return the intervals of integer nums by declaration; of functions by their symbol.

    If control flow implies narrower bounds at a reference, the reference has its own entry.

    Args:
        program: The whole program, because every call matters.
        constant_value: Returns the value of a CONST.
    """
    routines = list(program.routine_symbols())
    inference = _Inference(program, constant_value)
    mine = [inference.candidates(routine) for routine in routines]
    for routine, own in zip(routines, mine, strict=True):
        inference.note(routine, own)
    found = inference.infer()
    for routine, own in zip(routines, mine, strict=True):
        if own:
            found.update(narrowed(routine, program, found, inference.bounds))
    return found


@dataclass(slots=True)
class _Inference:
    program: Program
    constant_value: Callable[[DataSymbol], Value]
    _intervals: dict[tree.Node, Interval | None] = field(default_factory=dict)
    """Candidates with their intervals; None for a candidate that proved to be no integer."""
    _arguments_of: dict[RoutineSymbol, tuple[ParameterSymbol, ...]] = field(default_factory=dict)
    """Candidate parameters by routine."""
    _to_functions: bool = False
    """Whether functions have candidate parameters."""
    _flows: list[tuple[tree.Node, _Source]] = field(default_factory=list)
    """Flows: the target and the value that it receives."""
    _readers: dict[tree.Node, set[int]] = field(default_factory=dict)
    """Indices of the flows that depend on a candidate."""
    _grown: dict[tree.Node, int] = field(default_factory=dict)
    """Number of times that the interval of a candidate has grown."""
    _reading: int = 0
    """Index of the flow that is being evaluated."""

    def candidates(self, routine: RoutineSymbol) -> bool:
        """Collect the candidates of a routine; return whether it has any of its own."""
        node = routine.node
        is_open = self.program.loads_modules
        given = [] if is_open else [one for one in routine.parameters if _is_plain_num(one)]
        data = _num_variables(routine, self.program)
        if given or data:
            lent = set(lent_symbols(routine, list(descendants(node)), self.program))
            given = [one for one in given if one not in lent]
            self._intervals |= {one.node: _NEVER for one in given}
            self._intervals |= {one.node: _NEVER for one in data if one.node and one not in lent}
        if given:
            self._arguments_of[routine] = tuple(given)
            self._to_functions |= routine.result is not None
        gives = routine.result is not None and _is_num(routine.result) and not is_open
        if gives:
            self._intervals[node] = _NEVER
        return bool(given or data or gives)

    def note(self, routine: RoutineSymbol, own: bool) -> None:
        """Record the assignments and arguments in a routine, even one without candidates."""
        is_small = False
        nodes: Iterable[tree.Node]
        if own or self._to_functions:
            nodes = every = list(descendants(routine.node))
            is_small = len(every) <= _SMALL
        elif self._arguments_of:
            nodes = statements(*clauses(routine.node))
        else:
            return
        for node in nodes:
            match node:
                case tree.Data(value=value) if node in self._intervals:
                    if value is not None:
                        self._flow(node, value)
                    elif not (is_small and never_shows(node, routine, self.program)):
                        self._flow(node, lambda: Interval(0, 0))
                case tree.Assignment(target=target, value=value):
                    self._flow(declaration(target, self.program), value)
                case tree.Return(value=value) if value is not None:
                    self._flow(routine.node, value)
                case tree.LateCall(arguments=arguments) if arguments:
                    self._called_with_anything()
                case tree.Call() if variable := assigned_in_place(node, self.program):
                    self._step(node, declaration(variable, self.program))
                case tree.Call() | tree.FunctionCall():
                    self._call(node)
                case _:
                    pass

    def infer(self) -> dict[tree.Node, Interval]:
        """Iterate to a fixed point."""
        waiting = deque(range(len(self._flows)))
        while waiting:
            self._reading = waiting.popleft()
            target, source = self._flows[self._reading]
            before = self._intervals[target]
            often = self._grown.get(target, 0)
            after = None if before is None else _with(before, source(), far=often > _SELDOM)
            if after != before:
                self._intervals[target], self._grown[target] = after, often + 1
                waiting += self._readers.get(target, ())
        return {
            node: interval
            for node, interval in self._intervals.items()
            if interval is not None and interval != _NEVER
        }

    def _flow(self, target: tree.Node | None, value: tree.Expression | _Source) -> None:
        if target in self._intervals:
            source = value if callable(value) else lambda: self.bounds(value)
            self._flows.append((target, source))

    def _step(self, call: tree.Call, target: tree.Node | None) -> None:
        """Incr, Decr or Clear."""
        operator = step_in_place(call, self.program)
        if operator is None:
            self._flow(target, lambda: Interval(0, 0))
        else:
            self._flow(target, lambda: self._combined(operator, self._read(target), ONE))

    def _call(self, call: tree.Call | tree.FunctionCall) -> None:
        symbol = self.program.symbol_of[call]
        if isinstance(symbol, RoutineSymbol) and symbol in self._arguments_of:
            given = match_arguments(call.arguments, symbol.parameters)
            for parameter in self._arguments_of[symbol]:
                one = given.get(parameter.name.lower())
                value = None if one is None else one.value
                self._flow(parameter.node, (lambda: None) if value is None else value)

    def _called_with_anything(self) -> None:
        """Handle the call of a procedure whose name is known only at run time."""
        for parameters in self._arguments_of.values():
            for parameter in parameters:
                self._flow(parameter.node, lambda: None)

    def _read(self, node: tree.Node | None) -> Interval | None:
        """Interval of a candidate, read for the current flow."""
        if node not in self._intervals:
            return None
        self._readers.setdefault(node, set()).add(self._reading)
        return self._intervals[node]

    def bounds(self, expression: tree.Expression) -> Interval | None:
        """Interval of an integer expression."""
        match expression:
            case tree.Parenthesised(inner=inner) | tree.Unary(operator="+", operand=inner):
                return self.bounds(inner)
            case tree.NumberLiteral():
                return _literal(literal(expression, self.program.type_of[expression]))
            case tree.DataReference():
                return self._data(expression)
            case tree.Index():
                return self._element(expression)
            case tree.FunctionCall():
                symbol = self.program.symbol_of[expression]
                if isinstance(symbol, RoutineSymbol):
                    return self._read(symbol.node)
                installed = isinstance(symbol, LibrarySymbol)
                return _INSTALLED.get(symbol.name.lower()) if installed else None
            case tree.Unary(operator="-", operand=operand):
                of = self.bounds(operand)
                return of if of is None or of == _NEVER else negated(of)
            case tree.Binary(operator=operator, left=left, right=right):
                return self._combined(operator, self.bounds(left), self.bounds(right))
            case _:
                return None

    def _data(self, reference: tree.DataReference) -> Interval | None:
        match self.program.symbol_of[reference]:
            case DataSymbol(storage=Storage.CONST) as symbol:
                return _literal(self.constant_value(symbol)) if _is_num(symbol.type) else None
            case DataSymbol(node=node) | ParameterSymbol(node=node):
                return self._read(node)
            case CounterSymbol(node=loop):
                return self._counter(loop)
            case _:
                return None

    def _element(self, path: tree.Index) -> Interval | None:
        """Interval of the integers in a constant array."""
        parts = flat(path)
        symbol = self.program.symbol_of[parts.reference]
        if not isinstance(symbol, DataSymbol):
            return None
        table = constant_table(symbol, len(parts.indices), self.constant_value)
        return None if table is None else bounds_of(table)

    def _counter(self, loop: tree.For) -> Interval | None:
        first, last = self.bounds(loop.first), self.bounds(loop.last)
        step = whole_number(loop.step)
        if first is None or first == _NEVER or last == _NEVER:
            return first if first is None else _NEVER
        if loop.step is not None and step is None:
            return None
        ends = last if last is not None and last.exact else None
        return counted(first, ends, step_direction(first, ends) if step is None else step)

    def _combined(self, operator: str, a: Interval | None, b: Interval | None) -> Interval | None:
        if a is None or b is None:
            return None
        return _NEVER if _NEVER in (a, b) else combined(operator, a, b)


def _with(before: Interval, value: Interval | None, *, far: bool) -> Interval | None:
    """Interval of a variable that receives one more value; `far` widens growing bounds."""
    if value is None or value == _NEVER:
        return None if value is None else before
    value = replace(rounded(value), size="", signed=True)
    if before == _NEVER:
        return value
    return widened(before, value) if far else hull((before, value))


def _literal(value: Value) -> Interval | None:
    """A number as an interval; a literal zero has the sign as written."""
    known = isinstance(value, float) and value.is_integer() and abs(value) <= MAX_INTEGER
    return Interval(int(value), int(value), signed=True) if known else None


def _is_plain_num(parameter: ParameterSymbol) -> bool:
    """Whether a parameter is a num that each call passes by value."""
    is_required = parameter.mode is ParameterMode.IN and not parameter.optional
    return is_required and _is_num(parameter.type)


def _num_variables(routine: RoutineSymbol, program: Program) -> list[DataSymbol]:
    return [
        symbol
        for statement in routine.node.body
        if isinstance(statement, tree.Data)
        and isinstance(symbol := program.symbol_of[statement], DataSymbol)
        and symbol.storage is Storage.VAR
        and _is_num(symbol.type)
    ]


def _is_num(of: Type) -> bool:
    return resolved(of) == NUM
