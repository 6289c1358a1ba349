"""A closure interpreter: each node of the tree becomes a function of the routine's variables.

It is what generated code is measured against: the same meaning (singles, checked indices, ticks,
ERROR clauses, references) in the technique one would otherwise choose. It knows what `loops.mod`
needs and refuses the rest.
"""

from __future__ import annotations

import operator
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import count
from typing import Any

from rapidsim.analysis.literals import literal
from rapidsim.analysis.program import (
    DataSymbol,
    LibrarySymbol,
    ParameterSymbol,
    Program,
    RoutineSymbol,
    Storage,
)
from rapidsim.interpreter.codegen.data_access import by_reference
from rapidsim.interpreter.codegen.written_paths import bare
from rapidsim.interpreter.runtime.arrays import assign_array, copy_array, dimension, out_of_bounds
from rapidsim.interpreter.runtime.error_recovery import ERRORS, as_rapid_error, raised
from rapidsim.interpreter.runtime.references import ComponentReference, Element
from rapidsim.language.controller import uniform_controller
from rapidsim.language.initial_values import initial_value
from rapidsim.language.reference import Box
from rapidsim.language.single_precision import single
from rapidsim.language.types import ArrayOf, Record, resolved
from rapidsim.library.arithmetic import integer_quotient, integer_remainder, steps
from rapidsim.syntax import tree

Frame = list[Any]
Closure = Callable[[Frame], Any]

RETRY, TRYNEXT, END = ("retry",), ("try next",), ("end",)
PATHS = (tree.DataReference, tree.Index, tree.ComponentAccess)
OPERATORS: dict[str, Callable[[Any, Any], Any]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
    "DIV": integer_quotient,
    "MOD": integer_remainder,
    "=": operator.eq,
    "<>": operator.ne,
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
}


class Slot:
    """A reference to a variable of a running routine."""

    def __init__(self, frame: Frame, slot: int) -> None:
        """Refer to one variable."""
        self.frame, self.slot = frame, slot

    @property
    def value(self) -> Any:
        """What the variable holds."""
        return self.frame[self.slot]

    @value.setter
    def value(self, value: Any) -> None:
        self.frame[self.slot] = value


