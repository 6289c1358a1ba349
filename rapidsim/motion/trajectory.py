"""A whole run's motion as a function of time, while it grows and afterwards.

The command is a row of pieces: stretches of timed paths, with standstill in between. All their
stretches laid end to end give one parameter, the place S [m] of the whole run. A controller
smooths its command: the visible place is the mean of the commanded place over the last
`filter_time`. The arm therefore stays exactly on its path and lags behind the command.

Nothing is sampled or interpolated: within a cell of a timing S is a parabola of time and its mean
a cubic, and joints come from the exact pose.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import overload

import numpy as np
import numpy.typing as npt

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.path import Path
from rapidsim.motion.segments import Waypoint
from rapidsim.motion.timing import Timing

Index = npt.NDArray[np.int64]

SAMPLE_STEP_S = 0.012
"""As often as ABB's controllers log positions."""
_SAMPLES_AT_ONCE = 10_000
_ROUNDING = 1e-11
_HALVINGS = 52


@dataclass(frozen=True, slots=True, eq=False)
class Samples:
    """The arm at some instants."""

    times: Array
    """Shape (k,) [s]."""
    move: Index
    """Shape (k,): index of the move under way; the last one while standing still after it, the
    first one before it."""
    joints: Array
    """Shape (k, n) [rad]."""
    base_from_tcp: Transform
    """Shape (k,); the tool is that of the move."""
    tcp_speed: Array
    """Shape (k,) [m/s], against the work object."""
    external: Array = field(default_factory=lambda: np.zeros((0, 0)))
    """Shape (k, e) [m or rad]: the external axes."""


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


