"""Bulk statements: runs of lines that differ only in the target, found by exact text.

Programs exported by other software have thousands of them: moves with the numbers of their target,
or declarations of targets and moves to them by name. A run is matched as a whole by one regular
expression and read into columns, without an object per line. Lines that do not match exactly are
left to the parser: another blank, a comment, a statement on two lines, an invalid number. The same
applies to a line whose numbers the caller wants to be parsed, and to a name that occurs anywhere
except in its declaration and in one move.

Of each run the first two lines and the last one are parsed as well, and so are the neighbours of
parsed lines. Findings that depend on the kind of a line or on its neighbours therefore occur at
parsed lines.
"""

from __future__ import annotations

import re
import warnings
from collections import Counter
from collections.abc import Iterator, Sequence, Set
from functools import lru_cache
from itertools import compress, pairwise
from typing import TYPE_CHECKING

import numpy as np

from rapidsim.syntax.bulk_reading import BulkReading
from rapidsim.syntax.limits import LONGEST_NAME
from rapidsim.syntax.stored_table import rapid_table
from rapidsim.syntax.tree.bulk_statements import TARGET_SHAPE, TARGET_WIDTH
from rapidsim.values import value_class

if TYPE_CHECKING:
    from rapidsim.syntax.bulk_reading import Mask
    from rapidsim.syntax.tree.bulk_statements import Numbers, Offsets

LEAST_LINES = 12
"""Minimum number of lines of a run; shorter ones are parsed."""
_BLOCK = 4_000_000
"""Number of characters that are read into columns at once."""
_LEAST_STRETCH = 8
"""Minimum average number of lines of the intervals with names, below which they do not pay."""

# Possessive: a match is final, so a line that fails at its end fails once.
_NUMBER = r" *+-?+(?:[0-9]++(?:\.[0-9]*+)?+|\.[0-9]++)(?:[eE][+-]?+[0-9]++)?+ *+"
_PARTS = ",".join(rf" *+\[{','.join([_NUMBER] * count)}\] *+" for count in TARGET_SHAPE)
_TARGET = rf"\[{_PARTS}\] *+"
_NAME = r"[A-Za-z][A-Za-z0-9_]*+"
# No string, comment or function call: nothing that depends on another line.
_REST = r",[^\n;!\"(]*+;[ \t]*+\r?\n"
_LINE = re.compile(
    rf"^(?:([ \t]*+Move[JL][ \t]++)(?:{_TARGET}|({_NAME}))({_REST})"
    rf"|([ \t]*+(?:LOCAL[ \t]++)?+CONST[ \t]++robtarget[ \t]++){_NAME}([ \t]*+:=[ \t]*+){_TARGET}"
    r"(;[ \t]*+\r?\n))",
    re.MULTILINE | re.IGNORECASE,
)
_WORD = re.compile(r"\w+")
_TO_BLANKS = bytes.maketrans(b"[],", b"   ")


@value_class(frozen=True, slots=True, eq=False)
class SkippedSpan:
    """Consecutive lines of a run that are not parsed."""

    like: int
    """Offset of the parsed line before them."""
    lines: Offsets
    """Offset of each line, and of the parsed line after them: shape (rows + 1,)."""
    numbers: Numbers
    """Numbers of each target, as `num`: shape (rows, 17)."""
    numbers_of_like: Numbers
    """Numbers of the target of the line before them: shape (17,)."""
    names: tuple[str, ...] = ()
    """Folded names that the lines declare."""
    declared: Offsets | None = None
    """Offset of the declaration of each target; None if the targets are written out."""


@value_class(frozen=True, slots=True, eq=False)
class _BulkBlock:
    """A complete run: of moves with their targets, of declarations, or of moves by name."""

    lines: Offsets
    """Offset of each line, and of the line after them: shape (lines + 1,)."""
    numbers: Numbers | None
    """Numbers as written: shape (lines, 17); None for moves by name."""
    names: Sequence[str]
    """Folded names; empty if targets are written out."""


