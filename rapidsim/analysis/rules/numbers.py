"""Rules T307 to T309: what floating-point numbers of single precision do to a program."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from rapidsim.analysis.rules.facts import Facts
from rapidsim.analysis.rules.known_values import known_value
from rapidsim.diagnostics import Diagnostic, Severity, Violation
from rapidsim.language import types
from rapidsim.language.single import single
from rapidsim.language.types import resolved
from rapidsim.syntax import tree

_LARGEST = 1e30
"""Larger literals are reported as out of range."""


@dataclass(frozen=True)
class FloatEquality(Violation):
    """A number is compared for equality with a decimal fraction.

    A num has 24 binary digits, and 0.1 is not among the numbers it can hold. A value that was
    computed will hardly ever be equal to it.

    ## Example

        MODULE example
          PROC main()
            VAR num x;
            WHILE NOT x=0.3 DO
              x:=x+0.1;
            ENDWHILE
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            VAR num x;
            WHILE x<0.25 DO
              x:=x+0.1;
            ENDWHILE
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "T307"
    name: ClassVar[str] = "float-equality"
    template: ClassVar[str] = "comparing with {literal} for equality: num cannot hold it exactly"
    severity: ClassVar[Severity] = Severity.WARNING

    literal: str
    operand: str

    @property
    def help(self) -> str:
        """The usual cure."""
        return f"compare a difference: `Abs({self.operand}-{self.literal})<0.001`"


@dataclass(frozen=True)
class NumIntegerPrecision(Violation):
    """A whole number is too long for num, which holds all of them up to 16777216 only.

    The nearest number that it can hold is taken instead. A dnum holds whole numbers up to
    4503599627370496.

    ## Example

        MODULE example
          VAR num serial_number;
          PROC main()
            serial_number:=16777217;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          VAR dnum serial_number;
          PROC main()
            serial_number:=16777217;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "T308"
    name: ClassVar[str] = "num-integer-precision"
    template: ClassVar[str] = "num cannot hold {literal}; it becomes {held}"
    severity: ClassVar[Severity] = Severity.WARNING

    literal: str
    held: str

    @property
    def help(self) -> str:
        """The cure."""
        return "use a dnum"


@dataclass(frozen=True)
class DivisionByConstantZero(Violation):
    """Something is divided by what is always 0. The statement raises ERR_DIVZERO.

    ## Example

        MODULE example
          CONST num parts:=0;
          PROC main()
            WaitTime 10/parts;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          CONST num parts:=4;
          PROC main()
            WaitTime 10/parts;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "T309"
    name: ClassVar[str] = "division-by-constant-zero"
    template: ClassVar[str] = "`{operator}` divides by 0"
    severity: ClassVar[Severity] = Severity.WARNING
    cf: ClassVar[str] = "ABB 40194"

    operator: str


def find_float_equality(facts: Facts) -> Iterator[Diagnostic]:
    """`=` and `<>` with a literal that num rounds."""
    for part in facts.parts:
        for node in part.all(tree.Binary):
            if node.operator not in ("=", "<>"):
                continue
            for literal, other in ((node.left, node.right), (node.right, node.left)):
                number = _literal(literal)
                if number is None or number.is_integer() or isinstance(other, tree.Number):
                    continue
                if abs(number) > _LARGEST or single(number) == number:
                    continue
                source = part.module.source.text
                shown = (source[one.start : one.end] for one in (literal, other))
                violation = FloatEquality(*(" ".join(text.split()) for text in shown))
                yield part.finding(violation, node)


def find_long_integers(facts: Facts) -> Iterator[Diagnostic]:
    """Whole numbers, written in digits, that num rounds."""
    for part in facts.parts:
        for node in part.all(tree.Number):
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
        case tree.Number(value=value):
            return value
        case tree.Unary(operator="-", operand=tree.Number(value=value)):
            return -value
        case _:
            return None
