"""What long work calls now and then, so that whoever asked for it can end it by raising."""

from __future__ import annotations

from collections.abc import Callable

Look = Callable[[], None]


def undisturbed() -> None:
    """Nobody wants to end it."""
