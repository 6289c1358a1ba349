"""The world zones of one task's robot: stopping it, setting outputs.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "WZLimSup",
"WZDOSet".
"""

from __future__ import annotations

from rapidsim.controller.cell.cell import Cell
from rapidsim.controller.clock import TaskClock
from rapidsim.controller.journal.events import EventKind
from rapidsim.controller.journal.journal import Instant, Journal, Moment
from rapidsim.controller.journal.stop_reasons import ZoneReached
from rapidsim.controller.queue.mechanical_unit import MechanicalUnit
from rapidsim.controller.queue.zone_table import WatchedZone, WorldZoneTable
from rapidsim.language.error_numbers import ERR_ARGVALERR, rapid_error
from rapidsim.language.path_events import ZoneShape
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class TaskZones:
    """Implements `language.path_control.WorldZones`."""

    clock: TaskClock
    unit: MechanicalUnit
    cell: Cell
    journal: Journal
    zones: WorldZoneTable

    def watch_zone(
        self, shape: ZoneShape, signal: tuple[str, float] | None, *, before: bool = False
    ) -> float:
        """Watch a zone, from now on; without a signal it stops the robot."""
        self.clock.note_line()
        if before:
            self.journal.unsimulated(
                r"WZDOSet \Before", "set when the TCP is in the zone", self.clock.place
            )
        now_s = self.clock.resolve_time()
        cause, place = self.clock.cause(), self.clock.place

        def set_output(inside: bool, time_s: float) -> None:
            assert signal is not None
            name, value = signal
            set_to = value if inside else 1.0 - value
            self.cell.set_signal(cause, Moment(Instant(time_s)), name, set_to)

        def stop(inside: bool, time_s: float) -> None:
            if inside:
                what = f"the robot came to the world zone that line {place.span.line} supervises"
                moment = Moment(Instant(time_s))
                self.journal.event(moment, EventKind.LIMIT, self.clock.place, what)
                self.unit.halt(time_s)
                self.clock.set(time_s)
                raise ZoneReached(what)

        return self.zones.add(WatchedZone(shape, stop if signal is None else set_output), now_s)

    def enable_zone(self, zone: float, *, enabled: bool) -> None:
        """Switch a zone on or off.

        Raises:
            RapidError: ERR_ARGVALERR, if there is no such zone.
        """
        self.clock.note_line()
        now_s = self.clock.resolve_time()
        try:
            self.zones.enable(zone, now_s, enabled=enabled)
        except KeyError:
            raise _no_zone(zone) from None

    def free_zone(self, zone: float) -> None:
        """Remove a zone.

        Raises:
            RapidError: ERR_ARGVALERR, if there is no such zone.
        """
        self.clock.note_line()
        self.clock.resolve_time()
        try:
            self.zones.free(zone)
        except KeyError:
            raise _no_zone(zone) from None


def _no_zone(zone: float) -> Exception:
    return rapid_error(ERR_ARGVALERR, f"there is no world zone {zone:g}; define it first")
