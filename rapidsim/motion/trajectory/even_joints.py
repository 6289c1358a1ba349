"""Joints of a command in parts of equal width, which all that samples a whole run has in common."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

import numpy as np
import numpy.typing as npt

from rapidsim.frames.transform import Array

PART_S: Final = 0.008
"""Width [s] of a part."""
PLACES: Final[Array] = 0.5 * (np.polynomial.legendre.leggauss(3)[0] + 1.0)
"""Instants in each part, as shares of it: enough for 1e-6 rad."""
_MOST_PARTS = 500_000
"""Number of parts that are stored, those of the first hour: 72 MB for an arm of six axes."""


class EvenJoints:
    """Joints at the places of parts, each computed once."""

    def __init__(self, end_s: float) -> None:
        """Begin with none of a command that ends at a time [s]."""
        self._count = min(int(end_s / PART_S) + 2, _MOST_PARTS)
        self._stored = np.zeros((0, 0, 0))
        self._is_stored = np.zeros(self._count, dtype=np.bool_)

    def at(self, part: npt.NDArray[np.int64], joints_at: Callable[[Array], Array]) -> Array:
        """Return the joints (k, places, n) in parts (k,), counted from time 0.

        Args:
            part: The parts.
            joints_at: Joints (m, n) of the command at instants (m,) [s].
        """
        inside = (part >= 0) & (part < self._count)
        known = inside.copy()
        known[inside] = self._is_stored[part[inside]]
        new = np.flatnonzero(~known)
        if not len(new):
            return self._stored[part]
        found = joints_at((PART_S * part[new, None] + PART_S * PLACES).ravel())
        found = found.reshape(len(new), len(PLACES), -1)
        if not len(self._stored):
            self._stored = np.empty((self._count, *found.shape[1:]))
        joints = np.empty((len(part), *self._stored.shape[1:]))
        joints[known], joints[new] = self._stored[part[known]], found
        kept = inside[new]
        self._stored[part[new[kept]]], self._is_stored[part[new[kept]]] = found[kept], True
        return joints
