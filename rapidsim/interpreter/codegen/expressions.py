"""Expressions in generated code: operators, aggregates, constants.

Paths are in `data_access`, calls in `calls`, pending rounding in `expression_code`.
"""

from __future__ import annotations

import ast
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from rapidsim.analysis.literals import Value, element_type, literal
from rapidsim.analysis.program import DataSymbol, Program
from rapidsim.diagnostics import Span
from rapidsim.interpreter.codegen.ast_builder import AstBuilder, Positions
from rapidsim.interpreter.codegen.calls import Calls
from rapidsim.interpreter.codegen.data_access import DataPathTranslator, number
from rapidsim.interpreter.codegen.expression_code import (
    Code,
    DeferredCheck,
    comparable,
    finished,
    finished_integer,
    within,
)
from rapidsim.interpreter.codegen.intervals import MAX_EXACT, Interval, combined, negated
from rapidsim.interpreter.codegen.names import LocalNames
from rapidsim.interpreter.codegen.written_paths import bare
from rapidsim.interpreter.limits import MAX_EXPRESSION, NotExecutableError
from rapidsim.language.single_precision import LARGEST_SINGLE, single
from rapidsim.language.types import ArrayOf, Atomic, Record, Type, resolved
from rapidsim.library.arithmetic import MAX_INTEGER, WHOLE_FROM
from rapidsim.syntax import tree

ConstantValue = Callable[[DataSymbol], Value]
"""Returns the value of a CONST."""

_ARITHMETIC: dict[str, type[ast.operator]] = {
    "+": ast.Add,
    "-": ast.Sub,
    "*": ast.Mult,
    "/": ast.Div,
}
_COMPARISONS: dict[str, type[ast.cmpop]] = {
    "=": ast.Eq,
    "<>": ast.NotEq,
    "<": ast.Lt,
    "<=": ast.LtE,
    ">": ast.Gt,
    ">=": ast.GtE,
    "XOR": ast.NotEq,
}
_LOGICAL: dict[str, type[ast.boolop]] = {"AND": ast.And, "OR": ast.Or}
_CHECKED = (DeferredCheck.CHECKED_SINGLE, DeferredCheck.CHECKED_DOUBLE)
_INTEGER = {"DIV": "_quotient", "MOD": "_remainder"}
_WHOLE = {"DIV": "_whole_quotient", "MOD": "_whole_remainder"}
"""Function by operator, for Python integers."""
_POSITIONS = {
    ("+", "pos", "pos"): "_add_positions",
    ("-", "pos", "pos"): "_subtract_positions",
    ("*", "pos", "pos"): "_cross_product",
    ("*", "pos", "num"): "_scale_position",
    ("/", "pos", "num"): "_divide_position",
    ("*", "orient", "orient"): "_compose_orientations",
}


