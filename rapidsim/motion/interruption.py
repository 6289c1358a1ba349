"""Callback that long computations call regularly; the caller can end them by raising."""

from __future__ import annotations

from collections.abc import Callable

Look = Callable[[], None]


def undisturbed() -> None:
    """Never interrupt: the default callback."""
