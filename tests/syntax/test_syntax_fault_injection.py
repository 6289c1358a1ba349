"""Break correct programs in the ways people do, and ask whether the reports name the breaks.

Each fault is made of the tokens of a correct program, at a place drawn from a fixed sequence, so
the numbers below are the same on every machine.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import pytest

from rapidsim.diagnostics import Source
from rapidsim.syntax.lexer import Tokens, lex
from rapidsim.syntax.parser import parse

PROGRAMS = sorted((Path(__file__).parent / "programs").iterdir())
INNER_CLOSERS = {"ENDIF", "ENDFOR", "ENDWHILE", "ENDTEST"}
ROUTINE_CLOSERS = {"ENDPROC", "ENDFUNC", "ENDTRAP"}
BRACKETS = {"LPAR", "RPAR", "LBRACE", "RBRACE"}
MISSPELLABLE = (
    {"THEN", "DO", "FROM", "WHILE", "ELSEIF", "PROC", "FOR", "TEST", "CASE", "RETURN", "VAR"}
    | INNER_CLOSERS
    | ROUTINE_CLOSERS
)


@dataclass(frozen=True)
class Fault:
    """Write `text` in the place of a stretch of the program."""

    start: int
    end: int
    text: str


def tokens_of(kinds: set[str]) -> Callable[[Tokens], list[int]]:
    return lambda tokens: [i for i, kind in enumerate(tokens.kinds) if kind in kinds]


def deleted(tokens: Tokens, index: int, draw: random.Random, text: str) -> Fault:
    return Fault(tokens.starts[index], tokens.ends[index], "")


def misspelt(tokens: Tokens, index: int, draw: random.Random, text: str) -> Fault:
    """Swap two different neighbouring letters."""
    word = text[tokens.starts[index] : tokens.ends[index]]
    places = [i for i in range(len(word) - 1) if word[i] != word[i + 1]]
    i = draw.choice(places)
    swapped = word[:i] + word[i + 1] + word[i] + word[i + 2 :]
    return Fault(tokens.starts[index], tokens.ends[index], swapped)


def unquoted(tokens: Tokens, index: int, draw: random.Random, text: str) -> Fault:
    return Fault(tokens.ends[index] - 1, tokens.ends[index], "")


FAULTS = {
    "semicolon": (tokens_of({"SEMICOLON"}), deleted),
    "block end": (tokens_of(INNER_CLOSERS), deleted),
    "routine end": (tokens_of(ROUTINE_CLOSERS), deleted),
    "bracket": (tokens_of(BRACKETS), deleted),
    "misspelt word": (tokens_of(MISSPELLABLE), misspelt),
    "closing quote": (tokens_of({"STRING"}), unquoted),
}


def broken(text: str, names: Sequence[str], draw: random.Random) -> tuple[str, list[int]]:
    """A text with faults in it, and their lines in the broken text."""
    tokens = lex(text)
    faults: list[Fault] = []
    for name in names:
        candidates, make = FAULTS[name]
        fault = make(tokens, draw.choice(candidates(tokens)), draw, text)
        if all(abs(fault.start - other.start) > 1 for other in faults):
            faults.append(fault)
    for fault in sorted(faults, key=lambda fault: -fault.start):
        text = text[: fault.start] + fault.text + text[fault.end :]
    shift = 0
    lines = []
    for fault in sorted(faults, key=lambda fault: fault.start):
        lines.append(text.count("\n", 0, fault.start + shift) + 1)
        shift += len(fault.text) - (fault.end - fault.start)
    return text, lines


@dataclass
class Score:
    faults: int = 0
    found: int = 0
    reports: int = 0
    right: int = 0
    exact: int = 0
    texts: int = 0


def score(kinds: Sequence[str], count: int, rounds: int, *, show: bool = False) -> Score:
    draw = random.Random(f"{kinds} {count}")
    total = Score()
    for _ in range(rounds):
        program = draw.choice(PROGRAMS).read_text()
        names = [draw.choice(kinds) for _ in range(count)]
        if not all(FAULTS[name][0](lex(program)) for name in names):
            continue
        text, lines = broken(program, names, draw)
        reports = [d.span.line for d in parse(Source("broken", text)).diagnostics if d.span]
        if count == 1 and not reports:
            continue  # the fault has left a legal text
        found = sum(any(abs(line - report) <= 1 for report in reports) for line in lines)
        right = sum(any(abs(line - report) <= 1 for line in lines) for report in reports)
        if show and (found < len(lines) or right < len(reports)):
            print("=====", names, lines)
            for line in lines:
                print(
                    "\n".join(
                        f"{k + 1:4} {t}"
                        for k, t in enumerate(text.split("\n"))
                        if abs(k + 1 - line) < 4
                    )
                )
                print("   ..")
            for d in parse(Source("broken", text)).diagnostics:
                print("   ", d.span.line, d.violation.code, d.violation.message)
        total.faults += len(lines)
        total.found += found
        total.reports += len(reports)
        total.right += right
        total.exact += len(reports) == len(lines)
        total.texts += 1
    return total


if __name__ == "__main__":
    import sys

    for kinds, count in [([k], c) for k in FAULTS for c in (1, 5)] + [
        (list(FAULTS), c) for c in (1, 3, 5)
    ]:
        s = score(
            kinds,
            count,
            int(sys.argv[1]),
            show=len(sys.argv) > 2 and sys.argv[2] in (kinds[0],) and count == int(sys.argv[3]),
        )
        print(
            f"{str(kinds)[:20]:20} {count} texts {s.texts} found {100 * s.found / s.faults:.0f} right {100 * s.right / s.reports:.0f} exact {100 * s.exact / s.texts:.0f}"
        )
