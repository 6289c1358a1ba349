"""One task of a run: its setup, its controller, and its execution to the end."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace

import numpy as np

from rapidsim.analysis.program import Program
from rapidsim.controller.cell.cell import Cell
from rapidsim.controller.cell.message_queues import QueueSettings
from rapidsim.controller.controller import VirtualController, virtual_controller
from rapidsim.controller.journal.failed_moves import FailedMove, failed_at_fraction
from rapidsim.controller.journal.journal import Journal
from rapidsim.controller.journal.stop_reasons import (
    MoveImpossible,
    TimeLimitReached,
    TrapStorm,
    WaitsForever,
    WallLimitReached,
    ZoneReached,
)
from rapidsim.controller.moves.queued_move import MotionError
from rapidsim.controller.moves.resolve import Resolver
from rapidsim.controller.queue.mechanical_unit import MechanicalUnit
from rapidsim.controller.queue.member import Member, member_at_rest
from rapidsim.diagnostics import Diagnostic
from rapidsim.files import InputError
from rapidsim.frames.transform import Array, Transform
from rapidsim.interpreter.linking.loader import Task, running
from rapidsim.interpreter.runtime.call_stack import FatalError
from rapidsim.language.errors import (
    AllStopped,
    CycleEnded,
    NotAllowed,
    NotConnected,
    NotDeclared,
    Stopped,
)
from rapidsim.language.moves import Place
from rapidsim.motion.geometry.segments import Waypoint
from rapidsim.motion.robot.external_axes import ExternalAxis
from rapidsim.motion.robot.robot import Robot, RobotError
from rapidsim.motion.timing.axis_limits import limits_of
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.results.simulation import End
from rapidsim.simulation.run_findings import (
    endless_wait_finding,
    fatal_answer,
    fatal_finding,
    impossible_move_finding,
    motion_finding,
    not_allowed_finding,
    not_connected_finding,
    not_declared_finding,
    stopped_finding,
    time_limit_finding,
    trap_storm_finding,
    zone_finding,
)
from rapidsim.station.task_kind import TaskEvent, TaskKind
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class TaskSetup:
    """Inputs of a task."""

    name: str
    program: Program
    robot: Robot | None = None
    """None if the task moves no robot."""
    start_joints_deg: tuple[float, ...] | None = None
    """Joints at the start [deg]. None for the start of the arm's entry, usually all zero with
    axis 5 at 30 degrees; if the first move is a line or arc, the arm begins above it."""
    world_from_base: Transform | None = None
    """Pose of the robot's base; None for the world's origin."""
    kind: TaskKind = TaskKind.NORMAL
    written: frozenset[str] | None = None
    """Folded names of the persistents that the program may write; None if not determined."""
    entry: str | None = None
    """Procedure that it begins with; None for that of the run's options."""
    queue: QueueSettings | None = None
    """Message queue of the task; None if it is not described."""
    events: tuple[tuple[TaskEvent, str], ...] = ()
    """Event routines, which a controller that stays on calls."""
    robot_label: str | None = None
    """Name of its robot in the station; None if there is none."""
    is_base_known: bool = True
    """False if the robot is on a unit with unknown axes, or its pose on a body is unknown."""

    @property
    def counts(self) -> bool:
        """Whether the run lasts until this task has ended."""
        return self.kind is TaskKind.NORMAL

    @property
    def place(self) -> Transform:
        """Pose of the robot's base."""
        return self.world_from_base or Transform.identity()


@value_class(frozen=True, slots=True)
class TaskOutcome:
    """Outcome of a task."""

    end: End
    findings: tuple[Diagnostic, ...] = ()
    failed_moves: tuple[FailedMove, ...] = ()
    task: Task | None = None
    """The program with its final values; None if it failed to load."""
    ends_all: bool = False
    """Whether its program has stopped all tasks."""


@value_class(frozen=True, slots=True)
class TaskRun:
    """A task with its controller and its robot's motion."""

    setup: TaskSetup
    journal: Journal
    member: Member
    controller: VirtualController


def prepare(
    setup: TaskSetup, placeholder: Robot, cell: Cell, journal: Journal, options: RunOptions
) -> TaskRun:
    """Set up a task's controller at time zero.

    Args:
        setup: The task.
        placeholder: An arm that never moves, for a task without a robot.
        cell: The state shared with other tasks.
        journal: Receives its reports.
        options: Limits and the motion model.
    """
    unit = unit_of(setup, placeholder, cell, journal, options)
    unit.member.start_is_free = setup.start_joints_deg is None
    return new_task_run(setup, unit, cell, journal, options)


