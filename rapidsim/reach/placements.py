"""Reach and stored configurations of a program's moves for many robot positions at once.

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
from rapidsim.reach.dataflow.known_moves import KnownMoves
from rapidsim.reach.dataflow.program_walk import walk_program
from rapidsim.reach.target_poses import posed
from rapidsim.values import value_class

_BATCH = 8192
"""Number of poses that are solved at once."""


@value_class(frozen=True, slots=True, eq=False)
class PlacedReach:
    """Reach of the moves of a program from positions (k,)."""

    moves: int
    """Number of move instructions that were checked; those that require a run were not."""
    unreachable: Index
    """Shape (k,): number of ends that no configuration reaches within the limits."""
    other_configuration: Index
    """Shape (k,): number of ends reached, but not as stored although it is monitored."""
    margin: Array
    """Shape (k,) [rad]: smallest distance of an axis from a limit at these ends; infinite if not
    all of them are reached as stored, as the joints are then unknown."""


def reach_from(
    program: Program,
    robot: Robot,
    world_from_base: Transform,
    external: Sequence[ExternalAxis] = (),
    check_deadline: Look = undisturbed,
    *,
    exact: bool = False,
) -> PlacedReach:
    """Check all statically known moves, with the robot at positions (k,).

    Args:
        program: A checked program.
        robot: The arm.
        world_from_base: The robot's positions, shape (k,).
        external: External axes; moves that involve them are skipped.
        check_deadline: Called regularly; may raise to interrupt the check.
        exact: Tolerate no quarter turn between a configuration and the stored one.
    """
    known = walk_program(program).moves
    placed = posed(known, robot, Transform.identity(), external)
    checked = placed.is_placed & ~placed.carried
    checked &= ~known.each(lambda one: may_be_wrist_driven(one, robot))
    to_poses = np.flatnonzero(checked & ~placed.to_axes)
    to_axes = np.flatnonzero(checked & placed.to_axes)
    count = len(world_from_base)
    past_limits = programmed_excess(robot, placed.axes[to_axes]).any(axis=-1)
    unreachable = np.zeros((count, len(known)), dtype=bool)
    unreachable[:, to_axes] = past_limits
    other = np.zeros((count, len(known)), dtype=bool)
    to_axes_margin = _margins(robot, placed.axes[to_axes]).min(initial=np.inf)
    margin = np.full(count, to_axes_margin if not past_limits.any() else np.inf)
    if len(to_poses):
        confdata = confdata_columns(known, to_poses)
        monitored = known.each(lambda one: is_monitored(one, robot))[to_poses]
        # The robot's base was at the world's origin, so base and world are one.
        world_from_flange = placed.base_from_flange[to_poses]
        base_from_world = world_from_base.inverse()
        at_once = max(1, _BATCH // len(to_poses))
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
    instructions = _instructions(known, np.flatnonzero(checked))
    return PlacedReach(
        len(instructions),
        _counted(unreachable, instructions),
        _counted(other & ~unreachable, instructions),
        margin,
    )


def _each_from_each(a_from_b: Transform, b_from_c: Transform) -> Transform:
    """Products (v * m,) of transforms (v,) and (m,), in order of the first factor."""
    one = Transform(a_from_b.rotation[:, None], a_from_b.translation[:, None])
    product = one @ Transform(b_from_c.rotation[None], b_from_c.translation[None])
    return Transform(product.rotation.reshape(-1, 3, 3), product.translation.reshape(-1, 3))


def _margins(robot: Robot, joints: Array) -> Array:
    """Smallest distance (k,) [rad] of an axis from a limit at joints (k, n) [rad]."""
    margins: Array = np.minimum(joints - robot.lower, robot.upper - joints).min(axis=-1)
    return margins


def _instructions(known_moves: KnownMoves, rows: Index) -> list[Index]:
    """Return the rows of each move instruction: several paths of a program may reach it."""
    found: dict[int, list[int]] = {}
    for row, number in zip(rows.tolist(), known_moves.instruction[rows].tolist(), strict=True):
        found.setdefault(number, []).append(row)
    return [np.array(of_one, dtype=np.int64) for of_one in found.values()]


def _counted(holds: Mask, instructions: Sequence[Index]) -> Index:
    """Return the number of instructions for which a condition holds on some path."""
    total = np.zeros(len(holds), dtype=np.int64)
    for rows in instructions:
        total += holds[:, rows].any(axis=-1)
    return total
