"""Coverage of a check of moves: numbers of checked moves, and reasons for the others."""

from __future__ import annotations

from dataclasses import field

from rapidsim.diagnostics import Diagnostic, Span
from rapidsim.values import value_class

MOST_MOVES = 4000
"""Number of move instructions in a text above which a check does not run it."""
MOST_MOVES_FOR_ERRORS = 300
"""Same limit for runs that can only find errors: all moves are known, or all tasks run together."""


@value_class(frozen=True, slots=True)
class UncheckedMove:
    """A move instruction that was not checked."""

    span: Span
    reason: str


@value_class(frozen=True, slots=True)
class Coverage:
    """Move instructions of a program by kind of check."""

    by_value: int = 0
    """Number of moves whose targets, tools and work objects are known statically."""
    by_run: int = 0
    """Number of moves that a run of main executed."""
    unchecked: tuple[UncheckedMove, ...] = ()
    main_left_out: str = ""
    """Reason why main was not run for errors that only a run meets; empty if it was."""
    paths: int = 0
    """Number of moves along a line or arc, where the arm must also be able to follow the path."""
    unchecked_paths: tuple[UncheckedMove, ...] = ()
    """Moves along a line or arc of which only the end was checked."""

    @property
    def paths_checked(self) -> int:
        """Number of lines and arcs that were checked from start to end."""
        return self.paths - len(self.unchecked_paths)

    @property
    def checked(self) -> int:
        """Number of moves that were checked statically or by a run."""
        return self.by_value + self.by_run

    @property
    def moves(self) -> int:
        """Number of all moves."""
        return self.checked + len(self.unchecked)

    def __repr__(self) -> str:
        """One line."""
        return f"<{self.checked} of {self.moves} moves checked>"

    def __add__(self, other: Coverage) -> Coverage:
        """Return the coverage of two tasks together."""
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
    """Findings about the moves of one program."""

    diagnostics: tuple[Diagnostic, ...] = ()
    coverage: Coverage = field(default_factory=Coverage)
