"""Names of move targets in findings: the text of the program, if it is short."""

from __future__ import annotations

_LONGEST = 40
_LITERAL = "[[...]]"


def named_target(written: str) -> str:
    """The text of a target for a message.

    A long literal is reduced to its shape, so that generated programs, whose targets are all
    literals, have equal findings that can be merged.
    """
    text = " ".join(written.split())
    if len(text) <= _LONGEST:
        return text
    return _LITERAL if text.startswith("[") else f"{text[: _LONGEST - 3]}..."
