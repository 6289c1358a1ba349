"""AccSet's ramp: the speed along the path is averaged over time, so the arm stays on its path.

A ramp of p % limits how fast acceleration builds up. Here the command's position on the path is
replaced by its moving average over W = T (100 / p - 1), where T is the filter time of the arm. A
change of acceleration then takes W, a move from stop point to stop point takes W longer, and the
path is that without a ramp, because it is the place on it that is averaged, not the axes. The
planner keeps the speed low around places where the command is slow for a short time
(`timing/ramped_drive`), so the average passes no corner faster. Smoothing acts afterwards, as
without a ramp.

Source: the description of AccSet as "the rate at which acceleration and deceleration increases as a
percentage of the normal values". Neither the width nor the shape has been measured.

The average of a command with constant accelerations is quadratic in time; it is replaced by short
cells of constant acceleration, which differ from it by a few micrometres.
"""

from __future__ import annotations

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.path.segment_columns import ramp_window
from rapidsim.motion.timing.constraints import Limiter, Quantity
from rapidsim.motion.timing.time_scaling import Numbers, TimeScaling
from rapidsim.motion.trajectory.command import MotionCommand, Piece
from rapidsim.motion.trajectory.filter_windows import Windows
from rapidsim.motion.trajectory.zero_crossings import first_crossing
from rapidsim.repeated_rows import divided

_ROUNDING = 1e-9
_LEAST_WIDTH_S = 1e-6
"""Width [s] below which a window counts as closed."""
_DEVIATION_M = 3e-7
"""Largest distance [m] between the average and its cells, of one interval."""
_MOST_PARTS = 1000
_ADDED = 0.5
"""Share of the planned speed below which the ramp adds most of the time."""
_REACHED = 0.95
"""Share of a maximum speed that counts as reached."""
_PROBES = np.array([0.25, 0.5, 0.75])
"""Shares of an interval at which the speed is compared with a line."""


