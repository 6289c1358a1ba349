"""Memory of the arrays of routines that are being called.

A routine that calls itself has its arrays as often as it is active. Their bytes are counted while
their frames are on the stack; beyond the limit of declared arrays the stack overflows.
"""

from __future__ import annotations

import sys
from types import CodeType, FrameType
from typing import Any, Final

from rapidsim.interpreter.limits import MAX_ARRAY_BYTES, array_bytes
from rapidsim.interpreter.runtime.arrays import copy_array
from rapidsim.values import value_class

LEAST_COUNTED: Final = 200
"""Elements below which an array is not counted: at the greatest depth it takes 64 MB."""


@value_class(slots=True)
class _ActiveCall:
    """A call of a routine with large arrays."""

    frame: int
    """Identity of its frame, which another frame may have when the call has ended."""
    code: CodeType
    sizes: dict[str, int]
    """Bytes of its arrays by name."""


class LocalArrays:
    """Counter of the memory of one task's local arrays."""

    def __init__(self) -> None:
        """Begin without active calls."""
        self._calls: list[_ActiveCall] = []
        self._numbers: dict[int, int] = {}
        """Positions of calls by the identity of their frames."""
        self._bytes = 0

    def copy(self, array: list[Any], name: str) -> list[Any]:
        """Return a new array for the call that requests it.

        Args:
            array: Initial values.
            name: Name of the variable.

        Raises:
            RecursionError: If the arrays of all active calls take too much memory.
        """
        frame = sys._getframe(1)
        self._forget_ended(frame)
        if not self._calls or self._calls[-1].frame != id(frame):
            self._numbers[id(frame)] = len(self._calls)
            self._calls.append(_ActiveCall(id(frame), frame.f_code, {}))
        sizes = self._calls[-1].sizes
        size = array_bytes(array)
        self._bytes += size - sizes.get(name, 0)
        sizes[name] = size
        if self._bytes > MAX_ARRAY_BYTES:
            raise RecursionError
        return copy_array(array)

    def _forget_ended(self, frame: FrameType) -> None:
        """Drop calls that are not on the stack; the nearest one is usually the caller."""
        above: FrameType | None = frame
        active = 0
        while above is not None:
            number = self._numbers.get(id(above))
            if number is not None and self._calls[number].code is above.f_code:
                active = number + 1
                break
            above = above.f_back
        for call in self._calls[active:]:
            self._bytes -= sum(call.sizes.values())
            del self._numbers[call.frame]
        del self._calls[active:]
