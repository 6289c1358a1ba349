"""System outputs for the standstill of a robot."""

from __future__ import annotations

import math
from functools import cached_property
from typing import ClassVar, Final

from rapidsim.controller.cell.cell import Cause, Cell
from rapidsim.controller.cell.description import Status
from rapidsim.controller.journal.journal import Instant, Moment
from rapidsim.controller.moves.queued_move import MotionError
from rapidsim.controller.other_tasks import TaskCoordination
from rapidsim.controller.queue.mechanical_unit import MechanicalUnit
from rapidsim.motion.trajectory.trajectory import Trajectory

_ROUNDING_S: Final = 1e-9


class StandstillOutputs:
    """Outputs for the robot of one task: a `event_source.EventSource`.

    A guided robot moves as long as it is guided.
    """

    on_path: ClassVar = True

    def __init__(
        self, unit: MechanicalUnit, cell: Cell, coordination: TaskCoordination, cause: Cause
    ) -> None:
        """Start with a robot at rest, or that still comes to rest after the previous program."""
        self._unit, self._cell, self._others, self._cause = unit, cell, coordination, cause
        self._moves = unit.trajectory.duration > 0.0
        self._stood_s = 0.0
        """Time [s] at which it last came to rest."""

    @cached_property
    def _signals(self) -> tuple[str, ...]:
        # Computed late: at construction the tasks do not know each other yet.
        return tuple(
            one.name
            for one in self._cell.declared
            if one.status is Status.UNIT_NOT_MOVING
            and self._others.robot_of(one.unit) is self._others
        )

    def _ends_s(self) -> float:
        """Time [s] at which the robot is at rest if no further move is queued."""
        if self._unit.member.guided is not None:
            return math.inf
        return self._preview().duration

    def _preview(self) -> Trajectory:
        """Motion if no further move is queued; its fixed part if a move cannot be made."""
        try:
            return self._unit.preview()
        except MotionError:
            return self._unit.trajectory

    def _starts_s(self) -> float:
        """Time [s] at which the robot first moves after it last came to rest."""
        path = self._preview()
        starts = *(one.start_time for one in path.pieces), *(one.start_s for one in path.guided)
        after = (start_s for start_s in starts if start_s >= self._stood_s - _ROUNDING_S)
        return min(after, default=self._stood_s)

    def next_s(self) -> float | None:
        """Time [s] at which the robot starts or comes to rest; None if neither is planned."""
        if not self._signals:
            return None
        ends_s = self._ends_s()
        if self._moves:
            return None if math.isinf(ends_s) else ends_s
        return self._starts_s() if ends_s > self._stood_s + _ROUNDING_S else None

    def dispatch_next(self, passed_s: float, until_s: float) -> float:
        """Write the signals; see `event_source.EventSource`."""
        del until_s
        time_s = max(self.next_s() or 0.0, passed_s)
        self._write(time_s)
        return time_s

    def program_stopped(self) -> None:
        """Schedule the signals for when the robot comes to rest, after the task stopped polling."""
        ends_s = self._ends_s() if self._signals else 0.0
        if self._stood_s + _ROUNDING_S < ends_s < math.inf:
            self._cell.happen(ends_s, self._write)

    def _write(self, time_s: float) -> None:
        ends_s = self._ends_s()
        self._moves = ends_s > time_s + _ROUNDING_S
        if not self._moves:
            self._stood_s = max(time_s, ends_s)
        moment = Moment(Instant(time_s))
        for name in self._signals:
            self._cell.set_signal(self._cause, moment, name, float(not self._moves))

    def advance_to(self, time_s: float) -> None:
        """Do nothing: the path determines when the robot moves."""
