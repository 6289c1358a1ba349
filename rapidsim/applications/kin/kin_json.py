"""Results of `rapidsim kin` as records of JSON: mm, degrees, quaternions scalar first."""

from __future__ import annotations

from collections.abc import Sequence
from math import degrees
from typing import Annotated, ClassVar

import numpy as np

from rapidsim.frames.euler import Convention, euler_from_rotation
from rapidsim.frames.transform import Array, Transform
from rapidsim.json_records.declarations import Key, OrAbsent, OutputRecord, ValueForm
from rapidsim.motion.configurations.confdata import confdata_of
from rapidsim.motion.configurations.pose_solutions import PoseSolutions
from rapidsim.motion.configurations.postures import Postures
from rapidsim.motion.configurations.singularities import Differential, joint_speeds, rapid_speeds
from rapidsim.motion.robot.robot import Robot
from rapidsim.report.tables.axis_tables import Matrix, matrix_in_mm, plain_numbers
from rapidsim.values import value_class

_DIGITS = 12
"""Decimals of joints [deg], so that 30 is printed as 30."""


@value_class(frozen=True, slots=True)
class PlacedFrame:
    """A pose."""

    position_mm: Sequence[float]
    quaternion: Sequence[float]
    """Scalar first."""


@value_class(frozen=True, slots=True)
class LinkFrame:
    """Pose of a link."""

    name: str
    pose: Annotated[PlacedFrame, ValueForm.INLINE]


@value_class(frozen=True, slots=True)
class RelativeFrame:
    """Pose of a link in the link before it, or of the TCP in the last link."""

    name: str
    """`T(0,1)` to `T(n,TCP)`; link 0 is the base."""
    matrix: Matrix
    """The pose as a 4x4 matrix [mm]."""


@value_class(frozen=True, slots=True)
class EulerAngles:
    """Orientation of the tool as Euler angles."""

    convention: str
    names: Sequence[str]
    """Names of the angles."""
    degrees: Sequence[float]


@value_class(frozen=True, slots=True)
class ForwardReport(OutputRecord):
    """The object that `rapidsim kin fk --format json` prints."""

    robot: str
    joints_deg: Sequence[float]
    tcp: Annotated[PlacedFrame, ValueForm.INLINE]
    euler: EulerAngles
    """Orientation in the requested convention."""
    matrix: Matrix
    """Pose of the TCP as a 4x4 matrix [mm]."""
    base: PlacedFrame
    """Pose of the base in the world."""
    links: Sequence[LinkFrame]
    relative: Sequence[RelativeFrame]
    """Transforms whose product is the pose of the TCP in the base."""
    conf: Sequence[int]
    """cf1, cf4, cf6, cfx."""


@value_class(frozen=True, slots=True)
class JointSolution:
    """Joints that reach a pose."""

    joints_deg: Sequence[float]
    conf: Sequence[int]
    """cf1, cf4, cf6, cfx."""
    within_limits: bool
    residual_mm: float
    residual_deg: float


@value_class(frozen=True, slots=True)
class SearchCost:
    """Cost of a search."""

    starts: int
    iterations: int
    tolerance_mm: float
    """Residual distance at which it stops."""
    tolerance_deg: float
    time_s: float
    """Wall-clock time, on which nothing depends."""


@value_class(frozen=True, slots=True)
class InverseReport(OutputRecord):
    """The object that `rapidsim kin ik --format json` prints."""

    robot: str
    solver: str
    solutions: Sequence[JointSolution]
    reachable: bool
    reason: Annotated[str | None, Key("why")]
    """Reason why the pose cannot be reached; null if it can."""
    search: OrAbsent[SearchCost]
    """Cost of a numerical solver."""


@value_class(frozen=True, slots=True)
class SingularityRecord:
    """A singularity of the arm."""

    name: str
    distance: float
    near: bool
    reason: str


