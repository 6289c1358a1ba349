"""Programs of moves with calls between them, in turn."""

from __future__ import annotations

import random
from collections.abc import Sequence
from itertools import cycle

from exports import export


def with_calls(calls: Sequence[str], count: int, every: int, path: str = "raster") -> str:
    """Return a program of `count` moves, with one of the texts before each of some moves.

    Args:
        calls: The texts, each of one line or more without line ends around.
        count: Number of moves; the first is a MoveJ, and the last one stops.
        every: Number of moves between two texts.
        path: Path of the moves.
    """
    texts = cycle(calls)
    lines = []
    moves = 0
    for line in export("inline", path, count).splitlines(keepends=True):
        if "Move" in line:
            if moves and moves % every == 0:
                lines += [f"    {call.strip()}\n" for call in next(texts).splitlines()]
            moves += 1
        lines.append(line)
    return "".join(lines)


def with_random_calls(calls: Sequence[str], count: int, dice: random.Random) -> str:
    """Return a program of `count` moves, with one of the texts before some, or again as before."""
    lines = list[str]()
    pattern = [dice.choice(range(len(calls) + 5)) for _ in range(dice.randrange(1, 8))]
    for line in export("inline", "tilted", count, dice.randrange(100)).splitlines(keepends=True):
        if "MoveL" in line:
            which = pattern[len(lines) % len(pattern)]
            if dice.random() < 0.03:
                which = dice.randrange(len(calls))
            if which < len(calls):
                lines += [f"    {call.strip()}\n" for call in calls[which].splitlines()]
        lines.append(line)
    return "".join(lines)
