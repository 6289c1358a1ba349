"""Rules E106 and E107: bytes in a file that controllers or other tools cannot handle."""

from __future__ import annotations

import re
from collections.abc import Iterator

from rapidsim.analysis.program_parts import Facts
from rapidsim.diagnostics import Diagnostic, Edit, Fix, Span, Violation

_DOUBLED = re.compile(r"\r{2,}\n")
_OUTSIDE = re.compile(r"[^\x00-\xff\ufffd]")
# Code page 1252 has these in place of ISO 8859-1's control characters; controllers show them.
_WINDOWS = frozenset("€‚ƒ„…†‡ˆ‰Š‹ŒŽ‘’“”•–—˜™š›œžŸ")


class BadLineEndings(Violation, code="E106"):
    lines: str


class BadEncoding(Violation, code="E107"):
    character: str
    number: int
    other_text: str


def find_bad_line_endings(facts: Facts) -> Iterator[Diagnostic]:
    """Report line endings once per file, with the edits that leave CR LF."""
    for file in facts.files:
        source = file.source
        if "\r\r" not in source.text:
            continue
        doubled = list(_DOUBLED.finditer(source.text))
        if not doubled:
            continue
        edits = tuple(Edit(Span(source, m.start(), m.end()), "\r\n") for m in doubled)
        count = "1 line ends" if len(doubled) == 1 else f"{len(doubled)} lines end"
        fix = Fix("leave CR LF at the end of lines", edits)
        first = source.line_starts[source.position(doubled[0].start())[0] - 1]
        place = Span(source, first, max(first, doubled[0].start()))
        yield Diagnostic(BadLineEndings(count), place, fix=fix)


def find_bad_encoding(facts: Facts) -> Iterator[Diagnostic]:
    """Report the first character outside the set, once per file."""
    for file in facts.files:
        text = file.source.text
        if text.isascii():
            continue
        outside = [match for match in _OUTSIDE.finditer(text) if match.group() not in _WINDOWS]
        if outside:
            first = outside[0]
            count = len({match.group() for match in outside}) - 1
            others = f", nor are {count} others" if count > 1 else ", nor is another" * count
            violation = BadEncoding(first.group(), ord(first.group()), others)
            yield Diagnostic(violation, Span(file.source, first.start(), first.end()))
