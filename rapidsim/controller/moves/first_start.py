"""Configuration of an arm at the start of a run, if neither station nor program define it.

It is that of the first target, so that no finding is based on a guess: a line or arc as the first
move begins above it.
"""

from __future__ import annotations

import numpy as np

from rapidsim.controller.moves.configuration_choice import Quarters, nearest_without_switch
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.compliance import Match, hold
from rapidsim.motion.configurations.confdata import Configuration, configuration, configurations
from rapidsim.motion.configurations.reachability import pose_excess
from rapidsim.motion.robot.robot import Robot

_ABOVE_M: tuple[float, ...] = (0.1, 0.05, 0.02, 0.01, 0.0)
"""Heights [m] above the end of a line; the first that the arm reaches is used."""
_ARC_SHARES = (1.0, 0.5)
"""Heights above the middle of an arc, as shares of the distance from there to its end."""
_NO_TURN = 1.0
"""Turn [rad] that an axis makes on so short a line only through a singularity."""
_SAME = 1e-6


def first_configuration(
    robot: Robot, base_from_flange: Transform, stored: Quarters, start: Array, *, monitored: bool
) -> Configuration | None:
    """Configuration of an arm at its first target: the stored one, if it can be met.

    Else the nearest to joints (n,) [rad] at which the arm is assumed to begin; None if no
    configuration reaches the target. With ConfJ or ConfL on, other turns of the stored branch come
    first.
    """
    best = hold(robot, base_from_flange[None], np.array([stored]), start)
    if best.possible[0] and (monitored or best.match[0] <= Match.COMPLIANT):
        return configuration(robot.kinematics, best.joints[0])
    working = configurations(robot, base_from_flange)
    if not working:
        return None
    return nearest_without_switch(working, configuration(robot.kinematics, start))


def start_above(
    robot: Robot,
    end: Transform,
    via: Transform | None,
    tcp_from_flange: Transform,
    stored: Quarters,
    start: Array,
    *,
    monitored: bool,
) -> Array | None:
    """Joints (n,) [rad] above a line or arc, from which the arm reaches it; None if there are none.

    Args:
        robot: The arm.
        end: The end, base_from_tcp.
        via: The circle point of an arc; None for a line.
        tcp_from_flange: The inverse of the tool frame.
        stored: The configuration stored in the target.
        start: Joints (n,) [rad] at which the arm is assumed to begin otherwise.
        monitored: Whether ConfL is on.
    """
    flange = end @ tcp_from_flange
    reached = first_configuration(robot, flange, stored, start, monitored=monitored)
    if reached is None:
        return None
    middle, heights = end, _ABOVE_M
    if via is not None:
        radius = float(np.linalg.norm(end.translation - via.translation))
        middle, heights = via, tuple(share * radius for share in _ARC_SHARES)
    for height in heights:
        raised = Transform(middle.rotation, middle.translation + np.array([0.0, 0.0, height]))
        above = _on_branch(robot, raised @ tcp_from_flange, reached.joints)
        if above is None:
            continue
        back = _on_branch(robot, end @ tcp_from_flange, above)
        if back is not None and np.allclose(back, reached.joints, atol=_SAME):
            return above
    return None


def _on_branch(robot: Robot, base_from_flange: Transform, near: Array) -> Array | None:
    """Joints (n,) [rad] of a pose on the branch of joints near by; None if it turns an axis far."""
    branch = int(robot.kinematics.branch_of(near))
    found = robot.kinematics.inverse_on_branch(base_from_flange[None], branch, near)
    joints: Array = found.joints[0]
    if not found.exists[0] or pose_excess(robot, joints).any():
        return None
    return joints if np.abs(joints - near).max() < _NO_TURN else None
