"""Attribution of a run's findings to the targets of moves, as in a check."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace

from rapidsim.analysis.program import Program
from rapidsim.analysis.tree_walk import descendants
from rapidsim.diagnostics import Diagnostic, Span
from rapidsim.findings.reach_and_motion_data import (
    CircleUncertain,
    ConfigurationChangesOnLine,
    ConfigurationNotReachable,
    JointOutOfRange,
    MainAxesSwitched,
    PathConfiguration,
    PathNotReachable,
    PathThroughSingularity,
    UnreachableTarget,
    WristTurnsFar,
)
from rapidsim.findings.wrist_circles import WristCircleFails
from rapidsim.language.target_violations import QuaternionNotUnit
from rapidsim.syntax import tree

_ABOUT_TARGETS = (
    *(UnreachableTarget, JointOutOfRange, ConfigurationNotReachable, ConfigurationChangesOnLine),
    *(PathNotReachable, PathThroughSingularity, PathConfiguration, WristCircleFails),
    *(CircleUncertain, QuaternionNotUnit, MainAxesSwitched, WristTurnsFar),
)
_TARGETS = ("robtarget", "jointtarget")


def attribute_to_targets(
    diagnostics: Iterable[Diagnostic], programs: Iterable[Program]
) -> tuple[Diagnostic, ...]:
    """Return the findings at targets; those of a run refer only to instructions."""
    found = tuple(diagnostics)
    if not any(isinstance(one.violation, _ABOUT_TARGETS) for one in found):
        return found
    programs = tuple(programs)
    places = dict(place for program in programs for place in _targets(program))
    runs = [(one, run) for program in programs for one in program.modules for run in one.runs]
    return tuple(_pointed(one, places, runs) for one in found)


def _pointed(
    finding: Diagnostic,
    places: Mapping[tuple[str, int, int], Span],
    runs: Iterable[tuple[tree.Module, tree.BulkStatements]],
) -> Diagnostic:
    if not isinstance(finding.violation, _ABOUT_TARGETS) or finding.span is None:
        return finding
    span = finding.span
    for module, run in runs:
        row = run.row_at(span.start) if module.source.file == span.file else None
        if row is not None:
            return replace(finding, span=module.span(row.target))
    return replace(finding, span=places.get((span.file, span.start, span.end), span))


def _targets(program: Program) -> Iterator[tuple[tuple[str, int, int], Span]]:
    """Yield the span of each instruction with targets, and that of its last one, the end point."""
    for module in program.modules:
        for node in descendants(module):
            if not isinstance(node, tree.Call):
                continue
            values = [one.value for one in node.arguments if isinstance(one, tree.RequiredArgument)]
            targets = [one for one in values if _is_target(program, one)]
            if targets:
                span = module.span(node)
                yield (span.file, span.start, span.end), module.span(targets[-1])


def _is_target(program: Program, value: tree.Expression) -> bool:
    of = program.type_of.get(value)
    return of is not None and of.name in _TARGETS