class RampedCommand:
    """A motion command as planned, and as ramps change it."""

    def __init__(self) -> None:
        """Create an empty command."""
        self.planned = MotionCommand()
        self.command = self.planned
        """With its ramps; the same object while there are none."""
        self._windows = Windows(0.0)
        self._known_s = 0.0
        """Time [s] up to which `command` has been computed."""

    @property
    def has_ramps(self) -> bool:
        """Whether a ramp of AccSet averages the speed anywhere."""
        return self._windows.widens

    @property
    def widest(self) -> float:
        """Largest width [s] of the window."""
        return self._windows.widest

    def copy(self) -> RampedCommand:
        """Return a copy that can be extended independently."""
        copied = RampedCommand()
        copied.planned = copied.command = self.planned.copy()
        if self.command is not self.planned:
            copied.command = self.command.copy()
        copied._windows, copied._known_s = self._windows.copy(), self._known_s
        return copied

    def lag_s(self, command_s: float) -> float:
        """Return the delay [s] until the average has completed the command up to a time [s]."""
        return self._windows.lag(command_s)

    def cut(self, time_s: float) -> None:
        """Remove the command after a time [s]."""
        self._windows.cut(time_s)
        self.planned.cut(time_s)
        if self.command is not self.planned:
            self.command.cut(time_s)
            self._known_s = min(self._known_s, time_s)

    def forget(self, before_s: float) -> None:
        """Discard data that queries for a time [s] or later do not need."""
        self.planned.forget(before_s - self.widest)
        if self.command is not self.planned:
            self.command.forget(before_s)
        self._windows.forget(before_s - self.widest)

    def append(self, piece: Piece, *, elsewhere: bool) -> float:
        """Add a piece; see `Trajectory.append`.

        Args:
            piece: The next piece as planned.
            elsewhere: Whether it starts at another position than that of the last rest.
        """
        start_s = piece.start_time
        end_s = self.planned.end
        empty = start_s >= end_s + self.lag_s(end_s) - _ROUNDING
        self._follow(piece, empty=empty, elsewhere=elsewhere)
        if self.command is self.planned and self.has_ramps:
            self.command, self._known_s = self.planned.copy(), end_s
        place = self.planned.append(piece)
        if self.command is not self.planned:
            self._known_s = min(self._known_s, start_s)
            self.command.cut(self._known_s)
            if empty and self._windows.latest_width == 0.0:
                self.command.append(piece)
                self._known_s = self.planned.end
            else:
                self._extend(self._until_s(piece))
        return place

    def _until_s(self, piece: Piece) -> float:
        """Return the time [s] up to which the last piece determines the average."""
        end_s = self.planned.end
        at_rest = piece.to_s >= float(piece.timing.s[-1]) - _ROUNDING
        return end_s + (self.lag_s(end_s) if at_rest else 0.0)

    def _follow(self, piece: Piece, *, empty: bool, elsewhere: bool) -> None:
        """Widen the window as required by the moves of a piece; their ramps only decrease."""
        path, timing = piece.path, piece.timing
        full_s = path.model.window
        if not self.has_ramps and path.window == full_s and not elsewhere:
            return
        starts, start_s = path.segment_starts, piece.start_time
        first = max(int(np.searchsorted(starts, piece.from_s + _ROUNDING, side="right")) - 1, 0)
        last = max(int(np.searchsorted(starts, piece.to_s - _ROUNDING, side="left")) - 1, first)
        windows = self._windows
        if empty:
            windows.begin(start_s, float(path.ramp_windows[first]), elsewhere=elsewhere)
        shift_s = start_s - timing.time_at(piece.from_s)
        for index in range(first, last + 1):
            segment, width_s = path.segments[index], float(path.ramp_windows[index])
            stop_width_s = 0.0 if segment.zone else ramp_window(segment.stop_ramp, full_s)
            if max(width_s, stop_width_s) <= windows.latest_width:
                continue
            begins_s = max(start_s, shift_s + timing.time_at(float(starts[index])))
            windows.widen(begins_s, width_s)
            end = float(path.segment_bounds[index + 1])
            if stop_width_s > width_s and timing.s[-1] >= end - _ROUNDING:
                ends_s = shift_s + timing.time_at(end)
                begins_s = max(ends_s - windows.widening_s(stop_width_s), begins_s)
                # A step that would begin after the end of this piece is added with the next one.
                if begins_s < shift_s + timing.time_at(piece.to_s):
                    windows.widen(begins_s, stop_width_s)

    def _extend(self, until_s: float) -> None:
        """Compute the average up to a time [s]."""
        since_s, self._known_s = self._known_s, until_s
        times = self._divided(self._nodes(since_s, until_s))
        places, speeds = self._average(times)
        # What has been computed stays, with its rounding.
        places = np.maximum.accumulate(np.maximum(places, self.command.length))
        bounds = self.planned.bounds_between(float(places[0]), float(places[-1]))
        for number, start, end in bounds:
            first = int(np.searchsorted(places, start, side="right")) - 1
            last = int(np.searchsorted(places, end, side="left"))
            inside = slice(max(first, 0), last + 1)
            planned = self.planned.piece(number)
            ways = np.clip(places[inside], start, end) - start
            self._add(planned, ways, times[inside], speeds[inside])

    def _add(self, planned: Piece, ways: Array, times: Array, speeds: Array) -> None:
        """Append a stretch of a piece: distances since its start [m] and speeds [m/s] at times."""
        if len(times) < 2 or ways[-1] <= ways[0]:
            return
        steps = np.diff(times)
        mean = 0.5 * (speeds[1:] + speeds[:-1])
        length = float(mean @ steps)
        if length == 0.0:
            # At rest places differ by their rounding.
            return
        scale = float(ways[-1] - ways[0]) / length
        s = planned.from_s + ways[0] + np.concatenate([[0.0], np.cumsum(scale * mean * steps)])
        s[-1] = planned.from_s + ways[-1]
        timing = TimeScaling(
            s=s,
            speed=scale * speeds,
            start_excess=0.0,
            limiters=(*planned.timing.limiters, Limiter(Quantity.RAMP)),
            active=_active(planned.timing, 0.5 * (s[1:] + s[:-1]), scale * mean),
            standing=np.where(mean == 0.0, steps, 0.0),
        )
        start_s = max(float(times[0]), self.command.end)
        piece = Piece(start_s, planned.path, timing, float(s[0]), float(s[-1]), planned.first)
        self.command.append(piece)

    def _nodes(self, since_s: float, until_s: float) -> Array:
        """Return times [s] between which the average is quadratic, ends included.

        These are the instants at which a change of acceleration enters or leaves the window, or at
        which the average leaves a piece.
        """
        changes = self.planned.nodes_between(since_s - self.widest, until_s)
        leaves = changes + self._windows.at(changes)[0]
        # The window may widen until then.
        leaves = changes + self._windows.at(leaves)[0]
        nodes = np.unique(np.concatenate([[since_s, until_s], changes, leaves]))
        nodes = nodes[(nodes >= since_s) & (nodes <= until_s)]
        places = self._average(nodes)[0]
        ends = [end for *_, end in self.planned.bounds_between(float(places[0]), float(places[-1]))]
        passed = np.array(ends[:-1])
        if not len(passed):
            return nodes
        after = np.clip(np.searchsorted(places, passed), 1, len(nodes) - 1)
        crossings = first_crossing(
            lambda now, row: self._average(now)[0] - passed[row], nodes[after - 1], nodes[after]
        )
        return np.unique(np.concatenate([nodes, crossings]))

    def _divided(self, nodes: Array) -> Array:
        """Divide intervals (k - 1,) between times into cells that are short enough."""
        width = np.diff(nodes)
        probed = nodes[:-1] + np.multiply.outer(_PROBES, width)
        speeds = self._average(np.concatenate([nodes, probed.ravel()]))[1]
        ends, inner = speeds[: len(nodes)], speeds[len(nodes) :].reshape(probed.shape)
        lines = ends[:-1] + np.multiply.outer(_PROBES, np.diff(ends))
        bend = np.abs(inner - lines).max(axis=0)
        parts = np.ceil(np.sqrt(bend * width / _DEVIATION_M))
        parts = np.clip(parts, 1, _MOST_PARTS).astype(np.int64)
        return divided(nodes, parts)

    def _average(self, times: Array) -> tuple[Array, Array]:
        """Return the averaged position S (k,) [m] and its speed (k,) [m/s] at times (k,) [s]."""
        width, rate, floor = self._windows.at(times)
        closed = width < _LEAST_WIDTH_S
        before = np.where(closed, times, np.maximum(times - width, floor))
        oldest, way, changes = self.planned.since(before, (times,))
        mean, speed = self._windows.mean(np.where(closed, 1.0, width), rate, changes)
        now = self.planned.speed(self.planned.row_at(times), times)
        places = self.planned.starts(oldest)[1] + way + np.where(closed, 0.0, mean)
        return places, np.maximum(np.where(closed, now, speed), 0.0)


def _active(planned: TimeScaling, s: Array, speeds: Array) -> Numbers | None:
    """Return the active limit (k,) at positions (k,) [m] that are passed at speeds (k,) [m/s].

    It is the planned one, or the ramp, after these: where the ramp adds most of the time, or where
    the planned limit is one of the speed and is not reached.
    """
    if planned.active is None:
        return None
    cell = np.searchsorted(planned.s[1:-1], s, side="right")
    active = planned.active[cell]
    least = np.array([_ADDED if one.is_acceleration else _REACHED for one in planned.limiters])
    slow = speeds < least[active] * planned.speed_at(planned.time_at(s))
    return np.where(slow, np.int16(len(planned.limiters)), active)
