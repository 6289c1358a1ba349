"""Services that involve other tasks of the cell; part of the controller's protocols."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from rapidsim.language.data import JointTarget, RobTarget, ToolData, WobjData


class TaskService(Protocol):
    """The other tasks of the cell."""

    @property
    def task_name(self) -> str:
        """Name of the task."""
        ...

    @property
    def task_number(self) -> int:
        """Position of the task in the station, from 1."""
        ...

    @property
    def robot_number(self) -> int:
        """Position of the task's robot among all robots, from 1; 0 without a robot."""
        ...

    @property
    def robot_task(self) -> str:
        """Name of the task whose robot this one uses: its own, or the first task with a robot."""
        ...

    def has_task(self, name: str) -> bool:
        """Whether a task of this name is in the run."""
        ...

    def frames_of(self, task: str) -> tuple[ToolData, WobjData]:
        """Tool and work object of the last move of a task's robot.

        Raises:
            RapidError: ERR_TASKNAME if there is no such task, ERR_NOT_MOVETASK if it has no robot.
        """
        ...

    def meet(
        self,
        instruction: str,
        name: str,
        tasks: Sequence[str],
        *,
        max_time: float | None = None,
        in_position: bool = False,
    ) -> bool:
        """Wait at a synchronization point until all listed tasks, including this one, have arrived.

        Args:
            instruction: Points of different instructions are different.
            name: Of the point.
            tasks: Names of all tasks that must arrive.
            max_time: Maximum time [s]; None for no limit.
            in_position: Whether to bring the robot to rest first.

        Returns:
            False if `max_time` ran out first.
        """
        ...

    def joints_of(self, task: str) -> JointTarget:
        """Current positions of the axes of another task's robot.

        Raises:
            RapidError: ERR_TASKNAME if there is no such task, ERR_NOT_MOVETASK if it has no robot.
        """
        ...

    def target_of(self, task: str, tool: ToolData | None, wobj: WobjData | None) -> RobTarget:
        """Current robtarget of another task's robot; None selects the data of its last move.

        Raises:
            RapidError: See `joints_of`.
        """
        ...

    def stop_robots(self, *, every: bool, quick: bool) -> None:
        """Stop the robot a task without one refers to, or all; returns when they are at rest."""
        ...

    def start_robots(self, *, every: bool) -> None:
        """Restart the robot to which a task without one refers, or all."""
        ...

    def is_robot_held(self) -> tuple[bool, bool]:
        """Whether the robot's own task holds it, and whether an observing task does."""
        ...


class SyncMoves(Protocol):
    """Synchronized motion with the robots of other tasks."""

    @property
    def team(self) -> tuple[str, ...]:
        """Names of the tasks of the team, this one included; empty while it moves alone."""
        ...

    def sync_move_on(
        self, name: str, tasks: Sequence[str], *, max_time: float | None = None
    ) -> bool:
        """Wait for some tasks at a stop point; from there their robots form a team."""
        ...

    def sync_move_off(self, name: str, *, max_time: float | None = None) -> bool:
        """Wait for the tasks of the team at a stop point; from there each moves alone."""
        ...

    def leave_team(self) -> None:
        """Let all robots of the team move alone, without waiting for any of them."""
        ...

    def suspend_team(self) -> None:
        """Move alone until `resume_team`."""
        ...

    def resume_team(self) -> None:
        """Join the suspended team again."""
        ...
