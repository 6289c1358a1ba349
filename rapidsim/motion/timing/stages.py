"""Steps of the solver: parts of the cells of a path, with all their limits.

Derivatives are known at three points of a cell (`discretisation`). Within it they follow the
parabola through these, so a cell can be divided into as many stages as its time requires without
evaluating the arm again. Within a stage the path acceleration is constant.
"""

from __future__ import annotations

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.geometry.curves import Index
from rapidsim.motion.numba_jit import jit_function
from rapidsim.motion.timing import two_pass_loops
from rapidsim.motion.timing.constraints import AccelerationRows
from rapidsim.motion.timing.discretisation import GridCells
from rapidsim.repeated_rows import repeated
from rapidsim.values import value_class

LARGEST_X = 1e12
"""Square of a path speed [m2/s2] that nothing reaches."""
_CROSSINGS = 30


@value_class(frozen=True, slots=True, eq=False)
class Stages:
    """Stages (m,) in the order of s."""

    cell: Index
    """Shape (m,)."""
    begin: Array
    """Start of each in its cell, shape (m,), from 0 to 1."""
    end: Array
    """End of each in its cell, shape (m,), from 0 to 1."""
    nodes: Array
    """Parameter s of their ends, shape (m + 1,) [m]."""
    slack: Array
    """Shape (m, rows of starts, then of ends): |u + tilt x| <= slack, x at the start."""
    tilt: Array
    widest: Array
    """Shape (m,): largest x at the start for which some u keeps every row."""

    @property
    def width(self) -> Array:
        """Shape (m,) [m]."""
        return np.diff(self.nodes)

    @property
    def places(self) -> Array:
        """Start, middle and end of each stage, shape (m, 3) [m]."""
        first, last = self.nodes[:-1], self.nodes[1:]
        return np.stack([first, 0.5 * (first + last), last], axis=1)

    def beyond(self, count: int) -> Stages:
        """Return the stages after the first `count`."""
        return Stages(
            self.cell[count:],
            self.begin[count:],
            self.end[count:],
            self.nodes[count:],
            self.slack[count:],
            self.tilt[count:],
            self.widest[count:],
        )


def stages_of(cells: GridCells, rows: AccelerationRows, parts: int) -> Stages:
    """Divide each cell into equal stages; `rows` are the rows at the cells' points."""
    cell = np.repeat(np.arange(len(cells.at)), parts)
    share = np.arange(parts + 1) / parts
    begin, end = (np.tile(part, len(cells.at)) for part in (share[:-1], share[1:]))
    count, columns = len(cell), 2 * rows.slope.shape[1]
    slack, tilt = np.empty((2, count, columns))
    stages = Stages(cell, begin, end, np.empty(count + 1), slack, tilt, np.empty(count))
    _fill_in(stages, cells, rows, np.arange(count))
    return stages


def cut(stages: Stages, cells: GridCells, rows: AccelerationRows, parts: Index) -> Stages:
    """Divide each stage into a number (m,) of equal ones."""
    owner, number = repeated(parts)
    begin, step = stages.begin[owner], ((stages.end - stages.begin) / parts)[owner]
    # The last part ends exactly where its stage did, because ends are compared with stops.
    last = number + 1 == parts[owner]
    smaller = Stages(
        stages.cell[owner],
        np.where(number == 0, begin, begin + step * number),
        np.where(last, stages.end[owner], begin + step * (number + 1)),
        np.append(stages.nodes[owner], stages.nodes[-1]),
        stages.slack.take(owner, axis=0),
        stages.tilt.take(owner, axis=0),
        stages.widest[owner],
    )
    _fill_in(smaller, cells, rows, np.flatnonzero(parts[owner] > 1))
    return smaller


def weights_of(share: Array) -> Array:
    """Return weights (m, 3) of start, middle and end of cells at shares (m,) of them.

    These are the weights of the parabola through three values.
    """
    rest = 1.0 - share
    weights = np.empty((len(share), 3))
    weights[:, 0] = rest * (1.0 - 2.0 * share)
    weights[:, 1] = 4.0 * share * rest
    weights[:, 2] = share * (2.0 * share - 1.0)
    return weights


