"""How near the bodies of the cell come in each move, and what each move hits."""

from __future__ import annotations

from collections.abc import Mapping, Set

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rapidsim.collisions.contact import Clearance
from rapidsim.plots.sampled_run import MM, number_of, title_of
from rapidsim.plots.theme import Theme, new_figure, time_axis
from rapidsim.simulation.results.sampling import SampledRun


def clearance_picture(run: SampledRun, theme: Theme) -> Figure | None:
    """The nearest of each move from its start to its end, contacts at 0; None where none is known.

    Moves that nothing came near have no line.
    """
    collisions = run.simulation.collisions
    if collisions is None:
        return None
    number = number_of(run)
    nearest = {one.move: one for one in collisions.report.clearances if one.robot == number}
    hits = [one for one in collisions.report.contacts if one.robot == number]
    if not nearest and not hits:
        return None
    figure = new_figure(f"Clearance: {title_of(run)}", width=11.0, height=4.2)
    axes = figure.subplots()
    touched = {one.move for one in hits}
    _draw_moves(axes, run, nearest, touched, theme)
    calm = [one for move, one in nearest.items() if move not in touched]
    for places, colour in (
        ([(one.time_s, MM * one.distance_m) for one in calm], theme.tcp),
        ([(one.time_s, 0.0) for one in hits], theme.failed),
    ):
        if places:
            axes.plot(*np.transpose(places), "o", color=colour, markersize=4.0)
    if collisions.geometry.clearance_m:
        wanted = MM * collisions.geometry.clearance_m
        axes.axhline(wanted, color=theme.limit, linestyle="--", linewidth=0.9)
        axes.annotate("to keep", (run.end_s, wanted), va="bottom", ha="right", color=theme.soft)
    axes.set_ylim(bottom=-2.0 if hits else 0.0)
    axes.set_ylabel("nearest of the move [mm]")
    moves = "1 move hits" if len(touched) == 1 else f"{len(touched)} moves hit"
    axes.set_title(f"{moves} something" if touched else "nothing is hit")
    time_axis(axes, run.end_s)
    return figure


def _draw_moves(
    axes: Axes,
    run: SampledRun,
    nearest: Mapping[int, Clearance],
    touched: Set[int],
    theme: Theme,
) -> None:
    for move in run.robot_run.moves:
        if move.index in touched:
            least, colour = 0.0, theme.failed
        elif move.index in nearest:
            least, colour = MM * nearest[move.index].distance_m, theme.tcp
        else:
            continue
        axes.hlines(least, move.start_s, max(move.end_s, move.start_s), colour, linewidth=2.4)
