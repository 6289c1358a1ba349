"""Words of a text, including those in strings and comments."""

from __future__ import annotations

import re

_WORD = re.compile(r"[A-Za-z]\w*")
_CHUNK = 1_000_000
"""Characters whose words are listed at once; large programs repeat few words."""


def words_of(text: str) -> set[str]:
    """Return all possible names, folded."""
    found: set[str] = set()
    begin = 0
    while begin < len(text):
        end = text.find("\n", begin + _CHUNK) + 1 or len(text)
        found.update(map(str.lower, _WORD.findall(text, begin, end)))
        begin = end
    return found
