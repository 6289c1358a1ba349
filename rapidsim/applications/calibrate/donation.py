"""Logs for publication: joints, times, geometry of the programs, arm and RobotWare, nothing else.

A program is reduced to its executed moves, in the base frame, and to the waits between them: no
names, texts or paths of files remain. A program is generated from them to read them back, and its
run is compared with that of the original.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from rapidsim.applications.calibrate.fit import LoggedRun, simulated
from rapidsim.applications.calibrate.joint_log import JointLog
from rapidsim.applications.calibrate.rapid_text import (
    joint_target,
    number,
    record,
    rob_target,
    tool_data,
)
from rapidsim.files import InputError, SourceFile, input_text
from rapidsim.frames.transform import Array, Transform
from rapidsim.jobs.checking.checked_program import load
from rapidsim.json_records.declarations import OutputRecord
from rapidsim.json_records.encoding import json_of
from rapidsim.json_records.reading import RecordReader, WrongValueError
from rapidsim.language.robotware import RobotWare
from rapidsim.motion.geometry.segments import Geometry
from rapidsim.motion.kinematics.arm import Kinematics
from rapidsim.motion.model import MotionModel
from rapidsim.motion.robot.robot import Robot
from rapidsim.output_files import whole_file
from rapidsim.simulation.results.linear_alternative import segments_of
from rapidsim.simulation.results.simulation import Simulation
from rapidsim.values import value_class

_MM = 1e-3
_LATE_S = 2e-3
_OFF_RAD = math.radians(0.05)
"""Largest deviations of a run of the reduced program from that of the original."""
_COMPARED = 500
_NO_WAIT_S = 1e-6
_QUATERNION_NORM = 1e-3
_MOST = 1e6
"""Largest magnitude of a number in a file."""

Frame = tuple[float, float, float, float, float, float, float]
"""Position [mm] and quaternion, scalar first: seven numbers."""


@value_class(frozen=True, slots=True)
class DonatedMove:
    """One executed move."""

    path: str
    """`joint`, `line` or `arc`."""
    wait_s: float
    """Wait of the program before it."""
    joints_deg: tuple[float, ...]
    """Axes at its end [deg, mm for a sliding axis]."""
    base_from_tcp: Frame
    """Pose at its end."""
    circle_point: Frame | None
    flange_from_tcp: Frame
    load_kg: float
    """Mass at the wrist."""
    speed: tuple[float, float]
    """Speeds of the TCP [mm/s] and of reorientation [deg/s]."""
    zone: tuple[float, float, float] | None
    """Radius [mm], its radius [mm] and angle [deg] for the orientation; null for a stop point."""
    duration_s: float | None
    """Programmed time, which replaces the speed."""
    acceleration_percent: float
    ramp_percent: float
    stop_ramp_percent: float
    """AccSet, its ramp, and the ramp at stop points."""


@value_class(frozen=True, slots=True)
class DonatedRun:
    """The log of one run, and its program's moves."""

    times_s: tuple[float, ...]
    """From 0."""
    joints_deg: tuple[tuple[float, ...], ...]
    """Logged axes at these times [deg, mm for a sliding axis]."""
    moves: tuple[DonatedMove, ...]


@value_class(frozen=True, slots=True)
class Donation(OutputRecord):
    """The content of a file that `rapidsim calibrate --donate` writes."""

    arm: str
    """Name in the catalogue."""
    robotware: str | None
    """Version of the controller, such as `6.15`; null if unknown."""
    runs: tuple[DonatedRun, ...]


def write_donation(
    file: Path,
    runs: Sequence[LoggedRun],
    robot: Robot,
    robotware: RobotWare | None,
    model: MotionModel,
) -> None:
    """Write logs and the geometry of their programs into one file.

    Raises:
        InputError: If the arm is not of the catalogue, or moves alone do not repeat a run.
    """
    if robot.maker is None:
        raise InputError(
            f"{robot.name} is not an arm of the catalogue", "others cannot use logs of another arm"
        )
    version = None if robotware is None else str(robotware)
    donation = Donation(robot.name, version, tuple(_donated(run, robot, model) for run in runs))
    with whole_file(file) as temporary:
        temporary.write_text(json.dumps(json_of(donation)) + "\n", encoding="ascii")


