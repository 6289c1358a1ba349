"""Bulk statements: runs of lines that differ only in the target, found by exact text.

Programs exported by other software have thousands of them: moves with the numbers of their target,
or declarations of targets and moves to them by name. A run is matched as a whole by one regular
expression and read into columns, without an object per line. Lines that do not match exactly are
left to the parser: another blank, a comment, a statement on two lines, an invalid number. The same
applies to a line whose numbers the caller wants to be parsed, and to a name that occurs anywhere
except in its declaration and in one move.

Between moves with their targets there may be calls that are repeated to the letter, such as those
of an output.

Of each run the first two lines and the last one are parsed as well, and so are the neighbours of
parsed lines. Where a call is among a line and its neighbours, such a sequence is parsed the first
two times that it occurs. Findings that depend on the kind of a line or on its neighbours therefore
occur at parsed lines.
"""

from __future__ import annotations

import re
import warnings
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from itertools import pairwise, repeat
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
_PARSED = 2
"""Number of times that a sequence of lines with a call in it is parsed."""
_MOST_CALLS = 16
"""Number of texts of calls between the lines of a run, the most frequent ones, that are skipped."""
_MOST_SEQUENCES = 64
"""Number of sequences of lines with a call in them, the most frequent ones, that are skipped."""
_MOST_SHIFTED = 8
"""Number of lines by which each end of an interval with calls is searched for a suitable one."""
_LEAST_STRETCH = 8
"""Minimum average number of lines of the intervals with names, below which they do not pay."""

# Possessive: a match is final, so a line that fails at its end fails once.
_NUMBER = r" *+-?+(?:[0-9]++(?:\.[0-9]*+)?+|\.[0-9]++)(?:[eE][+-]?+[0-9]++)?+ *+"
_PARTS = ",".join(rf" *+\[{','.join([_NUMBER] * count)}\] *+" for count in TARGET_SHAPE)
_TARGET = rf"\[{_PARTS}\] *+"
_NAME = r"[A-Za-z][A-Za-z0-9_]*+"
# No string, comment or function call: nothing that depends on another line.
_REST = r",[^\n;!\"(]*+;[ \t]*+\r?\n"
_CALL = re.compile(rf"[ \t]*+({_NAME})[ \t][^\n;!\"([:]*+;[ \t]*+\r?\n")
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
    begin: int
    """Offset of the first line."""
    end: int
    """Offset of the parsed line after them."""
    starts: Offsets
    """Offset of each line but for the calls between: shape (rows,)."""
    ends: Offsets
    """Offset behind each of these lines: shape (rows,)."""
    numbers: Numbers
    """Numbers of each target, as `num`: shape (rows, 17)."""
    numbers_of_like: Numbers
    """Numbers of the target of the line before them: shape (17,)."""
    names: tuple[str, ...] = ()
    """Folded names that the lines declare."""
    declared: Offsets | None = None
    """Offset of the declaration of each target; None if the targets are written out."""
    calls: tuple[SkippedCalls, ...] = ()
    """The calls between these lines."""


@value_class(frozen=True, slots=True, eq=False)
class SkippedCalls:
    """Lines between those of a span that repeat a parsed line to the letter."""

    like: int
    """Offset of the parsed line."""
    move: int
    """Offset of the last line of the run before it."""
    starts: Offsets
    """Offset of each repetition."""
    rows: Offsets
    """Number of lines of the span before each, without such calls."""


@value_class(frozen=True, slots=True, eq=False)
class _BulkBlock:
    """A complete run: of moves with their targets, of declarations, or of moves by name."""

    starts: Offsets
    """Offset of each line: shape (lines,)."""
    ends: Offsets
    """Offset behind each line."""
    numbers: Numbers | None
    """Numbers of each line that is no call between, as `num`: shape (rows, 17); None for moves by
    name."""
    plain: Mask
    """Which of these lines are of no interest by themselves: shape (rows,); all moves by name."""
    names: Sequence[str]
    """Folded names; empty if targets are written out."""
    calls: Offsets
    """0 for the lines of the run; the lines between have a number for each text: shape (lines,)."""


def skipped_spans(text: str, how: BulkReading) -> tuple[SkippedSpan, ...]:
    """Return the skipped spans of a text, in order."""
    written: list[SkippedSpan] = []
    declarations: list[_BulkBlock] = []
    by_name: list[_BulkBlock] = []
    for one in _runs(text, how):
        if not one.names:
            assert one.numbers is not None
            plain = one.calls > 0
            plain[~plain] = one.plain
            mask, by = _represented(one.calls, plain)
            written += _cut(one, mask, one.numbers, by=by)
        else:
            (by_name if one.numbers is None else declarations).append(one)
    may_join = declarations and by_name and not how.keeps_data
    named = _joined(text, written, declarations, by_name) if may_join else []
    return tuple(sorted([*written, *named], key=lambda one: one.like))


