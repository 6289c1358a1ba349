"""A small run, made by hand: what recordings are tested on, whatever the simulation does.

The trajectory is exact geometry with an easy timing: each move starts and ends at rest, or passes
its end on a rounded corner.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from changed_run import with_robot

from rapidsim.controller.journal.events import Event, EventKind, ExecutedLine
from rapidsim.controller.moves.executed_move import CornerKind, ExecutedMove
from rapidsim.controller.moves.executed_moves import moves_of
from rapidsim.diagnostics import Diagnostic, Source, Span
from rapidsim.findings.runs import RoutineNotSimulated
from rapidsim.frames.transform import Array, Transform, slerp
from rapidsim.language.data import (
    FINE,
    LOAD0,
    NO_EXTERNAL_AXES,
    ConfData,
    Orient,
    Pos,
    Pose,
    RobTarget,
    SpeedData,
    ToolData,
    WobjData,
    ZoneData,
)
from rapidsim.language.moves import Interpolation, Move, Place
from rapidsim.motion.configurations import targets
from rapidsim.motion.model import MotionModel
from rapidsim.motion.robot.robot import Robot, load_robot
from rapidsim.motion.trajectory.command import MotionCommand, Piece
from rapidsim.motion.trajectory.samples import Samples
from rapidsim.motion.trajectory.trajectory import Trajectory
from rapidsim.simulation.results.simulation import End, RobotRun, Simulation, TaskEnd
from rapidsim.station.task_kind import TaskKind

TEXT = r"""MODULE Frame
  ! Traces a rectangle with a pen and switches a pump.
  PERS tooldata tPen:=[TRUE,[[-60,0,220],[1,0,0,0]],[0.5,[50,0,50],[1,0,0,0],0,0,0]];
  PERS wobjdata wTable:=[FALSE,TRUE,"",[[560,0,250],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];

  PROC main()
    TPWrite "Frame: start";
    MoveJ pAbove, v500, fine, tPen\WObj:=wTable;
    SetDO doPump, 1;
    FOR i FROM 1 TO 2 DO
      MoveL p1, v300, z20, tPen\WObj:=wTable;
      MoveL p2, v300, z20, tPen\WObj:=wTable;
      MoveC pArc, p3, v200, z20, tPen\WObj:=wTable;
      MoveL p4, v300, z20, tPen\WObj:=wTable;
    ENDFOR
    MoveL pAbove, v500, fine, tPen\WObj:=wTable;
    SetDO doPump, 0;
    WaitTime 1;
    TPWrite "Frame: done";
  ENDPROC
ENDMODULE
"""
SOURCE = Source("cell/Frame.mod", TEXT)

PEN = ToolData(True, Pose(Pos(-60.0, 0.0, 220.0), Orient(1.0, 0.0, 0.0, 0.0)), LOAD0)
TABLE = WobjData(
    False,
    True,
    "",
    Pose(Pos(560.0, 0.0, 250.0), Orient(1.0, 0.0, 0.0, 0.0)),
    Pose(Pos(0.0, 0.0, 0.0), Orient(0.9659258, 0.0, 0.0, 0.2588190)),
)
DOWN = Orient(0.0, 0.0, 1.0, 0.0)
Z20 = ZoneData(False, 20.0, 30.0, 30.0, 3.0, 30.0, 3.0)
PLACES = {
    "pAbove": (0.0, 0.0, 220.0),
    "p1": (-120.0, -160.0, 0.0),
    "p2": (120.0, -160.0, 0.0),
    "pArc": (200.0, 0.0, 0.0),
    "p3": (120.0, 160.0, 0.0),
    "p4": (-120.0, 160.0, 0.0),
}
ROUND = ("p1", "p2", "p3", "p4")
START_DEG = (0.0, -20.0, 20.0, 0.0, 60.0, 0.0)


def place(needle: str, **arguments: str) -> Place:
    """The statement that a text of the program begins."""
    start = TEXT.index(needle)
    return Place(Span(SOURCE, start, TEXT.index(";", start) + 1), "main", arguments)


@dataclass(frozen=True, slots=True, eq=False)
class Leg:
    """A move with its time and where it starts."""

    executed: ExecutedMove
    start_joints: Array
    start: Transform


class EasyTrajectory(Trajectory):
    """Legs one after another, each with a smooth start and end."""

    def __init__(self, robot: Robot, legs: Sequence[Leg], end_s: float) -> None:
        self.robot = robot
        self.legs = legs
        self.end_s = end_s

    @property
    def command(self) -> MotionCommand:
        return MotionCommand()

    @property
    def duration(self) -> float:
        return self.end_s

    @property
    def pieces(self) -> tuple[Piece, ...]:
        return ()

    def off_path(self, samples: Samples) -> Array:
        return np.zeros(len(samples.times))

    def at(self, times: Array, *, coarse: bool = False) -> Samples:
        times = np.asarray(times, dtype=np.float64)
        starts = [leg.executed.start_s for leg in self.legs]
        index = np.maximum(np.searchsorted(starts, times, side="right") - 1, 0)
        joints, speeds = np.empty((len(times), 6)), np.empty(len(times))
        tool = Transform(np.empty((len(times), 3, 3)), np.empty((len(times), 3)))
        for number in np.unique(index).tolist():
            on_leg, leg = index == number, self.legs[number]
            joints[on_leg], speeds[on_leg] = self._along(leg, times[on_leg])
            tcp_from_flange = leg.executed.tcp_from_flange.inverse()
            tool.rotation[on_leg] = tcp_from_flange.rotation
            tool.translation[on_leg] = tcp_from_flange.translation
        tcp = self.robot.kinematics.forward(joints) @ tool
        return Samples(times, index, joints, tcp, speeds)

    def _along(self, leg: Leg, times: Array) -> tuple[Array, Array]:
        """Joints (k, n) and speeds (k,) on a leg."""
        move = leg.executed
        span = max(move.end_s - move.start_s, 1e-9)
        u = np.clip((times - move.start_s) / span, 0.0, 1.0)
        share = 3.0 * u * u - 2.0 * u**3
        speed = 6.0 * u * (1.0 - u) / span * move.length_m
        if move.move.interpolation is Interpolation.JOINT:
            return leg.start_joints + share[:, None] * (move.joints - leg.start_joints), speed
        end = move.base_from_tcp
        quaternion = slerp(leg.start.quaternion, end.quaternion, share)
        line = leg.start.translation + share[:, None] * (end.translation - leg.start.translation)
        pose = Transform.from_quaternion(quaternion, line) @ move.tcp_from_flange
        kinematics = self.robot.kinematics
        branch = int(kinematics.branch_of(move.joints))
        followed = kinematics.inverse_on_branch(pose, branch, move.joints)
        assert followed.exists.all()
        return followed.joints, speed


def cell(robot: Robot | None = None, *, rounds: int = 2) -> Simulation:
    """A run of the program above."""
    robot = robot or load_robot("irb1600-6-1.2")
    names = ["pAbove", *ROUND * rounds, "pAbove"]
    legs: list[Leg] = []
    joints = np.radians(START_DEG)
    tcp_from_flange = targets.tcp_from_flange(PEN)
    pose = robot.kinematics.forward(joints) @ tcp_from_flange.inverse()
    now = 0.2
    for index, name in enumerate(names):
        leg = _leg(robot, legs, index, name, joints, pose, now, last=index == len(names) - 1)
        legs.append(leg)
        joints, pose, now = leg.executed.joints, leg.executed.base_from_tcp, leg.executed.end_s
        if index == 0:
            now += 0.3
    moves = tuple(leg.executed for leg in legs)
    end_s = now + 1.0
    return Simulation(
        program=("cell/Frame.mod",),
        model=MotionModel(),
        end=End.ENDED,
        time_s=end_s,
        motion_s=sum(move.end_s - move.start_s for move in moves),
        wait_s=1.5,
        robots=(
            RobotRun(
                task="T_ROB1",
                robot=robot,
                world_from_base=Transform.identity(),
                moves=moves_of(moves),
                lines=_lines(moves),
                trajectory=EasyTrajectory(robot, legs, end_s),
                path_m=sum(move.length_m for move in moves),
            ),
        ),
        tasks=(TaskEnd("T_ROB1", TaskKind.NORMAL, End.ENDED),),
        events=_events(moves, end_s),
        diagnostics=(
            Diagnostic(RoutineNotSimulated("MoveL \\Corr", "ignored"), moves[1].place.span),
        ),
        unsimulated=(),
        home_files=(),
    )


def _leg(
    robot: Robot,
    legs: Sequence[Leg],
    index: int,
    name: str,
    joints: Array,
    pose: Transform,
    start_s: float,
    *,
    last: bool,
) -> Leg:
    fine = index == 0 or last
    instruction = "MoveJ" if index == 0 else "MoveL"
    to = RobTarget(Pos(*PLACES[name]), DOWN, ConfData(0, 0, 0, 0), NO_EXTERNAL_AXES)
    speed = SpeedData(500.0 if fine else 300.0, 500.0, 5000.0, 1000.0)
    interpolation = Interpolation.JOINT if index == 0 else Interpolation.LINE
    zone = FINE if fine else Z20
    move = Move(instruction, interpolation, to, speed, zone, PEN, TABLE)
    base_from_tcp = targets.base_from_tcp(to, TABLE, Transform.identity())
    tcp_from_flange = targets.tcp_from_flange(PEN)
    flange = base_from_tcp @ tcp_from_flange
    batch = Transform(flange.rotation[None], flange.translation[None])
    followed = robot.kinematics.inverse_on_branch(
        batch, int(robot.kinematics.branch_of(joints)), joints
    )
    assert followed.exists.all()
    length = float(np.linalg.norm(base_from_tcp.translation - pose.translation))
    needle = f"MoveC pArc, {name}" if name == "p3" else f"{instruction} {name}"
    executed = ExecutedMove(
        index=index,
        task="T_ROB1",
        move=move,
        place=place(needle, topoint=name, tool="tPen", wobj="wTable"),
        corner=CornerKind.STOP if fine else CornerKind.FLY_BY,
        zone_m=0.0 if fine else 0.02,
        start_s=start_s,
        end_s=start_s + length / (0.0007 * speed.v_tcp),
        length_m=length,
        base_from_tcp=base_from_tcp,
        tcp_from_flange=tcp_from_flange,
        joints=followed.joints[0],
        conf=ConfData(0, 0, 0, 0),
    )
    return Leg(executed, joints, pose)


def _events(moves: Sequence[ExecutedMove], end_s: float) -> tuple[Event, ...]:
    def event(
        time_s: float, kind: EventKind, needle: str, message: str, **details: object
    ) -> Event:
        return Event(time_s, "T_ROB1", kind, place(needle), message, details)

    on, off = moves[0].end_s, moves[-1].end_s
    pump = {"signal": "doPump"}
    return (
        event(0.0, EventKind.TEXT, 'TPWrite "Frame: start"', "Frame: start"),
        event(0.0, EventKind.SIGNAL, "SetDO doPump, 0", "doPump = 0", **pump, value=0.0),
        event(on, EventKind.SIGNAL, "SetDO doPump, 1", "doPump = 1", **pump, value=1.0),
        event(moves[2].end_s, EventKind.CORNER, "MoveL p2", "corner path failure at p2", move=2),
        event(off, EventKind.SIGNAL, "SetDO doPump, 0", "doPump = 0", **pump, value=0.0),
        event(end_s, EventKind.TEXT, 'TPWrite "Frame: done"', "Frame: done"),
    )


def _lines(moves: Sequence[ExecutedMove]) -> tuple[ExecutedLine, ...]:
    """The program pointer is a move ahead of the robot."""
    ahead = [
        ExecutedLine(moves[max(move.index - 1, 0)].start_s, "T_ROB1", move.place) for move in moves
    ]
    wait = ExecutedLine(moves[-1].end_s, "T_ROB1", place("WaitTime 1"))
    return (*ahead, wait)


def without_description(simulation: Simulation) -> Simulation:
    """The same run of a robot that nobody drew."""
    return with_robot(simulation, robot=replace(simulation.only.robot, urdf=None))


def with_description(simulation: Simulation, urdf: Path) -> Simulation:
    """The same run of a robot drawn by another file."""
    return with_robot(simulation, robot=replace(simulation.only.robot, urdf=urdf))


def two_robots(apart_m: float = 1.6) -> Simulation:
    """The same run by two robots that stand face to face."""
    run = cell(rounds=1)
    half_turn = np.diag([-1.0, -1.0, 1.0])
    other = replace(
        run.only,
        task="T_ROB2",
        world_from_base=Transform(half_turn, np.array([apart_m, 0.3, 0.0])),
        moves=moves_of(replace(move, task="T_ROB2") for move in run.moves),
    )
    return replace(run, robots=(run.only, other))
