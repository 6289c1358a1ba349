"""Text that is wrapped between words, and never between a number and its unit."""

from __future__ import annotations

from rich.console import Console, ConsoleOptions, RenderResult
from rich.measure import Measurement
from rich.text import Text

from rapidsim.report.quantities import joined, parted


class UnbreakableUnits:
    """A text whose quantities stay whole."""

    def __init__(self, text: Text | str) -> None:
        """Take a text with its styles."""
        self._text = Text(text) if isinstance(text, str) else text

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        """Break lines as wide as there is room."""
        text = self._text.copy()
        text.plain = joined(text.plain)
        for line in text.wrap(console, options.max_width):
            line.plain = parted(line.plain)
            yield line

    def __rich_measure__(self, console: Console, options: ConsoleOptions) -> Measurement:
        """Width of the text in cells."""
        return Measurement.get(console, options, self._text)
