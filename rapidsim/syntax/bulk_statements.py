"""Runs of lines in a text that are alike but for the target, found by exact text.

What other programs export has thousands of them: moves with the numbers of their target, or
declarations of targets and moves to them by name. A run is matched as a whole by one regular
expression and read into columns, without an object a line. What does not match to the letter is
left to the parser: another blank, a comment, a statement on two lines, a number that is none. So is
a line whose numbers could be worth a word of a check, and a name that is anywhere but in its
declaration and in one move.

Of each run the first two lines and the last one stay in the text that is parsed, and so do those
beside others that stay. Whatever can be said of a line because of what it is, or of what stands
beside it, can be said of these.
"""

from __future__ import annotations

import re
import warnings
from collections import Counter
from collections.abc import Iterator, Sequence, Set
from functools import lru_cache
from itertools import compress, pairwise
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from rapidsim.syntax.limits import LONGEST_NAME
from rapidsim.syntax.stored_table import rapid_table
from rapidsim.values import value_class

if TYPE_CHECKING:
    from rapidsim.syntax.tree.bulk_statements import Numbers, Offsets

    Mask: TypeAlias = np.ndarray[Any, np.dtype[np.bool_]]

LEAST_LINES = 12
"""Lines of a run; shorter ones are parsed."""
TARGET_SHAPE = (3, 4, 4, 6)
"""Numbers of the parts of a target: place, orientation, configuration, external axes."""
_WIDTH = sum(TARGET_SHAPE)
_BLOCK = 4_000_000
"""Characters that are read into columns at once."""
_LARGEST = 3.4e38
_SMALLEST = 1e-30
_ORIENTATION_ERROR = 0.9e-4
"""A little less than any check tolerates."""
_NEAREST_MM = 10.1
"""Targets nearer to the origin may have been written in metres."""
_QUARTERS, _BRANCHES = 12, 7
"""What the configuration of a declared target may be."""
_LEAST_STRETCH = 8
"""Lines that stretches of names must have on average to be worth it."""

# Possessive: what has matched is never taken back, so a line that fails at its end fails once.
_NUMBER = r" *+-?+(?:[0-9]++(?:\.[0-9]*+)?+|\.[0-9]++)(?:[eE][+-]?+[0-9]++)?+ *+"
_PARTS = ",".join(rf" *+\[{','.join([_NUMBER] * count)}\] *+" for count in TARGET_SHAPE)
_TARGET = rf"\[{_PARTS}\] *+"
_NAME = r"[A-Za-z][A-Za-z0-9_]*+"
# No string, no comment, no call of a function: nothing that another line may read differently.
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
    """Lines of a run that are not parsed."""

    like: int
    """Offset of the line before them, which is."""
    lines: Offsets
    """Offset of each line, and of the one behind them, which is parsed again: shape (rows + 1,)."""
    numbers: Numbers
    """Of each target, as `num`: shape (rows, 17)."""
    numbers_of_like: Numbers
    """Of the target of the line before them: shape (17,)."""
    names: tuple[str, ...] = ()
    """Folded names that they declare."""
    declared: Offsets | None = None
    """Offset of the line that declares each target; None where they are written out."""


@value_class(frozen=True, slots=True, eq=False)
class _BulkBlock:
    """A whole run: of moves with their targets, of declarations, or of moves by name."""

    lines: Offsets
    """As of a stretch, of all its lines."""
    numbers: Numbers | None
    """As they are written; None of moves by name."""
    names: Sequence[str]
    """Folded; none where targets are written out."""


def skipped_spans(text: str, *, keeps_data: bool = False) -> tuple[SkippedSpan, ...]:
    """The runs of a text, in order; with `keeps_data` only those that declare and name nothing."""
    written: list[SkippedSpan] = []
    declarations: list[_BulkBlock] = []
    by_name: list[_BulkBlock] = []
    for one in _runs(text):
        if not one.names:
            assert one.numbers is not None
            written += _cut(one, _inner(_is_plain(one.numbers)), one.numbers)
        else:
            (by_name if one.numbers is None else declarations).append(one)
    may_join = declarations and by_name and not keeps_data
    named = _joined(text, written, declarations, by_name) if may_join else []
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
    """The columns of a run that has been matched."""
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
            if values.shape != (len(behind), _WIDTH):
                return None
            numbers.append(values)
        begin = stop
    starts = np.append(np.concatenate(lines), end)
    if (is_by_name or becomes) and len(names) != len(starts) - 1:
        return None
    return _BulkBlock(starts, np.concatenate(numbers) if numbers else None, names)


