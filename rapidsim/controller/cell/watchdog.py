"""Limit of a run on the computer's clock (wall clock), or of the processor time that it may take.

This is the only part of a run that reads these clocks, and it only ends the run. Polling the
limit costs next to nothing: a thread sleeps until the limit, then sets a flag that long work
checks, and takes the ticks of the tasks, so that every loop requests new ones at its next turn.
Work that cannot check the flag (loading a module runs the parser, the checker and the compiler) is
interrupted at once, and so is the whole run if nothing has checked the flag for a second; never
numba while it compiles (`COMPILING`). Recorded items must still be written: the more they are, the
earlier the limit.
"""

from __future__ import annotations

import ctypes
import math
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from threading import Event, Lock, Thread, get_ident
from time import monotonic, sleep
from typing import ClassVar, Final, Protocol

from rapidsim.controller.journal.stop_reasons import WallLimitReached
from rapidsim.controller.pointer_time import NO_TICKS
from rapidsim.motion.numba_jit import COMPILING

_AGAIN_S: Final = 0.02
"""Period [s] of taking the ticks of all tasks again, in case more were just granted."""

_PATIENCE_S: Final = 1.0
"""Time [s] from the limit until the run is interrupted, whatever it is doing."""
_LOOKS_S: Final = 0.1
"""Period [s] at which the number of recorded items is checked."""
_WRITING_S: Final = 25e-6
"""Time [s] to date, sort and write a recorded item as JSON and events."""
_FREE_S: Final = 1.0
"""Time [s] that writing may take beyond the limit."""


class _Interrupted(WallLimitReached):
    """Raised by the thread of the watchdog in the thread of the run."""

    def __init__(self) -> None:
        super().__init__("the run was cut off at its limit on the computer's clock")


class Ticking(Protocol):
    """A task that runs loops."""

    ticks_left: int
    """Remaining ticks; below zero a loop requests more, and the grant checks the limit."""


