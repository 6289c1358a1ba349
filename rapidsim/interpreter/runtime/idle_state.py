"""Everything that determines what a task's program does next, as a comparable value.

If two such states are equal and the program only read from the controller in between, it will do
the same again.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator
from types import FrameType
from typing import Any

from rapidsim.interpreter.runtime.error_recovery import is_generated
from rapidsim.language.reference import Box

LEFT, TURNS = "_left", "_turns"
"""The variables of a routine whose loops count their ticks; see `codegen.local_ticks`."""
MOST_VALUES = 20_000
"""Values beyond which the state of a program is too much to compare now and then."""


class _TooMuchError(Exception):
    """There are more values than anybody would compare."""


def idle_state(
    module_data: Callable[[], Iterable[Any]], other_state: Callable[[], object]
) -> Iterator[object]:
    """The position of the program, and the values of its variables.

    Part by part, innermost routine first, because two states usually differ there: comparing a deep
    recursion then need not walk all of it. The last part is None if there is too much.

    Args:
        module_data: The cells and lists of all variables outside routines.
        other_state: What else counts, such as ERRNO.
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
    """The routines that run, each with its place and what it holds."""
    while frame is not None:
        if is_generated(frame):
            # How many ticks are left is no business of the program.
            data = (one for name, one in frame.f_locals.items() if name not in (LEFT, TURNS))
            values = tuple(_frozen(one, remaining) for one in data)
            yield id(frame), frame.f_lasti, values
        frame = frame.f_back


def _frozen(value: Any, remaining: list[int]) -> object:
    """A value that stays as it is; what is neither data nor a variable counts as itself."""
    remaining[0] -= 1
    if remaining[0] < 0:
        raise _TooMuchError
    if isinstance(value, Box):
        return id(value), _frozen(value.value, remaining)
    if isinstance(value, list):
        return id(value), tuple(_frozen(one, remaining) for one in value)
    return value
