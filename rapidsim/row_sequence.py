"""Sequences over columns, the elements of which are created when they are needed."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator, Sequence
from typing import TypeVar, overload

Value = TypeVar("Value", covariant=True)


class RowSequence(Sequence[Value]):
    """A sequence that creates the element of a row; a slice is a tuple of such elements."""

    __slots__ = ()

    @abstractmethod
    def _element(self, row: int) -> Value:
        """Return the element of a row, from 0 on."""

    @overload
    def __getitem__(self, at: int) -> Value: ...
    @overload
    def __getitem__(self, at: slice) -> tuple[Value, ...]: ...

    def __getitem__(self, at: int | slice) -> Value | tuple[Value, ...]:
        """Return an element, or those of a slice."""
        if isinstance(at, slice):
            return tuple(map(self._element, range(len(self))[at]))
        return self._element(range(len(self))[at])

    def __iter__(self) -> Iterator[Value]:
        """Iterate over the elements."""
        return map(self._element, range(len(self)))
