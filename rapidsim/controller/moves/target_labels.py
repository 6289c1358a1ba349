"""How findings name the target of a move: as the program writes it, where that is short."""

from __future__ import annotations

_LONGEST = 40
_LITERAL = "[[...]]"


def named_target(written: str) -> str:
    """The text of a target for a message.

    Of a long literal only its shape is left, so that generated programs, whose targets are all
    literals, have equal findings that can be merged.
    """
    text = " ".join(written.split())
    if len(text) <= _LONGEST:
        return text
    return _LITERAL if text.startswith("[") else f"{text[: _LONGEST - 3]}..."
