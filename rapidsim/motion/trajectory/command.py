"""What a robot is told over a whole run: pieces of timed paths, with standstill in between.

All their stretches laid end to end give one parameter, the place S [m] of the whole run. Pieces are
counted from 1; number 0 is the standstill before the first.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from rapidsim.frames.transform import Array
from rapidsim.motion.path.joined_paths import JoinedPaths, joined_paths
from rapidsim.motion.path.path import Path
from rapidsim.motion.timing.time_scaling import Timing
from rapidsim.motion.trajectory.time_scalings import Timings, timings_of

Index = npt.NDArray[np.int64]

ROUNDING_M = 1e-11
"""Places so near count as one."""


@dataclass(frozen=True, slots=True, eq=False)
class Piece:
    """A stretch of a timed path, commanded from an instant on."""

    start_time: float
    """[s]"""
    path: Path
    timing: Timing
    from_s: float
    """Place [m] on the path where the piece starts."""
    to_s: float
    """Place [m] where it ends; the next piece may go on from there on another path."""


class MotionCommand:
    """A row of pieces; it can only be added to, and cut at its end."""

    def __init__(self) -> None:
        """Nothing is commanded."""
        self._pieces: list[Piece] = []
        # Row 0 is the standstill before the first piece. Columns: see `_Column`.
        self._table = np.zeros((16, 6))
        self._rows = 1
        self._joined_timings: _JoinedTimings | None = None
        self._joined_paths: _JoinedPaths | None = None

    def copy(self) -> MotionCommand:
        """The same, to be added to on its own."""
        copied = MotionCommand()
        copied._pieces = list(self._pieces)
        copied._table = self._table[: self._rows + 1].copy()
        copied._rows = self._rows
        return copied

    @property
    def pieces(self) -> tuple[Piece, ...]:
        """What was appended, in the order of time."""
        return tuple(self._pieces)

    @property
    def last(self) -> int:
        """The number of the last piece; 0 without pieces."""
        return self._rows - 1

    @property
    def end(self) -> float:
        """When it comes to its end [s]; 0 without pieces."""
        if not self._pieces:
            return 0.0
        row = self._table[self._rows - 1]
        return float(row[_Column.START] + row[_Column.DURATION])

    @property
    def length(self) -> float:
        """Place S [m] where the last piece ends."""
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
        if self._rows == len(self._table):
            self._table = np.concatenate([self._table, np.zeros_like(self._table)])
        place, start = self.length, max(piece.start_time, self.end)
        way = piece.to_s - piece.from_s
        self._pieces.append(piece)
        self._table[self._rows] = (start, end - offset, place, way, offset, piece.from_s)
        self._rows += 1
        return place

    def cut(self, time_s: float) -> None:
        """Take back what is commanded after a time [s]."""
        self._joined_timings = self._joined_paths = None
        while self._pieces and self._table[self._rows - 1, _Column.START] >= time_s:
            self._pieces.pop()
            self._rows -= 1
        if not self._pieces or self.end <= time_s:
            return
        row, piece = self._table[self._rows - 1], self._pieces[-1]
        driven = time_s - float(row[_Column.START])
        to_s = min(piece.timing.s_at(float(row[_Column.OFFSET]) + driven), piece.to_s)
        self._pieces[-1] = replace(piece, to_s=to_s)
        row[_Column.DURATION], row[_Column.WAY] = driven, to_s - piece.from_s

    def number_at(self, times: Array) -> Index:
        """The piece (k,) that began last before times (k,) [s]."""
        starts = self._table[1 : self._rows, _Column.START]
        return np.searchsorted(starts, times, side="right").astype(np.int64)

    def piece(self, number: int) -> Piece:
        """A piece by its number; the first one stands for the standstill before it."""
        return self._pieces[max(number, 1) - 1]

    def starts(self, number: Index) -> tuple[Array, Array]:
        """When pieces (k,) start [s], and at which places S [m]."""
        return self._table[number, _Column.START], self._table[number, _Column.PLACE]

    def ways(self, number: Index) -> Array:
        """How far S goes on in pieces (k,) [m]."""
        ways: Array = self._table[number, _Column.WAY]
        return ways

    def state(self, number: Index, times: Array) -> tuple[Array, Array]:
        """Way (k,) [m] since the start of pieces (k,), and its integral [m s] from there."""
        way, integral = np.zeros(len(times)), np.zeros(len(times))
        at = np.flatnonzero(number > 0)
        if not len(at):
            return way, integral
        numbers = number[at]
        joined = self._timings_of(int(numbers.min()), int(numbers.max()))
        start, duration, _, whole, offset, from_s = self._table[numbers].T
        since = times[at] - start
        driven = np.clip(since, 0.0, duration)
        own = numbers - joined.lowest
        s, now = joined.timings.place_and_integral(own, offset + driven)
        # At its end the piece is where it says, whatever rounding makes of it.
        way[at] = np.where(since >= duration, whole, np.clip(s - from_s, 0.0, whole))
        integral[at] = (
            now - joined.before[own] - joined.first[own] * driven + whole * (since - driven)
        )
        return way, integral

    def speed(self, number: Index, times: Array) -> Array:
        """Speed dS/dt (k,) [m/s] in pieces (k,)."""
        speed = np.zeros(len(times))
        for each, at in groups(number):
            if each:
                start, duration, _, _, offset, _ = self._table[each]
                since = times[at] - start
                driven = self._pieces[each - 1].timing.speed_at(offset + since)
                speed[at] = np.where(since <= duration, driven, 0.0)
        return speed

    def place_at(self, times: Array) -> Array:
        """Place S (k,) [m] at times (k,) [s]."""
        number = self.number_at(times)
        place: Array = self._table[number, _Column.PLACE] + self.state(number, times)[0]
        return place

    def time_at(self, place: Array) -> Array:
        """First time (k,) [s] at places S (k,)."""
        ends = self._table[: self._rows, _Column.PLACE] + self._table[: self._rows, _Column.WAY]
        row = np.searchsorted(ends, place - ROUNDING_M, side="left")
        row = np.clip(row, 0, self._rows - 1)
        times = np.zeros(len(place))
        for number, at in groups(row):
            if number == 0:
                continue
            piece = self._pieces[number - 1]
            start, _, before, _, offset, _ = self._table[number]
            s = piece.from_s + np.clip(place[at] - before, 0.0, piece.to_s - piece.from_s)
            times[at] = start + piece.timing.time_at(s) - offset
        return times

    def joints_at(self, times: Array) -> Array:
        """Joints of the arm, then external axes, (k, n + e) at times (k,) [s]."""
        number = self.number_at(times)
        way, _ = self.state(number, times)
        joints = np.empty((len(times), self.piece(1).path.axis_count))
        for path, s, at in self.on_paths(number, way):
            points = path.evaluate(s)
            joints[at] = np.concatenate([points.joints, points.external], axis=1)
        return joints

    def on_paths(self, number: Index, way: Array) -> Iterator[tuple[Path, Array, Index]]:
        """Where ways (k,) [m] since the start of pieces (k,) are.

        Before the first piece the arm stands where that begins.

        Yields:
            A path, places s on it [m], and which of the k they are.
        """
        if not len(number):
            return
        number = np.maximum(number, 1)
        joined = self._paths_of(np.unique(number))
        own = np.searchsorted(joined.numbers, number)
        s = self._table[number, _Column.FROM_S] + way + joined.paths.starts[own]
        for each, at in groups(joined.paths.on[own]):
            yield joined.paths.paths[each], s[at], at

    def nodes_between(self, first_s: float, last_s: float) -> Array:
        """Where the acceleration of the pieces from one instant to another changes [s]."""
        first, last = self.number_at(np.array([first_s, last_s])).tolist()
        nodes = [np.zeros(0)]
        for number in range(max(first, 1), last + 1):
            start, duration, _, _, offset, _ = self._table[number]
            times = self._pieces[number - 1].timing.times - offset
            nodes.append(start + np.clip(times, 0.0, duration))
        return np.concatenate(nodes)

    def _timings_of(self, lowest: int, highest: int) -> _JoinedTimings:
        """The timings of some pieces, counted from 1.

        They are kept, for whoever asks about many pieces mostly asks again.
        """
        joined = self._joined_timings
        if joined is None or lowest < joined.lowest or highest > joined.highest:
            timings = timings_of([piece.timing for piece in self._pieces[lowest - 1 : highest]])
            rows = self._table[lowest : highest + 1]
            own = np.arange(len(rows))
            _, before = timings.place_and_integral(own, rows[:, _Column.OFFSET])
            first = rows[:, _Column.FROM_S] - timings.s[timings.first]
            joined = self._joined_timings = _JoinedTimings(timings, lowest, highest, before, first)
        return joined

    def _paths_of(self, numbers: Index) -> _JoinedPaths:
        """The paths of some pieces, numbers increasing; kept as the timings are."""
        joined = self._joined_paths
        if joined is None or not np.isin(numbers, joined.numbers).all():
            paths = joined_paths([self._pieces[number - 1].path for number in numbers.tolist()])
            joined = self._joined_paths = _JoinedPaths(numbers, paths)
        return joined


@dataclass(frozen=True, slots=True, eq=False)
class _JoinedPaths:
    """The paths of some pieces (k,)."""

    numbers: Index
    paths: JoinedPaths


@dataclass(frozen=True, slots=True, eq=False)
class _JoinedTimings:
    """The timings of some pieces (t,)."""

    timings: Timings
    lowest: int
    """The number of the first piece."""
    highest: int
    before: Array
    """What `way_integral` is where each piece starts."""
    first: Array
    """How far along its timing each piece starts [m]."""


class _Column:
    """Columns of the table of pieces."""

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
    """Place [m] on its path at its start."""


def groups(row: Index) -> list[tuple[int, Index]]:
    """The places in `row` of each value in it, values increasing."""
    if not len(row):
        return []
    order = np.argsort(row, kind="stable")
    values, starts = np.unique(row[order], return_index=True)
    return [(int(value), at) for value, at in zip(values, np.split(order, starts[1:]), strict=True)]
