"""Rule T326: concatenated strings that become too long."""

from __future__ import annotations

from collections.abc import Iterator

from rapidsim.analysis.program_parts import Facts
from rapidsim.analysis.rules.facts.known_values import known_value
from rapidsim.diagnostics import Diagnostic, Violation
from rapidsim.library.arithmetic import MAX_STRING
from rapidsim.syntax import tree


class TextTooLong(Violation, code="T326"):
    length: int
    most: int


def find_long_texts(facts: Facts) -> Iterator[Diagnostic]:
    """Report concatenations whose constant parts alone exceed the maximum length."""
    for part in facts.parts:
        sums = [node for node in part.all(tree.Binary) if node.operator == "+"]
        inner = {_bare(side) for node in sums for side in (node.left, node.right)}
        for node in sums:
            if node in inner:
                continue
            known = [known_value(piece, facts, persistents=False) for piece in _pieces(node)]
            length = sum(len(text) for text in known if isinstance(text, str))
            if length > MAX_STRING:
                yield part.finding(TextTooLong(length, MAX_STRING), node)


def _pieces(expression: tree.Expression) -> Iterator[tree.Expression]:
    """Operands of a concatenation, in order."""
    waiting = [expression]
    while waiting:
        piece = _bare(waiting.pop())
        if isinstance(piece, tree.Binary) and piece.operator == "+":
            waiting += [piece.right, piece.left]
        else:
            yield piece


def _bare(expression: tree.Expression) -> tree.Expression:
    while isinstance(expression, tree.Parenthesised):
        expression = expression.inner
    return expression
