"""Robots from URDF files: joints, limits and frames by yourdfpy, kinematics by recognition.

The only module that imports yourdfpy, which takes two seconds; `load_robot` imports it for a file.
"""

from __future__ import annotations

from dataclasses import replace
from io import BytesIO
from math import degrees, inf, radians
from pathlib import Path

import numpy as np
import yourdfpy

from rapidsim.files import InputError, input_text
from rapidsim.frames.rotation_vectors import vector_from_rotation
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.kinematics.arm import METRES_PER_UNIT, Kinematics
from rapidsim.motion.kinematics.closed_form.opw import OrthoParallel
from rapidsim.motion.kinematics.closed_form.opw_geometry import JOINT_COUNT
from rapidsim.motion.kinematics.closed_form.opw_recognition import ortho_parallel_arm
from rapidsim.motion.kinematics.closed_form.scara import Scara
from rapidsim.motion.kinematics.closed_form.scara_recognition import scara_arm
from rapidsim.motion.kinematics.numerical.offset_wrist import near_arm
from rapidsim.motion.kinematics.numerical.revolute_chain import search_notices
from rapidsim.motion.kinematics.numerical.seeds import MOST_JOINTS
from rapidsim.motion.kinematics.numerical.solver import Numerical
from rapidsim.motion.kinematics.serial_chain import AxesAtZero, SerialChain
from rapidsim.motion.robot.catalogue import RobotError
from rapidsim.motion.robot.urdf_text import plain_urdf
from rapidsim.values import value_class

FLANGE_NAMES = ("tool0", "flange")
"""Names of the flange link, in order of preference; default: the link of the last axis."""
FEWEST_JOINTS = 2
TURNING = ("revolute", "continuous")
SLIDING = "prismatic"
_ALMOST_RIGHT = radians(0.05)
"""Angle [rad] by which a frame may be off a right angle because digits are missing."""
_FARTHEST_M = 10_000.0
_LONGEST_LINK_M = 20.0
"""Length above which a link is assumed to be in mm: commercial arms have links of up to 2 m."""


@value_class(frozen=True, slots=True, eq=False)
class RobotParts:
    """Content of a robot description."""

    name: str
    joint_names: tuple[str, ...]
    limits: tuple[tuple[float, float], ...]
    """[rad], see `Kinematics` for sliding joints; infinite for continuous joints."""
    max_speeds: tuple[float | None, ...]
    """[rad/s]; None if missing, or 0, which exporters write for an unknown speed."""
    kinematics: Kinematics
    notices: tuple[str, ...]
    """Notices for the user about the solver of this arm."""


def robot_parts_from_urdf(file: Path, scale: float = 1.0) -> RobotParts:
    """Read a URDF.

    Args:
        file: The description.
        scale: Factor that converts its lengths to m.

    Raises:
        RobotError: If the file is not a URDF, or its moving joints are neither one chain of turning
            axes nor a SCARA.
    """
    robot, remarks = _read(file, scale)
    _require_tree(file, robot)
    joints = _moving_joints(file, robot)
    axes = _axes_at_zero(robot, joints)
    limits = tuple(_limits(file, joint, scale) for joint in joints)
    if any(joint.type == SLIDING for joint in joints):
        return RobotParts(
            name=robot.name,
            joint_names=tuple(joint.name for joint in joints),
            limits=limits,
            max_speeds=tuple(_max_speed(joint, scale) for joint in joints),
            kinematics=_scara(file, joints, axes),
            notices=(*remarks, *_length_notices(file, robot)),
        )
    closed_form: OrthoParallel | str = f"it has {len(joints)} axes"
    if len(joints) == JOINT_COUNT:
        closed_form = ortho_parallel_arm(axes)
        if isinstance(closed_form, str) and (squared := _squared(robot)):
            tried = _axes_at_zero(squared.robot, joints)
            if not isinstance(found := ortho_parallel_arm(tried), str):
                robot, axes, closed_form = squared.robot, tried, found
                remarks += (squared.remark(file),)
    coupling = _coupling(file, robot, joints, axes)
    if coupling:
        if isinstance(closed_form, str):
            raise RobotError(
                f"{file}: {closed_form}; arms with a rod are supported only with closed formulas"
            )
        geometry = replace(closed_form.geometry, coupling=coupling)
        closed_form = replace(closed_form, geometry=geometry)
    notices: tuple[str, ...] = ()
    if coupling:
        notices = (
            f"{robot.name}: a rod moves axis 3; the limits of joint 3 - joint 2 are unknown, "
            "so poses that the rod prevents are not rejected",
        )
    arm: Kinematics
    if isinstance(closed_form, str):
        notices = search_notices(robot.name, closed_form, len(joints))
        lower, upper = np.array(limits).T
        arm = Numerical(SerialChain.uncoupled(axes), lower, upper, near_arm(axes))
    else:
        arm = closed_form
    return RobotParts(
        name=robot.name,
        joint_names=tuple(joint.name for joint in joints),
        limits=limits,
        max_speeds=tuple(_max_speed(joint, scale) for joint in joints),
        kinematics=arm,
        notices=(*remarks, *_length_notices(file, robot), *notices),
    )


