"""Themes of all pictures, light and dark: colours by meaning, small type, faint grid lines."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from types import MappingProxyType
from typing import Any

import matplotlib
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.patheffects import withStroke

from rapidsim.frames.transform import Array
from rapidsim.language.moves import Interpolation
from rapidsim.simulation.results.move_kinds import CORNER, MOVE_KINDS
from rapidsim.values import value_class

DPI = 144
_SHORTEST_S = 1e-3
"""[s]; no axis is shorter."""


@value_class(frozen=True, slots=True)
class Theme:
    """Colours of one theme."""

    name: str
    page: str
    ink: str
    soft: str
    rule: str
    programmed: str
    tcp: str
    limit: str
    corner: str
    failed: str
    bar: str
    moves: Mapping[Interpolation, str]
    joints: tuple[str, ...]


LIGHT = Theme(
    name="light",
    page="#ffffff",
    ink="#1b2330",
    soft="#5c6675",
    rule="#dde1e7",
    programmed="#8a93a1",
    tcp="#d97800",
    limit="#c62828",
    corner=CORNER.on_light,
    failed="#c62828",
    bar="#0b62c4",
    moves=MappingProxyType({way: kind.on_light for way, kind in MOVE_KINDS.items()}),
    joints=(
        "#d93b38", "#2f9a44", "#2f6fe0", "#c79000", "#9440b8", "#0f97ad", "#e0663c", "#77828c",
    ),
)  # fmt: skip
DARK = Theme(
    name="dark",
    page="#161a20",
    ink="#e6e9ee",
    soft="#98a2b1",
    rule="#2e3540",
    programmed="#7d8796",
    tcp="#ffa12e",
    limit="#ff6b62",
    corner=CORNER.on_dark,
    failed="#ff6b62",
    bar="#6db1ff",
    moves=MappingProxyType({way: kind.on_dark for way, kind in MOVE_KINDS.items()}),
    joints=(
        "#ef5350", "#66bb6a", "#4f93ff", "#ffca28", "#c17bd3", "#26c6da", "#ff8a65", "#b0bec5",
    ),
)  # fmt: skip


@contextmanager
def themed(theme: Theme) -> Iterator[None]:
    """Apply a theme to figures made in the block; nothing outside it changes."""
    settings: dict[Any, Any] = {
        "font.family": "DejaVu Sans",
        "font.size": 9.0,
        "figure.facecolor": theme.page,
        "savefig.facecolor": theme.page,
        "axes.facecolor": theme.page,
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


def write_name(axes: Axes, name: str, place: Array, theme: Theme) -> None:
    """Write a name next to a point (2,), in units of the axes, readable over lines."""
    axes.annotate(
        name,
        (place[0], place[1]),
        xytext=(4, 4),
        textcoords="offset points",
        fontsize=7.5,
        color=theme.soft,
        annotation_clip=True,
        path_effects=[withStroke(linewidth=2.0, foreground=theme.page)],
    )


def mark_start(axes: Axes, start: Array, theme: Theme) -> None:
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
