"""Seeds for arms whose axis 6 misses the intersection of axes 4 and 5, such as the GoFa.

Such an arm has no closed form, but it has one if axis 6 is moved into the intersection. Its
solutions for a pose, shifted by the offset in the direction to which axis 6 may have turned it, are
close to those of the true arm. That direction is unknown, so several around the circle are tried.
"""

from __future__ import annotations

import numpy as np

from rapidsim.frames.rotation_vectors import rotation_from_vector
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.kinematics.closed_form.opw import OrthoParallel
from rapidsim.motion.kinematics.closed_form.opw_recognition import ortho_parallel_arm
from rapidsim.motion.kinematics.serial_chain import AxesAtZero
from rapidsim.values import value_class

DIRECTIONS = 8


@value_class(frozen=True, slots=True, eq=False)
class NearArm:
    """An arm without its wrist offset."""

    arm: OrthoParallel
    offsets: Array
    """Possible offsets (DIRECTIONS, 3) [m] of the true flange from the near arm's, in flange."""

    def starts(self, base_from_flange: Transform) -> Array:
        """Return joint vectors (up to DIRECTIONS * 8, 6) [rad] close to those of one pose."""
        shifted = base_from_flange.translation - self.offsets @ base_from_flange.rotation.T
        rotation = np.broadcast_to(base_from_flange.rotation, (len(shifted), 3, 3))
        branches = self.arm.inverse(Transform(rotation, shifted))
        return branches.joints[branches.exists]


def near_arm(axes: AxesAtZero) -> NearArm | None:
    """Return the near arm of six axes; None if more than axis 6 prevents a closed form."""
    if len(axes.points) != 6:
        return None
    crossing = point_nearest(axes.points[3:5], axes.directions[3:5])
    direction = axes.directions[5]
    beside = axes.points[5] - crossing
    beside = beside - (beside @ direction) * direction
    points = axes.points.copy()
    points[5] -= beside
    flange = axes.base_from_flange
    moved = AxesAtZero(
        axes.directions,
        points,
        axes.base_from_link,
        Transform(flange.rotation, flange.translation - beside),
    )
    arm = ortho_parallel_arm(moved)
    if isinstance(arm, str):
        return None
    axis_in_flange = flange.rotation.T @ direction
    rolls = np.linspace(0.0, 2.0 * np.pi, DIRECTIONS, endpoint=False)
    turned = rotation_from_vector(rolls[:, None] * axis_in_flange)
    return NearArm(arm, turned @ (flange.rotation.T @ beside))


def point_nearest(points: Array, directions: Array) -> Array:
    """Return the point (3,) of a line that is closest to another line.

    Args:
        points: A point of each line, shape (2, 3) [m].
        directions: Unit vectors (2, 3) along them. If the lines are parallel, the result is the
            point closest to the second line's point.
    """
    normal = np.cross(directions[0], directions[1])
    length = float(normal @ normal)
    between = points[1] - points[0]
    if length < 1e-12:
        along = float(between @ directions[0])
    else:
        along = float(np.cross(between, directions[1]) @ normal) / length
    nearest: Array = points[0] + along * directions[0]
    return nearest
