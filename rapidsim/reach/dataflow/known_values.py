"""Values known without running the program, and why others are not.

Expressions are evaluated with the library's own functions, so a target known here is bit for bit
the one that a run computes.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from operator import ge, gt, le, lt
from typing import Any, Protocol, TypeAlias

from rapidsim.analysis.literals import from_literal, literal
from rapidsim.analysis.program import LibrarySymbol, Program, RoutineSymbol, Symbol
from rapidsim.analysis.types.operators import ARITHMETIC
from rapidsim.interpreter.codegen.calls import BoundArgument, match_arguments
from rapidsim.interpreter.codegen.special_forms import SPECIAL_FORMS
from rapidsim.language import types
from rapidsim.language.annotations import ParameterMode
from rapidsim.language.data import Orient, Pos
from rapidsim.language.errors import RapidError
from rapidsim.language.single_precision import single
from rapidsim.language.types import ArrayOf, Record, Type, resolved
from rapidsim.library import arithmetic
from rapidsim.library.table import LibraryRoutine
from rapidsim.syntax import tree
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class NotStatic:
    """A value that only a run can tell."""

    reason: str
    """Such as "`n` is asked of the operator"."""


Known: TypeAlias = Any
"""A RAPID value, or an `NotStatic`."""


class Environment(Protocol):
    """The environment of expressions: the data they read, and functions of the program."""

    def read(self, symbol: Symbol) -> Known:
        """The value of data at this point."""
        ...

    def call(self, symbol: RoutineSymbol, arguments: Sequence[tree.Argument]) -> Known:
        """The result of a function of the program."""
        ...


_NOT_TOLD = NotStatic("an expression that only a run evaluates")
_COMPARISONS: Mapping[str, Callable[[float, float], bool]] = {
    "<": lt,
    "<=": le,
    ">": gt,
    ">=": ge,
}
_ON_POSITIONS: Mapping[tuple[str, type, type], Callable[[Any, Any], Any]] = {
    ("+", Pos, Pos): arithmetic.add_positions,
    ("-", Pos, Pos): arithmetic.subtract_positions,
    ("*", Pos, float): arithmetic.scale_position,
    ("/", Pos, float): arithmetic.divide_position,
    ("*", float, Pos): arithmetic.scaled_position,
    ("*", Pos, Pos): arithmetic.cross_product,
    ("*", Orient, Orient): arithmetic.compose_orientations,
}


@value_class(frozen=True, slots=True)
class Evaluator:
    """Evaluates the expressions of a program at one point in it."""

    program: Program
    around: Environment

    def value(self, expression: tree.Expression, of: Type | None = None) -> Known:
        """The value of an expression, rounded as in an assignment; or why it is not known.

        Args:
            expression: Any expression of the program.
            of: Its type, if the program's side table has none.
        """
        of = self.program.type_of.get(expression, of)
        try:
            found = self._unrounded(expression, of)
            if isinstance(found, float) and of is not None:
                if resolved(of) != types.DNUM:
                    return single(found)
                if not abs(found) <= arithmetic.MAX_DOUBLE:
                    arithmetic.overflow(found)
        except RapidError as error:
            return NotStatic(f"it fails: {error.message}")
        except RecursionError:
            return _NOT_TOLD
        return found

    def arguments(
        self, parameters: Sequence[Any], bound: Mapping[str, BoundArgument]
    ) -> dict[str, Known] | NotStatic:
        """The argument values of a call by folded parameter name, or why one is not known."""
        values: dict[str, Known] = {}
        for parameter in parameters:
            key = parameter.name.lower()
            one = bound.get(key)
            if one is None:
                continue
            if one.caller_option is not None:
                return NotStatic(f"`{one.caller_option.text}` is passed on from the caller")
            found = True if one.value is None else self.value(one.value)
            if isinstance(found, NotStatic):
                return found
            values[key] = found
        return values

    def _unrounded(self, expression: tree.Expression, of: Type | None) -> Known:
        match expression:
            case tree.Parenthesised(inner=inner):
                return self._unrounded(inner, self.program.type_of.get(inner, of))
            case tree.DataReference():
                symbol = self.program.symbol_of.get(expression)
                return _NOT_TOLD if symbol is None else self.around.read(symbol)
            case tree.NumberLiteral() | tree.StringLiteral() | tree.BoolLiteral():
                return literal(expression, of or types.NUM)
            case tree.LiteralAggregate(value=values):
                return _NOT_TOLD if of is None else from_literal(values, of)
            case tree.Aggregate(elements=elements):
                return self._aggregate(elements, of)
            case tree.Index(array=array, indices=indices):
                return self._element(array, indices)
            case tree.ComponentAccess(record=record, name=name):
                return self._component(record, name)
            case tree.Unary(operator=operator, operand=operand):
                return self._unary(operator, operand)
            case tree.Binary(left=left, operator=operator, right=right):
                return self._binary(left, operator, right)
            case tree.FunctionCall():
                return self._function(expression)
            case _:
                return _NOT_TOLD

    def _aggregate(self, elements: Sequence[tree.Expression], of: Type | None) -> Known:
        target = None if of is None else resolved(of)
        match target:
            case Record(components=components, python=python):
                parts = [
                    self.value(element, component.type)
                    for element, component in zip(elements, components, strict=True)
                ]
                unknown = next((part for part in parts if isinstance(part, NotStatic)), None)
                return unknown or tuple.__new__(python, parts)
            case ArrayOf():
                parts = [self.value(element) for element in elements]
                return next((part for part in parts if isinstance(part, NotStatic)), parts)
            case _:
                return _NOT_TOLD

    def _element(self, array: tree.DataPath, indices: Sequence[tree.Expression]) -> Known:
        found = self.value(array)
        for index in indices:
            if isinstance(found, NotStatic):
                return found
            number = self.value(index)
            if isinstance(number, NotStatic):
                return number
            if number % 1.0 or not 1 <= number <= len(found):
                return NotStatic(f"there is no element {number:g}")
            found = found[int(number) - 1]
        return found

    def _component(self, record: tree.DataPath, name: tree.Name) -> Known:
        found = self.value(record)
        of = self.program.type_of.get(record)
        target = None if of is None else resolved(of)
        if isinstance(found, NotStatic) or not isinstance(target, Record):
            return found if isinstance(found, NotStatic) else _NOT_TOLD
        return found[component_index(target, name.key)]

    def _unary(self, operator: str, operand: tree.Expression) -> Known:
        found = self._unrounded(operand, self.program.type_of.get(operand))
        match found:
            case NotStatic():
                return found
            case bool():
                return not found
            case float():
                return -found if operator == "-" else found
            case Pos() if operator == "-":
                return arithmetic.negate_position(found)
            case _:
                return _NOT_TOLD if operator == "-" else found

    def _binary(self, left: tree.Expression, operator: str, right: tree.Expression) -> Known:
        # Operands of an arithmetic expression are rounded together with its result.
        operand = self._unrounded if operator in ARITHMETIC else self.value
        a = operand(left, self.program.type_of.get(left))
        if operator in ("AND", "OR") and isinstance(a, bool) and a is (operator == "OR"):
            return a
        b = operand(right, self.program.type_of.get(right))
        for found in (a, b):
            if isinstance(found, NotStatic):
                return found
        if operator in ("=", "<>"):
            if isinstance(a, list):
                # Elements may be unknown.
                return _NOT_TOLD
            return (a == b) is (operator == "=")
        if operator in _COMPARISONS:
            return _COMPARISONS[operator](a, b)
        match operator:
            case "AND":
                return a and b
            case "OR":
                return a or b
            case "XOR":
                return a is not b
            case _:
                pass
        if isinstance(a, float) and isinstance(b, float):
            return _computed(operator, a, b)
        if isinstance(a, str) and isinstance(b, str):
            return a + b
        function = _ON_POSITIONS.get((operator, type(a), type(b)))
        return _NOT_TOLD if function is None else function(a, b)

    def _function(self, call: tree.FunctionCall) -> Known:
        match self.program.symbol_of.get(call):
            case LibrarySymbol(routine=routine) if is_pure(routine):
                return self._library(routine, call)
            case RoutineSymbol() as symbol:
                return self.around.call(symbol, call.arguments)
            case _:
                return NotStatic(f"`{call.name.text}` tells it while the program runs")

    def _library(self, routine: LibraryRoutine, call: tree.FunctionCall) -> Known:
        signature = routine.signature
        given = match_arguments(call.arguments, signature.parameters)
        values = self.arguments(signature.parameters, given)
        if isinstance(values, NotStatic):
            return values
        there = [p for p in signature.parameters if p.name.lower() in values]
        options = {p.python: values[p.name.lower()] for p in there if p.by_keyword}
        for keyword, parameter in signature.types_of:
            of = given.get(parameter.name.lower())
            written = None if of is None or of.value is None else self.program.type_of.get(of.value)
            options[keyword] = written or types.NUM
        return routine.body(*(values[p.name.lower()] for p in there if not p.by_keyword), **options)


def is_pure(routine: LibraryRoutine) -> bool:
    """Whether an installed function depends on its arguments alone."""
    if not routine.simulated or routine.name.lower() in SPECIAL_FORMS:
        return False
    signature = routine.signature
    return (
        signature.result is not None
        and not signature.takes_controller
        and all(p.mode is ParameterMode.IN and not p.deferred for p in signature.parameters)
    )


def component_index(record: Record, key: str) -> int:
    """The index of the record component with a folded name."""
    return [component.name.lower() for component in record.components].index(key)


def _computed(operator: str, a: float, b: float) -> Known:
    match operator:
        case "+":
            return a + b
        case "-":
            return a - b
        case "*":
            return a * b
        case "/":
            return NotStatic("it divides by zero") if b == 0.0 else a / b
        case "DIV":
            return arithmetic.integer_quotient(a, b)
        case "MOD":
            return arithmetic.integer_remainder(a, b)
        case _:
            return _NOT_TOLD
