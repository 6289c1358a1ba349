"""The path of the TCP: in space and from three sides, with targets and zones."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle
from matplotlib.ticker import MaxNLocator
from mpl_toolkits.mplot3d.axes3d import Axes3D

from rapidsim.controller.moves.executed_move import CornerKind
from rapidsim.frames.transform import Array
from rapidsim.library.motion import PLAIN_MOVES
from rapidsim.plots.drawn import MM, end_mm, frame_of, pieces, places_mm, target_name, title_of
from rapidsim.plots.look import Theme, new_figure
from rapidsim.simulation.results.sampling import SampledRun

_MOST_NAMES = 25
_MOST_TARGETS = 400
"""Of more, neither points nor zones are drawn: they would cover the path."""
_THIN = 0.5
_NAME_ROOM = np.array([0.07, 0.035])
"""Shares of the width of a view that a name takes, across and upwards."""
_WIDE = 1.45
"""Width of a view through its height."""
_SIDES = (("from above", 0, 1), ("from the side", 0, 2), ("from the front", 1, 2))
_AXES = ("x [mm]", "y [mm]", "z [mm]")


def path_picture(run: SampledRun, theme: Theme) -> Figure:
    """The path in four views."""
    figure = new_figure(f"Path of the TCP: {title_of(run)}", width=11.0, height=8.4)
    grid = figure.add_gridspec(2, 2)
    space: Axes3D = figure.add_subplot(grid[0, 0], projection="3d")
    _draw_space(space, run, theme)
    for place, (name, first, second) in zip(
        (grid[0, 1], grid[1, 0], grid[1, 1]), _SIDES, strict=True
    ):
        axes = figure.add_subplot(place)
        axes.set_title(name)
        _draw_side(axes, run, theme, first, second)
    handles, labels = space.get_legend_handles_labels()
    figure.legend(handles, labels, loc="upper right", ncols=len(labels))
    return figure


def _draw_space(axes: Axes3D, run: SampledRun, theme: Theme) -> None:
    axes.set_title(f"in space, {frame_of(run)}")
    for label, colour, place in _stretches(run, theme):
        axes.plot(*place.T, color=colour, label=label, linewidth=_width(run))
    targets = _targets(run)
    if len(targets) <= _MOST_TARGETS:
        places = np.array([place for _, place in targets]).reshape(-1, 3)
        axes.scatter(*places.T, color=theme.ink, s=8, depthshade=False)
    _draw_failed(axes, run, theme, (0, 1, 2))
    axes.set_xlabel(_AXES[0])
    axes.set_ylabel(_AXES[1])
    axes.set_zlabel(_AXES[2])
    _draw_as_cube(axes, run)
    axes.view_init(elev=26.0, azim=-50.0)
    for pane in (axes.xaxis, axes.yaxis, axes.zaxis):
        pane.set_pane_color((0.0, 0.0, 0.0, 0.0))
        pane.set_major_locator(MaxNLocator(5))


def _width(run: SampledRun) -> float:
    """Width of the path: thin where many stretches lie side by side."""
    return 1.4 if len(run.one.moves) <= _MOST_TARGETS else _THIN


def _draw_as_cube(axes: Axes3D, run: SampledRun) -> None:
    """Give the three axes one scale and one length, so that a flat path keeps readable axes."""
    failed = [MM * failed.way for failed in run.one.failed_moves]
    points = np.concatenate([places_mm(run), *failed])
    middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
    half = 0.5 * max(float(np.ptp(points, axis=0).max()), 1.0)
    for set_ends, centre in zip((axes.set_xlim, axes.set_ylim, axes.set_zlim), middle, strict=True):
        set_ends(centre - half, centre + half)
    axes.set_box_aspect((1.0, 1.0, 1.0), zoom=1.05)


def _draw_side(axes: Axes, run: SampledRun, theme: Theme, first: int, second: int) -> None:
    for _, colour, place in _stretches(run, theme):
        axes.plot(place[:, first], place[:, second], color=colour, linewidth=_width(run))
    targets = _targets(run)
    for move in run.one.moves if len(targets) <= _MOST_TARGETS else ():
        if move.corner is CornerKind.FLY_BY and move.zone_m > 0.0:
            centre = end_mm(run, move)
            zone = Circle(
                (centre[first], centre[second]),
                MM * move.zone_m,
                fill=False,
                color=theme.corner,
                linewidth=0.8,
                alpha=0.7,
            )
            axes.add_patch(zone)
    places = np.array([place for _, place in targets])[:, (first, second)]
    if len(targets) <= _MOST_TARGETS:
        axes.plot(*places.T, "o", color=theme.ink, markersize=2.6)
    if len(targets) <= _MOST_NAMES:
        names = [name for name, _ in targets]
        for name, place in _apart(names, places, places_mm(run)[:, (first, second)]):
            axes.annotate(
                name,
                (place[0], place[1]),
                xytext=(4, 4),
                textcoords="offset points",
                fontsize=7.5,
                color=theme.soft,
            )
    _draw_failed(axes, run, theme, (first, second))
    axes.set_xlabel(_AXES[first])
    axes.set_ylabel(_AXES[second])
    axes.set_aspect("equal", adjustable="datalim")


def _apart(names: list[str], places: Array, sweep: Array) -> list[tuple[str, Array]]:
    """Names at places (k, 2) [mm] that leave room for one another; the others are left out."""
    spans = np.ptp(np.concatenate([places, sweep]), axis=0)
    room = _NAME_ROOM * max(float(spans[0]), _WIDE * float(spans[1]), 1.0)
    kept: list[tuple[str, Array]] = []
    for name, place in zip(names, places, strict=True):
        if all(np.any(np.abs(place - other) > room) for _, other in kept):
            kept.append((name, place))
    return kept


def _stretches(run: SampledRun, theme: Theme) -> list[tuple[str, str, Array]]:
    """Label, colour and places (k, 3) [mm] of stretches; a label stands at the first of a kind."""
    found: list[tuple[str, str, Array]] = []
    moves = run.one.moves
    if not moves:
        return found
    kinds = np.array([list(PLAIN_MOVES).index(move.move.interpolation) for move in moves])
    kind = kinds[np.clip(run.samples.move, 0, len(moves) - 1)]
    for interpolation in dict.fromkeys(move.move.interpolation for move in moves):
        mask = (kind == list(PLAIN_MOVES).index(interpolation)) & ~run.in_corner
        found += _of_kind(run, mask, PLAIN_MOVES[interpolation], theme.moves[interpolation])
    return found + _of_kind(run, run.in_corner, "corner", theme.corner)


def _of_kind(
    run: SampledRun, mask: np.typing.NDArray[np.bool_], label: str, colour: str
) -> list[tuple[str, str, Array]]:
    """Stretches of one kind, as one line with gaps: many lines would take long to draw."""
    places, gap = places_mm(run), np.full((1, 3), np.nan)
    parts = [part for piece in pieces(mask) for part in (places[piece], gap)]
    return [(label, colour, np.concatenate(parts))] if parts else []


def _targets(run: SampledRun) -> list[tuple[str, Array]]:
    """Each target once, with its place (3,) [mm]."""
    found: dict[tuple[str, ...], tuple[str, Array]] = {}
    for move in run.one.moves:
        place = end_mm(run, move)
        name = target_name(move)
        found.setdefault((name, *(f"{x:.2f}" for x in place)), (name, place))
    return list(found.values())


def _draw_failed(axes: Axes, run: SampledRun, theme: Theme, shown: tuple[int, ...]) -> None:
    label: str | None = "not possible"
    for failed in run.one.failed_moves:
        way = MM * failed.way[:, shown]
        axes.plot(*way.T, color=theme.failed, linestyle="--", linewidth=1.0)
        at = MM * failed.fails_at[list(shown)]
        axes.plot(
            *([x] for x in at),
            marker="x",
            linestyle="none",
            color=theme.failed,
            markersize=7,
            markeredgewidth=2,
            label=label,
        )
        label = None
