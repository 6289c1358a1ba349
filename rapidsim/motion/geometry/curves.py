"""Programmed curves of segments, without corners: TCP poses and derivatives.

The parameter x of a curve runs from 0 to its length. For a curve that moves the TCP the length is
the TCP's travel [m]. For one that only turns it, the length is the distance that the TCP would
travel in the same time at its programmed speed, so that x has one scale. Derivatives are with
respect to x.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from rapidsim.frames.moving_frames import Twists
from rapidsim.frames.rotation_vectors import (
    cross,
    rotate,
    rotation_from_vector,
    vector_from_rotation,
)
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.geometry.joint_mapping import arms_of
from rapidsim.motion.geometry.segment_rows import SegmentRows, of_each
from rapidsim.motion.geometry.segments import (
    TURNS_WITH_PATH,
    CircleMode,
    Geometry,
    Segment,
    Waypoint,
)
from rapidsim.motion.kinematics.arm import Kinematics
from rapidsim.repeated_rows import shared_row
from rapidsim.values import value_class

Index = npt.NDArray[np.int64]

STANDSTILL = 1e-9
"""Travel [m] and rotation [rad] below which nothing has moved."""
_TURN_ONLY_TRAVEL = 1e-5
_TURN_ONLY_ANGLE = 1e-3
_IDLE_TCP_SPEED = 0.001
"""TCP speed [m/s] for speeds of axes alone, such as vrot10, which have no TCP speed."""
_TRAVEL_SAMPLES = 32
_SHORTEST_CIRCLE_SIDE = 1e-4
_LONGEST_CIRCLE_SIDE = 1e3
"""[m]; no arm has points so far apart, and their circles have no significant digits."""
_WIDEST_ARC = math.radians(240.0)
_ONE_WAY_ONLY = math.radians(90.0)
"""Rotation [rad] below which the tool takes the short turn: the long one would be 270 deg."""


@value_class(frozen=True, slots=True, eq=False)
class Curves:
    """Curves of segments, one per row; shapes (m,), (m, 3) and (m, 3, 3)."""

    in_joints: npt.NDArray[np.bool_]
    """Whether the curve is straight in joint space; then only its joints are used."""
    length: Array
    """Range of x [m]."""
    travel: Array
    """Path length [m] of the TCP."""
    angle: Array
    """Reorientation from start to end [rad]."""
    turned: Array
    """Reorientation [rad]; for a joint move at least its largest joint travel, as a move may turn
    and end in its start orientation."""
    turns_only: npt.NDArray[np.bool_]
    """Whether the TCP rests (to within a digit of a robtarget) while something moves."""
    external: Array
    """Travel of each external axis (m, e), without sign [m or rad]."""
    start: Transform
    """base_from_tcp."""
    end: Array
    """Position of the TCP."""
    chord: Array
    """Vector from start to end of a line; 0 for arcs."""
    spoke: Array
    """Vector from the centre to the start of an arc; 0 for lines."""
    frame_turn: Array
    """Rotation vector of the spoke over the whole arc; 0 for lines."""
    carried_turn: Array
    """Rotation vector by which the path's own frame turns the tool: `frame_turn`, or 0 if the tool
    turns as on a line."""
    tool_turn: Array
    """Rotation vector of the tool relative to the path's own frame over the whole curve."""
    detour: Array
    """Rotation vector of the tool's deviation from that turn, which is `detour * x * (1 - x)` at
    share x of the arc, to pass through the orientation of the circle point; 0 if not needed."""
    start_joints: Array
    """Shape (m, n + e): the joints of the arm, then the external axes."""
    joint_travel: Array
    """Shape (m, n + e): end joints minus start joints."""

    def joints_at(self, row: Index, x: Array) -> Array:
        """Return joints (k, n + e) at x (k,) on curves that are straight in joint space."""
        share = x / np.maximum(self.length[row], STANDSTILL)
        joints: Array = self.start_joints[row] + share[:, None] * self.joint_travel[row]
        return joints

    def at(self, row: Index, x: Array) -> Twists:
        """Return the TCP motion at x (k,) on curves (k,) that are lines or arcs."""
        scale = 1.0 / np.maximum(self.length[row], STANDSTILL)
        share = (x * scale)[:, None]
        frame_turn = self.frame_turn[row]
        tool_turn = self.tool_turn[row]
        chord_rate = self.chord[row] * scale[:, None]
        frame_rate = frame_turn * scale[:, None]
        tool_rate = tool_turn * scale[:, None]
        rotation = rotation_from_vector(tool_turn * share) @ self.start.rotation[row]
        position = self.start.translation[row] + self.chord[row] * share
        if not frame_turn.any():
            still = np.zeros((2, *position.shape))
            return Twists(position, rotation, chord_rate, tool_rate, still[0], still[1])
        spoke = rotate(rotation_from_vector(frame_turn * share), self.spoke[row])
        around = cross(frame_rate, spoke)
        orientation = self._orientation(row, share, scale[:, None])
        return Twists(
            position=position + spoke - self.spoke[row],
            rotation=orientation.rotation,
            velocity=chord_rate + around,
            turning=orientation.turning,
            acceleration=cross(frame_rate, around),
            turning_change=orientation.turning_change,
        )

    def velocity(self, row: Index, x: Array) -> Array:
        """Return only the velocity (k, g, 3) of `at`, at places (k, g) of curves (k,).

        It is the same at all places of lines: then (k, 1, 3).
        """
        scale = 1.0 / np.maximum(self.length[row], STANDSTILL)
        velocity: Array = (self.chord[row] * scale[:, None])[:, None]
        frame_turn = self.frame_turn[row][:, None]
        if frame_turn.any():
            turned = rotation_from_vector(frame_turn * (x * scale[:, None])[..., None])
            around = frame_turn * scale[:, None, None]
            velocity = velocity + cross(around, rotate(turned, self.spoke[row][:, None]))
        return velocity

    def _orientation(self, row: Index, share: Array, scale: Array) -> Twists:
        """Return the rotation of the tool on arcs (k,), composed of three rotations."""
        still = np.zeros((len(row), 3))
        bulge, steepness = share * (1.0 - share), 1.0 - 2.0 * share
        turned = None
        for vector, way, rate, change in (
            (self.carried_turn[row], share, scale, 0.0),
            (self.tool_turn[row], share, scale, 0.0),
            (self.detour[row], bulge, steepness * scale, -2.0 * scale**2),
        ):
            turn = Twists(
                still,
                rotation_from_vector(vector * way),
                still,
                vector * rate,
                still,
                vector * change,
            )
            turned = turn if turned is None else turned @ turn
        assert turned is not None
        return turned.before(Transform(self.start.rotation[row], still))


