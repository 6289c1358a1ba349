"""Changes that make poses reachable: the shortest shift, the smallest rotation of the tool.

The search solves batches of poses, so joint limits count and every kind of arm is supported;
results are solved, not estimated.
"""

from __future__ import annotations

import math
from typing import Literal

import numpy as np

from rapidsim.frames.rotation_vectors import rotation_from_vector
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.reachability import (
    Unreachable,
    limit_excess,
    turns_within_limits,
)
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.motion.robot.robot import Robot
from rapidsim.values import value_class

FARTHEST = 1.5
"""Largest shift [m] that is proposed."""
_DIRECTIONS = 192
_NEAR_RINGS = np.arange(0.01, 0.3, 0.01)
_RINGS = np.concatenate([_NEAR_RINGS, np.arange(0.3, FARTHEST + 0.02, 0.03)])
_HALVINGS = 14
_TILTS = np.radians([12.0, 6.0, 3.0, 1.5, 0.8, 0.4, 0.2, 0.1])
_MOST_ACTIVE = 24
_ROUNDS = 8
_TURN_STEP = 5.0
_LARGEST_TILT = 60.0
_BATCH = 8192


@value_class(frozen=True, slots=True)
class ToolTurn:
    """Rotation of the tool about one of its axes through the TCP that makes the pose reachable."""

    axis: Literal["x", "y", "z"]
    degrees: float


def reachable(robot: Robot, base_from_flange: Transform) -> Mask:
    """Mask (k,) of the poses that the arm reaches within its limits, in any configuration."""
    found = []
    for first in range(0, len(base_from_flange), _BATCH):
        branches = robot.inverse(base_from_flange[first : first + _BATCH])
        turned = turns_within_limits(robot, branches.joints)
        within = branches.exists & ~limit_excess(robot, turned).any(axis=-1)
        found.append(within.any(axis=-1))
    mask: Mask = np.concatenate(found) if found else np.zeros(0, dtype=bool)
    return mask


