"""Following of points: branch choice, inverse kinematics, and measured deviations.

Deviations compare the TCP, by forward kinematics of the solved joints, with the request.
"""

from __future__ import annotations

from math import degrees

import numpy as np
import numpy.typing as npt

from rapidsim.frames.rotation_vectors import vector_from_rotation
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.reachability import limit_excess, unreachable_reason
from rapidsim.motion.numba_jit import jit_reconsidered
from rapidsim.motion.robot.external_axes import amount_text
from rapidsim.motion.robot.robot import Robot
from rapidsim.motion.trajectory.samples import Samples
from rapidsim.motion.waypoints.plan import (
    JointsOverTime,
    Plan,
    Refused,
    TcpMotion,
    Way,
    even_joint_motion,
    quintic_motion,
    tcp_motion,
)
from rapidsim.motion.waypoints.points import Points, posed
from rapidsim.motion.waypoints.quintic import overshoot
from rapidsim.motion.waypoints.tcp_joints import (
    NOT_FROM_THERE,
    TcpJoints,
    joints_of_tcp,
    solved,
    when,
)
from rapidsim.values import value_class

DEFAULT_DT = 0.012
"""[s]"""
MOST_SAMPLES = 200_000
_SAME_INSTANT = 1e-9
"""[s]"""
_CHORDS = 64
"""Number of chords of a joint-space line, from which the travel of its TCP is computed."""


@value_class(frozen=True, slots=True, eq=False)
class FollowedTrajectory:
    """A trajectory with its joints."""

    plan: Plan
    robot: Robot
    points: Points
    attitudes: Array
    """Shape (k, 4) or (k, 1): attitude at each point."""
    flange_from_tcp: Transform
    samples: Samples
    """`move` is the index of the previous point, counted from 0."""
    wanted: Transform
    """Requested base_from_tcp (k,); for joint-space paths the resulting one."""
    deviation: Array
    """Distance (k,) [m] of the TCP from the request: at the same instant on paths of the TCP, from
    the straight line between the points on joint-space paths."""
    turn_deviation: float
    """Largest rotation [rad] from the requested attitude; 0 on joint-space paths."""
    joint_peaks: Array
    """Largest speed (n,) [rad/s]."""
    overshoot: Array
    """Distance (n,) [rad] of joints beyond the adjacent points, on joint-space paths."""
    path_length: float
    """Travel of the TCP [m]."""
    peak_speed: float
    """Peak speed of the TCP [m/s]."""
    poses_solved: int
    """Number of poses solved by inverse kinematics."""
    dt: float
    """Time [s] between samples."""

    @property
    def duration(self) -> float:
        """[s]"""
        return float(self.samples.times[-1])

    @property
    def even_duration(self) -> float:
        """Time [s] along the path of the TCP at the requested speed throughout."""
        return self.path_length / self.plan.speed

    @property
    def deviation_rms(self) -> float:
        """Root mean square [m]."""
        return float(np.sqrt(np.mean(self.deviation**2)))

    @property
    def deviation_max(self) -> float:
        """[m]"""
        return float(self.deviation.max())

    @property
    def from_chord(self) -> float:
        """Maximum distance [m] of the TCP from the straight lines between the points."""
        tcp = self.samples.base_from_tcp.translation
        return float(_off_the_chord(tcp, self.points.positions, self.samples.move).max())

    @property
    def speed_ratios(self) -> tuple[float | None, ...]:
        """Peak speed divided by the limit of each joint; None if the limit is not known."""
        return tuple(
            None if joint.max_speed is None else peak / joint.max_speed
            for joint, peak in zip(self.robot.joints, self.joint_peaks.tolist(), strict=True)
        )


