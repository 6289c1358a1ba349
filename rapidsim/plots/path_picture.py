"""Path of the TCP: in space and from three sides, with targets and zones."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Rectangle
from matplotlib.ticker import MaxNLocator
from mpl_toolkits.mplot3d.axes3d import Axes3D

from rapidsim.colours import Colours
from rapidsim.controller.moves.executed_move import CornerKind
from rapidsim.frames.transform import Array
from rapidsim.library.motion import PLAIN_MOVES
from rapidsim.plots.cell_outline import CellOutline, cell_of, draw_cell, draw_cell_in_space, grown
from rapidsim.plots.sampled_run import (
    MM,
    end_mm,
    frame_of,
    pieces,
    places_mm,
    target_name,
    title_of,
)
from rapidsim.plots.stick_arm import as_cube
from rapidsim.plots.theme import mark_start, new_figure, write_name
from rapidsim.simulation.results.move_kinds import CORNER, MOVE_KINDS
from rapidsim.simulation.results.sampling import SampledRun

_MOST_NAMES = 25
_MOST_TARGETS = 400
"""Number of targets above which neither points nor zones are drawn: they would hide the path."""
_THIN = 0.5
_LETTER, _NAME_HEIGHT = 0.0125, 0.035
"""Width of a letter and height of a name, relative to the width of a view."""
_WIDE = 1.45
"""Aspect ratio (width / height) of a view."""
_SMALL = 0.45
"""Share of the whole path below which its lines and arcs get separate views."""
_AIR = 0.2
_SIDES = (("from above", 0, 1), ("from the side", 0, 2), ("from the front", 1, 2))
_AXES = ("x [mm]", "y [mm]", "z [mm]")


def path_picture(run: SampledRun, theme: Colours) -> Figure:
    """Draw the path in four views; and its lines and arcs from near, if they are small."""
    box, cell = _drawing(run), cell_of(run, theme)
    rows = 1 if box is None else 2
    shape = (2, 2) if box is None else (rows, 4)
    size = (11.0, 8.4) if box is None else (17.0, 8.6)
    figure = new_figure(f"Path of the TCP: {title_of(run)}", width=size[0], height=size[1])
    grid = figure.add_gridspec(*shape)
    places = [grid[k // shape[1], k % shape[1]] for k in range(4 * rows)]
    space: Axes3D = figure.add_subplot(places[0], projection="3d")
    _draw_space(space, run, theme, cell)
    for place, (name, first, second) in zip(places[1:4], _SIDES, strict=True):
        axes = figure.add_subplot(place)
        axes.set_title(name)
        _draw_side(axes, run, theme, (first, second), box, cell)
        draw_cell(axes, cell, theme, (first, second))
    if box is not None:
        near: Axes3D = figure.add_subplot(places[4], projection="3d")
        _draw_space(near, run, theme, cell, box)
        for place, (name, first, second) in zip(places[5:], _SIDES, strict=True):
            axes = figure.add_subplot(place)
            axes.set_title(f"lines and arcs, {name}")
            draw_cell(axes, cell, theme, (first, second))
            _draw_near(axes, run, theme, (first, second), box)
    handles, labels = space.get_legend_handles_labels()
    figure.legend(handles, labels, loc="upper right", ncols=len(labels))
    return figure


def _draw_space(
    axes: Axes3D, run: SampledRun, theme: Colours, cell: CellOutline, box: Array | None = None
) -> None:
    """Draw the path in space; with a box (2, 3) [mm] only the part within it."""
    what = "in space" if box is None else "lines and arcs, in space"
    axes.set_title(f"{what}, {frame_of(run)}")
    for label, colour, place in _path_sections(run, theme):
        if box is not None:
            place = np.where(_inside(place, box)[:, None], place, np.nan)
        axes.plot(*place.T, color=colour, label=label, linewidth=_width(run))
    targets = _targets(run)
    if len(targets) <= _MOST_TARGETS:
        places = np.array([place for _, place in targets]).reshape(-1, 3)
        places = places if box is None else places[_inside(places, box)]
        axes.scatter(*places.T, color=theme.ink, s=8, depthshade=False)
    if box is None:
        _draw_start(axes, run, theme, (0, 1, 2))
        _draw_failed(axes, run, theme, (0, 1, 2))
        failed = [MM * one.curve for one in run.robot_run.failed_moves]
        points = np.concatenate([places_mm(run), *failed])
        shown = grown(points) if cell.bodies else points
    else:
        shown = box
    as_cube(axes, shown)
    draw_cell_in_space(axes, cell, theme)
    axes.set_xlabel(_AXES[0])
    axes.set_ylabel(_AXES[1])
    axes.set_zlabel(_AXES[2])
    axes.view_init(elev=26.0, azim=-50.0)
    for pane in (axes.xaxis, axes.yaxis, axes.zaxis):
        pane.set_pane_color((0.0, 0.0, 0.0, 0.0))
        pane.set_major_locator(MaxNLocator(5))


def _inside(places: Array, box: Array) -> np.typing.NDArray[np.bool_]:
    """Mask of points (k, 3) within a box (2, 3)."""
    inside: np.typing.NDArray[np.bool_] = np.all((places >= box[0]) & (places <= box[1]), axis=1)
    return inside


def _width(run: SampledRun) -> float:
    """Return the line width of the path: thin if it has many adjacent sections."""
    return 1.4 if len(run.robot_run.moves) <= _MOST_TARGETS else _THIN


def _draw_side(
    axes: Axes,
    run: SampledRun,
    theme: Colours,
    view: tuple[int, int],
    box: Array | None,
    cell: CellOutline,
) -> None:
    """Draw the whole path from a side, with a frame around the part in the near view."""
    _draw_work(axes, run, theme, view)
    _draw_start(axes, run, theme, view)
    targets = _targets(run)
    if box is not None:
        targets = [one for one in targets if not _inside(one[1][None], box)[0]]
        (left, bottom), (width, height) = box[0, view], np.ptp(box, axis=0)[list(view)]
        frame = Rectangle(
            (left, bottom), width, height, fill=False, color=theme.soft, linewidth=0.9
        )
        axes.add_patch(frame)
    places = grown(places_mm(run)) if cell.bodies else places_mm(run)
    _draw_names(axes, targets, places[:, view], theme, view)
    _draw_failed(axes, run, theme, view)
    _label(axes, view)
    axes.set_aspect("equal", adjustable="datalim")


def _draw_near(
    axes: Axes, run: SampledRun, theme: Colours, view: tuple[int, int], box: Array
) -> None:
    """Draw the contents of a box (2, 3) [mm], from a side."""
    _draw_work(axes, run, theme, view)
    inside = [one for one in _targets(run) if _inside(one[1][None], box)[0]]
    _draw_names(axes, inside, box[:, view], theme, view)
    _draw_failed(axes, run, theme, view)
    middle, half = box[:, view].mean(axis=0), 0.5 * float(np.ptp(box, axis=0).max())
    # One scale for all sides: a drawing seen edge on is a line, and looks like one.
    axes.set_xlim(middle[0] - half, middle[0] + half)
    axes.set_ylim(middle[1] - half, middle[1] + half)
    _label(axes, view)
    axes.set_aspect("equal", adjustable="box")


def _label(axes: Axes, view: tuple[int, int]) -> None:
    axes.set_xlabel(_AXES[view[0]])
    axes.set_ylabel(_AXES[view[1]])


def _drawing(run: SampledRun) -> Array | None:
    """Return the box (2, 3) [mm] around lines and arcs; None if large enough in the whole view."""
    lines = [
        number
        for number, move in enumerate(run.robot_run.moves)
        if move.move.interpolation.leads_tcp
    ]
    swept = places_mm(run)
    drawn = swept[np.isin(run.samples.move, lines)]
    if len(drawn) < 2 or len(lines) < 2:
        return None
    # Use only the ends of lines, without the approach to the work and the retreat.
    ends = np.array([end_mm(run, run.robot_run.moves[number]) for number in lines])
    low, high = ends.min(axis=0), ends.max(axis=0)
    size = float(np.max(high - low))
    if not 0.0 < size < _SMALL * float(np.ptp(swept, axis=0).max()):
        return None
    return np.stack([low - _AIR * size, high + _AIR * size])


def _draw_work(axes: Axes, run: SampledRun, theme: Colours, view: tuple[int, int]) -> None:
    """Draw path, targets and zones from a side."""
    for _, colour, place in _path_sections(run, theme):
        axes.plot(*place[:, view].T, color=colour, linewidth=_width(run))
    targets = _targets(run)
    if len(targets) > _MOST_TARGETS:
        return
    for move in run.robot_run.moves:
        if move.corner is CornerKind.FLY_BY and move.zone_m > 0.0:
            centre = end_mm(run, move)[list(view)]
            zone = Circle(
                (centre[0], centre[1]),
                MM * move.zone_m,
                fill=False,
                color=theme.moves[CORNER],
                linewidth=0.8,
                alpha=0.7,
            )
            axes.add_patch(zone)
    places = np.array([place for _, place in targets])[:, view]
    axes.plot(*places.T, "o", color=theme.ink, markersize=2.6)


def _draw_names(
    axes: Axes,
    targets: list[tuple[str, Array]],
    sweep: Array,
    theme: Colours,
    view: tuple[int, int],
) -> None:
    """Draw names of targets in a view of `sweep` (k, 2) [mm]."""
    if not 0 < len(targets) <= _MOST_NAMES:
        return
    places = np.array([place for _, place in targets])[:, view]
    names = [name for name, _ in targets]
    for name, place in _spread_labels(names, places, sweep):
        write_name(axes, name, place, theme)


def _draw_start(axes: Axes, run: SampledRun, theme: Colours, view: tuple[int, ...]) -> None:
    """Draw a ring at the TCP before the first move."""
    mark_start(axes, places_mm(run)[0, view], theme)


def _spread_labels(names: list[str], places: Array, sweep: Array) -> list[tuple[str, Array]]:
    """Return names at points (k, 2) [mm] that do not overlap earlier ones; omit the others."""
    spans = np.ptp(np.concatenate([places, sweep]), axis=0)
    width = max(float(spans[0]), _WIDE * float(spans[1]), 1.0)
    kept: list[tuple[str, Array]] = []
    for name, place in zip(names, places, strict=True):
        for other, near in kept:
            right, up = place - near
            letters = len(other if right > 0.0 else name)
            if abs(right) <= _LETTER * width * letters and abs(up) <= _NAME_HEIGHT * width:
                break
        else:
            kept.append((name, place))
    return kept


def _path_sections(run: SampledRun, theme: Colours) -> list[tuple[str, str, Array]]:
    """Return label, colour and points (k, 3) [mm] of sections; the first of a kind has a label."""
    found: list[tuple[str, str, Array]] = []
    moves = run.robot_run.moves
    if not moves:
        return found
    kinds = np.array([list(PLAIN_MOVES).index(move.move.interpolation) for move in moves])
    kind = kinds[np.clip(run.samples.move, 0, len(moves) - 1)]
    for interpolation in dict.fromkeys(move.move.interpolation for move in moves):
        mask = (kind == list(PLAIN_MOVES).index(interpolation)) & ~run.in_corner
        found += _of_kind(
            run, mask, PLAIN_MOVES[interpolation], theme.moves[MOVE_KINDS[interpolation]]
        )
    return found + _of_kind(run, run.in_corner, "corner", theme.moves[CORNER])


def _of_kind(
    run: SampledRun, mask: np.typing.NDArray[np.bool_], label: str, colour: str
) -> list[tuple[str, str, Array]]:
    """Return sections of one kind, as one line with gaps: many lines would be slow to draw."""
    places, gap = places_mm(run), np.full((1, 3), np.nan)
    parts = [part for piece in pieces(mask) for part in (places[piece], gap)]
    return [(label, colour, np.concatenate(parts))] if parts else []


def _targets(run: SampledRun) -> list[tuple[str, Array]]:
    """Return each target position once (3,) [mm], with its first name."""
    found: dict[tuple[str, ...], tuple[str, Array]] = {}
    for move in run.robot_run.moves:
        place = end_mm(run, move)
        found.setdefault(tuple(f"{x:.1f}" for x in place), (target_name(move), place))
    return list(found.values())


def _draw_failed(axes: Axes, run: SampledRun, theme: Colours, view: tuple[int, ...]) -> None:
    label: str | None = "not possible"
    for failed in run.robot_run.failed_moves:
        way = MM * failed.curve[:, view]
        axes.plot(*way.T, color=theme.error, linestyle="--", linewidth=1.0)
        at = MM * failed.fails_at[list(view)]
        axes.plot(
            *([x] for x in at),
            marker="x",
            linestyle="none",
            color=theme.error,
            markersize=7,
            markeredgewidth=2,
            label=label,
        )
        label = None
