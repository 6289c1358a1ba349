"""The parameters of the motion model: what a controller does that geometry cannot tell.

Source: fits to logs of one virtual controller and of one real arm; for arms that were not measured,
values are scaled from those that were (`robot/dynamics.py`). Every run summary prints these values.
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
Version = Literal["1", "2"]
Controller = Literal["virtual", "real"]

INTERPOLATION_CYCLE_S = 0.004032
"""How often an IRC5 gives its axes new positions."""
_BRIEF_S = 4.0 * INTERPOLATION_CYCLE_S
"""Stops that brake for less than this cost less time."""
_SHORTER = 0.59
"""Share by which a stop is shorter at next to no speed: 57 ms at v50 where it is 102 from v300 on.

Seen to last 32 to 86 ms there, by a rule that is not known; this is their mean."""
REAL_STOP_S = 0.018
"""How much longer a real arm takes at a stop point than a virtual controller: 16 to 20 ms."""


@value_class(frozen=True, slots=True)
class MotionModel:
    """How quickly axes accelerate, how the command is smoothed, how long a stop point lasts."""

    version: Version = "2"
    """Which laws hold: `1` are those of version 0.1 of this program."""
    controller: Controller = "virtual"
    """What a stop point costs: a real arm takes a little longer."""
    acceleration_time: float = 0.16
    """Axis acceleration is axis speed divided by this [s], where nothing better is known."""
    own_accelerations: bool = True
    """Whether what is known of an arm, torques or accelerations, replaces `acceleration_time`."""
    acceleration: tuple[float, ...] | None = None
    """Axis accelerations [rad/s2], where they are known; they replace both of the above."""
    torque: tuple[float, float, float] = (1.0, 1.0, 1.0)
    """Factors on the torques of axes 1 to 3 that the arm is taken to have."""
    wrist: float = 1.0
    """A factor on the accelerations of its wrist axes."""
    max_speed: tuple[float, ...] | None = None
    """Axis speeds [rad/s] that replace the robot's, for arms of which no source gives them."""
    payload_acceleration: float | None = None
    """Share of the accelerations that is left with the rated payload, less of it in proportion.
    None: the load counts in the inertia of the arm, where that is known, and else not at all."""
    filter_time: float | None = None
    """Width [s] of the smoothing of the command; 0 switches it off, None is the arm's."""
    filter_averages: Averages = 2
    """How many moving averages follow one another, together as wide as that. Two come near the bell
    that was measured; one has the same standard deviation if it is narrower by a factor of 1.41."""
    smoothing: Smoothing = "axes"
    """What is averaged. `axes`: each axis by itself, as controllers do it: the arm rounds corners,
    and what is seen keeps the axis speeds and accelerations that the command keeps. `path`: the
    place on the path, so the arm stays on it, and takes the speed of straight stretches into tight
    corners."""
    fine_dwell: float | None = None
    """Time [s] from the end of the command at a stop point to the start of the next command on a
    virtual controller; None is the arm's."""
    corner: BlendShape = "abb"
    """Shape of corner paths."""
    orientation_zone: OrientationZone = "own"
    """`own`: the orientation turns within its own zone, and neither reduces the other, as measured.
    `position` (version 1): within the position's zone. `programmed` (version 1): within its own,
    and a large reorientation reduces both, as documented."""
    parabola_acceleration: float = 0.7
    """Share of the acceleration that is used inside zones when corners are parabolas."""
    accelerations_kept_by: Keeper = "command"
    """Who keeps the axis accelerations with `smoothing = "path"`. `command`: the command before
    smoothing, as measured. `motion`: the smoothed motion too, by slowing down around tight corners,
    at the price of times that no controller was seen to need."""
    cycle: float = INTERPOLATION_CYCLE_S
    """The command takes at least so long [s] through a zone."""
    zone_share: float = 0.64
    """Share of torques and accelerations that is used in a narrow zone; in wide ones it is more."""
    zone_cycles: float = 0.45
    """In that a zone counts as wider by so many times the way in a cycle at the speed there."""

    @property
    def window(self) -> float:
        """Width [s] of the command's smoothing window."""
        return _FILTER_S if self.filter_time is None else self.filter_time

    @property
    def dwell(self) -> float:
        """Time [s] at a stop point between the end of a command and the start of the next."""
        dwell = _DWELL_S if self.fine_dwell is None else self.fine_dwell
        return dwell + (REAL_STOP_S if self.controller == "real" else 0.0)

    def dwell_after(self, braking_s: float) -> float:
        """The same after a command that braked for the given time [s].

        The arm comes to rest in that time, except in slow moves, where almost nothing remains to be
        done then: logs of a controller do not show the arm at rest there either. Smoothed along the
        path the arm would carry speed into the next move, so there it always comes to rest.
        """
        if self.version == "1":
            return self.dwell
        missing = max(0.0, 1.0 - braking_s / _BRIEF_S)
        dwell = max(self.dwell, self.window) * (1.0 - _SHORTER * missing)
        return max(dwell, self.window) if self.smoothing == "path" else dwell

    @property
    def slows_for_bends(self) -> bool:
        """Whether the command slows down where the path bends, so that the motion keeps limits.

        Only smoothing along the path adds to the accelerations there.
        """
        return self.accelerations_kept_by == "motion" and self.smoothing == "path"

    def of_arm(self, filter_time: float, fine_dwell: float) -> MotionModel:
        """With the times [s] known for an arm where the model sets none."""
        return replace(
            self,
            filter_time=filter_time if self.filter_time is None else self.filter_time,
            fine_dwell=fine_dwell if self.fine_dwell is None else self.fine_dwell,
        )


_FILTER_S, _DWELL_S = 0.094, 0.102
"""Of the arm that was measured, for arms of which nothing is known."""
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
        "2": MotionModel(),
    }
)
"""What holds in each version where a station file says nothing else."""
