"""What the controller of a task asks of its robot's motion, alone or in step with others."""

from __future__ import annotations

from contextlib import suppress
from typing import Protocol

from rapidsim.controller.moves.executed_move import CornerKind
from rapidsim.controller.moves.queued_move import MotionError, QueuedMove
from rapidsim.controller.queue.move_log import MoveLog
from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.segments import Waypoint
from rapidsim.motion.trajectory.trajectory import Samples, Trajectory


class MotionQueue(Protocol):
    """A robot's moves and how far they are decided, alone or in step with others.

    Whatever plans raises `MotionError` when what is on the path turns out not to be passable.
    """

    @property
    def trajectory(self) -> Trajectory:
        """The robot's motion as far as it is fixed."""
        ...

    @property
    def moves(self) -> MoveLog:
        """All moves the robot was ever given."""
        ...

    @property
    def end(self) -> Waypoint:
        """Where the last queued move ends."""
        ...

    @property
    def version(self) -> int:
        """Changes whenever what the robot will do may change."""
        ...

    @property
    def is_open(self) -> bool:
        """Whether a block of moves waits for its end."""
        ...

    @property
    def is_halted(self) -> bool:
        """Whether a stop keeps the robot where it is."""
        ...

    @property
    def open_moves(self) -> int:
        """How many moves of the open block are still ahead of the robot."""
        ...

    @property
    def braking_s(self) -> float:
        """More time [s] than the arm needs to stop."""
        ...

    def close(self, corner: CornerKind = CornerKind.STOP) -> float:
        """End the block with a stop; the command time [s] at which it is reached."""
        ...

    def commit_last_start(self) -> float:
        """Fix the path up to the start of the last move; the command time [s] of that start."""
        ...

    def commit_ahead(self) -> float | None:
        """Fix what later moves cannot change; until when [s], or None if that is nothing."""
        ...

    def nominal_last_start(self) -> float:
        """About when the robot starts the last move [s]: at programmed speeds, without ramps."""
        ...

    def preview(self) -> Trajectory:
        """What the robot will do if nothing more is said."""
        ...

    def places_of(self, queued: QueuedMove) -> tuple[float, float] | None:
        """Where a move of the current block starts and ends [m] on the preview; None for others."""
        ...

    def path_ratio(self, queued: QueuedMove) -> float:
        """How far [m] the run's place goes on for a metre of the TCP's way on such a move."""
        ...

    def seen(self, now_s: float, times: Array) -> Samples:
        """The arm at times (k,) [s] in order, those to come if nothing more is said.

        A block that it is too late to go on with now [s] ends with a stop.
        """
        ...

    def at_past(self, time_s: float) -> Samples:
        """The arm at a time [s] that is past, one sample."""
        ...

    def halt(self, now_s: float, in_s: float = 0.0) -> float:
        """Stop on the path, see `stopping.halt`; the command time [s] at which the robot stands."""
        ...

    def resume(self, now_s: float) -> None:
        """Let the robot go on from where it was stopped."""
        ...

    def leave(self) -> None:
        """Leave the robot on its way; nothing is planned any more."""
        ...

    def clear(self) -> None:
        """Forget what is left of the path of a robot that stands."""
        ...

    def off_path_reason(self) -> str:
        """How far the arm stands from where it left the path it is to take up, in words.

        Empty where it is near enough to go back there by itself.
        """
        ...


def foreseen(queue: MotionQueue) -> Trajectory:
    """What the robot will do if nothing more is said, for somebody who looks on; never raises.

    Where that cannot be planned, it is what is decided: whoever asks for the moves hears why.
    """
    with suppress(MotionError):
        return queue.preview()
    return queue.trajectory
