"""Parallel map over several processes, with results in the order of the items."""

from __future__ import annotations

import os
import signal
import traceback
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from functools import partial
from multiprocessing import active_children, get_context
from pathlib import Path
from typing import Generic, TypeVar

from rapidsim.files import InputError
from rapidsim.values import value_class

_Thing = TypeVar("_Thing")
_Result = TypeVar("_Result")


class DefectError(Exception):
    """A defect of rapidsim as one process reports it to another: description and position."""

    def __init__(self, subject: str, place: str, report: str) -> None:
        """Store a one-line description, file and line, and the traceback."""
        super().__init__(subject, place, report)
        self.what = subject
        self.place = place
        self.report = report


def number_of_cores() -> int:
    """Return the number of processes that can run at the same time."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def in_processes(
    work: Callable[[_Thing], _Result],
    things: Sequence[_Thing],
    processes: int,
    *,
    begin: Callable[[], object] | None = None,
    at_once: int = 1,
) -> Iterator[_Result]:
    """Yield the result for each item, in order; an error in one process ends all.

    Args:
        work: A function of a module, as other processes find it by name.
        things: Arguments of the function, one per result.
        processes: Largest number of processes; with one the work is done in this process.
        begin: Called once in each process, before the work.
        at_once: Number of items that a process receives at a time.

    Raises:
        InputError: If `work` raises it; so are errors of the system (OSError, MemoryError).
        DefectError: If a process failed.
    """
    processes = min(processes, -(-len(things) // at_once))
    if processes < 2:
        if begin is not None:
            begin()
        yield from map(work, things)
        return
    others = frozenset(active_children())
    # A fresh process has no threads or locks of this one, and is the same on every system.
    pool = ProcessPoolExecutor(
        processes, get_context("spawn"), initializer=_begin, initargs=(begin,)
    )
    try:
        with _started_deaf():
            answers = pool.map(partial(_answer, work), things, chunksize=at_once)
        for answer in answers:
            yield answer.result()
    except BrokenProcessPool:
        what = "a process ended without an answer: killed, or out of memory"
        raise DefectError(what, "?", what) from None
    except BaseException:
        # Discard the other workers' results.
        for process in frozenset(active_children()) - others:
            process.terminate()
        raise
    finally:
        pool.shutdown(cancel_futures=True)


# Ctrl-C reaches all processes of a terminal; the parent reports it, and ends the others.
@contextmanager
def _started_deaf() -> Iterator[None]:
    """Start processes that ignore Ctrl-C from their first instant, if the system supports it."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _begin(begin: Callable[[], object] | None) -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if begin is not None:
        begin()


@value_class(frozen=True, slots=True, eq=False)
class _Answer(Generic[_Result]):
    """Outcome of the work: a value, or the error that it raised."""

    value: _Result | None
    error: InputError | OSError | MemoryError | DefectError | None = None

    def result(self) -> _Result:
        """Return the value.

        Raises:
            InputError: If the work raised it; so are errors of the system (OSError, MemoryError).
            DefectError: If it raised any other error.
        """
        if self.error is not None:
            raise self.error
        return self.value  # type: ignore[return-value]


def _answer(work: Callable[[_Thing], _Result], thing: _Thing) -> _Answer[_Result]:
    try:
        return _Answer(work(thing))
    except (InputError, OSError, MemoryError) as error:
        return _Answer(None, error)
    except (KeyboardInterrupt, SystemExit):
        raise
    except BaseException as error:
        # Exceptions that end a run are no `Exception`; one that arrives here is a defect, too.
        return _Answer(None, defect_of(error))


def defect_of(error: BaseException) -> DefectError:
    """Convert an exception, perhaps of another process, to a `DefectError`."""
    if isinstance(error, DefectError):
        return error
    frames = traceback.extract_tb(error.__traceback__)
    place = f"{Path(frames[-1].filename).name}:{frames[-1].lineno}" if frames else "?"
    what = f"{type(error).__name__}: {error}".splitlines()[0]
    return DefectError(what, place, "".join(traceback.format_exception(error)))
