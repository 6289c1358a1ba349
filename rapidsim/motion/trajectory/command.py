"""Command of a robot over a whole run: pieces of timed paths, with rest in between.

All pieces joined end to end have one parameter, the position S [m] of the whole run. Pieces are
counted from 1. Integrals over time are split into intervals of about a second, so that they keep
their precision: a long piece has several, in rows of one table; row 0 is the rest before all.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial

import numpy as np
import numpy.typing as npt

from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.segments import Segment
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.motion.path.joined_paths import JoinedPaths, joined_paths
from rapidsim.motion.path.path import Path
from rapidsim.motion.timing.time_scaling import TimeScaling
from rapidsim.motion.trajectory.even_joints import EvenJoints
from rapidsim.motion.trajectory.time_scalings import TimeScalings, timings_of
from rapidsim.values import value_class

Index = npt.NDArray[np.int64]

ROUNDING_M = 1e-11
"""Distance [m] below which positions count as one."""
_PIECES_AT_ONCE = 128
"""Number of pieces whose paths are joined end to end, which bounds the memory."""


@value_class(frozen=True, slots=True, eq=False)
class Piece:
    """A section of a timed path, commanded from an instant on."""

    start_time: float
    """[s]"""
    path: Path
    timing: TimeScaling
    from_s: float
    """Position [m] on the path where the piece starts."""
    to_s: float
    """Position [m] where it ends; the next piece may continue from there on another path."""
    first: int = 0
    """Number, among all moves of the robot, of the first segment of the path."""

    @property
    def numbered(self) -> Iterator[tuple[int, Segment]]:
        """Segments of its path with the numbers of their moves."""
        return enumerate(self.path.segments, self.first)


class MotionCommand:
    """Sequence of pieces that can only be extended, and cut at its end."""

    def __init__(self) -> None:
        """Create an empty command."""
        self._pieces: list[Piece] = []
        self._axis_count = 0
        # Columns: see `_Column`.
        self._table = np.zeros((16, 8))
        self._rows = 1
        self._joined_timings: _JoinedTimings | None = None
        self._joined_paths: _JoinedPaths | None = None
        self._taking: Index | None = None
        """Rows that take time or distance, followed by the number of rows."""
        self._even_joints: EvenJoints | None = None

    def copy(self) -> MotionCommand:
        """Return a copy that can be extended independently."""
        copied = MotionCommand()
        copied._pieces = list(self._pieces)
        copied._table = self._table[: self._rows + 1].copy()
        copied._rows = self._rows
        copied._axis_count = self._axis_count
        return copied

    @property
    def pieces(self) -> tuple[Piece, ...]:
        """Pieces in order of time."""
        return tuple(self._pieces)

    @property
    def last_row(self) -> int:
        """Number of the last row; 0 without pieces."""
        return self._rows - 1

    @property
    def axis_count(self) -> int:
        """Number of joints, external axes and carrier axes; paths that have fewer leave zeros."""
        return self._axis_count

    @property
    def end(self) -> float:
        """End time [s]; 0 without pieces."""
        if not self._pieces:
            return 0.0
        row = self._table[self._rows - 1]
        return float(row[_Column.START] + row[_Column.DURATION])

    @property
    def length(self) -> float:
        """Position S [m] at the end of the last piece."""
        row = self._table[self._rows - 1]
        return float(row[_Column.PLACE] + row[_Column.WAY])

    def append(self, piece: Piece) -> float:
        """Add a piece after the last one; see `Trajectory.append`."""
        offset, end = (piece.timing.time_at(s) for s in (piece.from_s, piece.to_s))
        if piece.start_time < self.end - 1e-9:
            raise ValueError(
                f"a piece starts at {piece.start_time} s, before the last ends at {self.end} s"
            )
        if piece.to_s < piece.from_s:
            raise ValueError(f"a piece runs backwards, from {piece.from_s} m to {piece.to_s} m")
        timing, place = piece.timing, self.length
        start = max(piece.start_time, self.end)
        began = timing.times[timing.marks]
        first = max(int(np.searchsorted(began, offset, side="right")) - 1, 0)
        after = max(int(np.searchsorted(began, end, side="left")), first + 1)
        marks = np.arange(first, after)
        times = np.concatenate([[offset], began[marks[1:]], [end]])
        s = np.concatenate([[piece.from_s], timing.s[timing.marks[marks[1:]]], [piece.to_s]])
        while self._rows + len(marks) > len(self._table):
            self._table = np.concatenate([self._table, np.zeros_like(self._table)])
        self._pieces.append(piece)
        self._axis_count = max(self._axis_count, piece.path.axis_count)
        rows = self._table[self._rows : self._rows + len(marks)]
        rows[:, _Column.START] = start + (times[:-1] - offset)
        rows[:, _Column.DURATION] = np.diff(times)
        rows[:, _Column.PLACE] = place + (s[:-1] - piece.from_s)
        rows[:, _Column.WAY] = np.diff(s)
        rows[:, _Column.OFFSET] = times[:-1]
        rows[:, _Column.FROM_S] = s[:-1]
        rows[:, _Column.PIECE] = len(self._pieces)
        rows[:, _Column.MARK] = marks
        self._rows += len(marks)
        self._taking = self._even_joints = None
        return place

    def cut(self, time_s: float) -> None:
        """Remove the command after a time [s]."""
        self._joined_timings = self._joined_paths = self._taking = self._even_joints = None
        kept = self._rows
        while kept > 1 and self._table[kept - 1, _Column.START] >= time_s:
            kept -= 1
        row = self._table[kept - 1]
        number = int(row[_Column.PIECE])
        begun = kept < self._rows and self._table[kept, _Column.PIECE] == number
        self._rows = kept
        del self._pieces[number:]
        if number == 0 or (self.end <= time_s and not begun):
            return
        piece = self._pieces[-1]
        driven = min(time_s - float(row[_Column.START]), float(row[_Column.DURATION]))
        to_s = min(piece.timing.s_at(float(row[_Column.OFFSET]) + driven), piece.to_s)
        self._pieces[-1] = replace(piece, to_s=to_s)
        row[_Column.DURATION], row[_Column.WAY] = driven, to_s - row[_Column.FROM_S]

    def forget(self, before_s: float) -> None:
        """Discard data that queries for a time [s] or later do not need.

        Remaining results are unchanged to the last bit: cached joined timings and paths are kept.
        """
        under_way = int(self.row_at(np.array([before_s]))[0])
        pieces = max(int(self._table[under_way, _Column.PIECE]) - 1, 0)
        rows = int(np.searchsorted(self._table[: self._rows, _Column.PIECE], pieces, "right")) - 1
        if not pieces:
            return
        kept = self._table[rows + 1 : self._rows]
        self._table = np.concatenate([self._table[:1], kept, np.zeros((16, 8))])
        self._table[1:, _Column.PIECE] -= pieces
        self._rows -= rows
        del self._pieces[:pieces]
        self._taking = None
        timings, paths = self._joined_timings, self._joined_paths
        if timings is not None:
            lowest, highest = timings.lowest - rows, timings.highest - rows
            self._joined_timings = replace(timings, lowest=lowest, highest=highest)
        if paths is not None:
            self._joined_paths = replace(paths, numbers=paths.numbers - pieces)

    def row_at(self, times: Array) -> Index:
        """Return the last row (k,) that began before times (k,) [s]."""
        starts = self._table[1 : self._rows, _Column.START]
        return np.searchsorted(starts, times, side="right").astype(np.int64)

    def piece(self, number: int) -> Piece:
        """Return a piece by its number."""
        return self._pieces[number - 1]

    def pieces_of(self, row: Index) -> Index:
        """Return the numbers of the pieces (k,) that contain rows (k,); 1 for row 0."""
        numbers: Index = np.maximum(self._table[row, _Column.PIECE].astype(np.int64), 1)
        return numbers

    def on_paths(self, row: Index, arc_length: Array) -> Iterator[tuple[Path, Array, Index, Index]]:
        """Yield paths and positions for distances (k,) [m] since the start of rows (k,).

        Before the first piece the arm is at its start.

        Yields:
            A path, positions s on it [m], their indices among the k, and the offset from segment
            indices on it to the numbers of their moves.
        """
        if not len(row):
            return
        row = np.maximum(row, 1)
        numbers = self.pieces_of(row)
        asked = np.unique(numbers)
        s = self._table[row, _Column.FROM_S] + arc_length
        for first in range(0, len(asked), _PIECES_AT_ONCE):
            some = asked[first : first + _PIECES_AT_ONCE]
            here = np.flatnonzero((some[0] <= numbers) & (numbers <= some[-1]))
            joined = self._paths_of(some)
            own = np.searchsorted(joined.numbers, numbers[here])
            on, start = joined.paths.on[own], joined.paths.starts[own]
            number = joined.first[own]
            for each, at in groups(on):
                yield joined.paths.paths[each], s[here[at]] + start[at], here[at], number[at]

    def starts(self, row: Index) -> tuple[Array, Array]:
        """Return the start times of rows (k,) [s], and their positions S [m]."""
        return self._table[row, _Column.START], self._table[row, _Column.PLACE]

    def increases(self, row: Index) -> Array:
        """Return the increase of S in rows (k,) [m]."""
        ways: Array = self._table[row, _Column.WAY]
        return ways

    def is_stationary(self, row: Index, times: Array) -> Mask:
        """Whether rows (k,) have ended, or have not begun, at times (k,) [s]."""
        start, duration = self._table[row, _Column.START], self._table[row, _Column.DURATION]
        over: Mask = (times - start >= duration) | (row == 0)
        return over

    def state(self, row: Index, times: Array) -> Array:
        """Distance [m], integral [m s] and double integral [m s2] since rows (k,) start, (3, k).

        Args:
            row: The rows.
            times: Times (k,) [s], at the start of the row or later.
        """
        state = np.zeros((3, len(times)))
        at = np.flatnonzero(row > 0)
        if not len(at):
            return state
        rows = row[at]
        joined = self._timings_of(int(rows.min()), int(rows.max()))
        start, duration, _, whole, offset, *_ = self._table[rows].T
        since = times[at] - start
        driven = np.clip(since, 0.0, duration)
        own = rows - joined.lowest
        way, once, twice = joined.before[:, own]
        now = joined.timings.since_marks(joined.interval_of[own], offset + driven)
        # At its end the row has its exact length, independent of rounding.
        state[0, at] = np.where(since >= duration, whole, np.clip(now[0] - way, 0.0, whole))
        state[1, at] = now[1] - once - way * driven
        state[2, at] = now[2] - twice - driven * (once + 0.5 * way * driven)
        over = since - driven
        state[2, at] += over * (state[1, at] + 0.5 * whole * over)
        state[1, at] += whole * over
        return state

    def since(
        self, before: Array, instants: Sequence[Array]
    ) -> tuple[Index, Array, tuple[Array, ...]]:
        """Return the travel of the command since earlier instants.

        Args:
            before: Earlier instants (k,) [s].
            instants: Later ones (k,) [s], one or more sets.

        Returns:
            The row (k,) of the earlier instants, and the distance [m] since the row's start (k,);
            for each set of later ones the distance since then [m], its integral [m s] and double
            integral [m s2], (3, k). Distances are relative, so neither a long run nor a long rest
            costs precision.
        """
        # All instants at once: for so few numbers, the cost is that of the NumPy calls.
        looks, times = len(instants), np.concatenate(instants)
        first, last = self.row_at(before), self.row_at(times)
        row = np.tile(first, looks)
        ahead = self.following(row)
        end = self._ends(ahead, last, times)
        state = self.state(np.append(first, row), np.append(before, end))
        origin, since = state[:, : len(first)], state[:, len(first) :]
        way, once, twice = np.tile(origin, looks)
        step = end - np.tile(before, looks)
        since[2] -= twice + step * (once + 0.5 * way * step)
        since[1] -= once + way * step
        since[0] -= way
        since[:, np.tile(self.is_stationary(first, before), looks)] = 0.0
        at = np.flatnonzero(ahead <= last)
        while len(at):
            row[at] = ahead[at]
            ahead[at] = self.following(row[at])
            begin, end[at] = end[at], self._ends(ahead[at], last[at], times[at])
            step, change = end[at] - begin, self.state(row[at], end[at])
            way, integral, _ = since[:, at]
            since[2, at] += step * (integral + 0.5 * way * step) + change[2]
            since[1, at] += way * step + change[1]
            since[0, at] += change[0]
            at = at[ahead[at] <= last[at]]
        return first, origin[0], tuple(np.split(since, looks, axis=1))

    def _ends(self, ahead: Index, last: Index, times: Array) -> Array:
        """Return times (k,) [s] until which rows before others (k,) count; `times` in last rows."""
        ends: Array = np.where(ahead <= last, self.starts(np.minimum(ahead, last))[0], times)
        return ends

    def following(self, row: Index) -> Index:
        """Return the next rows (k,) after rows (k,) that take time or distance, or past the last.

        Moves without length have rows with neither, thousands of them if a loop contains only such
        moves.
        """
        if self._taking is None:
            table = self._table[: self._rows]
            taking = (table[:, _Column.DURATION] > 0.0) | (table[:, _Column.WAY] > 0.0)
            self._taking = np.append(np.flatnonzero(taking), self._rows)
        return self._taking[np.searchsorted(self._taking[:-1], row, side="right")]

    def speed(self, row: Index, times: Array) -> Array:
        """Return the speed dS/dt (k,) [m/s] in rows (k,)."""
        speed = np.zeros(len(times))
        start, duration, offset = self._table[row][
            :, [_Column.START, _Column.DURATION, _Column.OFFSET]
        ].T
        since = times - start
        for number, at in groups(self.pieces_of(row)):
            driven = self.piece(number).timing.speed_at(offset[at] + since[at])
            speed[at] = np.where((since[at] <= duration[at]) & (row[at] > 0), driven, 0.0)
        return speed

    def place_at(self, times: Array) -> Array:
        """Return positions S (k,) [m] at times (k,) [s]."""
        row = self.row_at(times)
        place: Array = self._table[row, _Column.PLACE] + self.state(row, times)[0]
        return place

    def time_at(self, place: Array) -> Array:
        """Return the first times (k,) [s] at positions S (k,)."""
        ends = self._table[: self._rows, _Column.PLACE] + self._table[: self._rows, _Column.WAY]
        row = np.searchsorted(ends, place - ROUNDING_M, side="left")
        row = np.clip(row, 0, self._rows - 1).astype(np.int64)
        times = np.zeros(len(place))
        start, _, before, way, offset, from_s, number, _ = self._table[row].T
        s = from_s + np.clip(place - before, 0.0, way)
        for each, at in groups(number.astype(np.int64)):
            if each:
                driven = self.piece(each).timing.time_at(s[at]) - offset[at]
                times[at] = start[at] + driven
        return times

    def rows_at(self, place: Array) -> tuple[Index, Array]:
        """Rows (k,), after row 0, that contain positions S (k,) [m], and distances in them."""
        ends = self._table[: self._rows, _Column.PLACE] + self._table[: self._rows, _Column.WAY]
        row = np.searchsorted(ends, place - ROUNDING_M, side="left")
        row = np.clip(row, 1, self._rows - 1).astype(np.int64)
        before, way = self._table[row, _Column.PLACE], self._table[row, _Column.WAY]
        return row, np.clip(place - before, 0.0, way)

    def bounds_between(self, first: float, last: float) -> list[tuple[int, float, float]]:
        """Return the numbers of the pieces between positions S [m], with their starts and ends."""
        rows = self.rows_at(np.array([first, last]))[0]
        numbers = self._table[rows[0] : rows[1] + 1, _Column.PIECE]
        found = []
        for number in np.unique(numbers).astype(np.int64).tolist():
            own = np.searchsorted(self._table[: self._rows, _Column.PIECE], [number, number + 1])
            start, end = self._table[[own[0], own[1] - 1]]
            end_m = float(end[_Column.PLACE] + end[_Column.WAY])
            found.append((number, float(start[_Column.PLACE]), end_m))
        return found

    def joints_at(self, times: Array, *, quick: bool = False) -> Array:
        """Return joints, then external axes, (k, n + e) at times (k,) [s]; see `Path.joints_at`."""
        row = self.row_at(times)
        joints = np.zeros((len(times), self.axis_count))
        for path, s, at, _ in self.on_paths(row, self.state(row, times)[0]):
            joints[at, : path.axis_count] = path.joints_at(s, quick=quick)
        return joints

    def joints_in_parts(self, part: Index) -> Array:
        """Return joints (k, places, n + e) in parts of equal width; see `even_joints`."""
        if self._even_joints is None:
            self._even_joints = EvenJoints(self.end)
        return self._even_joints.at(part, partial(self.joints_at, quick=True))

    def nodes_between(self, first_s: float, last_s: float) -> Array:
        """Return times [s] of acceleration changes, in all rows from one instant to another."""
        first, last = self.row_at(np.array([first_s, last_s])).tolist()
        nodes = [np.zeros(0)]
        for start, duration, _, _, offset, _, number, mark in self._table[max(first, 1) : last + 1]:
            timing = self.piece(int(number)).timing
            begin, *after = timing.marks[int(mark) : int(mark) + 2].tolist()
            times = timing.times[begin : after[0] + 1 if after else None] - offset
            nodes.append(start + np.clip(times, 0.0, duration))
        return np.concatenate(nodes)

    def _timings_of(self, lowest: int, highest: int) -> _JoinedTimings:
        """Return the timings of some rows, counted from 1.

        They are cached, because a query about many rows is usually repeated.
        """
        joined = self._joined_timings
        if joined is None or lowest < joined.lowest or highest > joined.highest:
            # Use whole pieces, because a long piece has several rows.
            all_numbers = self._table[: self._rows, _Column.PIECE]
            first, last = int(all_numbers[lowest]), int(all_numbers[highest])
            lowest = int(np.searchsorted(all_numbers, first, side="left"))
            highest = int(np.searchsorted(all_numbers, last, side="right")) - 1
            rows = self._table[lowest : highest + 1]
            numbers = rows[:, _Column.PIECE].astype(np.int64)
            # A repeated cycle has the same timing each time; each distinct timing is joined once.
            all_of_them = [piece.timing for piece in self._pieces[first - 1 : last]]
            distinct = {id(one): one for one in all_of_them}
            place_of = {one: place for place, one in enumerate(distinct)}
            own = np.array([place_of[id(one)] for one in all_of_them])[numbers - first]
            timings = timings_of(list(distinct.values()))
            stretch = timings.begin[own] + rows[:, _Column.MARK].astype(np.int64)
            before = timings.since_marks(stretch, rows[:, _Column.OFFSET])
            joined = _JoinedTimings(timings, lowest, highest, stretch, before)
            self._joined_timings = joined
        return joined

    def _paths_of(self, numbers: Index) -> _JoinedPaths:
        """Return the paths of some pieces, numbers increasing; cached like the timings."""
        joined = self._joined_paths
        if joined is None or not np.isin(numbers, joined.numbers).all():
            pieces = [self._pieces[number - 1] for number in numbers.tolist()]
            paths = joined_paths([piece.path for piece in pieces])
            first = np.array([piece.first for piece in pieces]) - paths.before
            joined = self._joined_paths = _JoinedPaths(numbers, paths, first)
        return joined


@value_class(frozen=True, slots=True, eq=False)
class _JoinedPaths:
    """Joined paths of some pieces (k,)."""

    numbers: Index
    paths: JoinedPaths
    first: Index
    """Offset from a segment's index on its joined path to the number of its move, per piece."""


@value_class(frozen=True, slots=True, eq=False)
class _JoinedTimings:
    """Joined timings of some rows (m,)."""

    timings: TimeScalings
    lowest: int
    """Number of the first row."""
    highest: int
    interval_of: Index
    """Shape (m,): interval of the timings that contains each row."""
    before: Array
    """Shape (3, m): state at the start of each row, relative to its mark."""


class _Column:
    """Columns of the table of rows."""

    START = 0
    """Time [s]."""
    DURATION = 1
    """[s]"""
    PLACE = 2
    """S of the run at its start [m]."""
    WAY = 3
    """Range of S [m]."""
    OFFSET = 4
    """Time of the timing at its start [s]."""
    FROM_S = 5
    """Position [m] on its path at its start."""
    PIECE = 6
    """Number of its piece."""
    MARK = 7
    """Index of the mark of the timing to which it is relative."""


def groups(row: Index) -> list[tuple[int, Index]]:
    """Return the indices in `row` of each of its values, values ascending."""
    if not len(row):
        return []
    order = np.argsort(row, kind="stable")
    values, starts = np.unique(row[order], return_index=True)
    return [(int(value), at) for value, at in zip(values, np.split(order, starts[1:]), strict=True)]