def read_donation(file: Path) -> Donation:
    """Read a file of `write_donation`.

    Raises:
        InputError: If it is not one.
    """
    try:
        donation = RecordReader()(Donation, json.loads(input_text(file)))
    except (ValueError, RecursionError) as error:
        reason = str(error) if isinstance(error, WrongValueError) else "it is no JSON"
        raise InputError(f"{file} is no file of `rapidsim calibrate --donate`: {reason}") from error
    return donation


def donated_runs(donation: Donation, robot: Robot, name: str) -> list[LoggedRun]:
    """Return the logs of a donation, each with a generated program of its moves.

    Raises:
        InputError: If numbers do not belong to the arm, or a program has mistakes.
    """
    runs = []
    for position, run in enumerate(donation.runs, 1):
        title = f"{name} {position}"
        fault = _fault(run, len(robot.joints))
        if fault:
            raise InputError(f"{title}: {fault}")
        log = JointLog(title, np.array(run.times_s), np.radians(run.joints_deg))
        runs.append(_with_program(run, log, robot))
    return runs


def _donated(run: LoggedRun, robot: Robot, model: MotionModel) -> DonatedRun:
    """Return the reduced form of a run."""
    simulation = simulated(run, robot, model)
    log = JointLog(run.log.name, run.log.times - run.log.times[0], run.log.joints)
    donated = DonatedRun(
        tuple(log.times.tolist()),
        tuple(map(tuple, np.degrees(log.joints).tolist())),
        tuple(_moves(simulation, robot)),
    )
    trajectory = simulation.only.trajectory
    again = simulated(_with_program(donated, log, robot), robot, model).only.trajectory
    late_s = abs(again.duration - trajectory.duration)
    times = np.linspace(0.0, trajectory.duration, _COMPARED)
    off = np.abs(again.at(times).joints - trajectory.at(times).joints).max()
    if late_s > _LATE_S or off > _OFF_RAD:
        raise InputError(
            f"the moves of {run.log.name} alone do not repeat its run",
            "settings other than AccSet, speeds, zones, tools and waits cannot be donated",
        )
    return donated


def _moves(simulation: Simulation, robot: Robot) -> Iterator[DonatedMove]:
    """Yield the moves of a run, each with the wait before it."""
    run = simulation.only
    segments = segments_of(run)
    waits = list(simulation.waits)
    for move in run.moves:
        segment, zone = segments[move.index], move.move.zone
        before = [one for one in waits if one.end_s <= move.start_s + _NO_WAIT_S]
        waits = waits[len(before) :]
        wait_s = sum(one.end_s - one.start_s for one in before)
        speed = segment.speed
        yield DonatedMove(
            path=segment.geometry.value,
            wait_s=wait_s,
            joints_deg=tuple(np.degrees(move.joints).tolist()),
            base_from_tcp=_frame(move.base_from_tcp),
            circle_point=None if segment.via is None else _frame(segment.via),
            flange_from_tcp=_frame(segment.tcp_from_flange.inverse()),
            load_kg=segment.load * (robot.payload_kg or 0.0),
            speed=(speed.tcp / _MM, math.degrees(speed.reorientation)),
            zone=None if zone.finep else (zone.pzone_tcp, zone.pzone_ori, zone.zone_ori),
            duration_s=segment.duration,
            acceleration_percent=100.0 * segment.acceleration_share,
            ramp_percent=100.0 * segment.ramp,
            stop_ramp_percent=100.0 * segment.stop_ramp,
        )


def _with_program(run: DonatedRun, log: JointLog, robot: Robot) -> LoggedRun:
    """Return a log with the generated program of its moves."""
    text = program_text(run, robot.kinematics)
    loaded = load([SourceFile(f"{log.name}.mod", text, "utf-8")])
    if loaded.program is None:
        raise InputError(f"{log.name}: its moves make no program")
    return LoggedRun(loaded.program, log)