def skipped_spans(text: str, how: BulkReading) -> tuple[SkippedSpan, ...]:
    """Return the skipped spans of a text, in order."""
    written: list[SkippedSpan] = []
    declarations: list[_BulkBlock] = []
    by_name: list[_BulkBlock] = []
    for one in _runs(text):
        if not one.names:
            assert one.numbers is not None
            written += _cut(one, _inner(how.of_targets(one.numbers)), one.numbers)
        else:
            (by_name if one.numbers is None else declarations).append(one)
    may_join = declarations and by_name and not how.keeps_data
    named = _joined(text, written, declarations, by_name, how) if may_join else []
    return tuple(sorted([*written, *named], key=lambda one: one.like))


def _runs(text: str) -> Iterator[_BulkBlock]:
    position = 0
    while (first := _LINE.search(text, position)) is not None:
        head, name, rest, head_of_data, becomes, rest_of_data = first.groups()
        words: tuple[str, ...] = (head, rest)
        varying = _TARGET if name is None else _NAME
        if head is None:
            words = (head_of_data, becomes, rest_of_data)
            varying = f"{_NAME}{re.escape(becomes)}{_TARGET}"
        found = _pattern(words[0], varying, words[-1]).match(text, first.start())
        assert found is not None, "its first line matches"
        position = found.end()
        long = text.count("\n", found.start(), position) >= LEAST_LINES
        if long and "".join(words).isascii():
            run = _read(text, found.start(), position, words, is_by_name=name is not None)
            if run is not None:
                yield run


@lru_cache(64)
def _pattern(head: str, varying: str, rest: str) -> re.Pattern[str]:
    return re.compile(rf"(?:{re.escape(head)}{varying}{re.escape(rest)})++")


def _read(
    text: str, begin: int, end: int, words: tuple[str, ...], *, is_by_name: bool
) -> _BulkBlock | None:
    """Read the columns of a matched run."""
    head, *becomes, rest = words
    lines, numbers = [], []
    names: list[str] = []
    while begin < end:
        stop = end if end - begin <= _BLOCK else text.index("\n", begin + _BLOCK) + 1
        block = text[begin:stop]
        of_block = np.frombuffer(block.encode("ascii"), np.uint8)
        behind = np.flatnonzero(of_block == ord("\n")) + begin + 1
        lines.append(np.concatenate([[begin], behind[:-1]]))
        varying = block.replace(rest, "\n").replace(head, "")
        if is_by_name:
            names += varying.lower().split()
        elif becomes:
            parts = varying.replace(f"{becomes[0]}[", "\n[").split("\n")
            names += [name.lower() for name in parts[:-1:2]]
            varying = "\n".join(parts[1::2])
        if not is_by_name:
            values = _numbers(varying)
            if values.shape != (len(behind), TARGET_WIDTH):
                return None
            numbers.append(values)
        begin = stop
    starts = np.append(np.concatenate(lines), end)
    if (is_by_name or becomes) and len(names) != len(starts) - 1:
        return None
    return _BulkBlock(starts, np.concatenate(numbers) if numbers else None, names)


def _numbers(targets: str) -> Numbers:
    """Parse the numbers of targets, shape (targets, 17); the shape differs if that fails."""
    digits = targets.encode("ascii").translate(_TO_BLANKS)
    with warnings.catch_warnings():
        # It warns of text that it cannot parse, and stops there.
        warnings.simplefilter("ignore", DeprecationWarning)
        read = np.fromstring(digits, dtype=np.float64, sep=" ")
    return read.reshape(-1, TARGET_WIDTH) if len(read) % TARGET_WIDTH == 0 else read


def _inner(plain: Mask) -> Mask:
    """Mask of the plain lines after two plain ones and before one; the others are parsed."""
    inner = plain.copy()
    inner[:2] = inner[-1:] = False
    inner[1:] &= plain[:-1]
    inner[2:] &= plain[:-2]
    inner[:-1] &= plain[1:]
    return inner


