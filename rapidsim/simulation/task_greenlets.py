"""Greenlets of tasks, with enough frames of C that are their own.

NumPy looks at the ten innermost frames of C before it adds large arrays in place (`backtrace` of
the C library). What lies beyond the first frame of a greenlet is not of its stack: to unwind it may
end the process. Python calls Python without a frame of C, so a task has few: it begins with more.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from greenlet import greenlet

_CALLS = 5
"""Number of calls through C, each of which has several frames."""


def task_greenlet(body: Callable[[], None]) -> greenlet:
    """Return a greenlet that runs the body of a task."""
    return greenlet(partial(_enter, body, _CALLS))


def _enter(body: Callable[[], None], calls: int) -> None:
    if calls:
        # Not directly: `map` calls it from C.
        list(map(_enter, (body,), (calls - 1,)))
    else:
        body()
