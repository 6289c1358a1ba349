"""Motion of the fingers of a servo gripper, independent of the tasks that move them."""

from __future__ import annotations

from dataclasses import dataclass

OPEN_MM = 25.0
"""Position [mm] of fingers that are fully open; 0 is closed."""
FASTEST_MM_S = 25.0
STRONGEST_N = 20.0


@dataclass(slots=True, eq=False)
class Fingers:
    """Position of the fingers over time: straight lines, without ramps."""

    object_mm: float | None = None
    """Position at which closing fingers meet an object; None if it is unknown."""
    speed_mm_s: float = FASTEST_MM_S
    force_n: float = STRONGEST_N
    limit_mm: float = OPEN_MM
    """Maximum position to which they open."""
    _from_mm: float = 0.0
    _to_mm: float = 0.0
    _began_s: float = 0.0
    _ends_s: float = 0.0

    @property
    def rest_s(self) -> float:
        """Time [s] at which they come, or came, to rest."""
        return self._ends_s

    def position(self, now_s: float) -> float:
        """Position [mm] at a time [s]."""
        if now_s >= self._ends_s:
            return self._to_mm
        share = (now_s - self._began_s) / (self._ends_s - self._began_s)
        return self._from_mm + share * (self._to_mm - self._from_mm)

    def speed(self, now_s: float) -> float:
        """Speed [mm/s] at a time [s], not negative."""
        if not self._began_s <= now_s < self._ends_s:
            return 0.0
        return abs(self._to_mm - self._from_mm) / (self._ends_s - self._began_s)

    def move(self, to_mm: float, now_s: float) -> None:
        """Begin to move to a position [mm]."""
        self._from_mm, self._to_mm = self.position(now_s), to_mm
        self._began_s = now_s
        self._ends_s = now_s + abs(self._to_mm - self._from_mm) / self.speed_mm_s

    def stop(self, now_s: float) -> None:
        """Stop at once."""
        self._to_mm = self.position(now_s)
        self._ends_s = min(self._ends_s, now_s)