def curves_of(segments: Sequence[Segment], kinematics: Kinematics) -> Curves:
    """Build the curves of segments; arcs must have passed `circle_fault`."""
    m = len(segments)
    start, end, start_joints, end_joints = _ends(segments)
    joint_travel = end_joints - start_joints
    in_joints = of_each(segments, lambda segment: segment.geometry is Geometry.JOINT)
    arcs = np.flatnonzero(of_each(segments, lambda segment: segment.geometry is Geometry.ARC))

    chord = np.where(in_joints[:, None], 0.0, end.translation - start.translation)
    spoke, frame_turn = np.zeros((m, 3)), np.zeros((m, 3))
    carried_turn, detour = np.zeros((m, 3)), np.zeros((m, 3))
    turn = vector_from_rotation(end.rotation @ np.swapaxes(start.rotation, -1, -2))
    tool_turn = turn.copy()
    for row in arcs.tolist():
        arc = segments[row]
        chord[row] = 0.0
        spoke[row], frame_turn[row] = _circle(arc)
        if arc.circle_mode in TURNS_WITH_PATH:
            carried_turn[row] = frame_turn[row]
        tool_turn[row], detour[row] = _turns_on_arc(
            arc, spoke[row], frame_turn[row], carried_turn[row]
        )
    angle = np.linalg.norm(turn, axis=-1)

    travel = np.linalg.norm(chord, axis=-1)
    travel += np.linalg.norm(spoke, axis=-1) * np.linalg.norm(frame_turn, axis=-1)
    if in_joints.any():
        moves = [segment for segment in segments if segment.geometry is Geometry.JOINT]
        travel[in_joints] = _joint_move_travel(
            moves, kinematics, start_joints[in_joints], joint_travel[in_joints]
        )
    of_arm, external = np.split(np.abs(joint_travel), [kinematics.joint_count], axis=1)
    turned = np.maximum(angle, of_arm.max(axis=-1, initial=0.0) * in_joints)
    idle = (travel < _TURN_ONLY_TRAVEL) & (turned > _TURN_ONLY_ANGLE)
    # Distance that the TCP would travel at its programmed speed while the slowest other axis moves.
    tcp_speed = np.maximum(of_each(segments, lambda segment: segment.speed.tcp), _IDLE_TCP_SPEED)
    reorientation = of_each(segments, lambda segment: segment.speed.reorientation)
    meanwhile = turned * tcp_speed / reorientation
    if external.shape[1]:
        idle |= (travel < _TURN_ONLY_TRAVEL) & (external.max(axis=-1) > _TURN_ONLY_TRAVEL)
        seconds = external / of_each(segments, lambda segment: segment.external_speeds)
        meanwhile = np.maximum(meanwhile, seconds.max(axis=-1) * tcp_speed)
    length = np.where(idle, meanwhile, np.where(travel > STANDSTILL, travel, 0.0))
    return Curves(
        in_joints=in_joints,
        length=length,
        travel=travel,
        angle=angle,
        turned=turned,
        turns_only=idle,
        # A copy: as a part of wider rows it would retain these.
        external=external.copy(),
        start=start,
        end=end.translation,
        chord=chord,
        spoke=shared_row(spoke),
        frame_turn=shared_row(frame_turn),
        carried_turn=shared_row(carried_turn),
        tool_turn=shared_row(tool_turn),
        detour=shared_row(detour),
        start_joints=start_joints,
        joint_travel=joint_travel,
    )


