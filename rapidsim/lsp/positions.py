"""Offsets of characters to lines and code units of the protocol, and back.

Lines are those of the protocol: LF, CR LF and CR end one, so the line end CR CR LF of some tools is
two, though the rest of rapidsim counts one. Hence positions are converted by offset, never by line
number.

Source: Language Server Protocol 3.17, "Text Documents" and "Position".
"""

from __future__ import annotations

import re
from bisect import bisect_right
from enum import StrEnum
from functools import cached_property

from lsprotocol.types import Position, Range

from rapidsim.values import value_class

_LINE_END = re.compile(r"\r\n|\n|\r")


class Encoding(StrEnum):
    """Code units in which the columns of a client count."""

    UTF8 = "utf-8"
    UTF16 = "utf-16"
    UTF32 = "utf-32"

    def units(self, text: str) -> int:
        """Number of code units of a text."""
        if text.isascii() or self is Encoding.UTF32:
            return len(text)
        if self is Encoding.UTF8:
            return len(text.encode("utf-8", "surrogatepass"))
        return len(text) + sum(character > "\uffff" for character in text)


@value_class(frozen=True, eq=False, repr=False)
class LineTable:
    """A text with the offsets of its lines."""

    text: str
    encoding: Encoding = Encoding.UTF16

    @cached_property
    def starts(self) -> tuple[int, ...]:
        """Offset of the first character of each line."""
        return (0, *(match.end() for match in _LINE_END.finditer(self.text)))

    @cached_property
    def _is_plain(self) -> bool:
        """Whether each character is one code unit."""
        return self.encoding is Encoding.UTF32 or self.text.isascii()

    def position(self, offset: int) -> Position:
        """Position of an offset; offsets past the end mean the end."""
        offset = max(0, min(offset, len(self.text)))
        line = bisect_right(self.starts, offset) - 1
        start = self.starts[line]
        if self._is_plain:
            return Position(line, offset - start)
        return Position(line, self.encoding.units(self.text[start:offset]))

    def range(self, start: int, end: int) -> Range:
        """Range of a part of the text."""
        return Range(self.position(start), self.position(end))

    def offset(self, position: Position) -> int:
        """Offset of a position; one past the end of its line means that end, before the line end.

        A position inside a character means its start.
        """
        if position.line >= len(self.starts):
            return len(self.text)
        if position.line < 0:
            return 0
        start = self.starts[position.line]
        line = self.text[start : self.line_end(position.line)]
        if self._is_plain or line.isascii():
            return start + max(0, min(position.character, len(line)))
        units = 0
        for index, character in enumerate(line):
            units += self.encoding.units(character)
            if units > position.character:
                return start + index
        return start + len(line)

    def line_end(self, line: int) -> int:
        """Offset past the last character of a line, before its line end."""
        if line + 1 == len(self.starts):
            return len(self.text)
        end = self.starts[line + 1]
        start = self.starts[line]
        return start + len(self.text[start:end].rstrip("\r\n"))
