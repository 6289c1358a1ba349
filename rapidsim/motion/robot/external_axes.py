"""External axes: tracks that carry the robot, positioners that carry a work object, and others.

Their values are in `eax_a` to `eax_f` of targets, in mm or degrees; here in m and rad.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import field
from typing import Literal

import numpy as np

from rapidsim.frames.moving_frames import Screw
from rapidsim.frames.transform import Array, Transform
from rapidsim.values import value_class

Carried = Literal["robot", "wobj"]
LETTERS = "abcdef"
ROUNDED_AWAY = 0.05
"""Excess [deg or mm] over a limit that programs may contain: the controller displays 0.0."""
ROUNDED_POSE = 0.1
"""Excess [deg] of a revolute joint over its limit on the path to a pose, which is stored in
hundredths of a millimetre."""


@value_class(frozen=True, slots=True, eq=False)
class ExternalAxis:
    """One axis of a mechanical unit other than the robot."""

    unit: str
    """Name of its mechanical unit, as in ActUnit and `ufmec`."""
    letter: str
    """Component of `extjoint` that holds its value: `a` to `f`."""
    linear: bool
    """Whether values are m, else rad."""
    lower: float
    upper: float
    max_speed: float
    """[m/s or rad/s]"""
    max_acceleration: float
    """[m/s2 or rad/s2]"""
    start: float = 0.0
    """Position before the first move [m or rad]."""
    carries: Carried | None = None
    """Object that it moves; None if it moves nothing that targets refer to."""
    direction: tuple[float, float, float] = (0.0, 0.0, 1.0)
    """Direction of a linear axis or of the axis of rotation, in the world with all axes at zero;
    any length."""
    world_from_user: Transform = field(default_factory=Transform.identity)
    """User frame that a positioner carries, with all axes at zero; a rotating axis passes through
    its origin."""

    @property
    def component(self) -> str:
        """Name of its component of `extjoint`."""
        return f"eax_{self.letter}"

    @property
    def scale(self) -> float:
        """Number of RAPID's mm or degrees per m or rad."""
        return 1e3 if self.linear else math.degrees(1.0)

    @property
    def measure(self) -> str:
        """RAPID's unit for its values."""
        return "mm" if self.linear else "deg"


@value_class(frozen=True, slots=True, eq=False)
class Axes:
    """Names and ranges of all axes of a robot and its external axes, shape (n + e,)."""

    lower: Array
    """[rad], [m] for linear external axes."""
    upper: Array
    external: tuple[ExternalAxis, ...] = ()
    slides: tuple[bool, ...] = ()
    """Mask of the arm's joints that slide, from the base; the others turn. RAPID's unit for these
    is mm, and a mm counts as a degree: see `Kinematics`."""

    @property
    def joint_count(self) -> int:
        """Number of axes of the arm."""
        return len(self.lower) - len(self.external)

    @property
    def tolerances(self) -> Array:
        """Tolerance of each axis limit (n + e,) [rad or m]."""
        external = [ROUNDED_AWAY / axis.scale for axis in self.external]
        return np.array([math.radians(ROUNDED_AWAY)] * self.joint_count + external)

    @property
    def path_tolerances(self) -> Array:
        """Tolerance of each axis limit (n + e,) [rad or m] on paths to poses."""
        tolerances = self.tolerances
        for index in range(self.joint_count):
            if self.measure(index) == "deg":
                tolerances[index] = math.radians(ROUNDED_POSE)
        return tolerances

    def name(self, index: int) -> str:
        """Return a name such as `axis 3` or `axis eax_a of TRACK`."""
        if index < self.joint_count:
            return f"axis {index + 1}"
        axis = self.external[index - self.joint_count]
        return f"axis {axis.component} of {axis.unit}"

    def text(self, index: int, value: float) -> str:
        """Format a value of an axis with its unit, such as `12.5 deg`."""
        if index < self.joint_count:
            return f"{amount_text(math.degrees(value))} {self.measure(index)}"
        axis = self.external[index - self.joint_count]
        return f"{amount_text(value * axis.scale)} {axis.measure}"

    def measure(self, index: int) -> str:
        """Return RAPID's unit for the values of an axis."""
        if index >= self.joint_count:
            return self.external[index - self.joint_count].measure
        return "mm" if index < len(self.slides) and self.slides[index] else "deg"


def with_unit(number: str, measure: str) -> str:
    """Format a number for tables and pictures, such as `12.5°` or `12.5 mm`."""
    return f"{number}°" if measure == "deg" else f"{number} {measure}"


def amount_text(value: float) -> str:
    """Format degrees or millimetres with one decimal; with more if that would be 0."""
    return f"{value:.1f}" if value == 0.0 or abs(value) >= ROUNDED_AWAY else f"{value:.1g}"


def screws_of(
    axes: Sequence[ExternalAxis], wanted: Sequence[int], base_from_world: tuple[Array, Array]
) -> tuple[Screw, ...]:
    """Return the screws of some axes in base, the outermost first.

    Args:
        axes: All external axes.
        wanted: Indices in `axes`.
        base_from_world: Rotation (3, 3) and translation (3,) [m] with all axes at zero.
    """
    rotation, translation = base_from_world
    screws = []
    for index in wanted:
        axis = axes[index]
        direction = np.array(axis.direction) / np.linalg.norm(axis.direction)
        origin = rotation @ axis.world_from_user.translation + translation
        through = None if axis.linear else origin
        screws.append(Screw(index, rotation @ direction, through))
    return tuple(screws)
