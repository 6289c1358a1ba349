"""Robots from URDF files: joints, limits and frames by yourdfpy, kinematics by recognition.

The only module that imports yourdfpy, which takes two seconds; `load_robot` imports it when asked
for a file.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf
from pathlib import Path

import numpy as np
import yourdfpy

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.catalogue import RobotError
from rapidsim.motion.kinematics import Kinematics
from rapidsim.motion.opw_geometry import JOINT_COUNT
from rapidsim.motion.opw_recognise import AxesAtZero, ortho_parallel_arm

FLANGE_NAMES = ("tool0", "flange")
"""Links that are the flange, the first that the file has; else the link of the last axis."""
TURNING = ("revolute", "continuous")


@dataclass(frozen=True, slots=True, eq=False)
class RobotParts:
    """What a description says of a robot."""

    name: str
    joint_names: tuple[str, ...]
    limits: tuple[tuple[float, float], ...]
    """[rad]; infinite for continuous joints."""
    max_speeds: tuple[float | None, ...]
    """[rad/s]"""
    kinematics: Kinematics


def robot_parts_from_urdf(file: Path) -> RobotParts:
    """Read a URDF.

    Raises:
        RobotError: If the file is no URDF, or its arm is not six axes of the ortho-parallel kind.
    """
    robot = _read(file)
    joints = _moving_joints(file, robot)
    axes = _axes_at_zero(robot, joints)
    arm = ortho_parallel_arm(axes)
    if isinstance(arm, str):
        raise RobotError(
            f"{file}: {arm}; only arms with axis 2 square to axis 1, axis 3 parallel to axis 2 and "
            "a spherical wrist are supported, a numerical solver for others is not built yet"
        )
    return RobotParts(
        name=robot.name,
        joint_names=tuple(joint.name for joint in joints),
        limits=tuple(_limits(file, joint) for joint in joints),
        max_speeds=tuple(joint.limit.velocity if joint.limit else None for joint in joints),
        kinematics=arm,
    )


def _read(file: Path) -> yourdfpy.Robot:
    try:
        text = file.read_bytes()
    except OSError as failure:
        raise RobotError(f"{file}: {failure.strerror}") from None
    if b"<!DOCTYPE" in text or b"<!ENTITY" in text:
        # Entities can blow a small file up to gigabytes or read others; a URDF needs none.
        raise RobotError(f"{file}: a robot description must not declare XML entities")
    try:
        return yourdfpy.URDF.load(
            str(file), load_meshes=False, build_scene_graph=False, load_collision_meshes=False
        ).robot
    except (ValueError, AttributeError, TypeError, SyntaxError) as mistake:
        # yourdfpy has no error of its own: it fails wherever a tag or attribute is missing.
        raise RobotError(f"{file}: not a readable URDF: {mistake}") from None


def _moving_joints(file: Path, robot: yourdfpy.Robot) -> list[yourdfpy.Joint]:
    """The moving joints from base to flange."""
    moving = [joint for joint in robot.joints if joint.type != "fixed"]
    for joint in moving:
        if joint.type not in TURNING or joint.mimic is not None:
            kind = "mimic" if joint.mimic is not None else joint.type
            raise RobotError(f"{file}: {kind} joint `{joint.name}` is not supported yet")
    if len(moving) != JOINT_COUNT:
        raise RobotError(
            f"{file}: {len(moving)} moving joints; only arms with {JOINT_COUNT} are supported yet"
        )
    joint_to = {joint.child: joint for joint in robot.joints}
    ordered = max((_towards_base(joint_to, joint) for joint in moving), key=len)[::-1]
    if len(ordered) != JOINT_COUNT:
        raise RobotError(f"{file}: the moving joints do not follow one another in one chain")
    return ordered


def _towards_base(
    joint_to: dict[str, yourdfpy.Joint], joint: yourdfpy.Joint
) -> list[yourdfpy.Joint]:
    """A joint and the moving joints that carry it."""
    carried: list[yourdfpy.Joint] = []
    step: yourdfpy.Joint | None = joint
    while step is not None:
        if step.type != "fixed":
            carried.append(step)
        step = joint_to.get(step.parent)
    return carried


def _axes_at_zero(robot: yourdfpy.Robot, joints: list[yourdfpy.Joint]) -> AxesAtZero:
    base_from_link = _frames_at_zero(robot)
    names = {link.name for link in robot.links}
    last = joints[-1].child
    flange = next((name for name in FLANGE_NAMES if name in names), last)
    matrices = np.array([base_from_link[joint.child] for joint in joints])
    axes = np.array([joint.axis for joint in joints], dtype=np.float64)
    axes /= np.linalg.norm(axes, axis=-1, keepdims=True)
    rotations, points = matrices[:, :3, :3], matrices[:, :3, 3]
    return AxesAtZero(
        directions=np.einsum("kij,kj->ki", rotations, axes),
        points=points,
        base_from_link=Transform(rotations, points),
        base_from_flange=_transform(base_from_link[flange]),
    )


def _frames_at_zero(robot: yourdfpy.Robot) -> dict[str, Array]:
    """base_from_link as matrix (4, 4) of every link with all joints at 0."""
    children = {joint.child for joint in robot.joints}
    frames = {link.name: np.eye(4) for link in robot.links if link.name not in children}
    waiting = list(robot.joints)
    while waiting:
        known = [joint for joint in waiting if joint.parent in frames]
        if not known:
            break
        for joint in known:
            origin = np.eye(4) if joint.origin is None else joint.origin
            frames[joint.child] = frames[joint.parent] @ origin
        waiting = [joint for joint in waiting if joint.child not in frames]
    return frames


def _limits(file: Path, joint: yourdfpy.Joint) -> tuple[float, float]:
    if joint.type == "continuous":
        return -inf, inf
    limit = joint.limit
    if limit is None or limit.lower is None or limit.upper is None:
        raise RobotError(f"{file}: joint `{joint.name}` has no limits")
    return float(limit.lower), float(limit.upper)


def _transform(matrix: Array) -> Transform:
    return Transform(matrix[:3, :3], matrix[:3, 3])
