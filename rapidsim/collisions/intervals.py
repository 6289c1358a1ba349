"""Pairs of bodies between two instants, and bounds on their gaps there."""

from __future__ import annotations

from dataclasses import fields

import numpy as np

from rapidsim.collisions.convex import Index, Mask
from rapidsim.frames.transform import Array
from rapidsim.values import value_class


@value_class(frozen=True, slots=True, eq=False)
class PairIntervals:
    """Pairs (k,) between two instants."""

    pair: Index
    start: Index
    end: Index
    """Indices of the instants."""
    gap_start: Array
    gap_end: Array
    """Lower bounds [m] of the gaps at start and end."""
    seen_start: Mask
    seen_end: Mask
    """Whether the gap was measured as far as it is relevant."""
    bend: Array
    """Bound on the relative acceleration [m/s2] of both bodies, within a step."""
    floor: Array
    """Lower bound [m] of the gap within, by a plane between the bodies; -inf without one."""
    has_plane: Mask
    """Whether such a plane was looked for."""

    @property
    def seen(self) -> Mask:
        """Mask of intervals with both ends measured."""
        both: Mask = self.seen_start & self.seen_end
        return both

    def rows(self, at: Index | Mask) -> PairIntervals:
        """Return a subset of the intervals."""
        return PairIntervals(*(getattr(self, name)[at] for name in _NAMES))

    def and_also(self, *others: PairIntervals) -> PairIntervals:
        """Return these intervals followed by others."""
        every = (self, *others)
        return PairIntervals(*(np.concatenate([getattr(one, n) for one in every]) for n in _NAMES))


_NAMES = tuple(one.name for one in fields(PairIntervals))


def unseen(
    pair: Index, start: Index, end: Index, gap_start: Array, gap_end: Array
) -> PairIntervals:
    """Return intervals whose ends have not been measured."""
    count = len(pair)
    no, bend, floor = np.zeros(count, dtype=np.bool_), np.zeros(count), np.full(count, -np.inf)
    return PairIntervals(pair, start, end, gap_start, gap_end, no, no, bend, floor, no)
