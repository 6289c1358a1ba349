"""Frames that move along a path: poses with their derivatives, composed and inverted.

Every derivative is with respect to the path parameter; the product rule yields the rest.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from rapidsim.frames.rotation_vectors import cross, rotate, rotation_from_vector
from rapidsim.frames.transform import Array, Transform
from rapidsim.values import value_class

Index = npt.NDArray[np.int64]


@value_class(frozen=True, slots=True, eq=False)
class Twists:
    """Poses along a path and their derivatives, all shapes (k, ...): a_from_b.

    `velocity` and `acceleration` are the first and second derivatives of the position, `turning`
    is the angular velocity per unit of the parameter, `turning_change` its derivative; all in a.
    """

    position: Array
    rotation: Array
    velocity: Array
    turning: Array
    acceleration: Array
    turning_change: Array

    @property
    def base_from_tcp(self) -> Transform:
        """Poses without derivatives."""
        return Transform(self.rotation, self.position)

    def __getitem__(self, index: Index | slice) -> Twists:
        """Return a subset, copied."""
        return Twists(*(np.array(part[index]) for part in self._parts))

    def put(self, index: Index, motion: Twists) -> None:
        """Replace some rows."""
        for mine, other in zip(self._parts, motion._parts, strict=True):
            mine[index] = other

    @property
    def _parts(self) -> tuple[Array, ...]:
        return (
            self.position,
            self.rotation,
            self.velocity,
            self.turning,
            self.acceleration,
            self.turning_change,
        )

    def __matmul__(self, other: Twists) -> Twists:
        """a_from_b @ b_from_c = a_from_c."""
        lever = rotate(self.rotation, other.position)
        velocity = rotate(self.rotation, other.velocity)
        turning = rotate(self.rotation, other.turning)
        swing = cross(self.turning, lever)
        return Twists(
            position=self.position + lever,
            rotation=self.rotation @ other.rotation,
            velocity=self.velocity + swing + velocity,
            turning=self.turning + turning,
            acceleration=self.acceleration
            + cross(self.turning_change, lever)
            + cross(self.turning, swing + 2.0 * velocity)
            + rotate(self.rotation, other.acceleration),
            turning_change=self.turning_change
            + cross(self.turning, turning)
            + rotate(self.rotation, other.turning_change),
        )

    def inverse(self) -> Twists:
        """Return the inverse, b_from_a."""
        back = np.swapaxes(self.rotation, -1, -2)
        swing = cross(self.turning, self.position)
        return Twists(
            position=-rotate(back, self.position),
            rotation=back,
            velocity=rotate(back, swing - self.velocity),
            turning=-rotate(back, self.turning),
            acceleration=rotate(
                back,
                cross(self.turning_change, self.position)
                - cross(self.turning, swing - 2.0 * self.velocity)
                - self.acceleration,
            ),
            turning_change=-rotate(back, self.turning_change),
        )

    def before(self, b_from_c: Transform) -> Twists:
        """Return a_from_c, where c is fixed in b; poses (k,) or one."""
        lever = rotate(self.rotation, b_from_c.translation)
        swing = cross(self.turning, lever)
        return Twists(
            position=self.position + lever,
            rotation=self.rotation @ b_from_c.rotation,
            velocity=self.velocity + swing,
            turning=self.turning,
            acceleration=self.acceleration
            + cross(self.turning_change, lever)
            + cross(self.turning, swing),
            turning_change=self.turning_change,
        )


class ExternalCourse(NamedTuple):
    """External axes along a path [m or rad] and their derivatives, shape (k, e) each."""

    value: Array
    first: Array
    second: Array


@value_class(frozen=True, slots=True, eq=False)
class Screw:
    """Motion of the objects that one external axis carries, in base, with all axes at zero.

    Source: the product of exponentials; Lynch and Park (2017), Modern Robotics, section 4.1.
    """

    axis: int
    """Index among the external axes, from 0."""
    direction: Array
    """Shape (3,), unit length: along a linear axis, about a rotating one."""
    through: Array | None
    """A point (3,) [m] on the axis of rotation; None for a linear axis."""

    def motion(self, course: ExternalCourse) -> Twists:
        """Return moved_from_unmoved along a course (k, e)."""
        value, first, second = (part[:, self.axis, None] for part in course)
        still = np.zeros((len(value), 3))
        way, rate, change = (self.direction * part for part in (value, first, second))
        if self.through is None:
            rotation = np.broadcast_to(np.eye(3), (len(value), 3, 3))
            return Twists(way, rotation, rate, still, change, still)
        rotation = rotation_from_vector(way)
        lever = -rotate(rotation, np.broadcast_to(self.through, still.shape))
        swing = cross(rate, lever)
        return Twists(
            position=self.through + lever,
            rotation=rotation,
            velocity=swing,
            turning=rate,
            acceleration=cross(change, lever) + cross(rate, swing),
            turning_change=change,
        )


def standing(a_from_b: Transform, count: int) -> Twists:
    """Return a stationary frame, `count` times."""
    still = np.zeros((count, 3))
    position = np.broadcast_to(a_from_b.translation, (count, 3))
    rotation = np.broadcast_to(a_from_b.rotation, (count, 3, 3))
    return Twists(position, rotation, still, still, still, still)


def carried(screws: Sequence[Screw], course: ExternalCourse) -> Twists:
    """Return moved_from_unmoved for several axes in series, the outermost first."""
    moved = standing(Transform.identity(), len(course.value))
    for screw in screws:
        moved = moved @ screw.motion(course)
    return moved
