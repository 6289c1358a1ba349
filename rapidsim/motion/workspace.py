"""Workspace of an arm: the volume reached by its flange, and a section through it.

For any attitude: a position counts if the flange reaches it in some posture within the joint
limits. The volume is sampled from postures and stored as cells; positions between two postures may
be missed, so the volume is underestimated rather than overestimated.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.kinematics.axis_tables import screws_of
from rapidsim.motion.robot.robot import Robot
from rapidsim.values import value_class

_CELLS = 120
"""Number of cells from the axis to the farthest point; half as many up and down."""
_POSTURES = 400_000
_BATCH = 50_000
_AT_END = 0.1
"""Probability with which a joint is sampled at one of its ends."""
_UPRIGHT = 1e-6


@value_class(frozen=True, slots=True, eq=False)
class ArmWorkspace:
    """Positions that the flange of an arm reaches."""

    robot: Robot
    cell: float
    """Size of a cell [m]."""
    lowest: float
    """Height [m] of the lowest row of cells in base."""
    section: npt.NDArray[np.bool_]
    """Shape (rows, columns): mask of the heights and distances from axis 1 that are reached."""
    turn: tuple[float, float]
    """Range of axis 1 [rad]."""

    @property
    def radii(self) -> Array:
        """Distances (columns,) [m] of cell centres from axis 1."""
        return self.cell * (np.arange(self.section.shape[1], dtype=np.float64) + 0.5)

    @property
    def heights(self) -> Array:
        """Heights (rows,) [m] of cell centres."""
        rows = np.arange(self.section.shape[0], dtype=np.float64)
        return self.lowest + self.cell * (rows + 0.5)

    @property
    def swept(self) -> float:
        """Angle [rad] around axis 1 within reach of the arm, at most a whole turn."""
        return min(self.turn[1] - self.turn[0], 2.0 * np.pi)

    @property
    def volume(self) -> float:
        """[m3]: the volume of the section swept about axis 1."""
        area = self.section.sum(axis=0) * self.cell**2
        return float(self.swept * np.sum(area * self.radii))

    @property
    def extent(self) -> tuple[float, float, float, float]:
        """Minimum and maximum distance from axis 1, minimum and maximum height [m]."""
        rows, columns = np.nonzero(self.section)
        half = 0.5 * self.cell
        return (
            float(self.radii[columns.min()] - half),
            float(self.radii[columns.max()] + half),
            float(self.heights[rows.min()] - half),
            float(self.heights[rows.max()] + half),
        )


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
    places = []
    rng = np.random.default_rng(0)
    for _ in range(_POSTURES // _BATCH):
        joints = rng.uniform(lower, upper, (_BATCH, len(lower)))
        # Also sample every joint at its ends, which produce the edges of the workspace.
        at_end = rng.random(joints.shape) < _AT_END
        joints = np.where(at_end, np.where(rng.random(joints.shape) < 0.5, lower, upper), joints)
        joints[:, 0] = 0.0 if lower[0] <= 0.0 <= upper[0] else lower[0]
        place = robot.forward(joints).apply(point.translation)
        places.append(np.stack([np.hypot(place[:, 0], place[:, 1]), place[:, 2]], axis=1))
    found = np.concatenate(places)
    cell = float(max(found[:, 0].max(), 0.5 * np.ptp(found[:, 1]))) / _CELLS
    lowest = float(found[:, 1].min())
    column = np.floor(found[:, 0] / cell).astype(np.int64)
    row = np.floor((found[:, 1] - lowest) / cell).astype(np.int64)
    section = np.zeros((row.max() + 1, column.max() + 1), dtype=np.bool_)
    section[row, column] = True
    return ArmWorkspace(
        robot, cell, lowest, _closed(section), (float(robot.lower[0]), float(robot.upper[0]))
    )


def _closed(section: npt.NDArray[np.bool_]) -> npt.NDArray[np.bool_]:
    """Return the section with isolated cells filled if most of their neighbours are set."""
    padded = np.pad(section.astype(np.int64), 1)
    rows, columns = section.shape
    around = sum(
        padded[1 + down : 1 + down + rows, 1 + right : 1 + right + columns]
        for down in (-1, 0, 1)
        for right in (-1, 0, 1)
    )
    filled: npt.NDArray[np.bool_] = section | (np.asarray(around) >= 5)
    return filled