class Watchdog:
    """Watches the wall-clock time of one run."""

    runs_ended: ClassVar[int] = 0
    """Number of runs of this process that their limit ended; a faster computer ends fewer."""

    def __init__(
        self, limit_s: float | None, noted: Callable[[], int], work_s: float | None = None
    ) -> None:
        """Begin to watch a run.

        Args:
            limit_s: Maximum duration [s]; None for no limit.
            noted: Returns the number of recorded items that will be written at the end.
            work_s: Maximum processor time [s] of this thread, which does not depend on what else
                the computer does, without that to load programs; None for no limit.
        """
        self._noted = noted
        self.cut_off = f"was cut off after {limit_s or 0.0:g} s on the computer's clock"
        """Predicate of messages about the run, or work after it, at the limit on the clock."""
        self._reason = f"the run {self.cut_off}"
        self._limit_s = math.inf if limit_s is None else limit_s
        self._ends_s = monotonic() + self._limit_s
        self._work_s = math.inf if work_s is None else work_s
        self._clock_of_work = _processor_clock(get_ident())
        self._work_ends_s = self._clock_of_work() + self._work_s
        """Processor time of the limit; infinite while a program is loaded."""
        self._is_over = False
        self._rests = Event()
        self._tasks: list[Ticking] = []
        self._lock = Lock()
        self._thread = get_ident()
        """The thread of the run."""
        self._at_work: int | None = None
        """The thread doing work that may be interrupted."""
        self._is_unresponsive = False
        """Whether the run was interrupted because nothing in it checked the flag."""
        self.is_needed = True
        """Set to False as soon as the run is over: in a call of `rest` an interrupt might arrive,
        and another one each second from then on."""
        if limit_s is not None or work_s is not None:
            Thread(target=self._watch, name="rapidsim --max-wall", daemon=True).start()

    @property
    def has_ended_the_run(self) -> bool:
        """Whether `check` has raised; from then on nothing long may begin."""
        return self._is_over and self._rests.is_set()

    @property
    def left_s(self) -> float:
        """Remaining time [s] of the run; infinite without a limit."""
        return max(0.0, self._ends_s - monotonic()) if self._limit_s < math.inf else math.inf

    def watch(self, task: Ticking) -> None:
        """Interrupt the loops of one more task at the limit."""
        self._tasks.append(task)

    def forget(self, task: Ticking) -> None:
        """Stop interrupting the loops of a task."""
        self._tasks.remove(task)

    def check(self) -> None:
        """End the run, once, if its limit is reached. Costs next to nothing.

        Raises:
            WallLimitReached: If the limit is reached.
        """
        if self._is_over and not self._rests.is_set():
            self._rests.set()
            raise WallLimitReached(self._reason)

    def end_run(self, reason: str) -> None:
        """End the run soon, as at its limit; a handler of signals may call it.

        Args:
            reason: The reason, as a sentence without its full stop.
        """
        # Not in this thread, which may hold the lock.
        self._reason = reason
        Thread(target=self._end, name="rapidsim Ctrl-C", daemon=True).start()

    @contextmanager
    def loading(self) -> Iterator[None]:
        """Leave out the processor time of the body of the context: it is that of a text's size."""
        left_s, self._work_ends_s = self._work_left_s, math.inf
        try:
            yield
        finally:
            self._work_ends_s = self._clock_of_work() + left_s

    @contextmanager
    def interrupting(self) -> Iterator[None]:
        """Interrupt the body of the context at the limit.

        Raises:
            WallLimitReached: If the body was interrupted.
        """
        self.check()
        self._at_work = get_ident()
        try:
            try:
                yield
            finally:
                self._no_longer()
        except _Interrupted:
            self.check()
            raise

    def rest(self) -> None:
        """Stop watching: the run is over."""
        with self._lock:
            self._rests.set()
        if self._is_unresponsive:
            # The exception may arrive as late as this.
            with suppress(_Interrupted):
                sleep(_AGAIN_S)

    @property
    def _work_left_s(self) -> float:
        ends_s = self._work_ends_s
        return ends_s - self._clock_of_work() if ends_s < math.inf else math.inf

    def _watch(self) -> None:
        while True:
            work_left_s = self._work_left_s
            if work_left_s <= 0.0:
                self._reason = f"the run was cut off after {self._work_s:g} s of processor time"
            writing_s = max(0.0, self._noted() * _WRITING_S - _FREE_S)
            runs_s = min(self.left_s, work_left_s) - writing_s
            if runs_s <= 0.0:
                break
            if self._rests.wait(min(runs_s, _LOOKS_S)) or not self.is_needed:
                return
        self._end()

    def _end(self) -> None:
        with self._lock:
            if self._is_over:
                return
            self._is_over = True
        Watchdog.runs_ended += 1
        interrupt_s = monotonic() + _PATIENCE_S
        while True:
            for task in self._tasks:
                task.ticks_left = NO_TICKS
            with COMPILING, self._lock:
                if self._rests.is_set() or not self.is_needed:
                    return
                if monotonic() > interrupt_s:
                    self._is_unresponsive = True
                    interrupt_s += _PATIENCE_S
                    _interrupt(self._thread)
                elif self._at_work is not None:
                    _interrupt(self._at_work)
                self._at_work = None
            if self._rests.wait(_AGAIN_S):
                return

    def _no_longer(self) -> None:
        """End interruptible work; an exception already raised arrives in here or before."""
        with self._lock:
            interrupted, self._at_work = self._at_work is None, None
        if interrupted and not isinstance(sys.exception(), _Interrupted):
            # An exception raised in this thread arrives by the end of the sleep. If none does, it
            # arrived earlier and was replaced by another; `check` ends the run then.
            sleep(_AGAIN_S)


def _processor_clock(thread: int) -> Callable[[], float]:
    """Return the clock [s] of a thread's processor time; of the process where threads have none."""
    if sys.platform != "linux":
        return time.process_time
    clock = time.pthread_getcpuclockid(thread)

    def spent_s() -> float:
        with suppress(OSError):
            return time.clock_gettime(clock)
        return math.inf  # The thread has ended.

    return spent_s


def _interrupt(thread: int) -> None:
    exception = ctypes.py_object(_Interrupted)
    ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread), exception)
