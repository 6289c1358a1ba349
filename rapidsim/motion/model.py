"""The parameters of the motion model: what a controller does that geometry cannot tell.

Source: fits to recorded traces of one virtual controller; the acceleration of other arms is scaled
from their axis speeds. Every summary of a run prints these values.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

BlendShape = Literal["c2", "parabola"]
OrientationZone = Literal["position", "programmed"]
Keeper = Literal["command", "motion"]
Smoothing = Literal["path", "axes"]


@dataclass(frozen=True, slots=True)
class MotionModel:
    """How quickly axes accelerate, how the command is smoothed, how long a stop point lasts."""

    acceleration_time: float = 0.16
    """Axis acceleration is axis speed divided by this [s]."""
    own_accelerations: bool = True
    """Whether axis accelerations that were measured on an arm replace `acceleration_time` on it."""
    acceleration: tuple[float, ...] | None = None
    """Axis accelerations [rad/s2], where they are known; they replace both of the above."""
    max_speed: tuple[float, ...] | None = None
    """Axis speeds [rad/s] that replace the robot's, for arms of which no source gives them."""
    payload_acceleration: float = 1.0
    """Share of the accelerations that is left with the rated payload, less of it in proportion."""
    filter_time: float = 0.080
    """Width [s] of the moving average over the command; 0 switches it off."""
    smoothing: Smoothing = "path"
    """What is averaged. `path`: the place on the path, so the arm stays on it. `axes`: each axis by
    itself, as controllers do it: the arm rounds corners, and what is seen keeps the axis speeds and
    accelerations that the command keeps. The command is the same, and so are all times."""
    fine_dwell: float = 0.105
    """Time [s] from the end of the command at a stop point to the start of the next command."""
    corner: BlendShape = "c2"
    """Shape of corner paths."""
    orientation_zone: OrientationZone = "position"
    """`position`: the orientation turns within the position's zone and does not reduce it, as
    measured. `programmed`: it turns within its own zone, and a large reorientation reduces both, as
    documented."""
    parabola_acceleration: float = 0.7
    """Share of the acceleration that is used inside zones when corners are parabolas."""
    accelerations_kept_by: Keeper = "command"
    """Who keeps the axis accelerations. `command`: the command before smoothing, as measured; the
    smoothed motion exceeds them where it takes the speed of straight stretches into a tight corner,
    which a controller would round. `motion`: the smoothed motion too, by slowing down around such
    corners, at the price of times that no controller was seen to need."""

    @property
    def slows_for_bends(self) -> bool:
        """Whether the command goes slower where the path bends, for the motion to keep limits.

        Only smoothing along the path adds to the accelerations there.
        """
        return self.accelerations_kept_by == "motion" and self.smoothing == "path"
