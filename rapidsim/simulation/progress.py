"""Progress of a run; it may be read from another thread and does not affect the run."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from types import FrameType

from rapidsim.controller.cell.cell import Cell
from rapidsim.diagnostics import Span
from rapidsim.simulation.task_run import TaskRun
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class Progress:
    """Progress of a run: moves and time so far."""

    moves: int
    """Number of moves with known times."""
    places: int
    """Number of distinct instructions that made these moves."""
    planned: int
    """Number of further moves, being planned or waiting for the end of their block."""
    time_s: float = 0.0
    """Virtual time that the first task has reached, as far as it is planned."""
    place: Span | None = None
    """Statement that the first task executes; None before its first."""


class MoveCounter:
    """Counter of the moves of tasks; it visits each move only once in all calls."""

    def __init__(self, runs: Sequence[TaskRun]) -> None:
        """Create a counter for the tasks of a run."""
        self._runs = runs
        self._counted = [0] * len(runs)
        self._places: set[tuple[str, int]] = set()

    def __call__(self) -> Progress:
        """Return the progress so far."""
        for number, run in enumerate(self._runs):
            moves = run.member.moves
            for _, move in moves.numbered(self._counted[number]):
                if move.started.time is None:
                    break
                self._places.add((move.place.span.file, move.place.span.start))
                self._counted[number] += 1
        counted = sum(self._counted)
        given = sum(len(run.member.moves) for run in self._runs)
        clock = self._runs[0].controller.clock
        return Progress(
            counted, len(self._places), given - counted, clock.pointer_s(), clock.place.span
        )


@value_class(frozen=True, slots=True, eq=False)
class RunInProgress:
    """A run that has been set up and not ended, for those who watch it."""

    cell: Cell
    tasks: Callable[[], Sequence[TaskRun]]
    """Returns its tasks, in the order of the station file."""

    @property
    def progress(self) -> MoveCounter:
        """A counter of its moves."""
        return MoveCounter(self.tasks())

    @property
    def current(self) -> TaskRun:
        """The task that runs; the first one if none does."""
        clock, tasks = self.cell.scheduler.current, self.tasks()
        return next((one for one in tasks if one.controller.clock is clock), tasks[0])

    def frame_of(self, task: TaskRun) -> FrameType | None:
        """Python frame at which a task is suspended; None if it runs, or has ended."""
        return self.cell.scheduler.frame_of(task.controller.clock)