def rows_along(values: Array, at: Index, weights: Array) -> Array:
    """Return rows (m, r) within cells, on the parabolas through three points of each.

    Args:
        values: Shape (k, r), at points.
        at: Shape (m, 3): indices of the start, the middle and the end of each cell among the
            points.
        weights: Shape (m, 3); see `weights_of`.
    """
    rows: Array = np.einsum("mp,mpr->mr", weights, values.take(at, axis=0))
    return rows


def fastest(stages: Stages, cells: GridCells, slowness: Array) -> Array:
    """Return maximum path speeds (m, 3) [m/s] at start, middle and end of stages.

    `slowness` (k,) [s/m] is the inverse speed at the points of the cells. Within a cell it may have
    a kink, where another limit takes over: the slower of the parabola and of straight lines counts.
    """
    kernel = jit_function(two_pass_loops, "fast_stages", len(stages.cell))
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
        parabola = np.einsum("mp,mp->m", weights_of(share), own)
        np.maximum(parabola, straight, out=slow[:, i])
    speeds = 1.0 / slow
    return speeds


def _fill_in(stages: Stages, cells: GridCells, rows: AccelerationRows, new: Index) -> None:
    """Fill in nodes, slack, tilt and widest of some stages (j,).

    At the end of a stage x has grown by span u, so its row there is
    |(slope + span bend) u + bend x| <= 1.
    """
    cell, begin, end = stages.cell[new], stages.begin[new], stages.end[new]
    s = cells.places.s[cells.at]
    width = (s[:, 2] - s[:, 0])[cell]
    stages.nodes[new] = s[cell, 0] + width * begin
    stages.nodes[-1] = s[-1, 2]
    span = 2.0 * (end - begin) * width
    kernel = jit_function(two_pass_loops, "limit_stages", len(new))
    if kernel is not None:
        kernel(
            (cells.at, rows.slope, rows.bend),
            (cell, begin, end, span),
            (LARGEST_X, new),
            (stages.slack, stages.tilt, stages.widest),
        )
        return
    at = cells.at[cell]
    own = rows.slope.shape[1]
    ends = weights_of(begin), weights_of(end)
    tilt = np.concatenate([rows_along(rows.bend, at, weights) for weights in ends], axis=1)
    slope = np.concatenate([rows_along(rows.slope, at, weights) for weights in ends], axis=1)
    slope[:, own:] += span[:, None] * tilt[:, own:]
    steepest = np.abs(slope).max(axis=1)
    # Rows nearly independent of u get a small share of it: their bound on x is then 1 / |bend|.
    least = 1e-9 * (steepest[:, None] + span[:, None] * np.abs(tilt)) + 1e-300
    inverse = 1.0 / np.where(np.abs(slope) > least, slope, least)
    slack, tilt = np.abs(inverse), tilt * inverse
    stages.slack[new], stages.tilt[new] = slack, tilt
    stages.widest[new] = _widest(slack, tilt, span)


def _widest(slack: Array, tilt: Array, span: Array) -> Array:
    """Return the largest x (m,) for which some u keeps every row of a stage and stays above zero.

    As a function of x, the rows bound u by a band that narrows to a point. Starting far outside,
    iterate to the crossing of the two tightest rows, until they are the tightest at their crossing.
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


def in_the_middle(stages: Stages, x: Array) -> tuple[Array, Array, Array]:
    """Return share of the cell, path acceleration [m/s2] and squared path speed (m,) in mid-stage.

    `x` (m + 1,) are the values at the nodes.
    """
    u = np.diff(x) / np.maximum(2.0 * stages.width, 1e-300)
    return 0.5 * (stages.begin + stages.end), u, 0.5 * (x[:-1] + x[1:])


def loads(stages: Stages, cells: GridCells, rows: AccelerationRows, x: Array) -> Array:
    """Return the most constraining share (m,) of an acceleration limit in the middle of stages.

    `x` (m + 1,) are the values at the nodes, `rows` the rows at the points of the cells.
    """
    middle, u, square = in_the_middle(stages, x)
    kernel = jit_function(two_pass_loops, "load_stages", len(u))
    if kernel is not None:
        found = np.empty(len(u))
        kernel((cells.at, rows.slope, rows.bend), stages.cell, middle, u, square, found)
        return found
    at = cells.at[stages.cell]
    weights = weights_of(middle)
    slope, bend = rows_along(rows.slope, at, weights), rows_along(rows.bend, at, weights)
    largest: Array = np.abs(slope * u[:, None] + bend * square[:, None]).max(axis=1)
    return largest
