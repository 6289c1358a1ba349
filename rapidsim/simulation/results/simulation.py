"""What a run leaves behind: what each robot did, how each task ended, events, findings.

All of it is immutable and a function of program, robot and inputs alone. Times are virtual seconds.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Mapping, Sequence
from dataclasses import field, replace
from enum import StrEnum
from itertools import accumulate
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from rapidsim.controller.journal.events import ErrorTally, Event, ExecutedLine, Unsimulated, Wait
from rapidsim.controller.journal.failed_moves import FailedMove
from rapidsim.controller.moves.executed_move import ExecutedMove
from rapidsim.diagnostics import Diagnostic
from rapidsim.files import InputError, did_you_mean
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.model import MotionModel
from rapidsim.motion.robot.robot import Robot
from rapidsim.motion.trajectory.trajectory import Samples, Trajectory
from rapidsim.simulation.results.persistents import PersistentChange
from rapidsim.station.task_kind import TaskKind
from rapidsim.values import value_class

if TYPE_CHECKING:
    from rapidsim.simulation.results.collisions import Collisions

_AT_REST_S = 5.0
"""So long [s] after a limit every arm stands that was stopped there."""


class End(StrEnum):
    """How a run ended."""

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
    """What one robot did in a run."""

    task: str
    robot: Robot
    world_from_base: Transform
    """Where it stands, with all external axes at zero."""
    moves: tuple[ExecutedMove, ...]
    """Their indices, and those of its samples, count the moves of this robot."""
    lines: tuple[ExecutedLine, ...]
    trajectory: Trajectory
    path_m: float
    """Travel of the TCP, corners cut."""
    failed_moves: tuple[FailedMove, ...] = ()
    """Moves that could not be made; they ended the task."""

    def __repr__(self) -> str:
        """One line."""
        return f"<{self.robot.name[:40]} in {self.task[:40]}: {len(self.moves)} moves>"

    def move(self, index: int) -> ExecutedMove | None:
        """The move of an index; None where it was not made, as after a limit."""
        at = bisect_left(self.moves, index, key=lambda made: made.index)
        return self.moves[at] if at < len(self.moves) and self.moves[at].index == index else None

    def sample(self, time_s: float | Array) -> Samples:
        """The arm at one instant or several [s]: joints (k, n), TCP, speed; k is 1 for one."""
        return self.trajectory.at(np.atleast_1d(np.asarray(time_s, dtype=np.float64)))


@value_class(frozen=True, slots=True)
class TaskEnd:
    """How one task ended, be it that of a robot or not."""

    name: str
    kind: TaskKind
    end: End
    """One of the background ends with the run."""
    entry: str = "main"
    """The procedure it began with."""


@value_class(frozen=True, slots=True, eq=False, repr=False)
class Simulation:
    """One run of one robot or several."""

    program: tuple[str, ...]
    """Files, as the user named them."""
    model: MotionModel
    end: End
    time_s: float
    motion_s: float
    wait_s: float
    robots: tuple[RobotRun, ...]
    """What each robot did, one at least, in the order of the station file."""
    tasks: tuple[TaskEnd, ...]
    """All tasks, those without a robot too, in the order of the station file."""
    events: tuple[Event, ...]
    diagnostics: tuple[Diagnostic, ...]
    unsimulated: tuple[Unsimulated, ...]
    home_files: tuple[WrittenFile, ...]
    lacked_files: bool = False
    """Whether the program asked for files or folders that the home folder does not have."""
    persistents: tuple[PersistentChange, ...] = ()
    """The persistents that ended with another value than their declarations give them."""
    waits: tuple[Wait, ...] = ()
    """Of all tasks, in order of their starts."""
    collisions: Collisions | None = None
    """What bodies touched; None where the station says nothing of bodies."""
    errors: tuple[ErrorTally, ...] = ()
    """Of all tasks, in order of their first times."""
    signal_starts: Mapping[str, float] = field(default_factory=dict)
    """What the declared signals are at the start; those that a run creates start at 0."""
    named: str = ""
    """What the user named, such as a folder; empty where nobody said."""
    strict: bool = False
    """Whether any qualification of the verdict fails the run."""

    def __repr__(self) -> str:
        """One line."""
        return f"<simulation: {self.end} after {self.time_s:.3f} s, {len(self.moves)} moves>"

    @property
    def title(self) -> str:
        """What the run is called: as the user named it, else by its files."""
        if self.named or not self.program:
            return self.named
        first, *others = (Path(name).name for name in self.program)
        return f"{first} and {len(others)} more" if others else first

    @property
    def skipped(self) -> tuple[Unsimulated, ...]:
        """The routines that no module declares, with how many of their calls were skipped."""
        return tuple(one for one in self.unsimulated if one.is_unknown)

    @property
    def only(self) -> RobotRun:
        """What the robot did.

        Raises:
            InputError: Where there are several: nobody takes the first by mistake.
        """
        if len(self.robots) > 1:
            tasks = ", ".join(one.task for one in self.robots)
            cure = f"take one of them, as `robot_of({self.robots[0].task!r})`"
            raise InputError(f"the run has {len(self.robots)} robots, those of {tasks}", cure)
        return self.robots[0]

    def robot_of(self, task: str) -> RobotRun:
        """What the robot of a task did.

        Raises:
            InputError: If the task moves none.
        """
        for one in self.robots:
            if one.task.lower() == task.lower():
                return one
        tasks = [one.task for one in self.robots]
        cure = did_you_mean(task, tasks) or f"the robots are those of {', '.join(tasks)}"
        raise InputError(f"no robot of a task `{task}` is in the run", cure)

    @property
    def moves(self) -> tuple[ExecutedMove, ...]:
        """The moves of all robots, robot after robot, numbered through.

        Those of `robots[k]` begin with the number `move_offsets[k]`.
        """
        return numbered_moves(self.robots)

    @property
    def move_offsets(self) -> tuple[int, ...]:
        """What is added to the index of a move of each robot where all are listed together."""
        return _move_offsets(self.robots)

    @property
    def path_m(self) -> float:
        """Travel of the TCPs of all robots, corners cut."""
        return sum(one.path_m for one in self.robots)

    @property
    def motion_end_s(self) -> float:
        """The end of the run or, where a robot is still coming to rest then, of its motion.

        A run that the computer's clock cut off has not planned how its robots come to rest: what
        they would go on doing is no part of it.
        """
        end_s = max(self.time_s, *(one.trajectory.duration for one in self.robots))
        return min(end_s, self.time_s + _AT_REST_S) if self.end is End.TIME_LIMIT else end_s

    # For one release: what a run of one robot could be asked itself.

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
        """Where the only robot stands, with all external axes at zero."""
        return self.only.world_from_base

    @property
    def lines(self) -> tuple[ExecutedLine, ...]:
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
        """The move of an index; None where it was not made, as after a limit."""
        at = bisect_left(self.moves, index, key=lambda made: made.index)
        return self.moves[at] if at < len(self.moves) and self.moves[at].index == index else None

    def sample(self, time_s: float | Array) -> Samples:
        """The only robot at one instant or several [s]."""
        return self.only.sample(time_s)


def numbered_moves(robots: Sequence[RobotRun]) -> tuple[ExecutedMove, ...]:
    """The moves of some robots, robot after robot, with indices that go on from one to the next."""
    if len(robots) == 1:
        return robots[0].moves
    return tuple(
        replace(move, index=offset + move.index)
        for one, offset in zip(robots, _move_offsets(robots), strict=True)
        for move in one.moves
    )


def _move_offsets(robots: Sequence[RobotRun]) -> tuple[int, ...]:
    counts = [one.moves[-1].index + 1 if one.moves else 0 for one in robots]
    return (0, *accumulate(counts[:-1]))