def unit_of(
    setup: TaskSetup, placeholder: Robot, cell: Cell, journal: Journal, options: RunOptions
) -> MechanicalUnit:
    """Return the robot of a task at its start position; see `prepare`."""
    robot = setup.robot or placeholder
    start = _start_waypoint(robot, setup.start_joints_deg)
    return MechanicalUnit(member_at_rest(robot, options.model, start), cell.watchdog.check)


def new_task_run(
    setup: TaskSetup, unit: MechanicalUnit, cell: Cell, journal: Journal, options: RunOptions
) -> TaskRun:
    """Create a task with a new controller; of the previous program only the position remains.

    Args:
        setup: The task.
        unit: Its robot.
        cell: The state shared with other tasks.
        journal: Receives its reports.
        options: Limits and the motion model.
    """
    resolver = Resolver(
        unit.member.robot,
        journal,
        setup.place.inverse(),
        options.model.payload_acceleration,
        options.nearest_configuration,
        options.functions_fail,
        options.exact_configuration,
        guesses_frames=options.guesses_frames,
    )
    place = _entry_place(setup.program, setup.entry or options.entry)
    has_robot = setup.robot is not None
    controller = virtual_controller(
        cell, unit, resolver, journal, place, has_robot=has_robot, queue=setup.queue
    )
    controller.coordination.robot_label = setup.robot_label
    if not setup.counts:
        controller.clock.run_in_background()
    return TaskRun(setup, journal, unit.member, controller)


def require_limits(robot: Robot, options: RunOptions) -> None:
    """Reject an arm that cannot be timed before the program runs.

    Raises:
        InputError: If the speed limits of its axes are unknown.
    """
    try:
        limits_of(robot, options.model)
    except RobotError as error:
        raise InputError(
            str(error),
            "give one value an axis in rapidsim.toml: [motion] axis_speed = [...] in "
            f"{robot.units('/s')}",
        ) from None


def run_to_end(
    run: TaskRun,
    load: Callable[[], Task],
    options: RunOptions,
    other_waits: Callable[[], Sequence[tuple[str, Place]]] = tuple,
) -> TaskOutcome:
    """Load a task, run its main for the requested cycles and bring its robot to rest.

    Args:
        run: The task.
        load: Loads its program.
        options: Limits of the run.
        other_waits: Returns the tasks that wait when this one waits indefinitely, and where.
    """
    task: Task | None = None
    try:
        try:
            with run.controller.motion.cell.watchdog.loading():
                task = load()
            # Traps and procedures of the path also run while the arm comes to rest.
            with running():
                end = _run_cycles(task, run, options)
                while not _came_to_rest(run.controller):
                    pass
            outcome = TaskOutcome(end, task=task)
        except (FatalError, MotionError, Stopped) as error:
            outcome = replace(outcome_of(error, run, other_waits), task=task)
        run.controller.motion.end_with_the_run()
    except WallLimitReached as over:
        # Its limit reached the run at its end: what is left takes no time.
        run.controller.motion.cell.watchdog.rest()
        outcome = replace(outcome_of(over, run, other_waits), task=task)
        run.controller.motion.end_with_the_run()
    return outcome


def outcome_of(
    error: FatalError | MotionError | Stopped,
    run: TaskRun,
    other_waits: Callable[[], Sequence[tuple[str, Place]]] = tuple,
) -> TaskOutcome:
    """Return the outcome of a task that an error ended; its robot completes its moves.

    Args:
        error: The error that ended it.
        run: The task.
        other_waits: Returns the tasks that wait when this one waits indefinitely, and where.
    """
    outcome = _outcome_of(error, run, other_waits)
    if not isinstance(error, TimeLimitReached | WaitsForever):
        run.controller.execution.end()
    return outcome


