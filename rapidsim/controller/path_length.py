"""The counter of the path that the TCP of a task's robot travels."""

from __future__ import annotations

from dataclasses import dataclass

from rapidsim.controller.clock import TaskClock
from rapidsim.controller.queue.mechanical_unit import MechanicalUnit
from rapidsim.motion.trajectory.trajectory import Mark


@dataclass(slots=True, eq=False)
class TaskPathLength:
    """Implements `language.path_control.PathLength`."""

    clock: TaskClock
    unit: MechanicalUnit
    _length_m: float = 0.0
    _counted: Mark | None = None
    """The mark up to which the path is counted; None while the counter is off."""

    def switch_on(self) -> None:
        """Count from here on."""
        self._counted = self._count_to_now()

    def switch_off(self) -> None:
        """Stop counting."""
        self._count_to_now()
        self._counted = None

    def reset(self) -> None:
        """Set the counter to 0."""
        self._count_to_now()
        self._length_m = 0.0

    def length(self) -> float:
        """Value [mm] of the counter."""
        self._count_to_now()
        return self._length_m * 1e3

    def count_to(self, time_s: float) -> None:
        """Count the path up to a time [s] that has passed."""
        if self._counted is not None and time_s > self._counted.time_s:
            self._count(time_s)

    def _count(self, time_s: float) -> Mark:
        is_decided = time_s <= self.unit.trajectory.command_end
        trajectory = self.unit.trajectory if is_decided else self.unit.preview()
        mark = trajectory.mark(time_s)
        if self._counted is not None:
            self._length_m += trajectory.travelled_between(self._counted, mark)
            self._counted = mark
        return mark

    def _count_to_now(self) -> Mark:
        self.clock.note_line()
        return self._count(self.clock.resolve_time())
