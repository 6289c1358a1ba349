"""How many of a program's moves were checked, how, and why others were not."""

from __future__ import annotations

from dataclasses import field

from rapidsim.diagnostics import Diagnostic, Span
from rapidsim.values import value_class

MOST_MOVES = 4000
"""Move instructions in a text beyond which a check does not run it."""
MOST_MOVES_FOR_ERRORS = 300
"""Likewise, where only an error can be found: all moves are known, or tasks are run together."""


@value_class(frozen=True, slots=True)
class UncheckedMove:
    """A move instruction about which nothing is known."""

    span: Span
    reason: str


@value_class(frozen=True, slots=True)
class Coverage:
    """The move instructions of a program by how they were checked."""

    by_value: int = 0
    """Their targets, tools and work objects are known before the program runs."""
    by_run: int = 0
    """A run of main met them."""
    unchecked: tuple[UncheckedMove, ...] = ()
    main_left_out: str = ""
    """Why main was not run for the errors that only a run meets; empty where it was."""
    paths: int = 0
    """Those that lead the TCP on a line or arc, so that the arm must also get along the path."""
    unchecked_paths: tuple[UncheckedMove, ...] = ()
    """Those of them whose end alone was checked."""

    @property
    def paths_checked(self) -> int:
        """Lines and arcs that were checked from start to end."""
        return self.paths - len(self.unchecked_paths)

    @property
    def checked(self) -> int:
        """Those checked in either way."""
        return self.by_value + self.by_run

    @property
    def moves(self) -> int:
        """All of them."""
        return self.checked + len(self.unchecked)

    def __repr__(self) -> str:
        """One line."""
        return f"<{self.checked} of {self.moves} moves checked>"

    def __add__(self, other: Coverage) -> Coverage:
        """Of two tasks."""
        return Coverage(
            self.by_value + other.by_value,
            self.by_run + other.by_run,
            (*self.unchecked, *other.unchecked),
            self.main_left_out or other.main_left_out,
            self.paths + other.paths,
            (*self.unchecked_paths, *other.unchecked_paths),
        )


@value_class(frozen=True, slots=True, eq=False)
class ReachReport:
    """The findings about the moves of one program."""

    diagnostics: tuple[Diagnostic, ...] = ()
    coverage: Coverage = field(default_factory=Coverage)
