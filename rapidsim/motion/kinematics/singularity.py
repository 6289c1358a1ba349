"""A singularity, an arm's distance from it, and its detection without closed formulas."""

from __future__ import annotations

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.values import value_class

NEAR = 0.05
"""Distance below which a singularity is near: 2.9 deg of an axis, 5 % of the reach."""
WEAK = 0.02
"""Smallest singular value below which a singularity is near, for arms without formulas."""
TAKES_PART = 0.2
"""Share of a joint in the null motion from which it takes part in it."""


@value_class(frozen=True, slots=True)
class Singularity:
    """A singularity and the arm's distance from it."""

    name: str
    """`wrist`, `elbow` or `shoulder`."""
    distance: float
    """Sine of an angle that vanishes on it, or distance to it as a share of the reach."""
    reason: str
    """Geometric cause, in words."""

    @property
    def near(self) -> bool:
        """Whether joint speeds become much larger than in ordinary poses."""
        return self.distance < NEAR


def by_idle_motion(jacobian: Array) -> tuple[Singularity, ...]:
    """Return the singularity of a weak Jacobian (6, n), named by the joints whose motions cancel.

    Arms with more than six joints always have such motions; only additional ones count.
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
