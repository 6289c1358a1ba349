"""One file of a workspace: its tree in a spaced text, of which single items can be parsed again."""

from __future__ import annotations

from bisect import bisect_left
from dataclasses import replace
from typing import TypeAlias

from rapidsim.analysis.suppressions import is_suppressing
from rapidsim.diagnostics import Diagnostic
from rapidsim.syntax import tree
from rapidsim.syntax.lexer import Tokens, lex
from rapidsim.syntax.parser import parse_tokens
from rapidsim.syntax.routine_text import item_ranges, parse_data, parse_items, parse_routine
from rapidsim.values import value_class
from rapidsim.workspace.changes import TextChange
from rapidsim.workspace.spaced_source import SpacedSource

_BLANKS = frozenset(" \t\r\n!")
_LINE_ENDS = frozenset("\r\n")
_MOST_ERRORS = 100
"""Number of errors in a file beyond which it is parsed as a whole; the repair stops at some."""


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


class FileUnits:
    """The tree of a file, with comments and findings of the text by routine."""

    def __init__(self, path: str, text: str) -> None:
        """Parse a file."""
        tokens = lex(text)
        self.source = SpacedSource(path, text, list(item_ranges(tokens, text)))
        parsed = parse_tokens(_spaced(tokens, self.source), self.source)
        self.modules = parsed.file.modules
        self._homes = {
            self.source.piece_of(routine.start): (routine, module)
            for module in self.modules
            for routine in module.routines
            if self.source.is_piece(routine.start, routine.end)
        }
        """Routines that can be parsed alone, with their modules, by number of their piece."""
        self._data = {
            self.source.piece_of(item.start): (item, module)
            for module in self.modules
            for item in module.items
            if isinstance(item, tree.Data)
            and item.value is not None
            and self.source.text[item.end : item.end + 1] == ";"
            and self.source.is_piece(item.start, item.end + 1)
        }
        """Data with values that can be parsed alone."""
        self._items: dict[int, tuple[tree.Module, tuple[tree.Item, ...]]] = {
            self.source.piece_of(item.start): (module, (item,))
            for module in self.modules
            for item in module.items
            if self._is_piece(item)
        }
        """Data and routines by number of their piece, and those that came between, by module."""
        self._comments: dict[int, list[tree.Comment]] = {}
        self._inside: dict[int, list[Diagnostic]] = {}
        self._outside: list[Diagnostic] = []
        """Findings about the text that belong to no single routine."""
        for comment in parsed.file.comments:
            self._comments.setdefault(self.source.piece_of(comment.start), []).append(comment)
        for found in parsed.diagnostics:
            piece = -1 if found.span is None else self.source.piece_of(found.span.start)
            routine = self._homes[piece][0] if piece in self._homes else None
            place = -1 if found.span is None else found.span.start
            if routine and routine.header_end <= place < routine.end:
                self._inside.setdefault(piece, []).append(found)
            else:
                self._outside.append(found)

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
        return [*self._outside, *(one for found in self._inside.values() for one in found)]

    def edit(self, change: TextChange) -> Edited | None:
        """Change items of a module, and parse them.

        Returns:
            The routine with another body, the data with another value, or other items, whose trees
            are still the old ones; None if the file must be parsed as a whole. The text may have
            changed then.
        """
        place = self.source.piece_at(change.start, change.end)
        if place is None or self._outside or len(self.diagnostics) > _MOST_ERRORS:
            # Corrections outside of routines may depend on all text before them.
            return None
        piece, start, stop = place
        end = stop + len(change.text) - (change.end - change.start)
        address = self.source.address(change.start)
        if piece in self._data and piece not in self._comments:
            value = self._data[piece][0].value
            if value is not None and address >= value.start:
                return self._edit_data(change, piece, start, end)
        if piece in self._homes and address >= self._homes[piece][0].header_end:
            return self._edit_routine(change, piece, start, end)
        return self._edit_items(change, piece, start, end)

    def _edit_routine(
        self, change: TextChange, piece: int, start: int, end: int
    ) -> EditedRoutine | EditedItems | None:
        routine, module = self._homes[piece]
        if not self.source.replace(change.start, change.end, change.text):
            return None
        parsed = parse_routine(self.source, start, end, routine, module)
        if parsed is None:
            return self._parse_items(piece, start, end)
        if (parsed.diagnostics or self._inside.get(piece)) and self._inside.get(piece + 2):
            # A correction at the end of a routine looks a few tokens further.
            return None
        self._comments[piece] = list(parsed.comments)
        self._inside[piece] = list(parsed.diagnostics)
        return EditedRoutine(routine, module, parsed.routine)

    def _edit_items(
        self, change: TextChange, piece: int, start: int, end: int
    ) -> EditedItems | None:
        if piece not in self._items and not self._is_between(piece, start):
            return None
        if not self.source.replace(change.start, change.end, change.text):
            return None
        return self._parse_items(piece, start, end)

    def _parse_items(self, piece: int, start: int, end: int) -> EditedItems | None:
        """Parse a piece whose text changed, if it and the others of the file have no errors."""
        if any(self._inside.values()) or piece not in self._items:
            # A correction in a routine looks a few tokens further.
            return None
        module, removed = self._items[piece]
        text = self.source.text[start:end]
        parsed = parse_items(self.source, start, end, module)
        if parsed is None:
            return None
        if piece % 2:
            is_apart = parsed.last == end or not text.strip()
        else:
            is_apart = text[:1] in _BLANKS and text[-1:] in _LINE_ENDS
        if not is_apart:
            return None
        self._items[piece] = module, parsed.items
        self._comments[piece] = list(parsed.comments)
        self._homes.pop(piece, None)
        self._data.pop(piece, None)
        for item in parsed.items:
            if not self._is_piece(item):
                continue
            if isinstance(item, tree.Routine):
                self._homes[piece] = item, module
            elif isinstance(item, tree.Data) and item.value is not None:
                self._data[piece] = item, module
        return EditedItems(module, removed, parsed.items)

    def _is_piece(self, item: tree.Item) -> bool:
        """Whether an item is alone in a piece, so that it can be parsed alone."""
        if isinstance(item, tree.Routine):
            return self.source.is_piece(item.start, item.end)
        is_closed = self.source.text[item.end : item.end + 1] == ";"
        is_data = isinstance(item, tree.Data) and is_closed
        return is_data and self.source.is_piece(item.start, item.end + 1)

    def _is_between(self, piece: int, start: int) -> bool:
        """Whether a piece lies between two of one module and has only blanks and comments."""
        before, behind = self._items.get(piece - 1), self._items.get(piece + 1)
        if before is None or behind is None or before[0] is not behind[0]:
            return False
        stop = self.source.end_address(piece)
        text = self.source.text
        if len(lex(text, [(0, start), (stop, len(text))]).kinds) > 1:
            return False
        self._items[piece] = before[0], ()
        return True

    def _edit_data(
        self, change: TextChange, piece: int, start: int, end: int
    ) -> EditedData | EditedItems | None:
        data, module = self._data[piece]
        if not self.source.replace(change.start, change.end, change.text):
            return None
        parsed = parse_data(self.source, start, end, data, module)
        if parsed is None:
            return self._parse_items(piece, start, end)
        return EditedData(data, module, parsed)


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
