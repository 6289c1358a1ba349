"""Numbers on the command line: `1,2.5,-3`, with or without the brackets that RAPID writes."""

from __future__ import annotations

from collections.abc import Callable
from math import isfinite
from typing import Any, Final

import click

LARGEST: Final = 1e12
"""Largest magnitude of a number: a mm is a thousand-millionth of it, and its cube is finite."""


class NumberOption(click.FloatRange):
    """The type of an option that takes one finite number of a range."""

    name = "number"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> float:
        """Read it, and refuse what is not a number, infinite, huge or outside."""
        number = _number(str(value), str(value))
        return float(super().convert(number, param, ctx))


class _AnyNumber(click.types.FloatParamType):
    """The error message without a range, which click does not have."""

    name = "number"

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> float:
        return _number(str(value), str(value))


class _Processes(click.IntRange):
    """The type of an option that takes a number of processes."""

    name = "n|auto"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> int:
        """Read it; `auto` and 0 are one for each core."""
        if value in (0, "0", "auto"):
            # Few commands use one.
            from rapidsim.jobs.cache.processes import number_of_cores

            return number_of_cores()
        return int(super().convert(value, param, ctx))


PROCESSES = _Processes(1, 256)
ANY_NUMBER = _AnyNumber()
POSITIVE = NumberOption(min=0.0, min_open=True)


def numbers(*counts: int) -> Callable[[str], tuple[float, ...]]:
    """The type of an option that takes finite numbers with commas between.

    Args:
        counts: The permitted numbers of values; empty permits any.
    """

    def read(text: str) -> tuple[float, ...]:
        parts = text.replace("[", " ").replace("]", " ").strip().strip(",").split(",")
        found = tuple(_number(part.strip(), text) for part in parts)
        if counts and len(found) not in counts:
            wanted = " or ".join(map(str, counts))
            raise click.BadParameter(f"expected {wanted} numbers, got {len(found)}")
        return found

    return read


def _number(part: str, text: str) -> float:
    within = f" in `{text}`" if part != text else ""
    try:
        number = float(part)
    except ValueError:
        raise click.BadParameter(f"`{part}`{within} is not a number") from None
    if not isfinite(number):
        raise click.BadParameter(f"`{part}`{within} is not a finite number")
    if abs(number) > LARGEST:
        raise click.BadParameter(f"`{part}`{within} is beyond {LARGEST:g}")
    return number
