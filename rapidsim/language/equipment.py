"""Equipment of a program: mechanical units, the configuration, I/O devices."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from enum import Enum
from typing import Protocol, TypeAlias

from rapidsim.values import value_class


def robot_name(number: int) -> str:
    """Name of a robot, counted from 1, as on a controller."""
    return f"ROB_{number}"


class Attributes(Mapping[str, str]):
    """Attributes of an instance of system parameters: as written, compared without case."""

    __slots__ = ("_by_key", "_names")

    def __init__(self, written: Mapping[str, str]) -> None:
        """Store attributes in their order; of names that differ only in case, the last counts."""
        self._names = {name.lower(): name for name in written}
        self._by_key = {name.lower(): value for name, value in written.items()}

    def __getitem__(self, name: str) -> str:
        return self._by_key[name.lower()]

    def __iter__(self) -> Iterator[str]:
        return iter(self._names.values())

    def __len__(self) -> int:
        return len(self._names)

    def with_value(self, name: str, value: str) -> Attributes:
        """Copy with another value of an attribute, or with a further attribute."""
        return Attributes({**self, self._names.get(name.lower(), name): value})


Configured: TypeAlias = Mapping[str, Mapping[str, Sequence[Mapping[str, str]]]]
"""System parameters: by domain and type in upper case, the instances of each. An attribute that is
a switch is "true"."""


@value_class(frozen=True, slots=True)
class MechanicalUnitFacts:
    """Facts about a mechanical unit that a program can read."""

    name: str
    is_robot: bool
    axes: tuple[int, ...]
    """Positions, from 0, in `robax` of a robot, in `extax` of another unit."""
    task_number: int = 0
    """Position, from 1, of the task that moves it; 0 if none does."""
    robot_number: int = 0
    """Position, from 1, of the robot with which it moves; 0 if it moves with none."""
    is_active: bool = True
    """Whether the unit is active; DeactUnit deactivates it."""


class AxisQuantity(Enum):
    """Quantity of an axis that a test signal samples."""

    POSITION = "position"
    """[deg or mm]"""
    SPEED = "speed"
    """[deg/s or mm/s]"""


class AxisSignals(Protocol):
    """The test signals of the system, by the numbers of their channels."""

    def sample_axis(
        self,
        channel: int,
        unit: MechanicalUnitFacts,
        at: int,
        quantity: AxisQuantity,
        sample_s: float,
    ) -> None:
        """Sample a quantity of an axis from now on.

        Args:
            channel: Replaces the signal that the channel had.
            unit: The mechanical unit of the axis.
            at: Position of the axis in `unit.axes`.
            quantity: The quantity to sample.
            sample_s: Interval [s] of the samples.
        """
        ...

    def stop_sampling(self, channel: int) -> None:
        """Stop sampling for a channel."""
        ...

    def last_sample(self, channel: int) -> float | None:
        """Value of a channel as sampled last; None for a channel without a signal."""
        ...

    def stop_all_sampling(self) -> None:
        """Stop sampling for all channels."""
        ...


class SmartGripper(Protocol):
    """The servo gripper of the task's robot: fingers from 0 (closed) to 25 mm (open)."""

    @property
    def object_mm(self) -> float | None:
        """Position [mm] at which closing fingers meet an object; None if it is unknown."""
        ...

    @property
    def limit_mm(self) -> float:
        """Position [mm] to which the fingers open at most."""
        ...

    def adjust(
        self,
        *,
        speed_mm_s: float | None = None,
        force_n: float | None = None,
        limit_mm: float | None = None,
    ) -> None:
        """Change speed [mm/s], force [N] or limit [mm] of later motions."""
        ...

    def move_fingers(self, to_mm: float) -> None:
        """Begin to move the fingers to a position [mm]."""
        ...

    def stop_fingers(self) -> None:
        """Stop the fingers where they are."""
        ...

    def await_fingers(self) -> None:
        """Wait until the fingers are at rest."""
        ...

    def finger_position(self) -> float:
        """Position [mm] of the fingers."""
        ...

    def finger_speed(self) -> float:
        """Speed [mm/s] of the fingers."""
        ...


class Conveyor(Protocol):
    """A conveyor with its connection to one of its objects."""

    @property
    def is_connected(self) -> bool:
        """Whether a work object is connected to one of its objects."""
        ...

    def next_s(self, now_s: float, distance_mm: float) -> float | None:
        """Time [s] at which the next object has travelled a distance if the belt goes on as now.

        None if there is no object; infinite if the belt stands before.
        """
        ...

    @property
    def stops(self) -> bool:
        """Whether signals may stop the belt."""
        ...

    @property
    def shows_connection(self) -> bool:
        """Whether a signal is 1 while an object is connected."""
        ...

    def connect(self, now_s: float) -> None:
        """Take the next object at a time [s]."""
        ...

    def drop(self, now_s: float) -> None:
        """Release the object at a time [s], which counts if a signal shows it."""
        ...


class IndependentAxis(Protocol):
    """An axis that may leave the path and move independently; in degrees or mm."""

    @property
    def acceleration(self) -> float:
        """Maximum rate of change of its speed."""
        ...

    @property
    def turns(self) -> bool:
        """Whether the axis is rotating; otherwise it is linear."""
        ...

    @property
    def is_independent(self) -> bool:
        """Whether the axis has left the path."""
        ...

    def take(self, position: float, now_s: float) -> None:
        """Make the axis independent, at rest at its position."""
        ...

    def release(self) -> None:
        """Make the axis follow the path again."""
        ...

    def position(self, now_s: float) -> float:
        """Position at a time [s]."""
        ...

    def speed(self, now_s: float) -> float:
        """Speed at a time [s], negative backwards."""
        ...

    def is_at_target(self, now_s: float) -> bool:
        """Whether the axis rests at its target."""
        ...

    def has_speed(self, now_s: float) -> bool:
        """Whether the axis moves at the requested speed."""
        ...

    def move_to(self, target: float, speed: float, acceleration: float, now_s: float) -> None:
        """Move to a position and stay there."""
        ...

    def move_at(self, speed: float, acceleration: float, now_s: float) -> None:
        """Move indefinitely at a speed, or stop with a speed of 0."""
        ...


class Equipment(Protocol):
    """Equipment of a program."""

    def conveyor(self, unit: str) -> Conveyor | None:
        """A conveyor by the name of its unit, ignoring case; None if it does not exist."""
        ...

    def mechanical_units(self) -> tuple[MechanicalUnitFacts, ...]:
        """The task's robot, if it has one, and the units of external axes."""
        ...

    def system_units(self) -> tuple[MechanicalUnitFacts, ...]:
        """The robots of all tasks in the order of the station, then their external axes."""
        ...

    def independent_axis(self, unit: MechanicalUnitFacts, axis: int) -> IndependentAxis:
        """An axis of a mechanical unit, counted from 1."""
        ...

    def instances(self, domain: str, of: str) -> Sequence[Mapping[str, str]] | None:
        """The instances of a type of system parameters; None if there is no such type."""
        ...

    def configure(self, domain: str, of: str, number: int, attribute: str, value: str) -> None:
        """Change an attribute of an instance, by its position."""
        ...

    def is_enabled(self, device: str) -> bool:
        """Whether an I/O device is enabled; names ignore case."""
        ...

    def has_contact(self, device: str) -> bool:
        """Whether an I/O device has contact; names ignore case."""
        ...

    def enable(self, device: str, *, enabled: bool) -> None:
        """Enable or disable an I/O device."""
        ...
