"""What happens at places of the path: the values of `triggdata`, and what world zones are.

Everything is in RAPID's units.
"""

from __future__ import annotations

from collections.abc import Callable

from rapidsim.language.data import JointTarget, Pos
from rapidsim.language.reference import Reference
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class SetOutput:
    """An output takes a value, at once or after a delay."""

    signal: str
    value: float
    delay_s: float = 0.0


@value_class(frozen=True, slots=True)
class RaiseInterrupt:
    """An interrupt is raised."""

    interrupt: float


@value_class(frozen=True, slots=True)
class CheckSignal:
    """A signal is checked; an interrupt is raised if it is not as required."""

    signal: str
    wanted: Callable[[float], bool]
    interrupt: float
    stops: bool
    """The robot is stopped first."""


@value_class(frozen=True, slots=True)
class RampOutput:
    """An analog output ramps linearly to a value."""

    signal: str
    value: float
    length: float
    """Of the ramp [mm], or [s] if `by_time`."""
    by_time: bool


@value_class(frozen=True, slots=True)
class FollowSpeed:
    """From here on an analog output is the speed of the TCP [mm/s] times a factor; 0 ends it."""

    signal: str
    per_mm_s: float
    lag_s: float
    """How far [s] the output leads the speed."""


@value_class(frozen=True, slots=True)
class CallProcedure:
    """A procedure runs as a trap would."""

    name: str


@value_class(frozen=True, slots=True)
class Trigger:
    """Where on a move something happens, and what."""

    action: SetOutput | RaiseInterrupt | CheckSignal | RampOutput | FollowSpeed | CallProcedure
    distance: float = 0.0
    """[mm] before the end of the move, or after its start; [s] before the end if `by_time`."""
    from_start: bool = False
    by_time: bool = False
    lag_s: float = 0.0
    """How long [s] before the robot gets there: what the equipment takes to follow."""
    inhibited: Reference[bool] | None = None
    """While TRUE the trigger does nothing, or writes `inhibited_value`."""
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
    """The value of `shapedata`: a volume, meant inside or outside."""

    volume: Cuboid | Cylinder | Sphere | AxisRange
    outside: bool = False