def _cut(
    run: _BulkBlock, left_out: Mask, numbers: Numbers, declared: Offsets | None = None
) -> Iterator[SkippedSpan]:
    """Yield the intervals of consecutive lines of a run that are skipped.

    Args:
        run: The run.
        left_out: Mask of its skipped lines.
        numbers: Numbers of the target of each line, shape (lines, 17).
        declared: Offset of the declaration of each target.
    """
    edges = np.flatnonzero(np.diff(left_out, prepend=False, append=False)).tolist()
    has_values = run.numbers is not None
    for first, stop in zip(edges[::2], edges[1::2], strict=True):
        if declared is None and not run.names and stop - first < LEAST_LINES - 3:
            continue
        yield SkippedSpan(
            int(run.lines[first - 1]),
            run.lines[first : stop + 1],
            numbers[first:stop].astype(np.float32),
            numbers[first - 1].astype(np.float32),
            tuple(run.names[first:stop]) if has_values else (),
            None if declared is None else declared[first:stop],
        )


def _joined(
    text: str,
    written: Sequence[SkippedSpan],
    declarations: Sequence[_BulkBlock],
    by_name: Sequence[_BulkBlock],
    how: BulkReading,
) -> list[SkippedSpan]:
    """Return the spans of declarations and of moves by their names; empty if they are few.

    A skipped name is skipped in both, and occurs nowhere else.
    """
    tables = [run.numbers for run in declarations if run.numbers is not None]
    columns = np.concatenate(tables)
    places = np.concatenate([run.lines[:-1] for run in declarations])
    inner = np.concatenate([_inner(how.of_declared(table)) for table in tables])
    names = [name for run in declarations for name in run.names]
    row_of = {name: row for row, name in enumerate(names)}
    # For each move by name the row of its declaration; -1 without one in a run.
    rows = [np.array([row_of.get(name, -1) for name in run.names]) for run in by_name]
    every = (*declarations, *by_name)
    times = Counter(name for run in every for name in run.names)
    wanted = {
        name
        for name in _inner_names(by_name, rows)
        if times[name] == 2 and len(name) <= LONGEST_NAME and inner[row_of[name]]
    }
    wanted -= {word.lower() for word in rapid_table().words}
    wanted -= _words(text, _omitted_spans(written, every, _masks(every, wanted)))
    masks = iter(_masks(every, wanted))
    found: list[SkippedSpan] = []
    begin = 0
    for run in declarations:
        stop = begin + len(run.names)
        found += _cut(run, next(masks), columns[begin:stop])
        begin = stop
    for run, row in zip(by_name, rows, strict=True):
        found += _cut(run, next(masks), columns[row], places[row])
    return found if len(wanted) * 2 > len(found) * _LEAST_STRETCH else []


def _inner_names(by_name: Sequence[_BulkBlock], rows: Sequence[Offsets]) -> Iterator[str]:
    """Targets of moves by name whose neighbours also have their targets in runs."""
    for run, row in zip(by_name, rows, strict=True):
        yield from compress(run.names, _inner(row >= 0).tolist())


def _masks(runs: Sequence[_BulkBlock], wanted: Set[str]) -> list[Mask]:
    """Lines of each run whose name is wanted."""
    return [np.array([name in wanted for name in run.names]) for run in runs]


def _omitted_spans(
    written: Sequence[SkippedSpan], runs: Sequence[_BulkBlock], masks: Sequence[Mask]
) -> list[tuple[int, int]]:
    """Offsets of the parts of a text that would not be parsed, in order."""
    places = [(int(one.lines[0]), int(one.lines[-1])) for one in written]
    for run, mask in zip(runs, masks, strict=True):
        edges = np.flatnonzero(np.diff(mask, prepend=False, append=False))
        offsets = run.lines[edges].tolist()
        places += zip(offsets[::2], offsets[1::2], strict=True)
    return sorted(places)


def _words(text: str, left_out: Sequence[tuple[int, int]]) -> set[str]:
    """Folded words of the rest of a text, including strings and comments."""
    found: set[str] = set()
    for (_, begin), (end, _) in pairwise([(0, 0), *left_out, (len(text), len(text))]):
        found.update(_WORD.findall(text, begin, end))
    return {word.lower() for word in found}
