"""Commands that are broken off from outside: they tidy up, and say how far they were."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager


class Terminated(BaseException):
    """SIGTERM: like Ctrl-C, it unwinds, so that no half file is left."""


@contextmanager
def told_if_broken_off(so_far: Callable[[], str]) -> Iterator[None]:
    """Say how far the work in here was if Ctrl-C or SIGTERM breaks it off.

    Args:
        so_far: Tells it, in words to follow `interrupted` or `terminated`.
    """
    try:
        yield
    except (KeyboardInterrupt, Terminated) as broken_off:
        broken_off.args = (so_far(),)
        raise
