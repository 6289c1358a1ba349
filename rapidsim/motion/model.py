"""Parameters of the motion model: behaviour of a controller that geometry does not determine.

Source: fits to logs of one virtual controller and of one real arm; for arms without measurements,
values are scaled from the measured ones (`robot/motion_constants.py`). Every run summary prints
these values.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType
from typing import Literal

from rapidsim.values import value_class

BlendShape = Literal["abb", "c2", "parabola"]
OrientationZone = Literal["own", "position", "programmed"]
Keeper = Literal["command", "motion"]
Smoothing = Literal["path", "axes"]
Averages = Literal[1, 2]
Version = Literal["1", "2", "3"]
Controller = Literal["virtual", "real"]

INTERPOLATION_CYCLE_S = 0.004032
"""Interval [s] at which an IRC5 sends new positions to its axes."""
_BRIEF_S = 4.0 * INTERPOLATION_CYCLE_S
"""Braking time [s] below which stops of the large measured arm take less time."""
_QUICKER = 3.4
"""Power of the smoothing's width with which that time falls on smaller arms: these brake sooner,
and would miss stops by more than the large arm does."""
_SHORTER = 0.59
"""Share by which a stop is shorter at nearly zero speed: 57 ms at v50, 102 ms from v300 on.

Measured values are 32 to 86 ms at v50, by an unknown rule; this is their mean."""
ACCELERATION_TIME_S = 0.16
"""Time [s] in which an axis reaches its speed, for arms of which nothing better is known."""
REAL_STOP_S = 0.018
"""Extra time [s] of a real arm at a stop point against a virtual controller: 16 to 20 ms."""


@value_class(frozen=True, slots=True)
class MotionModel:
    """Axis accelerations, smoothing of the command, and duration of stop points."""

    version: Version = "3"
    """Version of the laws: `1` are the laws of version 0.1 of this program, `2` those of the large
    measured arm with less scaling by size."""
    controller: Controller = "virtual"
    """Kind of controller, for stop points: a real arm takes slightly longer."""
    acceleration_time: float = ACCELERATION_TIME_S
    """Axis acceleration is axis speed divided by this [s], if no better value is known."""
    own_accelerations: bool = True
    """Whether known torques or accelerations of an arm replace `acceleration_time`."""
    acceleration: tuple[float, ...] | None = None
    """Known axis accelerations [rad/s2], which replace both of the above; None if unknown."""
    torque: tuple[float, float, float] = (1.0, 1.0, 1.0)
    """Factors on the assumed torques of axes 1 to 3 of the arm."""
    wrist: float = 1.0
    """Factor on the accelerations of its wrist axes."""
    max_speed: tuple[float, ...] | None = None
    """Axis speeds [rad/s] that replace the robot's, for arms without published values."""
    payload_acceleration: float | None = None
    """Share of the accelerations that remains with the rated payload, interpolated for lower loads.
    None: the load counts in the inertia of the arm, if that is known, and else not at all."""
    filter_time: float | None = None
    """Width [s] of the smoothing of the command; 0 switches it off, None is the arm's value."""
    filter_averages: Averages = 2
    """Number of successive moving averages, together as wide as `filter_time`. Two are close to the
    measured bell shape; one has an equal standard deviation if it is narrower by a factor of
    1.41."""
    smoothing: Smoothing = "axes"
    """Smoothed quantity. `axes`: each axis separately, as in controllers: the arm rounds corners,
    and the motion keeps the axis speeds and accelerations that the command keeps. `path`: the
    position on the path, so the arm stays on it, and carries the speed of straight sections into
    tight corners."""
    fine_dwell: float | None = None
    """Time [s] from the end of the command at a stop point to the start of the next command on a
    virtual controller; None is the arm's value."""
    corner: BlendShape = "abb"
    """Shape of corner paths."""
    orientation_zone: OrientationZone = "own"
    """`own`: the orientation turns within its own zone, and neither reduces the other, as measured.
    `position` (version 1): within the position's zone. `programmed` (version 1): within its own
    zone, and a large reorientation reduces both, as documented."""
    parabola_acceleration: float = 0.7
    """Share of the acceleration that is used inside zones when corners are parabolas."""
    accelerations_kept_by: Keeper = "command"
    """Signal that keeps the axis accelerations with `smoothing = "path"`. `command`: the command
    before smoothing, as measured. `motion`: the smoothed motion too, by slowing down around tight
    corners, at the cost of times that no controller was seen to need."""
    cycle: float = INTERPOLATION_CYCLE_S
    """Minimum time [s] of the command in a zone."""
    zone_share: float | None = None
    """Share of torques and accelerations that is used in a narrow zone; in wide ones it is more.
    None is the arm's value."""
    zone_cycles: float = 0.45
    """Number of cycles whose travel, at the speed in a zone, widens the zone for `zone_share`."""

    @property
    def window(self) -> float:
        """Width [s] of the command's smoothing window."""
        return FILTER_S if self.filter_time is None else self.filter_time

    @property
    def share_in_zones(self) -> float:
        """Share of torques and accelerations that is used in a narrow zone."""
        return ZONE_SHARE if self.zone_share is None else self.zone_share

    @property
    def dwell(self) -> float:
        """Time [s] at a stop point between the end of a command and the start of the next."""
        dwell = DWELL_S if self.fine_dwell is None else self.fine_dwell
        return dwell + (REAL_STOP_S if self.controller == "real" else 0.0)

    def dwell_after(self, braking_s: float) -> float:
        """Time [s] at a stop point after a command that braked for `braking_s` [s].

        The arm comes to rest in that time, except in slow moves, which then have almost no
        remaining motion: logs of a controller do not show the arm at rest there either. What is
        slow depends on how quick the arm is. Smoothed along the path the arm would carry speed into
        the next move, so there it always comes to rest.
        """
        if self.version == "1":
            return self.dwell
        brief_s = _BRIEF_S * min(1.0, self.window / FILTER_S) ** _QUICKER
        missing = max(0.0, 1.0 - braking_s / brief_s) if brief_s else 0.0
        dwell = max(self.dwell, self.window) * (1.0 - _SHORTER * missing)
        return max(dwell, self.window) if self.smoothing == "path" else dwell

    @property
    def slows_for_bends(self) -> bool:
        """Whether the command slows down where the path bends, so that the motion keeps limits.

        Only smoothing along the path adds to the accelerations there.
        """
        return self.accelerations_kept_by == "motion" and self.smoothing == "path"

    def of_arm(self, filter_time: float, fine_dwell: float, zone_share: float) -> MotionModel:
        """Return the model with the times [s] and the share of an arm where the model has none."""
        return replace(
            self,
            filter_time=filter_time if self.filter_time is None else self.filter_time,
            fine_dwell=fine_dwell if self.fine_dwell is None else self.fine_dwell,
            zone_share=zone_share if self.zone_share is None else self.zone_share,
        )


FILTER_S, DWELL_S, ZONE_SHARE = 0.094, 0.102, 0.64
"""Values of the large measured arm, for arms of unknown size."""
MODELS: Mapping[Version, MotionModel] = MappingProxyType(
    {
        "1": MotionModel(
            version="1",
            payload_acceleration=1.0,
            filter_time=0.080,
            filter_averages=1,
            smoothing="path",
            fine_dwell=0.105,
            corner="c2",
            orientation_zone="position",
            cycle=0.0,
            zone_share=1.0,
        ),
        "2": MotionModel(version="2"),
        "3": MotionModel(),
    }
)
"""Default model of each version, before overrides of a station file."""
