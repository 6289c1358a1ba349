"""Rules E1 about statements and blocks: violations of RAPID's syntax.

E104 to E107 are not rules of the syntax. The rules about characters, names and whole files are in
`rapidsim.syntax.text_violations`.
"""

from __future__ import annotations

from rapidsim.diagnostics import Violation


class BrokenSyntax(Violation, code="E101"):
    construct: str
    problem: str


class UnclosedBlock(Violation, code="E102"):
    block: str
    closer: str
    line: int


class MissingSemicolon(Violation, code="E103"):
    construct: str


class MisspeltWord(Violation, code="E112"):
    written: str
    word: str


class MissingSymbol(Violation, code="E113"):
    symbol: str
    construct: str


class UnexpectedSymbol(Violation, code="E114"):
    symbol: str
    construct: str


class StrayBlockWord(Violation, code="E115"):
    word: str
    opener: str


class BrokenHead(Violation, code="E117"):
    construct: str
    problem: str


class RepeatedClause(Violation, code="E119"):
    clause: str


class SquareIndex(Violation, code="E120"):
    array: str


class StrayStatement(Violation, code="E123"):
    construct: str
