"""Findings about cycle time, if there is a budget: cycles that take too long, needless stops."""

from __future__ import annotations

import re
from collections.abc import Iterator

import numpy as np

from rapidsim.analysis.program import Program
from rapidsim.diagnostics import Diagnostic
from rapidsim.findings.cycle_time import AvoidableStop, CycleOverBudget
from rapidsim.language.moves import Interpolation
from rapidsim.reach.dataflow.abstract_interpreter import ENTRY
from rapidsim.reach.path_findings import SurveyedPaths
from rapidsim.reach.target_poses import PosedMoves
from rapidsim.reach.trial_run import RunMoves
from rapidsim.reach.wording import target_span, target_text

_STRAIGHT = np.cos(np.radians(1.0))
_SHORTEST = 1e-5
_NOTHING_BETWEEN = re.compile(r"(?:[;\s]|![^\r\n]*)*")


def budget_findings(
    program: Program, run_moves: RunMoves, budget_s: float, model: str
) -> Iterator[Diagnostic]:
    """D701: a cycle that exceeds its budget, or whose duration the run does not determine."""
    main = program.routines.get(ENTRY)
    if main is None or (run_moves.time_s is not None and run_moves.time_s <= budget_s):
        return
    taken = (
        f"{run_moves.time_s:.2f} s" if run_moves.time_s is not None else run_moves.duration_unknown
    )
    span = main.module.span(main.node.name)
    yield Diagnostic(CycleOverBudget(taken, budget_s, model), span, routine=main.name)


def stop_findings(
    program: Program, posed: PosedMoves, surveyed: SurveyedPaths
) -> Iterator[Diagnostic]:
    """D702: a stop point between two lines in one direction with nothing between them."""
    for after in np.flatnonzero(surveyed.is_surveyed).tolist():
        known, before = posed.moves[after], int(posed.moves.previous[after])
        if not surveyed.is_surveyed[before]:
            continue
        stop = posed.moves[before]
        lines = known.move.interpolation is stop.move.interpolation is Interpolation.LINE
        if not lines or stop.move.zone.finep is False or stop.module is not known.module:
            continue
        between = stop.module.source.text[stop.call.end : known.call.start]
        if known.call.start < stop.call.end or not _NOTHING_BETWEEN.fullmatch(between):
            continue
        into, out = (
            one.end.base_from_tcp.translation - one.start.base_from_tcp.translation
            for one in (surveyed.make(before), surveyed.make(after))
        )
        lengths = float(np.linalg.norm(into)), float(np.linalg.norm(out))
        if min(lengths) > _SHORTEST and into @ out >= _STRAIGHT * lengths[0] * lengths[1]:
            found = AvoidableStop(target_text(program, stop))
            yield Diagnostic(found, target_span(program, stop), routine=stop.routine)