def _runs(text: str, how: BulkReading) -> Iterator[_BulkBlock]:
    position = 0
    while (first := _LINE.search(text, position)) is not None:
        head, name, rest, head_of_data, becomes, rest_of_data = first.groups()
        words: tuple[str, ...] = (head, rest)
        varying, are_plain = (_TARGET, how.of_targets) if name is None else (_NAME, None)
        if head is None:
            words, are_plain = (head_of_data, becomes, rest_of_data), how.of_declared
            varying = f"{_NAME}{re.escape(becomes)}{_TARGET}"
        pattern = _pattern(words[0], varying, words[-1])
        found = pattern.match(text, first.start())
        assert found is not None, "its first line matches"
        parts, calls = [found.span()], list[re.Match[str]]()
        if head is not None and name is None:
            _continue(text, pattern, how, parts, calls)
        position = parts[-1][1]
        long = text.count("\n", first.start(), position) >= LEAST_LINES
        if long and "".join(words).isascii():
            run = _read_parts(text, parts, words, are_plain)
            if run is not None:
                yield _with_calls(run, calls) if calls else run


def _continue(
    text: str,
    pattern: re.Pattern[str],
    how: BulkReading,
    parts: list[tuple[int, int]],
    calls: list[re.Match[str]],
) -> None:
    """Add the parts of a run behind its first, and the calls between them."""
    position = parts[-1][1]
    between: list[re.Match[str]] = []
    while (call := _CALL.match(text, position)) is not None and how.of_calls(call[1]):
        between.append(call)
        position = call.end()
        if (found := pattern.match(text, position)) is not None:
            parts.append(found.span())
            calls += between
            between = []
            position = found.end()


@lru_cache(64)
def _pattern(head: str, varying: str, rest: str) -> re.Pattern[str]:
    return re.compile(rf"(?:{re.escape(head)}{varying}{re.escape(rest)})++")


def _read_parts(
    text: str,
    parts: Sequence[tuple[int, int]],
    words: tuple[str, ...],
    are_plain: Callable[[Numbers], Mask] | None,
) -> _BulkBlock | None:
    """Read the columns of the matched parts of a run."""
    if len(parts) == 1:
        return _read(text, *parts[0], words, are_plain)
    joined = "".join(text[begin:end] for begin, end in parts)
    run = _read(joined, 0, len(joined), words, are_plain)
    if run is None:
        return None
    begins, stops = np.array(parts).T
    lengths = stops - begins
    before = np.cumsum(lengths) - lengths
    moved = (begins - before)[before.searchsorted(run.starts, "right") - 1]
    return replace(run, starts=run.starts + moved, ends=run.ends + moved)


def _with_calls(run: _BulkBlock, calls: Sequence[re.Match[str]]) -> _BulkBlock:
    """Add the calls between its lines to a run."""
    by_frequency = Counter(call[0] for call in calls).most_common()
    number_of = {text: number for number, (text, _) in enumerate(by_frequency, 1)}
    numbers = [number_of[call[0]] for call in calls]
    starts = np.append(run.starts, [call.start() for call in calls])
    order = starts.argsort()
    return replace(
        run,
        starts=starts[order],
        ends=np.append(run.ends, [call.end() for call in calls])[order],
        calls=np.append(run.calls, numbers)[order],
    )


def _read(
    text: str,
    begin: int,
    end: int,
    words: tuple[str, ...],
    are_plain: Callable[[Numbers], Mask] | None,
) -> _BulkBlock | None:
    """Read the columns of a matched part of a run; moves by name have no numbers to judge."""
    head, *becomes, rest = words
    lines, numbers, plain = [], [], []
    names: list[str] = []
    while begin < end:
        stop = end if end - begin <= _BLOCK else text.index("\n", begin + _BLOCK) + 1
        block = text[begin:stop]
        of_block = np.frombuffer(block.encode("ascii"), np.uint8)
        behind = np.flatnonzero(of_block == ord("\n")) + begin + 1
        lines.append(np.concatenate([[begin], behind[:-1]]))
        varying = block.replace(rest, "\n").replace(head, "")
        if becomes:
            parts = varying.replace(f"{becomes[0]}[", "\n[").split("\n")
            names += [name.lower() for name in parts[:-1:2]]
            varying = "\n".join(parts[1::2])
        if are_plain is None:
            names += varying.lower().split()
        else:
            values = _numbers(varying)
            if values.shape != (len(behind), TARGET_WIDTH):
                return None
            plain.append(are_plain(values))
            with np.errstate(over="ignore"):
                numbers.append(values.astype(np.float32))
        begin = stop
    starts = np.append(np.concatenate(lines), end)
    count = len(starts) - 1
    if (are_plain is None or becomes) and len(names) != count:
        return None
    table = np.concatenate(numbers) if numbers else None
    mask = np.concatenate(plain) if plain else np.ones(count, dtype=bool)
    no_calls = np.zeros(count, dtype=np.int64)
    return _BulkBlock(starts[:-1], starts[1:], table, mask, names, no_calls)


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


