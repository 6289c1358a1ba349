"""`rapidsim.check`: find the mistakes in the files of a program without running it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from os import PathLike, fspath
from typing import TYPE_CHECKING

from rapidsim.diagnostics import Diagnostic, Severity, Span
from rapidsim.files import TaskFiles, read_tasks
from rapidsim.simulation.load import load
from rapidsim.simulation.written_moves import written_moves

if TYPE_CHECKING:
    from rapidsim.motion.robot import Robot


@dataclass(frozen=True, slots=True, eq=False)
class CheckResult:
    """What checking found, and what it did not look at."""

    files: tuple[str, ...]
    """The files that were read."""
    diagnostics: tuple[Diagnostic, ...]
    """Findings in order of file and place."""
    unchecked_moves: tuple[Span, ...]
    """Moves whose reach, limits and path were not checked; only a run does that so far."""

    @property
    def accepted(self) -> bool:
        """Whether the program could run: there is no error among the findings."""
        return all(d.severity is not Severity.ERROR for d in self.diagnostics)


def check(
    paths: Iterable[str | PathLike[str]],
    *,
    robot: Robot | str | None = None,
) -> CheckResult:
    """Check the modules, program files or folders named, as `rapidsim check` does.

    Args:
        paths: What is checked; together it is one task, but for the tasks of a backup.
        robot: The arm the program is for. No rule looks at it yet: the moves it would decide on are
            in `CheckResult.unchecked_moves`.

    Raises:
        InputError: If something is missing, unreadable, or no RAPID.
    """
    return check_tasks(read_tasks([fspath(path) for path in paths]))


def check_tasks(tasks: Iterable[TaskFiles]) -> CheckResult:
    """Check tasks that have been read, each on its own."""
    loaded = [(task, load(task.files)) for task in tasks]
    found = (diagnostic for _, one in loaded for diagnostic in one.diagnostics)
    return CheckResult(
        files=tuple(file.name for task, _ in loaded for file in task.files),
        diagnostics=tuple(sorted(found, key=lambda diagnostic: diagnostic.order)),
        unchecked_moves=tuple(move for _, one in loaded for move in written_moves(one.files)),
    )
