"""The programmed curves of segments, before corners cut them: TCP poses and derivatives.

A curve runs in x from 0 to its length. For what moves the TCP the length is the TCP's travel [m].
For what only turns it, it is the travel the TCP would have made in the same time at its programmed
speed, so that x has one scale. Derivatives are with respect to x.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.kinematics import Kinematics
from rapidsim.motion.segments import Geometry, Segment
from rapidsim.motion.turns import cross, rotate, rotation_from_vector, vector_from_rotation

Index = npt.NDArray[np.int64]

STANDSTILL = 1e-9
"""Travel [m] and turn [rad] below which nothing has moved."""
_TURN_ONLY_TRAVEL = 1e-5
_TURN_ONLY_ANGLE = 1e-3
_TRAVEL_SAMPLES = 32
_SHORTEST_CIRCLE_SIDE = 1e-4
_WIDEST_ARC = math.radians(240.0)
_ONE_WAY_ONLY = math.radians(90.0)
"""Below this nobody means the long way round, which would be three quarters of a turn."""


@dataclass(frozen=True, slots=True, eq=False)
class Motion:
    """TCP poses on curves and how they change, all shapes (k, ...), in base.

    `velocity` and `acceleration` are the first and second derivatives of the position, `turning`
    is the angular velocity per unit of the parameter, `turning_change` its derivative.
    """

    position: Array
    rotation: Array
    velocity: Array
    turning: Array
    acceleration: Array
    turning_change: Array

    @property
    def base_from_tcp(self) -> Transform:
        """The poses."""
        return Transform(self.rotation, self.position)


@dataclass(frozen=True, slots=True, eq=False)
class Curves:
    """Curves of segments, one row each; shapes (m,), (m, 3) and (m, 3, 3)."""

    in_joints: npt.NDArray[np.bool_]
    """Whether the curve is straight in joint space; then only its joints count."""
    length: Array
    """Range of x [m]."""
    travel: Array
    """Way of the TCP [m]."""
    angle: Array
    """Reorientation from start to end [rad]."""
    turned: Array
    """The same, or the largest joint travel of a joint move, which may turn and end as it began."""
    turns_only: npt.NDArray[np.bool_]
    """Whether the arm turns and the TCP hardly moves: less than a robtarget's last digit."""
    start: Transform
    """base_from_tcp."""
    end: Transform
    chord: Array
    """From start to end of a line; 0 for arcs."""
    spoke: Array
    """From the centre to the start of an arc; 0 for lines."""
    frame_turn: Array
    """Rotation vector of the spoke over the whole arc; 0 for lines."""
    tool_turn: Array
    """Rotation vector of the tool relative to the path's own frame over the whole curve."""
    start_joints: Array
    """Shape (m, n)."""
    joint_travel: Array
    """Shape (m, n): end joints less start joints."""

    def joints_at(self, row: Index, x: Array) -> Array:
        """Joints (k, n) at places x (k,) of curves that are straight in joint space."""
        share = x / np.maximum(self.length[row], STANDSTILL)
        joints: Array = self.start_joints[row] + share[:, None] * self.joint_travel[row]
        return joints

    def at(self, row: Index, x: Array) -> Motion:
        """TCP motion at places x (k,) of curves (k,) that are lines or arcs."""
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
            return Motion(position, rotation, chord_rate, tool_rate, still[0], still[1])
        frame = rotation_from_vector(frame_turn * share)
        spoke = rotate(frame, self.spoke[row])
        tool_rate = rotate(frame, tool_rate)
        around = cross(frame_rate, spoke)
        return Motion(
            position=position + spoke - self.spoke[row],
            rotation=frame @ rotation,
            velocity=chord_rate + around,
            turning=frame_rate + tool_rate,
            acceleration=cross(frame_rate, around),
            turning_change=cross(frame_rate, tool_rate),
        )