def program_text(run: DonatedRun, kinematics: Kinematics) -> str:
    """Return a module that makes the moves of a run."""
    tools: dict[str, str] = {}
    body, settings = [], ""
    for move in run.moves:
        tool = tool_data(_transform(move.flange_from_tcp), move.load_kg)
        tools.setdefault(tool, f"tool{len(tools) + 1}")
        braking = 100.0 * move.stop_ramp_percent / move.ramp_percent
        limits = ",".join(map(number, (move.acceleration_percent, move.ramp_percent)))
        now = rf"    AccSet {limits}\FinePointRamp:={number(braking)};"
        body += [now] if now != settings else []
        settings = now
        body += [f"    WaitTime {number(move.wait_s)};"] if move.wait_s > _NO_WAIT_S else []
        body.append(f"    {_statement(move, tools[tool], kinematics)}")
    data = [f"  PERS tooldata {name}:={tool};" for tool, name in tools.items()]
    head = [r"    ConfJ\Off;", r"    ConfL\Off;"]
    return "\n".join(["MODULE donated", *data, "  PROC main()", *head, *body, "  ENDPROC"]) + (
        "\nENDMODULE\n"
    )


def _statement(move: DonatedMove, tool: str, kinematics: Kinematics) -> str:
    """Return the move instruction of a move."""
    joints = np.radians(move.joints_deg)
    speed = record([*move.speed, 5000.0, 1000.0])
    time = "" if move.duration_s is None else rf"\T:={number(move.duration_s)}"
    zone = "fine"
    if move.zone is not None:
        radius, turning, angle = move.zone
        zone = record(["FALSE", radius, turning, turning, angle, turning, angle])
    rest = f"{speed}{time},{zone},{tool};"
    if move.path == Geometry.JOINT.value:
        return f"MoveAbsJ {joint_target(joints, kinematics)},{rest}"
    end = rob_target(_transform(move.base_from_tcp), joints, kinematics)
    if move.circle_point is None:
        return f"MoveL {end},{rest}"
    return f"MoveC {rob_target(_transform(move.circle_point), joints, kinematics)},{end},{rest}"


def _fault(run: DonatedRun, axes: int) -> str | None:
    """Return what is wrong with the numbers of a run for an arm; None if nothing is."""
    rows = [*run.joints_deg, *(move.joints_deg for move in run.moves)]
    if any(len(row) != axes for row in rows):
        return f"not all rows have {axes} axes"
    if len(run.times_s) != len(run.joints_deg) or len(run.times_s) < 2:
        return "there must be as many times as rows, and at least two"
    if (np.diff(run.times_s) <= 0.0).any():
        return "the times do not ascend"
    for number_of_move, move in enumerate(run.moves, 1):
        if not _is_possible(move):
            return f"move {number_of_move} has impossible values"
    return None


def _is_possible(move: DonatedMove) -> bool:
    """Whether the values of a move have ranges from which a program can be made."""
    frames = [move.base_from_tcp, move.flange_from_tcp]
    frames += [] if move.circle_point is None else [move.circle_point]
    values = [*move.speed, *(move.zone or ()), move.wait_s, move.load_kg, move.duration_s or 0.0]
    return (
        move.path in {one.value for one in Geometry}
        and (move.path == Geometry.ARC.value) == (move.circle_point is not None)
        and all(abs(math.hypot(*one[3:]) - 1.0) < _QUATERNION_NORM for one in frames)
        and all(0.0 <= value < _MOST for value in values)
        and all(abs(value) < _MOST for one in frames for value in one)
        and all(0.0 < one <= 100.0 for one in (move.ramp_percent, move.acceleration_percent))
    )


def _frame(a_from_b: Transform) -> Frame:
    x, y, z = (a_from_b.translation / _MM).tolist()
    q1, q2, q3, q4 = a_from_b.quaternion.tolist()
    return x, y, z, q1, q2, q3, q4


def _transform(frame: Sequence[float]) -> Transform:
    position: Array = np.array(frame[:3]) * _MM
    return Transform.from_quaternion(frame[3:], position)
