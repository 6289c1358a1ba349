"""Build the result of a run after all of its tasks have ended."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from rapidsim.analysis.program import Program
from rapidsim.controller.cell.cell import Cell
from rapidsim.controller.journal.events import Event, EventKind, Unsimulated
from rapidsim.controller.journal.journal import Journal
from rapidsim.controller.moves.executed_move import CornerKind
from rapidsim.controller.moves.executed_moves import ExecutedMoves, MoveColumns
from rapidsim.controller.moves.motion_findings import hasty_move_findings
from rapidsim.diagnostics import Diagnostic
from rapidsim.interpreter.linking.loader import Task
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.results.belt_findings import belt_findings
from rapidsim.simulation.results.early_outputs import early_output_findings
from rapidsim.simulation.results.gripper_protocol import with_gripper_findings
from rapidsim.simulation.results.moved_work_objects import moved_object_findings
from rapidsim.simulation.results.persistents import changed_persistents, deduplicated
from rapidsim.simulation.results.simulation import (
    End,
    RobotRun,
    Simulation,
    TaskEnd,
    WrittenFile,
    numbered_moves,
)
from rapidsim.simulation.results.smoothed_corners import corner_findings
from rapidsim.simulation.results.uncertain_corners import uncertain_corner_findings
from rapidsim.simulation.run_findings import (
    backward_findings,
    not_simulated_findings,
)
from rapidsim.simulation.task_run import TaskOutcome, TaskRun
from rapidsim.syntax import tree
from rapidsim.values import value_class

_WORST_FIRST = (End.ERROR, End.TIME_LIMIT, End.STOPPED, End.CYCLE_LIMIT, End.ENDED)


@value_class(frozen=True, slots=True)
class FinishedRun:
    """A run, and its tasks, whose final data can be read."""

    simulation: Simulation
    tasks: Mapping[str, Task]
    """Tasks by name, without those that failed to load."""


def build_result(
    runs: Sequence[TaskRun],
    outcomes: Sequence[TaskOutcome],
    cell: Cell,
    time_s: float,
    options: RunOptions,
) -> FinishedRun:
    """Build the result of a run from its tasks, which have ended.

    Args:
        runs: The tasks.
        outcomes: Outcome of each task.
        cell: The state that they shared; no task waits for others any more.
        time_s: End of the run [s].
        options: Inputs and limits of the run.
    """
    simulation = _simulation(runs, outcomes, cell, time_s, options)
    simulation = with_gripper_findings(simulation, options.io.grippers)
    if options.geometry is not None:
        # Few cells have bodies; the collision check is imported for those only.
        from rapidsim.simulation.collisions import with_collisions  # noqa: PLC0415

        conveyors, hulls = options.io.conveyors, options.hulls
        watchdog = cell.watchdog
        simulation = with_collisions(simulation, options.geometry, conveyors, hulls, watchdog)
    return FinishedRun(
        simulation,
        {
            run.setup.name: outcome.task
            for run, outcome in zip(runs, outcomes, strict=True)
            if outcome.task is not None
        },
    )


def _simulation(
    runs: Sequence[TaskRun],
    outcomes: Sequence[TaskOutcome],
    cell: Cell,
    time_s: float,
    options: RunOptions,
) -> Simulation:
    """Build the result without findings on grippers and collisions."""
    robots = tuple(
        _robot_run(run, outcome)
        for run, outcome in zip(runs, outcomes, strict=True)
        if run.setup.robot is not None
    )
    moves = numbered_moves(robots)
    events = _sorted_events(runs[0].journal, moves)
    motion_s = _motion_s(moves.columns, time_s)
    ends = [outcome.end for outcome in outcomes]
    return Simulation(
        program=options.program_files,
        model=options.model,
        end=next(end for end in _WORST_FIRST if end in ends),
        time_s=time_s,
        motion_s=motion_s,
        wait_s=max(0.0, time_s - motion_s),
        robots=robots,
        tasks=tuple(
            TaskEnd(
                run.setup.name,
                run.setup.kind,
                outcome.end,
                run.setup.entry or options.entry,
            )
            for run, outcome in zip(runs, outcomes, strict=True)
        ),
        events=events,
        diagnostics=tuple(_findings(runs, outcomes, robots, events, time_s)),
        unsimulated=_not_simulated(runs),
        home_files=tuple(WrittenFile(path, size) for path, size in cell.home.written()),
        lacked_files=cell.home.lacks,
        belts=tuple(one.course for one in cell.conveyors.values()),
        # Now, not at the end of each task: others may have changed shared data since.
        persistents=deduplicated(
            one
            for outcome in outcomes
            if outcome.task is not None
            for one in changed_persistents(outcome.task)
        ),
        waits=tuple(
            sorted((one for run in runs for one in run.journal.waits()), key=lambda w: w.start_s)
        ),
        errors=tuple(
            sorted(
                (one for run in runs for one in run.journal.errors(time_s)),
                key=lambda tally: tally.time_s,
            )
        ),
        signal_starts={signal.name: signal.value for signal in options.io.signals},
    )


def _findings(
    runs: Sequence[TaskRun],
    outcomes: Sequence[TaskOutcome],
    robots: Sequence[RobotRun],
    events: Sequence[Event],
    time_s: float,
) -> Iterator[Diagnostic]:
    """The findings of each task, then those of the path and the outputs of each robot."""
    for run, outcome in zip(runs, outcomes, strict=True):
        yield from run.journal.diagnostics()
        yield from not_simulated_findings(run.journal)
        yield from backward_findings(run.setup.program)
        yield from hasty_move_findings(run.member.moves.parts)
        yield from outcome.findings
    movers = [run for run in runs if run.setup.robot is not None]
    for robot, run in zip(robots, movers, strict=True):
        limits, model = run.member.limits, run.member.model
        yield from corner_findings(robot.moves, robot.trajectory, limits, robot.robot.axes, model)
        yield from uncertain_corner_findings(robot.moves, robot.trajectory, robot.robot, model)
        yield from belt_findings(
            *(robot.moves, robot.trajectory, limits, robot.robot, time_s),
            by_axes=model.smoothing == "axes",
        )
    for robot, run in zip(robots, movers, strict=True):
        yield from early_output_findings(events, robot, _traps(run.setup.program))
    yield from moved_object_findings(robots, [run.setup.robot_label for run in movers])


def _traps(program: Program) -> frozenset[str]:
    """Return the folded names of the traps of a task."""
    routines = (routine for module in program.modules for routine in module.routines)
    return frozenset(one.name.key for one in routines if isinstance(one, tree.Trap))


def _robot_run(run: TaskRun, outcome: TaskOutcome) -> RobotRun:
    name, trajectory = run.setup.name, run.member.trajectory
    return RobotRun(
        task=name,
        robot=run.member.robot,
        world_from_base=run.setup.place,
        moves=run.member.executed(name),
        lines=run.journal.lines(),
        trajectory=trajectory,
        path_m=trajectory.travelled_m,
        failed_moves=(*run.journal.failed_moves(), *outcome.failed_moves),
    )


def _not_simulated(runs: Sequence[TaskRun]) -> tuple[Unsimulated, ...]:
    """Return the routines called by all tasks that were not simulated, each once, with counts."""
    counts: dict[tuple[str, str, bool], int] = {}
    for run in runs:
        for one in run.journal.not_simulated():
            key = (one.name, one.treated_as, one.is_unknown)
            counts[key] = counts.get(key, 0) + one.count
    return tuple(
        Unsimulated(name, count, how, is_unknown)
        for (name, how, is_unknown), count in counts.items()
    )


def _motion_s(moves: MoveColumns, until_s: float) -> float:
    """Return the time in motion [s]: overlapping moves, also of several robots, count once.

    Args:
        moves: Moves of all robots.
        until_s: The end of the run [s]; a robot that is stopped there is at rest only later.
    """
    order = np.argsort(moves.start_s, kind="stable")
    end_s = np.minimum(moves.end_s[order], until_s)
    reached_s = np.maximum.accumulate(np.concatenate([[0.0], end_s]))[:-1]
    lasts_s = end_s - np.maximum(moves.start_s[order], reached_s)
    return float(np.cumsum(np.append(0.0, np.maximum(lasts_s, 0.0)))[-1])


def _sorted_events(journal: Journal, moves: ExecutedMoves) -> tuple[Event, ...]:
    """Events by time, with the corners that became stops because the next move was late."""
    late = CornerKind.STOP_CORNER_PATH_FAILURE
    failures = tuple(
        Event(
            move.end_s,
            move.task,
            EventKind.CORNER,
            move.place,
            "corner path failure: the next move was not known in time and the robot stopped",
            {"move": move.index, "cf": "ABB 50024"},
        )
        for move in (moves[at] for at, kind in enumerate(moves.columns.corners) if kind is late)
    )
    return tuple(sorted((*journal.events(), *failures), key=lambda event: event.time_s))
