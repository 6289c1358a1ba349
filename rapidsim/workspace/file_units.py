"""One file of a workspace: its tree in a spaced text, of which single items can be parsed again."""

from __future__ import annotations

import re
from bisect import bisect_left, bisect_right
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TypeAlias

from rapidsim.analysis.suppressions import is_suppressing
from rapidsim.diagnostics import Diagnostic
from rapidsim.syntax import tree
from rapidsim.syntax.lexer import Tokens, lex
from rapidsim.syntax.parser import parse_tokens
from rapidsim.syntax.routine_text import (
    ParsedItems,
    ParsedRoutine,
    item_ranges,
    parse_data,
    parse_items,
    parse_routine,
)
from rapidsim.values import value_class
from rapidsim.workspace.changes import TextChange
from rapidsim.workspace.spaced_source import SpacedSource

_BLANKS = frozenset(" \t\r\n!")
_LINE_ENDS = frozenset("\r\n")
_REST_OF_LINE = re.compile(r"[ \t]*(?:![^\r\n]*)?(?:[\r\n]|$)")
"""A line behind an item, without words and marks."""
_MOST_ERRORS = 100
"""Number of errors in a file beyond which it is parsed as a whole; the repair stops at some."""
_REACH = 4
"""Number of pieces, two of which are items, that a correction may look at behind an error."""
_MOST_PIECES = 400
"""Number of pieces beyond which the whole file is parsed."""


@value_class(frozen=True, slots=True, eq=False)
class EditedRoutine:
    """A routine whose text changed."""

    routine: tree.Routine
    """The routine with its old body."""
    module: tree.Module
    replacement: tree.Routine
    """A routine with the same header and the new body."""


@value_class(frozen=True, slots=True, eq=False)
class EditedData:
    """Data of a module whose value changed."""

    data: tree.Data
    """The declaration with its old value."""
    module: tree.Module
    replacement: tree.Data


@value_class(frozen=True, slots=True, eq=False)
class EditedItems:
    """Data and routines in place of others."""

    module: tree.Module
    """The module, which still has its old items."""
    removed: tuple[tree.Item, ...]
    added: tuple[tree.Item, ...]


Edited: TypeAlias = EditedRoutine | EditedData | EditedItems


@value_class(frozen=True, slots=True, eq=False)
class _Fault:
    """Errors of syntax, with the first and the last piece on which they may depend."""

    first: int
    last: int
    diagnostics: Sequence[Diagnostic]

    def is_in(self, item: tree.Item | None) -> bool:
        """Whether all errors are in the body of a routine."""
        return isinstance(item, tree.RoutineNode) and all(
            one.span is not None and item.header_end <= one.span.start < item.end
            for one in self.diagnostics
        )


@value_class(frozen=True, slots=True, eq=False)
class _ParsedRange:
    """Pieces of a module that were parsed together."""

    first: int
    stop: int
    """The last one in the module."""
    last: int
    """The last one on which errors in them may depend; may be behind the module."""
    parsed: ParsedItems
    same_items: Mapping[int, tree.Item]
    """The items before that stay, by address."""


