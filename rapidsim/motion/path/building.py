"""Building of a path from segments: first curves and corners, then the joints along them."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.blends import Corners, corners_of, without_skipped
from rapidsim.motion.geometry.curves import Curves, Index, circle_fault, curves_of, unsupported
from rapidsim.motion.geometry.joint_mapping import JointMapper, arms_of
from rapidsim.motion.geometry.parameterisation import CarrierAxes, layout_of
from rapidsim.motion.geometry.segments import Geometry, Segment
from rapidsim.motion.interruption import Look, undisturbed
from rapidsim.motion.model import MotionModel
from rapidsim.motion.path.along_curves import course_of
from rapidsim.motion.path.curve_following import FaultKind, PathFault, follow, limit_fault
from rapidsim.motion.path.line_derivatives import lines_of
from rapidsim.motion.path.nominal_times import NominalTimes, nominal_times
from rapidsim.motion.path.path import Path
from rapidsim.motion.robot.external_axes import Axes
from rapidsim.motion.robot.robot import Robot

_CORNER_CHECKS = 8


def build_path(
    robot: Robot,
    segments: Sequence[Segment],
    model: MotionModel,
    check_deadline: Look = undisturbed,
) -> Path | PathFault:
    """Join segments to a path.

    Args:
        robot: The arm with its joint limits.
        segments: At least one; each starts with the joints at the end of the previous one, and has
            speeds above zero.
        model: Shape of corners.
        check_deadline: Called regularly.

    Returns:
        The path, or the first point where the arm cannot follow it.
    """
    outline = outline_of(robot, segments, model, check_deadline)
    return outline if isinstance(outline, PathFault) else path_along(outline, check_deadline)


@dataclass(frozen=True, eq=False)
class Outline:
    """Curves and corners of a path, before inverse kinematics along it."""

    robot: Robot
    segments: Sequence[Segment]
    model: MotionModel
    active: Index
    """Shape (m,): see `Path.active`."""
    curves: Curves
    arms: JointMapper
    corners: Corners

    @property
    def segment_bounds(self) -> Array:
        """Path parameters at segment ends; see `Path.segment_bounds`."""
        lengths = np.zeros(len(self.segments))
        lengths[self.active] = self.curves.length
        return np.concatenate([[0.0], np.cumsum(lengths)])

    @property
    def nominal(self) -> NominalTimes:
        """Times of the segments at the programmed speeds."""
        return nominal_times(self.segments, self.curves, self.active)


def outline_of(
    robot: Robot,
    segments: Sequence[Segment],
    model: MotionModel,
    check_deadline: Look = undisturbed,
) -> Outline | PathFault:
    """Return the curves and corners of segments; see `build_path`."""
    kinematics = robot.kinematics
    for i, segment in enumerate(segments):
        if segment.geometry is Geometry.JOINT:
            continue
        if (reason := circle_fault(segment)) is not None:
            return PathFault(i, 0.0, 0.0, 0.0, reason, FaultKind.SET_UP)
        if (reason := unsupported(kinematics)) is not None:
            return PathFault(i, 0.0, 0.0, 0.0, reason, FaultKind.NOT_SIMULATED)
    curves = curves_of(segments, kinematics)
    active = np.flatnonzero(curves.length > 0.0).astype(np.int64)
    if not len(active):
        active = np.zeros(1, dtype=np.int64)
    moving = [segments[int(i)] for i in active]
    if len(active) < len(segments):
        curves = curves_of(moving, kinematics)
    check_deadline()
    arms = arms_of(moving, kinematics, curves.joint_travel, curves.length)
    corners = without_skipped(corners_of(moving, curves, arms, model), active)
    return Outline(robot, segments, model, active, curves, arms, corners)


def path_along(
    outline: Outline,
    check_deadline: Look = undisturbed,
    carrier_axes: CarrierAxes | None = None,
    further: Array | None = None,
) -> Path | PathFault:
    """Solve the joints along an outline; see `build_path` and `layout_of`."""
    segments, active, arms, model = outline.segments, outline.active, outline.arms, outline.model
    kinematics, axes = outline.robot.kinematics, outline.robot.axes
    moving = [segments[int(i)] for i in active]
    layout = layout_of(outline.curves, outline.corners, model.corner, carrier_axes, further)
    lines = lines_of(layout, arms)
    nodes = follow(layout, arms, lines, moving, axes, check_deadline)
    if isinstance(nodes, PathFault):
        return dataclasses.replace(nodes, segment=int(active[nodes.segment]))
    course = nodes.course if lines is None else course_of(nodes, lines.regular(nodes))
    path = Path(segments, kinematics, layout, arms, active, course, model, lines)
    check_deadline()
    fault = _joint_space_fault(path, axes)
    if fault is not None:
        return dataclasses.replace(fault, segment=int(active[fault.segment]))
    return path


def _joint_space_fault(path: Path, axes: Axes) -> PathFault | None:
    """Return the first point where a joint move or joint-space corner exceeds limits, or None."""
    layout = path.layout
    pieces = np.flatnonzero(
        layout.curves.in_joints[layout.row] | (layout.joint_corner >= 0)
    ).astype(np.int64)
    if not len(pieces):
        return None
    share = np.linspace(0.0, 1.0, _CORNER_CHECKS + 1)
    width = np.diff(layout.bounds)[pieces]
    s = (layout.bounds[pieces][:, None] + width[:, None] * share).ravel()
    piece = np.repeat(pieces, len(share))
    joints, _, _ = path._in_joint_space(s, piece)
    return limit_fault(layout, s, layout.row[piece], joints, axes)