def _represented(calls: Offsets, plain: Mask) -> tuple[Mask, Offsets]:
    """Return which lines are represented by others, and by which the calls among them are.

    A line with a call among its two predecessors, itself and its successor is represented by the
    second occurrence of the same sequence; lines of a run without calls by the first few.
    """
    mask = _inner(plain)
    by = np.full(len(calls), -1)
    near = np.flatnonzero(calls)
    if not len(near):
        return mask, by
    near = np.unique((near[:, None] + np.arange(-1, 3)).ravel())
    near = near[(near >= 2) & (near < len(calls) - 1)]
    around = near[:, None] + np.arange(-2, 2)
    may_be = mask[near] & (calls[around] <= _MOST_CALLS).all(axis=1)
    mask[near] = False
    near, around = near[may_be], around[may_be]
    _, kind, counts = np.unique(calls[around], axis=0, return_inverse=True, return_counts=True)
    kind = kind.reshape(-1)
    by_kind = kind.argsort(kind="stable")
    firsts = np.cumsum(counts) - counts
    occurrence = np.empty(len(near), dtype=np.int64)
    occurrence[by_kind] = np.arange(len(near)) - np.repeat(firsts, counts)
    is_frequent = np.zeros(len(counts), dtype=bool)
    is_frequent[(-counts).argsort(kind="stable")[:_MOST_SEQUENCES]] = True
    mask[near] = (occurrence >= _PARSED) & is_frequent[kind]
    twice = counts >= _PARSED
    second = np.zeros(len(counts), dtype=np.int64)
    second[twice] = near[by_kind[firsts[twice] + _PARSED - 1]]
    by[near] = second[kind]
    return mask, by


def _cut(
    run: _BulkBlock,
    left_out: Mask,
    numbers: Numbers,
    declared: Offsets | None = None,
    by: Offsets | None = None,
) -> Iterator[SkippedSpan]:
    """Yield the intervals of consecutive lines of a run that are skipped.

    Args:
        run: The run.
        left_out: Mask of its skipped lines.
        numbers: Numbers of the target of each line that is no call between, as `num`: shape
            (rows, 17).
        declared: Offset of the declaration of each target.
        by: Line that represents each call between; None if there are no calls.
    """
    edges = np.flatnonzero(np.diff(left_out, prepend=False, append=False)).tolist()
    has_values = run.numbers is not None
    is_call = run.calls > 0
    row_of = np.cumsum(~is_call) - 1
    for begin, end in zip(edges[::2], edges[1::2], strict=True):
        first, stop = (begin, end) if by is None else _joint(run.calls, begin, end)
        if declared is None and not run.names and stop - first < LEAST_LINES - 3:
            continue
        like = int(row_of[first - 1])
        rows = slice(like + 1, int(row_of[stop - 1]) + 1)
        is_row = ~is_call[first:stop]
        lines = np.flatnonzero(is_row) + first
        calls = np.flatnonzero(~is_row) + first
        yield SkippedSpan(
            int(run.starts[first - 1]),
            int(run.starts[first]),
            int(run.ends[stop - 1]),
            run.starts[lines],
            run.ends[lines],
            numbers[rows],
            numbers[like],
            tuple(run.names[rows]) if has_values else (),
            None if declared is None else declared[rows],
            () if by is None else tuple(_skipped_calls(run, calls, row_of[calls] - like, by)),
        )


def _joint(calls: Offsets, begin: int, end: int) -> tuple[int, int]:
    """Return which lines of an interval to skip, so that those around look as if they followed.

    There is no call at either end, and what precedes the first line is what precedes the end: so
    each parsed line has the neighbours that it has, or that a skipped one has.
    """
    for first in range(begin, min(begin + _MOST_SHIFTED, end)):
        if calls[first - 1] or calls[first]:
            continue
        for stop in range(end, max(end - _MOST_SHIFTED, first + 1), -1):
            if not (calls[stop - 1] or calls[stop]) and calls[stop - 2] == calls[first - 2]:
                return first, stop
    return begin, begin


def _skipped_calls(
    run: _BulkBlock, lines: Offsets, rows: Offsets, by: Offsets
) -> Iterator[SkippedCalls]:
    """Yield the calls on skipped lines of a run by what represents them.

    Args:
        run: The run.
        lines: Numbers of the lines.
        rows: Number of rows before each.
        by: Line that represents each line of the run.
    """
    for like in np.unique(by[lines]).tolist():
        here = by[lines] == like
        move = int(np.flatnonzero(run.calls[:like] == 0)[-1])
        yield SkippedCalls(
            int(run.starts[like]), int(run.starts[move]), run.starts[lines[here]], rows[here]
        )


