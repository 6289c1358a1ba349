"""The first Ctrl-C ends a run as its limits do, so that what was done is shown and written.

A second one interrupts whatever is going on then, as Ctrl-C does in other commands.
"""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

from rapidsim.simulation.progress import RunInProgress

_REASON = "the run was interrupted"


class RunInterruption:
    """Ctrl-C during a run."""

    def __init__(self, *, ends_run: bool) -> None:
        """Begin without an interruption, and without a run.

        Args:
            ends_run: Whether the first Ctrl-C ends the run; else it interrupts it, like a second.
        """
        self._ends_run = ends_run
        self.has_come = False
        """Whether Ctrl-C has ended the run."""
        self._run: RunInProgress | None = None

    def watch(self, run: RunInProgress) -> None:
        """Take a run as soon as there is one; after a Ctrl-C it ends at once."""
        self._run = run
        if self.has_come:
            run.cell.watchdog.end_run(_REASON)

    @contextmanager
    def awaited(self) -> Iterator[None]:
        """Let the first Ctrl-C end the run in here, unless the process ignores it."""
        before = signal.getsignal(signal.SIGINT)
        is_main = threading.current_thread() is threading.main_thread()
        if not (self._ends_run and is_main and before is signal.default_int_handler):
            yield
            return
        signal.signal(signal.SIGINT, self._handle)
        try:
            yield
        finally:
            signal.signal(signal.SIGINT, before)

    def _handle(self, _number: int, _frame: FrameType | None) -> None:
        signal.signal(signal.SIGINT, signal.default_int_handler)
        if self._run is None:
            raise KeyboardInterrupt
        self.has_come = True
        self._run.cell.watchdog.end_run(_REASON)
