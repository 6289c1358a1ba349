"""Result of a run: motion of each robot, end of each task, events, findings.

It is immutable and a function of program, robot and inputs alone. Times are virtual seconds.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import field
from enum import StrEnum
from itertools import accumulate
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from rapidsim.controller.journal.events import ErrorTally, Event, ExecutedLine, Unsimulated, Wait
from rapidsim.controller.journal.failed_moves import FailedMove
from rapidsim.controller.moves.executed_move import ExecutedMove
from rapidsim.controller.moves.executed_moves import ExecutedMoves, moves_of_all
from rapidsim.diagnostics import Diagnostic
from rapidsim.files import InputError, did_you_mean
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.geometry.belts import BeltCourse
from rapidsim.motion.model import MotionModel
from rapidsim.motion.robot.robot import Robot
from rapidsim.motion.trajectory.samples import Samples
from rapidsim.motion.trajectory.trajectory import Trajectory
from rapidsim.simulation.results.persistents import PersistentChange
from rapidsim.station.task_kind import TaskKind
from rapidsim.values import value_class

if TYPE_CHECKING:
    from rapidsim.simulation.results.collisions import Collisions

_AT_REST_S = 5.0
"""Time [s] after a limit within which every stopped arm is at rest."""


class End(StrEnum):
    """Reason for the end of a run."""

    ENDED = "ended"
    STOPPED = "stopped"
    TIME_LIMIT = "time_limit"
    CYCLE_LIMIT = "cycle_limit"
    ERROR = "error"


@value_class(frozen=True, slots=True)
class WrittenFile:
    """A file of the home folder that the program wrote."""

    path: str
    size: int


@value_class(frozen=True, slots=True, eq=False, repr=False)
class RobotRun:
    """Motion of one robot in a run."""

    task: str
    robot: Robot
    world_from_base: Transform
    """Pose of the base, with all external axes at zero."""
    moves: ExecutedMoves
    """Moves; their indices, and those of the samples, count the moves of this robot."""
    lines: Sequence[ExecutedLine]
    trajectory: Trajectory
    path_m: float
    """Travel of the TCP, with corners cut."""
    failed_moves: tuple[FailedMove, ...] = ()
    """Impossible moves, which ended the task."""

    def __repr__(self) -> str:
        """One line."""
        return f"<{self.robot.name[:40]} in {self.task[:40]}: {len(self.moves)} moves>"

    def move(self, index: int) -> ExecutedMove | None:
        """Return the move of an index; None if it was not made, as after a limit."""
        return _move(self.moves, index)

    def sample(self, time_s: float | Array) -> Samples:
        """Samples of the arm at one instant (k = 1) or several [s]: joints (k, n), TCP, speed."""
        return self.trajectory.at(np.atleast_1d(np.asarray(time_s, dtype=np.float64)))


@value_class(frozen=True, slots=True)
class TaskEnd:
    """End of one task, with a robot or without."""

    name: str
    kind: TaskKind
    end: End
    """A background task ends with the run."""
    entry: str = "main"
    """Procedure that it began with."""


@value_class(frozen=True, slots=True, eq=False, repr=False)
class Simulation:
    """A run of one robot or several."""

    program: tuple[str, ...]
    """Files, as the user named them."""
    model: MotionModel
    end: End
    time_s: float
    motion_s: float
    wait_s: float
    robots: tuple[RobotRun, ...]
    """Motion of each robot, at least one, in the order of the station file."""
    tasks: tuple[TaskEnd, ...]
    """Ends of all tasks, also of those without a robot, in the order of the station file."""
    events: tuple[Event, ...]
    diagnostics: tuple[Diagnostic, ...]
    unsimulated: tuple[Unsimulated, ...]
    home_files: tuple[WrittenFile, ...]
    lacked_files: bool = False
    """Whether the program accessed files or folders that the home folder does not have."""
    belts: tuple[BeltCourse, ...] = ()
    """Belts of the cell, in the order of the station file."""
    persistents: tuple[PersistentChange, ...] = ()
    """Persistents whose final values differ from their declarations."""
    waits: tuple[Wait, ...] = ()
    """Waits of all tasks, by start time."""
    collisions: Collisions | None = None
    """Contacts and clearances; None if the station describes no bodies."""
    errors: tuple[ErrorTally, ...] = ()
    """Errors of all tasks, by the time of their first occurrence."""
    signal_starts: Mapping[str, float] = field(default_factory=dict)
    """Initial values of the declared signals; signals that a run creates start at 0."""
    named: str = ""
    """Name of the program by the user, such as a folder; empty if there is none."""
    strict: bool = False
    """Whether any qualification of the verdict fails the run."""

    def __repr__(self) -> str:
        """One line."""
        return f"<simulation: {self.end} after {self.time_s:.3f} s, {len(self.moves)} moves>"

    @property
    def title(self) -> str:
        """Title of the run: as the user named it, else its files."""
        if self.named or not self.program:
            return self.named
        first, *others = (Path(name).name for name in self.program)
        return f"{first} and {len(others)} more" if others else first

    @property
    def skipped(self) -> tuple[Unsimulated, ...]:
        """Routines that no module declares, with how many of their calls were skipped."""
        return tuple(one for one in self.unsimulated if one.is_unknown)

    @property
    def only(self) -> RobotRun:
        """Motion of the only robot.

        Raises:
            InputError: If there are several robots, so that the first is not taken by mistake.
        """
        if len(self.robots) > 1:
            tasks = ", ".join(one.task for one in self.robots)
            cure = f"take one of them, as `robot_of({self.robots[0].task!r})`"
            raise InputError(f"the run has {len(self.robots)} robots, those of {tasks}", cure)
        return self.robots[0]

    def robot_of(self, task: str) -> RobotRun:
        """Return the motion of the robot of a task.

        Raises:
            InputError: If the task moves no robot.
        """
        for one in self.robots:
            if one.task.lower() == task.lower():
                return one
        tasks = [one.task for one in self.robots]
        cure = did_you_mean(task, tasks) or f"the robots are those of {', '.join(tasks)}"
        raise InputError(f"no robot of a task `{task}` is in the run", cure)

    @property
    def moves(self) -> ExecutedMoves:
        """Moves of all robots, robot after robot, numbered consecutively.

        The numbers of `robots[k]` begin at `move_offsets[k]`.
        """
        return numbered_moves(self.robots)

    @property
    def move_offsets(self) -> tuple[int, ...]:
        """Offsets added to the index of a move of each robot in the list of all moves."""
        return _move_offsets(self.robots)

    @property
    def path_m(self) -> float:
        """Travel of the TCPs of all robots, with corners cut."""
        return sum(one.path_m for one in self.robots)

    @property
    def motion_end_s(self) -> float:
        """End [s] of the run or, if a robot comes to rest only later, of its motion.

        If the wall-clock limit cut a run off, the stops of its robots are not planned: motion
        long after the limit is not part of the run.
        """
        end_s = max(self.time_s, *(one.trajectory.duration for one in self.robots))
        return min(end_s, self.time_s + _AT_REST_S) if self.end is End.TIME_LIMIT else end_s

    # For one release: shortcuts for a run of one robot.

    @property
    def task(self) -> str:
        """The task of the only robot."""
        return self.only.task

    @property
    def robot(self) -> Robot:
        """The only robot."""
        return self.only.robot

    @property
    def world_from_base(self) -> Transform:
        """Pose of the only robot's base, with all external axes at zero."""
        return self.only.world_from_base

    @property
    def lines(self) -> Sequence[ExecutedLine]:
        """The lines that the task of the only robot executed."""
        return self.only.lines

    @property
    def trajectory(self) -> Trajectory:
        """The motion of the only robot."""
        return self.only.trajectory

    @property
    def failed_moves(self) -> tuple[FailedMove, ...]:
        """The moves that the only robot could not make."""
        return self.only.failed_moves

    def move(self, index: int) -> ExecutedMove | None:
        """Return the move of an index; None if it was not made, as after a limit."""
        return _move(self.moves, index)

    def sample(self, time_s: float | Array) -> Samples:
        """The only robot at one instant or several [s]."""
        return self.only.sample(time_s)


def numbered_moves(robots: Sequence[RobotRun]) -> ExecutedMoves:
    """Moves of several robots, robot after robot, numbered consecutively."""
    return moves_of_all([one.moves for one in robots], _move_offsets(robots))


def _move(moves: ExecutedMoves, index: int) -> ExecutedMove | None:
    at = int(np.searchsorted(moves.columns.index, index))
    return moves[at] if at < len(moves) and moves.columns.index[at] == index else None


def _move_offsets(robots: Sequence[RobotRun]) -> tuple[int, ...]:
    counts = [int(one.moves.columns.index[-1]) + 1 if one.moves else 0 for one in robots]
    return (0, *accumulate(counts[:-1]))
