"""State of the abstract interpreter at a statement, and its join where control-flow paths meet."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Final

from rapidsim.analysis.evaluation import Known, NotStatic
from rapidsim.analysis.program import RoutineSymbol, Symbol
from rapidsim.reach.dataflow.motion_settings import KnownSettings

_MISSING = object()
BEGINNING: Final = -1
"""Value in place of the index of a move: no move has been made yet."""


@dataclass(slots=True)
class State:
    """Abstract state before a statement."""

    values: dict[Symbol, Known] = field(default_factory=dict)
    """Data whose values differ, or may differ, from those at the entry."""
    settings: KnownSettings = field(default_factory=KnownSettings)
    last: int | None = None
    """Index of the move at whose end the robot is, or BEGINNING; None if unknown."""
    alive: bool = True
    """Whether the statement is reachable."""

    def copy(self) -> State:
        """Return an independent copy."""
        return State(dict(self.values), self.settings, self.last, self.alive)

    def forget(self, symbols: Iterable[Symbol], reason: str) -> None:
        """Forget the values of data; `reason` is a format string for the name of each."""
        for symbol in symbols:
            self.values[symbol] = NotStatic(reason.format(name=symbol.name))

    def without(self, symbols: frozenset[Symbol]) -> State:
        """Return the state after the data of a routine have gone out of scope."""
        kept = {symbol: value for symbol, value in self.values.items() if symbol not in symbols}
        return State(kept, self.settings, self.last, self.alive)


def joined(states: Iterable[State]) -> State:
    """Join the states of several paths; those that end before are ignored.

    If all of them end before, the data keep their values at the ends: the statements that follow
    are examined, too.
    """
    every = list(states)
    first, *others = [way for way in every if way.alive] or every
    result = first.copy()
    for other in others:
        for symbol in {**result.values, **other.values}:
            a = result.values.get(symbol, _MISSING)
            b = other.values.get(symbol, _MISSING)
            if a is not b and (a is _MISSING or b is _MISSING or type(a) is not type(b) or a != b):
                result.values[symbol] = NotStatic(
                    f"`{symbol.name}` depends on the way the program takes"
                )
        result.settings = result.settings.joined(other.settings)
        if result.last != other.last:
            result.last = None
    return result


@dataclass(eq=False)
class AbstractFrame:
    """Abstract frame of a routine that is being interpreted."""

    routine: RoutineSymbol
    returns: list[State] = field(default_factory=list)
    results: list[Known] = field(default_factory=list)
    jumps: dict[str, State] = field(default_factory=dict)
    """States that GOTO has sent to labels ahead, by folded label."""
    off_path: int = 0
    """Above 0 while interpreting statements of the routine that the current path does not reach."""

    def jump(self, label: str, state: State) -> None:
        """Send a state to a label ahead."""
        self.jumps[label] = self.arriving(label, state).copy()

    def arriving(self, label: str, state: State) -> State:
        """Return the join of a state with those sent to a label, which are then no longer kept."""
        sent = self.jumps.pop(label, None)
        return state if sent is None else joined([sent, state])
