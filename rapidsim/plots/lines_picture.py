"""Which lines of the program cost the time."""

from __future__ import annotations

from pathlib import Path

from matplotlib.figure import Figure

from rapidsim.controller.moves.executed_move import ExecutedMove
from rapidsim.language.moves import Interpolation
from rapidsim.plots.drawn import target_name, title_of
from rapidsim.plots.look import Theme, new_figure
from rapidsim.simulation.results.sampling import SampledRun

_MOST_LINES = 30


def lines_picture(run: SampledRun, theme: Theme) -> Figure:
    """The time in the moves of each line, in the order of the program; the slowest of many."""
    rows = _rows(run)
    order = sorted(range(len(rows)), key=lambda place: -rows[place][1])
    shown = [rows[place] for place in sorted(order[:_MOST_LINES])]
    figure = new_figure(
        f"Time by line: {title_of(run)}", width=11.0, height=1.4 + 0.27 * max(len(shown), 2)
    )
    axes = figure.subplots()
    places = range(len(shown))
    axes.barh(
        places,
        [seconds for _, seconds, _ in shown],
        color=[theme.moves[kind] for _, _, kind in shown],
        height=0.68,
    )
    for place, (_, seconds, _) in enumerate(shown):
        axes.annotate(
            f"{seconds:.3f} s",
            (seconds, place),
            xytext=(4, 0),
            textcoords="offset points",
            va="center",
            fontsize=8.0,
            color=theme.soft,
        )
    axes.set_yticks(list(places), [words for words, _, _ in shown])
    axes.tick_params(axis="y", length=0)
    axes.invert_yaxis()
    axes.grid(visible=False, axis="y")
    axes.margins(x=0.1)
    axes.set_xlabel("time in moves [s]")
    left = len(rows) - len(shown)
    if left:
        rest = sum(seconds for _, seconds, _ in rows) - sum(seconds for _, seconds, _ in shown)
        axes.set_title(f"the {len(shown)} slowest of {len(rows)} lines; the others {rest:.3f} s")
    return figure


def _rows(run: SampledRun) -> list[tuple[str, float, Interpolation]]:
    """Words, time [s] and kind of each line that moves, in the order of the program."""
    lines: dict[tuple[str, int], list[ExecutedMove]] = {}
    for move in run.one.moves:
        lines.setdefault((move.place.span.file, move.place.span.line), []).append(move)
    return [
        (
            f"{Path(file).name}:{number}  {moves[0].move.instruction} {target_name(moves[0])}"
            + (f"  ×{len(moves)}" if len(moves) > 1 else ""),
            sum(move.end_s - move.start_s for move in moves),
            moves[0].move.interpolation,
        )
        for (file, number), moves in sorted(lines.items())
    ]
