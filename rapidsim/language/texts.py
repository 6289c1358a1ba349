"""Text tables of the controller, which all tasks share."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol


class Texts(Protocol):
    """Texts by table and number."""

    def install_texts(self, name: str, texts: Mapping[int, str]) -> None:
        """Install a table of texts."""
        ...

    def text_table(self, name: str) -> int | None:
        """Number of a table, by its name; None if it does not exist."""
        ...

    def table_text(self, table: float, index: float) -> str | None:
        """Text of a table, by numbers; None if it does not exist."""
        ...