@dataclass
class Interpreter:
    """A program as closures."""

    program: Program
    controller: Any
    routines: dict[RoutineSymbol, Callable[[Frame], Any]] = field(default_factory=dict)
    variables: dict[Any, Any] = field(default_factory=dict)
    slots: dict[Any, int] = field(default_factory=dict)

    def run(self, name: str) -> None:
        """Execute a procedure without parameters."""
        self.routine(self.program.routines[name])([])

    def routine(self, symbol: RoutineSymbol) -> Callable[[Frame], Any]:
        """A routine as a function of its arguments."""
        if symbol in self.routines:
            return self.routines[symbol]
        self.routines[symbol] = lambda arguments: self.routines[symbol](arguments)
        for slot, parameter in enumerate(symbol.parameters):
            self.slots[parameter] = slot
        numbers = count(len(symbol.parameters))
        for node in _nodes(symbol.node.body):
            if isinstance(node, tree.Data | tree.For):
                self.slots[self.program.symbol_of[node]] = next(numbers)
        extra = [None] * next(numbers)
        clause = symbol.node.error
        handler = self.body(clause.body, None) if clause else None
        body = self.body(symbol.node.body, handler)

        def call(arguments: Frame) -> Any:
            done = body([*arguments, *extra])
            return done[0] if done is not None and done is not END else None

        self.routines[symbol] = call
        return call

    def body(self, body: tree.Body, handler: Closure | None) -> Closure:
        """Statements; the closure gives None, or how the routine goes on."""
        parts = [self.statement(s, handler) for s in body]

        def run(frame: Frame) -> Any:
            for part in parts:
                done = part(frame)
                if done is not None:
                    return done
            return None

        return run

    def statement(self, node: tree.Statement, handler: Closure | None) -> Closure:
        """One statement."""
        match node:
            case tree.Assignment(target=target, value=value):
                return self.guarded(self.store(target, self.value(value)), handler)
            case tree.Call():
                call = self.call(node)
                return self.guarded(lambda frame: (call(frame), None)[1], handler)
            case tree.If(branches=branches, otherwise=otherwise):
                tests = [
                    (self.value(b.condition, handler), self.body(b.body, handler)) for b in branches
                ]
                rest = self.body(otherwise or (), handler)

                def choose(frame: Frame) -> Any:
                    for test, body in tests:
                        if test(frame):
                            return body(frame)
                    return rest(frame)

                return choose
            case tree.CompactIf(condition=condition, statement=inner):
                test, then = self.value(condition, handler), self.statement(inner, handler)
                return lambda frame: then(frame) if test(frame) else None
            case tree.While(condition=condition, body=inside):
                return self.loop_while(self.value(condition, handler), self.body(inside, handler))
            case tree.For():
                return self.loop_for(node, self.body(node.body, handler))
            case tree.Return(value=result):
                if result is None:
                    return lambda frame: END
                give = self.value(result)
                return self.guarded(lambda frame: (give(frame),), handler)
            case tree.Raise(number=None):
                return _raise_again
            case tree.Raise(number=number) if number is not None:
                which = self.value(number)

                def throw(frame: Frame) -> Any:
                    value = which(frame)
                    raise raised(value, f"{value:g}")

                return self.guarded(throw, handler)
            case tree.Retry():
                return lambda frame: RETRY
            case tree.TryNext():
                return lambda frame: TRYNEXT
            case tree.Data():
                return self.data(node)
            case _:
                raise LookupError(f"no closure for {type(node).__name__}")

    def guarded(self, closure: Closure, handler: Closure | None) -> Closure:
        """What may raise, under the ERROR clause."""
        if handler is None:
            return closure

        def run(frame: Frame) -> Any:
            while True:
                try:
                    return closure(frame)
                except ERRORS as error:
                    rapid = as_rapid_error(error)
                    self.controller.errno = rapid.errno
                    answer = handler(frame)
                    if answer is TRYNEXT:
                        return None
                    if answer is _RAISE:
                        raise rapid from None
                    if answer is not RETRY:
                        return answer or END

        return run

    def loop_while(self, test: Closure, body: Closure) -> Closure:
        """WHILE with its tick."""
        controller = self.controller

        def loop(frame: Frame) -> Any:
            while test(frame):
                controller.ticks_left -= 1
                if controller.ticks_left < 0:
                    controller.service()
                done = body(frame)
                if done is not None:
                    return done
            return None

        return loop

    def loop_for(self, node: tree.For, body: Closure) -> Closure:
        """FOR with its tick."""
        controller, slot = self.controller, self.slots[self.program.symbol_of[node]]
        parts = [self.value(part) for part in (node.first, node.last, node.step) if part]

        def loop(frame: Frame) -> Any:
            for value in steps(*(part(frame) for part in parts)):
                controller.ticks_left -= 1
                if controller.ticks_left < 0:
                    controller.service()
                frame[slot] = value
                done = body(frame)
                if done is not None:
                    return done
            return None

        return loop

    def data(self, node: tree.Data) -> Closure:
        """A local variable gets its initial value."""
        symbol = self.program.symbol_of[node]
        assert isinstance(symbol, DataSymbol)
        slot, zero = self.slots[symbol], initial_value(symbol.type)
        give = self.value(node.value) if node.value else lambda frame: zero
        if isinstance(zero, list):
            return lambda frame: frame.__setitem__(slot, copy_array(give(frame)))
        return lambda frame: frame.__setitem__(slot, give(frame))

    def value(self, node: tree.Expression, handler: Closure | None = None) -> Closure:
        """An expression as a stored value: arithmetic is rounded at its root."""
        inner, closure = bare(node), self.expression(node)
        computes = isinstance(inner, tree.Binary) and inner.operator in "+-*/"
        if computes and resolved(self.program.type_of[node]).name.lower() == "num":
            rounded = closure
            closure = lambda frame: single(rounded(frame))  # noqa: E731
        return self.guarded(closure, handler) if handler else closure

    def expression(self, node: tree.Expression) -> Closure:
        """An expression that is not rounded yet."""
        match node:
            case tree.Parenthesised(inner=inner):
                return self.expression(inner)
            case tree.Binary(left=a, operator="AND", right=b):
                left, right = self.value(a), self.value(b)
                return lambda frame: left(frame) and right(frame)
            case tree.Binary(left=a, operator="OR", right=b):
                left, right = self.value(a), self.value(b)
                return lambda frame: left(frame) or right(frame)
            case tree.Binary(left=a, operator=word, right=b):
                inside = self.expression if word in "+-*/" else self.value
                left, right, apply = inside(a), inside(b), OPERATORS[word]
                return lambda frame: apply(left(frame), right(frame))
            case tree.Unary(operator="NOT", operand=operand):
                truth = self.value(operand)
                return lambda frame: not truth(frame)
            case tree.FunctionCall():
                return self.call(node)
            case tree.DataReference() | tree.Index() | tree.ComponentAccess():
                return self.load(node)
            case _:
                constant = literal(node, self.program.type_of[node])
                if constant is None:
                    raise LookupError(f"no closure for {type(node).__name__}")
                return lambda frame: constant

    def load(self, node: tree.DataPath) -> Closure:
        """Read data."""
        match node:
            case tree.Index(array=array, indices=indices):
                holder, index = self.element(array, indices)
                return lambda frame: holder(frame)[index(frame)]
            case tree.ComponentAccess(record=record, name=name):
                whole, position = self.load(record), self.position(node, name)
                return lambda frame: whole(frame)[position]
        symbol = self.program.symbol_of[node]
        slot = self.slots.get(symbol)
        if slot is None:
            variable = self.variable(symbol)
            if isinstance(variable, list):
                return lambda frame: variable
            return lambda frame: variable.value
        if self.is_reference(symbol):
            return lambda frame: frame[slot].value
        return lambda frame: frame[slot]

    def store(self, node: tree.DataPath | tree.Placeholder, value: Closure) -> Closure:
        """Write data."""
        match node:
            case tree.Index(array=array, indices=indices):
                holder, index = self.element(array, indices)

                def set_element(frame: Frame) -> None:
                    new = value(frame)
                    holder(frame)[index(frame)] = new

                return set_element
            case tree.ComponentAccess(record=record, name=name):
                old, position = self.load(record), self.position(node, name)

                def changed(frame: Frame) -> Any:
                    parts = list(old(frame))
                    parts[position] = value(frame)
                    return tuple.__new__(type(old(frame)), parts)

                return self.store(record, changed)
        symbol = self.program.symbol_of[node]
        if isinstance(resolved(symbol.type), ArrayOf):  # type: ignore[union-attr]
            whole = self.load(node)  # type: ignore[arg-type]
            return lambda frame: assign_array(whole(frame), value(frame))
        slot = self.slots.get(symbol)
        if slot is None:
            cell = self.variable(symbol)
            return lambda frame: setattr(cell, "value", value(frame))
        if self.is_reference(symbol):
            return lambda frame: setattr(frame[slot], "value", value(frame))
        return lambda frame: frame.__setitem__(slot, value(frame))

    def refer(self, node: tree.DataPath) -> Closure:
        """A reference to data."""
        match node:
            case tree.Index(array=array, indices=indices):
                holder, index = self.element(array, indices)
                return lambda frame: Element(holder(frame), index(frame))
            case tree.ComponentAccess(record=record, name=name):
                whole, position = self.refer(record), self.position(node, name)
                return lambda frame: ComponentReference(whole(frame), (position,))
        symbol = self.program.symbol_of[node]
        if isinstance(resolved(symbol.type), ArrayOf):  # type: ignore[union-attr]
            return self.load(node)
        slot = self.slots.get(symbol)
        if slot is None:
            cell = self.variable(symbol)
            return lambda frame: cell
        if self.is_reference(symbol):
            return lambda frame: frame[slot]
        return lambda frame: Slot(frame, slot)

    def element(
        self, array: tree.DataPath, indices: tuple[tree.Expression, ...]
    ) -> tuple[Closure, Closure]:
        """The innermost list and the checked position in it."""
        holder, *positions = self.load(array), *(self.value(index) for index in indices)

        def inner(outer: Closure, position: Closure) -> Closure:
            return lambda frame: outer(frame)[_checked(outer(frame), position(frame))]

        for position in positions[:-1]:
            holder = inner(holder, position)
        last = positions[-1]
        return holder, lambda frame: _checked(holder(frame), last(frame))

    def call(self, node: tree.Call | tree.FunctionCall) -> Closure:
        """A call, whose arguments all loops give by position."""
        symbol = self.program.symbol_of[node]
        given = [a.value for a in node.arguments if isinstance(a, tree.RequiredArgument)]
        if isinstance(symbol, RoutineSymbol):
            parts = [
                self.refer(bare(value))  # type: ignore[arg-type]
                if by_reference(parameter.mode)
                else self.copy(value)
                for parameter, value in zip(symbol.parameters, given, strict=True)
            ]
            self.routine(symbol)
            routines = self.routines
            return lambda frame: routines[symbol]([part(frame) for part in parts])
        assert isinstance(symbol, LibrarySymbol)
        if symbol.name.lower() == "dim":
            array, which = self.value(given[0]), self.value(given[1])
            return lambda frame: dimension(array(frame), which(frame))
        signature, function = symbol.routine.signature, symbol.routine.body
        parts = [
            self.refer(bare(value)) if by_reference(parameter.mode) else self.value(value)  # type: ignore[arg-type]
            for parameter, value in zip(signature.parameters, given, strict=False)
        ]
        if signature.takes_controller:
            concern = signature.concern_of(uniform_controller(self.controller))
            parts.insert(0, lambda frame: concern)
        return lambda frame: function(*[part(frame) for part in parts])

    def copy(self, node: tree.Expression) -> Closure:
        """An argument by value."""
        give = self.value(node)
        if isinstance(resolved(self.program.type_of[node]), ArrayOf):
            return lambda frame: copy_array(give(frame))
        return give

    def variable(self, symbol: Any) -> Any:
        """The cell or list of module data and of constants."""
        if symbol not in self.variables:
            if symbol.node is None:
                value: Any = symbol.value
                if symbol.name.lower() == "errno":
                    self.variables[symbol] = _ErrorNumber(self.controller)
                    return self.variables[symbol]
            elif symbol.node.value is not None:
                value = self.value(symbol.node.value)([])
            else:
                value = initial_value(symbol.type)
            self.variables[symbol] = value if isinstance(value, list) else Box(value)
        return self.variables[symbol]

    def is_reference(self, symbol: Any) -> bool:
        """Whether a slot holds a reference to the data."""
        if isinstance(symbol, DataSymbol) and symbol.storage is Storage.CONST:
            return False
        is_array = isinstance(resolved(getattr(symbol, "type", None)), ArrayOf)  # type: ignore[arg-type]
        return isinstance(symbol, ParameterSymbol) and by_reference(symbol.mode) and not is_array

    def position(self, node: tree.ComponentAccess, name: tree.Name) -> int:
        """Where a component stands in its record."""
        record = node.record
        assert isinstance(record, tree.DataReference)
        of = resolved(self.program.symbol_of[record].type)  # type: ignore[union-attr]
        assert isinstance(of, Record)
        return [part.name.lower() for part in of.components].index(name.key)


class _ErrorNumber:
    """ERRNO, which the controller keeps."""

    def __init__(self, controller: Any) -> None:
        self.controller = controller

    @property
    def value(self) -> float:
        return float(self.controller.errno)


_RAISE = ("raise",)


def _raise_again(frame: Frame) -> Any:
    return _RAISE


def _checked(array: list[Any], index: float) -> int:
    if 1 <= index <= len(array) and index == int(index):
        return int(index) - 1
    out_of_bounds(index, len(array))


def _nodes(body: tree.Body) -> list[tree.Node]:
    """Every statement of a list, those inside others too."""
    found: list[tree.Node] = []
    for node in body:
        found.append(node)
        match node:
            case tree.If(branches=branches, otherwise=otherwise):
                for branch in branches:
                    found += _nodes(branch.body)
                found += _nodes(otherwise or ())
            case tree.For(body=inner) | tree.While(body=inner):
                found += _nodes(inner)
            case tree.CompactIf(statement=inner_statement):
                found += _nodes((inner_statement,))
            case _:
                continue
    return found
