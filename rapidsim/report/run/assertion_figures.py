"""The figures of a run that an assertion may name, as they are called in the JSON report."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType
from typing import TypeAlias

from rapidsim.controller.moves.executed_move import CornerKind
from rapidsim.diagnostics import Diagnostic, Severity
from rapidsim.report.run.error_records import dropped_error_count, error_count
from rapidsim.report.run.figures import Figures
from rapidsim.simulation.results.parts import PartCounts
from rapidsim.simulation.results.simulation import Simulation

_Read: TypeAlias = Callable[[Simulation, Figures, Sequence[Diagnostic]], float]

NOT_THERE = 9e9
"""Stands for what a run without moves does not have, as 9E9 does in RAPID's own data."""

ASKED_FIGURES: Mapping[str, _Read] = MappingProxyType(
    {
        "time_s": lambda run, *_: run.time_s,
        "motion_s": lambda run, *_: run.motion_s,
        "wait_s": lambda run, *_: run.wait_s,
        "path_mm": lambda run, *_: run.path_m * 1000.0,
        "moves": lambda run, *_: len(run.moves),
        "corner_path_failures": lambda _, figures, __: dict(figures.moves_by_corner).get(
            CornerKind.STOP_CORNER_PATH_FAILURE, 0
        ),
        "margin_deg": lambda _, figures, __: (
            figures.joint_margin.degrees if figures.joint_margin else NOT_THERE
        ),
        "smallest_singular_value": lambda _, figures, __: (
            figures.singularity.smallest_singular_value if figures.singularity else NOT_THERE
        ),
        "warnings": lambda _, __, findings: sum(
            one.severity is Severity.WARNING for one in findings
        ),
        "unsimulated": lambda run, *_: len(run.unsimulated),
        "errors": lambda run, *_: error_count(run),
        "errors_dropped": lambda run, *_: dropped_error_count(run),
        "collisions": lambda run, *_: len(run.collisions.crashes) if run.collisions else 0,
        "parts_moved": lambda run, *_: _part_counts(run).moved,
        "parts_delivered": lambda run, *_: _part_counts(run).delivered,
        "parts_lost": lambda run, *_: _part_counts(run).lost,
    }
)
"""By name, in the order of the documentation."""


def _part_counts(run: Simulation) -> PartCounts:
    return run.collisions.part_counts if run.collisions else PartCounts(0, 0, 0, 0)


def asked_figures(
    simulation: Simulation, figures: Figures, findings: Sequence[Diagnostic]
) -> dict[str, float]:
    """The figures of a run by name.

    Args:
        simulation: The run.
        figures: What its summary shows.
        findings: What checking and running found.
    """
    return {
        name: float(read(simulation, figures, findings)) for name, read in ASKED_FIGURES.items()
    }