@dataclass(slots=True)
class Expressions:
    """Translates the expressions of one routine, statement by statement."""

    program: Program
    names: LocalNames
    positions: Positions
    module: tree.Module
    constant_value: ConstantValue
    integers: Mapping[tree.Node, Interval]
    """Variables and functions with integer values, from `integer_inference`."""
    statement: AstBuilder = field(default_factory=lambda: AstBuilder(1, 0, 0))
    """Position of the statement whose expressions are translated."""
    counters: dict[str, Interval] = field(default_factory=dict)
    """FOR counters that are Python integers, by Python name."""
    paths: DataPathTranslator = field(init=False)
    calls: Calls = field(init=False)
    _depth: int = 0

    def __post_init__(self) -> None:
        """Connect the translators that translate each other's operands."""
        self.paths = DataPathTranslator(self)
        self.calls = Calls(self, self.paths)

    def at(self, node: tree.Node) -> AstBuilder:
        """The position of a part of the statement."""
        return self.positions.within(self.statement, node)

    def span(self, node: tree.Node) -> Span:
        """The source span of a node, for messages."""
        return self.module.span(node)

    def type_of(self, expression: tree.Expression) -> Type:
        """The type of an expression."""
        if isinstance(expression, tree.DataReference | tree.Index | tree.ComponentAccess):
            return self.paths.type_of(expression)
        return self.program.type_of[expression]

    def value(self, expression: tree.Expression) -> Code:
        """An expression as the value stored in a variable; arrays are not copied."""
        return finished(self.code(expression), self.at(expression))

    def copy(self, expression: tree.Expression, home: tree.Node | None = None) -> Code:
        """Like `value`, but an array is copied to an unshared list.

        Args:
            expression: The expression to copy.
            home: The declaration of the variable or function that gets the value.
        """
        if home in self.integers:
            return finished_integer(self.code(expression), self.at(expression))
        code = self.value(expression)
        # A literal aggregate is a constant of the namespace; functions return lists of their own.
        shared = isinstance(
            bare(expression),
            tree.DataReference | tree.Index | tree.LiteralAggregate | tree.Aggregate,
        )
        if shared and isinstance(resolved(self.type_of(expression)), ArrayOf):
            node = self.at(expression).call("_copy_array", [code.node])
            return Code(node, may_raise=code.may_raise, calls=code.calls)
        return code

    def condition(self, expression: tree.Expression) -> Code:
        """A bool for a Python `if`."""
        return self.code(expression)

    def constant_data(self, symbol: DataSymbol, at: AstBuilder) -> ast.expr:
        """A CONST: plain values are inlined, records and arrays are referred to by name."""
        value = self.constant_value(symbol)
        if isinstance(value, float | str | bool):
            return at.constant(value)
        return at.name(self.names.module.constant_data(symbol, value))

    def code(self, expression: tree.Expression) -> Code:
        """An expression whose result may still need rounding."""
        self._depth += 1
        if self._depth > MAX_EXPRESSION:
            raise NotExecutableError(
                f"an expression nested more than {MAX_EXPRESSION} deep", self.span(expression)
            )
        try:
            return self._code(expression)
        finally:
            self._depth -= 1

    def _code(self, expression: tree.Expression) -> Code:
        at = self.at(expression)
        match expression:
            case tree.NumberLiteral():
                return self._number(expression, at)
            case tree.StringLiteral(value=value) | tree.BoolLiteral(value=value):
                return Code(at.constant(value))
            case tree.DataReference() | tree.Index() | tree.ComponentAccess():
                return self.paths.read(expression)
            case tree.FunctionCall():
                return self.calls.function(expression)
            case tree.Parenthesised(inner=inner):
                return self.code(inner)
            case tree.Unary():
                return self._unary(expression, at)
            case tree.Binary():
                return self._binary(expression, at)
            case tree.LiteralAggregate() | tree.Aggregate():
                return self._aggregate(expression, at)
            case tree.LateFunctionCall():
                raise NotExecutableError("a late-bound function call", self.span(expression))
            case tree.Placeholder():
                return Code(at.call("_unfinished"), may_raise=True)

    def _number(self, expression: tree.NumberLiteral, at: AstBuilder) -> Code:
        value = float(expression.value)
        of = resolved(self.program.type_of[expression])
        return number(value if of.name.lower() == "dnum" else single(value), at)

    def _unary(self, expression: tree.Unary, at: AstBuilder) -> Code:
        operand = self.code(expression.operand)
        if expression.operator == "+":
            return operand
        if expression.operator == "NOT":
            negation = at.unary(ast.Not(), operand.node)
            return Code(negation, may_raise=operand.may_raise, calls=operand.calls)
        if operand.literal is not None:
            return number(-operand.literal, at)
        if resolved(self.type_of(expression.operand)).name.lower() == "pos":
            opposite = at.call("_negate_position", [operand.node])
            return Code(opposite, may_raise=operand.may_raise, calls=operand.calls)
        opposite_of = None if operand.integer is None else negated(operand.integer)
        if operand.stays_integer and opposite_of is None:
            operand = finished(operand, at)
        node = at.unary(ast.USub(), operand.node)
        return Code(
            node,
            operand.deferred,
            operand.may_raise,
            operand.calls,
            opposite_of,
            too_exact=operand.too_exact,
        )

    def _binary(self, expression: tree.Binary, at: AstBuilder) -> Code:
        operator = expression.operator
        left, right = self.code(expression.left), self.code(expression.right)
        may_raise = left.may_raise or right.may_raise
        calls = left.calls or right.calls
        if operator in _LOGICAL:
            node: ast.expr = at.both_or_either(_LOGICAL[operator](), left.node, right.node)
            return Code(node, may_raise=may_raise, calls=calls)
        if operator in _COMPARISONS:
            return self._comparison(expression, left, right, at)
        types = (self._name_of_type(expression.left), self._name_of_type(expression.right))
        if operator in _INTEGER:
            return _integer_division(operator, left, right, at)
        if "pos" in types or "orient" in types:
            return self._vector(operator, types, left, right, at)
        if types[0] == "string":
            node = at.operation(left.node, ast.Add(), right.node)
            return Code(node, DeferredCheck.STRING, may_raise=True, calls=calls)
        return self._arithmetic(operator, types[0] == "dnum", left, right, at)

    def _arithmetic(
        self, operator: str, is_dnum: bool, left: Code, right: Code, at: AstBuilder
    ) -> Code:
        may_raise = left.may_raise or right.may_raise
        calls = left.calls or right.calls
        owed = _deferred_check(operator, left, right, is_dnum=is_dnum)
        checked = owed in _CHECKED
        divides = operator == "/" and not right.literal
        folded = _folded(operator, left, right, at)
        if folded is not None:
            folded.may_raise = checked
            return folded
        integer = None if is_dnum or operator == "/" else _combined(operator, left, right)
        if integer is None:
            operands = _as_doubles(left, right, at)
            node = at.operation(operands[0], _ARITHMETIC[operator](), operands[1])
            code = Code(node, owed, may_raise or checked or divides, calls)
            return code if is_dnum else _bounded(code, operator, left, right)
        operands = left.as_integer(at), right.as_integer(at)
        node = at.operation(operands[0], _ARITHMETIC[operator](), operands[1])
        if integer.exact:
            return Code(
                node,
                DeferredCheck.NOTHING,
                may_raise or (checked and integer.signed),
                calls,
                integer,
            )
        too_exact = not integer.is_double
        return Code(node, owed, may_raise or checked, calls, integer, too_exact=too_exact)

    def _comparison(self, expression: tree.Binary, left: Code, right: Code, at: AstBuilder) -> Code:
        left_at, right_at = self.at(expression.left), self.at(expression.right)
        if left.stays_integer and right.literal is not None and right.integer is not None:
            right = Code(right.as_integer(right_at))
        elif right.stays_integer and left.literal is not None and left.integer is not None:
            left = Code(left.as_integer(left_at))
        left, right = comparable(left, left_at), comparable(right, right_at)
        node = at.compare(left.node, (_COMPARISONS[expression.operator](), right.node))
        return Code(
            node, may_raise=left.may_raise or right.may_raise, calls=left.calls or right.calls
        )

    def _vector(
        self, operator: str, types: tuple[str, str], left: Code, right: Code, at: AstBuilder
    ) -> Code:
        operands = [finished(left, at).node, finished(right, at).node]
        calls = left.calls or right.calls
        if types == ("num", "pos"):
            # The product is commutative, but the operands are evaluated in source order.
            return Code(at.call("_scaled_position", operands), may_raise=True, calls=calls)
        function = _POSITIONS[operator, types[0], types[1]]
        return Code(at.call(function, operands), may_raise=True, calls=calls)

    def _aggregate(
        self, expression: tree.LiteralAggregate | tree.Aggregate, at: AstBuilder
    ) -> Code:
        of = self.program.type_of[expression]
        value = literal(expression, of)
        if value is not None:
            return Code(at.name(self.names.module.constant(value)))
        assert isinstance(expression, tree.Aggregate)
        return self._computed_aggregate(expression, resolved(of), at)

    def _computed_aggregate(
        self, expression: tree.Aggregate, of: Atomic | Record | ArrayOf, at: AstBuilder
    ) -> Code:
        if isinstance(of, ArrayOf):
            types: list[Type] = [element_type(of)] * len(expression.elements)
        else:
            assert isinstance(of, Record)
            types = [component.type for component in of.components]
        parts = []
        for element, type_ in zip(expression.elements, types, strict=True):
            inner = bare(element)
            whole = resolved(type_)
            if isinstance(inner, tree.Aggregate) and literal(inner, type_) is None:
                parts.append(self._computed_aggregate(inner, whole, self.at(inner)))
            elif isinstance(inner, tree.Aggregate | tree.LiteralAggregate):
                constant = self.names.module.constant(literal(inner, type_))
                parts.append(Code(self.at(inner).name(constant)))
            else:
                parts.append(self.value(element))
        nodes = [part.node for part in parts]
        if isinstance(of, Record):
            python = at.name(self.names.module.record_class(of.python))
            node: ast.expr = at.call("_new", [python, at.tuple_of(nodes)])
        else:
            node = at.list_of(nodes)
        may_raise = any(part.may_raise for part in parts)
        return Code(node, may_raise=may_raise, calls=any(part.calls for part in parts))

    def _name_of_type(self, expression: tree.Expression) -> str:
        of = resolved(self.type_of(expression))
        if isinstance(of, Atomic) and of.reads_as:
            return of.reads_as
        return of.name.lower()