def unsupported(kinematics: Kinematics) -> str | None:
    """Reason why lines and arcs cannot be simulated; None if they can."""
    if kinematics.joint_count > 6:
        return "lines and arcs of arms with more than six axes are not simulated"
    return None


def circle_fault(segment: Segment) -> str | None:
    """Reason why the circle of an arc is ill-defined; None if it is well-defined.

    Source: the controller's event 50063 lists these cases; the thresholds are estimates.
    """
    if segment.geometry is not Geometry.ARC:
        return None
    if segment.via is None:
        return "there is no circle point"
    start, via, end = _circle_points(segment)
    for a, b, names in (
        (start, end, "end point is {} mm from the start"),
        (start, via, "circle point is {} mm from the start"),
        (via, end, "circle point is {} mm from the end point"),
    ):
        distance = float(np.linalg.norm(b - a))
        if distance < _SHORTEST_CIRCLE_SIDE:
            return f"the {names.format(f'{distance * 1e3:.3f}')}"
        if distance > _LONGEST_CIRCLE_SIDE:
            return f"the {names.format(f'{distance * 1e3:.4g}')}"
    sides = np.linalg.norm(via - start) * np.linalg.norm(end - start)
    if np.linalg.norm(np.cross(via - start, end - start)) < 1e-9 * sides:
        return "start, circle point and end point lie on one line"
    angle = float(np.linalg.norm(_circle(segment)[1]))
    if angle > _WIDEST_ARC:
        return f"the arc spans {math.degrees(angle):.1f} deg, more than 240 deg"
    return None


def _circle_points(segment: Segment) -> tuple[Array, Array, Array]:
    assert segment.via is not None
    return (
        segment.start.base_from_tcp.translation,
        segment.via.translation,
        segment.end.base_from_tcp.translation,
    )


def _circle(segment: Segment) -> tuple[Array, Array]:
    """Return the spoke from centre to start, and the rotation vector of the spoke over the arc."""
    start, via, end = _circle_points(segment)
    a, b = via - start, end - start
    normal = np.cross(a, b)
    # The centre of the circle through 0, a and b.
    centre = np.cross((a @ a) * b - (b @ b) * a, normal) / (2.0 * (normal @ normal))
    axis = normal / np.linalg.norm(normal)
    spoke = -centre
    last = b - centre
    angle = math.atan2(float(axis @ np.cross(spoke, last)), float(spoke @ last)) % (2.0 * math.pi)
    return spoke, angle * axis


def _share_of_circle_point(segment: Segment, spoke: Array, frame_turn: Array) -> float:
    """Return the share of the arc at which its circle point lies."""
    start, via, _ = _circle_points(segment)
    whole = float(np.linalg.norm(frame_turn))
    axis, to_via = frame_turn / whole, via - start + spoke
    turned = math.atan2(float(axis @ np.cross(spoke, to_via)), float(spoke @ to_via))
    return (turned % (2.0 * math.pi)) / whole