def _joined(
    text: str,
    written: Sequence[SkippedSpan],
    declarations: Sequence[_BulkBlock],
    by_name: Sequence[_BulkBlock],
) -> list[SkippedSpan]:
    """Return the spans of declarations and of moves by their names; empty if they are few.

    A skipped name is skipped in both, and occurs nowhere else.
    """
    tables = [run.numbers for run in declarations if run.numbers is not None]
    columns = np.concatenate(tables)
    places = np.concatenate([run.starts for run in declarations])
    inner = np.concatenate([_inner(run.plain) for run in declarations])
    row_of = {
        name: row for row, name in enumerate(name for run in declarations for name in run.names)
    }
    # For each move by name the row of its declaration; -1 without one in a run.
    rows = [np.array([row_of.get(name, -1) for name in run.names]) for run in by_name]
    wanted = inner & _used_once(declarations, rows, row_of)
    _remove(wanted, row_of, (name for name in row_of if len(name) > LONGEST_NAME))
    _remove(wanted, row_of, (word.lower() for word in rapid_table().words))
    ends = np.cumsum([len(run.names) for run in declarations])[:-1]
    runs = [*declarations, *by_name]
    left_out = _omitted_spans(written, runs, _of_lines(wanted, ends, rows))
    _remove(wanted, row_of, _words(text, left_out))
    numbers = [*np.split(columns, ends), *(_rows(columns, row) for row in rows)]
    declared = [*repeat(None, len(declarations)), *(places[row] for row in rows)]
    of_runs = zip(runs, _of_lines(wanted, ends, rows), numbers, declared, strict=True)
    found = [span for run, *of_run in of_runs for span in _cut(run, *of_run)]
    return found if int(wanted.sum()) * 2 > len(found) * _LEAST_STRETCH else []


def _used_once(
    declarations: Sequence[_BulkBlock], rows: Sequence[Offsets], row_of: Mapping[str, int]
) -> Mask:
    """Mask of the declared names that one move of the runs uses, between others of these.

    Args:
        declarations: The runs that declare names.
        rows: For each run of moves by name the rows of these; -1 where no run declares the name.
        row_of: Row of each name.
    """
    count = sum(len(run.names) for run in declarations)
    uses = np.concatenate(rows)
    once: Mask = np.bincount(uses[uses >= 0], minlength=count) == 1
    if len(row_of) < count:
        declared = [row_of[name] for run in declarations for name in run.names]
        once &= np.bincount(declared, minlength=count) == 1
    between = np.zeros(count, dtype=bool)
    for row in rows:
        between[row[_inner(row >= 0)]] = True
    return once & between


def _rows(columns: Numbers, rows: Offsets) -> Numbers:
    """Return the numbers (k, 17) of some rows, without a copy of consecutive ones."""
    is_consecutive = len(rows) > 0 and rows[0] >= 0 and bool((np.diff(rows) == 1).all())
    return columns[rows[0] : rows[-1] + 1] if is_consecutive else columns[rows]


def _of_lines(wanted: Mask, ends: Offsets, rows: Sequence[Offsets]) -> list[Mask]:
    """Return which lines of each run have a wanted name, by the rows of the names."""
    return [*np.split(wanted, ends), *((row >= 0) & wanted[row] for row in rows)]


def _remove(wanted: Mask, row_of: Mapping[str, int], names: Iterable[str]) -> None:
    """Unset the rows of some names."""
    for name in names:
        if (row := row_of.get(name)) is not None:
            wanted[row] = False


def _omitted_spans(
    written: Sequence[SkippedSpan], runs: Sequence[_BulkBlock], masks: Sequence[Mask]
) -> list[tuple[int, int]]:
    """Offsets of the parts of a text that would not be parsed, in order."""
    places = [(one.begin, one.end) for one in written]
    for run, mask in zip(runs, masks, strict=True):
        edges = np.flatnonzero(np.diff(mask, prepend=False, append=False))
        begins, ends = run.starts[edges[::2]], run.ends[edges[1::2] - 1]
        places += zip(begins.tolist(), ends.tolist(), strict=True)
    return sorted(places)


def _words(text: str, left_out: Sequence[tuple[int, int]]) -> set[str]:
    """Folded words of the rest of a text, including strings and comments."""
    found: set[str] = set()
    for (_, begin), (end, _) in pairwise([(0, 0), *left_out, (len(text), len(text))]):
        found.update(_WORD.findall(text, begin, end))
    return {word.lower() for word in found}
