"""Forward kinematics of any chain of axes, from their positions at joint values 0.

Used by arms without closed formulas, and by several with a closed-form inverse.
"""

from __future__ import annotations

from functools import cached_property

import numpy as np

from rapidsim.frames.rotation_vectors import cross, cross_matrix
from rapidsim.frames.transform import Array, Transform
from rapidsim.values import value_class


@value_class(frozen=True, slots=True, eq=False)
class AxesAtZero:
    """Axes of rotation with all joints at 0, in base, from base to flange."""

    directions: Array
    """Unit vectors (m, 3)."""
    points: Array
    """Point (m, 3) [m] on each axis."""
    base_from_link: Transform
    """Shape (m,): link that each axis moves."""
    base_from_flange: Transform


@value_class(frozen=True, eq=False)
class SerialChain:
    """Chain of axes, each of which carries the next.

    Source:
        Brockett (1984), Robotic manipulators and the product of exponentials formula.
    """

    axes: AxesAtZero
    axis_from_joint: Array
    """Shape (m, n): axis angles per joint value; the unit matrix unless rods couple axes."""
    links: tuple[int, ...]
    """Index, from 0, of the axis that moves the link of each of the n joints."""

    @staticmethod
    def uncoupled(axes: AxesAtZero) -> SerialChain:
        """Return a chain with one joint per axis."""
        count = len(axes.points)
        return SerialChain(axes, np.eye(count), tuple(range(count)))

    @property
    def joint_count(self) -> int:
        """Number of joints of the arm."""
        return int(self.axis_from_joint.shape[1])

    @cached_property
    def _turns(self) -> tuple[Array, Array]:
        """Matrices (m, 3, 3) that are multiplied by the sine, and one minus cosine, of an angle."""
        once = cross_matrix(self.axes.directions)
        return once, once @ once

    def forward(self, joints: Array) -> Transform:
        """Return base_from_flange of joint vectors (..., n) [rad]."""
        return self._moved(joints)[-1] @ self.axes.base_from_flange

    def link_frames(self, joints: Array) -> Transform:
        """Return base_from_link of the link of each joint, shape (..., n), of joints (..., n)."""
        moved = self._moved(joints)
        frames = [moved[axis] @ self.axes.base_from_link[axis] for axis in self.links]
        return Transform(
            np.stack([frame.rotation for frame in frames], axis=-3),
            np.stack([frame.translation for frame in frames], axis=-2),
        )

    def jacobian(self, joints: Array) -> Array:
        """Return the flange twist per joint speed, (..., 6, n): [m/rad] over [rad/rad], in base."""
        return self.forward_and_jacobian(joints)[1]

    def forward_and_jacobian(self, joints: Array) -> tuple[Transform, Array]:
        """Return both at the cost of one; needed at every step of a search."""
        moved = self._moved(joints)
        flange = moved[-1] @ self.axes.base_from_flange
        columns = []
        for axis, frame in enumerate(moved):
            direction = np.einsum("...ij,j->...i", frame.rotation, self.axes.directions[axis])
            arm = flange.translation - frame.apply(self.axes.points[axis])
            columns.append(np.concatenate([cross(direction, arm), direction], axis=-1))
        return flange, np.stack(columns, axis=-1) @ self.axis_from_joint

    def _moved(self, joints: Array) -> list[Transform]:
        """Return the displacement of each axis's link from its pose at joint values 0."""
        angles = np.asarray(joints, dtype=np.float64) @ self.axis_from_joint.T
        sine, cosine = np.sin(angles)[..., None, None], 1.0 - np.cos(angles)[..., None, None]
        once, twice = self._turns
        moved: list[Transform] = []
        for axis, point in enumerate(self.axes.points):
            turn = np.eye(3) + sine[..., axis, :, :] * once[axis]
            turn = turn + cosine[..., axis, :, :] * twice[axis]
            here = Transform(turn, point - turn @ point)
            moved.append(moved[-1] @ here if moved else here)
        return moved
