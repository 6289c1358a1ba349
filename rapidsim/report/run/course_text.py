"""The course of a run as text: a line for each move, wait and event, in order of their starts."""

from __future__ import annotations

from collections.abc import Iterator
from math import inf
from pathlib import Path

from rapidsim.controller.journal.events import Event, Wait
from rapidsim.language.moves import Place
from rapidsim.report.findings.source_frame import printable
from rapidsim.simulation.results.simulation import Simulation
from rapidsim.simulation.results.time_shares import Step, goal_of, instruction_of

_Row = tuple[float, float, str, Place | None, str]
"""Start [s], rank among rows that start then, task, place and text."""


def course_lines(simulation: Simulation) -> Iterator[str]:
    """Yield the lines, after a heading."""
    several = len(simulation.tasks) > 1
    rows = sorted(
        (*_moves(simulation), *map(_wait, simulation.waits), *map(_event, simulation.events)),
        key=lambda row: row[:2],
    )
    yield "     time  place and what happened"
    for time_s, _, task, place, what in rows:
        whose = f"{task}  " if several else ""
        where = f"{Path(place.span.file).name}:{place.span.line}  " if place else ""
        yield f"{time_s:9.3f}  {whose}{where}{printable(what)}"


def _moves(simulation: Simulation) -> Iterator[_Row]:
    for robot in simulation.robots:
        for number, move in enumerate(robot.moves):
            what = f"{_timed(move)}, {1000.0 * move.length_m:.1f} mm, {move.corner}"
            # Events before it know of fewer moves.
            yield move.start_s, number + 0.5, move.task, move.place, what


def _wait(wait: Wait) -> _Row:
    # What the program has done before it starts to wait takes no time.
    return wait.start_s, inf, wait.task, wait.place, f"{_timed(wait)}, ended by {wait.ended_by}"


def _event(event: Event) -> _Row:
    return event.time_s, event.moves_given, event.task, event.place, event.message


def _timed(step: Step) -> str:
    return f"{instruction_of(step)} {goal_of(step)}: {step.end_s - step.start_s:.3f} s"
