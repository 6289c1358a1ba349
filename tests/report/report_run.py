"""A small run made by hand: two moves of the IRB 1600, a corner path failure, texts, a file."""

from typing import cast

import numpy as np

from rapidsim.controller.journal.events import Event, EventKind, Unsimulated
from rapidsim.controller.moves.executed_move import CornerKind, ExecutedMove
from rapidsim.controller.moves.executed_moves import moves_of
from rapidsim.diagnostics import Source, Span
from rapidsim.frames.transform import Array, Transform
from rapidsim.language.data import (
    FINE,
    NO_EXTERNAL_AXES,
    TOOL0,
    WOBJ0,
    ConfData,
    Orient,
    Pos,
    RobTarget,
    SpeedData,
)
from rapidsim.language.moves import Interpolation, Move, Place
from rapidsim.motion.model import MotionModel
from rapidsim.motion.robot.robot import load_robot
from rapidsim.motion.trajectory.command import MotionCommand
from rapidsim.motion.trajectory.samples import Samples
from rapidsim.motion.trajectory.trajectory import Trajectory
from rapidsim.simulation.results.simulation import (
    End,
    RobotRun,
    Simulation,
    TaskEnd,
    WrittenFile,
)
from rapidsim.station.task_kind import TaskKind

TEXT = """MODULE cell
  PROC main()
    MoveJ pHome,v200,fine,tool0;
    MoveL pPick,v200,z10,tGrip\\WObj:=wTable;
    TPWrite "Done";
  ENDPROC
ENDMODULE
"""
SOURCE = Source("cell/cell.mod", TEXT)
ROBOT = load_robot("irb1600-6-1.2")
HOME = np.radians([0.0, 0.0, 0.0, 0.0, 30.0, 0.0])
PICK = np.radians([20.0, 10.0, -5.0, 0.0, 30.0, 197.0])


class StraightTrajectory:
    """All joints evenly from HOME to PICK in two seconds."""

    duration = 2.0

    pieces = ()
    """Nothing of it was planned, so it takes as long with other accelerations."""

    command = MotionCommand()
    has_ramps = False

    def off_path(self, samples: Samples) -> Array:
        return np.zeros(len(samples.times))

    def at(self, times: Array, *, coarse: bool = False) -> Samples:
        share = np.clip(times / self.duration, 0.0, 1.0)
        joints = HOME + share[:, None] * (PICK - HOME)
        move = (times > 0.5).astype(np.int64)
        return Samples(times, move, joints, ROBOT.kinematics.forward(joints), np.zeros(len(times)))


def place(statement: str, **arguments: str) -> Place:
    start = TEXT.index(statement)
    return Place(Span(SOURCE, start, start + len(statement)), "main", arguments)


def executed(
    index: int, place: Place, instruction: str, times: tuple[float, float], corner: CornerKind
) -> ExecutedMove:
    joints = PICK if index else HOME
    target = RobTarget(
        Pos(0.0, 0.0, 0.0),
        Orient(1.0, 0.0, 0.0, 0.0),
        ConfData(0.0, 0.0, 0.0, 0.0),
        NO_EXTERNAL_AXES,
    )
    line = instruction == "MoveL"
    move = Move(
        instruction,
        Interpolation.LINE if line else Interpolation.JOINT,
        target,
        SpeedData(200.0, 500.0, 5000.0, 1000.0),
        FINE,
        TOOL0,
        WOBJ0,
    )
    return ExecutedMove(
        index=index,
        task="T_ROB1",
        move=move,
        place=place,
        corner=corner,
        zone_m=0.0,
        start_s=times[0],
        end_s=times[1],
        length_m=0.1 * (index + 1),
        base_from_tcp=ROBOT.kinematics.forward(joints),
        tcp_from_flange=Transform.identity(),
        joints=joints,
        conf=ConfData(0.0, 0.0, 1.0, 0.0),
    )


def run() -> Simulation:
    moves = (
        executed(
            0,
            place("MoveJ pHome", topoint="pHome", tool="tool0"),
            "MoveJ",
            (0.0, 0.5),
            CornerKind.STOP,
        ),
        executed(
            1,
            place("MoveL pPick", topoint="pPick", tool="tGrip", wobj="wTable"),
            "MoveL",
            (0.5, 2.0),
            CornerKind.STOP_CORNER_PATH_FAILURE,
        ),
    )
    show = place("TPWrite")
    return Simulation(
        program=("cell/cell.mod",),
        model=MotionModel(),
        end=End.ENDED,
        time_s=2.5,
        motion_s=2.0,
        wait_s=0.5,
        robots=(
            RobotRun(
                task="T_ROB1",
                robot=ROBOT,
                world_from_base=Transform.identity(),
                moves=moves_of(moves),
                lines=(),
                trajectory=cast(Trajectory, StraightTrajectory()),
                path_m=0.3,
            ),
        ),
        tasks=(TaskEnd("T_ROB1", TaskKind.NORMAL, End.ENDED),),
        events=(
            Event(
                2.0, "T_ROB1", EventKind.CORNER, moves[1].place, "corner path failure", {"move": 1}
            ),
            Event(2.1, "T_ROB1", EventKind.INTERRUPT, show, "timer", {"interrupt": 1.0}),
            Event(2.2, "T_ROB1", EventKind.TEXT, show, "Done \x1b[31m"),
        ),
        diagnostics=(),
        unsimulated=(Unsimulated("ArcL", 3, "treated as MoveL"),),
        home_files=(WrittenFile("cell.home/log.txt", 12),),
    )
