"""Lines that the robot has made, with their executed state as columns."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from operator import attrgetter

import numpy as np
import numpy.typing as npt

from rapidsim.controller.journal.journal import Instant
from rapidsim.controller.moves.executed_move import CornerKind
from rapidsim.controller.moves.line_rows import LineRow, LineRows
from rapidsim.controller.moves.queued_move import QueuedMove
from rapidsim.frames.transform import Array
from rapidsim.language.moves import Move, Place
from rapidsim.row_sequence import RowSequence
from rapidsim.values import value_class

_FEWEST = 8
"""Fewer lines are not worth their arrays."""
_KINDS = tuple(CornerKind)
_Small = npt.NDArray[np.int16]


@value_class(frozen=True, slots=True, eq=False)
class SettledLines(RowSequence[QueuedMove]):
    """Successive lines (k,); each move is created when it is needed."""

    rows: LineRows
    begin: int
    """Row of the first line."""
    number: int
    """Number of its move among all that the robot ever got."""
    level: int
    started_s: Array
    """Shape (k,), as the following; see `QueuedMove`."""
    ended_s: Array
    start_place_m: Array
    end_place_m: Array
    length_m: Array
    zone_m: Array
    corner: _Small
    """Shape (k,): index of the type of corner."""
    reason: _Small
    """Shape (k,): index of the reason of a corner."""
    reasons: tuple[str, ...]

    def __len__(self) -> int:
        """Return the number of lines."""
        return len(self.corner)

    def _element(self, row: int) -> QueuedMove:
        rows, line = self.rows, self.begin + row
        segment = rows.segment(line)
        return QueuedMove(
            LineRow(rows, line, segment),
            segment,
            Instant(float(self.started_s[row])),
            _KINDS[self.corner[row]],
            segment.end.base_from_tcp,
            segment.tcp_from_flange,
            rows.grip_load_kg,
            number=self.number + row,
            level=self.level,
            corner_reason=self.reasons[self.reason[row]],
            zone_m=float(self.zone_m[row]),
            start_place_m=float(self.start_place_m[row]),
            end_place_m=float(self.end_place_m[row]),
            length_m=float(self.length_m[row]),
            ended_s=float(self.ended_s[row]),
        )

    @property
    def is_timed(self) -> bool:
        """Whether the program gives their times."""
        return self.rows.like.duration_s is not None

    def move(self, at: int) -> Move:
        """Return the move of a line as programmed."""
        return self.rows.move(self.begin + at)

    def place(self, at: int) -> Place:
        """Return the place of its statement."""
        return self.rows.place(self.begin + at)

    def numbers(self) -> Array:
        """Return the numbers (k,) of the moves."""
        return self.number + np.arange(len(self), dtype=np.float64)

    def starts(self) -> Array:
        """Return the offsets (k,) of their statements."""
        first = self.rows.first + self.begin
        starts: Array = self.rows.targets.starts[first : first + len(self)].astype(np.float64)
        return starts

    def corners(self) -> tuple[CornerKind, ...]:
        """Return the types of their ends."""
        return tuple(_KINDS[number] for number in self.corner.tolist())

    def joints(self) -> Array:
        """Return the joints (k, n) [rad] at their ends."""
        return self.rows.joints[self.begin : self.begin + len(self)]

    def end_m(self) -> Array:
        """Return the positions (k, 3) of the TCP at their programmed ends."""
        return self.rows.ends.translation[self.begin : self.begin + len(self)]


def settled(moves: Sequence[QueuedMove]) -> Iterator[Sequence[QueuedMove]]:
    """Divide moves into lines of the same rows, as columns, and others as they are."""
    others: list[QueuedMove] = []
    for begin, end in _spans(moves):
        if end - begin < _FEWEST:
            others.extend(moves[begin:end])
            continue
        if others:
            yield others
            others = []
        yield _columns(moves[begin:end])
    if others:
        yield others


def _spans(moves: Sequence[QueuedMove]) -> Iterator[tuple[int, int]]:
    """Yield begin and end of lines of the same rows in succession; single moves between them."""
    begin = 0
    for end in range(1, len(moves) + 1):
        if end == len(moves) or not _follows(moves[end - 1], moves[end]):
            yield begin, end
            begin = end


def _follows(before: QueuedMove, after: QueuedMove) -> bool:
    one, other = before.row, after.row
    if one is None or other is None or one.rows is not other.rows or other.at != one.at + 1:
        return False
    return _is_as_resolved(before) and _is_as_resolved(after)


def _is_as_resolved(queued: QueuedMove) -> bool:
    """Whether the row and the columns describe a move that is over."""
    return (
        queued.row is not None
        and queued.started.time is not None
        and queued.ended_s is not None
        and queued.command_start_s is None
        and not queued.was_stopped
    )


def _columns(moves: Sequence[QueuedMove]) -> SettledLines:
    first, row = moves[0], moves[0].row
    assert row is not None
    numbers: dict[str, int] = {}

    def column(name: str) -> Array:
        return np.array(list(map(attrgetter(name), moves)), dtype=np.float64)

    return SettledLines(
        row.rows,
        row.at,
        first.number,
        first.level,
        column("started.time"),
        column("ended_s"),
        column("start_place_m"),
        column("end_place_m"),
        column("length_m"),
        column("zone_m"),
        np.array([_KINDS.index(one.corner) for one in moves], dtype=np.int16),
        np.array(
            [numbers.setdefault(one.corner_reason, len(numbers)) for one in moves], dtype=np.int16
        ),
        tuple(numbers),
    )
