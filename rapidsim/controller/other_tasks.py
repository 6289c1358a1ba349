"""Services of one task that involve other tasks of its cell: waiting for and reading them.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "WaitSyncTask",
"CRobT", "GetTaskName". That the name at the call identifies a synchronization point is our reading:
the name of its variable.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from rapidsim.controller.cell.cell import Cell
from rapidsim.controller.cell.rendezvous import Rendezvous
from rapidsim.controller.clock import TaskClock
from rapidsim.controller.journal.events import MAX_TIME
from rapidsim.controller.journal.stop_reasons import WaitsForever
from rapidsim.controller.motion_state import MotionState
from rapidsim.controller.moves.resolve import Resolver
from rapidsim.controller.moves.work_object_holders import Holder
from rapidsim.controller.position_reading import PositionReader
from rapidsim.controller.queue.mechanical_unit import MechanicalUnit
from rapidsim.language.data import JointTarget, RobTarget, ToolData, WobjData
from rapidsim.language.equipment import robot_name
from rapidsim.language.error_numbers import (
    ERR_ARGVALERR,
    ERR_NOT_MOVETASK,
    ERR_TASKNAME,
    rapid_error,
)
from rapidsim.motion.configurations.targets import world_from_base_at
from rapidsim.motion.timing.braking import PROGRAM_STOP_S

_ROUNDING_S = 1e-9


@dataclass(slots=True, eq=False)
class TaskCoordination:
    """Implements `language.tasks.TaskService`."""

    clock: TaskClock
    unit: MechanicalUnit
    cell: Cell
    resolver: Resolver
    state: MotionState
    reader: PositionReader
    task_name: str
    has_robot: bool = True
    neighbours: Mapping[str, TaskCoordination] = field(default_factory=dict)
    """The objects of all tasks of the cell, its own included, by folded name."""
    robot_label: str | None = None
    """The name of its robot in the station; None if the station has none."""

    @property
    def task_number(self) -> int:
        """Position of the task in the station, from 1."""
        return 1 + list(self.all_tasks()).index(self.task_name.lower())

    @property
    def robot_number(self) -> int:
        """Position of the task's robot among those of the station, from 1; 0 without a robot."""
        robots = [key for key, one in self.all_tasks().items() if one.has_robot]
        return 1 + robots.index(self.task_name.lower()) if self.has_robot else 0

    @property
    def robot_task(self) -> str:
        """The task whose robot this one uses: itself, or the first task with a robot."""
        with_robot = (one.task_name for one in self.all_tasks().values() if one.has_robot)
        return self.task_name if self.has_robot else next(with_robot, self.task_name)

    def robot_of(self, unit: str) -> TaskCoordination | None:
        """The task whose robot has the name of a mechanical unit; None if none has."""
        wanted = unit.lower()
        return next((one for one in self.all_tasks().values() if one._is_called(wanted)), None)

    def holder(self, unit: str) -> Holder | None:
        """Another robot by the name of its mechanical unit, at its current pose; see `Holders`."""
        other = self.robot_of(unit)
        if other is None or other is self:
            return None
        now_s, robot = self.clock.synchronise(), other.resolver.robot
        path = other.unit.foreseen()
        seen = path.at(np.array([now_s]))
        axes, world_from_base = robot.external, other.resolver.base_from_world.inverse()
        world_from_base = world_from_base_at(axes, world_from_base, seen.external)[0]
        world_from_user = world_from_base @ robot.forward(seen.joints[0])
        moves = now_s < path.duration - _ROUNDING_S or other.unit.member.is_guided
        return Holder(unit, moves, world_from_user)

    def _is_called(self, unit: str) -> bool:
        """Whether its robot has a folded name."""
        if not self.has_robot:
            return False
        return unit in (robot_name(self.robot_number).lower(), (self.robot_label or "").lower())

    def has_task(self, name: str) -> bool:
        """Whether a task of this name is in the run."""
        return name.lower() in self.all_tasks()

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

        Raises:
            RapidError: ERR_ARGVALERR, if the task is not listed or the others list different tasks.
            Stopped: If one of them can never arrive.
        """
        self.clock.note_line()
        self.require_listed(instruction, name, tasks)
        if in_position:
            self.clock.bring_to_rest()
        return self.rendezvous(instruction, name, tasks, max_time) is not None

    def joints_of(self, task: str) -> JointTarget:
        """Current positions of the axes of a task's robot.

        Raises:
            RapidError: ERR_TASKNAME if there is no such task, ERR_NOT_MOVETASK if it has no robot.
        """
        other = self._robot_of(task)
        reading = other.reader.read(self.clock.synchronise())
        return other.resolver.joint_target(reading.joints, reading.external)

    def target_of(self, task: str, tool: ToolData | None, wobj: WobjData | None) -> RobTarget:
        """Current robtarget of a task's robot; None selects the data of its last move.

        Raises:
            RapidError: See `joints_of`.
        """
        other = self._robot_of(task)
        now_s = self.clock.synchronise()
        reading = other.reader.read(now_s)
        tool, wobj = tool or other.state.tool, wobj or other.state.wobj
        place = self.clock.place
        return other.clock.at_time(now_s, lambda: other.reader.target(reading, tool, wobj, place))

    def frames_of(self, task: str) -> tuple[ToolData, WobjData]:
        """Tool and work object of the last move of a task's robot.

        Raises:
            RapidError: See `joints_of`.
        """
        other = self._robot_of(task)
        self.clock.synchronise()
        return other.state.tool, other.state.wobj

    def stop_robots(self, *, every: bool, quick: bool) -> None:
        """Stop the robot to which this task refers, or all; returns when they are at rest."""
        self.clock.note_line()
        now_s = rest_s = self.clock.resolve_time()
        for unit in self._observed_robots(every):
            unit.held_by_task = unit.held_by_task or (
                unit.queue.is_halted and not unit.held_by_watcher
            )
            unit.held_by_watcher = True
            if not unit.queue.is_halted:
                stood_s = unit.halt(now_s, 0.0 if quick else PROGRAM_STOP_S)
                rest_s = max(rest_s, unit.seen_s(stood_s))
        self.clock.notify_tasks()
        self.clock.pass_time(rest_s)

    def start_robots(self, *, every: bool) -> None:
        """Restart the robot this task refers to, or all, except those held by their own tasks."""
        self.clock.note_line()
        now_s = self.clock.resolve_time()
        for unit in self._observed_robots(every):
            unit.held_by_watcher = False
            if unit.queue.is_halted and not unit.held_by_task:
                unit.resume(now_s)
        self.clock.notify_tasks()

    def is_robot_held(self) -> tuple[bool, bool]:
        """Whether its own task holds the robot (own or observed), and whether an observer does."""
        (unit, *_) = self._observed_robots(every=False) or (self.unit,)
        watched = unit.held_by_watcher
        return unit.queue.is_halted and (unit.held_by_task or not watched), watched

    def _observed_robots(self, every: bool) -> list[MechanicalUnit]:
        """The robot to which a task without one refers, or all robots of the cell."""
        meant = self.robot_task
        tasks = self.all_tasks().values()
        return [one.unit for one in tasks if one.has_robot and (every or one.task_name == meant)]

    def stop_robot(self, time_s: float) -> None:
        """Stop the robot at a time [s]: another task has failed, or the run is over."""
        if self.cell.watchdog.has_ended_the_run:
            # Stopping would plan the open part, which may be the cause of the long run time.
            self.unit.leave()
            return
        with self.unit.ending():
            if not self.unit.queue.is_halted:
                self.unit.halt(time_s)

    def rendezvous(
        self, instruction: str, name: str, tasks: Sequence[str], max_time: float | None
    ) -> Rendezvous | None:
        """Wait at a synchronization point; None if `max_time` [s] ran out first."""
        now_s = self.clock.synchronise()
        deadline_s = math.inf if max_time is None else now_s + max_time
        meeting = self.cell.rendezvous.arrive(instruction, name, self.task_name, tasks)
        self.clock.notify_tasks()
        missing = ", ".join(one for one in tasks if one.lower() not in meeting.arrived)
        with self.clock.waiting(missing) as wait:
            while not meeting.is_complete:
                if self.clock.resolve_time() >= deadline_s:
                    self.cell.rendezvous.leave(instruction, meeting, self.task_name)
                    wait.ended_by = MAX_TIME
                    return None
                if not self.clock.await_event(deadline_s):
                    late = ", ".join(one for one in tasks if one.lower() not in meeting.arrived)
                    raise WaitsForever(f"{instruction} {name} waits for {late}, which never comes")
            wait.ended_by = missing
        # Waiting tasks continue in their own order, not after the last to arrive.
        self.clock.synchronise()
        return meeting

    def require_listed(self, instruction: str, name: str, tasks: Sequence[str]) -> None:
        """Refuse a list of tasks that does not include this one.

        Raises:
            RapidError: ERR_ARGVALERR.
        """
        if self.task_name.lower() not in (one.lower() for one in tasks):
            raise rapid_error(
                ERR_ARGVALERR,
                f"{instruction} {name}: {self.task_name} is not in its own list of tasks",
            )

    def all_tasks(self) -> Mapping[str, TaskCoordination]:
        """The objects of all tasks of the cell, its own included, by folded name."""
        return self.neighbours or {self.task_name.lower(): self}

    def _robot_of(self, task: str) -> TaskCoordination:
        other = self.all_tasks().get(task.lower())
        if other is None:
            raise rapid_error(ERR_TASKNAME, f"there is no task {task} in this run")
        if not other.has_robot:
            raise rapid_error(ERR_NOT_MOVETASK, f"the task {task} has no robot")
        return other
