"""Rules S902 to S906: whitespace, empty lines and line lengths; all are off by default."""

from __future__ import annotations

import re
from collections.abc import Iterator

from rapidsim.analysis.program_parts import Facts
from rapidsim.analysis.tree_walk import blocks, clauses
from rapidsim.diagnostics import Diagnostic, Edit, Fix, Source, Span, Violation
from rapidsim.syntax import tree

_TRAILING = re.compile(r"[ \t]+(?=\r*\n|\r|\Z)")
_BLANK_LINES = re.compile(r"(?:^[ \t]*(?:\r*\n|\r)){3,}", re.MULTILINE)
_LONGEST_LINE = 120
_MOST_BLANK_LINES = 2


class Indentation(Violation, code="S902"):
    actual: int
    wanted: int


class TrailingSpace(Violation, code="S903"):
    pass


class BlankLines(Violation, code="S904"):
    count: int


class FinalNewline(Violation, code="S905"):
    pass


class LineTooLong(Violation, code="S906"):
    count: int


def find_indentation(facts: Facts) -> Iterator[Diagnostic]:
    """Report statements whose indentation differs from the first statement of their list."""
    for part in facts.routine_parts:
        assert part.routine is not None
        waiting = list(clauses(part.routine))
        while waiting:
            body = waiting.pop()
            wanted: int | None = None
            for statement in body:
                waiting += blocks(statement)
                depth = _depth(part.module.source, statement)
                if depth is None or isinstance(statement, tree.Label | tree.InvalidStatement):
                    continue
                if wanted is None:
                    wanted = depth
                elif depth != wanted:
                    yield part.finding(Indentation(depth, wanted), statement)


def find_trailing_space(facts: Facts) -> Iterator[Diagnostic]:
    """Report trailing whitespace, with the edit that removes it."""
    for file in facts.files:
        for match in _TRAILING.finditer(file.source.text):
            span = Span(file.source, match.start(), match.end())
            yield Diagnostic(TrailingSpace(), span, fix=Fix("take them out", (Edit(span, ""),)))


def find_blank_lines(facts: Facts) -> Iterator[Diagnostic]:
    """Report more than two consecutive empty lines, with the edit that leaves two."""
    for file in facts.files:
        for match in _BLANK_LINES.finditer(file.source.text):
            lines = match.group().splitlines(keepends=True)
            count = sum(1 for line in lines if line.strip(" \t") != "\r" or line == "\r")
            kept = match.start() + len("".join(lines[:_MOST_BLANK_LINES]))
            span = Span(file.source, kept, match.end())
            fix = Fix("leave two", (Edit(span, ""),))
            yield Diagnostic(BlankLines(count), span, fix=fix)


def find_final_newline(facts: Facts) -> Iterator[Diagnostic]:
    """Report files whose last line has no line ending; the edit adds the previous line's ending."""
    for file in facts.files:
        text = file.source.text
        if not text or text.endswith(("\n", "\r")):
            continue
        end = len(text)
        first_end = re.search(r"\r*\n|\r", text)
        line_end = "\n" if first_end is None else first_end.group()
        fix = Fix("end the line", (Edit(Span(file.source, end, end), line_end),))
        yield Diagnostic(FinalNewline(), Span(file.source, end - 1, end), fix=fix)


def find_long_lines(facts: Facts) -> Iterator[Diagnostic]:
    """Report lines of statements and comments that are too long."""
    for file in facts.files:
        source = file.source
        data = {
            source.position(item.start)[0]
            for module in file.modules
            for item in module.items
            if isinstance(item, tree.Data)
        }
        for number in range(1, len(source.line_starts) + 1):
            text = source.line(number)
            if len(text) > _LONGEST_LINE and number not in data:
                start = source.line_starts[number - 1]
                span = Span(source, start + _LONGEST_LINE, start + len(text))
                yield Diagnostic(LineTooLong(len(text)), span)


def _depth(source: Source, statement: tree.Node) -> int | None:
    """Number of blanks before a statement at the start of a line; None after another statement."""
    line_start = source.line_starts[source.position(statement.start)[0] - 1]
    before = source.text[line_start : statement.start]
    return None if before.strip(" \t") else len(before.expandtabs(4))
