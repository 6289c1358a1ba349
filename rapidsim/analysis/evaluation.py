"""Evaluator of static expressions, with the reason why others are not static.

Values equal those in a run, bit for bit: a num is rounded to single precision as in a run, after
each arithmetic expression, not each operator; a dnum is a double. The caller provides the values of
data and the results of functions: constants for a rule, the state at a statement for an abstract
interpreter. Programs with errors are accepted, too: an expression that does not fit its
type is not static.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from operator import ge, gt, le, lt
from typing import Any, Protocol, TypeAlias

from rapidsim.analysis.literals import from_literal, literal
from rapidsim.analysis.program import Symbol
from rapidsim.language import types
from rapidsim.language.data import Orient, Pos
from rapidsim.language.errors import RapidError
from rapidsim.language.single_precision import single
from rapidsim.language.types import ArrayOf, Record, Type, resolved
from rapidsim.library import arithmetic
from rapidsim.syntax import tree
from rapidsim.values import value_class

ARITHMETIC = frozenset({"+", "-", "*", "/", "DIV", "MOD"})


@value_class(frozen=True, slots=True)
class NotStatic:
    """A value that depends on the run."""

    reason: str
    """The reason, such as "`n` is read from the operator"."""


Known: TypeAlias = Any
"""A RAPID value, or a `NotStatic`."""

NOT_STATIC = NotStatic("an expression that only a run evaluates")


class Tables(Protocol):
    """The side tables of a checked program, complete or not."""

    @property
    def symbol_of(self) -> Mapping[tree.Node, Symbol]:
        """The symbols of references and calls."""
        ...

    @property
    def type_of(self) -> Mapping[tree.Node, Type]:
        """The types of expressions."""
        ...


def _call_nothing(call: tree.FunctionCall, evaluator: Evaluator) -> Known:
    """Leave the results of functions unknown."""
    return NOT_STATIC


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
    """Evaluates the expressions of a program."""

    tables: Tables
    read: Callable[[tree.DataReference], Known]
    """Returns the value of the data that a name refers to."""
    call: Callable[[tree.FunctionCall, Evaluator], Known] = _call_nothing
    """Returns the result of a function; the evaluator is for its arguments."""

    def value(self, expression: tree.Expression, of: Type | None = None) -> Known:
        """Return the value of an expression, rounded as in an assignment, or the reason why not.

        Args:
            expression: Any expression of the program.
            of: Its type, if the side table has none.
        """
        of = self.tables.type_of.get(expression, of)
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
            return NOT_STATIC
        return found

    def _unrounded(self, expression: tree.Expression, of: Type | None) -> Known:
        match expression:
            case tree.Parenthesised(inner=inner):
                return self._unrounded(inner, self.tables.type_of.get(inner, of))
            case tree.DataReference():
                return self.read(expression)
            case tree.NumberLiteral() | tree.StringLiteral() | tree.BoolLiteral():
                return literal(expression, of or types.NUM)
            case tree.LiteralAggregate(value=values):
                return self._literal_aggregate(values, of)
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
                return self.call(expression, self)
            case _:
                return NOT_STATIC

    def _literal_aggregate(self, values: tree.LiteralValue, of: Type | None) -> Known:
        try:
            return NOT_STATIC if of is None else from_literal(values, of)
        except ValueError:
            # The number of components differs from the type's.
            return NOT_STATIC

    def _aggregate(self, elements: Sequence[tree.Expression], of: Type | None) -> Known:
        target = None if of is None else resolved(of)
        match target:
            case Record(components=components, python=python) if len(components) == len(elements):
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
                return NOT_STATIC

    def _element(self, array: tree.DataPath, indices: Sequence[tree.Expression]) -> Known:
        found = self.value(array)
        for index in indices:
            if isinstance(found, NotStatic):
                return found
            number = self.value(index)
            if isinstance(number, NotStatic):
                return number
            if not isinstance(number, float) or not isinstance(found, list):
                return NOT_STATIC
            if number % 1.0 or not 1 <= number <= len(found):
                return NotStatic(f"there is no element {number:g}")
            found = found[int(number) - 1]
        return found

    def _component(self, record: tree.DataPath, name: tree.Name) -> Known:
        found = self.value(record)
        if isinstance(found, NotStatic):
            return found
        of = self.tables.type_of.get(record)
        index = None if of is None else component_index(resolved(of), name.key)
        return NOT_STATIC if index is None else found[index]

    def _unary(self, operator: str, operand: tree.Expression) -> Known:
        found = self._unrounded(operand, self.tables.type_of.get(operand))
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
                return NOT_STATIC if operator == "-" else found

    def _binary(self, left: tree.Expression, operator: str, right: tree.Expression) -> Known:
        # Operands of an arithmetic expression are rounded together with its result.
        operand = self._unrounded if operator in ARITHMETIC else self.value
        a = operand(left, self.tables.type_of.get(left))
        if operator in ("AND", "OR") and isinstance(a, bool) and a is (operator == "OR"):
            return a
        b = operand(right, self.tables.type_of.get(right))
        for found in (a, b):
            if isinstance(found, NotStatic):
                return found
        if operator in ("=", "<>"):
            # Elements of an array may be unknown.
            return NOT_STATIC if isinstance(a, list) else (a == b) is (operator == "=")
        if isinstance(a, bool) and isinstance(b, bool):
            return _logical(operator, a, b)
        if isinstance(a, float) and isinstance(b, float):
            if operator in _COMPARISONS:
                return _COMPARISONS[operator](a, b)
            return arithmetic_result(operator, a, b)
        if isinstance(a, str) and isinstance(b, str) and operator == "+":
            text = a + b
            return text if len(text) <= arithmetic.MAX_STRING else arithmetic.too_long(text)
        function = _ON_POSITIONS.get((operator, type(a), type(b)))
        return NOT_STATIC if function is None else function(a, b)


def component_index(record: Type, key: str) -> int | None:
    """Return the index of the record component with a folded name; None without one."""
    if isinstance(record, Record):
        for index, component in enumerate(record.components):
            if component.name.lower() == key:
                return index
    return None


def arithmetic_result(operator: str, a: float, b: float) -> float | NotStatic:
    """The result of an operator on numbers, not rounded.

    Raises:
        RapidError: If DIV or MOD cannot be computed.
    """
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
            return NOT_STATIC


def _logical(operator: str, a: bool, b: bool) -> bool | NotStatic:
    match operator:
        case "AND":
            return a and b
        case "OR":
            return a or b
        case "XOR":
            return a is not b
        case _:
            return NOT_STATIC
