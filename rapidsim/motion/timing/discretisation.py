"""Discretisation of a path for timing: cells, denser where derivatives change quickly.

Each cell has derivatives at its start, middle and end, all taken from the piece that contains it,
so that jumps at zone edges are kept; between the three they follow a parabola. Cells of one piece
share the points where they meet.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.curves import Index
from rapidsim.motion.geometry.parameterisation import PathParameterisation
from rapidsim.motion.interruption import Look, undisturbed
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.motion.path.path import Path
from rapidsim.motion.path.path_derivatives import PathRates
from rapidsim.motion.timing.axis_limits import Limits
from rapidsim.repeated_rows import repeated
from rapidsim.values import value_class

_LONGEST_CELL = 0.025
_TCP_CELLS = 8
"""Cells of half a corner where the acceleration of the TCP is limited: its derivatives are norms of
vectors, which have larger curvature than those of joints."""
_MIXED_CELLS = 4
"""Cells of half a corner between a joint move and a line, whose curvature always requires these."""
_FIRST_DEVIATION = 0.02
_SECOND_DEVIATION = 0.2
_SHORTEST_SHARE = 1e-9
_DENT = 0.002
_DROP = 0.15
_SHORTEST_DENT = 1e-4
_ROUNDS = 24


@value_class(frozen=True, slots=True, eq=False)
class GridPoints:
    """Points (k,) of a path with their derivatives, in no particular order."""

    s: Array
    piece: Index
    rates: PathRates


@value_class(frozen=True, slots=True, eq=False)
class GridCells:
    """Cells (c,) in the order of s."""

    places: GridPoints
    at: Index
    """Shape (c, 3): indices in `places` of the start, the middle and the end of each cell."""
    driven: int
    """First cell of the motion; smoothing uses the speed limits of the cells before it."""

    @property
    def s(self) -> Array:
        """Start, middle and end of each cell, shape (c, 3) [m]."""
        ends: Array = self.places.s[self.at]
        return ends

    @property
    def width(self) -> Array:
        """Shape (c,) [m]."""
        width: Array = self.places.s[self.at[:, 2]] - self.places.s[self.at[:, 0]]
        return width

    @property
    def piece(self) -> Index:
        """Piece of each cell (c,)."""
        piece: Index = self.places.piece[self.at[:, 0]]
        return piece


def cells_of(
    path: Path,
    limits: Limits,
    start: float,
    check_deadline: Look = undisturbed,
    within: tuple[float, float] = (-np.inf, np.inf),
) -> GridCells:
    """Return cells of a path, fine enough for its derivatives.

    Args:
        path: The geometry.
        limits: Axis limits.
        start: Position [m] on the path where the motion starts.
        check_deadline: Called regularly.
        within: Range [m] of interest, around the start; only pieces that overlap it get cells.
    """
    cells = _evaluate(path, *_first_cells(path, start, within))
    rough = np.arange(len(cells.at))
    for _ in range(_ROUNDS):
        check_deadline()
        rough = rough[_rough(cells, rough, limits, path.length)]
        if not len(rough):
            break
        cells = _halved(path, cells, rough)
        # Only the halves can still be rough.
        first = rough + np.arange(len(rough))
        rough = np.stack([first, first + 1], axis=1).ravel()
    driven = int(np.searchsorted(cells.places.s[cells.at[:, 0]], start))
    return replace(cells, driven=driven)


def _halved(path: Path, cells: GridCells, index: Index) -> GridCells:
    """Halve cells (k,), in increasing order."""
    places, cut = cells.places, cells.at[index]
    start, middle, end = places.s[cut].T
    s = np.concatenate([0.5 * (start + middle), 0.5 * (middle + end)])
    pieces = np.tile(places.piece[cut[:, 0]], 2)
    count, k = len(places.s), len(index)
    number = count + np.arange(k)
    rows = np.repeat(cells.at, 1 + np.bincount(index, minlength=len(cells.at)), axis=0)
    first = index + np.arange(k)
    rows[first] = np.stack([cut[:, 0], number, cut[:, 1]], axis=1)
    rows[first + 1] = np.stack([cut[:, 1], number + k, cut[:, 2]], axis=1)
    more = GridPoints(
        np.concatenate([places.s, s]),
        np.concatenate([places.piece, pieces]),
        places.rates.and_then(path.rates(s, pieces)),
    )
    return GridCells(more, rows, cells.driven)


def _first_cells(
    path: Path, start: float, within: tuple[float, float]
) -> tuple[Array, Array, Index]:
    layout, (first, last) = path.layout, within
    width = np.diff(layout.bounds)
    least = np.where((layout.in_corner >= 0) & _tcp_is_limited(path), _TCP_CELLS, 1)
    least = np.where(_is_mixed(layout), np.maximum(least, _MIXED_CELLS), least)
    longest = np.maximum(_LONGEST_CELL, path.length * 1e-4)
    count = np.maximum(least, np.ceil(width / longest)).astype(np.int64)
    count[(layout.bounds[1:] <= first) | (layout.bounds[:-1] >= last)] = 0
    owner, number = repeated(count)
    begin = layout.bounds[owner] + width[owner] * (number / count[owner])
    end = np.append(begin[1:], layout.bounds[owner[-1] + 1])
    if start <= 0.0:
        return begin, end, owner.astype(np.int64)
    # A start inside a cell cuts it, unless a sliver of the cell would only be rounding.
    kept = end > start + 1e-3 * np.minimum(end - begin, path.length)
    kept[-1] = True
    before = begin < start
    rest = np.maximum(begin[kept], start)
    rest[0] = start
    return (
        np.concatenate([begin[before], rest]),
        np.concatenate([np.minimum(end[before], start), end[kept]]),
        np.concatenate([owner[before], owner[kept]]).astype(np.int64),
    )


def _is_mixed(layout: PathParameterisation) -> Mask:
    """Mask of pieces (p,) in a corner between a joint move and another curve."""
    corner, in_joints = layout.joint_corner, layout.curves.in_joints
    mixed: Mask = (corner >= 0) & ~(in_joints[corner] & in_joints[corner + 1])
    return mixed


def _tcp_is_limited(path: Path) -> bool:
    """Whether PathAccLim or WorldAccLim hold somewhere."""
    limits = (path.programmed.tcp_acceleration, path.programmed.world_acceleration)
    return any(np.isfinite(limit).any() for limit in limits)


def _evaluate(path: Path, start: Array, end: Array, piece: Index) -> GridCells:
    count = len(start)
    number = np.arange(count)
    # If the next cell belongs to another piece, the end is a separate point.
    last = np.flatnonzero(np.append(piece[1:] != piece[:-1], True))
    after = number + 1
    after[last] = 2 * count + np.arange(len(last))
    s = np.concatenate([start, 0.5 * (start + end), end[last]])
    pieces = np.concatenate([piece, piece, piece[last]])
    at = np.stack([number, count + number, after], axis=1)
    return GridCells(GridPoints(s, pieces, path.rates(s, pieces)), at, 0)


def _rough(cells: GridCells, index: Index, limits: Limits, length: float) -> Mask:
    """Mask of cells (k,) within which derivatives bend too much."""
    at, rates = cells.at[index], cells.places.rates
    start, middle, end = at.T
    width = cells.places.s[end] - cells.places.s[start]
    bend, scale = _bend(rates.first[at] / limits.max_speed)
    curl, curve = _bend(rates.second[at] / limits.max_acceleration)
    # The second derivative counts as far as it can use up the acceleration.
    fastest = np.minimum(1.0 / np.maximum(curve, 1e-12), 1.0 / np.maximum(scale, 1e-12) ** 2)
    wide = width > _SHORTEST_SHARE * length
    # The TCP may reverse in a cusp: then its rate is a V that a middle can miss, and before the
    # cusp an S that three points do not show.
    a, b, c = rates.tcp_rate[start], rates.tcp_rate[middle], rates.tcp_rate[end]
    most = np.maximum(np.maximum(a, b), c)
    dented = (np.abs(b - 0.5 * (a + c)) > _DENT * most) | (np.abs(c - a) > _DROP * most)
    dented &= width > _SHORTEST_DENT * length
    bent = (bend > _FIRST_DEVIATION * scale) | (curl * fastest > _SECOND_DEVIATION)
    rough: Mask = (wide & bent) | dented
    return rough


def _bend(values: Array) -> tuple[Array, Array]:
    """Return the deviation of values (k, 3, n) from a line in the middle, and their maximum (k,).

    The maximum over the n columns is used; columns come first, because short rows are slow to
    process.
    """
    columns = np.ascontiguousarray(values.T)
    off: Array = np.abs(columns[:, 1] - 0.5 * (columns[:, 0] + columns[:, 2])).max(axis=0)
    largest: Array = np.abs(columns).max(axis=(0, 1))
    return off, largest
