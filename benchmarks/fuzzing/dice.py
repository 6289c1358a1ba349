"""Chance that repeats: all that is drawn follows from a seed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from random import Random
from typing import TypeVar

T = TypeVar("T")


class Dice(Random):
    """Draws what a program is made of; `oddness` is how often that is an odd thing."""

    def __init__(self, seed: str) -> None:
        """Start from a seed; how odd the program gets is drawn first."""
        super().__init__(seed)
        self.oddness = self.choice((0.0, 0.02, 0.1, 0.3))

    def of(self, things: Sequence[T]) -> T:
        """One of several things."""
        return self.choice(things)

    def chance(self, probability: float) -> bool:
        """Whether something happens that happens so often."""
        return self.random() < probability

    def odd(self) -> bool:
        """Whether the next thing is to be an odd one."""
        return self.chance(self.oddness)

    def weighed(self, weights: Mapping[T, float]) -> T:
        """One of several things, as often as its weight says."""
        return self.choices(tuple(weights), tuple(weights.values()))[0]
