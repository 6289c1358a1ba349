"""Persistents that the controller keeps equal to a condition: cyclic bools."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from rapidsim.language.reference import Reference


class CyclicBools(Protocol):
    """The cyclic bools of a task."""

    def set_up(
        self, name: str, flag: Reference[bool], condition: Callable[[], bool], signal: str | None
    ) -> None:
        """Keep a persistent, and an output if one is named, equal to a condition from now on.

        Args:
            name: Of the persistent, as the program writes it.
            flag: The persistent.
            condition: Of signals and persistents.
            signal: An output that follows.
        """
        ...

    def remove(self, name: str) -> None:
        """Stop updating a persistent; its name ignores case."""
        ...

    def names(self) -> tuple[str, ...]:
        """The persistents that are updated, in the order of setting up."""
        ...
