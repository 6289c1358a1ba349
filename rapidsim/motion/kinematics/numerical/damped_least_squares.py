"""Damped least squares: joints approach a pose, in many searches in parallel.

The error is the remaining displacement of the flange [m] and rotation vector [rad], the step that
of Levenberg and Marquardt with the exact Jacobian. Damping decreases with every step that helps and
increases with every one that does not, so the search neither stalls nor diverges where the arm is
singular.
"""

from __future__ import annotations

import numpy as np

from rapidsim.frames.rotation_vectors import vector_from_rotation
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.motion.kinematics.serial_chain import SerialChain
from rapidsim.values import value_class

REACHED = 1e-9
"""Remaining distance [m] and angle [rad] at which a pose counts as reached."""
MOST_STEPS = 80
_AIM = 1e-12
"""Squared error at which a search ends: further steps only change rounding errors."""
_FIRST_DAMPING = 1e-3
_LEAST_DAMPING = 1e-12
_STUCK_DAMPING = 1e6


@value_class(frozen=True, slots=True, eq=False)
class SolverStates:
    """Final states of searches (k,)."""

    joints: Array
    """Shape (k, n) [rad]."""
    distance: Array
    """Shape (k,) [m]: remaining distance."""
    angle: Array
    """Shape (k,) [rad]: remaining rotation."""
    steps: int
    """Number of steps of the longest search."""

    @property
    def reached(self) -> Mask:
        """Shape (k,): whether the search has reached the pose."""
        reached: Mask = (self.distance <= REACHED) & (self.angle <= REACHED)
        return reached


def descend(
    chain: SerialChain,
    base_from_flange: Transform,
    starts: Array,
    lower: Array | None = None,
    upper: Array | None = None,
) -> SolverStates:
    """Search from seeds (k, n) [rad] for the joints of poses (k,).

    Args:
        chain: The arm.
        base_from_flange: A pose for each start.
        starts: Joint vectors.
        lower: Lower limits (n,) [rad] observed during the search; None for none.
        upper: Upper limits (n,) [rad] observed during the search; None for none.
    """
    low = np.full(chain.joint_count, -np.inf) if lower is None else lower
    high = np.full(chain.joint_count, np.inf) if upper is None else upper
    joints = np.clip(starts, low, high)
    error, jacobian = _error(chain, base_from_flange, joints)
    cost = np.sum(error**2, axis=-1)
    damping = np.full(len(joints), _FIRST_DAMPING)
    steps = 0
    for steps in range(1, MOST_STEPS + 1):  # noqa: B007 - The count is part of the result.
        rows = np.flatnonzero((cost > _AIM**2) & (damping < _STUCK_DAMPING))
        if not rows.size:
            break
        transposed = np.swapaxes(jacobian[rows], -1, -2)
        normal = transposed @ jacobian[rows]
        normal += damping[rows, None, None] * np.eye(chain.joint_count)
        downhill = np.einsum("kij,kj->ki", transposed, error[rows])
        step = np.linalg.solve(normal, downhill[..., None])[..., 0]
        tried = np.clip(joints[rows] + step, low, high)
        new_error, new_jacobian = _error(chain, base_from_flange[rows], tried)
        new_cost = np.sum(new_error**2, axis=-1)
        better = new_cost < cost[rows]
        damping[rows] = np.where(
            better, np.maximum(0.1 * damping[rows], _LEAST_DAMPING), 10.0 * damping[rows]
        )
        taken = rows[better]
        joints[taken], cost[taken] = tried[better], new_cost[better]
        error[taken], jacobian[taken] = new_error[better], new_jacobian[better]
    return SolverStates(
        joints,
        np.linalg.norm(error[:, :3], axis=-1),
        np.linalg.norm(error[:, 3:], axis=-1),
        steps,
    )


def _error(chain: SerialChain, target: Transform, joints: Array) -> tuple[Array, Array]:
    """Return the remaining twist to the target, (k, 6) in base, and the Jacobians (k, 6, n)."""
    flange, jacobian = chain.forward_and_jacobian(joints)
    way = target.translation - flange.translation
    turn = vector_from_rotation(target.rotation @ np.swapaxes(flange.rotation, -1, -2))
    return np.concatenate([way, turn], axis=-1), jacobian
