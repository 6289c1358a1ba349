"""How far a run is while it goes on; asked from another thread, it changes nothing."""

from __future__ import annotations

from collections.abc import Sequence

from rapidsim.diagnostics import Span
from rapidsim.simulation.task_run import TaskRun
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class Progress:
    """What robots were given so far."""

    moves: int
    """Those whose times are known."""
    places: int
    """At how many places of the text these moves stand."""
    planned: int
    """Those besides that are planned at once, or wait for the end of their block."""
    time_s: float = 0.0
    """Virtual time up to which the first task has come, as far as that is planned."""
    place: Span | None = None
    """The statement that it executes; None before there is one."""


class MoveCounter:
    """Counts the moves of tasks; looks at each only once, however often it is asked."""

    def __init__(self, runs: Sequence[TaskRun]) -> None:
        """Take the tasks of a run."""
        self._runs = runs
        self._counted = [0] * len(runs)
        self._places: set[tuple[str, int]] = set()

    def __call__(self) -> Progress:
        """How far it is."""
        for number, run in enumerate(self._runs):
            moves = run.queue.moves
            for _, move in moves.numbered(self._counted[number]):
                if move.started.time is None:
                    break
                self._places.add((move.place.span.file, move.place.span.start))
                self._counted[number] += 1
        counted = sum(self._counted)
        given = sum(len(run.queue.moves) for run in self._runs)
        clock = self._runs[0].controller.clock
        return Progress(
            counted, len(self._places), given - counted, clock.pointer_s(), clock.place.span
        )
