"""Dates on the command line: `2025-03-01`, with a time of day if there is one."""

from __future__ import annotations

from datetime import datetime
from typing import Any

import click

_EXAMPLE = "2025-03-01 or 2025-03-01T06:00:00"


class Date(click.DateTime):
    """The type of an option that takes a date, with or without a time of day."""

    name = "date"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> datetime:
        """Parse a date of ISO 8601; without a time zone, which a controller's clock lacks."""
        try:
            date = datetime.fromisoformat(str(value))
        except ValueError:
            self.fail(f"`{value}` is not a date such as {_EXAMPLE}", param, ctx)
        if date.tzinfo is not None:
            self.fail(f"`{value}` has a time zone; write it as {_EXAMPLE}", param, ctx)
        return date
