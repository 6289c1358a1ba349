"""Progress of a long run on a terminal: share, rate, remaining time."""

from __future__ import annotations

import time
from collections.abc import Callable

from rich.text import Text

from rapidsim.simulation.progress import Progress, RunInProgress

_SAID_AFTER_S = 1.0
_LEAST_SHARE = 0.01
"""Below it a time left would be a guess."""
_MINUTE_S = 60.0
_A_BLOCK = 100
"""Least number of moves for which progress is shown."""


class Meter:
    """Content of a status line, read from the run when the line is drawn."""

    def __init__(self, written: int, now: Callable[[], float] = time.monotonic) -> None:
        """Begin to measure.

        Args:
            written: The number of move instructions in the programs.
            now: A clock [s].
        """
        self._written, self._now, self._began = written, now, now()
        self._look: Callable[[], Progress] | None = None

    def watch(self, run: RunInProgress) -> None:
        """Take the run, as soon as there is one."""
        self.read(run.progress)

    def read(self, progress: Callable[[], Progress]) -> None:
        """Take a function that returns the progress of the run."""
        self._look = progress

    def __rich__(self) -> Text:
        """The line as it is now."""
        seconds = self._now() - self._began
        if self._look is None or seconds < _SAID_AFTER_S:
            return Text("simulating ...")
        return Text(f"simulating: {_words(self._look(), self._written, seconds)}")

    def so_far(self) -> str:
        """Progress of a run that was broken off, as text after `interrupted`."""
        return f"{self.reached()}; no output was written" if self._look else ""

    def reached(self) -> str:
        """Progress of an interrupted run, as text after `interrupted`."""
        if self._look is None:
            return ""
        far = self._look()
        waits = f", {far.planned:,} more on the way" if far.planned else ""
        place = f", the program at {far.place.file}:{far.place.line}" if far.place else ""
        return f" at {far.time_s:.3f} s: {far.moves:,} moves made{waits}{place}"


def _words(progress: Progress, written: int, seconds: float) -> str:
    """Share and remaining time follow from the text as long as no move has been repeated."""
    if progress.planned > max(_A_BLOCK, progress.moves):
        # A block has no times before it is planned as a whole.
        return f"planning {progress.planned:,} moves as one path, {_length(seconds)} so far"
    rate = f"{progress.moves:,} moves, {progress.moves / seconds:,.0f} a second"
    share = progress.places / written if written else 0.0
    if progress.places < progress.moves or not _LEAST_SHARE <= share <= 1.0:
        return rate
    return f"{100.0 * share:.0f} %, {rate}, {_length(seconds * (1.0 / share - 1.0))} left"


def _length(seconds: float) -> str:
    if seconds < _MINUTE_S:
        return f"{seconds:.0f} s"
    return f"{seconds // _MINUTE_S:.0f} min {seconds % _MINUTE_S:.0f} s"
