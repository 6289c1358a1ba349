"""Windows of moving averages over time, which a ramp of AccSet may widen.

A moving average of a motion is its weighted mean over the window [t - T(t), t]. The weights are
uniform for one moving average of width T; for two successive ones of width T / 2 they rise linearly
to the middle of the window and fall again.

The mean of positions on a path stays on that path and is never faster while 0 <= T' <= 1, so a
window only widens while the arm moves, smoothly and slowly. It becomes narrow again when it is
empty, that is, when the arm has been at rest so long that the window contains only rest. From then
on it does not extend back beyond the new start.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.model import Averages
from rapidsim.motion.trajectory.zero_crossings import first_crossing
from rapidsim.values import value_class

_STEEPEST = 0.5
"""Largest T' while a window widens: the visible speed is at least three quarters of the arm's."""
_UNHURRIED_S = 1.0
"""Minimum time [s] in which a window widens. Widening slows the arm down slightly, which takes a
share of the acceleration: a faster change would be noticeable. A shorter last move has less of a
ramp."""


@value_class(frozen=True, slots=True)
class _Step:
    """An instant from which the window widens, or restarts."""

    start_s: float
    floor_s: float
    """Earliest time [s] in the window: before it the arm was at rest."""
    width_s: float
    """Width at the start."""
    growth_s: float = 0.0
    lasts_s: float = 1.0

    @property
    def end_s(self) -> float:
        return self.start_s + self.lasts_s if self.growth_s else self.start_s

    @property
    def widest_s(self) -> float:
        return self.width_s + self.growth_s


class Windows:
    """Width of the window over the time of a whole run; it can only be extended."""

    def __init__(self, filter_time: float, averages: Averages = 1) -> None:
        """Create windows; `filter_time` [s] is the width of all averages until they widen."""
        self.filter_time = filter_time
        self.averages = averages
        self.widest = filter_time
        """Largest width [s]."""
        self._steps: list[_Step] = []
        self._table = np.zeros((16, 5))
        """Inputs of `_at` for each step."""
        self._add(_Step(-np.inf, -np.inf, filter_time))

    @property
    def is_constant(self) -> bool:
        """Whether the width is the filter time throughout."""
        return len(self._steps) == 1

    @property
    def widens(self) -> bool:
        """Whether the window is wider than the filter time somewhere."""
        return any(one.widest_s > self.filter_time for one in self._steps)

    @property
    def latest_width(self) -> float:
        """Width [s] at the end of the last widening."""
        return self._steps[-1].widest_s

    def copy(self) -> Windows:
        """Return a copy that can be extended independently."""
        copied = Windows(self.filter_time, self.averages)
        copied.widest = self.widest
        copied._steps, copied._table = list(self._steps), self._table.copy()
        return copied

    def at(self, times: Array) -> tuple[Array, Array, Array]:
        """Return width T [s], its rate T' and the window's earliest instant [s] at times (k,)."""
        if self.is_constant:
            count = len(times)
            return np.full(count, self.filter_time), np.zeros(count), np.full(count, -np.inf)
        return _at(self._table[: len(self._steps)], times)

    def instants(self, times: Array, width: Array, before: Array) -> tuple[Array, ...]:
        """Return times [s] to evaluate the command for `mean`: now, and in the middle of windows.

        Args:
            times: End times of windows (k,) [s].
            width: Their widths [s].
            before: Their start times [s]; earlier times are ignored.
        """
        if self.averages == 1:
            return (times,)
        return times, np.maximum(times - 0.5 * width, before)

    def mean(self, width: Array, rate: Array, changes: Sequence[Array]) -> tuple[Array, Array]:
        """Return the mean over windows of a changing quantity, and its rate of change.

        Args:
            width: Widths of the windows (k, ...) [s].
            rate: Rates at which they widen (k, ...).
            changes: For each of `instants`, the change since the start of the window, its
                integral and double integral, (3, k, ...).
        """
        now = changes[0]
        if self.averages == 1:
            mean = now[1] / width
            return mean, (now[0] - rate * mean) / width
        # Second difference of the second integral, as for a mean over two windows.
        middle, scale = changes[1], 4.0 / width**2
        mean = scale * (now[2] - 2.0 * middle[2])
        slope = scale * (now[1] - (2.0 - rate) * middle[1])
        return mean, slope - 2.0 * rate / width * mean

    def lag(self, command_s: float) -> float:
        """Return the delay [s] until the visible motion has completed the command up to a time."""
        if self.is_constant:
            return self.filter_time
        starts = self._table[: len(self._steps), 0]
        first = int(np.searchsorted(starts, command_s, side="right")) - 1
        last = first
        while (
            last + 1 < len(self._steps)
            and self._steps[last + 1].floor_s == self._steps[first].floor_s
        ):
            last += 1
        if command_s + self._steps[last].widest_s >= self._steps[last].end_s:
            return self._steps[last].widest_s
        # The window continues to widen while the arm comes to rest.
        steps = self._table[first : last + 1]
        run_empty = first_crossing(
            lambda since, _: since - _at(steps, command_s + since)[0],
            np.zeros(1),
            np.array([self._steps[last].widest_s]),
        )
        return float(run_empty[0])

    def forget(self, before_s: float) -> None:
        """Discard data that queries for a time [s] or later do not need."""
        count = len(self._steps)
        under_way = int(np.searchsorted(self._table[:count, 0], before_s, side="right")) - 1
        if under_way > 1:
            # The first step defines the width without ramps.
            del self._steps[1:under_way]
            self._table = np.delete(self._table, np.s_[1:under_way], axis=0)

    def cut(self, time_s: float) -> None:
        """Remove steps that begin at a time [s] or later."""
        while self._steps[-1].start_s >= time_s:
            self._steps.pop()

    def begin(self, start_s: float, width_s: float, *, elsewhere: bool) -> None:
        """Restart an empty window with a width, unless it already has it.

        Args:
            start_s: Time [s].
            width_s: Width [s].
            elsewhere: Whether the motion continues at another position than that of its last rest;
                then earlier times are ignored.
        """
        self.cut(start_s)
        last = self._steps[-1]
        if elsewhere or width_s != last.widest_s or last.end_s > start_s:
            self._add(_Step(start_s, start_s, width_s))

    def widening_s(self, width_s: float) -> float:
        """Return the time [s] in which the window widens to a width [s]."""
        return max(_UNHURRIED_S, 1.5 * (width_s - self._steps[-1].widest_s) / _STEEPEST)

    def widen(self, begins_s: float, width_s: float) -> None:
        """Widen from a time [s] on to a width [s], unless already as wide."""
        last = self._steps[-1]
        growth_s = width_s - last.widest_s
        if growth_s > 0.0:
            start_s = max(begins_s, last.end_s)
            lasts_s = self.widening_s(width_s)
            self._add(_Step(start_s, last.floor_s, last.widest_s, growth_s, lasts_s))

    def _add(self, step: _Step) -> None:
        number = len(self._steps)
        if number == len(self._table):
            self._table = np.concatenate([self._table, np.zeros_like(self._table)])
        row = (step.start_s, step.floor_s, step.width_s, step.growth_s, step.lasts_s)
        self._table[number] = row
        self._steps.append(step)
        self.widest = max(self.widest, step.widest_s)


def _at(steps: Array, times: Array) -> tuple[Array, Array, Array]:
    """Return width, rate and earliest instant at times (k,) [s], from steps (m, 5)."""
    number = np.maximum(np.searchsorted(steps[:, 0], times, side="right") - 1, 0)
    start, floor, width, growth, lasts = steps[number].T
    since = times - np.where(growth > 0.0, start, times)
    share = np.clip(since / lasts, 0.0, 1.0)
    grown: Array = width + growth * share**2 * (3.0 - 2.0 * share)
    rate: Array = 6.0 * growth / lasts * share * (1.0 - share)
    return grown, rate, floor
