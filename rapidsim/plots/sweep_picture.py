"""Feasible positions of a program in a sweep, and the margin of the arm to its limits there."""

from __future__ import annotations

from functools import partial
from pathlib import Path

import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from rapidsim.colours import Colours
from rapidsim.frames.transform import Array
from rapidsim.jobs.running.sweep import Axis, Sweep
from rapidsim.plots.theme import new_figure
from rapidsim.plots.write import write_pictures


def write_sweep_picture(sweep: Sweep, folder: Path) -> tuple[Path, ...]:
    """Write the picture, light and dark.

    Raises:
        InputError: If the files cannot be written.
    """
    return write_pictures({"sweep": partial(_picture, sweep)}, folder)


def _picture(sweep: Sweep, theme: Colours) -> Figure:
    """Draw the margin over the first two keys: the best one if more keys vary."""
    figure = new_figure(_title(sweep), width=8.0, height=5.6)
    axes = figure.subplots()
    axes.grid(visible=False)
    margin = best_margins(sweep)
    first = sweep.axes[0]
    axes.set_xlabel(_label(first))
    if margin.ndim == 1:
        axes.plot(first.values, margin, color=theme.accent, marker="o", markersize=3.0)
        axes.set_ylabel(_margin_label(sweep))
        axes.set_xlim(*_edges(first)[[0, -1]])
        axes.set_ylim(bottom=0.0)
        return figure
    second = sweep.axes[1]
    # Feasible variants without a known margin: the arm uses other configurations.
    axes.pcolormesh(
        *(_edges(first), _edges(second), _reached(sweep).T),
        cmap=ListedColormap([theme.programmed]),
        rasterized=True,
    )
    shown = axes.pcolormesh(
        _edges(first), _edges(second), margin.T, cmap="viridis", vmin=0.0, rasterized=True
    )
    axes.set_ylabel(_label(second))
    if (np.isfinite(_reached(sweep)) & np.isnan(margin)).any():
        handle = Patch(color=theme.programmed, label="reached in other configurations")
        figure.legend(handles=[handle], loc="upper right")
    figure.colorbar(shown, ax=axes, label=_margin_label(sweep))
    return figure


def best_margins(sweep: Sweep) -> Array:
    """Return the largest margin [deg] over the first two keys, or the only one; NaN without any."""
    margins = np.where(np.isfinite(sweep.margin_deg), sweep.margin_deg, np.nan)
    return _largest(sweep, margins)


def _reached(sweep: Sweep) -> Array:
    """Return 1 where some variant works, else NaN."""
    return _largest(sweep, np.ones(len(sweep.number)))


def _largest(sweep: Sweep, values: Array) -> Array:
    """Return the largest values (k,) of feasible variants, over the first two keys."""
    whole = [len(axis.values) for axis in sweep.axes]
    largest = np.full(whole[:2], np.nan)
    at = np.unravel_index(sweep.number[sweep.works], whole)[:2]
    np.fmax.at(largest, at, values[sweep.works])
    return largest


def _title(sweep: Sweep) -> str:
    title = f"{int(sweep.works.sum())} of {len(sweep.number)} variants reach every move"
    others = ", ".join(axis.key for axis in sweep.axes[2:])
    return f"{title}; the best of {others}" if others else title


def _margin_label(sweep: Sweep) -> str:
    return f"least way to a limit [{sweep.margin_measure.replace('deg', '°')}]"


def _label(axis: Axis) -> str:
    unit = "°" if axis.key.startswith("base.r") else "mm"
    return f"{axis.key} [{unit}]"


def _edges(axis: Axis) -> Array:
    """Return the borders of the cells of values (k + 1,), rising or falling like the values."""
    values = np.array(axis.values)
    if len(values) == 1:
        return np.array([values[0] - 0.5, values[0] + 0.5])
    middle = 0.5 * (values[1:] + values[:-1])
    first, last = 2.0 * values[0] - middle[0], 2.0 * values[-1] - middle[-1]
    return np.concatenate([[first], middle, [last]])
