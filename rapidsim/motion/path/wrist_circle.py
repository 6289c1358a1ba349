r"""Arcs guided by two wrist axes: start, end, deviations, and reasons for failure.

Source: Technical reference manual RAPID Instructions, "CirPathMode". Two assumptions are our own,
as the manual does not specify them: the largest tilt of the tool from perpendicular, and that an
arc after such an arc starts where the z axis intersects the plane rather than at the TCP.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from rapidsim.diagnostics import Violation
from rapidsim.findings.wrist_circles import WristCircleDeviates, WristCircleTilted
from rapidsim.frames.rotation_vectors import vector_from_rotation
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.geometry.curves import curves_of
from rapidsim.motion.geometry.joint_mapping import Index, JointMapper, arms_of
from rapidsim.motion.geometry.segments import Segment, Waypoint
from rapidsim.motion.geometry.wrist_pair import FLATTEST, PairTurns
from rapidsim.motion.kinematics.arm import Kinematics, Mask
from rapidsim.values import value_class

_UPRIGHT = np.radians(10.0)
"""Angle [rad] of the tool from perpendicular to the circle above which a tilt is reported."""
_TOLD_TURN = np.radians(0.5)
_PLACES = 129
_ON_THE_AXIS = 1e-6
_IN_LINE = 1e-3
_MM = 1e3
_SINGULAR_ONLY = np.radians(0.05)
"""Angle [rad] outside a pair's range up to which a failed circle is reported as singular."""
_BY_ALL_AXES = r"use all axes, with CirPathMode \PathFrame"


@value_class(frozen=True, slots=True, eq=False)
class WristCircleError:
    """Path deviation of an arc guided by two wrist axes."""

    arrival: Array
    """Joints (n,) [rad] at the end."""
    tilt: float
    """Angle [rad] between the tool's z axis and the normal of the plane at the start; 0 if the arc
    continues another, which has tilted the tool."""
    off_plane: float
    """Largest distance [m] of the TCP from the plane."""
    turned: float
    """Largest rotation [rad] of the tool from its programmed orientation."""
    off_end: float
    """Final distance [m] of the TCP from the programmed end."""


@value_class(frozen=True, slots=True)
class WristCircleRefusal:
    """Reason why two wrist axes cannot follow a circle, and a possible remedy."""

    reason: str
    cure: str


def start_on_circle(base_from_tcp: Transform, aim: Array | None) -> Transform:
    """Return the start of an arc guided by two wrist axes: the TCP, or the previous arc's aim.

    Args:
        base_from_tcp: The current pose.
        aim: The programmed end (3,) [m] of the arc before, or None; it is used as long as the z
            axis of the tool passes through it.
    """
    if aim is None:
        return base_from_tcp
    x, y, _ = base_from_tcp.inverse().apply(aim)
    if np.hypot(x, y) > _ON_THE_AXIS:
        return base_from_tcp
    return Transform(base_from_tcp.rotation, aim)


def end_of_circle(end: Waypoint) -> Waypoint:
    """Return the end of an arc guided by two wrist axes, with the programmed point as aim."""
    return replace(end, aim=end.base_from_tcp.translation)


def wrist_circle_error(kinematics: Kinematics, segment: Segment) -> WristCircleError | None:
    """Return the deviation of an arc guided by two wrist axes; None if they cannot follow it."""
    curves = curves_of((segment,), kinematics)
    arms = arms_of((segment,), kinematics, curves.joint_travel, curves.length)
    if arms.pairs is None:
        return None
    row = np.zeros(_PLACES, dtype=np.int64)
    motion = curves.at(row, np.linspace(0.0, float(curves.length[0]), _PLACES))
    near = np.broadcast_to(segment.start.joints, (_PLACES, kinematics.joint_count))
    joints, exists = arms.pairs.joints(motion.position, row, near)
    if not exists.all():
        return None
    taken = kinematics.forward(joints) @ segment.tcp_from_flange.inverse()
    normal = arms.pairs.normal[0]
    goes_on = np.linalg.norm(taken.translation[0] - motion.position[0]) > _ON_THE_AXIS
    upright = 1.0 if goes_on else min(1.0, abs(float(arms.pairs.tool_z[0] @ normal)))
    turn = vector_from_rotation(taken.rotation @ np.swapaxes(motion.rotation, -1, -2))
    end = taken.translation[-1] - segment.end.base_from_tcp.translation
    return WristCircleError(
        arrival=np.unwrap(joints, axis=0)[-1],
        tilt=float(np.arccos(upright)),
        off_plane=float(np.abs((taken.translation - motion.position) @ normal).max()),
        turned=float(np.linalg.norm(turn, axis=-1).max()),
        off_end=float(np.linalg.norm(end)),
    )


