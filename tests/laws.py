"""How many cases a law looks at: all it asks for in `ci`, a sixteenth in `fast`, more in `explore`.

Laws that say nothing look at Hypothesis' hundred in `ci`, at eight in `fast`.
"""

import os
from collections.abc import Sequence
from typing import TypeVar

from hypothesis import settings

PROFILE = os.environ.get("HYPOTHESIS_PROFILE", "fast")
_TIMES = {"fast": 0.0625, "ci": 1.0, "explore": 5.0}
_LEAST = 4
_T = TypeVar("_T")


def cases(asked: int) -> int:
    """How many cases of the number a law asks for."""
    return max(_LEAST, round(_TIMES[PROFILE] * asked))


def examples(asked: int = 100) -> settings:
    """The same for Hypothesis, on top of the profile."""
    return settings(max_examples=cases(asked))


def some(asked: Sequence[_T], every: int) -> Sequence[_T]:
    """Of many that are much alike: all, in `fast` one of each `every`."""
    return asked[::every] if PROFILE == "fast" else asked


def in_turn(ways: Sequence[_T], turn: int, few: int) -> Sequence[_T]:
    """Of the ways in which each of many is asked: all, in `fast` a few, others each turn."""
    if PROFILE != "fast":
        return ways
    return [ways[(turn + number) % len(ways)] for number in range(few)]
