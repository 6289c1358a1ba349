"""Rules E1: what is wrong with the text of a program."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from rapidsim.diagnostics import Violation


@dataclass(frozen=True)
class SyntaxError_(Violation):  # noqa: N801
    """The text does not follow RAPID's syntax."""

    code: ClassVar[str] = "E101"
    name: ClassVar[str] = "syntax-error"
    template: ClassVar[str] = "{what}"

    what: str
