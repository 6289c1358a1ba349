"""Run a program on a robot: set the virtual controller up, run main, collect what happened."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rapidsim.analysis.program import Program
from rapidsim.diagnostics import Diagnostic, Related, Span
from rapidsim.frames.transform import Array, Transform
from rapidsim.interpreter.loader import load
from rapidsim.interpreter.stack import FatalError, Frame
from rapidsim.language.controller import Place
from rapidsim.language.errors import Stopped
from rapidsim.motion.robot import Robot
from rapidsim.motion.segments import Waypoint
from rapidsim.motion.trajectory import Trajectory
from rapidsim.simulation.controller import VirtualController
from rapidsim.simulation.journal import Journal
from rapidsim.simulation.motion_findings import path_violation
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.path_queue import MotionError, PathQueue
from rapidsim.simulation.resolve import MoveRefusedError, Resolver
from rapidsim.simulation.result import (
    CornerKind,
    End,
    Event,
    EventKind,
    ExecutedMove,
    Simulation,
    WrittenFile,
)
from rapidsim.simulation.stops import TimeLimitReached, WaitsForever
from rapidsim.simulation.violations import EndlessWait, RoutineNotSimulated, UncaughtError

DEFAULT_START_DEG = (0.0, 0.0, 0.0, 0.0, 30.0, 0.0)
"""Axis 5 bent: the all-zero pose of most arms is singular, and a program may begin with a line."""


@dataclass(frozen=True, slots=True)
class _Outcome:
    end: End
    findings: tuple[Diagnostic, ...] = ()


def simulate(program: Program, robot: Robot, *, options: RunOptions) -> Simulation:
    """Run a program.

    Args:
        program: A checked program.
        robot: The arm.
        options: Inputs and limits.

    Returns:
        What happened. A program that stops with an error is a result, not an exception.
    """
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
        *_not_simulated(journal),
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
    )


def _run(program: Program, controller: VirtualController, options: RunOptions) -> _Outcome:
    """Run main as often as asked and let the robot come to rest."""
    try:
        task = load(program, controller)
        for _ in range(options.max_cycles):
            task.run(options.entry)
        controller.finish()
    except FatalError as fatal:
        controller.abandon()
        finding = _fatal_finding(fatal, program, controller.place)
        return _Outcome(End.ERROR, (finding,))
    except MotionError as error:
        return _Outcome(End.ERROR, (_motion_finding(error),))
    except TimeLimitReached:
        return _Outcome(End.TIME_LIMIT)
    except WaitsForever as stop:
        place = controller.place
        finding = Diagnostic(EndlessWait(stop.reason), place.span, routine=place.routine)
        return _Outcome(End.ERROR, (finding,))
    except Stopped:
        controller.abandon()
        return _Outcome(End.STOPPED)
    return _Outcome(End.ENDED)


def _start_waypoint(robot: Robot, options: RunOptions) -> Waypoint:
    """Where the arm stands before the first move, as the flange with no tool."""
    degrees = options.start_joints_deg
    if degrees is None:
        degrees = DEFAULT_START_DEG[: len(robot.joints)]
    joints: Array = np.clip(np.radians(np.array(degrees)), robot.lower, robot.upper)
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


def _not_simulated(journal: Journal) -> tuple[Diagnostic, ...]:
    """One warning for each routine that was met and not simulated."""
    return tuple(
        Diagnostic(RoutineNotSimulated(entry.name, entry.treated_as), None)
        for entry in journal.not_simulated()
    )


def _motion_finding(error: MotionError) -> Diagnostic:
    place = error.queued.place
    return Diagnostic(path_violation(error), place.span, routine=place.routine)


def _fatal_finding(fatal: FatalError, program: Program, place: Place) -> Diagnostic:
    """The error that nothing caught, with the call chain as related places, innermost first."""
    calls = [(frame.routine, _statement_span(frame, program)) for frame in reversed(fatal.stack)]
    routine, span = calls[0] if calls else (place.routine, place.span)
    related = tuple(
        Related(call_span, f"called from {caller}" if caller else "initial value")
        for caller, call_span in calls[1:]
        if call_span is not None
    )
    error = fatal.error
    violation = error.violation if isinstance(error, MoveRefusedError) else None
    if span is not None and span.line == place.span.line and span.file == place.span.file:
        span = place.span
    return Diagnostic(violation or UncaughtError(error.message), span, related, routine=routine)


def _statement_span(frame: Frame, program: Program) -> Span | None:
    """The line a routine had come to, without its indentation."""
    for module in program.modules:
        source = module.source
        if source.file == frame.file:
            start = source.line_starts[frame.line - 1]
            text = source.line(frame.line)
            indent = len(text) - len(text.lstrip())
            return Span(source, start + indent, start + max(len(text.rstrip()), indent + 1))
    return None