class FileUnits:
    """The tree of a file, with comments and findings of the text by piece."""

    def __init__(self, path: str, text: str) -> None:
        """Parse a file."""
        tokens = lex(text)
        self.source = SpacedSource(path, text, list(item_ranges(tokens, text)))
        parsed = parse_tokens(_spaced(tokens, self.source), self.source)
        self.modules = parsed.file.modules
        self._items: dict[int, tuple[tree.Module, tuple[tree.Item, ...]]] = {}
        """Items by the piece in which they begin, but the head and the end of their module."""
        for module in self.modules:
            self._take_module(module)
        self._comments: dict[int, list[tree.Comment]] = {}
        for comment in parsed.file.comments:
            self._comments.setdefault(self.source.piece_of(comment.start), []).append(comment)
        self._faults = [self._fault(found) for found in parsed.diagnostics]

    def _take_module(self, module: tree.Module) -> None:
        piece_of = self.source.piece_of
        pieces = range(piece_of(module.name.end) + 1, piece_of(module.end - 1))
        found: dict[int, list[tree.Item]] = {piece: [] for piece in pieces}
        for item in module.items:
            piece = piece_of(item.start)
            if piece in found:
                found[piece].append(item)
        self._items |= {piece: (module, tuple(items)) for piece, items in found.items()}

    def _fault(self, error: Diagnostic) -> _Fault:
        """An error in the file as a whole, with what it may depend on."""
        if error.span is None:
            return _Fault(0, len(self._items) + _REACH, (error,))
        start, end = error.span.start, error.span.end
        first = last = self.source.piece_of(start)
        routine = self._alone(first)
        if not (
            isinstance(routine, tree.RoutineNode) and routine.header_end <= start < routine.end
        ):
            # The item that contains it, or ends before it, may begin long before.
            items = [item for one in self.modules for item in one.items]
            number = bisect_right(items, start, key=lambda item: item.start)
            for item in items[max(number - 1, 0) : number + 1]:
                if item.start <= end and start <= item.end:
                    first = min(first, self.source.piece_of(item.start))
                    end = max(end, item.end)
            last = self.source.piece_of(end)
        return _Fault(first, last + _REACH, (error,))

    @property
    def file(self) -> tree.File:
        """The tree of the file, with its comments."""
        comments = (one for piece in sorted(self._comments) for one in self._comments[piece])
        return tree.File(self.source, self.modules, tuple(comments))

    @property
    def suppressing(self) -> tuple[tree.Comment, ...]:
        """The comments that suppress findings, at their offsets in the file as written."""
        return tuple(
            tree.Comment(self.source.offset(one.start), one.text)
            for comments in self._comments.values()
            for one in comments
            if is_suppressing(one)
        )

    @property
    def diagnostics(self) -> list[Diagnostic]:
        """Findings about the text."""
        return [one for fault in self._faults for one in fault.diagnostics]

    def edit(self, change: TextChange) -> Edited | None:
        """Change items of a module, and parse them.

        Returns:
            The routine with another body, the data with another value, or other items, whose trees
            are still the old ones; None if the file must be parsed as a whole. The text may have
            changed then.
        """
        place = self.source.piece_at(change.start, change.end, change.text)
        if place is None or len(self.diagnostics) > _MOST_ERRORS:
            return None
        piece, start, stop = place
        address, item = start + change.start - self.source.offset(start), self._alone(piece)
        if piece not in self._items or not self.source.replace(
            change.start, change.end, change.text
        ):
            return None
        end = stop + len(change.text) - (change.end - change.start)
        if not self._is_apart(piece, start, end):
            return None
        edited = None if item is None else self._parse_alone(piece, item, address, (start, end))
        return edited or self._parse_around(piece)

    def _parse_alone(
        self, piece: int, item: tree.Routine | tree.Data, address: int, span: tuple[int, int]
    ) -> Edited | None:
        """Parse a changed piece, the only item of which is known, without its neighbours.

        Args:
            piece: Its number.
            item: Its item before the change.
            address: Where the change begins.
            span: Start and end of the piece.

        Returns:
            None if the change or errors near by may concern more than a body or a value.
        """
        module = self._items[piece][0]
        near = [one for one in self._faults if one.first <= piece <= one.last]
        own = [one for one in near if one.is_in(item)]
        before = [one for one in near if one not in own]
        behind = [one for one in self._faults if piece < one.first <= piece + _REACH]
        if before:
            return None
        if isinstance(item, tree.Data):
            value = item.value
            is_plain = not (own or behind or piece in self._comments)
            if not is_plain or value is None or address < value.start:
                return None
            data = parse_data(self.source, *span, item, module)
            return None if data is None else EditedData(item, module, data)
        if address < item.header_end:
            return None
        parsed = parse_routine(self.source, *span, item, module)
        # A correction at the end of a routine looks a few tokens further.
        if parsed is None or ((own or parsed.diagnostics) and behind):
            return None
        self._take_body(piece, parsed, own)
        return EditedRoutine(item, module, parsed.routine)

    def _take_body(self, piece: int, parsed: ParsedRoutine, own: Sequence[_Fault]) -> None:
        """Replace comments and errors of a piece with those of its new routine."""
        self._comments[piece] = list(parsed.comments)
        self._faults = [one for one in self._faults if one not in own]
        if parsed.diagnostics:
            self._faults.append(_Fault(piece, piece + _REACH, parsed.diagnostics))

    def _alone(self, piece: int) -> tree.Routine | tree.Data | None:
        """The only item of a piece, if it can be parsed alone."""
        match self._items.get(piece):
            case _, (tree.RoutineNode() as routine,) if self.source.is_piece(
                routine.start, routine.end
            ):
                return routine
            case _, (tree.Data() as data,) if self.source.is_piece(data.start, data.end + 1):
                return data if self.source.text[data.end : data.end + 1] == ";" else None
            case _:
                return None

    def _is_apart(self, piece: int, start: int, end: int) -> bool:
        """Whether the text of a piece has no word, string or comment in common with the next."""
        text = self.source.text
        if piece % 2 == 0:
            is_between = text[start : start + 1] in _BLANKS and text[end - 1 : end] in _LINE_ENDS
            is_after_item = bool(self.source.text_of(piece - 1))
            starts = not is_after_item or _REST_OF_LINE.match(text, start, end) is not None
            return start == end or (is_between and starts)
        behind = self.source.text_of(piece + 1)
        if behind[:1] in _LINE_ENDS or not text[start:end].strip():
            return True
        tokens = lex(text, [(0, start), (end, len(text))])
        return len(tokens.ends) > 1 and tokens.ends[-2] == end and not tokens.unterminated

    def _parse_around(self, piece: int) -> EditedItems | None:
        """Parse a piece whose text changed, with as many others as may read otherwise now."""
        module = self._items[piece][0]
        found = self._parsed_range(piece, module)
        if found is None:
            return None
        parsed, pieces = found.parsed, range(found.first, found.stop + 1)
        homes = [self.source.piece_of(item.start) for item in parsed.items]
        if any(home not in pieces for home in homes):
            # The end of the module was skipped with an item.
            return None
        removed = [item for one in pieces for item in self._items[one][1]]
        added = [found.same_items.get(item.start, item) for item in parsed.items]
        self._faults = [one for one in self._faults if not found.first <= one.first <= found.last]
        if parsed.diagnostics:
            self._faults.append(_Fault(found.first, found.last, parsed.diagnostics))
        for one in pieces:
            self._items[one] = module, ()
            self._comments.pop(one, None)
        for home, item in zip(homes, added, strict=True):
            self._items[home] = module, (*self._items[home][1], item)
        for comment in parsed.comments:
            self._comments.setdefault(self.source.piece_of(comment.start), []).append(comment)
        stay = set(found.same_items.values())
        return EditedItems(
            module,
            tuple(item for item in removed if item not in stay),
            tuple(item for item in added if item not in stay),
        )

    def _parsed_range(self, piece: int, module: tree.Module) -> _ParsedRange | None:
        """Parse pieces around one, more of them until those at the end read as before."""
        inner = [one for one, (home, _) in self._items.items() if home is module]
        first, last = piece, piece + _REACH * bool(self._faults)
        while True:
            first, last = self._with_faults(first, last)
            begin = self._begin(first, module)
            stop = min(last, inner[-1])
            if begin is None or first < inner[0] or stop - begin > _MOST_PIECES:
                return None
            closes = last > stop
            if closes and (module is not self.modules[-1] or self._has_faults_behind(stop + 1)):
                # A correction looks at the text behind the module.
                return None
            parsed = self._parse_pieces(begin, stop, module, closes=closes)
            if parsed is None:
                return None
            kept, reach = self._unchanged(parsed, piece, begin, stop)
            is_faulty = bool(parsed.diagnostics)
            if reach + _REACH * is_faulty <= last or closes:
                return _ParsedRange(begin, stop, last, parsed, kept)
            last = max(reach + _REACH, last + (last - first))

    def _begin(self, piece: int, module: tree.Module) -> int | None:
        """The last piece with an item before another piece, as a correction may look at its end.

        Returns:
            The piece itself if no item is before it; None if a correction may look at the head.
        """
        begin = piece
        while self._items.get(begin - 1, (None,))[0] is module:
            begin -= 1
            if begin % 2 and self._items[begin][1]:
                return begin
        head = self.source.text[module.name.end : self.source.addresses(begin)[0]]
        return None if head.lstrip().startswith("(") else begin

    def _has_faults_behind(self, piece: int) -> bool:
        """Whether there is an error behind a piece."""
        _, end = self.source.addresses(piece)
        return any(
            one.span is None or end < one.span.start
            for fault in self._faults
            for one in fault.diagnostics
        )

    def _with_faults(self, first: int, last: int) -> tuple[int, int]:
        """Widen a range of pieces by the errors that depend on some of them."""
        while True:
            near = [one for one in self._faults if one.first <= last and first <= one.last]
            wider = (
                min([first, *(one.first for one in near)]),
                max([last, *(one.last for one in near)]),
            )
            if wider == (first, last):
                return wider
            first, last = wider

    def _parse_pieces(
        self, first: int, last: int, module: tree.Module, *, closes: bool
    ) -> ParsedItems | None:
        """Parse a range of pieces, with the end of the module if it follows and is asked for."""
        start, _ = self.source.addresses(first)
        _, end = self.source.addresses(last + closes)
        return parse_items(self.source, start, end, module, closes=closes)

    def _unchanged(
        self, parsed: ParsedItems, piece: int, first: int, last: int
    ) -> tuple[dict[int, tree.Item], int]:
        """Compare items with those before.

        Returns:
            The items before that stay, by address; and the last piece with anything else.
        """
        errors = [*parsed.diagnostics]
        errors += [d for one in self._faults if first <= one.first <= last for d in one.diagnostics]
        spans = [one.span for one in errors if one.span is not None]
        reach = piece
        for span in spans:
            reach = max(reach, self.source.piece_of(span.end))
        new = {item.start: item for item in parsed.items}
        kept: dict[int, tree.Item] = {}
        for one in range(first, last + 1):
            for item in self._items[one][1]:
                other = new.get(item.start)
                if (
                    one != piece
                    and other is not None
                    and (type(other), other.end) == (type(item), item.end)
                    and not any(item.start <= at.end and at.start <= item.end for at in spans)
                ):
                    kept[item.start] = item
                else:
                    reach = max(reach, one, self.source.piece_of(item.end))
        for item in parsed.items:
            if item.start not in kept:
                reach = max(reach, self.source.piece_of(item.end))
        return kept, reach


def _spaced(tokens: Tokens, source: SpacedSource) -> Tokens:
    """Tokens at their addresses."""
    starts: list[int] = []
    ends: list[int] = []
    first = 0
    for stop, shift in source.shifts():
        # The last token is at the end of the file.
        last = len(tokens.starts) if stop == len(source.written.text) else 0
        last = last or bisect_left(tokens.starts, stop, first)
        starts += [place + shift for place in tokens.starts[first:last]]
        ends += [place + shift for place in tokens.ends[first:last]]
        first = last
    comments = tuple(tree.Comment(source.address(one.start), one.text) for one in tokens.comments)
    unterminated = tuple(map(source.address, tokens.unterminated))
    return replace(tokens, starts=starts, ends=ends, comments=comments, unterminated=unterminated)
