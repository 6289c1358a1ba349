"""Relative travel of pairs of bodies between the instants of a motion.

Between two instants a body moves no farther than it shifts and turns, and deviates from the
straight path by no more than its acceleration allows. Over many instants distances add up.

Accelerations are estimated from the instants, doubled, taking the largest of some neighbours.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from rapidsim.collisions.bounds import Bounds, turned
from rapidsim.collisions.convex import Index
from rapidsim.collisions.scene import Poses, Scene
from rapidsim.frames.transform import Array

_SAFETY = 2.0
_NEIGHBOURS = 2
_BRIEF = 4
"""Number of instants below which the steps before and after a move count as well."""
_STIRS_M = 1e-6
"""Relative travel [m] in a move below which two bodies are at rest against each other."""
_LEVELS = 5
"""Exponent of the longest interval in steps, plus one."""
LONGEST = 2 ** (_LEVELS - 1)
"""Number of steps of the longest interval."""


class Travel:
    """Relative travel of all pairs over the steps of a block."""

    def __init__(self, scene: Scene, bounds: Bounds, poses: Poses, pairs: Index) -> None:
        """Sum up the travel of some pairs (k,); those of one body with static ones share it."""
        columns: dict[tuple[int, int], int] = {}
        self._column: Index = np.zeros(len(scene.pairs), dtype=np.int64)
        for number in pairs.tolist():
            pair = scene.pairs[number]
            other = -1 if scene.bodies[pair.second].is_static else pair.second
            self._column[number] = columns.setdefault((pair.first, other), len(columns))
        count = len(poses.times)
        step = np.diff(poses.times)[:, None]
        self._way = np.zeros((count, len(columns)))
        shift, turn = np.empty((2, count - 1, len(columns)))
        pull = np.zeros((count, len(columns)))
        for (first, second), column in columns.items():
            seen = poses.of(first) if second < 0 else poses.seen(first, second)
            centre = seen.apply(bounds.centre[first])
            shift[:, column] = np.linalg.norm(np.diff(centre, axis=0), axis=1)
            turn[:, column] = bounds.bound[first] * turned(seen.rotation[1:], seen.rotation[:-1])
            if count > 2:
                pull[1:-1, column] = np.linalg.norm(_second(centre, step), axis=1)
                twist = _second(seen.rotation.reshape(-1, 9), step)
                pull[1:-1, column] += bounds.bound[first] * np.linalg.norm(twist, axis=1) / 2**0.5
        np.cumsum(shift + turn, axis=0, out=self._way[1:])
        wide = np.pad(pull, ((_NEIGHBOURS, _NEIGHBOURS), (0, 0)), mode="edge")
        around = [wide[at : at + count - 1] for at in range(2 * _NEIGHBOURS + 2)]
        self._bend = _SAFETY * np.maximum.reduce(around) + 0.1 * pull.max(axis=0)
        self._stirs = [
            _stirring(poses.moves[:, robot], self._way) for robot in range(poses.moves.shape[1])
        ]
        slack = self._bend * (step**2 / 8.0)
        # Maximum over 1, 2, 4 ... steps from each instant on.
        self._slacks = np.zeros((_LEVELS, count, len(columns)))
        self._slacks[0, :-1] = slack
        for level in range(1, _LEVELS):
            half = 2 ** (level - 1)
            here, below = self._slacks[level], self._slacks[level - 1]
            here[:] = below
            np.maximum(here[:-half], below[half:], out=here[:-half])

    def between(self, pair: Index, start: Index, end: Index) -> Array:
        """Return distances (k,) [m] that pairs move between instants."""
        column = self._column[pair]
        moved: Array = self._way[end, column] - self._way[start, column]
        return moved

    def slack(self, pair: Index, start: Index, end: Index) -> Array:
        """Return the largest deviations (k,) [m] from lines in the steps between instants."""
        column, level = self._column[pair], np.log2(end - start + 0.5).astype(np.int64)
        slack: Array = np.maximum(
            self._slacks[level, start, column], self._slacks[level, end - 2**level, column]
        )
        return slack

    def stirs(self, pair: Index, owner: Index, move: Index) -> npt.NDArray[np.bool_]:
        """Mask of pairs (k,) whose bodies move against each other in moves of robots."""
        found = np.ones(len(pair), dtype=np.bool_)
        for robot, (moves, stirs) in enumerate(self._stirs):
            rows = np.flatnonzero(owner == robot)
            at = np.minimum(np.searchsorted(moves, move[rows]), len(moves) - 1)
            known = moves[at] == move[rows]
            found[rows[known]] = stirs[at[known], self._column[pair[rows[known]]]]
        return found

    def bend(self, pair: Index, step: Index) -> Array:
        """Return accelerations (k,) [m/s2] of one body relative to the other."""
        found: Array = self._bend[step, self._column[pair]]
        return found


def _stirring(move: Index, travel: Array) -> tuple[Index, npt.NDArray[np.bool_]]:
    """Return the moves (m,) at instants (k,), and in which of them columns stir (m, c)."""
    moves, at = np.unique(move, return_inverse=True)
    steps, total = np.diff(travel, axis=0), np.zeros((len(moves), travel.shape[1]))
    within = at[1:] == at[:-1]
    np.add.at(total, at[1:][within], steps[within])
    brief = np.bincount(at) < _BRIEF
    for end in (at[1:], at[:-1]):
        of_brief = brief[end]
        np.add.at(total, end[of_brief], steps[of_brief])
    return moves, total > _STIRS_M


def _second(values: Array, step: Array) -> Array:
    """Return second derivatives of values (k, n) at the instants between steps (k - 1, 1)."""
    rate = np.diff(values, axis=0) / step
    found: Array = 2.0 * np.diff(rate, axis=0) / (step[1:] + step[:-1])
    return found
