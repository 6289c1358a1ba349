"""Data passed by reference: any object with a `value`.

A routine is independent of the kind of its argument: variable, array element, record component.
"""

from __future__ import annotations

from typing import Generic, Protocol, TypeVar

T = TypeVar("T")


class Reference(Protocol[T]):
    """Data that a routine may read and write."""

    value: T


class Box(Generic[T]):
    """One variable: a reference that stores its value itself."""

    __slots__ = ("value",)

    def __init__(self, value: T) -> None:
        """Start with a value."""
        self.value = value

    def __repr__(self) -> str:
        """For debuggers."""
        return f"Box({self.value!r})"