def nearest_shift(robot: Robot, base_from_flange: Transform) -> Array | None:
    """Return the shortest shift (3,) [m] in base after which the arm reaches all poses (k,).

    None if no shift up to `FARTHEST` works. The shift is rounded to millimetres and verified.
    """
    bad = np.flatnonzero(~reachable(robot, base_from_flange))
    if not bad.size:
        return np.zeros(3)
    if float(np.max(robot.inverse(base_from_flange[bad]).shortfall)) > FARTHEST:
        return None
    active = bad[:: max(1, len(bad) // (_MOST_ACTIVE // 2))].tolist()
    for _ in range(_ROUNDS):
        shift = _search(robot, base_from_flange[active])
        if shift is None:
            return None
        bad = np.flatnonzero(~reachable(robot, _shifted(base_from_flange, shift[None])[0]))
        if not bad.size:
            return shift
        active = sorted({*active, *bad[:: max(1, len(bad) // 4)].tolist()})
        if len(active) > _MOST_ACTIVE:
            return None
    return None


def least_turn(
    robot: Robot, base_from_tcp: Transform, tcp_from_flange: Transform
) -> ToolTurn | None:
    """Return the smallest rotation of the tool about its z, x or y that makes a pose reachable."""
    turns: list[ToolTurn] = []
    vectors: list[Array] = []
    for axis, largest in (("z", 180.0), ("x", _LARGEST_TILT), ("y", _LARGEST_TILT)):
        unit = np.eye(3)["xyz".index(axis)]
        for size in np.arange(_TURN_STEP, largest + 1e-9, _TURN_STEP):
            for angle in (size, -size):
                turns.append(ToolTurn(axis, float(angle)))  # type: ignore[arg-type]
                vectors.append(math.radians(angle) * unit)
    rotation = base_from_tcp.rotation @ rotation_from_vector(np.array(vectors))
    translation = np.broadcast_to(base_from_tcp.translation, (len(rotation), 3))
    works = reachable(robot, Transform(rotation, translation) @ tcp_from_flange)
    possible = [turn for turn, good in zip(turns, works, strict=True) if good]
    return min(possible, key=lambda turn: abs(turn.degrees), default=None)


def reason_with_lengths(robot: Robot, base_from_flange: Transform, reason: Unreachable) -> str:
    """Reason why one pose is unreachable, with the part of the arm that is too short or long."""
    length = robot.kinematics.limiting_length(base_from_flange) if reason.joint is None else None
    return reason.message if length is None else f"{reason.message}: {length}"


def _shifted(poses: Transform, shifts: Array) -> Transform:
    """Poses (m, k): poses (k,) shifted by each of the shifts (m, 3)."""
    translation = poses.translation[None] + shifts[:, None]
    rotation = np.broadcast_to(poses.rotation[None], (len(shifts), *poses.rotation.shape))
    return Transform(rotation, translation)


def _all_reached(robot: Robot, poses: Transform, shifts: Array) -> Mask:
    """Mask (m,) of the shifts (m, 3) after which the arm reaches all poses (k,)."""
    moved = _shifted(poses, shifts)
    count = len(shifts) * len(poses)
    flat = Transform(moved.rotation.reshape(count, 3, 3), moved.translation.reshape(count, 3))
    works: Mask = np.all(reachable(robot, flat).reshape(len(shifts), len(poses)), axis=1)
    return works


def _search(robot: Robot, poses: Transform) -> Array | None:
    """Return the shortest shift (3,) that makes a few poses reachable: rings, then directions."""
    directions = _sphere(_DIRECTIONS)
    inside = 0.0
    for ring in _RINGS:
        works = _all_reached(robot, poses, ring * directions)
        if works.any():
            break
        inside = float(ring)
    else:
        return None
    kept = directions[works]
    length = _shortest(robot, poses, kept, inside, float(ring))
    best = int(length.argmin())
    direction, shortest = kept[best], float(length[best])
    for tilt in _TILTS:
        around = _tilted(direction, float(tilt))
        works = _all_reached(robot, poses, shortest * around)
        if works.any():
            length = _shortest(robot, poses, around[works], 0.0, shortest)
            best = int(length.argmin())
            direction, shortest = around[works][best], float(length[best])
    return _whole_millimetres(robot, poses, direction, shortest)


def _shortest(
    robot: Robot, poses: Transform, directions: Array, inside: float, works: float
) -> Array:
    """Shortest shift (m,) [m] in each direction (m, 3) that works, by bisection."""
    low, high = np.full(len(directions), inside), np.full(len(directions), works)
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        good = _all_reached(robot, poses, middle[:, None] * directions)
        low, high = np.where(good, low, middle), np.where(good, middle, high)
    return high


def _whole_millimetres(
    robot: Robot, poses: Transform, direction: Array, length: float
) -> Array | None:
    """Return a shift of whole millimetres, rounded to 0.1 mm per component, that works."""
    for extra in range(6):
        size = (math.ceil(1e3 * length - 1e-6) + extra) * 1e-3
        shift: Array = np.round(size * direction, 4)
        if _all_reached(robot, poses, shift[None])[0]:
            return shift
    return None


def _sphere(count: int) -> Array:
    """Directions (count + 6, 3) spread evenly, preceded by those of the axes.

    Source:
        Swinbank, Purser (2006), Fibonacci grids: A novel approach to global modelling.
    """
    number = np.arange(count) + 0.5
    polar = np.arccos(1.0 - 2.0 * number / count)
    turn = math.pi * (1.0 + math.sqrt(5.0)) * number
    spread = np.stack(
        [np.cos(turn) * np.sin(polar), np.sin(turn) * np.sin(polar), np.cos(polar)], axis=-1
    )
    return np.concatenate([np.eye(3), -np.eye(3), spread])


def _tilted(direction: Array, angle: float) -> Array:
    """Twelve directions around a direction, all tilted by the same angle [rad]."""
    across = np.cross(direction, np.eye(3)[int(np.abs(direction).argmin())])
    across /= np.linalg.norm(across)
    around = np.linspace(0.0, 2.0 * math.pi, 12, endpoint=False)[:, None]
    side = np.cos(around) * across + np.sin(around) * np.cross(direction, across)
    tilted: Array = math.cos(angle) * direction + math.sin(angle) * side
    return tilted
