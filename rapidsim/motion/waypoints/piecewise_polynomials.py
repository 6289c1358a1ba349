"""Piecewise polynomials: splines, joint quintics and time laws.

Values and derivatives are functions of position or time; extremes are exact, not sampled.
"""

from __future__ import annotations

from math import factorial

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.values import value_class

_NEGLIGIBLE = 1e-12
"""Share of a polynomial's largest coefficient below which a coefficient is rounding."""
_REAL = 1e-6
"""Imaginary part of a double root that is due to rounding."""


@value_class(frozen=True, slots=True, eq=False)
class Piecewise:
    """Function of one variable with d components, a polynomial between breaks."""

    breaks: Array
    """Shape (m + 1,), not falling."""
    coefficients: Array
    """Shape (m, p, d): for each piece, lowest power first, in the distance from its first break."""

    @property
    def end(self) -> float:
        """Last break."""
        return float(self.breaks[-1])

    def piece(self, x: Array) -> np.ndarray[tuple[int, ...], np.dtype[np.int64]]:
        """Return the piece (k,) at each point (k,); the outer ones continue beyond the ends."""
        found = np.searchsorted(self.breaks, x, side="right") - 1
        return np.clip(found, 0, len(self.coefficients) - 1).astype(np.int64)

    def at(self, x: Array, derivative: int = 0) -> Array:
        """Return values, or a derivative, (k, d) at points (k,)."""
        piece = self.piece(x)
        local = (x - self.breaks[piece])[:, None]
        rows = self.coefficients[piece]
        powers = rows.shape[1]
        value: Array = np.zeros((len(x), rows.shape[2]))
        for power in range(powers - 1, derivative - 1, -1):
            factor = factorial(power) / factorial(power - derivative)
            value = value * local + factor * rows[:, power]
        return value

    def extremes(self, derivative: int = 0) -> tuple[Array, Array]:
        """Return minimum and maximum value, or derivative, of each piece: two arrays (m, d)."""
        count, powers, components = self.coefficients.shape
        rows = self.coefficients.transpose(0, 2, 1).reshape(-1, powers)
        for _ in range(derivative):
            rows = rows[:, 1:] * np.arange(1, rows.shape[1])
        width = np.repeat(np.diff(self.breaks), components)[:, None]
        places = width * _turning_points(rows * width ** np.arange(rows.shape[1]))
        values = np.zeros_like(places)
        for column in rows.T[::-1]:
            values = values * places + column[:, None]
        shape = (count, components)
        return values.min(axis=1).reshape(shape), values.max(axis=1).reshape(shape)

    def peak(self, derivative: int) -> Array:
        """Return the maximum magnitude (d,) of a derivative."""
        low, high = self.extremes(derivative)
        largest: Array = np.maximum(np.abs(low), np.abs(high)).max(axis=0)
        return largest


def _turning_points(rows: Array) -> Array:
    """Return points (k, c) in 0..1 where polynomials (k, p) have extremes, and both ends."""
    slopes = rows[:, 1:] * np.arange(1, rows.shape[1])
    places = np.zeros((len(rows), max(rows.shape[1], 2)))
    places[:, 1] = 1.0
    size = np.abs(slopes).max(axis=1, initial=0.0)
    counts = np.abs(slopes) > _NEGLIGIBLE * size[:, None]
    degree = (counts * np.arange(slopes.shape[1])).max(axis=1, initial=0)
    for order in range(1, slopes.shape[1]):
        at = np.flatnonzero(degree == order)
        # Roots are the eigenvalues of the companion matrix.
        companion = np.zeros((len(at), order, order))
        companion[:, np.arange(1, order), np.arange(order - 1)] = 1.0
        companion[:, :, -1] = -slopes[at, :order] / slopes[at, order, None]
        roots = np.linalg.eigvals(companion)
        inside = (np.abs(roots.imag) < _REAL) & (roots.real > 0.0) & (roots.real < 1.0)
        places[at, 2 : 2 + order] = np.where(inside, roots.real, 0.0)
    return places


def integrated(widths: Array, accelerations: Array) -> Piecewise:
    """Return the position, from rest at 0, for a piecewise polynomial second derivative.

    Args:
        widths: Shape (m,): length of each piece; pieces of zero length are omitted.
        accelerations: Shape (m, p): a polynomial for each piece, lowest power first.

    Returns:
        A function with one component.
    """
    lasting = widths > 0.0
    widths, accelerations = widths[lasting], accelerations[lasting]
    power = np.arange(accelerations.shape[1])
    pieces = np.zeros((len(widths), accelerations.shape[1] + 2, 1))
    place = speed = 0.0
    for row, (width, acceleration) in enumerate(zip(widths, accelerations, strict=True)):
        pieces[row, 0, 0], pieces[row, 1, 0] = place, speed
        pieces[row, 2:, 0] = acceleration / ((power + 1) * (power + 2))
        polynomial = np.polynomial.Polynomial(pieces[row, :, 0])
        place, speed = float(polynomial(width)), float(polynomial.deriv()(width))
    return Piecewise(np.concatenate([[0.0], np.cumsum(widths)]), pieces)
