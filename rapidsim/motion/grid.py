"""The places of a path at which timing looks: cells between nodes, denser where the path bends.

Each cell holds derivatives at its start, middle and end, all taken from the piece it lies in, so
that what jumps at zone edges does not smear.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.curves import Index
from rapidsim.motion.kinematics import Mask
from rapidsim.motion.limits import Limits
from rapidsim.motion.path import Path

_LONGEST_CELL = 0.025
_LINE_CELLS = 3
_CORNER_CELLS = 6
_FIRST_DEVIATION = 0.02
_SECOND_DEVIATION = 0.05
_SHORTEST_SHARE = 1e-9
_SHORTEST_DENT = 1e-4
_ROUNDS = 24


@dataclass(frozen=True, slots=True, eq=False)
class Cells:
    """Cells (c,) in the order of s; the middle axis of derivatives is start, middle, end."""

    start: Array
    end: Array
    piece: Index
    first: Array
    """Joints, shape (c, 3, n) [rad/m]."""
    second: Array
    """Joints, shape (c, 3, n) [rad/m2]."""
    tcp_rate: Array
    """TCP travel, shape (c, 3) [m/m]."""
    turn_rate: Array
    """Reorientation, shape (c, 3) [rad/m]."""
    behind: Cells | None = None
    """Cells before the first, which are not driven: smoothing still sees their speed limits."""

    @property
    def nodes(self) -> Array:
        """S of all cell ends, shape (c + 1,)."""
        return np.append(self.start, self.end[-1])


def cells_of(path: Path, limits: Limits, start: float) -> Cells:
    """Cells from a place to the end of a path, fine enough for its derivatives."""
    cells = _evaluate(path, *_first_cells(path, start))
    if start > 0.0:
        cells = replace(cells, behind=_evaluate(path, *_first_cells_before(path, start)))
    for _ in range(_ROUNDS):
        rough = np.flatnonzero(_rough(cells, limits, path.length))
        if not len(rough):
            break
        middle = 0.5 * (cells.start[rough] + cells.end[rough])
        cells = split(path, cells, rough, middle)
    return cells


def split(path: Path, cells: Cells, index: Index, at: Array) -> Cells:
    """Cut some cells (k,), in increasing order, each at a place (k,) inside it."""
    halves = _evaluate(
        path,
        np.stack([cells.start[index], at], axis=1).ravel(),
        np.stack([at, cells.end[index]], axis=1).ravel(),
        np.repeat(cells.piece[index], 2),
    )
    source = np.repeat(np.arange(len(cells.start)), 1 + np.isin(np.arange(len(cells.start)), index))
    split_rows = np.isin(source, index)

    def merged(old: Array, new: Array) -> Array:
        result = old[source]
        result[split_rows] = new
        return result

    return Cells(
        start=merged(cells.start, halves.start),
        end=merged(cells.end, halves.end),
        piece=cells.piece[source],
        first=merged(cells.first, halves.first),
        second=merged(cells.second, halves.second),
        tcp_rate=merged(cells.tcp_rate, halves.tcp_rate),
        turn_rate=merged(cells.turn_rate, halves.turn_rate),
        behind=cells.behind,
    )


def _first_cells(path: Path, start: float) -> tuple[Array, Array, Index]:
    layout = path.layout
    width = np.diff(layout.bounds)
    in_corner = np.maximum(layout.orientation_corner, layout.joint_corner) >= 0
    least = np.where(in_corner, _CORNER_CELLS, _LINE_CELLS)
    longest = np.maximum(_LONGEST_CELL, path.length * 1e-4)
    count = np.maximum(least, np.ceil(width / longest)).astype(np.int64)
    owner = np.repeat(np.arange(len(width)), count)
    number = np.arange(len(owner)) - np.repeat(np.cumsum(count) - count, count)
    begin = layout.bounds[owner] + width[owner] * (number / count[owner])
    end = np.append(begin[1:], layout.bounds[-1])
    # A start inside a cell leaves the rest of it; a sliver of a cell would only be rounding.
    kept = end > start + 1e-3 * np.minimum(end - begin, path.length)
    kept[-1] = True
    begin, end, owner = begin[kept], end[kept], owner[kept]
    begin[0] = start
    return begin, end, owner.astype(np.int64)


def _first_cells_before(path: Path, start: float) -> tuple[Array, Array, Index]:
    begin, end, owner = _first_cells(path, 0.0)
    kept = begin < start
    return begin[kept], np.minimum(end[kept], start), owner[kept]


def _evaluate(path: Path, start: Array, end: Array, piece: Index) -> Cells:
    s = np.stack([start, 0.5 * (start + end), end], axis=1)
    rates = path.rates(s.ravel(), np.repeat(piece, 3))
    count, axes = len(start), rates.first.shape[1]
    return Cells(
        start=start,
        end=end,
        piece=piece,
        first=rates.first.reshape(count, 3, axes),
        second=rates.second.reshape(count, 3, axes),
        tcp_rate=rates.tcp_rate.reshape(count, 3),
        turn_rate=rates.turn_rate.reshape(count, 3),
    )


def _rough(cells: Cells, limits: Limits, length: float) -> Mask:
    """Whether derivatives bend too much within each cell (c,)."""
    first = cells.first / limits.max_speed
    bend = np.abs(first[:, 1] - 0.5 * (first[:, 0] + first[:, 2])).max(axis=-1)
    scale = np.abs(first).max(axis=(1, 2))
    # What the second derivative does counts as far as it can use up the acceleration.
    second = np.abs(cells.second) / limits.max_acceleration
    fastest = 1.0 / np.maximum(second.max(axis=(1, 2)), 1e-12)
    fastest = np.minimum(fastest, 1.0 / np.maximum(scale, 1e-12) ** 2)
    middle = cells.second[:, 1] - 0.5 * (cells.second[:, 0] + cells.second[:, 2])
    curl = np.abs(middle / limits.max_acceleration).max(axis=-1) * fastest
    wide = cells.end - cells.start > _SHORTEST_SHARE * length
    # The TCP may come to a point and go back: then its rate is a V that a middle can miss.
    dent = np.abs(cells.tcp_rate[:, 1] - 0.5 * (cells.tcp_rate[:, 0] + cells.tcp_rate[:, 2]))
    dented = dent > _FIRST_DEVIATION * cells.tcp_rate.max(axis=1)
    dented &= cells.end - cells.start > _SHORTEST_DENT * length
    bent = (bend > _FIRST_DEVIATION * scale) | (curl > _SECOND_DEVIATION)
    rough: Mask = (wide & bent) | dented
    return rough
