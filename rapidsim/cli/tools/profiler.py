"""`rapidsim run --profile`: where the interpreter spends its time, by RAPID routine.

This is the simulating computer's time, measured by Python's profiler, and independent of
the robot. It differs from run to run; the run itself does not.
"""

from __future__ import annotations

import cProfile
import marshal
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeAlias, TypeVar

from rich.console import Group, RenderableType
from rich.table import Table
from rich.text import Text

from rapidsim.analysis.program import Program
from rapidsim.files import InputError
from rapidsim.interpreter.runtime.call_stack import CLAUSES
from rapidsim.values import value_class

T = TypeVar("T")

SHOWN_ROUTINES = 10

_Function: TypeAlias = tuple[str, int, str]
"""File, line of the header, name: the key of a function in Python's profiler."""
_Stats: TypeAlias = dict[_Function, tuple[Any, ...]]


@value_class(frozen=True, slots=True)
class RoutineCost:
    """Computer time of one routine or clause."""

    name: str
    file: str
    line: int
    """Line of its header."""
    calls: int
    own_s: float
    """In its own lines: expressions, decisions, loops."""
    total_s: float
    """With all it called: instructions, the simulation behind them, other routines."""


@value_class(frozen=True, slots=True)
class RunProfile:
    """Measurements of a run."""

    stats: _Stats
    """Statistics for Python's `pstats`, with routines named as in RAPID."""
    routines: tuple[RoutineCost, ...]
    """The most expensive first."""


def profiled(run: Callable[[], T], program: Program) -> tuple[T, RunProfile]:
    """Run a program and measure."""
    profiler = cProfile.Profile()
    result = profiler.runcall(run)
    profiler.create_stats()
    raw: _Stats = profiler.stats
    rapid = _rapid_names(raw, program)
    stats = {
        rapid.get(function, function): (
            *numbers,
            {rapid.get(caller, caller): edge for caller, edge in callers.items()},
        )
        for function, (*numbers, callers) in raw.items()
    }
    costs = [
        RoutineCost(name, file, line, calls, own_s, total_s)
        for file, line, name in rapid.values()
        for _, calls, own_s, total_s, _ in [stats[file, line, name]]
    ]
    costs.sort(key=lambda cost: (-cost.total_s, -cost.own_s, cost.file, cost.line))
    return result, RunProfile(stats, tuple(costs))


def write_profile(profile: RunProfile, path: Path) -> None:
    """Write what `pstats` and the viewers made for it read.

    Raises:
        InputError: If the file cannot be written.
    """
    try:
        path.write_bytes(marshal.dumps(profile.stats))
    except OSError as error:
        raise InputError(f"{path} cannot be written: {error.strerror or error}") from error


def costs_table(costs: Sequence[RoutineCost]) -> RenderableType:
    """The routines that cost the computer most."""
    table = Table(box=None, pad_edge=False)
    for heading in ("calls", "own ms", "total ms"):
        table.add_column(heading, justify="right")
    table.add_column("routine")
    table.add_column("header")
    for cost in costs[:SHOWN_ROUTINES]:
        table.add_row(
            f"{cost.calls}",
            f"{cost.own_s * 1e3:.1f}",
            f"{cost.total_s * 1e3:.1f}",
            Text(cost.name),
            Text(f"{cost.file}:{cost.line}"),
        )
    title = "Wall time of the interpreter by routine (the computer's time, not the robot's):"
    return Group(Text(), Text(title), table)


def _rapid_names(stats: _Stats, program: Program) -> Mapping[_Function, _Function]:
    """The functions of routines and clauses, by their names in RAPID."""
    headers = [
        (module.source.file, module.source.position(routine.start)[0], routine.name.text)
        for module in program.modules
        for routine in module.routines
    ]
    by_name = {(file, line, name.lower()): name for file, line, name in headers}
    by_line = {(file, line): name for file, line, name in headers}
    names: dict[_Function, _Function] = {}
    for file, line, python in sorted(stats):
        clause = CLAUSES.get(python)
        routine = by_name.get((file, line, python)) or by_line.get((file, line))
        if routine is None or (clause is None and python.startswith(("_", "<"))):
            continue
        names[file, line, python] = (file, line, f"{routine} {clause}" if clause else routine)
    return names
