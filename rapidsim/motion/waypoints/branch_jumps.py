"""Detection of joint jumps of an arm that follows a path of its TCP.

Whether joints jump must not depend on how finely a trajectory is sampled. So times are added where
joints move far from one sample to the next, until they do not, or until the time between two is so
short that no axis could move as far.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

import numpy as np
import numpy.typing as npt

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.kinematics.unwrapping import turning
from rapidsim.motion.robot.robot import Robot
from rapidsim.motion.waypoints.plan import TcpMotion

Solution = TypeVar("Solution")

DECIDED_S = 0.012
"""Largest time [s] between the samples by which a path is accepted or refused."""
_LARGEST = 0.5
"""Largest motion [rad] of an axis within that time: no axis is that fast."""
_FAR = 0.05
"""Step [rad] of an axis above which times are added between two samples."""
_SHORTEST_S = 1e-4
"""Time [s] between two samples that is not divided again."""
_PARTS = 8
"""Number of parts into which the time between two samples is divided at once."""
_SMOOTH = 0.1
"""Deviation [rad] of the joints midway between two samples from their mean without a jump."""
_HALVINGS = 24
"""Bisections of the time between two samples, after which a branch change is on the path itself."""


def with_small_steps(
    times: Array, solve: Callable[[Array], Solution], steps: Callable[[Solution], Array]
) -> tuple[Array, Solution]:
    """Return times [s] with more in between where an axis moves far, and their solution.

    Args:
        times: Shape (k,), increasing.
        solve: Solves a motion at times (k,).
        steps: Returns the largest step (k - 1,) [rad] of any axis in a solution.
    """
    while True:
        solution = solve(times)
        wide = np.flatnonzero((steps(solution) > _FAR) & (np.diff(times) > _SHORTEST_S))
        if not len(wide):
            return times, solution
        share = np.arange(1, _PARTS) / _PARTS
        between = times[wide, None] + share * np.diff(times)[wide, None]
        times = np.sort(np.concatenate([times, between.reshape(-1)]))


def too_fast(
    robot: Robot, times: Array, joints: Array, exists: npt.NDArray[np.bool_] | None = None
) -> tuple[int, int, float] | None:
    """Return sample before, joint and size [rad] of the farthest motion that no axis can make.

    Args:
        robot: The arm.
        times: Shape (k,) [s].
        joints: Shape (k, n) [rad].
        exists: Samples (k,) that have joints; None for all.
    """
    until = np.searchsorted(times, times + DECIDED_S * (1.0 + 1e-9), side="right") - 1
    until = np.maximum(until, np.minimum(np.arange(len(times)) + 1, len(times) - 1))
    step = np.abs(turning(joints[until] - joints, robot.kinematics.turns))
    if exists is not None:
        step[~(exists & exists[until])] = 0.0
    row, joint = (int(i) for i in np.unravel_index(np.argmax(step), step.shape))
    return (row, joint, float(step[row, joint])) if step[row, joint] > _LARGEST else None


def jump_on(
    robot: Robot, motion: TcpMotion, tcp_from_flange: Transform, times: Array, joints: Array
) -> tuple[int, int, float] | None:
    """Return sample before, joint and size [rad] of a jump of the arm; None if there is none.

    A jump occurs between two samples, and may be hidden: close to a singularity joints on two
    branches nearly coincide, and only the poses in between show whether the path passes from one to
    the other.
    """
    jump = too_fast(robot, times, joints)
    if jump is not None:
        return jump
    branch = robot.kinematics.branch_of(joints)
    for row in np.flatnonzero(np.diff(branch)).tolist():
        ends = {int(branch[row]): joints[row], int(branch[row + 1]): joints[row + 1]}
        first = int(branch[row])
        low, high = float(times[row]), float(times[row + 1])
        for _ in range(_HALVINGS):
            middle = 0.5 * (low + high)
            flange = motion.at(np.array([middle]))[0] @ tcp_from_flange
            average = sum(ends.values()) / 2.0
            found = {
                at: robot.kinematics.inverse_on_branch(flange, at, average[None]) for at in ends
            }
            off = {
                at: np.abs(turning(one.joints[0] - average, robot.kinematics.turns))
                if one.exists[0]
                else np.full_like(average, np.pi)
                for at, one in found.items()
            }
            nearer = min(off, key=lambda at: float(off[at].max()))
            if off[nearer].max() > _SMOOTH:
                return row, int(off[nearer].argmax()), 2.0 * float(off[nearer].max())
            ends[nearer] = found[nearer].joints[0]
            low, high = (middle, high) if nearer == first else (low, middle)
    return None
