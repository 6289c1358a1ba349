"""SciPy's general-purpose solvers for one pose: slower than our own, as a second opinion.

The only module of this room that imports SciPy, and only when such a solver is requested.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

import numpy as np
from scipy import optimize

from rapidsim.frames.rotation_vectors import cross_matrix, vector_from_rotation
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.reachability import limit_excess, turns_within_limits
from rapidsim.motion.kinematics.arm import Kinematics
from rapidsim.motion.kinematics.numerical.seeds import spread_starts
from rapidsim.motion.robot.robot import Robot
from rapidsim.values import value_class

METRES_PER_RADIAN = 0.3
"""Weight of an angle against a distance, so that both count equally at the size of an arm."""
TOLERANCE = 1e-6
"""Remaining distance [m] and angle [rad] at which a pose counts as reached."""
MOST_STARTS = 12
MOST_EVALUATIONS = 400


@value_class(frozen=True, slots=True, eq=False)
class SolverHistory:
    """The course of a search."""

    joints: Array
    """Shape (n,) [rad]: the solution, or the nearest joints of the search."""
    solved: bool
    """Whether the pose is reached within the joint limits."""
    distance: float
    """Remaining distance [m]."""
    angle: float
    """Remaining angle [rad]."""
    starts: int
    iterations: int
    """Steps of all starts; for `lm` evaluations, as SciPy does not count its steps."""


def search(
    robot: Robot, base_from_flange: Transform, method: str, start: Array | None = None
) -> SolverHistory:
    """Search for the joints of one pose from several starts until a solution is within the limits.

    Args:
        robot: The arm.
        base_from_flange: One pose.
        method: `lm`, `trf` or `bfgs`. Only `trf` observes the limits during the search; results of
            the others are shifted by whole turns and then compared with them.
        start: Joints (n,) [rad] to start from, before other starts.
    """
    run = METHODS[method]
    target = _Target(robot.kinematics, base_from_flange)
    best: SolverHistory | None = None
    iterations = 0
    starts = spread_starts(robot.lower, robot.upper, MOST_STARTS)
    if start is not None:
        starts = np.concatenate([start[None], starts])
    for number, start in enumerate(starts, start=1):
        found, steps = run(target, start, robot.lower, robot.upper)
        iterations += steps
        joints = turns_within_limits(robot, found)
        distance, angle = target.pose_error(joints)
        reached = distance <= TOLERANCE and angle <= TOLERANCE
        solved = reached and not limit_excess(robot, joints).any()
        ended = SolverHistory(joints, solved, distance, angle, number, iterations)
        if solved:
            return ended
        if best is None or distance + angle < best.distance + best.angle:
            best = ended
    assert best is not None
    return SolverHistory(best.joints, False, best.distance, best.angle, len(starts), iterations)


@value_class(frozen=True, slots=True, eq=False)
class _Target:
    """Residual of the search: twelve numbers, smooth everywhere, with their exact derivatives."""

    kinematics: Kinematics
    pose: Transform

    def residual(self, joints: Array) -> Array:
        """Position error [m] and difference of the rotation matrices, weighted, shape (12,)."""
        flange = self.kinematics.forward(joints)
        turned = (flange.rotation - self.pose.rotation).ravel() * (METRES_PER_RADIAN / np.sqrt(2.0))
        return np.concatenate([flange.translation - self.pose.translation, turned])

    def derivative(self, joints: Array) -> Array:
        """Shape (12, n)."""
        jacobian = self.kinematics.jacobian(joints)
        turning = cross_matrix(jacobian[3:].T) @ self.kinematics.forward(joints).rotation
        turned = turning.reshape(len(turning), 9).T * (METRES_PER_RADIAN / np.sqrt(2.0))
        return np.concatenate([jacobian[:3], turned])

    def pose_error(self, joints: Array) -> tuple[float, float]:
        """Distance [m] and angle [rad] from the pose."""
        flange = self.kinematics.forward(joints)
        turn = vector_from_rotation(self.pose.rotation @ flange.rotation.T)
        way = self.pose.translation - flange.translation
        return float(np.linalg.norm(way)), float(np.linalg.norm(turn))


def _levenberg_marquardt(target: _Target, start: Array, _: Array, __: Array) -> tuple[Array, int]:
    result = optimize.least_squares(
        target.residual,
        start,
        target.derivative,
        method="lm",
        xtol=1e-14,
        ftol=1e-14,
        gtol=1e-14,
        max_nfev=MOST_EVALUATIONS,
    )
    return result.x, int(result.nfev)


def _trust_region(target: _Target, start: Array, lower: Array, upper: Array) -> tuple[Array, int]:
    result = optimize.least_squares(
        target.residual,
        start,
        target.derivative,
        bounds=(lower, upper),
        method="trf",
        xtol=1e-14,
        ftol=1e-14,
        gtol=1e-14,
        max_nfev=MOST_EVALUATIONS,
    )
    return result.x, int(result.njev)


def _bfgs(target: _Target, start: Array, _: Array, __: Array) -> tuple[Array, int]:
    def cost(joints: Array) -> tuple[float, Array]:
        residual = target.residual(joints)
        return 0.5 * float(residual @ residual), residual @ target.derivative(joints)

    result = optimize.minimize(
        cost, start, jac=True, method="BFGS", options={"gtol": 1e-10, "maxiter": MOST_EVALUATIONS}
    )
    return result.x, int(result.nit)


METHODS: Mapping[str, Callable[[_Target, Array, Array, Array], tuple[Array, int]]] = (
    MappingProxyType({"lm": _levenberg_marquardt, "trf": _trust_region, "bfgs": _bfgs})
)