def _turns_on_arc(
    arc: Segment, spoke: Array, frame_turn: Array, carried_turn: Array
) -> tuple[Array, Array]:
    """Return the tool's rotation relative to its carrying frame, and its detour; see `Curves`."""
    start, detour = arc.start.base_from_tcp.rotation, np.zeros(3)
    tool_turn = vector_from_rotation(
        rotation_from_vector(-carried_turn) @ arc.end.base_from_tcp.rotation @ start.T
    )
    if arc.via is not None:
        share = _share_of_circle_point(arc, spoke, frame_turn)
        wanted = rotation_from_vector(-carried_turn * share) @ arc.via.rotation @ start.T
        if arc.circle_mode in TURNS_WITH_PATH:
            tool_turn = _turn_by_circle_point(tool_turn, share, wanted)
        if arc.circle_mode is CircleMode.CIRCLE_POINT:
            away = vector_from_rotation(rotation_from_vector(-tool_turn * share) @ wanted)
            detour = away / (share * (1.0 - share))
    return tool_turn, detour


def _turn_by_circle_point(short_turn: Array, share: float, wanted: Array) -> Array:
    """Return the tool's turn (3,) relative to the path's frame: the short or the long one.

    Half a circle with equal orientations at both ends turns the tool by half a turn against the
    path's frame, so both turns are possible. The orientation of the circle point decides.

    Args:
        short_turn: The short turn.
        share: Share of the arc at which the circle point lies.
        wanted: Turn of the tool at the circle point, relative to the path's frame.
    """
    short = float(np.linalg.norm(short_turn))
    if short < _ONE_WAY_ONLY:
        return short_turn
    long_turn = short_turn * (1.0 - 2.0 * math.pi / short)
    away = [
        float(np.linalg.norm(vector_from_rotation(rotation_from_vector(-turn * share) @ wanted)))
        for turn in (short_turn, long_turn)
    ]
    return short_turn if away[0] <= away[1] else long_turn


def _joint_move_travel(
    segments: Sequence[Segment], kinematics: Kinematics, start_joints: Array, joint_travel: Array
) -> Array:
    """Return the TCP travel (m,) [m] of joint-space moves, relative to the work object."""
    count = _TRAVEL_SAMPLES + 1
    share = np.linspace(0.0, 1.0, count)[None, :, None]
    joints = (start_joints[:, None, :] + share * joint_travel[:, None, :]).reshape(
        -1, start_joints.shape[1]
    )
    arms = arms_of(segments, kinematics, joint_travel, np.ones(len(segments)))
    row = np.repeat(np.arange(len(segments)), count)
    points = arms.curve_from_tcp(joints, row).translation.reshape(-1, count, 3)
    fine = np.linalg.norm(np.diff(points, axis=1), axis=-1).sum(axis=1)
    coarse = np.linalg.norm(np.diff(points[:, ::2], axis=1), axis=-1).sum(axis=1)
    # Chords fall short of the arc by the square of their length.
    travel: Array = fine + (fine - coarse) / 3.0
    return travel


def _ends(segments: Sequence[Segment]) -> tuple[Transform, Transform, Array, Array]:
    """Return poses (m,) at starts and ends, and joints (m, n + e) at starts and ends."""
    if isinstance(segments, SegmentRows):
        ends = [
            np.concatenate([one.joints, one.external], axis=1)
            for one in (segments.start, segments.end)
        ]
        return segments.start.base_from_tcp, segments.end.base_from_tcp, ends[0], ends[1]
    points = [segments[0].start, *(segment.end for segment in segments)]
    if any(one.start is not point for one, point in zip(segments, points, strict=False)):
        # Segments are not consecutive: some start differs from the previous end.
        start, first = _poses([segment.start for segment in segments])
        end, last = _poses(points[1:])
    else:
        poses, joints = _poses(points)
        start, end, first, last = poses[:-1], poses[1:], joints[:-1], joints[1:]
    led = [segment.carrier_axes for segment in segments if segment.carrier_axes is not None]
    if led:
        first = np.concatenate([first, [start for start, _ in led]], axis=1)
        last = np.concatenate([last, [end for _, end in led]], axis=1)
    return start, end, first, last


def _poses(points: Sequence[Waypoint]) -> tuple[Transform, Array]:
    """Return poses (k,) and joints (k, n + e) of points."""
    poses = Transform.stacked([point.base_from_tcp for point in points])
    joints = np.array([point.joints for point in points])
    if len(points[0].external):
        joints = np.concatenate([joints, [point.external for point in points]], axis=1)
    return poses, joints
