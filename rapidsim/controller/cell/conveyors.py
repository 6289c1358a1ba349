"""Conveyors of a cell: the objects that pass, and the one to which a program is connected.

The belt has a time of its own that stands while the belt does. Objects lie on it at distances that
it travels between their arrivals.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import field
from typing import TypeAlias

from rapidsim.controller.cell.conveyor_scripts import ConveyorScript
from rapidsim.motion.geometry.belts import BeltCourse
from rapidsim.values import value_class

MM_BEHIND = 1e-6
_MM = 1e-3
SWITCH_S = 0.1
"""Length [s] of the pulse of a switch."""


Schedule: TypeAlias = Callable[[str, float, Callable[[float], bool]], None]
"""Lets a signal be 1 for a moment, at a time [s], if a function of that time is true then."""
Show: TypeAlias = Callable[[str, float, float], None]
"""Sets a signal to a value at a time [s]."""


@value_class(slots=True, eq=False)
class ConveyorState:
    """State of a conveyor during a run; implements `language.equipment.Conveyor`."""

    script: ConveyorScript
    read: Callable[[str], float]
    """Returns the value of a signal."""
    course: BeltCourse = field(init=False)
    """Its travel, as robots follow it."""
    _connected: int | None = None
    """Number of the object that a work object follows; None if there is none."""
    _next: int = 0
    """Index of the object that is taken next."""
    _since_s: float = 0.0
    _travelled_s: float = 0.0
    """Time of the belt at `_since_s`."""
    _passes: int = 0
    """Number of objects that have operated the switch."""
    _changes: int = 0
    """Number of times that the belt has started or stopped."""
    _schedule: Schedule | None = None
    _show: Show | None = None
    _conditions: tuple[bool, bool] = (False, False)
    """Conditions of `_holding` after the last change of a signal."""
    _runs: bool = field(init=False)

    def __post_init__(self) -> None:
        """Look whether it runs at the start."""
        self._runs, self._conditions = self._is_running(), self._holding()
        self.course = BeltCourse(self.script.unit, self._speed_m_s if self._runs else 0.0)

    @property
    def is_connected(self) -> bool:
        """Whether a work object is connected to one of its objects."""
        return self._connected is not None

    @property
    def passed_m(self) -> float | None:
        """Travel [m] of the belt at which the connected object passed the switch, None if none."""
        if self._connected is None:
            return None
        passed_s = self._arrives_s(self._connected)
        assert passed_s is not None
        return passed_s * self._speed_m_s

    def leaves_s(self) -> float:
        """Time [s] from which on no robot may follow the connected object, if nothing changes."""
        assert self.passed_m is not None
        return self.course.time_at(self.passed_m + self.script.most_mm * _MM)

    @property
    def _speed_m_s(self) -> float:
        return self.script.speed_mm_s * _MM

    @property
    def stops(self) -> bool:
        """Whether signals may stop the belt."""
        return self.script.runs is not None

    @property
    def is_wired(self) -> bool:
        """Whether signals act on the belt or its objects."""
        return bool(self.script.conditions)

    @property
    def shows_connection(self) -> bool:
        """Whether a signal is 1 while an object is connected."""
        return self.script.connected is not None

    def next_s(self, now_s: float, distance_mm: float) -> float | None:
        """Time [s] at which the next object has travelled a distance if the belt goes on as now.

        None if there is no object; infinite if the belt stands before.
        """
        script = self.script
        belt_s = self._belt_s(now_s)
        late_s = (script.length_mm + MM_BEHIND) / script.speed_mm_s
        while (passed_s := self._passes_s()) is not None and passed_s + late_s < belt_s:
            self._next += 1
        if passed_s is None:
            return None
        wait_s = passed_s + distance_mm / script.speed_mm_s - belt_s
        return now_s + wait_s if wait_s <= 0.0 or self._runs else math.inf

    def listens_to(self, signal: str) -> bool:
        """Whether a signal acts on the belt or its objects."""
        folded = signal.lower()
        names = (name for condition in self.script.conditions for name in condition.signals())
        return any(name.lower() == folded for name in names)

    def signal_changed(self, signal: str, old: float, value: float, now_s: float) -> None:
        """Start or stop the belt, drop the connected object, or remove those that wait."""
        before, self._conditions = self._conditions, self._holding()
        if self._conditions[0] and not before[0]:
            self.drop(now_s)
        if self._conditions[1] and not before[1]:
            while (passed_s := self._passes_s()) is not None and passed_s <= self._belt_s(now_s):
                self._next += 1
        if self._is_running() != self._runs:
            self._start_or_stop(now_s)

    def _start_or_stop(self, now_s: float) -> None:
        self._travelled_s = self._belt_s(now_s)
        self._since_s, self._runs = now_s, self._is_running()
        self.course.change(now_s, self._speed_m_s if self._runs else 0.0)
        self._changes += 1
        self._watch_switch(now_s)

    def begin(self, schedule: Schedule, show: Show) -> None:
        """Operate the switch from time zero on, and the signal of the connection."""
        self._schedule, self._show = schedule, show
        self._watch_switch(0.0)

    def _watch_switch(self, now_s: float) -> None:
        """Schedule the next pulse of the switch, if the belt goes on as now."""
        switch, passes_s = self.script.switch, self._arrives_s(self._passes)
        if self._schedule is None or switch is None or passes_s is None or not self._runs:
            return
        changes = self._changes

        def passes(time_s: float) -> bool:
            if self._changes != changes:
                return False
            self._passes += 1
            self._watch_switch(time_s)
            return True

        self._schedule(switch, now_s + max(0.0, passes_s - self._belt_s(now_s)), passes)

    def _belt_s(self, now_s: float) -> float:
        """Time [s] for which the belt has run."""
        return self._travelled_s + (now_s - self._since_s if self._runs else 0.0)

    def _is_running(self) -> bool:
        return self.script.runs is None or self.script.runs.holds(self.read)

    def connect(self, now_s: float) -> None:
        """Take the next object at a time [s]."""
        self._connected, self._next = self._next, self._next + 1
        self._show_connection(now_s)

    def drop(self, now_s: float) -> None:
        """Release the object at a time [s], which counts if a signal shows it."""
        self._connected = None
        self._show_connection(now_s)

    def _show_connection(self, now_s: float) -> None:
        if self.script.connected is not None and self._show is not None:
            self._show(self.script.connected, float(self.is_connected), now_s)

    def _holding(self) -> tuple[bool, bool]:
        """Whether the conditions hold that drop the object and that remove those that wait."""
        drops, clears = self.script.drops, self.script.clears
        return (
            drops is not None and drops.holds(self.read),
            clears is not None and clears.holds(self.read),
        )

    def _passes_s(self) -> float | None:
        """Time [s] of the belt at which the next object passes the switch; None for none."""
        return self._arrives_s(self._next)

    def _arrives_s(self, number: int) -> float | None:
        every_s = self.script.every_s
        if number and every_s is None:
            return None
        return self.script.first_s + number * (every_s or 0.0)
