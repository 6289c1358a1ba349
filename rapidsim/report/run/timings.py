"""Processor time of a run by its parts; it differs from run to run, the run itself does not."""

from __future__ import annotations

from rapidsim.json_records.declarations import Rounded
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class RunTimings:
    """Processor time [s] of a run, without the start of Python."""

    reading_s: Rounded
    """Files read and checked."""
    solving_s: Rounded
    """Geometry of paths, and the joints along them."""
    planning_s: Rounded
    """Fastest motion along the paths."""
    program_s: Rounded
    """The rest of the run: code, statements, signals, single targets, findings, collisions."""
    recording_s: Rounded
    """Recording and other output files."""

    @property
    def text(self) -> str:
        """One line for people."""
        parts = {
            "reading": self.reading_s,
            "solving": self.solving_s,
            "planning": self.planning_s,
            "program": self.program_s,
            "recording": self.recording_s,
        }
        shares = ", ".join(f"{name} {seconds:.3f}" for name, seconds in parts.items())
        return f"processor time {sum(parts.values()):.3f} s: {shares}"
