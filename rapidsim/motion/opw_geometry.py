"""The seven lengths and the zero positions of an ortho-parallel arm with a spherical wrist.

The angles theta of the formulas are zero with the arm straight up. The joint values differ from
them by a sign, an offset and, for arms that move axis 3 through a rod, by the angle of axis 2.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot

JOINT_COUNT = 6
ROUNDING = 1e-12
"""Angles [rad] and shares of the arm's length up to this are zero spoiled by rounding."""


@dataclass(frozen=True, slots=True)
class OpwGeometry:
    """The lengths [m] and the zero positions of an ortho-parallel arm."""

    a1: float
    """Axis 1 to axis 2, forward."""
    a2: float
    """Axis 3 to axis 4; negative where the forearm lies above the elbow with the arm forward."""
    b: float
    """Sideways offset of the wrist centre from axis 1."""
    c1: float
    """Base to axis 2, upward."""
    c2: float
    """Axis 2 to axis 3."""
    c3: float
    """Elbow to wrist centre, along axis 4."""
    c4: float
    """Wrist centre to flange, along axis 6."""
    offsets: tuple[float, ...] = (0.0,) * JOINT_COUNT
    """theta = sign * joint - offset [rad]."""
    signs: tuple[int, ...] = (1,) * JOINT_COUNT
    coupling: int = 0
    """Axis 3 turns by joint 3 plus this times joint 2: -1 for arms with a parallel rod, else 0."""

    @property
    def reach(self) -> float:
        """Longest distance [m] of the wrist centre from axis 2; the scale of every tolerance."""
        return self.c2 + hypot(self.a2, self.c3)
