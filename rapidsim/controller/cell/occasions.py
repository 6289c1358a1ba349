"""When something from outside a program happens: at a time, or after a condition became true."""

from __future__ import annotations

from itertools import count
from typing import Annotated

from rapidsim.controller.cell.conditions import Condition
from rapidsim.json_records.declarations import (
    AboveZero,
    Excludes,
    Key,
    Needs,
    NotNegative,
    Valid,
)
from rapidsim.values import value_class

_LEAST_PERIOD_S = 0.001


def _is_period(every_s: float) -> bool:
    return every_s >= _LEAST_PERIOD_S


@value_class(frozen=True, slots=True, kw_only=True)
class Occasion:
    """The times at which something happens."""

    at_s: Annotated[NotNegative | None, Key("at")] = None
    """Virtual time of the first occurrence."""
    every_s: Annotated[
        AboveZero | None,
        Key("every"),
        Valid(_is_period, f"at least {_LEAST_PERIOD_S:g} s is needed"),
    ] = None
    """Time from one occurrence to the next; None if it happens once."""
    when: Condition | None = None
    """In place of a time: the condition that causes it each time that it becomes true."""
    after_s: Annotated[
        NotNegative, Key("after"), Needs("when", "it needs `when`; with the clock, use `at`")
    ] = 0.0
    """Delay after the condition became true."""
    nth: Annotated[
        tuple[int, ...],
        Excludes("skip", "give `nth`, the times that it acts, or `skip`, those that it does not"),
    ] = ()
    """Occurrences at which it acts, the first is 1; empty for all."""
    skip: tuple[int, ...] = ()
    """Occurrences at which it does not act."""

    def first_that_acts(self, occurrence: int) -> int | None:
        """The first occurrence from one on at which it acts; None if there is none."""
        if self.nth:
            return min((one for one in self.nth if one >= occurrence), default=None)
        return next(one for one in count(occurrence) if one not in self.skip)
