"""Recognition of an ortho-parallel arm with a spherical wrist from six axes in space.

Input is a robot description at joint values 0: a line for each axis and the frames of links and
flange. Output is the arm with its closed-form solver, or the reason why the arm does not qualify.
"""

from __future__ import annotations

import numpy as np

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.kinematics.closed_form.opw import OrthoParallel
from rapidsim.motion.kinematics.closed_form.opw_geometry import JOINT_COUNT, OpwGeometry
from rapidsim.motion.kinematics.serial_chain import AxesAtZero

ANGLE_TOLERANCE = 1e-9
"""Angle [rad] for square or parallel axes; descriptions with 1.571 for 90 deg exceed it."""
LENGTH_TOLERANCE = 1e-9
"""Distance [m] up to which axes count as intersecting."""


def ortho_parallel_arm(axes: AxesAtZero) -> OrthoParallel | str:
    """Return the closed-form arm that moves like six axes, or the property that they lack."""
    directions, points = axes.directions, axes.points
    lacking = _lacking(directions)
    if lacking:
        return lacking
    wrist = _intersection(directions[3:], points[3:])
    if wrist is None:
        return "axes 4, 5 and 6 do not meet in one point"

    # The formulas' frame at joint 1 = 0: z up axis 1, x towards axis 2 or, above the base, the arm.
    sign_1 = 1 if directions[0, 2] >= 0.0 else -1
    up = sign_1 * directions[0]
    foot = points[0] - (points[0] @ up) * up
    sideways = directions[1]
    ahead = float((points[1] - foot) @ np.cross(sideways, up))
    if abs(ahead) < LENGTH_TOLERANCE:
        ahead = float(np.cross(sideways, up)[0])
    sign_2 = 1 if ahead >= 0.0 else -1
    sideways = sign_2 * sideways
    base_from_opw = Transform(np.column_stack([np.cross(sideways, up), sideways, up]), foot)
    points = base_from_opw.inverse().apply(np.vstack([points, wrist]))
    directions = directions @ base_from_opw.rotation
    wrist = points[-1]

    upper = points[2] - points[1]
    theta_2 = np.arctan2(upper[0], upper[2])
    sign_3 = 1 if directions[2, 1] > 0.0 else -1
    fore = wrist - points[2]
    sign_4 = 1 if fore @ directions[3] >= 0.0 else -1
    along = sign_4 * directions[3]
    theta_23 = np.arctan2(along[0], along[2])
    elbow = np.array([[along[2], 0.0, -along[0]], [0.0, 1.0, 0.0], along])  # rows: its x, y, z
    in_elbow = elbow @ directions[4]
    sign_5 = 1 if in_elbow[1] >= 0.0 else -1
    theta_4 = np.arctan2(-sign_5 * in_elbow[0], sign_5 * in_elbow[1])
    flange = base_from_opw.inverse() @ axes.base_from_flange
    outward = float((flange.translation - wrist) @ directions[5])
    sign_6 = -1 if outward < -LENGTH_TOLERANCE else 1
    in_elbow = elbow @ (sign_6 * directions[5])
    theta_5 = np.arctan2(np.cos(theta_4) * in_elbow[0] + np.sin(theta_4) * in_elbow[1], in_elbow[2])
    theta = (0.0, theta_2, theta_23 - theta_2, theta_4, theta_5, 0.0)
    geometry = OpwGeometry(
        a1=float(points[1, 0]),
        a2=float(fore @ elbow[0]),
        b=float(wrist[1]),
        c1=float(points[1, 2]),
        c2=float(np.hypot(upper[0], upper[2])),
        c3=float(fore @ along),
        c4=abs(outward),
        offsets=tuple(-float(angle) for angle in theta),
        signs=(sign_1, sign_2, sign_3, sign_4, sign_5, sign_6),
    )
    return _with_frames(geometry, base_from_opw, axes)


def _with_frames(
    geometry: OpwGeometry, base_from_opw: Transform, axes: AxesAtZero
) -> OrthoParallel:
    """Return the arm of a geometry with the described links and flange."""
    unnamed = Transform(np.broadcast_to(np.eye(3), (JOINT_COUNT, 3, 3)), np.zeros((JOINT_COUNT, 3)))
    formulas = OrthoParallel(geometry, base_from_opw, unnamed, Transform.identity())
    opw_from_base = formulas.link_frames(np.zeros(JOINT_COUNT)).inverse()
    return OrthoParallel(
        geometry,
        base_from_opw,
        opw_from_base @ axes.base_from_link,
        opw_from_base[JOINT_COUNT - 1] @ axes.base_from_flange,
    )


def _lacking(directions: Array) -> str | None:
    """Describe the first angle between axes that an ortho-parallel arm would not have, or None."""
    for first, second in ((0, 1), (2, 3), (3, 4), (4, 5)):
        if abs(float(directions[first] @ directions[second])) > ANGLE_TOLERANCE:
            return f"axis {second + 1} is not perpendicular to axis {first + 1}"
    if np.linalg.norm(np.cross(directions[1], directions[2])) > ANGLE_TOLERANCE:
        return "axis 3 is not parallel to axis 2"
    return None


def _intersection(directions: Array, points: Array) -> Array | None:
    """Return the intersection (3,) [m] of lines (k, 3) by least squares; None if there is none."""
    across = np.eye(3) - directions[:, :, None] * directions[:, None, :]  # (k, 3, 3)
    meeting: Array = np.linalg.solve(across.sum(axis=0), np.einsum("kij,kj->i", across, points))
    distances = np.linalg.norm(np.einsum("kij,kj->ki", across, meeting - points), axis=-1)
    return meeting if float(distances.max()) <= LENGTH_TOLERANCE else None
