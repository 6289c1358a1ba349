"""Rules E106 and E107: bytes of a file that controllers or other tools stumble over."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from rapidsim.analysis.rules.facts import Facts
from rapidsim.diagnostics import Diagnostic, Edit, Fix, Severity, Span, Violation

_DOUBLED = re.compile(r"\r{2,}\n")
_OUTSIDE = re.compile(r"[^\x00-\xff\ufffd]")
# Code page 1252 has these where ISO 8859-1 has control characters; controllers show them.
_WINDOWS = frozenset("€‚ƒ„…†‡ˆ‰Š‹ŒŽ‘’“”•–—˜™š›œžŸ")


@dataclass(frozen=True)
class BadLineEndings(Violation):
    """Lines end in two carriage returns and a line feed.

    Careless transfers double the carriage return. Older controllers read the extra one as an empty
    line or refuse the module, and editors show every second line empty. `--fix` takes it out.
    """

    code: ClassVar[str] = "E106"
    name: ClassVar[str] = "bad-line-endings"
    template: ClassVar[str] = "{lines} in CR CR LF, first here"
    severity: ClassVar[Severity] = Severity.WARNING

    lines: str

    @property
    def help(self) -> str:
        """The cure."""
        return "`rapidsim check --fix` leaves CR LF"


@dataclass(frozen=True)
class BadEncoding(Violation):
    """A character is outside the set that controllers up to RobotWare 6 can show.

    They keep modules in ISO 8859-1. Arrows, typographic quotes of other sets or other scripts come
    out as two or three wrong characters each; in a string they also count as so many.

    ## Example

        MODULE example
          PROC main()
            TPWrite "Station A → B";
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            TPWrite "Station A to B";
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "E107"
    name: ClassVar[str] = "bad-encoding"
    template: ClassVar[str] = "`{character}` (U+{number:04X}) is not in ISO 8859-1{others}"
    severity: ClassVar[Severity] = Severity.NOTE

    character: str
    number: int
    others: str

    @property
    def help(self) -> str:
        """The cure."""
        return "write it with letters that western European keyboards have"


def find_bad_line_endings(facts: Facts) -> Iterator[Diagnostic]:
    """One finding a file, with the edits that leave CR LF."""
    for file in facts.files:
        source = file.source
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
    """One finding a file, at the first character that is outside the set."""
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
