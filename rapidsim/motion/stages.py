"""The steps of the solver: parts of the cells of a path, with all their limits.

Derivatives are known at three places of a cell (`grid`). Within it they follow the parabola through
these, so a cell can be driven in as many stages as its time is worth without looking at the arm
again. Within a stage the path acceleration is constant.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion import solver_loops
from rapidsim.motion.compiled import compiled
from rapidsim.motion.curves import Index
from rapidsim.motion.grid import Cells
from rapidsim.motion.rows import AccelerationRows

LARGEST_X = 1e12
"""Square of a path speed [m2/s2] that nothing reaches."""
_CROSSINGS = 30


@dataclass(frozen=True, slots=True, eq=False)
class Stages:
    """Stages (m,) in the order of s."""

    cell: Index
    """Shape (m,)."""
    begin: Array
    """Where in its cell each begins, shape (m,), from 0 to 1."""
    end: Array
    """Where it ends."""
    nodes: Array
    """S of their ends, shape (m + 1,) [m]."""
    slack: Array
    """Shape (m, rows of begins, then of ends): |u + tilt x| <= slack, x at the begin."""
    tilt: Array
    widest: Array
    """Shape (m,): largest x at the begin for which some u keeps every row."""

    @property
    def width(self) -> Array:
        """Shape (m,) [m]."""
        return np.diff(self.nodes)

    @property
    def places(self) -> Array:
        """Begin, middle and end of each, shape (m, 3) [m]."""
        first, last = self.nodes[:-1], self.nodes[1:]
        return np.stack([first, 0.5 * (first + last), last], axis=1)

    def beyond(self, count: int) -> Stages:
        """Those after the first few."""
        return Stages(
            self.cell[count:],
            self.begin[count:],
            self.end[count:],
            self.nodes[count:],
            self.slack[count:],
            self.tilt[count:],
            self.widest[count:],
        )


def stages_of(cells: Cells, rows: AccelerationRows, parts: int) -> Stages:
    """Each cell in a number of equal stages; `rows` are those of the places of the cells."""
    cell = np.repeat(np.arange(len(cells.at)), parts)
    share = np.arange(parts + 1) / parts
    count = len(cells.at)
    return _with_limits(cells, rows, cell, np.tile(share[:-1], count), np.tile(share[1:], count))


def cut(stages: Stages, cells: Cells, rows: AccelerationRows, parts: Index) -> Stages:
    """Each stage in a number (m,) of equal ones."""
    owner = np.repeat(np.arange(len(parts)), parts)
    number = np.arange(len(owner)) - np.repeat(np.cumsum(parts) - parts, parts)
    begin, step = stages.begin[owner], ((stages.end - stages.begin) / parts)[owner]
    # The last one ends exactly where its stage did, for ends are compared with stops.
    last = number + 1 == parts[owner]
    end = np.where(last, stages.end[owner], begin + step * (number + 1))
    begin = np.where(number == 0, begin, begin + step * number)
    new = np.flatnonzero(parts[owner] > 1)
    of_new = _with_limits(cells, rows, stages.cell[owner[new]], begin[new], end[new])
    slack, tilt, widest = (values[owner] for values in (stages.slack, stages.tilt, stages.widest))
    nodes = np.append(stages.nodes[owner], stages.nodes[-1])
    slack[new], tilt[new], widest[new] = of_new.slack, of_new.tilt, of_new.widest
    nodes[new] = of_new.nodes[:-1]
    return Stages(stages.cell[owner], begin, end, nodes, slack, tilt, widest)


def rows_along(values: Array, at: Index, share: Array) -> Array:
    """Rows (m, r) at shares (m,) of cells, on the parabolas through three places of each.

    Args:
        values: Shape (k, r), at places.
        at: Shape (m, 3): the start, the middle and the end of each cell among the places.
        share: Shape (m,), from 0 to 1.
    """
    rows: Array = np.einsum("mp,mpr->mr", _weights(share), values[at])
    return rows


def along(values: Array, share: Array) -> Array:
    """The same for values (m, 3) of which each cell has its own."""
    found: Array = np.einsum("mp,mp->m", _weights(share), values)
    return found


def _weights(share: Array) -> Array:
    """What start, middle and end of cells count at shares (m,) of them, shape (m, 3)."""
    rest = 1.0 - share
    start, end = rest * (1.0 - 2.0 * share), share * (2.0 * share - 1.0)
    return np.stack([start, 4.0 * share * rest, end], axis=1)


def fastest(stages: Stages, cells: Cells, slowness: Array) -> Array:
    """Largest path speeds (m, 3) [m/s] at begin, middle and end of stages.

    `slowness` (k,) [s/m] is that of the places of the cells. Within a cell it may have a kink,
    where another limit takes over: of the parabola and of straight lines the slower counts.
    """
    kernel = compiled(solver_loops, "fast_stages", len(stages.cell))
    if kernel is not None:
        speeds = np.empty((len(stages.cell), 3))
        kernel(cells.at, slowness, stages.cell, stages.begin, stages.end, speeds)
        return speeds
    own = slowness[cells.at][stages.cell]
    start, middle, end = own.T
    slow = np.empty((len(own), 3))
    for i, share in enumerate((stages.begin, 0.5 * (stages.begin + stages.end), stages.end)):
        of_end = np.maximum(2.0 * share - 1.0, 0.0)
        of_middle = 2.0 * (share - of_end)
        straight = start * (1.0 - of_middle - of_end) + middle * of_middle + end * of_end
        np.maximum(along(own, share), straight, out=slow[:, i])
    speeds = 1.0 / slow
    return speeds


def _with_limits(
    cells: Cells, rows: AccelerationRows, cell: Index, begin: Array, end: Array
) -> Stages:
    """Stages with their acceleration rows.

    At the end of a stage x has grown by span u, so its row there is
    |(slope + span bend) u + bend x| <= 1.
    """
    s = cells.places.s[cells.at]
    start, width = s[:, 0], s[:, 2] - s[:, 0]
    nodes = np.append(start[cell] + width[cell] * begin, s[-1, 2])
    span = 2.0 * (end - begin) * width[cell]
    count, own = len(cell), rows.slope.shape[1]
    slack, tilt = np.empty((count, 2 * own)), np.empty((count, 2 * own))
    widest = np.empty(count)
    kernel = compiled(solver_loops, "limit_stages", count)
    if kernel is not None:
        kernel(
            (cells.at, rows.slope, rows.bend),
            (cell, begin, end, span),
            LARGEST_X,
            slack,
            tilt,
            widest,
        )
        return Stages(cell, begin, end, nodes, slack, tilt, widest)
    at = cells.at[cell]
    np.concatenate([rows_along(rows.bend, at, share) for share in (begin, end)], axis=1, out=tilt)
    np.concatenate([rows_along(rows.slope, at, share) for share in (begin, end)], axis=1, out=slack)
    slack[:, own:] += span[:, None] * tilt[:, own:]
    steepest = np.abs(slack).max(axis=1)
    # Rows that hardly see u get a small share of it instead: their bound on x is then 1 / |bend|.
    least = 1e-9 * (steepest[:, None] + span[:, None] * np.abs(tilt)) + 1e-300
    slope = np.where(np.abs(slack) > least, slack, least)
    slack, tilt = 1.0 / np.abs(slope), tilt / slope
    return Stages(cell, begin, end, nodes, slack, tilt, _widest(slack, tilt, span))


def _widest(slack: Array, tilt: Array, span: Array) -> Array:
    """Largest x (m,) for which some u keeps every row of a stage and stays above zero.

    Seen over x, the rows leave u a band that narrows to a point. From far outside one goes to where
    the two rows cross that are the tightest there, until they are the tightest at their crossing.
    """
    x = np.full(len(slack), LARGEST_X)
    among = np.arange(len(slack))
    for _ in range(_CROSSINGS):
        own_slack, own_tilt = slack[among], tilt[among]
        leaning = own_tilt * x[among, None]
        number = np.arange(len(among))
        above = (own_slack - leaning).argmin(axis=1)
        below = (own_slack + leaning).argmin(axis=1)
        gap = own_tilt[number, above] - own_tilt[number, below]
        room = own_slack[number, above] + own_slack[number, below]
        crossing = room / np.maximum(gap, room / LARGEST_X)
        nearer = crossing < x[among]
        among = among[nearer]
        if not len(among):
            break
        x[among] = crossing[nearer]
    # x + span u >= 0 with u <= slack - tilt x.
    falls = span[:, None] * tilt - 1.0
    grown = span[:, None] * slack / np.where(falls > 1e-12, falls, 1.0)
    ends = np.where(falls > 1e-12, grown, np.inf).min(axis=1)
    result: Array = np.minimum(x, ends)
    return result


def loads(stages: Stages, cells: Cells, rows: AccelerationRows, x: Array) -> Array:
    """The largest share (m,) of an acceleration that is used in the middle of stages.

    `x` (m + 1,) is given at the nodes, `rows` are those of the places of the cells.
    """
    middle = 0.5 * (stages.begin + stages.end)
    u = np.diff(x) / np.maximum(2.0 * stages.width, 1e-300)
    square = 0.5 * (x[:-1] + x[1:])
    kernel = compiled(solver_loops, "load_stages", len(u))
    if kernel is not None:
        found = np.empty(len(u))
        kernel((cells.at, rows.slope, rows.bend), stages.cell, middle, u, square, found)
        return found
    at = cells.at[stages.cell]
    slope, bend = rows_along(rows.slope, at, middle), rows_along(rows.bend, at, middle)
    largest: Array = np.abs(slope * u[:, None] + bend * square[:, None]).max(axis=1)
    return largest
