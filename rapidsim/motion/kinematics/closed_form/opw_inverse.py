"""Inverse kinematics of ortho-parallel arms in the angles theta of the formulas.

Input are poses of the last frame, whose origin is the wrist centre; output are angles, not
unwrapped to any particular turn. No solution is lost where two of them meet, because nothing is
computed by acos.
"""

from __future__ import annotations

import numpy as np

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.motion.kinematics.closed_form.opw_geometry import OpwGeometry
from rapidsim.motion.kinematics.closed_form.two_link import REACH_TOLERANCE, close_triangle
from rapidsim.values import value_class

ON_AXIS = 1e-10
"""Share of the reach within which a wrist centre counts as lying on axis 1."""
ROUNDED_WRIST = 1e-12
"""sin of axis 5 below which it is zero with rounding: the direction of axis 4 is noise."""
HELD_WRIST = 1e-7
"""sin of axis 5 up to which axis 4 keeps its value: printed targets are no more exact."""


@value_class(frozen=True, slots=True, eq=False)
class _Arm:
    """Axes 1 to 3, broadcast over poses and branches."""

    t1: Array
    t2: Array
    t3: Array
    shortfall: Array
    """Distance [m] of the wrist centre outside the reach; 0 inside."""


def all_branches(geometry: OpwGeometry, opw6: Transform) -> tuple[Array, Mask, Array]:
    """Return every branch of poses (...,).

    Returns:
        theta (..., 8, 6) [rad], a mask of existing ones (..., 8), and the shortfall (...,) [m].
    """
    pose = opw6[..., None]
    side = np.array([1.0, 1.0, -1.0, -1.0])
    bend = np.array([1.0, -1.0, 1.0, -1.0])
    t1, undetermined = _axis_1(geometry, pose.translation, side)
    arm = _arm(geometry, pose.translation, side, bend, np.where(undetermined, 0.0, t1))
    wrist = _wrist_matrix(arm, pose.rotation)
    t4 = np.where(_sine(wrist) < ROUNDED_WRIST, 0.0, np.arctan2(wrist[..., 1, 2], wrist[..., 0, 2]))
    t5, t6 = _axes_5_6(wrist, t4)
    plus = np.stack([arm.t1, arm.t2, arm.t3, t4, t5, t6], axis=-1)
    minus = np.stack([arm.t1, arm.t2, arm.t3, t4 + np.pi, -t5, t6 + np.pi], axis=-1)
    theta = np.stack([plus, minus], axis=-2).reshape(*plus.shape[:-2], 8, 6)
    exists = np.repeat(arm.shortfall <= REACH_TOLERANCE * geometry.reach, 2, axis=-1)
    nearest = np.min(arm.shortfall, axis=-1)
    return theta, exists, np.where(nearest <= REACH_TOLERANCE * geometry.reach, 0.0, nearest)


def one_branch(
    geometry: OpwGeometry, opw6: Transform, branch: int, near: Array
) -> tuple[Array, Mask]:
    """Return one branch for a sequence of poses (k,).

    Args:
        geometry: The arm.
        opw6: Poses (k,) of the last frame.
        branch: 0 to 7.
        near: theta (k, 6) or (6,) [rad], kept by axes 1 and 4 if the pose does not determine
            them. A single vector precedes the first row: then the last determined value is kept.

    Returns:
        theta (k, 6) [rad] and a mask of existing rows (k,).
    """
    side, bend = np.array(-1.0 if branch & 4 else 1.0), np.array(-1.0 if branch & 2 else 1.0)
    flip = np.pi if branch & 1 else 0.0
    t1, undetermined = _axis_1(geometry, opw6.translation, side)
    t1 = _hold(t1, undetermined, near[..., 0])
    arm = _arm(geometry, opw6.translation, side, bend, t1)
    wrist = _wrist_matrix(arm, opw6.rotation)
    t4 = np.arctan2(wrist[..., 1, 2], wrist[..., 0, 2])
    t4 = _hold(t4, _sine(wrist) < HELD_WRIST, near[..., 3] - flip)
    t5, t6 = _axes_5_6(wrist, t4)
    if branch & 1:
        t4, t5, t6 = t4 + np.pi, -t5, t6 + np.pi
    theta = np.stack([arm.t1, arm.t2, arm.t3, t4, t5, t6], axis=-1)
    return theta, arm.shortfall <= REACH_TOLERANCE * geometry.reach


