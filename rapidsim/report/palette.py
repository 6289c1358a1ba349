"""The few colours of terminal output, by what they mean.

Findings are coloured with these plain escape codes and not with rich: `rapidsim check` on a small
file shall start fast.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import fields

from rapidsim.diagnostics import Severity
from rapidsim.values import value_class

_RESET = "\x1b[0m"


@value_class(frozen=True, slots=True)
class Palette:
    """Escape codes; empty strings give plain text."""

    error: str = ""
    warning: str = ""
    note: str = ""
    frame: str = ""
    """Line numbers and rules around source text."""
    strong: str = ""
    help: str = ""

    def paint(self, text: str, code: str) -> str:
        """The text in a colour of this palette."""
        return f"{code}{text}{_RESET}" if code and text else text

    def map_plain_text(self, change: Callable[[str], str], text: str) -> str:
        """A painted text with everything changed but the codes of this palette."""
        codes = {one for field in fields(self) if (one := getattr(self, field.name))}
        if not codes:
            return change(text)
        pieces = re.split(f"({'|'.join(map(re.escape, sorted(codes | {_RESET})))})", text)
        return "".join(
            piece if number % 2 else change(piece) for number, piece in enumerate(pieces)
        )

    def of(self, severity: Severity) -> str:
        """The colour of a severity."""
        match severity:
            case Severity.ERROR:
                return self.error
            case Severity.WARNING:
                return self.warning
            case Severity.NOTE:
                return self.note


PLAIN = Palette()
COLOURED = Palette(
    error="\x1b[1;31m",
    warning="\x1b[1;33m",
    note="\x1b[1;36m",
    frame="\x1b[34m",
    strong="\x1b[1m",
    help="\x1b[32m",
)
