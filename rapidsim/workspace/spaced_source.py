"""Text of a file with room behind each item, so that places stay when an item grows.

Nodes hold offsets. If these counted the characters of the file, a character typed at its top would
move all nodes. In a spaced text they are addresses: an edit in a routine uses up some of the room
behind it, and no other address changes. The room consists of line ends, which mean nothing in
RAPID. Whatever leaves the workspace has the offsets of the file again.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator, Sequence
from itertools import pairwise

from rapidsim.diagnostics import LINE_END, Source
from rapidsim.values import value_class

_BLANKS = frozenset(" \t\r\n!")
"""Characters with which a blank or a comment begins."""
_LEAST_ROOM = 120
"""Least number of characters by which a piece can grow; a large one grows by more."""


@value_class(frozen=True, slots=True)
class TextPiece:
    """A piece of a spaced text, at this moment."""

    source: SpacedSource
    start: int
    """Offset in the file."""
    address: int
    end: int
    """Address past the text of the piece; room follows."""
    next_address: int
    """Address of the next piece."""


class SpacedSource(Source):
    """The text of a file in pieces, with room behind each but the first and the last.

    The text changes, and so does that of `written`: findings in pieces that do not move stay as
    they are.
    """

    def __init__(self, file: str, text: str, ranges: Sequence[tuple[int, int]]) -> None:
        """Space a text.

        Args:
            file: The name of the file.
            text: Its text.
            ranges: Offsets of the pieces with odd numbers, in order; the others lie between them.
        """
        super().__init__(file, "")
        # Corrections copy the line end that they find.
        line_end = LINE_END.search(text)
        self._filling = line_end.group() if line_end else "\n"
        marks = [0, *(mark for one in ranges for mark in one), len(text)]
        self._starts = marks[:-1]
        """Offsets of the pieces in the file; those with odd numbers are single items."""
        self._addresses: list[int] = []
        pieces: list[str] = []
        address = 0
        for number, (start, end) in enumerate(pairwise(marks)):
            self._addresses.append(address)
            is_between = 0 < number < len(marks) - 2
            room = (_LEAST_ROOM + (end - start) * (number % 2)) * is_between
            pieces.append(text[start:end] + self._room(room))
            address += end - start + room
        self._written = Source(file, "")
        self._set_texts(text, "".join(pieces))

    def _set_texts(self, written: str, spaced: str) -> None:
        vars(self)["text"] = spaced
        vars(self._written)["text"] = written
        vars(self._written).pop("line_starts", None)

    @property
    def written(self) -> Source:
        """The text of the file as written."""
        return self._written

    def address(self, offset: int) -> int:
        """Address of an offset in the file."""
        piece = bisect_right(self._starts, offset) - 1
        return self._addresses[piece] + offset - self._starts[piece]

    def offset(self, address: int) -> int:
        """Offset in the file of an address."""
        piece = self.piece_of(address)
        inside = min(address - self._addresses[piece], self._end(piece) - self._starts[piece])
        return self._starts[piece] + inside

    def offsets(self, start: int, end: int) -> tuple[int, int]:
        """Offsets in the file of the addresses of a range."""
        behind = bisect_right(self._addresses, start)
        shift = self._starts[behind - 1] - self._addresses[behind - 1]
        # Most spans lie in a piece that is not the last.
        if behind < len(self._starts) and start <= end <= self._starts[behind] - shift:
            return start + shift, end + shift
        return self.offset(start), self.offset(end)

    def piece(self, address: int) -> TextPiece:
        """The piece that contains an address."""
        number = self.piece_of(address)
        begin, start = self._addresses[number], self._starts[number]
        is_last = number + 1 == len(self._starts)
        # The end of the text belongs to the last piece.
        behind = len(self.text) + 1 if is_last else self._addresses[number + 1]
        return TextPiece(self, start, begin, begin + self._end(number) - start, behind)

    def piece_at(self, start: int, end: int, text: str) -> tuple[int, int, int] | None:
        """Return the piece that may grow and contains a range, with its number.

        Args:
            start: Offset in the file.
            end: Offset in the file.
            text: The text in its place.

        Returns:
            Number, address of the beginning, and address of the end; None if there is no such
            piece.
        """
        piece = bisect_right(self._starts, start) - 1
        if piece % 2 == 0 and piece and start == end == self._starts[piece]:
            # A word or mark at the end of an item belongs to it.
            piece -= bool(text) and text[0] not in _BLANKS
        if piece + 1 == len(self._starts) or end > self._end(piece):
            return None
        address = self._addresses[piece]
        return piece, address, address + self._end(piece) - self._starts[piece]

    def addresses(self, piece: int) -> tuple[int, int]:
        """Addresses of the beginning and the end of the text of a piece."""
        begin = self._addresses[piece]
        return begin, begin + self._end(piece) - self._starts[piece]

    def text_of(self, piece: int) -> str:
        """The text of a piece."""
        begin, end = self.addresses(piece)
        return self.text[begin:end]

    def piece_of(self, address: int) -> int:
        """Number of the piece that contains an address; those with odd numbers are items."""
        return bisect_right(self._addresses, address) - 1

    def is_piece(self, start: int, end: int) -> bool:
        """Whether a range of addresses is a piece with an odd number, but for blanks before it."""
        piece = self.piece_of(start)
        begin = self._addresses[piece]
        stop = begin + self._end(piece) - self._starts[piece]
        return piece % 2 == 1 and end == stop and not self.text[begin:start].strip()

    def shifts(self) -> Iterator[tuple[int, int]]:
        """Yield for each piece its end in the file, and the distance of addresses to offsets."""
        for piece, (start, address) in enumerate(zip(self._starts, self._addresses, strict=True)):
            yield self._end(piece), address - start

    def replace(self, start: int, end: int, text: str) -> bool:
        """Replace text within a piece that may grow; whether the room suffices.

        Args:
            start: Offset in the file.
            end: Offset in the file.
            text: The new text.
        """
        found = self.piece_at(start, end, text)
        growth = len(text) - (end - start)
        if found is None:
            return False
        piece, address, stop = found
        next_address = self._addresses[piece + 1]
        if stop + growth >= next_address or (self._filling == "\r" and "\n" in text):
            return False
        begin = address + start - self._starts[piece]
        room = next_address - stop - growth
        written = self._written.text
        self._set_texts(
            f"{written[:start]}{text}{written[end:]}",
            f"{self.text[:begin]}{text}{self.text[begin + end - start : stop]}"
            f"{self._room(room)}{self.text[next_address:]}",
        )
        for later in range(piece + 1, len(self._starts)):
            self._starts[later] += growth
        return True

    def _room(self, size: int) -> str:
        """Line ends with so many characters together."""
        count, rest = divmod(size, len(self._filling))
        return self._filling * count + self._filling[-1] * rest

    def _end(self, piece: int) -> int:
        """Offset in the file past a piece."""
        last = piece + 1 == len(self._starts)
        return len(self._written.text) if last else self._starts[piece + 1]

    @property
    def line_starts(self) -> Sequence[int]:
        """Offset in the file of the first character of each line."""
        return self.written.line_starts

    def position(self, offset: int) -> tuple[int, int]:
        """Line and column of an address, both counted from 1."""
        return self.written.position(self.offset(offset))

    def line(self, number: int) -> str:
        """Text of a line, counted from 1, without its line end."""
        return self.written.line(number)