def findings_on_pair(
    error: WristCircleError, segment: Segment, target: str
) -> tuple[Violation, ...]:
    """Return findings about an arc to a target that two wrist axes guide."""
    pair = segment.circle_mode.value
    found: list[Violation] = []
    if error.tilt > _UPRIGHT:
        found.append(WristCircleTilted(target, np.degrees(error.tilt), pair))
    if error.turned > _TOLD_TURN:
        off_plane_mm, off_end_mm = _MM * error.off_plane, _MM * error.off_end
        found.append(
            WristCircleDeviates(target, pair, off_plane_mm, np.degrees(error.turned), off_end_mm)
        )
    return tuple(found)


def wrist_circle_refusal(arms: JointMapper, place: Array, row: Index) -> WristCircleRefusal:
    """Return the reason why the pair of one arc cannot aim the z axis at points (k, 3) of it.

    The first point determines the reason, all of them its extent.
    """
    pairs, here = arms.pairs, row[:1]
    assert pairs is not None
    centre, spoke = pairs.centre[here[0]], pairs.aim[here[0]]
    first, second = pairs.first[here[0]], pairs.second[here[0]]
    low, high = (int(axis) + 1 for axis in pairs.axes[here[0]])
    names, other = f"axes {low} and {high}", f"take another pair of wrist axes, or {_BY_ALL_AXES}"
    if _in_line(first, second):
        angle = np.degrees(pairs.start[here[0], 4])
        return WristCircleRefusal(
            f"{names} are in one line, with axis 5 at {angle:.1f} deg", f"bend axis 5, {other}"
        )
    for axis, direction in ((low, first), (high, second)):
        if _in_line(direction, spoke):
            return WristCircleRefusal(
                f"the tool's z axis lies along axis {axis}, which cannot move it",
                f"bend wrist or tool so that it leans away from axis {axis}, {other}",
            )
    aim, start = pairs.aimed(place, row), pairs.aimed((centre + spoke)[None], here)
    flattest = np.degrees(np.arcsin(aim.steepness[0] if start.exists[0] else start.steepness[0]))
    if flattest < np.degrees(FLATTEST) and (not start.exists[0] or _within(aim)[0]):
        return WristCircleRefusal(
            f"the tool's z axis hardly crosses the plane of the circle, at {flattest:.1f} deg",
            f"start with the tool perpendicular to the circle, or {_BY_ALL_AXES}",
        )
    if aim.grazes[0] > 0.0:
        closest = int(aim.grazes.argmax())
        beside = aim.grazes[closest] + float(np.linalg.norm(place[closest] - centre))
        return WristCircleRefusal(
            f"the tool's z axis passes {_MM * beside:.1f} mm beside the wrist, and the circle "
            f"comes up to {_MM * aim.grazes[closest]:.1f} mm nearer to it",
            f"use a tool whose z axis points away from the wrist, or {_BY_ALL_AXES}",
        )
    if not start.exists[0] or _within(aim)[0]:
        where = "on the way" if start.exists[0] else "where the circle starts"
        return WristCircleRefusal(
            f"{names} both move the tool's z axis the same way {where}: they are singular",
            f"start the circle in another posture, {other}",
        )
    farthest = int(aim.beyond.argmax())
    beyond = float(aim.beyond[farthest])
    miss = _MM * beyond * float(np.linalg.norm(place[farthest] - centre))
    return WristCircleRefusal(
        f"the circle goes up to {miss:.1f} mm ({np.degrees(beyond):.1f} deg) beyond where {names} "
        "take the tool's z axis",
        f"make the circle smaller, {other}",
    )


def _within(aim: PairTurns) -> Mask:
    """Mask of points (k,) that a pair reaches, or misses by so little that it is singular there."""
    within: Mask = (aim.beyond < _SINGULAR_ONLY) & (aim.grazes <= 0.0)
    return within


def _in_line(a: Array, b: Array) -> bool:
    """Whether two vectors (3,) are parallel."""
    return bool(np.linalg.norm(np.cross(a, b)) < _IN_LINE * np.linalg.norm(a) * np.linalg.norm(b))
