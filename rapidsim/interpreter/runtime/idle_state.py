"""State that determines the further execution of a task's program, as a comparable value.

If two such states are equal and the program only read from the controller in between, it will
repeat the same execution.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator
from types import FrameType
from typing import Any

from rapidsim.interpreter.runtime.error_recovery import is_generated
from rapidsim.language.reference import Box

LEFT, TURNS = "_left", "_turns"
"""Variables of a routine whose loops count their ticks; see `codegen.local_ticks`."""
MOST_VALUES = 20_000
"""Number of values beyond which the state of a program is too large to compare repeatedly."""


class _TooMuchError(Exception):
    """The state has too many values to compare."""


def idle_state(
    module_data: Callable[[], Iterable[Any]], other_state: Callable[[], object]
) -> Iterator[object]:
    """Yield the position of the program, and the values of its variables.

    The parts begin with the innermost routine, because two states usually differ there: comparing a
    deep recursion then need not visit all of it. The last part is None if the state is too large.

    Args:
        module_data: Returns the cells and lists of all variables outside routines.
        other_state: Returns the remaining state, such as ERRNO.
    """
    left = [MOST_VALUES]
    try:
        yield from _frames(sys._getframe(1), left)
        for home in module_data():
            yield _frozen(home, left)
        yield other_state()
    except _TooMuchError:
        yield None


def _frames(frame: FrameType | None, remaining: list[int]) -> Iterator[object]:
    """Yield the running routines, each with its position and its variables."""
    while frame is not None:
        if is_generated(frame):
            # Exclude the tick counter from the program state.
            data = (one for name, one in frame.f_locals.items() if name not in (LEFT, TURNS))
            values = tuple(_frozen(one, remaining) for one in data)
            yield id(frame), frame.f_lasti, values
        frame = frame.f_back


def _frozen(value: Any, remaining: list[int]) -> object:
    """Immutable copy of a value; an object that is neither data nor a variable is kept as it is."""
    remaining[0] -= 1
    if remaining[0] < 0:
        raise _TooMuchError
    if isinstance(value, Box):
        return id(value), _frozen(value.value, remaining)
    if isinstance(value, list):
        return id(value), tuple(_frozen(one, remaining) for one in value)
    return value
