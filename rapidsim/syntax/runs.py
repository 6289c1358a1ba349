"""Runs of lines in a text that are alike but for the numbers of their target, found by exact text.

What other programs export has thousands of them. A run is matched as a whole by one regular
expression and read into columns, without an object a line. What does not match to the letter is
left to the parser: another blank, a comment, a statement on two lines, a number that is none. So is
a line whose numbers could be worth a word of a check, with the lines beside it.

Of each run the first two lines and the last one stay in the text that is parsed. Whatever can be
said of a line because of what it is, or of what stands beside it, can be said of these.
"""

from __future__ import annotations

import re
import warnings
from collections.abc import Iterator
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from rapidsim.values import dataclass

if TYPE_CHECKING:
    from rapidsim.syntax.tree.runs import Numbers, Offsets

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

# Possessive: what has matched is never taken back, so a line that fails at its end fails once.
_NUMBER = r" *+-?+(?:[0-9]++(?:\.[0-9]*+)?+|\.[0-9]++)(?:[eE][+-]?+[0-9]++)?+ *+"
_PARTS = ",".join(rf" *+\[{','.join([_NUMBER] * count)}\] *+" for count in TARGET_SHAPE)
_TARGET = rf"\[{_PARTS}\] *+"
# No string, no comment, no call of a function: nothing that another line may read differently.
_REST = r",[^\n;!\"(]*+;[ \t]*+\r?\n"
_LINE = re.compile(rf"^([ \t]*+Move[JL][ \t]++){_TARGET}({_REST})", re.MULTILINE | re.IGNORECASE)
_TO_BLANKS = bytes.maketrans(b"[],", b"   ")


@dataclass(frozen=True, slots=True, eq=False)
class Stretch:
    """Lines of a run that are not parsed."""

    like: int
    """Offset of the line before them, which is."""
    lines: Offsets
    """Offset of each line, and of the one behind them, which is parsed again: shape (rows + 1,)."""
    numbers: Numbers
    """Of each target, as `num`: shape (rows, 17)."""


def stretches(text: str) -> Iterator[Stretch]:
    """All runs of a text, in order."""
    position = 0
    while (first := _LINE.search(text, position)) is not None:
        head, rest = first.groups()
        found = _run(head, rest).match(text, first.start())
        assert found is not None, "its first line matches"
        position = found.end()
        if text.count("\n", found.start(), position) >= LEAST_LINES:
            yield from _read(text, found.start(), position, head, rest)


@lru_cache(64)
def _run(head: str, rest: str) -> re.Pattern[str]:
    return re.compile(rf"(?:{re.escape(head)}{_TARGET}{re.escape(rest)})++")


def _read(text: str, begin: int, end: int, head: str, rest: str) -> Iterator[Stretch]:
    """The stretches of a run that has been matched."""
    if not (head + rest).isascii():
        return
    lines, numbers = [], []
    while begin < end:
        stop = end if end - begin <= _BLOCK else text.index("\n", begin + _BLOCK) + 1
        block = text[begin:stop].encode("ascii")
        of_block = np.flatnonzero(np.frombuffer(block, np.uint8) == ord("\n")) + begin + 1
        values = _numbers(block, head.encode("ascii"), rest.encode("ascii"))
        if values.shape != (len(of_block), _WIDTH):
            return
        lines.append(np.concatenate([[begin], of_block[:-1]]))
        numbers.append(values)
        begin = stop
    starts, columns = np.append(np.concatenate(lines), end), np.concatenate(numbers)
    # Lines that are plain in a row: where they begin, and one past their ends.
    plain = np.concatenate([[False], _is_plain(columns), [False]])
    edges = np.flatnonzero(plain[1:] != plain[:-1]).tolist()
    for first, stop in zip(edges[::2], edges[1::2], strict=True):
        if stop - first >= LEAST_LINES:
            yield Stretch(
                int(starts[first + 1]),
                starts[first + 2 : stop],
                columns[first + 2 : stop - 1].astype(np.float32),
            )


def _numbers(block: bytes, head: bytes, rest: bytes) -> Numbers:
    """The numbers of whole lines, shape (lines, 17); another shape where that went wrong."""
    digits = block.replace(rest, b"\n").replace(head, b"").translate(_TO_BLANKS)
    with warnings.catch_warnings():
        # It warns of text that it does not understand, and reads no further.
        warnings.simplefilter("ignore", DeprecationWarning)
        read = np.fromstring(digits, dtype=np.float64, sep=" ")
    return read.reshape(-1, _WIDTH) if len(read) % _WIDTH == 0 else read


def _is_plain(numbers: Numbers) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
    """The lines of whose numbers, as they are written, no check has anything to say."""
    size = np.abs(numbers)
    single = ((size <= _LARGEST) & ((size >= _SMALLEST) | (size == 0.0))).all(axis=1)
    away = np.sqrt((numbers[:, :3] ** 2).sum(axis=1)) >= _NEAREST_MM
    length = np.sqrt((numbers[:, 3:7] ** 2).sum(axis=1))
    plain: np.ndarray[tuple[int], np.dtype[np.bool_]] = (
        single & away & (np.abs(length - 1.0) <= _ORIENTATION_ERROR)
    )
    return plain