@jit_reconsidered()
def follow(
    robot: Robot,
    points: Points,
    attitudes: Array,
    flange_from_tcp: Transform,
    plan: Plan,
    *,
    start: Array | None = None,
    first: Array | None = None,
    dt: float = DEFAULT_DT,
) -> FollowedTrajectory | Refused:
    """Solve a trajectory through points.

    Args:
        robot: The arm.
        points: One or more points; at one the arm rests.
        attitudes: The attitude at each, (k, 4) or (k, 1); see `reachability.reach`.
        flange_from_tcp: The tool.
        plan: The requested trajectory.
        start: Joints (n,) [rad] near which to begin; None for those with the least motion, at a
            lone point for 0.
        first: Required joints (n,) [rad] at the first point; None if free.
        dt: Time [s] between samples.

    Returns:
        The trajectory, or the reason for refusing it.
    """
    if not len(points):
        return Refused("a trajectory needs points")
    tcp_from_flange = flange_from_tcp.inverse()
    if len(points) == 1:
        start = np.zeros(len(robot.joints)) if start is None else start
    elif plan.kind.of_tcp:
        motion = tcp_motion(points, attitudes, plan)
        if isinstance(motion, Refused):
            return motion
        times = _times(motion.starts, dt)
        if isinstance(times, Refused):
            return times
        found = joints_of_tcp(robot, points, motion, times, tcp_from_flange, start, first)
        if isinstance(found, Refused):
            return found
        return _of_tcp(robot, points, attitudes, flange_from_tcp, plan, motion, times, found, dt)

    at_points = posed(points.positions, attitudes)
    knots = solved(robot, at_points @ tcp_from_flange, start, first)
    if isinstance(knots, int):
        why = unreachable_reason(robot, (at_points @ tcp_from_flange)[knots])
        said = why.message if why else NOT_FROM_THERE
        return Refused(f"point {points.number(knots)}: {said}", None, knots)
    if len(points) == 1:
        return _at_rest(robot, points, attitudes, flange_from_tcp, plan, knots, dt)
    if plan.kind is Way.JOINT_QUINTIC:
        made = quintic_motion(points, knots, plan)
    else:
        ways = _joint_motion_lengths(robot, knots, flange_from_tcp)
        made = even_joint_motion(knots, ways, plan)
    if isinstance(made, Refused):
        return made
    times = _times(made.trajectory.breaks, dt)
    if isinstance(times, Refused):
        return times
    return _of_joints(robot, points, attitudes, flange_from_tcp, plan, made, knots, times, dt)


def _at_rest(
    robot: Robot,
    points: Points,
    attitudes: Array,
    flange_from_tcp: Transform,
    plan: Plan,
    joints: Array,
    dt: float,
) -> FollowedTrajectory:
    """Return the rest at one point, with joints (1, n) [rad]."""
    base_from_tcp = robot.forward(joints) @ flange_from_tcp
    none = np.zeros(1)
    return FollowedTrajectory(
        plan=plan,
        robot=robot,
        points=points,
        attitudes=attitudes,
        flange_from_tcp=flange_from_tcp,
        samples=Samples(none, np.zeros(1, dtype=np.int64), joints, base_from_tcp, none),
        wanted=base_from_tcp,
        deviation=np.linalg.norm(base_from_tcp.translation - points.positions, axis=1),
        turn_deviation=0.0,
        joint_peaks=np.zeros(len(robot.joints)),
        overshoot=np.zeros(len(robot.joints)),
        path_length=0.0,
        peak_speed=0.0,
        poses_solved=1,
        dt=dt,
    )


def _joint_motion_lengths(robot: Robot, knots: Array, flange_from_tcp: Transform) -> Array:
    """Return the TCP travel (k - 1,) [m] of linear joint motions between knots (k, n)."""
    share = np.linspace(0.0, 1.0, _CHORDS + 1)[:, None, None]
    joints = knots[:-1] + share * np.diff(knots, axis=0)
    tcp = (robot.forward(joints) @ flange_from_tcp).translation
    ways: Array = np.linalg.norm(np.diff(tcp, axis=0), axis=-1).sum(axis=0)
    return ways


def _of_tcp(
    robot: Robot,
    points: Points,
    attitudes: Array,
    flange_from_tcp: Transform,
    plan: Plan,
    motion: TcpMotion,
    times: Array,
    found: TcpJoints,
    dt: float,
) -> FollowedTrajectory | Refused:
    wanted, segment = motion.at(times)
    joints = found.joints
    base_from_tcp = robot.forward(joints) @ flange_from_tcp
    off = vector_from_rotation(np.swapaxes(wanted.rotation, -1, -2) @ base_from_tcp.rotation)
    speeds = np.zeros(len(times))
    for number, began in enumerate(motion.starts[:-1].tolist()):
        at = (times >= began) & (times <= motion.starts[number + 1])
        curve = motion.curves[number]
        rate = motion.laws[number].at(times[at] - began, 1)[:, 0]
        speeds[at] = rate * curve.travel / curve.length
    return FollowedTrajectory(
        plan=plan,
        robot=robot,
        points=points,
        attitudes=attitudes,
        flange_from_tcp=flange_from_tcp,
        samples=Samples(times, segment, joints, base_from_tcp, np.maximum(speeds, 0.0)),
        wanted=wanted,
        deviation=np.linalg.norm(base_from_tcp.translation - wanted.translation, axis=1),
        turn_deviation=float(np.linalg.norm(off, axis=1).max()),
        joint_peaks=found.peaks,
        overshoot=np.zeros(len(robot.joints)),
        path_length=motion.travel,
        peak_speed=motion.peak_speed,
        poses_solved=len(times),
        dt=dt,
    )


