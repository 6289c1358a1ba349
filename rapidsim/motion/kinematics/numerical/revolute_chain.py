"""Catalogue arms without a closed form: chains of revolute axes, solved by search.

These are arms whose axis 6 misses the intersection of axes 4 and 5, and arms with seven axes. They
are described by the positions of their axes with all joints at 0, so the numbers can be compared
with a drawing of the arm without any convention in between.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rapidsim.frames.transform import Transform
from rapidsim.motion.kinematics.numerical.offset_wrist import near_arm
from rapidsim.motion.kinematics.numerical.solver import Numerical
from rapidsim.motion.kinematics.serial_chain import AxesAtZero, SerialChain

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class AxisRowGeometry:
    """Positions of axes and flange in base with all joints at 0."""

    points: tuple[Vector, ...]
    """Point on each axis [m], from base to flange: the origin of the frame of its link."""
    directions: tuple[Vector, ...]
    """Directions of the axes, positive as the joint turns; of any length."""
    flange_point: Vector
    """[m]"""
    flange_quaternion: tuple[float, float, float, float]
    """Scalar first, of any length; z points out of the flange."""

    @cached_property
    def axes(self) -> AxesAtZero:
        """Axes, with link frames parallel to the base."""
        directions = np.array(self.directions, dtype=np.float64)
        points = np.array(self.points, dtype=np.float64)
        directions /= np.linalg.norm(directions, axis=-1, keepdims=True)
        upright = np.broadcast_to(np.eye(3), (len(points), 3, 3))
        flange = Transform.from_quaternion(self.flange_quaternion, self.flange_point)
        # The last link ends in the flange and is drawn there.
        places = np.concatenate([points[:-1], flange.translation[None]])
        return AxesAtZero(directions, points, Transform(upright, places), flange)


def searched_arm(geometry: AxisRowGeometry, limits: Sequence[tuple[float, float]]) -> Numerical:
    """Return the arm with the limits [rad] within which searches start."""
    lower, upper = np.array(limits).T
    chain = SerialChain.uncoupled(geometry.axes)
    return Numerical(chain, lower, upper, near_arm(geometry.axes))


def search_notices(name: str, reason: str, joint_count: int) -> tuple[str, ...]:
    """Return notices for the user about an arm that is solved by search.

    Args:
        name: The arm.
        reason: Reason why it has no closed form, such as `it has 7 axes`.
        joint_count: Number of its joints.
    """
    searched = (
        f"{name}: {reason}, so its joints are found by a numerical search; solutions beyond "
        "those found may exist"
    )
    if joint_count <= 6:
        return (searched,)
    nearest = (
        f"{name}: of the many solutions for a pose the closest of those found is "
        "used; the arm angle and the configuration of targets are ignored"
    )
    return searched, nearest