@value_class(frozen=True, slots=True, eq=False)
class _Squared:
    """A description whose almost right angles are right."""

    robot: yourdfpy.Robot
    largest: float
    """Largest angle [rad] by which a frame was turned."""

    def remark(self, file: Path) -> str:
        """Return a remark for the user."""
        return (
            f"{file}: angles up to {degrees(self.largest):.3g} deg off a right angle are taken as "
            "right, as digits are missing; the arm has closed formulas then"
        )


def _squared(robot: yourdfpy.Robot) -> _Squared | None:
    """Return a description with right angles; None if no frame is almost along its parent's axes.

    Exporters that write 1.571 for 90 deg turn axes by 0.01 deg, which no arm is built with.
    """
    joints, largest = [], 0.0
    for joint in robot.joints:
        if joint.origin is not None:
            right = np.round(joint.origin[:3, :3])
            off = float(np.linalg.norm(vector_from_rotation(right.T @ joint.origin[:3, :3])))
            if abs(np.linalg.det(right)) == 1.0 and 0.0 < off <= _ALMOST_RIGHT:
                origin = joint.origin.copy()
                origin[:3, :3] = right
                joint, largest = replace(joint, origin=origin), max(largest, off)
        joints.append(joint)
    return _Squared(replace(robot, joints=joints), largest) if largest else None


def _scara(file: Path, joints: list[yourdfpy.Joint], axes: AxesAtZero) -> Scara:
    """Return the SCARA of a description with a sliding joint, the only supported kind."""
    slides = np.array([joint.type == SLIDING for joint in joints])
    arm = scara_arm(axes, slides)
    if isinstance(arm, str):
        name = joints[int(np.argmax(slides))].name
        raise RobotError(
            f"{file}: {SLIDING} joint `{name}` is supported only as axis 3 of a SCARA: {arm}"
        )
    return arm


def _length_notices(file: Path, robot: yourdfpy.Robot) -> tuple[str, ...]:
    """Return a notice about lengths that are implausible in metres."""
    longest = max(
        (joint for joint in robot.joints if joint.origin is not None),
        key=lambda joint: float(np.abs(joint.origin[:3, 3]).max()),
        default=None,
    )
    if longest is None:
        return ()
    length = float(np.abs(longest.origin[:3, 3]).max())
    if length <= _LONGEST_LINK_M:
        return ()
    return (
        f"{file}: joint `{longest.name}` is {length:g} m from the one before: URDF lengths "
        "are in m, these seem to be in mm; `--scale 0.001` converts them",
    )


def _read(file: Path, scale: float) -> tuple[yourdfpy.Robot, tuple[str, ...]]:
    """Return the description with lengths in m, and remarks on skipped non-URDF content."""
    try:
        text, remarks = plain_urdf(file, input_text(file))
    except InputError as mistake:
        raise RobotError(mistake.message) from None
    try:
        robot = yourdfpy.URDF.load(
            BytesIO(text.encode()),
            mesh_dir="",
            load_meshes=False,
            build_scene_graph=False,
            load_collision_meshes=False,
        ).robot
    except (AttributeError, LookupError, SyntaxError, TypeError, ValueError) as mistake:
        # yourdfpy has no exception class: it fails wherever a tag or attribute is missing.
        raise RobotError(f"{file}: not a readable URDF: {_reason(mistake)}") from None
    for joint in robot.joints:
        if joint.origin is not None:
            joint.origin[:3, 3] *= scale
    return robot, remarks


def _reason(mistake: Exception) -> str:
    """Describe an error of yourdfpy in words."""
    match mistake:
        case KeyError():
            return f"the attribute `{mistake.args[0]}` is missing"
        case AttributeError():
            return "a tag is missing"
        case _:
            return str(mistake)


def _require_tree(file: Path, robot: yourdfpy.Robot) -> None:
    """Raise for joints that do not form a tree, or whose values are not finite numbers."""
    links = {link.name for link in robot.links}
    joint_to: dict[str, yourdfpy.Joint] = {}
    for joint in robot.joints:
        for link in (joint.parent, joint.child):
            if link not in links:
                raise RobotError(
                    f"{file}: joint `{joint.name}` refers to link `{link}`, which does not exist"
                )
        if joint.child in joint_to:
            other = joint_to[joint.child].name
            raise RobotError(
                f"{file}: joints `{other}` and `{joint.name}` have the same child link"
            )
        joint_to[joint.child] = joint
        _require_numbers(file, joint)
    grounded: set[str] = set()
    for joint in robot.joints:
        way: dict[str, None] = {}
        link = joint.child
        while link in joint_to and link not in grounded:
            if link in way:
                raise RobotError(f"{file}: the joints form a loop through link `{link}`")
            way[link] = None
            link = joint_to[link].parent
        grounded.update(way)


