"""Tables [[conveyor]] of the station file: belts, and when objects arrive on them."""

from __future__ import annotations

import math
from typing import Annotated

from rapidsim.controller.cell.conditions import Condition
from rapidsim.json_records.declarations import AboveZero, Key, NotNegative
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class ConveyorScript:
    """A belt and the arrival of objects on it: a table [[conveyor]] of the station file."""

    unit: str
    """Name of its mechanical unit."""
    speed_mm_s: Annotated[AboveZero, Key("speed")]
    """Its speed while it runs."""
    first_s: Annotated[NotNegative, Key("at")] = 0.0
    """Time [s] at which the first object passes the synchronisation switch, if the belt runs."""
    every_s: Annotated[AboveZero | None, Key("every")] = None
    """Time from one object to the next while the belt runs; None if there is only one."""
    length_mm: Annotated[AboveZero, Key("length")] = math.inf
    """An object that travels this far from the switch without being taken is lost."""
    most: Annotated[AboveZero | None, Key("maximum")] = None
    """Distance from the switch up to which a robot may follow an object; no key for `length`."""
    runs: Condition | None = None
    """While it holds, the belt runs; no key if it always does."""
    drops: Condition | None = None
    """When it becomes true, the connected object is dropped, as by DropWObj."""
    clears: Condition | None = None
    """When it becomes true, all objects behind the switch are removed from the queue."""
    connected: str | None = None
    """The input that is 1 while an object is connected."""
    switch: str | None = None
    """The input that is 1 for 0.1 s each time that an object passes the switch."""
    arrival: Annotated[str | None, Key("object")] = None
    """The [[object]] of which a copy arrives each time, at the pose of the object."""
    surface: str | None = None
    """The [[object]] on which parts that are put down travel with the belt."""
    position: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """Position of the switch in the world [mm]."""
    quaternion: tuple[float, float, float, float] = (1.0, 0.0, 0.0, 0.0)
    """Orientation of the switch; the belt travels along its x axis."""

    @property
    def conditions(self) -> tuple[Condition, ...]:
        """The conditions that signals decide."""
        every = (self.runs, self.drops, self.clears)
        return tuple(one for one in every if one is not None)

    @property
    def has_place(self) -> bool:
        """Whether the switch has a place in the world."""
        return self.position != (0.0, 0.0, 0.0) or self.quaternion != (1.0, 0.0, 0.0, 0.0)

    @property
    def most_mm(self) -> float:
        """Distance [mm] from the switch up to which a robot may follow an object."""
        return self.length_mm if self.most is None else self.most
