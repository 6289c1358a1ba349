"""Numbers from outside that our kinematics, paths and figures are compared with.

A file a chapter in `tests/reference_numbers/`, each with its `source`: where its robot comes from,
and how the numbers were computed, by programs that share nothing with ours.
"""

import json
from functools import cache
from pathlib import Path
from typing import Any

_FOLDER = Path(__file__).with_suffix("")


@cache
def recorded(chapter: str) -> dict[str, Any]:
    """A chapter of the recorded numbers."""
    text = (_FOLDER / f"{chapter}.json").read_text(encoding="utf-8")
    loaded: dict[str, Any] = json.loads(text)
    return loaded