def _deferred_check(operator: str, left: Code, right: Code, *, is_dnum: bool) -> DeferredCheck:
    """The check that the result of an operation still needs."""
    checked = operator in "*/" and not _cannot_grow(operator, left, right)
    checked = checked or left.deferred in _CHECKED or right.deferred in _CHECKED
    if is_dnum:
        return DeferredCheck.CHECKED_DOUBLE if checked else DeferredCheck.NOTHING
    return DeferredCheck.CHECKED_SINGLE if checked else DeferredCheck.SINGLE


def _folded(operator: str, left: Code, right: Code, at: AstBuilder) -> Code | None:
    """Fold the sum, difference or product of literals, if it is an integer."""
    a, b = left.literal, right.literal
    if a is None or b is None or operator == "/":
        return None
    value = a + b if operator == "+" else a - b if operator == "-" else a * b
    return number(value, at) if value.is_integer() and abs(value) <= MAX_INTEGER else None


def _as_doubles(left: Code, right: Code, at: AstBuilder) -> tuple[ast.expr, ast.expr]:
    """Operands for arithmetic in doubles, in which a zero result may have a sign."""
    first, second = (
        code.as_integer(at) if code.stays_integer else code.node for code in (left, right)
    )
    if left.stays_integer and right.stays_integer:
        first = at.operation(first, ast.Add(), at.constant(0.0))
    return first, second


