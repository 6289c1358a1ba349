"""Placement of a plot's legend where it hides the fewest samples."""

from __future__ import annotations

import numpy as np
import rerun.blueprint as rrb

from rapidsim.frames.transform import Array

_CORNERS = (
    (rrb.Corner2D.RightTop, 1, 1),
    (rrb.Corner2D.LeftTop, 0, 1),
    (rrb.Corner2D.RightBottom, 1, 0),
    (rrb.Corner2D.LeftBottom, 0, 0),
)
"""Corners with their side, 0 low and 1 high, in time and value; the first one wins ties."""


def emptiest_corner(times: Array, values: Array, width: float, height: float) -> rrb.Corner2D:
    """Return the corner of a plot with the fewest samples under a legend.

    Args:
        times: Shape (k,).
        values: Shape (k, n): n lines, drawn on one axis that fits them all.
        width: Share of the plot's width that the legend takes.
        height: Share of the plot's height that the legend takes.
    """
    x = _unit(times)[:, None]
    y = _unit(values)
    covered = [
        np.count_nonzero((np.abs(x - side_x) < width) & (np.abs(y - side_y) < height))
        for _, side_x, side_y in _CORNERS
    ]
    return _CORNERS[int(np.argmin(covered))][0]


def _unit(values: Array) -> Array:
    """Return values shifted and scaled to 0..1."""
    low, high = float(values.min()), float(values.max())
    return (values - low) / (high - low) if high > low else np.full_like(values, 0.5)
