"""The moves of a program for many robot positions at once: reach and stored configurations.

For each position the result is that of checking the ends of moves; the paths between them are not
examined.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from rapidsim.analysis.program import Program
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.reachability import programmed_excess
from rapidsim.motion.geometry.curves import Index
from rapidsim.motion.interruption import Look, undisturbed
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.motion.robot.external_axes import ExternalAxis
from rapidsim.motion.robot.robot import Robot
from rapidsim.reach.arm_configurations import confdata_columns, is_monitored, solved_ends
from rapidsim.reach.dataflow.circle_modes import may_be_wrist_driven
from rapidsim.reach.dataflow.known_moves import KnownMove
from rapidsim.reach.dataflow.program_walk import walk_program
from rapidsim.reach.target_poses import posed
from rapidsim.values import value_class

_BATCH = 8192
"""Poses solved at once."""


@value_class(frozen=True, slots=True, eq=False)
class PlacedReach:
    """What the arm can do about the moves of a program from positions (k,)."""

    moves: int
    """How many move instructions were looked at; those that only a run can tell were not."""
    unreachable: Index
    """Shape (k,): ends that no configuration reaches within the limits."""
    other_configuration: Index
    """Shape (k,): ends that are reached, but not as stored where the controller insists on it."""
    margin: Array
    """Shape (k,) [rad]: the least way that an axis has left to a limit at these ends; infinite
    where not all of them are reached as stored, for then nobody knows how the arm stands."""


def reach_from(
    program: Program,
    robot: Robot,
    world_from_base: Transform,
    external: Sequence[ExternalAxis] = (),
    check_deadline: Look = undisturbed,
    *,
    exact: bool = False,
) -> PlacedReach:
    """Check all moves known without a run, with the robot at positions (k,).

    Args:
        program: A checked program.
        robot: The arm.
        world_from_base: The robot's positions, shape (k,).
        external: External axes; moves that involve them are skipped.
        check_deadline: Called now and then.
        exact: Tolerate no quarter turn between a configuration and the stored one.
    """
    known = walk_program(program).moves
    placed = posed(known, robot, Transform.identity(), external)
    rows = [
        row
        for row in range(len(known))
        if row not in placed.left_out and not may_be_wrist_driven(known[row], robot)
    ]
    to_poses = np.array([row for row in rows if not placed.to_axes[row]], dtype=np.int64)
    to_axes = np.array([row for row in rows if placed.to_axes[row]], dtype=np.int64)
    count = len(world_from_base)
    past_limits = programmed_excess(robot, placed.axes[to_axes]).any(axis=-1)
    unreachable = np.zeros((count, len(known)), dtype=bool)
    unreachable[:, to_axes] = past_limits
    other = np.zeros((count, len(known)), dtype=bool)
    to_axes_margin = _margins(robot, placed.axes[to_axes]).min(initial=np.inf)
    margin = np.full(count, to_axes_margin if not past_limits.any() else np.inf)
    if len(to_poses):
        moves = [known[row] for row in to_poses.tolist()]
        confdata = confdata_columns(moves)
        monitored = np.array([is_monitored(one, robot) for one in moves])
        # With the base in the world's place, base and world are one.
        world_from_flange = placed.base_from_flange[to_poses]
        base_from_world = world_from_base.inverse()
        at_once = max(1, _BATCH // len(moves))
        for first in range(0, count, at_once):
            check_deadline()
            at = slice(first, min(first + at_once, count))
            flange = _each_from_each(base_from_world[at], world_from_flange)
            places = at.stop - at.start
            solved = solved_ends(robot, flange, np.tile(confdata, (places, 1)), exact=exact)
            reached = solved.reachable.reshape(places, -1)
            held = solved.on_stored_branch.reshape(places, -1)
            unreachable[at, to_poses] = ~reached
            other[at, to_poses] = reached & ~held & monitored
            least = _margins(robot, solved.stored).reshape(places, -1).min(axis=-1)
            known_stance = held.all(axis=-1) & ~past_limits.any()
            margin[at] = np.where(known_stance, np.minimum(margin[at], least), np.inf)
    instructions = _instructions(known, rows)
    return PlacedReach(
        len(instructions),
        _counted(unreachable, instructions),
        _counted(other & ~unreachable, instructions),
        margin,
    )


def _each_from_each(a_from_b: Transform, b_from_c: Transform) -> Transform:
    """All products of transforms (v,) and (m,), shape (v * m,), those with the first one first."""
    one = Transform(a_from_b.rotation[:, None], a_from_b.translation[:, None])
    product = one @ Transform(b_from_c.rotation[None], b_from_c.translation[None])
    return Transform(product.rotation.reshape(-1, 3, 3), product.translation.reshape(-1, 3))


def _margins(robot: Robot, joints: Array) -> Array:
    """The least way (k,) [rad] that an axis has to a limit at joints (k, n) [rad]."""
    margins: Array = np.minimum(joints - robot.lower, robot.upper - joints).min(axis=-1)
    return margins


def _instructions(known_moves: Sequence[KnownMove], rows: Sequence[int]) -> list[Index]:
    """The rows of each move instruction: a program may come to it in several ways."""
    found: dict[object, list[int]] = {}
    for row in rows:
        found.setdefault(known_moves[row].call, []).append(row)
    return [np.array(of_one, dtype=np.int64) for of_one in found.values()]


def _counted(holds: Mask, instructions: Sequence[Index]) -> Index:
    """For how many instructions something holds in some way that the program comes to them."""
    total = np.zeros(len(holds), dtype=np.int64)
    for rows in instructions:
        total += holds[:, rows].any(axis=-1)
    return total