@value_class(frozen=True, slots=True)
class MissedTwist:
    """Part of a twist that no joint speeds give."""

    velocity_mm_s: Sequence[float]
    turning_deg_s: Sequence[float]


@value_class(frozen=True, slots=True)
class JacobianReport(OutputRecord):
    """The object that `rapidsim kin jacobian --format json` prints."""

    robot: str
    jacobian: Matrix
    """Rows vx vy vz [m/rad], wx wy wz [rad/rad]."""
    frame: ClassVar[str] = "base"
    singular_values: Sequence[float]
    manipulability: float
    near: Sequence[str]
    """Names of the nearby singularities."""
    rank: int
    singularities: Sequence[SingularityRecord]
    joint_speeds_deg_s: OrAbsent[Sequence[float]]
    """With --twist: joint speeds that give the twist; mm/s for a joint that slides."""
    missed: OrAbsent[MissedTwist]
    """With --twist: the part of the twist that no joint speeds give."""


def forward_report(postures: Postures, convention: Convention) -> ForwardReport:
    """Poses of the TCP and the links; in the world, if the base is placed in it."""
    robot, joints, stands = postures.robot, postures.rows[0].joints, postures.world_from_base
    tcp = postures.world_from_tcp
    links = stands @ robot.kinematics.link_frames(joints)
    angles = plain_numbers(np.degrees(euler_from_rotation(tcp.rotation, convention)))
    return ForwardReport(
        robot=robot.name,
        joints_deg=plain_numbers(np.degrees(joints).round(_DIGITS)),
        tcp=_pose(tcp),
        euler=EulerAngles(convention.value, convention.names, angles),
        matrix=plain_numbers(matrix_in_mm(tcp)),
        base=_pose(stands),
        links=[
            LinkFrame(f"link_{number}", _pose(links[number - 1]))
            for number in range(1, len(links) + 1)
        ],
        relative=[
            RelativeFrame(name, plain_numbers(matrix_in_mm(frame)))
            for name, frame in postures.relative_frames
        ],
        conf=confdata_of(robot.kinematics, joints).tolist(),
    )


def inverse_report(
    robot: Robot, solver: str, solutions: PoseSolutions, searched: SearchCost | None
) -> InverseReport:
    """The joints that reach a pose, or why none do."""
    return InverseReport(
        robot=robot.name,
        solver=solver,
        solutions=[
            JointSolution(
                joints_deg=plain_numbers(np.degrees(solution.joints)),
                conf=solution.confdata,
                within_limits=solution.within_limits,
                residual_mm=solution.distance * 1000.0,
                residual_deg=degrees(solution.angle),
            )
            for solution in solutions.solutions
        ],
        reachable=solutions.reason is None,
        reason=solutions.reason,
        search=searched,
    )


def jacobian_report(
    robot: Robot, differential: Differential, twist: Array | None
) -> JacobianReport:
    """The Jacobian and what follows from it; with a twist (6,) [m/s, rad/s] also joint speeds."""
    speeds, missed = None, None
    if twist is not None:
        rates, rest = joint_speeds(differential.jacobian, twist)
        speeds = plain_numbers(rapid_speeds(robot.kinematics, rates))
        missed = MissedTwist(plain_numbers(rest[:3] * 1000.0), plain_numbers(np.degrees(rest[3:])))
    return JacobianReport(
        robot=robot.name,
        jacobian=plain_numbers(differential.jacobian),
        singular_values=plain_numbers(differential.singular_values),
        manipulability=differential.manipulability,
        near=differential.near,
        rank=differential.rank,
        singularities=[
            SingularityRecord(one.name, one.distance, one.near, one.reason)
            for one in differential.singularities
        ],
        joint_speeds_deg_s=speeds,
        missed=missed,
    )


def _pose(base_from_frame: Transform) -> PlacedFrame:
    return PlacedFrame(
        plain_numbers(base_from_frame.translation * 1000.0),
        plain_numbers(base_from_frame.quaternion),
    )
