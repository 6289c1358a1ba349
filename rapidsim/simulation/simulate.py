"""Run a program on a robot: set the virtual controller up, run main, collect what happened."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass

import numpy as np

from rapidsim.analysis.program import Program
from rapidsim.diagnostics import Diagnostic
from rapidsim.files import InputError
from rapidsim.frames.transform import Array, Transform
from rapidsim.interpreter.loader import Task, load
from rapidsim.interpreter.stack import FatalError
from rapidsim.language.controller import Place
from rapidsim.language.errors import CycleEnded, Stopped
from rapidsim.motion.limits import limits_of
from rapidsim.motion.robot import Robot, RobotError
from rapidsim.motion.segments import Waypoint
from rapidsim.motion.trajectory import Trajectory
from rapidsim.simulation.controller import VirtualController
from rapidsim.simulation.journal import Journal
from rapidsim.simulation.motion_findings import hasty_move_findings
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.path_queue import MotionError, PathQueue
from rapidsim.simulation.persistents import PersistentChange, changed_persistents
from rapidsim.simulation.resolve import Resolver
from rapidsim.simulation.result import (
    CornerKind,
    End,
    Event,
    EventKind,
    ExecutedMove,
    Simulation,
    WrittenFile,
)
from rapidsim.simulation.run_findings import (
    backward_findings,
    endless_wait_finding,
    fatal_finding,
    motion_finding,
    not_simulated_findings,
    stopped_finding,
    time_limit_finding,
)
from rapidsim.simulation.stops import TimeLimitReached, WaitsForever


@dataclass(frozen=True, slots=True)
class _Outcome:
    end: End
    findings: tuple[Diagnostic, ...]
    persistents: tuple[PersistentChange, ...]


def simulate(program: Program, robot: Robot, *, options: RunOptions) -> Simulation:
    """Run a program.

    Args:
        program: A checked program.
        robot: The arm.
        options: Inputs and limits.

    Returns:
        What happened. A program that stops with an error is a result, not an exception.

    Raises:
        InputError: If how fast the arm's axes turn is not known.
    """
    _require_limits(robot, options)
    journal = Journal(options.task)
    start = _start_waypoint(robot, options)
    trajectory = Trajectory(start, options.model.filter_time)
    queue = PathQueue(robot, options.model, trajectory, start)
    resolver = Resolver(robot, journal, Transform.identity())
    controller = VirtualController(
        queue, resolver, journal, options, _entry_place(program, options)
    )
    try:
        outcome = _run(program, controller, options)
        time_s = controller.end_time_s()
    finally:
        controller.home.close_all()
    moves = queue.executed(options.task)
    findings = (
        *journal.diagnostics(),
        *not_simulated_findings(journal),
        *backward_findings(program),
        *hasty_move_findings(queue.moves),
        *outcome.findings,
    )
    motion_s = _motion_s(moves)
    return Simulation(
        program=options.program_files,
        robot=robot,
        model=options.model,
        end=outcome.end,
        time_s=time_s,
        motion_s=motion_s,
        wait_s=max(0.0, time_s - motion_s),
        path_m=trajectory.travelled_m,
        moves=moves,
        events=_sorted_events(journal, moves),
        lines=journal.lines(),
        trajectory=trajectory,
        diagnostics=findings,
        unsimulated=journal.not_simulated(),
        home_files=tuple(WrittenFile(path, size) for path, size in controller.home.written()),
        persistents=outcome.persistents,
    )


def _run(program: Program, controller: VirtualController, options: RunOptions) -> _Outcome:
    """Run main as often as asked and let the robot come to rest."""
    task: Task | None = None
    findings: tuple[Diagnostic, ...] = ()
    try:
        task = load(program, controller)
        end = _run_cycles(task, options)
        controller.finish()
    except FatalError as fatal:
        controller.abandon()
        end, findings = End.ERROR, (fatal_finding(fatal, controller.place),)
    except MotionError as error:
        end, findings = End.ERROR, (motion_finding(error),)
    except TimeLimitReached as stop:
        end, findings = End.TIME_LIMIT, (time_limit_finding(stop, controller.place),)
    except WaitsForever as stop:
        end, findings = End.ERROR, (endless_wait_finding(stop, controller.place),)
    except Stopped as stop:
        controller.abandon()
        end, findings = End.STOPPED, (stopped_finding(stop, controller.place),)
    return _Outcome(end, findings, changed_persistents(task) if task else ())


def _run_cycles(task: Task, options: RunOptions) -> End:
    """Run main again and again; module data keep their values from one cycle to the next."""
    for _ in range(options.max_cycles):
        with suppress(CycleEnded):
            task.run(options.entry)
    return End.CYCLE_LIMIT if options.max_cycles > 1 else End.ENDED


def _require_limits(robot: Robot, options: RunOptions) -> None:
    """Refuse an arm that cannot be timed before the program runs."""
    try:
        limits_of(robot, options.model)
    except RobotError as error:
        raise InputError(
            str(error),
            "give one value an axis in rapidsim.toml: [motion] axis_speed = [...] in deg/s",
        ) from None


def _start_waypoint(robot: Robot, options: RunOptions) -> Waypoint:
    """Where the arm stands before the first move, as the flange with no tool."""
    degrees = options.start_joints_deg
    wanted = robot.start if degrees is None else np.radians(np.array(degrees))
    joints: Array = np.clip(wanted, robot.lower, robot.upper)
    return Waypoint(joints, robot.kinematics.forward(joints))


def _entry_place(program: Program, options: RunOptions) -> Place:
    """Where the program pointer stands before the first statement."""
    routine = program.routines.get(options.entry.lower())
    if routine is not None:
        return Place(routine.module.span(routine.node.name), routine.name)
    module = program.modules[0]
    return Place(module.span(module.name), options.entry)


def _motion_s(moves: tuple[ExecutedMove, ...]) -> float:
    """Time under way: moves that touch or overlap count once."""
    total_s = 0.0
    reached_s = 0.0
    for move in moves:
        start_s = max(move.start_s, reached_s)
        total_s += max(0.0, move.end_s - start_s)
        reached_s = max(reached_s, move.end_s)
    return total_s


def _sorted_events(journal: Journal, moves: tuple[ExecutedMove, ...]) -> tuple[Event, ...]:
    """What was noted, and the corners that became stops because the next move came too late."""
    failures = tuple(
        Event(
            move.end_s,
            move.task,
            EventKind.CORNER,
            move.place,
            "corner path failure: the next move was not known in time and the robot stopped",
            {"move": move.index, "cf": "ABB 50024"},
        )
        for move in moves
        if move.corner is CornerKind.STOP_CORNER_PATH_FAILURE
    )
    return tuple(sorted((*journal.events(), *failures), key=lambda event: event.time_s))
