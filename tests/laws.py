"""How many cases a law looks at: all it asks for in `ci`, a fifth in `fast`, more in `explore`.

Laws that say nothing look at Hypothesis' hundred in `ci`, at forty in `fast`.
"""

import os

from hypothesis import settings

PROFILE = os.environ.get("HYPOTHESIS_PROFILE", "fast")
_TIMES = {"fast": 0.2, "ci": 1.0, "explore": 5.0}
_LEAST = 5


def cases(asked: int) -> int:
    """How many cases of the number a law asks for."""
    return max(_LEAST, round(_TIMES[PROFILE] * asked))


def examples(asked: int = 100) -> settings:
    """The same for Hypothesis, on top of the profile."""
    return settings(max_examples=cases(asked))
