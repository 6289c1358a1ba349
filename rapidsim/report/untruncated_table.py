"""A table whose cells are never cut: wider than a narrow terminal rather than without digits."""

from __future__ import annotations

from rich.console import Console, ConsoleOptions, RenderResult
from rich.measure import Measurement
from rich.table import Table

_ANY_WIDTH = 1000


class UntruncatedTable(Table):
    """A table of numbers and names. Where it does not fit, the terminal wraps whole lines.

    A column that may wrap is narrowed instead, as in any table.
    """

    @classmethod
    def without_lines(cls, padding: int = 2) -> UntruncatedTable:
        """An empty one: nothing but space between columns, so much of it."""
        return cls(box=None, padding=(0, padding, 0, 0), pad_edge=False, header_style="cyan")

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        """Draw as wide as the cells are."""
        if all(column.no_wrap for column in self.columns):
            needed = Measurement.get(console, options.update(max_width=_ANY_WIDTH), self).maximum
            options = options.update(max_width=max(options.max_width, needed))
        yield from super().__rich_console__(console, options)
