"""Break correct programs in the ways people do, and ask whether the reports name the breaks.

Each fault is made of the tokens of a correct program, at a place drawn from a fixed sequence, so
the shares below are the same on every machine.
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
INNER_CLOSERS = frozenset({"ENDIF", "ENDFOR", "ENDWHILE", "ENDTEST"})
ROUTINE_CLOSERS = frozenset({"ENDPROC", "ENDFUNC", "ENDTRAP"})
BRACKETS = frozenset({"LPAR", "RPAR", "LBRACE", "RBRACE"})
OPENERS = frozenset({"THEN", "DO", "FROM", "WHILE", "ELSEIF", "PROC", "FOR", "TEST", "CASE", "VAR"})
MISSPELLABLE = OPENERS | INNER_CLOSERS | ROUTINE_CLOSERS


@dataclass(frozen=True)
class Fault:
    """Write `text` in the place of a stretch of the program."""

    start: int
    end: int
    text: str


Make = Callable[[Tokens, int, random.Random, str], Fault]


def deleted(tokens: Tokens, index: int, draw: random.Random, text: str) -> Fault:
    return Fault(tokens.starts[index], tokens.ends[index], "")


def misspelt(tokens: Tokens, index: int, draw: random.Random, text: str) -> Fault:
    """Swap two different neighbouring letters."""
    word = text[tokens.starts[index] : tokens.ends[index]]
    i = draw.choice([i for i in range(len(word) - 1) if word[i] != word[i + 1]])
    swapped = word[:i] + word[i + 1] + word[i] + word[i + 2 :]
    return Fault(tokens.starts[index], tokens.ends[index], swapped)


def unquoted(tokens: Tokens, index: int, draw: random.Random, text: str) -> Fault:
    return Fault(tokens.ends[index] - 1, tokens.ends[index], "")


FAULTS: dict[str, tuple[frozenset[str], Make]] = {
    "semicolon": (frozenset({"SEMICOLON"}), deleted),
    "block end": (INNER_CLOSERS, deleted),
    "routine end": (ROUTINE_CLOSERS, deleted),
    "bracket": (BRACKETS, deleted),
    "misspelt word": (MISSPELLABLE, misspelt),
    "closing quote": (frozenset({"STRING"}), unquoted),
}


@dataclass
class Score:
    """How many faults have a report within a line, and how many reports a fault."""

    faults: int = 0
    found: int = 0
    reports: int = 0
    right: int = 0


def broken(text: str, names: Sequence[str], draw: random.Random) -> tuple[str, list[int]]:
    """A text with faults in it, and their lines in the broken text."""
    tokens = lex(text)
    faults: list[Fault] = []
    for name in names:
        kinds, make = FAULTS[name]
        places = [index for index, kind in enumerate(tokens.kinds) if kind in kinds]
        fault = make(tokens, draw.choice(places), draw, text)
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


def score(kinds: Sequence[str], count: int, rounds: int) -> Score:
    draw = random.Random(f"{kinds} {count}")
    total = Score()
    for _ in range(rounds):
        program = draw.choice(PROGRAMS).read_text()
        text, lines = broken(program, [draw.choice(kinds) for _ in range(count)], draw)
        reports = [d.span.line for d in parse(Source("broken", text)).diagnostics if d.span]
        if count == 1 and not reports:
            continue  # the fault has left a legal text
        total.faults += len(lines)
        total.found += sum(any(abs(line - r) <= 1 for r in reports) for line in lines)
        total.reports += len(reports)
        total.right += sum(any(abs(line - r) <= 1 for line in lines) for r in reports)
    return total


@pytest.mark.parametrize("kind", FAULTS)
def test_a_single_fault_is_reported_where_it_is(kind: str) -> None:
    total = score([kind], 1, 40)
    assert total.faults > 20
    assert total.found >= 0.95 * total.faults
    assert total.right >= 0.95 * total.reports


def test_five_faults_of_any_kind_are_nearly_all_reported() -> None:
    total = score(list(FAULTS), 5, 60)
    assert total.found >= 0.9 * total.faults
    assert total.right >= 0.88 * total.reports
