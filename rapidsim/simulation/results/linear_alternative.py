"""Linear alternative of a move: MoveL to the same target, from the same joints.

It is followed as in a run, on the current branch of the arm, so that it fails where the run of that
MoveL fails.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from rapidsim.controller.moves.arrival import end_of_curve
from rapidsim.controller.moves.configuration_choice import nearest
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.confdata import (
    Configuration,
    configurations,
    has_branches,
)
from rapidsim.motion.geometry.curves import curves_of
from rapidsim.motion.geometry.joint_mapping import arms_of
from rapidsim.motion.geometry.segments import (
    CircleMode,
    Geometry,
    Segment,
    Waypoint,
    without_carrier_axes,
)
from rapidsim.motion.model import MotionModel
from rapidsim.motion.path.building import build_path
from rapidsim.motion.path.curve_following import PathFault
from rapidsim.motion.robot.robot import Robot
from rapidsim.simulation.results.simulation import RobotRun
from rapidsim.values import value_class

_PLACES = 101


@value_class(frozen=True, slots=True, eq=False)
class LinearAlternative:
    """A line as far as the arm can follow it."""

    tcp: Array
    """Positions (k, 3) [m] in base of the TCP for the solved joints, evenly spaced."""
    start: Array
    """Shape (3,) [m]."""
    end: Array
    fault: PathFault | None
    """Position and reason of the failure; None if the line is possible."""
    arrival: Configuration | None
    """Configuration of the arm at the end; None if it is not reached."""

    @property
    def fails_at(self) -> Array | None:
        """Position (3,) [m] of the failure; None if there is none."""
        if self.fault is None:
            return None
        return self.start + self.fault.fraction * (self.end - self.start)


def segments_of(robot_run: RobotRun) -> Mapping[int, Segment]:
    """Return the executed segments of a robot's moves, by number of the move."""
    # If a path was planned again from within a move, the first segment is the whole one.
    return {
        number: without_carrier_axes(segment)
        for piece in reversed(robot_run.trajectory.pieces)
        for number, segment in piece.numbered
    }


def linear_alternative(
    robot: Robot, segment: Segment, model: MotionModel
) -> LinearAlternative | None:
    """Follow the line from the start of a move to its end.

    Args:
        robot: The arm.
        segment: The move.
        model: The motion model of the run.

    Returns:
        The line; None if it cannot be computed: something other than the arm moves tool or work, or
        the inverse kinematics of the arm is iterative.
    """
    kinematics = robot.kinematics
    carried = segment.carrier is not None or bool(segment.rides)
    if carried or robot.external or not has_branches(kinematics):
        return None
    joints = segment.start.joints
    tcp = kinematics.forward(joints) @ segment.tcp_from_flange.inverse()
    line = replace(
        segment,
        geometry=Geometry.LINE,
        start=Waypoint(joints, tcp),
        branch=int(kinematics.branch_of(joints)),
        zone=None,
        via=None,
        wrist_in_joints=False,
        circle_mode=CircleMode.PATH_FRAME,
    )
    arrival = _arrival(robot, line)
    if arrival is not None:
        line = replace(line, end=replace(line.end, joints=arrival.joints))
    built = build_path(robot, [line], model)
    fault = built if isinstance(built, PathFault) else None
    return LinearAlternative(
        tcp=_followed(robot, line, 1.0 if fault is None else fault.fraction),
        start=tcp.translation,
        end=line.end.base_from_tcp.translation,
        fault=fault,
        arrival=arrival if fault is None else None,
    )


def _arrival(robot: Robot, line: Segment) -> Configuration | None:
    """Return the end configuration; the nearest one if the branch ends before, None without any."""
    arrived = end_of_curve(robot, line)
    if arrived is not None:
        return arrived
    working = configurations(robot, line.end.base_from_tcp @ line.tcp_from_flange)
    return nearest(working, line.start.joints) if working else None


def _followed(robot: Robot, line: Segment, share: float) -> Array:
    """TCP (k, 3) [m] by forward kinematics of the joints solved along a share of the line."""
    kinematics = robot.kinematics
    curves = curves_of((line,), kinematics)
    arms = arms_of((line,), kinematics, curves.joint_travel, curves.length)
    row = np.zeros(_PLACES, dtype=np.int64)
    motion = curves.at(row, np.linspace(0.0, share, _PLACES) * curves.length[0])
    flange = arms.base_from_flange(motion, row, np.tile(line.start.joints, (_PLACES, 1)))
    solved = kinematics.inverse_on_branch(flange, line.branch, line.start.joints)
    flange_from_tcp: Transform = line.tcp_from_flange.inverse()
    tcp = kinematics.forward(solved.joints[solved.exists]) @ flange_from_tcp
    return tcp.translation
