"""The parameters of the motion model: what a controller does that geometry cannot tell.

Source: fits to recorded traces of one virtual controller; the acceleration of other arms is scaled
from their axis speeds. Every summary of a run prints these values.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

Corner = Literal["c2", "parabola"]
OrientationZone = Literal["position", "programmed"]


@dataclass(frozen=True, slots=True)
class MotionModel:
    """How quickly axes accelerate, how the command is smoothed, how long a stop point lasts."""

    acceleration_time: float = 0.16
    """Axis acceleration is axis speed divided by this [s]."""
    acceleration: tuple[float, ...] | None = None
    """Axis accelerations [rad/s2], where they are known; they replace `acceleration_time`."""
    max_speed: tuple[float, ...] | None = None
    """Axis speeds [rad/s] that replace the robot's, for arms of which no source gives them."""
    filter_time: float = 0.080
    """Width [s] of the moving average over the path parameter; 0 switches it off."""
    fine_dwell: float = 0.105
    """Time [s] from the end of the command at a stop point to the start of the next command."""
    corner: Corner = "c2"
    """Shape of corner paths."""
    orientation_zone: OrientationZone = "position"
    """`position`: the orientation turns within the position's zone and does not reduce it, as
    measured. `programmed`: it turns within its own zone, and a large reorientation reduces both, as
    documented."""
    parabola_acceleration: float = 0.7
    """Share of the acceleration that is used inside zones when corners are parabolas."""
