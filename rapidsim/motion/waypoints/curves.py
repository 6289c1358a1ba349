"""Curves of the TCP by arc length: straight lines, arcs around the base, splines.

The parameter of a curve is the TCP's travel [m]; if the TCP only turns, the distance it would
travel in the same time.
"""

from __future__ import annotations

from functools import cached_property
from typing import Protocol

import numpy as np

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.waypoints.piecewise_polynomials import Piecewise
from rapidsim.motion.waypoints.points import between, posed
from rapidsim.values import value_class

_CELLS = 16
"""Number of sections of a spline between two knots whose lengths are computed separately."""
_GAUSS, _WEIGHTS = np.polynomial.legendre.leggauss(8)
_NEWTON_STEPS = 6


class Curve(Protocol):
    """A curve that is followed from rest to rest."""

    @property
    def length(self) -> float:
        """[m]"""
        ...

    @property
    def travel(self) -> float:
        """Travel [m] of the TCP; less than the length if it turns more than it travels."""
        ...

    def at(self, place: Array) -> Transform:
        """Return base_from_tcp (k,) at positions (k,) [m]."""
        ...


@value_class(frozen=True, slots=True, eq=False)
class StraightLine:
    """The TCP on a straight line, with uniform rotation."""

    start: Array
    """Shape (3,) [m]."""
    end: Array
    start_attitude: Array
    end_attitude: Array
    length: float
    """[m]"""

    @property
    def travel(self) -> float:
        """See `Curve`."""
        return float(np.linalg.norm(self.end - self.start))

    def at(self, place: Array) -> Transform:
        """See `Curve`."""
        share = place / self.length
        position = self.start + share[:, None] * (self.end - self.start)
        return posed(position, between(self.start_attitude, self.end_attitude, share))


@value_class(frozen=True, slots=True, eq=False)
class BaseArc:
    """The TCP on a great circle around the origin of the base, from `start` to `end`.

    The points of a straight line, pushed out to a sphere.
    """

    start: Array
    """Shape (3,) [m]; as far from the origin as `end`, and not opposite to it."""
    end: Array
    start_attitude: Array
    end_attitude: Array
    length: float
    """[m]"""

    @property
    def travel(self) -> float:
        """See `Curve`."""
        return self.length

    def at(self, place: Array) -> Transform:
        """See `Curve`."""
        radius = float(np.linalg.norm(self.start))
        ahead = self.end - self.start * float(self.start @ self.end) / radius**2
        ahead *= radius / np.linalg.norm(ahead)
        angle = (place / radius)[:, None]
        position = np.cos(angle) * self.start + np.sin(angle) * ahead
        share = place / self.length
        return posed(position, between(self.start_attitude, self.end_attitude, share))


@value_class(frozen=True, eq=False)
class SplineCurve:
    """The TCP on a spline; quaternions are interpolated by a spline and normalised."""

    positions: Piecewise
    """Position [m] as a function of the knots' parameter."""
    attitudes: Piecewise

    @cached_property
    def _cells(self) -> tuple[Array, Array]:
        """Parameters and arc lengths [m] at the ends of all cells, (c + 1,) each."""
        breaks = self.positions.breaks
        share = np.arange(_CELLS) / _CELLS
        inner = (breaks[:-1, None] + share * np.diff(breaks)[:, None]).reshape(-1)
        ends = np.append(inner, breaks[-1])
        return ends, np.concatenate([[0.0], np.cumsum(self._length(ends[:-1], ends[1:]))])

    @property
    def length(self) -> float:
        """[m]"""
        return float(self._cells[1][-1])

    @property
    def travel(self) -> float:
        """See `Curve`."""
        return self.length

    def parameter(self, place: Array) -> Array:
        """Return the spline's parameter (k,) at positions (k,) [m]."""
        ends, ways = self._cells
        cell = np.clip(np.searchsorted(ways, place, side="right") - 1, 0, len(ends) - 2)
        low, high = ends[cell], ends[cell + 1]
        size = np.maximum(ways[cell + 1] - ways[cell], 1e-300)
        found = low + (place - ways[cell]) / size * (high - low)
        for _ in range(_NEWTON_STEPS):
            speed = np.linalg.norm(self.positions.at(found, 1), axis=1)
            missing = place - ways[cell] - self._length(low, found)
            found = np.clip(found + missing / np.maximum(speed, 1e-12), low, high)
        inside: Array = found
        return inside

    def at(self, place: Array) -> Transform:
        """See `Curve`."""
        parameter = self.parameter(place)
        return posed(self.positions.at(parameter), self.attitudes.at(parameter))

    def _length(self, start: Array, end: Array) -> Array:
        """Return the length (k,) [m] between parameters (k,) of one cell."""
        half = 0.5 * (end - start)
        nodes = (0.5 * (start + end))[:, None] + half[:, None] * _GAUSS
        speed = np.linalg.norm(self.positions.at(nodes.reshape(-1), 1), axis=1)
        way: Array = half * (speed.reshape(nodes.shape) @ _WEIGHTS)
        return way
