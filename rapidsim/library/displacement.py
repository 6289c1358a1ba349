"""Program displacement and offsets of external axes: setting, applying, removing.

The coordinates of a displaced target refer to a frame within the object frame; the active
displacement is a setting of the task.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "PDispOn",
"EOffsOn", "ORobT".
"""

from __future__ import annotations

from dataclasses import replace

from rapidsim.frames.vectors import minus
from rapidsim.language.annotations import Pers, Switch
from rapidsim.language.controller import Motion
from rapidsim.language.data import (
    IDENTITY_POSE,
    UNUSED_AXIS,
    ExtJoint,
    Pose,
    RobTarget,
    ToolData,
    WobjData,
)
from rapidsim.language.single_precision import single
from rapidsim.library.poses import composed, inverted, rounded, single_pos
from rapidsim.library.table import routine, table
from rapidsim.library.traits import Trait


def in_object(controller: Motion, point: RobTarget) -> RobTarget:
    """A programmed target with displacement and offsets applied."""
    settings = controller.settings
    if settings.displacement is None and settings.axis_offsets is None:
        return point
    moved = _displaced(point, settings.displacement)
    return moved._replace(extax=with_axis_offsets(point.extax, settings.axis_offsets))


def in_program(controller: Motion, point: RobTarget) -> RobTarget:
    """Target in the object frame, converted to the coordinates that the program would use."""
    settings = controller.settings
    if settings.displacement is None and settings.axis_offsets is None:
        return point
    back = None if settings.displacement is None else inverted(settings.displacement)
    moved = _displaced(point, back)
    return moved._replace(extax=without_axis_offsets(point.extax, settings.axis_offsets))


def with_axis_offsets(axes: ExtJoint, offsets: ExtJoint | None) -> ExtJoint:
    """External axes with offsets added; unused axes stay unused."""
    if offsets is None:
        return axes
    return ExtJoint(
        *(
            axis if UNUSED_AXIS in (axis, offset) else single(axis + offset)
            for axis, offset in zip(axes, offsets, strict=True)
        )
    )


def without_axis_offsets(axes: ExtJoint, offsets: ExtJoint | None) -> ExtJoint:
    """External axes with offsets removed."""
    if offsets is None:
        return axes
    negative = (o if o == UNUSED_AXIS else -o for o in offsets)
    return with_axis_offsets(axes, ExtJoint(*negative))


def p_disp_on(
    controller: Motion,
    prog_point: RobTarget,
    tool: Pers[ToolData],
    *,
    rot: Switch = False,
    exe_p: RobTarget | None = None,
    wobj: Pers[WobjData] | None = None,
) -> None:
    r"""Displace the program by the difference of a target and the robot's position, or \ExeP."""
    if exe_p is None:
        exe_p = controller.current_target(tool.value, None if wobj is None else wobj.value)
    if rot:
        executed = Pose(exe_p.trans, exe_p.rot)
        frame = rounded(composed(executed, inverted(Pose(prog_point.trans, prog_point.rot))))
    else:
        way = single_pos(minus(exe_p.trans, prog_point.trans))
        frame = Pose(way, IDENTITY_POSE.rot)
    controller.settings = replace(controller.settings, displacement=frame)


def p_disp_set(controller: Motion, disp_frame: Pose) -> None:
    """Displace the program by a frame."""
    controller.settings = replace(controller.settings, displacement=rounded(disp_frame))


def p_disp_off(controller: Motion) -> None:
    """End the program displacement."""
    controller.settings = replace(controller.settings, displacement=None)


def e_offs_on(controller: Motion, prog_point: RobTarget, *, exe_p: RobTarget | None = None) -> None:
    r"""Offset the external axes by the difference of a target and their position, or \ExeP."""
    axes = controller.current_joints().extax if exe_p is None else exe_p.extax
    offsets = without_axis_offsets(axes, prog_point.extax)
    controller.settings = replace(controller.settings, axis_offsets=offsets)


def e_offs_set(controller: Motion, e_ax_offs: ExtJoint) -> None:
    """Offset the external axes."""
    controller.settings = replace(controller.settings, axis_offsets=e_ax_offs)


def e_offs_off(controller: Motion) -> None:
    """End the offsets of external axes."""
    controller.settings = replace(controller.settings, axis_offsets=None)


def o_rob_t(
    controller: Motion,
    org_point: RobTarget,
    *,
    in_p_disp: Switch = False,
    in_e_offs: Switch = False,
) -> RobTarget:
    r"""A programmed target in the object frame, without offsets unless a switch keeps them."""
    settings = controller.settings
    moved = org_point if in_p_disp else _displaced(org_point, settings.displacement)
    if in_e_offs:
        return moved
    return moved._replace(extax=with_axis_offsets(moved.extax, settings.axis_offsets))


def _displaced(point: RobTarget, object_from_displaced: Pose | None) -> RobTarget:
    if object_from_displaced is None:
        return point
    pose = rounded(composed(object_from_displaced, Pose(point.trans, point.rot)))
    return point._replace(trans=pose.trans, rot=pose.rot)


_DISPLACEMENT = ("displacement",)
_OFFSETS = ("axis_offsets",)

DISPLACEMENT = table(
    routine(
        "PDispOn",
        p_disp_on,
        r"\Rot \ExeP ProgPoint Tool \WObj",
        sets=_DISPLACEMENT,
        back="PDispOff",
    ),
    routine("PDispSet", p_disp_set, sets=_DISPLACEMENT, back="PDispOff"),
    routine("PDispOff", p_disp_off, sets=_DISPLACEMENT, back="PDispOff"),
    routine("EOffsOn", e_offs_on, r"\ExeP ProgPoint", sets=_OFFSETS, back="EOffsOff"),
    routine("EOffsSet", e_offs_set, "EAxOffs", sets=_OFFSETS, back="EOffsOff"),
    routine("EOffsOff", e_offs_off, sets=_OFFSETS, back="EOffsOff"),
    routine("ORobT", o_rob_t, r"OrgPoint \InPDisp|\InEOffs", does=Trait.READ_TASK),
)
