"""What ends a run from outside the program."""

from __future__ import annotations

from rapidsim.language.errors import Stopped


class TimeLimitReached(Stopped):
    """Virtual time reached `--max-time`."""


class WaitsForever(Stopped):
    """The program waits for something that cannot happen."""