def curves_of(segments: Sequence[Segment], kinematics: Kinematics) -> Curves:
    """Lay out the curves of segments; arcs must have passed `circle_fault`."""
    m = len(segments)
    start = _stack([segment.start.base_from_tcp for segment in segments])
    end = _stack([segment.end.base_from_tcp for segment in segments])
    in_joints = np.array([segment.geometry is Geometry.JOINT for segment in segments])
    start_joints = np.array([segment.start.joints for segment in segments])
    joint_travel = np.array([segment.end.joints for segment in segments]) - start_joints

    chord = np.where(in_joints[:, None], 0.0, end.translation - start.translation)
    spoke, frame_turn = np.zeros((m, 3)), np.zeros((m, 3))
    for row, segment in enumerate(segments):
        if segment.geometry is Geometry.ARC:
            chord[row] = 0.0
            spoke[row], frame_turn[row] = _circle(segment)
    turn = vector_from_rotation(end.rotation @ np.swapaxes(start.rotation, -1, -2))
    tool_turn = vector_from_rotation(
        rotation_from_vector(-frame_turn) @ end.rotation @ np.swapaxes(start.rotation, -1, -2)
    )
    for row, segment in enumerate(segments):
        if segment.geometry is Geometry.ARC:
            tool_turn[row] = _turn_by_circle_point(
                segment, spoke[row], frame_turn[row], tool_turn[row]
            )
    angle = np.linalg.norm(turn, axis=-1)

    travel = np.linalg.norm(chord, axis=-1)
    travel += np.linalg.norm(spoke, axis=-1) * np.linalg.norm(frame_turn, axis=-1)
    if in_joints.any():
        tcp_from_flange = _stack([segment.tcp_from_flange for segment in segments])[in_joints]
        travel[in_joints] = _joint_move_travel(
            kinematics, start_joints[in_joints], joint_travel[in_joints], tcp_from_flange
        )
    ratio = np.array([segment.speed.tcp / segment.speed.reorientation for segment in segments])
    turned = np.maximum(angle, np.abs(joint_travel).max(axis=-1, initial=0.0) * in_joints)
    turns_only = (travel < _TURN_ONLY_TRAVEL) & (turned > _TURN_ONLY_ANGLE)
    length = np.where(turns_only, turned * ratio, np.where(travel > STANDSTILL, travel, 0.0))
    return Curves(
        in_joints=in_joints,
        length=length,
        travel=travel,
        angle=angle,
        turned=turned,
        turns_only=turns_only,
        start=start,
        end=end,
        chord=chord,
        spoke=spoke,
        frame_turn=frame_turn,
        tool_turn=tool_turn,
        start_joints=start_joints,
        joint_travel=joint_travel,
    )


def circle_fault(segment: Segment) -> str | None:
    """Say why the circle of an arc is uncertain, or None.

    Source: the controller's event 50063 lists these cases; the distances are estimates.
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
    """Spoke from the centre to the start, and rotation vector of the spoke over the arc."""
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


def _turn_by_circle_point(
    segment: Segment, spoke: Array, frame_turn: Array, short_turn: Array
) -> Array:
    """The tool's turn (3,) relative to the path's frame: the short way, or the long way round.

    Half a circle with the same orientation at both ends turns the tool by half a turn against the
    path's frame, and either way would do. The orientation of the circle point says which is meant;
    it says nothing else.
    """
    short = float(np.linalg.norm(short_turn))
    if short < _ONE_WAY_ONLY or segment.via is None:
        return short_turn
    long_turn = short_turn * (1.0 - 2.0 * math.pi / short)
    start, via, _ = _circle_points(segment)
    whole = float(np.linalg.norm(frame_turn))
    to_via = via - start + spoke
    axis = frame_turn / whole
    turned = math.atan2(float(axis @ np.cross(spoke, to_via)), float(spoke @ to_via))
    share = (turned % (2.0 * math.pi)) / whole
    wanted = (
        rotation_from_vector(-frame_turn * share)
        @ segment.via.rotation
        @ segment.start.base_from_tcp.rotation.T
    )
    away = [
        float(np.linalg.norm(vector_from_rotation(rotation_from_vector(-turn * share) @ wanted)))
        for turn in (short_turn, long_turn)
    ]
    return short_turn if away[0] <= away[1] else long_turn


def _joint_move_travel(
    kinematics: Kinematics, start_joints: Array, joint_travel: Array, tcp_from_flange: Transform
) -> Array:
    """TCP travel (m,) [m] of moves that are straight in joint space."""
    share = np.linspace(0.0, 1.0, _TRAVEL_SAMPLES + 1)[None, :, None]
    joints = start_joints[:, None, :] + share * joint_travel[:, None, :]
    base_from_flange = kinematics.forward(joints)
    tcp_in_flange = tcp_from_flange.inverse().translation[:, None, :]
    points = base_from_flange.apply(np.broadcast_to(tcp_in_flange, (*joints.shape[:2], 3)))
    fine = np.linalg.norm(np.diff(points, axis=1), axis=-1).sum(axis=1)
    coarse = np.linalg.norm(np.diff(points[:, ::2], axis=1), axis=-1).sum(axis=1)
    # Chords fall short of the arc by the square of their length.
    travel: Array = fine + (fine - coarse) / 3.0
    return travel


def _stack(transforms: Sequence[Transform]) -> Transform:
    return Transform(
        np.array([transform.rotation for transform in transforms]),
        np.array([transform.translation for transform in transforms]),
    )