def _of_joints(
    robot: Robot,
    points: Points,
    attitudes: Array,
    flange_from_tcp: Transform,
    plan: Plan,
    motion: JointsOverTime,
    knots: Array,
    times: Array,
    dt: float,
) -> FollowedTrajectory | Refused:
    joints = motion.trajectory.at(times)
    segment = np.searchsorted(motion.passed, times, side="right") - 1
    segment = np.clip(segment, 0, len(points) - 2).astype(np.int64)
    excess = limit_excess(robot, joints)
    if excess.any():
        row, joint = (int(i) for i in np.unravel_index(np.argmax(np.abs(excess)), excess.shape))
        limit = "upper" if excess[row, joint] > 0.0 else "lower"
        return Refused(
            f"{when(points, segment, times, row)}: joint {joint + 1} would go "
            f"{amount_text(degrees(abs(excess[row, joint])))} {robot.joints[joint].measure} beyond "
            f"its {limit} limit",
            "give lower speeds at the points, or more time between them",
            int(segment[row]),
        )
    base_from_tcp = robot.forward(joints) @ flange_from_tcp
    tcp = base_from_tcp.translation
    travel = np.linalg.norm(np.diff(tcp, axis=0), axis=1)
    speed = np.linalg.norm(
        _tcp_velocity(robot, joints, motion.trajectory.at(times, 1), tcp), axis=1
    )
    beyond = np.zeros(len(robot.joints))
    if plan.kind is Way.JOINT_QUINTIC:
        beyond = overshoot(motion.trajectory, knots)
    return FollowedTrajectory(
        plan=plan,
        robot=robot,
        points=points,
        attitudes=attitudes,
        flange_from_tcp=flange_from_tcp,
        samples=Samples(times, segment, joints, base_from_tcp, speed),
        wanted=base_from_tcp,
        deviation=_off_the_chord(tcp, points.positions, segment),
        turn_deviation=0.0,
        joint_peaks=motion.trajectory.peak(1),
        overshoot=beyond,
        path_length=float(travel.sum()),
        peak_speed=float(speed.max()),
        poses_solved=len(points),
        dt=dt,
    )


def _tcp_velocity(robot: Robot, joints: Array, speeds: Array, tcp: Array) -> Array:
    """Return the velocity (k, 3) [m/s] of TCPs (k, 3) [m] for joint speeds (k, n) [rad/s]."""
    twist = np.einsum("kij,kj->ki", robot.kinematics.jacobian(joints), speeds)
    arm = tcp - robot.forward(joints).translation
    velocity: Array = twist[:, :3] + np.cross(twist[:, 3:], arm)
    return velocity


def _off_the_chord(tcp: Array, points: Array, segment: npt.NDArray[np.int64]) -> Array:
    """Return distances (k,) [m] of positions (k, 3) from straight lines between points (p, 3)."""
    if len(points) == 1:
        alone: Array = np.linalg.norm(tcp - points, axis=1)
        return alone
    start, along = points[segment], np.diff(points, axis=0)[segment]
    square = np.maximum(np.sum(along**2, axis=1), 1e-300)
    share = np.clip(np.sum((tcp - start) * along, axis=1) / square, 0.0, 1.0)
    off: Array = np.linalg.norm(tcp - start - share[:, None] * along, axis=1)
    return off


def _times(breaks: Array, dt: float) -> Array | Refused:
    """Return every `dt` from 0, with all breaks among them."""
    end = float(breaks[-1])
    if end / dt > MOST_SAMPLES:
        return Refused(
            f"the trajectory takes {end:.0f} s: over {MOST_SAMPLES} samples",
            "raise --speed, or --dt",
        )
    times = np.unique(np.concatenate([np.arange(int(np.ceil(end / dt))) * dt, breaks]))
    apart: Array = times[np.append(np.diff(times) > _SAME_INSTANT, True)]
    return apart
