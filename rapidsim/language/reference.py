"""Data passed by reference: whatever has a `value`.

A routine never knows what it was given: a variable's cell, an array element, a record component.
"""

from __future__ import annotations

from typing import Generic, Protocol, TypeVar

T = TypeVar("T")


class Reference(Protocol[T]):
    """Data that a routine may read and write."""

    value: T


class Box(Generic[T]):
    """One variable: a reference that holds its value itself."""

    __slots__ = ("value",)

    def __init__(self, value: T) -> None:
        """Start with a value."""
        self.value = value

    def __repr__(self) -> str:
        """For debuggers."""
        return f"Box({self.value!r})"
