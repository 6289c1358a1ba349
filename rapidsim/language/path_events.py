"""Actions at places of the path: the values of `triggdata`; and shapes of world zones.

Everything is in RAPID's units.
"""

from __future__ import annotations

from collections.abc import Callable

from rapidsim.language.data import JointTarget, Pos
from rapidsim.language.reference import Reference
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class SetOutput:
    """Sets an output to a value, at once or after a delay."""

    signal: str
    value: float
    delay_s: float = 0.0


@value_class(frozen=True, slots=True)
class RaiseInterrupt:
    """Raises an interrupt."""

    interrupt: float


@value_class(frozen=True, slots=True)
class CheckSignal:
    """Checks a signal, and raises an interrupt if it is not as required."""

    signal: str
    wanted: Callable[[float], bool]
    interrupt: float
    stops: bool
    """Whether the robot is stopped first."""


@value_class(frozen=True, slots=True)
class RampOutput:
    """Ramps an analog output linearly to a value."""

    signal: str
    value: float
    length: float
    """Length of the ramp [mm], or [s] if `by_time`."""
    by_time: bool


@value_class(frozen=True, slots=True)
class FollowSpeed:
    """Makes an analog output follow the speed of the TCP [mm/s] times a factor; 0 ends it."""

    signal: str
    per_mm_s: float
    lag_s: float
    """Time [s] by which the output leads the speed."""


@value_class(frozen=True, slots=True)
class CallProcedure:
    """Runs a procedure like a trap."""

    name: str


@value_class(frozen=True, slots=True)
class Trigger:
    """An action at a place on a move."""

    action: SetOutput | RaiseInterrupt | CheckSignal | RampOutput | FollowSpeed | CallProcedure
    distance: float = 0.0
    """[mm] before the end of the move, or after its start; [s] before the end if `by_time`."""
    from_start: bool = False
    by_time: bool = False
    lag_s: float = 0.0
    """Time [s] before the robot's arrival: the delay of the equipment."""
    inhibited: Reference[bool] | None = None
    """While TRUE the trigger has no effect, or writes `inhibited_value`."""
    inhibited_value: Reference[object] | None = None


@value_class(frozen=True, slots=True)
class Cuboid:
    """A box between two corners, along the axes of the world [mm]."""

    low: Pos
    high: Pos


@value_class(frozen=True, slots=True)
class Cylinder:
    """A cylinder along the z axis of the world [mm]; below its centre if the height is negative."""

    centre: Pos
    radius: float
    height: float


@value_class(frozen=True, slots=True)
class Sphere:
    """A sphere [mm]."""

    centre: Pos
    radius: float


@value_class(frozen=True, slots=True)
class AxisRange:
    """Positions of the axes between two joint targets [deg]."""

    low: JointTarget
    high: JointTarget


@value_class(frozen=True, slots=True)
class ZoneShape:
    """The value of `shapedata`: a volume, or all space outside it."""

    volume: Cuboid | Cylinder | Sphere | AxisRange
    outside: bool = False
