"""Interface of a task's controller to the motion of its robot, alone or in a team."""

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
    """A robot's moves and the decided part of its motion, alone or in a team.

    Every method that plans raises `MotionError` if the path turns out not to be passable.
    """

    @property
    def trajectory(self) -> Trajectory:
        """The robot's motion as far as it is fixed."""
        ...

    @property
    def moves(self) -> MoveLog:
        """All moves the robot ever got."""
        ...

    @property
    def end(self) -> Waypoint:
        """End of the last queued move."""
        ...

    @property
    def version(self) -> int:
        """Changes whenever the planned motion of the robot may change."""
        ...

    @property
    def is_open(self) -> bool:
        """Whether a block of moves is open: its end is not decided."""
        ...

    @property
    def is_halted(self) -> bool:
        """Whether a stop keeps the robot where it is."""
        ...

    @property
    def open_moves(self) -> int:
        """Number of moves of the open block that are not yet travelled."""
        ...

    @property
    def braking_s(self) -> float:
        """More time [s] than the arm needs to stop."""
        ...

    def close(self, corner: CornerKind = CornerKind.STOP) -> float:
        """End the block with a stop; return the command time [s] at which it is reached."""
        ...

    def commit_last_start(self) -> float:
        """Fix the path up to the start of the last move; return its command time [s]."""
        ...

    def commit_ahead(self) -> float | None:
        """Fix what later moves cannot change; return its end [s], or None if there is none."""
        ...

    def nominal_last_start(self) -> float:
        """About when the robot starts the last move [s]: at programmed speeds, without ramps."""
        ...

    def preview(self) -> Trajectory:
        """Trajectory if no further move is queued."""
        ...

    def places_of(self, queued: QueuedMove) -> tuple[float, float] | None:
        """Path positions [m] of start and end of a move of the current block; None for others."""
        ...

    def path_ratio(self, queued: QueuedMove) -> float:
        """Change [m] of the path position per metre that the TCP travels on such a move."""
        ...

    def seen(self, now_s: float, times: Array) -> Samples:
        """The arm at increasing times (k,) [s]; future ones as if no further move is queued.

        A block that is too late to be continued now [s] ends with a stop.
        """
        ...

    def at_past(self, time_s: float) -> Samples:
        """The arm at a time [s] that is past, one sample."""
        ...

    def halt(self, now_s: float, in_s: float = 0.0) -> float:
        """Stop on the path, see `stopping.halt`; return the command time [s] of the standstill."""
        ...

    def resume(self, now_s: float) -> None:
        """Continue from where the robot was stopped."""
        ...

    def leave(self) -> None:
        """Leave the robot in motion; planning ends."""
        ...

    def clear(self) -> None:
        """Discard the remaining path of a robot at rest."""
        ...

    def off_path_reason(self) -> str:
        """Distance from where the path to be resumed was left, as text.

        Empty if the arm is near enough to return by itself.
        """
        ...


def foreseen(queue: MotionQueue) -> Trajectory:
    """Trajectory if no further move is queued, for observers; never raises.

    Falls back to the committed part; the next read of the moves raises the cause.
    """
    with suppress(MotionError):
        return queue.preview()
    return queue.trajectory
