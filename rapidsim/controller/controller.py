"""The virtual controller of one task: its clock, and one concern for each service to programs.

Each concern is a module here and gets what it uses at construction; tasks share the `Cell`.
"""

from __future__ import annotations

from rapidsim.controller.axis_signals import TaskAxisSignals
from rapidsim.controller.belt_tracking import BeltTracking
from rapidsim.controller.cameras import TaskCameras
from rapidsim.controller.cell.cell import CELL_TASK, Cause, Cell
from rapidsim.controller.cell.message_queues import QueueSettings
from rapidsim.controller.clock import TaskClock
from rapidsim.controller.cyclic_bools import TaskCyclicBools
from rapidsim.controller.equipment import TaskEquipment
from rapidsim.controller.errors import TaskErrors
from rapidsim.controller.execution import TaskExecution
from rapidsim.controller.files import FileAccess, TaskTexts
from rapidsim.controller.guidance import TaskGuidance
from rapidsim.controller.interrupt_table import InterruptTable
from rapidsim.controller.interrupts import TaskErrorNumbers, TaskInterrupts
from rapidsim.controller.journal.journal import Journal
from rapidsim.controller.messages import TaskMessages
from rapidsim.controller.motion import TaskMotion
from rapidsim.controller.motion_state import MotionState
from rapidsim.controller.moves.resolve import Resolver
from rapidsim.controller.operator import TaskFidelityReporter, TaskOperator
from rapidsim.controller.other_tasks import TaskCoordination
from rapidsim.controller.path_control import TaskPathControl
from rapidsim.controller.path_length import TaskPathLength
from rapidsim.controller.path_recorder import TaskPathRecorder
from rapidsim.controller.position_reading import PositionReader
from rapidsim.controller.queue.mechanical_unit import MechanicalUnit
from rapidsim.controller.queue.path_marks import PathMarks
from rapidsim.controller.queue.speed_outputs import SpeedOutputs
from rapidsim.controller.queue.zone_table import WorldZoneTable
from rapidsim.controller.search import TaskSearch
from rapidsim.controller.signals import TaskSignals
from rapidsim.controller.smart_gripper import TaskSmartGripper
from rapidsim.controller.sockets import TaskSockets
from rapidsim.controller.standstill import StandstillOutputs
from rapidsim.controller.stop_processes import StopProcesses
from rapidsim.controller.synchronisation import TaskSynchronisation
from rapidsim.controller.task_moves import TaskMoves
from rapidsim.controller.triggers import Triggers
from rapidsim.controller.zones import TaskZones
from rapidsim.language.controller import Controller
from rapidsim.language.moves import Place
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class VirtualController:
    """The controller of one task, for runs; the program of the task uses only `concerns`."""

    clock: TaskClock
    execution: TaskExecution
    motion: TaskMotion
    coordination: TaskCoordination
    files: FileAccess
    sockets: TaskSockets
    guidance: TaskGuidance
    recorder: TaskPathRecorder
    path_length: TaskPathLength
    concerns: Controller


def virtual_controller(
    cell: Cell,
    unit: MechanicalUnit,
    resolver: Resolver,
    journal: Journal,
    place: Place,
    *,
    has_robot: bool = True,
    queue: QueueSettings | None = None,
) -> VirtualController:
    """The controller of a task at time zero.

    Args:
        cell: State shared with other tasks.
        unit: The robot; one that never moves if the task has none.
        resolver: Makes segments of moves.
        journal: Record of the task.
        place: Place of the program pointer.
        has_robot: Whether the task moves the robot.
        queue: Settings of its message queue; None for the defaults.
    """
    state, table = MotionState(), InterruptTable()
    cell.error_listeners.append(table)
    marks, world_from_base = PathMarks(unit), resolver.base_from_world.inverse()
    watched = WorldZoneTable(unit, world_from_base, cell.max_time_s, cell.watchdog.check)
    clock = TaskClock(cell, unit, journal, table, place)
    interrupts = TaskInterrupts(clock, cell, table)
    execution = TaskExecution(clock, unit, cell, table, StopProcesses(clock, cell))
    speeds = SpeedOutputs(unit, cell)
    guidance = TaskGuidance(clock, unit, cell, resolver, state, journal)
    belts = BeltTracking(clock, unit, cell, resolver)
    reader = PositionReader(unit, resolver)
    others = TaskCoordination(clock, unit, cell, resolver, state, reader, journal.task, has_robot)
    resolver.holders.find = lambda wobj, time_s: (
        belts.holder(wobj, time_s) or others.holder(wobj.ufmec)
    )
    stands = StandstillOutputs(unit, cell, others, Cause(journal.for_task(CELL_TASK)))
    execution.stopped = stands.program_stopped
    clock.event_sources = (execution, cell, guidance, marks, watched, speeds, stands, interrupts)
    synchronisation = TaskSynchronisation(clock, unit, cell, resolver, table, marks, state, others)
    own = clock, unit, cell, resolver, table, marks, watched, journal, state, interrupts
    moves = TaskMoves(*own, synchronisation, belts)
    triggers = Triggers(clock, unit, cell, marks, interrupts, speeds)
    motion = TaskMotion(
        clock, unit, cell, resolver, state, triggers, moves.put, moves.repeat, reader
    )
    own_queue = cell.messages.open_for(journal.task, queue or QueueSettings())
    sockets = TaskSockets(clock, cell, journal)
    files = FileAccess(clock, cell)
    recorder = TaskPathRecorder(clock, unit, resolver, state, moves.put)
    path_length = TaskPathLength(clock, unit)
    concerns = Controller(
        clock=clock,
        execution=execution,
        motion=motion,
        path_control=TaskPathControl(clock, unit, marks, interrupts, state),
        path_recorder=recorder,
        path_length=path_length,
        searches=TaskSearch(clock, unit, cell, resolver, moves.put, state),
        world_zones=TaskZones(clock, unit, cell, journal, watched),
        operator=TaskOperator(clock, cell, journal),
        files=files,
        texts=TaskTexts(clock, cell),
        sockets=sockets,
        interrupts=interrupts,
        signals=TaskSignals(clock, unit, cell, table, marks, watched),
        error_numbers=TaskErrorNumbers(),
        errors=TaskErrors(clock, journal),
        tasks=others,
        sync_moves=synchronisation,
        fidelity=TaskFidelityReporter(clock, journal),
        equipment=TaskEquipment(clock, cell, resolver, others),
        axis_signals=TaskAxisSignals(clock, cell, others),
        smart_gripper=TaskSmartGripper(clock, cell, journal.task),
        cyclic_bools=TaskCyclicBools(clock, cell),
        cameras=TaskCameras(clock, cell),
        messages=TaskMessages(clock, cell, table, journal, own_queue),
        guidance=guidance,
    )
    return VirtualController(
        clock, execution, motion, others, files, sockets, guidance, recorder, path_length, concerns
    )
