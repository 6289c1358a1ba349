r"""The position of the robot, and its forward and inverse kinematics.

Positions are in program coordinates: the program displacement is removed.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "CRobT", "CJointT",
"CPos", "CTool", "CWObj", "CalcRobT", "CalcJointT".
"""

from __future__ import annotations

from rapidsim.language.annotations import ErrNum, InOut, Num, Pers, String, Switch, TaskId, Var
from rapidsim.language.controller import Controller, Motion
from rapidsim.language.data import (
    NO_EXTERNAL_AXES,
    WOBJ0,
    JointTarget,
    Orient,
    Pos,
    RobJoint,
    RobTarget,
    ToolData,
    WobjData,
)
from rapidsim.language.errors import RapidError
from rapidsim.language.reference import Reference
from rapidsim.language.tasks import TaskService
from rapidsim.library.displacement import in_object, in_program, without_axis_offsets
from rapidsim.library.fidelity_notes import note_ignored_options
from rapidsim.library.table import routine, table
from rapidsim.library.task_arguments import named_task
from rapidsim.library.traits import Trait

_NOISE = 1e-9
"""Rounding noise, in mm, deg or components of a quaternion."""


def c_rob_t(
    controller: Controller,
    *,
    task_ref: Var[TaskId] | None = None,
    task_name: String | None = None,
    tool: Pers[ToolData] | None = None,
    wobj: Pers[WobjData] | None = None,
) -> RobTarget:
    """The position of the TCP, by default with the tool and work object of the last move."""
    of_tool = None if tool is None else tool.value
    of_wobj = None if wobj is None else wobj.value
    other = _other_task(controller.tasks, task_ref, task_name)
    if other is not None:
        return controller.tasks.target_of(other, of_tool, of_wobj)
    stands = controller.motion.current_target(of_tool, of_wobj)
    return _without_noise(in_program(controller.motion, stands))


def c_joint_t(
    controller: Controller,
    *,
    task_ref: Var[TaskId] | None = None,
    task_name: String | None = None,
) -> JointTarget:
    """The positions of the axes."""
    other = _other_task(controller.tasks, task_ref, task_name)
    if other is not None:
        return controller.tasks.joints_of(other)
    joints = controller.motion.current_joints()
    offsets = controller.motion.settings.axis_offsets
    at = RobJoint(*map(_flushed, joints.robax))
    return JointTarget(at, without_axis_offsets(joints.extax, offsets))


def c_pos(
    controller: Controller,
    *,
    tool: Pers[ToolData] | None = None,
    wobj: Pers[WobjData] | None = None,
) -> Pos:
    """The position [mm] of the TCP, without its orientation."""
    return c_rob_t(controller, tool=tool, wobj=wobj).trans


def c_tool(
    controller: Controller,
    *,
    task_ref: Var[TaskId] | None = None,
    task_name: String | None = None,
) -> ToolData:
    """The tool of the last move."""
    other = _other_task(controller.tasks, task_ref, task_name)
    return (
        controller.motion.active_tool() if other is None else controller.tasks.frames_of(other)[0]
    )


def c_wobj(
    controller: Controller,
    *,
    task_ref: Var[TaskId] | None = None,
    task_name: String | None = None,
) -> WobjData:
    """The work object of the last move."""
    other = _other_task(controller.tasks, task_ref, task_name)
    return (
        controller.motion.active_wobj() if other is None else controller.tasks.frames_of(other)[1]
    )


def calc_rob_t(
    controller: Motion,
    joint_target: JointTarget,
    tool: Pers[ToolData],
    *,
    wobj: Pers[WobjData] | None = None,
) -> RobTarget:
    """The position of the TCP at axis positions."""
    of_wobj = WOBJ0 if wobj is None else wobj.value
    stands = controller.target_at(joint_target, tool.value, of_wobj)
    return _without_noise(in_program(controller, stands))


def calc_joint_t(
    controller: Controller,
    rob_target: RobTarget,
    tool: Pers[ToolData],
    *,
    use_cur_wobj_pos: Switch = False,
    wobj: Pers[WobjData] | None = None,
    error_number: InOut[ErrNum] | None = None,
) -> JointTarget:
    r"""Axis positions that reach a target in its configuration.

    Configuration and limits apply as in a move: with ConfJ off the nearest solution is used. With
    \ErrorNumber an unreachable target stores the error number there and returns all axes at 0.
    """
    note_ignored_options(controller.fidelity, "CalcJointT", {r"\UseCurWObjPos": use_cur_wobj_pos})
    of_wobj = WOBJ0 if wobj is None else wobj.value
    try:
        joints = controller.motion.joints_at(
            in_object(controller.motion, rob_target), tool.value, of_wobj
        )
    except RapidError as error:
        if error_number is None:
            raise
        error_number.value = error.errno
        return JointTarget(RobJoint(0.0, 0.0, 0.0, 0.0, 0.0, 0.0), NO_EXTERNAL_AXES)
    if error_number is not None:
        error_number.value = 0.0
    offsets = controller.motion.settings.axis_offsets
    at = RobJoint(*map(_flushed, joints.robax))
    return JointTarget(at, without_axis_offsets(joints.extax, offsets))


def c_speed_override(controller: Motion, *, c_task: Switch = False) -> Num:
    """The speed override [%] of the operator, set by SpeedRefresh."""
    del c_task
    return controller.settings.speed_refresh_percent


def _without_noise(position: RobTarget) -> RobTarget:
    """Position of the TCP with rounding noise replaced by 0, because programs print it."""
    return position._replace(
        trans=Pos(*map(_flushed, position.trans)), rot=Orient(*map(_flushed, position.rot))
    )


def _flushed(value: float) -> float:
    return 0.0 if abs(value) < _NOISE else value


def _other_task(
    controller: TaskService, task_ref: Reference[object] | None, task_name: str | None
) -> str | None:
    """Name of another task whose robot an argument means; None for the calling task's own.

    For a task without a robot the default is the robot task that it belongs to.
    """
    meant = named_task(task_ref, task_name) or controller.robot_task
    return None if meant.lower() == controller.task_name.lower() else meant


_TASK = r"\TaskRef|\TaskName"

ROBOT_STATE = table(
    routine("CRobT", c_rob_t, rf"{_TASK} \Tool \WObj", does=Trait.READ_TASK),
    routine("CJointT", c_joint_t, _TASK, does=Trait.READ_TASK),
    routine("CPos", c_pos, does=Trait.READ_TASK),
    routine("CTool", c_tool, _TASK, does=Trait.READ_TASK),
    routine("CWObj", c_wobj, _TASK, does=Trait.READ_TASK),
    routine("CalcRobT", calc_rob_t, r"Joint_target Tool \WObj", does=Trait.READ_TASK),
    routine(
        "CalcJointT",
        calc_joint_t,
        r"\UseCurWObjPos Rob_target Tool \WObj \ErrorNumber",
        does=Trait.READ_TASK,
    ),
    routine("CSpeedOverride", c_speed_override, does=Trait.READ_TASK),
)
