"""Text tables of the controller, which all tasks share."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol


class Texts(Protocol):
    """Texts by table and number."""

    def install_texts(self, name: str, texts: Mapping[int, str]) -> None:
        """Keep a table of texts."""
        ...

    def text_table(self, name: str) -> int | None:
        """The number of a table, by its name; None if there is none."""
        ...

    def table_text(self, table: float, index: float) -> str | None:
        """A text of a table, by numbers; None if there is none."""
        ...
