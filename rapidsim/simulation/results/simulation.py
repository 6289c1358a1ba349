"""What a run leaves behind: moves, events, the trajectory, findings.

All of it is immutable and a function of program, robot and inputs alone. Times are virtual seconds.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from enum import StrEnum

import numpy as np

from rapidsim.controller.journal.events import Event, ExecutedLine, Unsimulated
from rapidsim.controller.journal.failed_moves import FailedMove
from rapidsim.controller.moves.executed_move import ExecutedMove
from rapidsim.diagnostics import Diagnostic
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.model import MotionModel
from rapidsim.motion.robot.robot import Robot
from rapidsim.motion.trajectory.trajectory import Samples, Trajectory
from rapidsim.simulation.results.persistents import PersistentChange


class End(StrEnum):
    """How a run ended."""

    ENDED = "ended"
    STOPPED = "stopped"
    TIME_LIMIT = "time_limit"
    CYCLE_LIMIT = "cycle_limit"
    ERROR = "error"


@dataclass(frozen=True, slots=True)
class WrittenFile:
    """A file of the home folder that the program wrote."""

    path: str
    size: int


@dataclass(frozen=True, slots=True, eq=False)
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
    """Moves that could not be made."""


@dataclass(frozen=True, slots=True, eq=False)
class Simulation:
    """One run. What is of one robot is that of the first; `robots` has them all."""

    program: tuple[str, ...]
    """Files, as the user named them."""
    robot: Robot
    model: MotionModel
    end: End
    time_s: float
    motion_s: float
    wait_s: float
    path_m: float
    """Travel of the TCP, corners cut."""
    moves: tuple[ExecutedMove, ...]
    events: tuple[Event, ...]
    lines: tuple[ExecutedLine, ...]
    trajectory: Trajectory
    diagnostics: tuple[Diagnostic, ...]
    unsimulated: tuple[Unsimulated, ...]
    home_files: tuple[WrittenFile, ...]
    persistents: tuple[PersistentChange, ...] = ()
    """The persistents that ended with another value than their declarations give them."""
    world_from_base: Transform = field(default_factory=Transform.identity)
    """Where the robot stands, with all external axes at zero."""
    failed_moves: tuple[FailedMove, ...] = ()
    """Moves that could not be made, those that an ERROR handler dealt with included."""
    signal_starts: Mapping[str, float] = field(default_factory=dict)
    """What the declared signals are at the start; those that a run creates start at 0."""
    task: str = "T_ROB1"
    """The task of the first robot."""
    other_robots: tuple[RobotRun, ...] = ()
    """What the robots of further tasks did, in the order of the station file."""

    @property
    def robots(self) -> tuple[RobotRun, ...]:
        """What each robot did, the first one first."""
        first = RobotRun(
            self.task,
            self.robot,
            self.world_from_base,
            self.moves,
            self.lines,
            self.trajectory,
            self.path_m,
            self.failed_moves,
        )
        return (first, *self.other_robots)

    @property
    def all_moves(self) -> tuple[ExecutedMove, ...]:
        """The moves of all robots, robot after robot, with indices that go on from one to the next.

        The moves of robot k begin at `move_offsets[k]`.
        """
        if not self.other_robots:
            return self.moves
        return tuple(
            replace(move, index=offset + move.index)
            for robot, offset in zip(self.robots, self.move_offsets, strict=True)
            for move in robot.moves
        )

    @property
    def move_offsets(self) -> tuple[int, ...]:
        """What is added to the index of a move of each robot where all are listed together."""
        counts = [robot.moves[-1].index + 1 if robot.moves else 0 for robot in self.robots]
        return tuple(sum(counts[:number]) for number in range(len(counts)))

    def sample(self, time_s: float | Array) -> Samples:
        """The arm at one instant or several [s]: joints (k, n), TCP, speed; k is 1 for one."""
        return self.trajectory.at(np.atleast_1d(np.asarray(time_s, dtype=np.float64)))
