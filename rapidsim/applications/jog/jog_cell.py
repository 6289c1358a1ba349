"""An arm to jog, with the frames and bodies of its cell as a controller has them when switched on.

No program is executed: data have their initial values, and virtual time stays at 0.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field, replace
from typing import Final, TypeVar

import numpy as np

from rapidsim.applications.jog.posture_contacts import PostureContacts, bare_scene
from rapidsim.collisions.geometry import CellGeometry, CellObject, Parent, ParentKind
from rapidsim.files import InputError, SourceFile
from rapidsim.frames.transform import Array, Transform
from rapidsim.jobs.inputs.job import job
from rapidsim.jobs.inputs.run_request import RunRequest
from rapidsim.jobs.running.run_files import LoadedJob, PreparedRun, loaded, prepared
from rapidsim.language.data import TOOL0, WOBJ0, ToolData, WobjData
from rapidsim.motion.configurations.targets import transform, world_from_base_at
from rapidsim.motion.robot.robot import Robot
from rapidsim.simulation.cell_scene import cell_scene
from rapidsim.simulation.live.controller import LiveController
from rapidsim.simulation.live.live_task import LiveTask
from rapidsim.simulation.live.symbols import all_data, value_of
from rapidsim.simulation.task_run import TaskSetup
from rapidsim.values import value_class

_PLAIN_TOOL, _PLAIN_OBJECT = "tool0", "wobj0"
_ANY_SPEED: Final = 1.0
"""[rad/s]"""
_NO_AXES: Final = np.zeros(0)
T = TypeVar("T", bound=tuple[object, ...])


@value_class(frozen=True, slots=True, eq=False)
class JogCell:
    """An arm that stands in its cell."""

    robot: Robot
    base_from_world: Transform
    start: Array
    """Joints (n,) [rad] at which it stands first."""
    external: Array
    """External axes (e,) [m or rad], which stay."""
    tools: Mapping[str, ToolData]
    """Tools that it can hold, by name."""
    wobjs: Mapping[str, WobjData]
    """Work objects that nothing moves, by name."""
    contacts: PostureContacts
    colours: Mapping[int, str] = field(default_factory=dict)
    """Colours of the objects of the station by the index of their body."""
    files: tuple[SourceFile, ...] = ()
    """Files of its task."""
    remarks: tuple[str, ...] = ()
    """Reasons why bodies are not drawn."""


def bare_cell(robot: Robot) -> JogCell:
    """Return an arm without a cell."""
    return JogCell(
        robot,
        Transform.identity(),
        robot.start,
        _NO_AXES,
        {_PLAIN_TOOL: TOOL0},
        {_PLAIN_OBJECT: WOBJ0},
        PostureContacts(bare_scene(robot), _NO_AXES),
    )


def cell_of(request: RunRequest) -> JogCell:
    """Return the first arm that a task of a program moves, in its cell.

    Raises:
        ProgramRejectedError: If checking the program finds an error.
        InputError: If an input is missing, or no task moves a robot.
    """
    checked = loaded(job(request))
    return _switched_on(checked, prepared(checked))


def _switched_on(checked: LoadedJob, run: PreparedRun) -> JogCell:
    options = replace(run.options, answers=None, network=None, geometry=None)
    live = LiveController([*map(_with_speeds, run.setups)], options, keeps_all=True)
    task, robot = _mover(live)
    standing = task.unit.member.standing()
    tools = {_PLAIN_TOOL: TOOL0} | {
        name: one for name, one in _values(task, ToolData).items() if one.robhold
    }
    objects = {_PLAIN_OBJECT: WOBJ0} | _values(task, WobjData)
    base = task.setup.place
    if robot.external:
        base = world_from_base_at(robot.external, base, standing.external[None])[0]
    live.switch_off()
    simulation = live.finished().simulation
    geometry = run.options.geometry
    scene, remarks, colours = bare_scene(robot), tuple[str, ...](), dict[int, str]()
    if geometry is not None:
        built = cell_scene(simulation, _placed(geometry, objects), options.io.conveyors)
        scene, remarks = built.scene, built.remarks
        colours = {at: one.hex_colour for at, one in built.objects.items()}
    files = next(
        (one.files for one in checked.job.tasks if (one.name or task.name) == task.name), ()
    )
    return JogCell(
        robot,
        base.inverse(),
        standing.joints,
        standing.external,
        tools,
        {name: one for name, one in objects.items() if one.ufprog and not one.robhold},
        PostureContacts(scene, standing.external),
        colours,
        files,
        remarks,
    )


def _with_speeds(setup: TaskSetup) -> TaskSetup:
    """Return a setup whose arm has speeds of all axes, on which no answer depends."""
    if setup.robot is None:
        return setup
    joints = tuple(
        replace(one, max_speed=_ANY_SPEED) if one.max_speed is None else one
        for one in setup.robot.joints
    )
    return replace(setup, robot=replace(setup.robot, joints=joints))


def _mover(live: LiveController) -> tuple[LiveTask, Robot]:
    """Return the first task with a robot, which is the first of a scene."""
    for task in live.tasks.values():
        if task.setup.robot is not None:
            return task, task.setup.robot
    raise InputError("no task moves a robot", "`--robot NAME` without PATH jogs an arm alone")


def _values(task: LiveTask, kind: type[T]) -> dict[str, T]:
    """Return the module data of a record type, by name."""
    found: dict[str, T] = {}
    for datum in all_data(task):
        if not datum.dimensions and isinstance(value := value_of(task, datum), kind):
            found[datum.name] = value
    return found


def _placed(geometry: CellGeometry, wobjs: Mapping[str, WobjData]) -> CellGeometry:
    """Return the geometry with objects in work objects where these are, without any move."""
    by_name = {name.lower(): one for name, one in wobjs.items()}
    return replace(geometry, objects=tuple(_fixed(one, by_name) for one in geometry.objects))


def _fixed(item: CellObject, wobjs: Mapping[str, WobjData]) -> CellObject:
    parent = item.parent
    wobj = wobjs.get(parent.name.lower()) if parent.kind is ParentKind.WOBJ else None
    if wobj is None:
        return item
    pose = transform(wobj.oframe) @ item.parent_from_object
    if not wobj.ufprog:
        unit = Parent(ParentKind.UNIT, wobj.ufmec, robot=parent.robot)
        return replace(item, parent=unit, parent_from_object=pose)
    pose = transform(wobj.uframe) @ pose
    kind = ParentKind.TOOL if wobj.robhold else ParentKind.WORLD
    return replace(item, parent=Parent(kind, robot=parent.robot), parent_from_object=pose)
