"""Axes of an arm as textbook tables: screws of the product of exponentials, and DH.

Both are derived from the positions of the axes at joint values 0, so they apply to any arm in which
each joint turns about, or slides along, one axis and carries the next. An arm with rods that hold a
link level has no such table.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from rapidsim.frames.rotation_vectors import rotation_from_vector
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.kinematics.arm import METRES_PER_UNIT, Kinematics, Mask
from rapidsim.values import value_class

_TOLERANCE = 1e-9
_TRIALS = 5


@value_class(frozen=True, slots=True, eq=False)
class Screws:
    """base_from_flange = exp(S1 q1) ... exp(Sn qn) M.

    Source:
        Lynch, Park (2017), Modern Robotics, section 4.1.
    """

    directions: Array
    """Unit vectors (n, 3) of the axes in base, joints at 0."""
    points: Array
    """Point (n, 3) [m] of each axis that is nearest to the base."""
    base_from_flange: Transform
    """M: joints at 0."""
    slides: Mask
    """Shape (n,): mask of the joints that slide along their axis; the others turn."""

    @property
    def turns(self) -> Array:
        """Angular velocities (n, 3) of S; 0 for a sliding joint."""
        return np.where(self.slides[:, None], 0.0, self.directions)

    @property
    def moments_mm(self) -> Array:
        """Velocities (n, 3) of S [mm per rad], for a sliding joint [mm per mm]."""
        turning: Array = -1e3 * np.cross(self.directions, self.points)
        return np.where(self.slides[:, None], self.directions, turning)

    def forward(self, joints: Array) -> Transform:
        """Return base_from_flange of joints (n,) [rad]; see `Kinematics` for sliding ones."""
        moved = Transform.identity()
        rows = zip(self.directions, self.points, joints.tolist(), self.slides, strict=True)
        for direction, point, value, slides in rows:
            if slides:
                moved = moved @ Transform(np.eye(3), METRES_PER_UNIT * value * direction)
                continue
            turn = rotation_from_vector(value * direction)
            moved = moved @ Transform(turn, point - turn @ point)
        return moved @ self.base_from_flange


@value_class(frozen=True, slots=True, eq=False)
class DhTable:
    """Each row rotates by theta about z, moves d along z and a along x, rotates by alpha about x.

    Source:
        Denavit, Hartenberg (1955), in the standard form.
    """

    base: Transform
    """Transform from base to frame 0; the identity if axis 1 is the z axis of the base."""
    theta: Array
    """Offset added to each joint (n,) [rad]; for a sliding joint the whole angle."""
    d: Array
    """Shape (n,) [m]; the value of a sliding joint is added to it."""
    a: Array
    alpha: Array
    """Shape (n,) [rad]."""
    flange: Transform
    """Transform from the last frame to the flange; usually the identity."""
    slides: Mask
    """Shape (n,): mask of the joints that slide along their axis; the others turn."""

    def forward(self, joints: Array) -> Transform:
        """Return base_from_flange of joints (n,) [rad]; see `Kinematics` for sliding ones."""
        moved = self.base
        thetas = self.theta + np.where(self.slides, 0.0, joints)
        ways = self.d + np.where(self.slides, METRES_PER_UNIT * joints, 0.0)
        for theta, d, a, alpha in zip(thetas, ways, self.a, self.alpha, strict=True):
            about_z = rotation_from_vector(np.array([0.0, 0.0, theta]))
            about_x = rotation_from_vector(np.array([alpha, 0.0, 0.0]))
            along = about_z @ np.array([a, 0.0, 0.0]) + np.array([0.0, 0.0, d])
            moved = moved @ Transform(about_z @ about_x, along)
        return moved @ self.flange


def screws_of(kinematics: Kinematics) -> Screws | None:
    """Return the screws of an arm; None if a joint does not turn about or slide along an axis."""
    zero = np.zeros(kinematics.joint_count)
    flange = kinematics.forward(zero)
    jacobian = kinematics.jacobian(zero)
    slides = kinematics.slides
    directions = np.where(slides[:, None], jacobian[:3].T / METRES_PER_UNIT, jacobian[3:].T)
    lengths = np.linalg.norm(directions, axis=1)
    if np.abs(lengths - 1.0).max() > _TOLERANCE:
        return None
    # The velocity of the flange is the direction crossed with the vector from the axis to it. Only
    # the direction of a sliding axis is significant; the axis is placed through the flange.
    away = np.where(slides[:, None], 0.0, np.cross(directions, jacobian[:3].T))
    points = flange.translation + away
    points = points - np.sum(points * directions, axis=1, keepdims=True) * directions
    screws = Screws(directions, points, flange, slides)
    return screws if _agrees(screws, kinematics) else None


def dh_table_of(kinematics: Kinematics) -> DhTable | None:
    """Return the standard DH table of an arm; None if it has no screws."""
    screws = screws_of(kinematics)
    if screws is None:
        return None
    directions, points = screws.directions, screws.points
    frames = [_first_frame(directions[0], points[0])]
    for (z, _), (following, point) in pairwise(zip(directions, points, strict=True)):
        frames.append(_next_frame(frames[-1], z, following, point))
    frames.append(_last_frame(frames[-1], directions[-1], screws.base_from_flange))
    rows = np.array([_row(before, after) for before, after in pairwise(frames)])
    theta, d, a, alpha = rows.T
    flange = frames[-1].inverse() @ screws.base_from_flange
    table = DhTable(frames[0], theta, d, a, alpha, flange, screws.slides)
    return table if _agrees(table, kinematics) else None


def _agrees(table: Screws | DhTable, kinematics: Kinematics) -> bool:
    """Whether a table agrees with the arm at some random joint values."""
    for joints in np.random.default_rng(0).uniform(-1.0, 1.0, (_TRIALS, kinematics.joint_count)):
        said, right = table.forward(joints).matrix, kinematics.forward(joints).matrix
        if np.abs(said - right).max() > _TOLERANCE:
            return False
    return True


def _first_frame(z: Array, point: Array) -> Transform:
    """Return frame 0: on axis 1 near the base, x as close to that of the base as z allows."""
    return Transform(_axes(_across(z, np.array([1.0, 0.0, 0.0])), z), point)


def _next_frame(before: Transform, z: Array, following: Array, point: Array) -> Transform:
    """Return the frame on the following axis, x along the common normal of both axes."""
    origin = before.translation
    normal = np.cross(z, following)
    sine = float(np.linalg.norm(normal))
    if sine < _TOLERANCE:
        # Parallel axes: use the common normal through the previous frame.
        foot = point + float((origin - point) @ following) * following
        aside = foot - origin - float((foot - origin) @ z) * z
        length = float(np.linalg.norm(aside))
        x = aside / length if length > _TOLERANCE else before.rotation[:, 0]
        return Transform(_axes(x, following), foot)
    x = normal / sine
    # Intersection of the following axis with the common normal.
    foot = point + float(np.cross(point - origin, z) @ normal) / sine**2 * following
    away = float((foot - origin) @ x)
    if away < -_TOLERANCE:
        x = -x
    elif abs(away) <= _TOLERANCE and float(x @ before.rotation[:, 0]) < -_TOLERANCE:
        # Intersecting axes: of both normals, use that on the side of the previous x.
        x = -x
    return Transform(_axes(x, following), foot)


def _last_frame(before: Transform, z: Array, base_from_flange: Transform) -> Transform:
    """Return the flange if its z axis is the last axis, else the nearest frame that DH allows."""
    x = _across(z, base_from_flange.rotation[:, 0])
    origin = before.translation
    way = float((base_from_flange.translation - origin) @ z)
    aside = base_from_flange.translation - origin - way * z
    if float(np.linalg.norm(aside)) > _TOLERANCE:
        x = aside / np.linalg.norm(aside)
    return Transform(_axes(x, z), base_from_flange.translation)


def _row(before: Transform, after: Transform) -> tuple[float, float, float, float]:
    """Return theta, d, a and alpha from one frame to the next."""
    x, z = before.rotation[:, 0], before.rotation[:, 2]
    y = before.rotation[:, 1]
    new_x, new_z, new_y = after.rotation[:, 0], after.rotation[:, 2], after.rotation[:, 1]
    way = after.translation - before.translation
    theta = float(np.arctan2(new_x @ y, new_x @ x))
    alpha = float(np.arctan2(new_y @ z, new_z @ z))
    return theta, float(way @ z), float(way @ new_x), alpha


def _across(z: Array, wanted: Array) -> Array:
    """Return the unit vector normal to z nearest to a direction, or another if that is along z."""
    for direction in (wanted, *np.eye(3)):
        aside = direction - float(direction @ z) * z
        length = float(np.linalg.norm(aside))
        if length > 1e-6:
            unit: Array = aside / length
            return unit
    raise AssertionError("some axis of three lies across any direction")


def _axes(x: Array, z: Array) -> Array:
    """Return the rotation (3, 3) with these x and z axes."""
    return np.stack([x, np.cross(z, x), z], axis=1)
