"""Relation of joint speeds to TCP velocity, and the singularities where it breaks down.

Everything is based on the singular values of the Jacobian, which remain valid where it has no
inverse. Its rows mix m/rad and rad/rad, as usual, so singular values compare poses of one arm, not
different arms. Here a sliding joint has a column in its own unit: m of the flange per m of the
joint.
"""

from __future__ import annotations

import numpy as np

from rapidsim.frames.rotation_vectors import cross, rotate
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.kinematics.arm import METRES_PER_UNIT, Kinematics
from rapidsim.motion.kinematics.singularity import Singularity
from rapidsim.values import value_class

SMALL_SINGULAR_VALUE = 1e-10
"""Share of the largest singular value below which a singular value counts as 0."""


@value_class(frozen=True, slots=True, eq=False)
class Differential:
    """Jacobian at one joint vector, with the quantities derived from it."""

    jacobian: Array
    """Shape (6, n): velocity [m/s] and angular velocity [rad/s] in base per joint speed [rad/s], or
    [m/s] for a sliding joint."""
    singular_values: Array
    """Shape (min(6, n),), in falling order."""
    manipulability: float
    """Product of the singular values: 0 in a singularity."""
    rank: int
    singularities: tuple[Singularity, ...]
    """All singularities of the arm, with distances."""

    @property
    def near(self) -> tuple[str, ...]:
        """Names of the nearby singularities."""
        return tuple(s.name for s in self.singularities if s.near)


def differential(
    kinematics: Kinematics, joints: Array, flange_from_tcp: Transform | None = None
) -> Differential:
    """Return the Jacobian of the TCP at joints (n,) [rad], and quantities derived from it."""
    jacobian = tcp_jacobian(kinematics, joints, flange_from_tcp or Transform.identity())
    jacobian = per_metre(kinematics, jacobian)
    values: Array = np.linalg.svd(jacobian, compute_uv=False).astype(np.float64)
    return Differential(
        jacobian=jacobian,
        singular_values=values,
        manipulability=float(np.prod(values)),
        rank=int(np.count_nonzero(values > SMALL_SINGULAR_VALUE * values[0])),
        singularities=kinematics.singularities(joints),
    )


def tcp_jacobian(kinematics: Kinematics, joints: Array, flange_from_tcp: Transform) -> Array:
    """Twist of the TCP per joint speed, (..., 6, n), in base, of joint vectors (..., n) [rad]."""
    of_flange = kinematics.jacobian(joints)
    lever = rotate(kinematics.forward(joints).rotation, flange_from_tcp.translation)
    jacobian = of_flange.copy()
    turning = np.swapaxes(of_flange[..., 3:, :], -1, -2)
    jacobian[..., :3, :] += np.swapaxes(cross(turning, lever[..., None, :]), -1, -2)
    return jacobian


def per_metre(kinematics: Kinematics, jacobian: Array) -> Array:
    """Jacobians (..., 6, n) with the columns of sliding joints per m."""
    slides = kinematics.slides
    return jacobian / np.where(slides, METRES_PER_UNIT, 1.0) if slides.any() else jacobian


def rapid_speeds(kinematics: Kinematics, speeds: Array) -> Array:
    """Joint speeds (..., n) [rad/s, m/s for a sliding joint] in RAPID's units [deg/s, mm/s]."""
    return np.where(kinematics.slides, 1e3 * speeds, np.degrees(speeds))


def pseudo_inverse(jacobian: Array) -> Array:
    """The pseudo-inverse (..., n, 6) of Jacobians (..., 6, n), which has the least joint speeds.

    Directions whose singular value counts as 0 are omitted, so the result is finite at every
    singularity, where the textbook's (J'J)^-1 J' does not exist.
    """
    inverse = np.linalg.pinv(jacobian, rcond=SMALL_SINGULAR_VALUE).astype(np.float64)
    return inverse


def joint_speeds(jacobian: Array, twist: Array) -> tuple[Array, Array]:
    """Return the joint speeds for a twist.

    Args:
        jacobian: Shape (..., 6, n).
        twist: Velocity [m/s] and angular velocity [rad/s] in base, shape (..., 6).

    Returns:
        Joint speeds (..., n), each in the unit of its column, and the part of the twist (..., 6)
        that no joint speeds produce.
    """
    speeds = np.einsum("...ij,...j->...i", pseudo_inverse(jacobian), twist)
    return speeds, twist - np.einsum("...ij,...j->...i", jacobian, speeds)
