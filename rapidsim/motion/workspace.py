"""Workspace of an arm: the volume reached by its flange, and a section through it.

For any attitude: a position counts if the flange reaches it in some posture within the joint
limits. The volume is sampled from postures and stored as cells; positions between two postures may
be missed.

An arm that leans over backwards reaches positions behind axis 1, where it turns through another
range of angles. So cells are sorted by direction as well.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.kinematics.axis_tables import screws_of
from rapidsim.motion.kinematics.closed_form.opw import OrthoParallel
from rapidsim.motion.robot.robot import Robot
from rapidsim.values import value_class

_CELLS = 120
"""Number of cells from the axis to the farthest point; half as many up and down."""
_POSTURES = 400_000
_BATCH = 50_000
_AT_END = 0.1
"""Probability with which a joint is sampled at one of its ends."""
_UPRIGHT = 1e-6
_DIRECTIONS = 180
"""Number of directions around axis 1."""


@value_class(frozen=True, slots=True, eq=False)
class ArmWorkspace:
    """Positions that the flange of an arm reaches."""

    robot: Robot
    cell: float
    """Size of a cell [m]."""
    lowest: float
    """Height [m] of the lowest row of cells in base."""
    reached: npt.NDArray[np.bool_]
    """Shape (rows, columns, directions): mask of the heights, distances from axis 1 and directions
    around it, from x on, that are reached."""
    extent: tuple[float, float, float, float]
    """Minimum and maximum distance from axis 1, minimum and maximum height [m]."""

    @property
    def section(self) -> npt.NDArray[np.bool_]:
        """Shape (rows, columns): mask of what is reached in any direction."""
        found: npt.NDArray[np.bool_] = np.asarray(self.reached.any(axis=2))
        return found

    @property
    def above(self) -> npt.NDArray[np.bool_]:
        """Shape (columns, directions): mask of what is reached at any height."""
        found: npt.NDArray[np.bool_] = np.asarray(self.reached.any(axis=0))
        return found

    @property
    def radii(self) -> Array:
        """Distances (columns,) [m] of cell centres from axis 1."""
        return self.cell * (np.arange(self.reached.shape[1], dtype=np.float64) + 0.5)

    @property
    def heights(self) -> Array:
        """Heights (rows,) [m] of cell centres."""
        rows = np.arange(self.reached.shape[0], dtype=np.float64)
        return self.lowest + self.cell * (rows + 0.5)

    @property
    def swept(self) -> float:
        """Angle [rad] around axis 1 within reach of the arm."""
        return float(2.0 * np.pi * self.above.any(axis=0).mean())

    @property
    def volume(self) -> float:
        """[m3]: the volume of the section swept about axis 1; half of each cell on its edge."""
        padded = np.pad(self.reached, ((1, 1), (1, 1), (0, 0)))
        padded[:, 0] = padded[:, 1]  # Axis 1 is no edge.
        inside = padded[:-2, 1:-1] & padded[2:, 1:-1] & padded[1:-1, :-2] & padded[1:-1, 2:]
        share = self.reached * np.where(inside, 1.0, 0.5)
        angles = 2.0 * np.pi * share.mean(axis=2).sum(axis=0)
        return float(self.cell**2 * np.sum(angles * self.radii))


def wrist_workspace_of(robot: Robot) -> ArmWorkspace | str | None:
    """Return the workspace of the wrist centre; None for arms without a spherical wrist."""
    arm = robot.kinematics
    if robot.maker is None or not isinstance(arm, OrthoParallel):
        return None
    behind = np.array([0.0, 0.0, -arm.geometry.c4])
    return workspace_of(robot, Transform(np.eye(3), behind))


def workspace_of(robot: Robot, flange_from_point: Transform | None = None) -> ArmWorkspace | str:
    """Sample postures evenly over the joints except axis 1, which only rotates the result.

    Args:
        robot: The arm.
        flange_from_point: The point on the flange to consider; by default the flange itself.

    Returns:
        The workspace, or the reason why it cannot be computed.
    """
    screws = screws_of(robot.kinematics)
    if screws is not None and (
        abs(screws.directions[0, 2]) < 1.0 - _UPRIGHT or np.abs(screws.points[0]).max() > _UPRIGHT
    ):
        return "axis 1 is not vertical through the origin of the base"
    point = flange_from_point or Transform.identity()
    lower, upper = robot.lower.copy(), robot.upper.copy()
    endless = ~np.isfinite(lower) | ~np.isfinite(upper)
    lower[endless], upper[endless] = -np.pi, np.pi
    first = 0.0 if lower[0] <= 0.0 <= upper[0] else float(lower[0])
    places = []
    rng = np.random.default_rng(0)
    for _ in range(_POSTURES // _BATCH):
        joints = rng.uniform(lower, upper, (_BATCH, len(lower)))
        # Also sample every joint at its ends, which produce the edges of the workspace.
        at_end = rng.random(joints.shape) < _AT_END
        joints = np.where(at_end, np.where(rng.random(joints.shape) < 0.5, lower, upper), joints)
        joints[:, 0] = first
        places.append(robot.forward(joints).apply(point.translation))
    found = np.concatenate(places)
    radius, height = np.hypot(found[:, 0], found[:, 1]), found[:, 2]
    cell = float(max(radius.max(), 0.5 * np.ptp(height))) / _CELLS
    lowest = float(height.min())
    column = np.floor(radius / cell).astype(np.int64)
    row = np.floor((height - lowest) / cell).astype(np.int64)
    turn = 2.0 * np.pi / _DIRECTIONS
    direction = np.round(np.arctan2(found[:, 1], found[:, 0]) / turn).astype(np.int64) % _DIRECTIONS
    reached = np.zeros((row.max() + 1, column.max() + 1, _DIRECTIONS), dtype=np.bool_)
    reached[row, column, direction] = True
    begin, end = (float(limit[0]) - first for limit in (robot.lower, robot.upper))
    least = float(radius.min())
    return ArmWorkspace(
        robot,
        cell,
        lowest,
        _turned(_closed(reached), begin / turn, end / turn),
        (0.0 if least < cell else least, float(radius.max()), lowest, float(height.max())),
    )


def _turned(reached: npt.NDArray[np.bool_], begin: float, end: float) -> npt.NDArray[np.bool_]:
    """Return cells (..., d) that are reached if axis 1 turns from begin to end [directions]."""
    count = reached.shape[-1]
    if end - begin >= count:
        return np.broadcast_to(reached.any(axis=-1, keepdims=True), reached.shape)
    # A direction is reached from those from which the axis turns to it.
    wide = np.concatenate([reached] * 3, axis=-1).cumsum(axis=-1)
    at = count + np.arange(count)
    until = wide[..., at - int(np.ceil(begin))]
    found: npt.NDArray[np.bool_] = until > wide[..., at - int(np.floor(end)) - 1]
    return found


def _closed(reached: npt.NDArray[np.bool_]) -> npt.NDArray[np.bool_]:
    """Return cells with isolated ones filled if most of their neighbours are set."""
    padded = np.pad(reached.astype(np.int8), ((1, 1), (1, 1), (0, 0)))
    rows, columns, _ = reached.shape
    around = np.zeros_like(reached, dtype=np.int8)
    for down in (-1, 0, 1):
        for right in (-1, 0, 1):
            around += padded[1 + down : 1 + down + rows, 1 + right : 1 + right + columns]
    filled: npt.NDArray[np.bool_] = reached | (around >= 5)
    return filled