def _numbers(targets: str) -> Numbers:
    """The numbers of targets, shape (targets, 17); another shape where that went wrong."""
    digits = targets.encode("ascii").translate(_TO_BLANKS)
    with warnings.catch_warnings():
        # It warns of text that it does not understand, and reads no further.
        warnings.simplefilter("ignore", DeprecationWarning)
        read = np.fromstring(digits, dtype=np.float64, sep=" ")
    return read.reshape(-1, _WIDTH) if len(read) % _WIDTH == 0 else read


def _is_plain(numbers: Numbers) -> Mask:
    """The lines whose numbers, as they are written, no check objects to."""
    size = np.abs(numbers)
    single = ((size <= _LARGEST) & ((size >= _SMALLEST) | (size == 0.0))).all(axis=1)
    away = np.sqrt((numbers[:, :3] ** 2).sum(axis=1)) >= _NEAREST_MM
    length = np.sqrt((numbers[:, 3:7] ** 2).sum(axis=1))
    plain: Mask = single & away & (np.abs(length - 1.0) <= _ORIENTATION_ERROR)
    return plain


def _is_plain_data(numbers: Numbers) -> Mask:
    """The same of declared targets, of which a check looks at configuration and external axes."""
    configuration = numbers[:, 7:11]
    plain: Mask = _is_plain(numbers) & (configuration == np.rint(configuration)).all(axis=1)
    plain &= (np.abs(configuration[:, :3]) <= _QUARTERS).all(axis=1)
    plain &= (configuration[:, 3] >= 0.0) & (configuration[:, 3] <= _BRANCHES)
    plain &= (numbers[:, 11:] == numbers[0, 11:]).all(axis=1)
    return plain


def _inner(plain: Mask) -> Mask:
    """The plain lines with two plain ones before and one behind them; the others are parsed."""
    inner = plain.copy()
    inner[:2] = inner[-1:] = False
    inner[1:] &= plain[:-1]
    inner[2:] &= plain[:-2]
    inner[:-1] &= plain[1:]
    return inner


def _cut(
    run: _BulkBlock, left_out: Mask, numbers: Numbers, declared: Offsets | None = None
) -> Iterator[SkippedSpan]:
    """The stretches of lines in a row that are left out of a run.

    Args:
        run: The run.
        left_out: Which of its lines.
        numbers: Of the target of each line, shape (lines, 17).
        declared: Offset of the line that declares it.
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
) -> list[SkippedSpan]:
    """The stretches of declarations and of the moves by their names; none where few are left out.

    A name is left out in both, and stands nowhere else.
    """
    tables = [run.numbers for run in declarations if run.numbers is not None]
    columns = np.concatenate(tables)
    places = np.concatenate([run.lines[:-1] for run in declarations])
    inner = np.concatenate([_inner(_is_plain_data(table)) for table in tables])
    names = [name for run in declarations for name in run.names]
    row_of = {name: row for row, name in enumerate(names)}
    # Of each move by name the declaration of its target; -1 where that is in no run.
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
    """The parts of a text that would not be parsed, in order."""
    places = [(int(one.lines[0]), int(one.lines[-1])) for one in written]
    for run, mask in zip(runs, masks, strict=True):
        edges = np.flatnonzero(np.diff(mask, prepend=False, append=False))
        offsets = run.lines[edges].tolist()
        places += zip(offsets[::2], offsets[1::2], strict=True)
    return sorted(places)


def _words(text: str, left_out: Sequence[tuple[int, int]]) -> set[str]:
    """The folded words of what is left of a text, those of strings and comments among them."""
    found: set[str] = set()
    for (_, begin), (end, _) in pairwise([(0, 0), *left_out, (len(text), len(text))]):
        found.update(_WORD.findall(text, begin, end))
    return {word.lower() for word in found}
