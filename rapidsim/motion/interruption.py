"""A callback that long computations call now and then; the caller can end them by raising."""

from __future__ import annotations

from collections.abc import Callable

Look = Callable[[], None]


def undisturbed() -> None:
    """The callback that never interrupts."""
