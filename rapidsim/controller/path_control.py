"""Stopping the robot on its path, restarting it, and other paths in between.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "StopMove",
"StartMove", "StorePath", "ClearPath". That a program continues after StopMove when the robot is at
rest is our reading of the examples, which read the position right after it.
"""

from __future__ import annotations

from rapidsim.controller.clock import TaskClock
from rapidsim.controller.interrupts import TaskInterrupts
from rapidsim.controller.motion_state import MotionState
from rapidsim.controller.queue.mechanical_unit import MechanicalUnit
from rapidsim.controller.queue.path_marks import PathMarks
from rapidsim.language.error_numbers import (
    ERR_ALRDY_MOVING,
    ERR_PATH,
    ERR_PATHDIST,
    rapid_error,
)
from rapidsim.language.errors import NotAllowed, RapidError
from rapidsim.motion.timing.braking import PROGRAM_STOP_S
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class TaskPathControl:
    """Implements `language.path_control.PathControl`."""

    clock: TaskClock
    unit: MechanicalUnit
    marks: PathMarks
    interrupts: TaskInterrupts
    state: MotionState

    @property
    def path_level(self) -> float:
        """The path level: 1 plus the number of stored paths."""
        return 1.0 + self.unit.member.level

    def stop_move(self, *, quick: bool = False) -> None:
        """Stop the robot on its path, or as fast as it can; returns when it is at rest."""
        self.clock.note_line()
        now_s = self.clock.resolve_time()
        self.unit.hold()
        if not self.unit.queue.is_halted:
            rest_s = self.unit.halt(now_s, 0.0 if quick else PROGRAM_STOP_S)
            self.clock.pass_time(max(now_s, self.unit.seen_s(rest_s)))
        else:
            # Another task has stopped it, and it may still brake.
            self.clock.pass_time(max(now_s, self.unit.trajectory.duration))

    def fail(self, error: RapidError) -> None:
        """Stop the robot and raise an error where the program waits for it.

        Called by a trap, it raises the error at the statement that the trap interrupts.
        """
        self.stop_move()
        if not self.interrupts.in_trap:
            raise error
        self.clock.fail_later(error)

    def start_move(self) -> None:
        """Restart the robot, and with it the other robots of its team.

        Raises:
            RapidError: ERR_ALRDY_MOVING; ERR_PATHDIST, when it is too far from where it left its
                path.
        """
        self.clock.note_line()
        now_s = self.clock.resolve_time()
        queue = self.unit.queue
        if queue.is_open and not queue.is_halted and self.unit.preview().duration > now_s:
            raise rapid_error(ERR_ALRDY_MOVING, "the robot is moving; nothing stopped it")
        too_far = self.unit.off_path_reason()
        if too_far:
            raise rapid_error(
                ERR_PATHDIST,
                f"the robot is {too_far} away from where it left its path; move it back before "
                "RestoPath",
            )
        is_free = self.unit.release()
        if is_free and not self.unit.held_by_watcher:
            self.unit.resume(now_s)
        self.clock.notify_tasks()

    def is_stopped(self) -> bool:
        """Whether StopMove keeps the robot where it is."""
        return self.unit.queue.is_halted

    def clear_path(self) -> None:
        """Drop the rest of the path of a stopped robot.

        Raises:
            RapidError: ERR_PATH, while the robot moves.
        """
        self.clock.note_line()
        self._require_standstill("ClearPath")
        self.unit.clear()
        self.marks.clear()

    def store_path(self, *, keep_sync: bool = False) -> None:
        """Store the rest of the path and begin a new one.

        In a team, `keep_sync` begins it together with the team; otherwise the robot moves alone.

        Raises:
            RapidError: ERR_PATH, while the robot moves.
        """
        self.clock.note_line()
        if self.state.searches and not self.unit.member.level:
            raise NotAllowed("StorePath in a trap while the robot searches; ISleep the interrupt")
        self._require_standstill("StorePath")
        if self.unit.member.rides:
            raise NotAllowed("StorePath while the robot follows a conveyor; leave it before")
        self.unit.store_path(keep_sync=keep_sync)

    def restore_path(self) -> None:
        """Restore the stored path; the robot continues on it after `start_move`.

        Raises:
            RapidError: ERR_PATH, if no path is stored.
        """
        self.clock.note_line()
        if self.path_level <= 1.0:
            raise rapid_error(ERR_PATH, "RestoPath without StorePath: no path is kept")
        self.clock.bring_to_rest()
        self.unit.restore_path()
        self.clock.notify_tasks()

    def _require_standstill(self, instruction: str) -> None:
        now_s = self.clock.resolve_time()
        if self.unit.queue.is_open and not self.unit.queue.is_halted:
            raise rapid_error(ERR_PATH, f"{instruction} while the robot moves; StopMove first")
        self.clock.pass_time(max(now_s, self.unit.trajectory.duration))