def elbow_rotation(c1: Array, s1: Array, c23: Array, s23: Array) -> Array:
    """Return Rz(t1) Ry(t2 + t3) as matrices (..., 3, 3), from cosines and sines (...)."""
    rotation = np.empty((*c1.shape, 3, 3))
    rotation[..., 0, 0] = c1 * c23
    rotation[..., 0, 1] = -s1
    rotation[..., 0, 2] = c1 * s23
    rotation[..., 1, 0] = s1 * c23
    rotation[..., 1, 1] = c1
    rotation[..., 1, 2] = s1 * s23
    rotation[..., 2, 0] = -s23
    rotation[..., 2, 1] = 0.0
    rotation[..., 2, 2] = c23
    return rotation


def _axis_1(geometry: OpwGeometry, wrist_centre: Array, side: Array) -> tuple[Array, Mask]:
    """Return axis 1 and a mask of poses that do not determine it: wrist centre on axis 1.

    Args:
        geometry: The arm.
        wrist_centre: Points (..., 3) [m].
        side: 1 where the wrist centre shall be in front of axis 1, -1 where behind.
    """
    x, y = wrist_centre[..., 0], wrist_centre[..., 1]
    radius = np.hypot(x, y)
    forward = side * np.sqrt(np.maximum(radius**2 - geometry.b**2, 0.0))
    t1 = np.arctan2(y, x) - np.arctan2(geometry.b, forward)
    return t1, np.broadcast_to(radius < ON_AXIS * geometry.reach, t1.shape)


def _arm(geometry: OpwGeometry, wrist_centre: Array, side: Array, bend: Array, t1: Array) -> _Arm:
    """Return axes 2 and 3 for a wrist centre, as far as the triangle of the two arms closes.

    Args:
        geometry: The arm.
        wrist_centre: Points (..., 3) [m].
        side: 1 where the wrist centre is in front of axis 1, -1 where behind.
        bend: 1 where the wrist centre is in front of the lower arm, -1 where behind.
        t1: Axis 1 (...) [rad].
    """
    radius = np.hypot(wrist_centre[..., 0], wrist_centre[..., 1])
    forward = side * np.sqrt(np.maximum(radius**2 - geometry.b**2, 0.0)) - geometry.a1
    up = wrist_centre[..., 2] - geometry.c1
    t2, elbow, outside = close_triangle(forward, up, geometry.c2, geometry.fore, bend)
    t3 = elbow - geometry.fore_lean
    within_b = np.maximum(abs(geometry.b) - radius, 0.0)
    return _Arm(*np.broadcast_arrays(t1, t2, t3, outside + within_b))


def _wrist_matrix(arm: _Arm, rotation: Array) -> Array:
    """Return the rotation that remains for axes 4 to 6: Rz(t4) Ry(t5) Rz(t6), shape (..., 3, 3)."""
    t23 = arm.t2 + arm.t3
    elbow = elbow_rotation(np.cos(arm.t1), np.sin(arm.t1), np.cos(t23), np.sin(t23))
    return np.swapaxes(elbow, -1, -2) @ rotation


def _sine(wrist: Array) -> Array:
    """Return |sin t5|."""
    return np.hypot(wrist[..., 0, 2], wrist[..., 1, 2])


def _axes_5_6(wrist: Array, t4: Array) -> tuple[Array, Array]:
    """Return axes 5 and 6 for a value of axis 4.

    Axis 6 takes the rest of the orientation, so that the sum of both is exact even if the direction
    of axis 4 is inexact.
    """
    c4, s4 = np.cos(t4), np.sin(t4)
    t5 = np.arctan2(c4 * wrist[..., 0, 2] + s4 * wrist[..., 1, 2], wrist[..., 2, 2])
    t6 = np.arctan2(
        c4 * wrist[..., 1, 0] - s4 * wrist[..., 0, 0],
        c4 * wrist[..., 1, 1] - s4 * wrist[..., 0, 1],
    )
    return t5, t6


def _hold(angles: Array, undetermined: Mask, near: Array) -> Array:
    """Replace undetermined angles (k,) by `near` (k,); by the last determined with one `near`."""
    if near.ndim:
        return np.where(undetermined, near, angles)
    last = np.maximum.accumulate(np.where(undetermined, -1, np.arange(len(angles))))
    return np.where(last < 0, near, angles[last])