def _integer_division(operator: str, left: Code, right: Code, at: AstBuilder) -> Code:
    """DIV and MOD, as Python's operators where these agree, which is from 0 up."""
    calls = left.calls or right.calls
    python = ast.FloorDiv() if operator == "DIV" else ast.Mod()
    integer = _combined(operator, left, right)
    if integer is not None:
        return _division_of_integers(operator, left, right, integer, at)
    b = right.integer
    operands = [finished(left, at).node, finished(right, at).node]
    if b is None or b.low <= 0 or right.literal is None:
        return Code(at.call(_INTEGER[operator], operands), may_raise=True, calls=calls)
    # n >= 0 and (n + WHOLE_FROM) - WHOLE_FROM == n, which holds for integers only.
    n, far = at.name("_n"), at.constant(WHOLE_FROM)
    whole = at.operation(at.operation(n, ast.Add(), far), ast.Sub(), far)
    easy = at.compare(at.constant(0.0), (ast.LtE(), at.named("_n", operands[0])), (ast.Eq(), whole))
    refused_or_negative = at.call(_INTEGER[operator], [n, operands[1]])
    node = at.choice(easy, at.operation(n, python, operands[1]), refused_or_negative)
    rest = Interval(1 - b.high, b.high - 1) if operator == "MOD" else None
    most = math.inf if rest is None else rest.high
    return Code(node, may_raise=True, calls=calls, most=most, integral=rest)


