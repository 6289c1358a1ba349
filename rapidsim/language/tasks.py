"""What a task may ask of the other tasks of its cell; part of the controller's protocols."""

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
        """Place of the task in the station, from 1."""
        ...

    @property
    def robot_number(self) -> int:
        """Place of the task's robot among those of the station, from 1; 0 without a robot."""
        ...

    @property
    def robot_task(self) -> str:
        """Name of the task whose robot this one reads: its own, or the first that has one."""
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
        """Wait at a synchronization point until some tasks are there, this one among them.

        Args:
            instruction: Points of different instructions never meet.
            name: Of the point.
            tasks: Names of all that must come.
            max_time: So long [s] at most.
            in_position: First let the robot come to rest.

        Returns:
            False if `max_time` ran out first.
        """
        ...

    def joints_of(self, task: str) -> JointTarget:
        """Where the axes of another task's robot are now.

        Raises:
            RapidError: ERR_TASKNAME if there is no such task, ERR_NOT_MOVETASK if it has no robot.
        """
        ...

    def target_of(self, task: str, tool: ToolData | None, wobj: WobjData | None) -> RobTarget:
        """Where the TCP of another task's robot is now; None takes what its last move used.

        Raises:
            RapidError: See `joints_of`.
        """
        ...

    def stop_robots(self, *, every: bool, quick: bool) -> None:
        """Stop the robot that a task without one watches, or all; returns when they stand."""
        ...

    def start_robots(self, *, every: bool) -> None:
        """Let the robot that a task without one watches go on, or all."""
        ...

    def is_robot_held(self) -> tuple[bool, bool]:
        """Whether the robot's own task keeps it where it is, and whether one that watches does."""
        ...


class SyncMoves(Protocol):
    """Moving together with the robots of other tasks."""

    @property
    def team(self) -> tuple[str, ...]:
        """Names of the tasks that move together, this one among them; empty while it is alone."""
        ...

    def sync_move_on(
        self, name: str, tasks: Sequence[str], *, max_time: float | None = None
    ) -> bool:
        """Wait for some tasks at a stop point; from there their robots move together."""
        ...

    def sync_move_off(self, name: str, *, max_time: float | None = None) -> bool:
        """Wait for the tasks that move together at a stop point; from there each moves alone."""
        ...

    def leave_team(self) -> None:
        """Let all robots of the team move alone, without waiting for any of them."""
        ...

    def suspend_team(self) -> None:
        """Move alone until `resume_team`."""
        ...

    def resume_team(self) -> None:
        """Move together again."""
        ...
