"""The LALR table of the grammar: the automaton, and what the lexer must know of the terminals.

`Exported` is the form that is stored as JSON, in which symbols are numbers; `Table` is the form
that is run.
"""

from __future__ import annotations

import zlib
from typing import TypedDict

from rapidsim.values import value_class

GRAMMAR_FILE = "rapid.lark"
TABLE_FILE = "rapid.table.json"
END = "$END"
"""The terminal after the last token."""
ACCEPT = 0
"""The action that ends a parse."""


class Exported(TypedDict):
    """A table as JSON."""

    grammar: int
    """Fingerprint of the grammar it was made from."""
    terminals: int
    """How many of the symbols are terminals; they come first."""
    symbols: list[str]
    words: dict[str, str]
    marks: dict[str, str]
    patterns: dict[str, str]
    rules: list[tuple[str, int, str | None, list[int | None]]]
    """The fields of `GrammarRule`."""
    states: list[list[int]]
    """For each state, symbol and target in turn; terminals first."""


@value_class(frozen=True, slots=True)
class GrammarRule:
    """A production: pop `length` values, push what `build` makes of the `children` among them."""

    origin: str
    """The nonterminal it reduces to."""
    length: int
    build: str | None
    """The builder's function; None passes the only child on, "" gathers the children in a list."""
    children: tuple[int | None, ...]
    """Which of the popped values are children; None where an optional one is absent."""


@value_class(frozen=True, eq=False, slots=True)
class Table:
    """The automaton, and what the lexer must know of the terminals."""

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
    """A checksum that tells whether a table belongs to a grammar."""
    return zlib.crc32(grammar.encode())


def unpacked(exported: Exported) -> Table:
    """The table that runs, from its stored form."""
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
