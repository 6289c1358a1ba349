"""Time per line of the program."""

from __future__ import annotations

from pathlib import Path

from matplotlib.figure import Figure

from rapidsim.colours import Colours
from rapidsim.controller.journal.events import Wait
from rapidsim.language.moves import Interpolation
from rapidsim.plots.sampled_run import target_name, title_of
from rapidsim.plots.theme import new_figure
from rapidsim.simulation.results.move_kinds import MOVE_KINDS
from rapidsim.simulation.results.sampling import SampledRun
from rapidsim.simulation.results.time_shares import Step, instruction_of

_MOST_LINES = 30


def lines_picture(run: SampledRun, theme: Colours) -> Figure:
    """Draw the time in moves and waits of each line, in program order; of many, the slowest."""
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
        color=[
            theme.soft if kind is None else theme.moves[MOVE_KINDS[kind]] for _, _, kind in shown
        ],
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
    axes.set_xlabel("time in moves and waits [s]")
    left = len(rows) - len(shown)
    if left:
        rest = sum(seconds for _, seconds, _ in rows) - sum(seconds for _, seconds, _ in shown)
        axes.set_title(f"the {len(shown)} slowest of {len(rows)} lines; the others {rest:.3f} s")
    return figure


def _rows(run: SampledRun) -> list[tuple[str, float, Interpolation | None]]:
    """Text, time [s] and kind of each line that moves or waits, in the order of the program.

    Waits have no kind.
    """
    waits = (wait for wait in run.simulation.waits if wait.task == run.robot_run.task)
    lines: dict[tuple[str, int, bool], list[Step]] = {}
    steps: tuple[Step, ...] = (*run.robot_run.moves, *waits)
    for step in steps:
        span, is_wait = step.place.span, isinstance(step, Wait)
        lines.setdefault((span.file, span.line, is_wait), []).append(step)
    return [
        (
            f"{Path(file).name}:{number}  {_words(steps[0])}"
            + (f"  ×{len(steps)}" if len(steps) > 1 else ""),
            sum(step.end_s - step.start_s for step in steps),
            None if isinstance(steps[0], Wait) else steps[0].move.interpolation,
        )
        for (file, number, _), steps in sorted(lines.items(), key=lambda item: item[0])
    ]


def _words(step: Step) -> str:
    goal = step.awaited if isinstance(step, Wait) else target_name(step)
    return f"{instruction_of(step)} {goal}"
