"""The servo gripper of a task's robot: fingers that move in virtual time."""

from __future__ import annotations

import math

from rapidsim.controller.cell.cell import Cell
from rapidsim.controller.cell.finger_motion import Fingers
from rapidsim.controller.clock import TaskClock
from rapidsim.values import value_class

_HOLDS_S = 1e-3
"""Time [s] for which the position of moving fingers counts as unchanged."""


@value_class(frozen=True, slots=True)
class TaskSmartGripper:
    """Implements `language.equipment.SmartGripper`."""

    clock: TaskClock
    cell: Cell
    task: str

    @property
    def object_mm(self) -> float | None:
        """Position [mm] at which closing fingers meet an object; None if it is unknown."""
        return self._fingers.object_mm

    @property
    def limit_mm(self) -> float:
        """Position [mm] to which the fingers open at most."""
        return self._fingers.limit_mm

    def adjust(
        self,
        *,
        speed_mm_s: float | None = None,
        force_n: float | None = None,
        limit_mm: float | None = None,
    ) -> None:
        """Change the settings that are not None."""
        self.clock.note_line()
        fingers = self._fingers
        fingers.speed_mm_s = fingers.speed_mm_s if speed_mm_s is None else speed_mm_s
        fingers.force_n = fingers.force_n if force_n is None else force_n
        fingers.limit_mm = fingers.limit_mm if limit_mm is None else limit_mm

    def move_fingers(self, to_mm: float) -> None:
        """Begin to move the fingers to a position [mm]."""
        self.clock.note_line()
        self._fingers.move(to_mm, self.clock.resolve_time())

    def stop_fingers(self) -> None:
        """Stop the fingers where they are."""
        self.clock.note_line()
        self._fingers.stop(self.clock.resolve_time())

    def await_fingers(self) -> None:
        """Wait until the fingers are at rest."""
        now_s = self.clock.resolve_time()
        with self.clock.waiting("the gripper") as wait:
            while now_s < self._fingers.rest_s:
                self.clock.pass_time(self._fingers.rest_s)
                now_s = self.clock.resolve_time()
            wait.ended_by = "the gripper"

    def finger_position(self) -> float:
        """Position [mm] of the fingers."""
        return self._fingers.position(self._look())

    def finger_speed(self) -> float:
        """Speed [mm/s] of the fingers."""
        return self._fingers.speed(self._look())

    @property
    def _fingers(self) -> Fingers:
        return self.cell.fingers_of(self.task)

    def _look(self) -> float:
        self.clock.note_line()
        now_s = self.clock.resolve_time()
        is_moving = now_s < self._fingers.rest_s
        self.clock.hold_until(now_s + _HOLDS_S if is_moving else math.inf)
        return now_s
