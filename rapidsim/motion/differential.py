"""How joint speeds and TCP velocity go together, and where they stop doing so: singularities.

Everything rests on the singular values of the Jacobian, which stay true where it has no inverse.
Its rows mix m/rad and rad/rad, as usual, so singular values compare poses of one arm, not arms.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.five_axis import FiveAxis
from rapidsim.motion.kinematics import Kinematics
from rapidsim.motion.opw import OrthoParallel
from rapidsim.motion.palletizer import Palletizer
from rapidsim.motion.turns import cross, rotate

NEAR = 0.05
"""A singularity is near below this: 2.9 deg of an axis, 5 % of the reach."""
SMALL_SINGULAR_VALUE = 1e-10
"""Share of the largest singular value below which one counts as 0."""
WEAK = 0.02
"""For arms without formulas: smallest singular value below which a singularity is near."""
TAKES_PART = 0.2
"""Share of a joint in the motion that moves nothing from which it takes part in it."""


@dataclass(frozen=True, slots=True)
class Singularity:
    """A singularity and how far the arm is from it."""

    name: str
    """`wrist`, `elbow` or `shoulder`."""
    distance: float
    """The sine of an angle that vanishes on it, or the way to it as a share of the reach."""
    reason: str
    """What has come together, in words."""

    @property
    def near(self) -> bool:
        """Whether joint speeds grow much beyond those of usual poses."""
        return self.distance < NEAR


@dataclass(frozen=True, slots=True, eq=False)
class Differential:
    """What the Jacobian says at one joint vector."""

    jacobian: Array
    """Shape (6, n): velocity [m/s] and angular velocity [rad/s] in base per joint speed [rad/s]."""
    singular_values: Array
    """From the largest, shape (min(6, n),)."""
    manipulability: float
    """Product of the singular values: 0 in a singularity."""
    rank: int
    singularities: tuple[Singularity, ...]
    """Those that the arm has, with distances."""

    @property
    def near(self) -> tuple[str, ...]:
        """Names of the singularities that are near."""
        return tuple(s.name for s in self.singularities if s.near)


def differential(
    kinematics: Kinematics, joints: Array, flange_from_tcp: Transform | None = None
) -> Differential:
    """The Jacobian of the TCP at joints (n,) [rad] and what follows from it."""
    jacobian = tcp_jacobian(kinematics, joints, flange_from_tcp or Transform.identity())
    values: Array = np.linalg.svd(jacobian, compute_uv=False).astype(np.float64)
    return Differential(
        jacobian=jacobian,
        singular_values=values,
        manipulability=float(np.prod(values)),
        rank=int(np.count_nonzero(values > SMALL_SINGULAR_VALUE * values[0])),
        singularities=singularities(kinematics, joints),
    )


def tcp_jacobian(kinematics: Kinematics, joints: Array, flange_from_tcp: Transform) -> Array:
    """Twist of the TCP per joint speed, (..., 6, n), in base, of joint vectors (..., n) [rad]."""
    of_flange = kinematics.jacobian(joints)
    lever = rotate(kinematics.forward(joints).rotation, flange_from_tcp.translation)
    jacobian = of_flange.copy()
    turning = np.swapaxes(of_flange[..., 3:, :], -1, -2)
    jacobian[..., :3, :] += np.swapaxes(cross(turning, lever[..., None, :]), -1, -2)
    return jacobian


def pseudo_inverse(jacobian: Array) -> Array:
    """The inverse (..., n, 6) of Jacobians (..., 6, n) that asks the least joint speeds.

    Directions whose singular value counts as 0 are left out, so the result is finite in every
    singularity, where the textbook's (J'J)^-1 J' does not exist.
    """
    inverse = np.linalg.pinv(jacobian, rcond=SMALL_SINGULAR_VALUE).astype(np.float64)
    return inverse


def joint_speeds(jacobian: Array, twist: Array) -> tuple[Array, Array]:
    """Joint speeds for a twist.

    Args:
        jacobian: Shape (..., 6, n).
        twist: Velocity [m/s] and angular velocity [rad/s] in base, shape (..., 6).

    Returns:
        Joint speeds (..., n) [rad/s], and the part of the twist (..., 6) that no joint speeds give.
    """
    speeds = np.einsum("...ij,...j->...i", pseudo_inverse(jacobian), twist)
    return speeds, twist - np.einsum("...ij,...j->...i", jacobian, speeds)


def singularities(kinematics: Kinematics, joints: Array) -> tuple[Singularity, ...]:
    """The singularities of an arm and how far joints (n,) [rad] are from each."""
    match kinematics:
        case OrthoParallel():
            return _of_ortho_parallel(kinematics, joints)
        case FiveAxis():
            return _of_five_axis(kinematics, joints)
        case Palletizer():
            return _of_palletizer(kinematics, joints)
        case _:
            return _by_idle_motion(kinematics.jacobian(joints))


def _of_ortho_parallel(arm: OrthoParallel, joints: Array) -> tuple[Singularity, ...]:
    """The determinant is the product of these three and of lengths."""
    g = arm.geometry
    _, t2, t3, _, t5, _ = arm.theta_from_joints(joints).tolist()
    forward = g.a1 + g.c2 * np.sin(t2) + g.c3 * np.sin(t2 + t3) + g.a2 * np.cos(t2 + t3)
    bend = np.sin(t3 + np.arctan2(g.a2, g.c3))
    return (
        Singularity("wrist", abs(float(np.sin(t5))), "axes 4 and 6 are in line"),
        Singularity("elbow", abs(float(bend)), "the wrist centre is in line with axes 2 and 3"),
        Singularity("shoulder", abs(float(forward)) / g.reach, "the wrist centre is on axis 1"),
    )


def _of_five_axis(arm: FiveAxis, joints: Array) -> tuple[Singularity, ...]:
    """The Jacobian loses rank with the elbow stretched, or with the roll axis on the waist axis.

    Its first three rows, the velocity, do so earlier where the flange is on the waist axis,
    whatever the roll axis does: then no joint moves the flange sideways.
    """
    reach = arm.geometry.reach
    bend = abs(float(np.sin(joints[2])))
    aside = abs(float(arm.flange_forward(joints))) / reach
    return (
        Singularity("elbow", bend, "axes 2, 3 and 4 are in one plane: the arm is straight"),
        Singularity("shoulder", aside, "the flange is on axis 1"),
    )


def _of_palletizer(arm: Palletizer, joints: Array) -> tuple[Singularity, ...]:
    bend = abs(float(np.cos(joints[2] - joints[1])))
    aside = abs(float(arm.flange_forward(joints))) / arm.geometry.reach
    return (
        Singularity("elbow", bend, "upper arm and forearm are in line"),
        Singularity("shoulder", aside, "the flange is on axis 1"),
    )


def _by_idle_motion(jacobian: Array) -> tuple[Singularity, ...]:
    """What singularity a weak Jacobian (6, n) stands for, by the joints that move in vain.

    Arms with more than six joints always have such motions; only those that come on top count.
    """
    _, values, directions = np.linalg.svd(jacobian)
    weakest = min(jacobian.shape) - 1
    takes_part = np.abs(directions[weakest]) > TAKES_PART
    if takes_part[0]:
        name = "shoulder"
    elif takes_part[1:-3].any():
        name = "elbow"
    else:
        name = "wrist"
    moving = ", ".join(str(number + 1) for number in np.flatnonzero(takes_part))
    distance = NEAR * float(values[weakest]) / WEAK
    return (Singularity(name, distance, f"joints {moving} together move the flange little"),)
