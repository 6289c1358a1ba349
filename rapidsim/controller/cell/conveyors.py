"""Conveyors of a cell: the objects that pass, and the one to which a program is connected."""

from __future__ import annotations

import math
from typing import Annotated

from rapidsim.json_records.declarations import AboveZero, Key, NotNegative
from rapidsim.values import value_class

MM_BEHIND = 1e-6


@value_class(frozen=True, slots=True)
class ConveyorScript:
    """Arrival of objects on a conveyor: a table [[conveyor]] of the station file."""

    unit: str
    """Name of its mechanical unit."""
    speed_mm_s: Annotated[AboveZero, Key("speed")]
    """Its speed, which is constant."""
    first_s: Annotated[NotNegative, Key("at")] = 0.0
    """Time [s] at which the first object passes the synchronisation switch."""
    every_s: Annotated[AboveZero | None, Key("every")] = None
    """Time from one object to the next; None if there is only one."""
    length_mm: Annotated[AboveZero, Key("length")] = math.inf
    """An object that travels this far without being taken is lost."""


@value_class(slots=True, eq=False)
class ConveyorState:
    """State of a conveyor during a run; implements `language.equipment.Conveyor`."""

    script: ConveyorScript
    is_connected: bool = False
    _next: int = 0
    """Index of the object that is taken next."""

    def next_s(self, now_s: float, distance_mm: float) -> float | None:
        """Time [s] at which the next object has travelled a distance; None if there is none."""
        script = self.script
        late_s = (script.length_mm + MM_BEHIND) / script.speed_mm_s
        while (passed_s := self._passes_s()) is not None and passed_s + late_s < now_s:
            self._next += 1
        return None if passed_s is None else passed_s + distance_mm / script.speed_mm_s

    def connect(self) -> None:
        """Take the next object."""
        self.is_connected, self._next = True, self._next + 1

    def drop(self) -> None:
        """Release the object."""
        self.is_connected = False

    def _passes_s(self) -> float | None:
        """Time [s] at which the next object passes the switch; None if there is none."""
        every_s = self.script.every_s
        if self._next and every_s is None:
            return None
        return self.script.first_s + self._next * (every_s or 0.0)