def _outcome_of(
    error: FatalError | MotionError | Stopped,
    run: TaskRun,
    other_waits: Callable[[], Sequence[tuple[str, Place]]],
) -> TaskOutcome:
    controller = run.controller
    place = controller.clock.place
    match error:
        case MotionError():
            return _failed_motion(error, run)
        case TimeLimitReached():
            # Motion after the run is not part of it, apart from its stop.
            controller.coordination.stop_robot(controller.clock.pointer_s())
            return TaskOutcome(End.TIME_LIMIT, (time_limit_finding(error, place),))
        case WaitsForever():
            found = endless_wait_finding(error, (run.setup.name, place), other_waits())
            return TaskOutcome(End.ERROR, (found,))
        case TrapStorm():
            return TaskOutcome(End.ERROR, (trap_storm_finding(error, place),))
        case ZoneReached():
            return TaskOutcome(End.ERROR, (zone_finding(error, place),))
        case _:
            return _abandoned(error, run)


def _abandoned(error: FatalError | Stopped, run: TaskRun) -> TaskOutcome:
    """Return the outcome of a task whose program stopped, perhaps with moves still queued."""
    controller = run.controller
    place = controller.clock.place
    mark = run.journal.error_mark(controller.clock.moment())
    if (earlier := controller.motion.abandon()) is not None:
        return _failed_motion(earlier, run)
    match error:
        case FatalError():
            run.journal.error(mark, fatal_answer(error, place))
            return TaskOutcome(End.ERROR, (fatal_finding(error, place),))
        case MoveImpossible():
            error.assumed |= not run.setup.is_base_known
            return TaskOutcome(End.ERROR, (impossible_move_finding(error, place),))
        case NotDeclared():
            return TaskOutcome(End.ERROR, (not_declared_finding(error, place),))
        case NotConnected():
            return TaskOutcome(End.ERROR, (not_connected_finding(error, place),))
        case NotAllowed():
            return TaskOutcome(End.ERROR, (not_allowed_finding(error, place),))
        case _:
            found = stopped_finding(error, place)
            return TaskOutcome(End.STOPPED, (found,), ends_all=isinstance(error, AllStopped))


def _failed_motion(error: MotionError, run: TaskRun) -> TaskOutcome:
    """Return the outcome of a task with a move that proved impossible when its path was planned."""
    finding = motion_finding(error)
    if not run.setup.is_base_known:
        finding = replace(finding, assumed=True)
    queued = error.queued
    way = (queued.place, finding.violation, queued.segment, error.fault.fraction, run.member.robot)
    return TaskOutcome(End.ERROR, (finding,), (failed_at_fraction(*way),))


def _run_cycles(task: Task, run: TaskRun, options: RunOptions) -> End:
    """Run main repeatedly; module data keep their values from one cycle to the next."""
    entry = run.setup.entry or options.entry
    if run.setup.kind is not TaskKind.NORMAL:
        while True:
            with suppress(CycleEnded):
                task.run(entry)
            run.controller.clock.tick()
    for _ in range(options.max_cycles):
        with suppress(CycleEnded):
            task.run(entry)
    return End.CYCLE_LIMIT if options.max_cycles > 1 else End.ENDED


def _came_to_rest(controller: VirtualController) -> bool:
    """Bring the robot to rest; False if ExitCycle in a trap interrupts it after the last cycle."""
    with suppress(CycleEnded):
        controller.motion.finish()
        return True
    return False


def start_joints(robot: Robot, degrees: tuple[float, ...] | None) -> Array:
    """Joints (n,) [rad] before the first move; the start of the arm's entry if degrees are None."""
    wanted = robot.start if degrees is None else np.radians(np.array(degrees))
    joints: Array = np.clip(wanted, robot.lower, robot.upper)
    return joints


def _start_waypoint(robot: Robot, degrees: tuple[float, ...] | None) -> Waypoint:
    """Waypoint of arm and external axes before the first move, with the flange as TCP."""
    joints = start_joints(robot, degrees)
    external = np.array([_start_of(axis) for axis in robot.external])
    return Waypoint(joints, robot.kinematics.forward(joints), external)


def _start_of(axis: ExternalAxis) -> float:
    """Position of an external axis before the first move [m or rad]: `start`, within its limits."""
    return min(max(axis.start, axis.lower), axis.upper)


def _entry_place(program: Program, entry: str) -> Place:
    """Position of the program pointer before the first statement."""
    routine = program.routines.get(entry.lower())
    if routine is not None:
        return Place(routine.module.span(routine.node.name), routine.name)
    module = program.modules[0]
    return Place(module.span(module.name), entry)
