"""Clearance of the bodies of the cell in each move, and the contacts of each move."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rapidsim.colours import Colours
from rapidsim.plots.sampled_run import MM, number_of, title_of
from rapidsim.plots.theme import new_figure, time_axis
from rapidsim.simulation.results.sampling import SampledRun


def clearance_picture(run: SampledRun, theme: Colours) -> Figure | None:
    """Draw the clearance of each move over its time, contacts at 0; None without any data.

    Moves without nearby bodies have no line.
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
    least = {move: MM * one.distance_m for move, one in nearest.items()}
    least |= dict.fromkeys(touched, 0.0)
    for move in run.robot_run.moves:
        if move.index in least:
            colour = theme.error if move.index in touched else theme.tcp
            end_s = max(move.end_s, move.start_s)
            axes.hlines(least[move.index], move.start_s, end_s, colour, linewidth=2.4)
    calm = [(one.time_s, least[move]) for move, one in nearest.items() if move not in touched]
    _draw_dots(axes, calm, theme.tcp)
    _draw_dots(axes, [(one.time_s, 0.0) for one in hits], theme.error)
    if collisions.geometry.clearance_m:
        wanted = MM * collisions.geometry.clearance_m
        axes.axhline(wanted, color=theme.error, linestyle="--", linewidth=0.9)
        axes.annotate("to keep", (run.end_s, wanted), va="bottom", ha="right", color=theme.soft)
    axes.set_ylim(bottom=-2.0 if hits else 0.0)
    axes.set_ylabel("nearest of the move [mm]")
    moves = "1 move hits" if len(touched) == 1 else f"{len(touched)} moves hit"
    axes.set_title(f"{moves} something" if touched else "nothing is hit")
    time_axis(axes, run.end_s)
    return figure


def _draw_dots(axes: Axes, places: Sequence[tuple[float, float]], colour: str) -> None:
    if places:
        axes.plot(*np.transpose(places), "o", color=colour, markersize=4.0)
