"""Rules T307 to T309: pitfalls of single-precision numbers."""

from __future__ import annotations

from collections.abc import Iterator

from rapidsim.analysis.program_parts import Facts
from rapidsim.analysis.rules.facts.known_values import known_value
from rapidsim.diagnostics import Diagnostic, Violation
from rapidsim.language import types
from rapidsim.language.single_precision import single
from rapidsim.language.types import resolved
from rapidsim.syntax import tree

_LARGEST = 1e30
"""Larger literals are reported as out of range."""


class FloatEquality(Violation, code="T307"):
    literal: str
    operand: str


class NumIntegerPrecision(Violation, code="T308"):
    literal: str
    stored: str


class DivisionByConstantZero(Violation, code="T309"):
    operator: str


def find_float_equality(facts: Facts) -> Iterator[Diagnostic]:
    """`=` and `<>` with a literal that num rounds."""
    for part in facts.parts:
        for node in part.all(tree.Binary):
            if node.operator not in ("=", "<>"):
                continue
            for literal, other in ((node.left, node.right), (node.right, node.left)):
                number = _literal(literal)
                if number is None or number.is_integer() or isinstance(other, tree.NumberLiteral):
                    continue
                if abs(number) > _LARGEST or single(number) == number:
                    continue
                source = part.module.source.text
                shown = (source[one.start : one.end] for one in (literal, other))
                violation = FloatEquality(*(" ".join(text.split()) for text in shown))
                yield part.finding(violation, node)


def find_long_integers(facts: Facts) -> Iterator[Diagnostic]:
    """Whole numbers, written as digits, that num rounds."""
    for part in facts.parts:
        for node in part.all(tree.NumberLiteral):
            if not 2**24 < node.value < _LARGEST or not node.text.isdecimal():
                continue
            of = facts.analysis.type_of.get(node)
            if of is None or resolved(of) != types.NUM or single(node.value) == node.value:
                continue
            held = f"{single(node.value):.0f}"
            yield part.finding(NumIntegerPrecision(node.text, held), node)


def find_zero_divisors(facts: Facts) -> Iterator[Diagnostic]:
    """Divisions by a literal or a constant that is 0."""
    for part in facts.parts:
        for node in part.all(tree.Binary):
            if node.operator in ("/", "DIV", "MOD"):
                divisor = known_value(node.right, facts, persistents=False)
                if divisor == 0.0 and isinstance(divisor, float):
                    yield part.finding(DivisionByConstantZero(node.operator), node.right)


def _literal(expression: tree.Expression) -> float | None:
    match expression:
        case tree.NumberLiteral(value=value):
            return value
        case tree.Unary(operator="-", operand=tree.NumberLiteral(value=value)):
            return -value
        case _:
            return None