def _division_of_integers(
    operator: str, left: Code, right: Code, integer: Interval, at: AstBuilder
) -> Code:
    """DIV and MOD of Python integers; the quotient may be negative, the remainder may not."""
    calls, by_literal = left.calls or right.calls, right.literal is not None
    halves = right.literal is not None and math.frexp(right.literal)[0] == 0.5
    left, right = finished_integer(left, at), finished_integer(right, at)
    a, b = left.integer, right.integer
    assert a is not None
    assert b is not None
    # A quotient of larger numbers is rounded as doubles are, unless a power of 2 divides them.
    exact = operator == "MOD" or a.is_double
    may_raise = left.may_raise or right.may_raise or integer.signed or not exact
    exact = exact or halves
    if b.low > 0 and a.low >= 0 and exact:
        python = ast.FloorDiv() if operator == "DIV" else ast.Mod()
        node: ast.expr = at.operation(left.node, python, right.node)
    else:
        may_raise = True
        most = None if exact else MAX_EXACT
        node = _checked_division(operator, left, right, most, at, by_literal=by_literal)
    return Code(node, may_raise=may_raise, calls=calls, integer=integer)


def _checked_division(
    operator: str, left: Code, right: Code, most: float | None, at: AstBuilder, *, by_literal: bool
) -> ast.expr:
    """The division, after a test of its operands; Python divides dividends up to `most`."""
    assert left.integer is not None
    assert right.integer is not None
    name = left.node if isinstance(left.node, ast.Name) else None
    n, first = (name, name) if name else (at.name("_n"), at.named("_n", left.node))
    if operator == "DIV" and by_literal and right.integer.low > 0:
        easy = within(first, None if left.integer.low >= 0 else 0, most, at)
        node = at.operation(n, ast.FloorDiv(), right.node)
        return at.choice(easy, node, at.call("_literal_quotient", [n, right.node]))
    if operator == "MOD" and isinstance(right.node, ast.Name) and name:
        easy = at.compare(right.node, (ast.Gt(), at.constant(0)))
        node = at.operation(left.node, ast.Mod(), right.node)
        return at.choice(easy, node, at.call("_whole_remainder", [n, right.node]))
    return at.call(_WHOLE[operator], [left.node, right.node])


def _combined(operator: str, left: Code, right: Code) -> Interval | None:
    """Interval of the result if it is a Python integer; None if it may be another number."""
    a, b = left.integer, right.integer
    if a is None or b is None or not (left.stays_integer or right.stays_integer):
        return None
    return combined(operator, a, b)


def _bounded(code: Code, operator: str, left: Code, right: Code) -> Code:
    """Result in doubles, with the bounds that follow from its operands."""
    a, b = left.integral or left.integer, right.integral or right.integer
    if operator == "/":
        code.most = math.inf if b is None or b.low <= 0 <= b.high else left.most
        return code
    code.most = left.most * right.most if operator == "*" else left.most + right.most
    if a is not None and b is not None and a.exact and b.exact:
        code.integral = combined(operator, a, b)
    return code


def _cannot_grow(operator: str, left: Code, right: Code) -> bool:
    """Whether a product or quotient is no larger than its other operand, which is in range."""
    if operator == "*":
        factors = [code.literal for code in (left, right) if code.literal is not None]
        exact = left.deferred is DeferredCheck.NOTHING and right.deferred is DeferredCheck.NOTHING
        return exact and any(abs(factor) <= 1.0 for factor in factors)
    return right.literal is not None and 1.0 <= abs(right.literal) <= LARGEST_SINGLE