class Trajectory:
    """Where the arm is at any time; it can only be added to."""

    def __init__(self, start: Waypoint, filter_time: float = 0.0) -> None:
        """Stand still at a start; `filter_time` [s] is the width of the smoothing."""
        self._start = start
        self._filter_time = filter_time
        self._pieces: list[Piece] = []
        # Row 0 is the standstill before the first piece. Columns: see `_Column`.
        self._table = np.zeros((16, 5))
        self._rows = 1

    @property
    def pieces(self) -> tuple[Piece, ...]:
        """What was appended, in the order of time."""
        return tuple(self._pieces)

    def append(self, piece: Piece) -> float:
        """Add a piece after the last one.

        Returns:
            The place S [m] of the whole run where the piece starts: S - `from_s` turns places on
            its path into places of the run.

        Raises:
            ValueError: If the piece starts before the last one ends, or ends before it starts.
        """
        offset, end = (piece.timing.time_at(s) for s in (piece.from_s, piece.to_s))
        if piece.start_time < self.command_end - 1e-9:
            raise ValueError(
                f"a piece starts at {piece.start_time} s, before the last ends at "
                f"{self.command_end} s"
            )
        if piece.to_s < piece.from_s:
            raise ValueError(f"a piece runs backwards, from {piece.from_s} m to {piece.to_s} m")
        if self._rows == len(self._table):
            self._table = np.concatenate([self._table, np.zeros_like(self._table)])
        place = self.length
        self._pieces.append(piece)
        self._table[self._rows] = (
            max(piece.start_time, self.command_end),
            end - offset,
            place,
            piece.to_s - piece.from_s,
            offset,
        )
        self._rows += 1
        return place

    def cut(self, time_s: float) -> None:
        """Take back what is commanded after a time [s]."""
        while self._pieces and self._table[self._rows - 1, _Column.START] >= time_s:
            self._pieces.pop()
            self._rows -= 1
        if not self._pieces or self.command_end <= time_s:
            return
        row, piece = self._table[self._rows - 1], self._pieces[-1]
        driven = time_s - float(row[_Column.START])
        to_s = min(piece.timing.s_at(float(row[_Column.OFFSET]) + driven), piece.to_s)
        self._pieces[-1] = replace(piece, to_s=to_s)
        row[_Column.DURATION], row[_Column.WAY] = driven, to_s - piece.from_s

    def extended(self, piece: Piece) -> Trajectory:
        """A copy with one more piece; this one stays as it is."""
        longer = Trajectory(self._start, self._filter_time)
        longer._pieces = list(self._pieces)
        longer._table = self._table[: self._rows + 1].copy()
        longer._rows = self._rows
        longer.append(piece)
        return longer

    @property
    def command_end(self) -> float:
        """When the command comes to its end [s]; 0 without pieces."""
        if not self._pieces:
            return 0.0
        row = self._table[self._rows - 1]
        return float(row[_Column.START] + row[_Column.DURATION])

    @property
    def duration(self) -> float:
        """Last instant [s] of visible motion; 0 without pieces."""
        return self.command_end + self._filter_time if self._pieces else 0.0

    @property
    def length(self) -> float:
        """Place S [m] of the run where the last piece ends."""
        row = self._table[self._rows - 1]
        return float(row[_Column.PLACE] + row[_Column.WAY])

    @property
    def travelled_m(self) -> float:
        """TCP travel [m] of the whole run, corners cut."""
        travel = 0.0
        for piece in self._pieces:
            start, end = piece.path.travelled(np.array([piece.from_s, piece.to_s]))
            travel += float(end - start)
        return travel

    def at(self, times: Array) -> Samples:
        """The arm at some instants (k,) [s], in any order."""
        times = np.atleast_1d(np.asarray(times, dtype=np.float64))
        row, way, speed = self._visible(times)
        joints = np.tile(self._start.joints, (len(times), 1))
        external = np.tile(self._start.external, (len(times), 1))
        rotation = np.tile(self._start.base_from_tcp.rotation, (len(times), 1, 1))
        translation = np.tile(self._start.base_from_tcp.translation, (len(times), 1))
        move = np.zeros(len(times), dtype=np.int64)
        tcp_speed = np.zeros(len(times))
        for number, at in _groups(np.maximum(row, min(1, len(self._pieces)))):
            if number == 0:
                continue
            # Before the first piece the arm stands where it begins, with the tool it begins with.
            piece = self._pieces[number - 1]
            points = piece.path.evaluate(piece.from_s + way[at])
            joints[at], external[at] = points.joints, points.external
            rotation[at] = points.base_from_tcp.rotation
            translation[at] = points.base_from_tcp.translation
            indices = np.array([segment.index for segment in piece.path.segments])
            move[at] = indices[points.segment]
            tcp_speed[at] = points.tcp_rate * speed[at]
        pose = Transform(rotation, translation)
        return Samples(times, move, joints, pose, tcp_speed, external)

    @property
    def times(self) -> Array:
        """Instants (k,) [s] every `SAMPLE_STEP_S` from 0, and the last of visible motion."""
        steps: Array = np.arange(0.0, self.duration, SAMPLE_STEP_S)
        return np.append(steps, self.duration)

    @property
    def joints(self) -> Array:
        """Joints (k, n) [rad] at `times`, worked out anew each time; `at` gives more."""
        times = self.times
        # In parts, so that a long run does not need the memory for all its solutions at once.
        parts = np.array_split(times, len(times) // _SAMPLES_AT_ONCE + 1)
        return np.concatenate([self.at(part).joints for part in parts])

    def place_at(self, times: Array) -> Array:
        """Visible place S (k,) [m] of the run at times (k,) [s]."""
        row, way, _ = self._visible(np.atleast_1d(np.asarray(times, dtype=np.float64)))
        place: Array = self._table[row, _Column.PLACE] + way
        return place

    @overload
    def time_at_place(self, place: float) -> float: ...

    @overload
    def time_at_place(self, place: Array) -> Array: ...

    def time_at_place(self, place: float | Array) -> float | Array:
        """First time [s] at which the visible motion is at places S [m] of the run.

        Args:
            place: One place, or places (k,).
        """
        places = np.atleast_1d(np.asarray(place, dtype=np.float64))
        times = self._command_time(places)
        if self._filter_time > 0.0:
            # The mean over the last `filter_time` has passed what the command passed before that.
            early, late = times, times + self._filter_time
            for _ in range(_HALVINGS):
                middle = 0.5 * (early + late)
                there = self.place_at(middle) >= places - _ROUNDING
                early, late = np.where(there, early, middle), np.where(there, middle, late)
            times = late
        return times if np.ndim(place) else float(times[0])

    def _row_at(self, times: Array) -> Index:
        starts = self._table[1 : self._rows, _Column.START]
        return np.searchsorted(starts, times, side="right").astype(np.int64)

    def _command_time(self, place: Array) -> Array:
        """First time (k,) [s] at which the command is at places S (k,)."""
        ends = self._table[: self._rows, _Column.PLACE] + self._table[: self._rows, _Column.WAY]
        row = np.searchsorted(ends, place - _ROUNDING, side="left")
        row = np.clip(row, 0, self._rows - 1)
        times = np.zeros(len(place))
        for number, at in _groups(row):
            if number == 0:
                continue
            piece = self._pieces[number - 1]
            start, _, before, _, offset = self._table[number]
            s = piece.from_s + np.clip(place[at] - before, 0.0, piece.to_s - piece.from_s)
            times[at] = start + piece.timing.time_at(s) - offset
        return times

    def _command(self, row: Index, times: Array) -> tuple[Array, Array]:
        """Commanded way (k,) [m] since the start of pieces, and its integral [m s] from there."""
        way, integral = np.zeros(len(times)), np.zeros(len(times))
        for number, at in _groups(row):
            if number == 0:
                continue
            piece = self._pieces[number - 1]
            start, duration, _, whole, offset = self._table[number]
            since = times[at] - start
            driven = np.clip(since, 0.0, duration)
            first = piece.from_s - float(piece.timing.s[0])
            s = piece.timing.s_at(offset + driven)
            # At its end the piece is where it says, whatever rounding makes of it.
            way[at] = np.where(since >= duration, whole, np.clip(s - piece.from_s, 0.0, whole))
            part = piece.timing.way_integral(np.append(offset + driven, offset))
            integral[at] = part[:-1] - part[-1] - first * driven + whole * (since - driven)
        return way, integral

    def _visible(self, times: Array) -> tuple[Index, Array, Array]:
        """Piece (k,), way (k,) [m] since its start and speed dS/dt (k,) [m/s] of the motion."""
        row = self._row_at(times)
        table = self._table[: self._rows]
        if self._filter_time == 0.0:
            way, _ = self._command(row, times)
            speed = np.zeros(len(times))
            for number, at in _groups(row):
                if number:
                    start, duration, _, _, offset = table[number]
                    since = times[at] - start
                    driven = self._pieces[number - 1].timing.speed_at(offset + since)
                    speed[at] = np.where(since <= duration, driven, 0.0)
            return row, way, speed
        before = times - self._filter_time
        oldest = self._row_at(before)
        way, integral = self._command(row, times)
        old_way, old_integral = self._command(oldest, before)
        # Places are counted from the start of the oldest piece in the window, so that a long run
        # costs no digits.
        origin = table[oldest, _Column.PLACE]
        total = integral - old_integral
        between = oldest.copy()
        while True:
            at = np.flatnonzero(between < row)
            if not len(at):
                break
            # A piece that ended within the window counts up to the start of the next one.
            passed = between[at]
            next_start = table[passed + 1, _Column.START]
            total[at] += self._command(passed, next_start)[1] + (
                table[passed, _Column.PLACE] - origin[at]
            ) * (next_start - table[passed, _Column.START])
            between[at] += 1
        rise = table[row, _Column.PLACE] - origin
        total += rise * (times - table[row, _Column.START])
        mean = total / self._filter_time
        speed = (rise + way - old_way) / self._filter_time
        return *self._piece_of(oldest, mean), speed

    def _piece_of(self, oldest: Index, way: Array) -> tuple[Index, Array]:
        """Move ways (k,) [m] counted from pieces (k,) on to the pieces that hold them."""
        row, way = oldest.copy(), np.maximum(way, 0.0)
        while True:
            whole = self._table[row, _Column.WAY]
            past = np.flatnonzero((way > whole + _ROUNDING) & (row < self._rows - 1))
            if not len(past):
                return row, np.minimum(way, whole)
            way[past] -= whole[past]
            row[past] += 1


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


def _groups(row: Index) -> list[tuple[int, Index]]:
    """The places in `row` of each value in it, values increasing."""
    if not len(row):
        return []
    order = np.argsort(row, kind="stable")
    values, starts = np.unique(row[order], return_index=True)
    return [(int(value), at) for value, at in zip(values, np.split(order, starts[1:]), strict=True)]
