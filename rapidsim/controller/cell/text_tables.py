"""The text tables that programs have installed."""

from __future__ import annotations

from collections.abc import Mapping

FIRST_TABLE = 1
"""Number of the first table; a program only gets numbers from TextTabGet."""


class TextTables:
    """Texts by table and number; names of tables are case-sensitive, as file names are."""

    def __init__(self) -> None:
        """Start without tables."""
        self._numbers: dict[str, int] = {}
        self._texts: dict[tuple[float, float], str] = {}

    def install(self, name: str, texts: Mapping[int, str]) -> None:
        """Add a table."""
        number = self._numbers[name] = FIRST_TABLE + len(self._numbers)
        self._texts |= {(number, index): text for index, text in texts.items()}

    def number(self, name: str) -> int | None:
        """Number of a table; None if no table has that name."""
        return self._numbers.get(name)

    def text(self, table: float, index: float) -> str | None:
        """A text; None if it does not exist."""
        return self._texts.get((table, index))
