"""Conversion of tokens to leaves of the tree: numbers, strings, names, placeholders."""

from __future__ import annotations

from collections.abc import Callable
from types import MappingProxyType
from typing import TypeAlias

from rapidsim.syntax import literals, tree

BuildTerminal: TypeAlias = Callable[[int, int, str], tree.Node]
"""Signature `build(start, end, text)`."""


def _number(start: int, end: int, text: str) -> tree.NumberLiteral:
    return tree.NumberLiteral(start, end, text, literals.number(text))


def _string(start: int, end: int, text: str) -> tree.StringLiteral:
    return tree.StringLiteral(start, end, literals.string(text))


def _bool(start: int, end: int, text: str) -> tree.BoolLiteral:
    return tree.BoolLiteral(start, end, text.upper() == "TRUE")


def _literals(start: int, end: int, text: str) -> tree.LiteralAggregate:
    return tree.LiteralAggregate(start, end, literals.aggregate(text))


def _placeholder(start: int, end: int, text: str) -> tree.Placeholder:
    return tree.Placeholder(start, end, text.strip("<>").upper())


def _missing_operand(start: int, end: int, text: str) -> tree.Placeholder:
    """`<EXP>`, written or inserted by a repair for text that is no expression."""
    return tree.Placeholder(start, end, "EXP")


def _broken(start: int, end: int, text: str) -> tree.InvalidStatement:
    return tree.InvalidStatement(start, end)


def _fixed_word(meant: str) -> BuildTerminal:
    """A word or mark of the language. A repair substitutes it for other text: `VRA` for VAR."""

    def build(start: int, end: int, text: str) -> tree.Name:
        return tree.Name(start, end, text if text.upper() == meant else meant)

    return build


_WORDS = (
    "DIV MOD AND OR XOR NOT LOCAL TASK VAR PERS CONST INOUT SYSMODULE NOVIEW NOSTEPIN VIEWONLY"
    " READONLY"
)
_MARKS = {
    "BECOMES": ":=",
    "EQUAL": "=",
    "UNEQUAL": "<>",
    "LESS": "<",
    "LESS_EQUAL": "<=",
    "GREATER": ">",
    "GREATER_EQUAL": ">=",
    "PLUS": "+",
    "MINUS": "-",
    "STAR": "*",
    "SLASH": "/",
}
_PLACEHOLDERS = "TDN DDN RDN PAR ALT DIM SMT VAR_PLACEHOLDER EIT CSE ARG"

TERMINALS: MappingProxyType[str, BuildTerminal] = MappingProxyType(
    {
        "NAME": tree.Name,
        **{word: _fixed_word(word) for word in _WORDS.split()},
        **{kind: _fixed_word(mark) for kind, mark in _MARKS.items()},
        **dict.fromkeys(_PLACEHOLDERS.split(), _placeholder),
        "EXP": _missing_operand,
        "NUMBER": _number,
        "STRING": _string,
        "TRUE": _bool,
        "FALSE": _bool,
        "LITERALS": _literals,
        "BROKEN": _broken,
    }
)
"""Builder of each kept terminal; the others have no value."""
