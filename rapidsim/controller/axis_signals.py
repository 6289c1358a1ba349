"""Test signals of a task: quantities of the axes of any robot of the cell, sampled at intervals."""

from __future__ import annotations

import math

import numpy as np

from rapidsim.controller.cell.cell import Cell
from rapidsim.controller.clock import TaskClock
from rapidsim.controller.other_tasks import TaskCoordination
from rapidsim.frames.transform import Array
from rapidsim.language.data import JointTarget
from rapidsim.language.equipment import AxisQuantity, MechanicalUnitFacts
from rapidsim.values import value_class

_MEAN_OVER_S = 0.004
"""Signals sampled more often than this [s] read as a mean over it."""
_SHORTEST_S = 0.0005
"""Interval [s] of samples for which a program specifies 0."""
_SPEED_OVER_S = 1e-3
"""A speed is the change of a position over this time [s]."""
_ROUNDING_S = 1e-9


@value_class(frozen=True, slots=True, eq=False)
class SampledAxis:
    """Implements `cell.SampledSignal` for an axis."""

    of: TaskCoordination
    """The task that moves it."""
    unit: MechanicalUnitFacts
    at: int
    """Position in `unit.axes`."""
    quantity: AxisQuantity
    sample_s: float
    since_s: float
    """Time [s] of the first sample."""

    def value(self, now_s: float, reader: object) -> float:
        """Value as sampled last before a time [s]."""
        times = self._times(now_s)
        if self.quantity is AxisQuantity.POSITION:
            return float(np.mean(self._positions(times, now_s, reader)))
        before = np.maximum(times - _SPEED_OVER_S, 0.0)
        both = np.stack([before, times], axis=1).ravel()
        order = np.argsort(both, kind="stable")
        positions = np.empty(len(both))
        positions[order] = self._positions(both[order], now_s, reader)
        start, end = positions.reshape(-1, 2).T
        return float(np.mean((end - start) / _SPEED_OVER_S))

    def _times(self, now_s: float) -> Array:
        """Times [s] of the samples that are read now."""
        if self.sample_s < _MEAN_OVER_S:
            step_s = max(self.sample_s, _SHORTEST_S)
            count = round(_MEAN_OVER_S / step_s)
            return np.maximum(now_s - step_s * np.arange(count - 1, -1, -1.0), 0.0)
        steps = math.floor((now_s - self.since_s + _ROUNDING_S) / self.sample_s)
        return np.array([min(now_s, self.since_s + steps * self.sample_s)])

    def _positions(self, times: Array, now_s: float, reader: object) -> Array:
        """Positions (k,) [deg or mm] at times (k,) [s] in order."""
        unit = self.of.unit
        samples = unit.seen(now_s, times) if reader is self.of else unit.foreseen().at(times)
        at = self.unit.axes[self.at]
        targets: list[JointTarget] = [
            self.of.resolver.joint_target(joints, external)
            for joints, external in zip(samples.joints, samples.external, strict=True)
        ]
        return np.array([(one.robax if self.unit.is_robot else one.extax)[at] for one in targets])


@value_class(frozen=True, slots=True, eq=False)
class TaskAxisSignals:
    """Implements `language.equipment.AxisSignals`."""

    clock: TaskClock
    cell: Cell
    others: TaskCoordination

    def sample_axis(
        self,
        channel: int,
        unit: MechanicalUnitFacts,
        at: int,
        quantity: AxisQuantity,
        sample_s: float,
    ) -> None:
        """Sample a quantity of an axis from now on."""
        self.clock.note_line()
        now_s = self.clock.synchronise()
        tasks = self.others.all_tasks().values()
        of = next(one for one in tasks if one.task_number == unit.task_number)
        self.cell.sampled[channel] = SampledAxis(of, unit, at, quantity, sample_s, now_s)

    def stop_sampling(self, channel: int) -> None:
        """Stop sampling for a channel."""
        self.clock.note_line()
        self.clock.synchronise()
        self.cell.sampled.pop(channel, None)

    def last_sample(self, channel: int) -> float | None:
        """Value of a channel as sampled last; None for a channel without a signal."""
        self.clock.note_line()
        now_s = self.clock.synchronise()
        signal = self.cell.sampled.get(channel)
        return None if signal is None else signal.value(now_s, self.others)

    def stop_all_sampling(self) -> None:
        """Stop sampling for all channels."""
        self.clock.note_line()
        self.clock.synchronise()
        self.cell.sampled.clear()
