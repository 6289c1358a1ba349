r"""Where the robot is, and what its kinematics say about positions.

Positions are those the program would have to give: program displacement is taken away again.

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
"""[mm, deg], or of a quaternion."""


def c_rob_t(
    controller: Controller,
    *,
    task_ref: Var[TaskId] | None = None,
    task_name: String | None = None,
    tool: Pers[ToolData] | None = None,
    wobj: Pers[WobjData] | None = None,
) -> RobTarget:
    """Where the TCP is; by default, of the tool and work object of the last move."""
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
    """Where the axes are."""
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
    """Where the TCP is, without its orientation [mm]."""
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
    """Where the TCP would be with the axes at given positions."""
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

    Configuration and limits are held to as by a move: with ConfJ off the nearest will do. With
    \ErrorNumber a target that cannot be reached gives the number there and all axes at 0.
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
    """The speed override of the operator [%]: that of SpeedRefresh."""
    del c_task
    return controller.settings.speed_refresh_percent


def _without_noise(position: RobTarget) -> RobTarget:
    """Where the TCP is, with 0 where rounding leaves next to nothing: programs print it."""
    return position._replace(
        trans=Pos(*map(_flushed, position.trans)), rot=Orient(*map(_flushed, position.rot))
    )


def _flushed(value: float) -> float:
    return 0.0 if abs(value) < _NOISE else value


def _other_task(
    controller: TaskService, task_ref: Reference[object] | None, task_name: str | None
) -> str | None:
    """The task whose robot is meant, if that is not the one that asks.

    A task without a robot asks for that of the task it belongs to.
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
