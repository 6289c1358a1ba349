"""The world zones of one task's robot: stopping it, setting outputs.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "WZLimSup",
"WZDOSet".
"""

from __future__ import annotations

from rapidsim.controller.clock import TaskTime
from rapidsim.controller.journal.events import EventKind
from rapidsim.controller.journal.journal import Instant, Moment
from rapidsim.controller.journal.stop_reasons import ZoneReached
from rapidsim.controller.queue.zone_table import Zone
from rapidsim.language.error_numbers import ERR_ARGVALERR, rapid_error
from rapidsim.language.path_events import ZoneShape


class TaskZones(TaskTime):
    """Implements `language.controller.WorldZones`."""

    def watch_zone(
        self, shape: ZoneShape, signal: tuple[str, float] | None, *, before: bool = False
    ) -> float:
        """Watch a zone, from now on; without a signal it stops the robot."""
        self._note_line()
        if before:
            self._journal.unsimulated(
                r"WZDOSet \Before", "set when the TCP is in the zone", self.place
            )
        now_s = self._observe()
        cause, place = self._cause(), self.place

        def set_output(inside: bool, time_s: float) -> None:
            assert signal is not None
            name, value = signal
            set_to = value if inside else 1.0 - value
            self._cell.set_signal(cause, Moment(Instant(time_s)), name, set_to)

        def stop(inside: bool, time_s: float) -> None:
            if inside:
                what = f"the robot came to the world zone that line {place.span.line} supervises"
                moment = Moment(Instant(time_s))
                self._journal.event(moment, EventKind.LIMIT, self.place, what)
                self._unit.queue.halt(time_s)
                self._time.set(time_s)
                raise ZoneReached(what)

        return self._zones.add(Zone(shape, stop if signal is None else set_output), now_s)

    def enable_zone(self, zone: float, *, enabled: bool) -> None:
        """Switch a zone on or off.

        Raises:
            RapidError: ERR_ARGVALERR, if there is no such zone.
        """
        self._note_line()
        now_s = self._observe()
        try:
            self._zones.enable(zone, now_s, enabled=enabled)
        except KeyError:
            raise _no_zone(zone) from None

    def free_zone(self, zone: float) -> None:
        """Forget a zone.

        Raises:
            RapidError: ERR_ARGVALERR, if there is no such zone.
        """
        self._note_line()
        self._observe()
        try:
            self._zones.free(zone)
        except KeyError:
            raise _no_zone(zone) from None


def _no_zone(zone: float) -> Exception:
    return rapid_error(ERR_ARGVALERR, f"there is no world zone {zone:g}; define it first")
