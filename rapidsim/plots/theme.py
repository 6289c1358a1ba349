"""Themes of all pictures, light and dark: colours by meaning, small type, faint grid lines."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import matplotlib
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.patheffects import withStroke

from rapidsim.colours import Colours
from rapidsim.frames.transform import Array

DPI = 144
_SHORTEST_S = 1e-3
"""[s]; no axis is shorter."""


@contextmanager
def themed(theme: Colours) -> Iterator[None]:
    """Apply a theme to figures made in the block; nothing outside it changes."""
    settings: dict[Any, Any] = {
        "font.family": "DejaVu Sans",
        "font.size": 9.0,
        "figure.facecolor": theme.panel,
        "savefig.facecolor": theme.panel,
        "axes.facecolor": theme.panel,
        "axes.edgecolor": theme.rule,
        "axes.labelcolor": theme.soft,
        "axes.labelsize": 8.5,
        "axes.titlesize": 9.5,
        "axes.titlelocation": "left",
        "axes.titlecolor": theme.ink,
        "axes.grid": True,
        "axes.axisbelow": True,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "grid.color": theme.rule,
        "grid.linewidth": 0.6,
        "text.color": theme.ink,
        "xtick.color": theme.rule,
        "ytick.color": theme.rule,
        "xtick.labelcolor": theme.soft,
        "ytick.labelcolor": theme.soft,
        "xtick.labelsize": 8.0,
        "ytick.labelsize": 8.0,
        "legend.fontsize": 8.0,
        "legend.frameon": False,
        "legend.labelcolor": theme.soft,
        "lines.linewidth": 1.4,
        "lines.solid_capstyle": "round",
        "path.simplify": True,
    }
    with matplotlib.rc_context():
        # Otherwise any `matplotlibrc` in the working directory would apply.
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(settings)
        yield


def new_figure(title: str, *, width: float, height: float) -> Figure:
    """Return a figure of a size [inch] with its title; without pyplot, which keeps global state."""
    layout = ConstrainedLayoutEngine(w_pad=0.12, h_pad=0.12, wspace=0.04, hspace=0.06)
    figure = Figure(figsize=(width, height), dpi=DPI, layout=layout)
    FigureCanvasAgg(figure)
    figure.suptitle(title, x=0.012, ha="left", fontsize=12.0, fontweight="bold")
    return figure


def time_axis(axes: Axes, end_s: float) -> None:
    """Set the time axis from 0 to the end [s] of the run."""
    axes.set_xlabel("time [s]")
    axes.set_xlim(0.0, max(end_s, _SHORTEST_S))


def write_name(axes: Axes, name: str, place: Array, theme: Colours) -> None:
    """Write a name next to a point (2,), in units of the axes, readable over lines."""
    axes.annotate(
        name,
        (place[0], place[1]),
        xytext=(4, 4),
        textcoords="offset points",
        fontsize=7.5,
        color=theme.soft,
        annotation_clip=True,
        path_effects=[withStroke(linewidth=2.0, foreground=theme.panel)],
    )


def mark_start(axes: Axes, start: Array, theme: Colours) -> None:
    """Draw a ring at the start of a path (2,) or (3,), in units of the axes."""
    axes.plot(
        *start[:, None],
        marker="o",
        markersize=8,
        fillstyle="none",
        markeredgewidth=1.6,
        linestyle="none",
        color=theme.ink,
        label="start",
    )
