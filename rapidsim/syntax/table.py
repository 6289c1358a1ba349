"""LALR table of the grammar: the automaton, and the terminals for the lexer.

`Exported` is the form that is stored as JSON, in which symbols are numbers; `Table` is the form
for execution.
"""

from __future__ import annotations

import zlib
from typing import TypedDict

from rapidsim.values import value_class

GRAMMAR_FILE = "rapid.lark"
TABLE_FILE = "rapid.table.json"
END = "$END"
"""Terminal after the last token."""
ACCEPT = 0
"""Action that ends a parse."""


class Exported(TypedDict):
    """A table as JSON."""

    grammar: int
    """Fingerprint of the grammar of the table."""
    terminals: int
    """Number of terminals, which precede the other symbols."""
    symbols: list[str]
    words: dict[str, str]
    marks: dict[str, str]
    patterns: dict[str, str]
    rules: list[tuple[str, int, str | None, list[int | None]]]
    """The fields of `GrammarRule`."""
    states: list[list[int]]
    """For each state, alternately symbol and target; terminals first."""


@value_class(frozen=True, slots=True)
class GrammarRule:
    """A production: pop `length` values, push the result of `build` for the `children` of them."""

    origin: str
    """Nonterminal that it reduces to."""
    length: int
    build: str | None
    """The builder's function; None passes the only child on, "" gathers the children in a list."""
    children: tuple[int | None, ...]
    """Indices of the popped values that are children; None for an absent optional one."""


@value_class(frozen=True, eq=False, slots=True)
class Table:
    """The automaton, and the terminals for the lexer."""

    rules: tuple[GrammarRule, ...]
    actions: tuple[dict[str, int], ...]
    """For each state, by terminal: shift to s is s + 1, reduce by rule r is -(r + 1), `ACCEPT`."""
    gotos: tuple[dict[str, int], ...]
    """For each state, by nonterminal: the state after a reduction."""
    words: dict[str, str]
    """Reserved words in upper case, and their terminals."""
    marks: dict[str, str]
    """Operators, punctuation and placeholders, and their terminals."""
    patterns: dict[str, str]
    """The other terminals as regular expressions."""


def fingerprint(grammar: str) -> int:
    """Return a checksum that identifies the grammar of a table."""
    return zlib.crc32(grammar.encode())


def unpacked(exported: Exported) -> Table:
    """Convert the stored form of a table to the executable form."""
    symbols = exported["symbols"]
    terminal_count = exported["terminals"]
    actions: list[dict[str, int]] = []
    gotos: list[dict[str, int]] = []
    for row in exported["states"]:
        action: dict[str, int] = {}
        goto: dict[str, int] = {}
        for symbol, target in zip(row[::2], row[1::2], strict=True):
            (action if symbol < terminal_count else goto)[symbols[symbol]] = target
        actions.append(action)
        gotos.append(goto)
    return Table(
        rules=tuple(
            GrammarRule(origin, length, build, tuple(children))
            for origin, length, build, children in exported["rules"]
        ),
        actions=tuple(actions),
        gotos=tuple(gotos),
        words=exported["words"],
        marks=exported["marks"],
        patterns=exported["patterns"],
    )
