"""Seven lengths and zero positions of an ortho-parallel arm with a spherical wrist.

The angles theta of the formulas are zero with the arm straight up. The joint values differ from
them by a sign, an offset and, for arms that move axis 3 through a rod, by the angle of axis 2.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import atan2, hypot, sqrt

from rapidsim.frames.vectors import Number

JOINT_COUNT = 6
ROUNDING = 1e-12
"""Angles [rad] and shares of the arm's length up to this are zero with rounding errors."""


@dataclass(frozen=True)
class OpwGeometry:
    """Lengths [m] and zero positions of an ortho-parallel arm."""

    a1: float
    """Axis 1 to axis 2, forward."""
    a2: float
    """Axis 3 to axis 4; negative if the forearm lies above the elbow with the arm forward."""
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

    @cached_property
    def reach(self) -> float:
        """Maximum distance [m] of the wrist centre from axis 2; the scale of every tolerance."""
        return self.c2 + self.fore

    @cached_property
    def fore(self) -> float:
        """Straight-line distance [m] from the elbow, axis 3, to the wrist centre."""
        return hypot(self.a2, self.c3)

    @cached_property
    def fore_lean(self) -> float:
        """Angle [rad] by which that line leans forward of axis 4."""
        return atan2(self.a2, self.c3)

    def wrist_forward(self, s2: Number, c23: Number, s23: Number) -> Number:
        """Distance [m] of the wrist centre in front of axis 1.

        Args:
            s2: Sine of theta 2.
            c23: Cosine of theta 2 + theta 3.
            s23: Sine of theta 2 + theta 3.
        """
        return self.a1 + self.c2 * s2 + self.a2 * c23 + self.c3 * s23

    def wrist_up(self, c2: Number, c23: Number, s23: Number) -> Number:
        """Height [m] of the wrist centre above the base; see `wrist_forward`."""
        return self.c1 + self.c2 * c2 - self.a2 * s23 + self.c3 * c23

    def limiting_length(self, x: float, y: float, z: float) -> str | None:
        """Describe the length that keeps the wrist centre from a point [m]; None if none does."""
        radius = hypot(x, y)
        if radius < abs(self.b):
            nearest = 1e3 * abs(self.b)
            return f"it comes no nearer to axis 1 than {nearest:.0f} mm, not {1e3 * radius:.1f}"
        distance = 1e3 * hypot(sqrt(radius**2 - self.b**2) - self.a1, z - self.c1)
        stretched, folded = 1e3 * self.reach, 1e3 * abs(self.c2 - self.fore)
        if distance > stretched:
            return (
                f"the stretched arm puts it {stretched:.1f} mm from axis 2, "
                f"the target asks for {distance:.1f} mm"
            )
        if distance < folded:
            return (
                f"the folded arm puts it no nearer to axis 2 than {folded:.1f} mm, "
                f"the target asks for {distance:.1f} mm"
            )
        return None