def _require_numbers(file: Path, joint: yourdfpy.Joint) -> None:
    axis, origin = np.asarray(joint.axis), joint.origin
    if axis.shape != (3,) or not np.isfinite(axis).all() or not 1e-9 < np.abs(axis).max() < 1e9:
        raise RobotError(f"{file}: the axis of joint `{joint.name}` is not a direction")
    if origin is not None and not (np.abs(origin) <= _FARTHEST_M).all():
        raise RobotError(f"{file}: the origin of joint `{joint.name}` is too far away")
    limit = joint.limit
    stated = (limit.lower, limit.upper, limit.velocity) if limit else ()
    if not np.isfinite([one for one in stated if one is not None]).all():
        raise RobotError(f"{file}: the limits of joint `{joint.name}` are not finite")
    if limit and ((limit.lower or 0.0) > (limit.upper or 0.0) or (limit.velocity or 0.0) < 0.0):
        raise RobotError(f"{file}: the limits of joint `{joint.name}` are the wrong way round")


def _moving_joints(file: Path, robot: yourdfpy.Robot) -> list[yourdfpy.Joint]:
    """Return the moving joints from base to flange."""
    moving = [joint for joint in robot.joints if joint.type != "fixed"]
    for joint in moving:
        if joint.type not in (*TURNING, SLIDING):
            raise RobotError(f"{file}: {joint.type} joint `{joint.name}` is not supported yet")
    moving = [joint for joint in moving if joint.mimic is None]
    if not FEWEST_JOINTS <= len(moving) <= MOST_JOINTS:
        joints = "joint" if len(moving) == 1 else "joints"
        raise RobotError(
            f"{file}: {len(moving)} moving {joints}; supported are arms with "
            f"{FEWEST_JOINTS} to {MOST_JOINTS}"
        )
    joint_to = {joint.child: joint for joint in robot.joints}
    ordered = max((_towards_base(joint_to, joint) for joint in moving), key=len)[::-1]
    if len(ordered) != len(moving):
        raise RobotError(f"{file}: the moving joints do not follow one another in one chain")
    return ordered


def _towards_base(
    joint_to: dict[str, yourdfpy.Joint], joint: yourdfpy.Joint
) -> list[yourdfpy.Joint]:
    """Return a joint and the moving joints that carry it."""
    carried: list[yourdfpy.Joint] = []
    step: yourdfpy.Joint | None = joint
    while step is not None:
        if step.type != "fixed" and step.mimic is None:
            carried.append(step)
        step = joint_to.get(step.parent)
    return carried


def _coupling(
    file: Path, robot: yourdfpy.Robot, joints: list[yourdfpy.Joint], axes: AxesAtZero
) -> int:
    """Return the rotation of axis 3 per joint 2: -1 if a rod holds the link between level, else 0.

    Raises:
        RobotError: If a joint mimics another in any other form.
    """
    for rod in (joint for joint in robot.joints if joint.mimic is not None):
        if len(joints) == JOINT_COUNT and rod.mimic.joint == joints[1].name:
            base_from_rod = _frames_at_zero(robot)[rod.child]
            direction = base_from_rod[:3, :3] @ rod.axis / np.linalg.norm(rod.axis)
            along = float(direction @ axes.directions[2])
            off_axis = np.cross(base_from_rod[:3, 3] - axes.points[2], direction)
            multiplier = 1.0 if rod.mimic.multiplier is None else rod.mimic.multiplier
            turn = [multiplier * along, abs(along), rod.mimic.offset or 0.0, *off_axis]
            between = (rod.parent, rod.child) == (joints[1].child, joints[2].parent)
            if between and np.allclose(turn, [-1.0, 1.0, 0.0, 0.0, 0.0, 0.0], atol=1e-9):
                return -1
        raise RobotError(
            f"{file}: joint `{rod.name}` mimics `{rod.mimic.joint}`; supported is only a link that "
            "a rod holds level between joints 2 and 3"
        )
    return 0


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
    """Return base_from_link as matrix (4, 4) of every link with all joints at 0."""
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


def _max_speed(joint: yourdfpy.Joint, scale: float) -> float | None:
    """Return the speed [rad/s] of a joint; None if missing or 0, as exporters write for unknown."""
    if not joint.limit or not joint.limit.velocity:
        return None
    return float(joint.limit.velocity * _unit(joint, scale))


def _unit(joint: yourdfpy.Joint, scale: float) -> float:
    """Return the factor on values of a joint in the file; see `Kinematics`."""
    return scale / METRES_PER_UNIT if joint.type == SLIDING else 1.0


def _limits(file: Path, joint: yourdfpy.Joint, scale: float) -> tuple[float, float]:
    if joint.type == "continuous":
        return -inf, inf
    limit = joint.limit
    if limit is None or limit.lower is None or limit.upper is None:
        raise RobotError(f"{file}: joint `{joint.name}` has no limits")
    unit = _unit(joint, scale)
    return float(limit.lower) * unit, float(limit.upper) * unit


def _transform(matrix: Array) -> Transform:
    return Transform(matrix[:3, :3], matrix[:3, 3])
