"""Check texts and folders in this process, as `rapidsim check` does."""

from __future__ import annotations

from pathlib import Path

from rapidsim.analysis.cell_names import CellNames
from rapidsim.analysis.rules.table import detectors_of
from rapidsim.analysis.suppressions import without_suppressed
from rapidsim.diagnostics import Diagnostic
from rapidsim.jobs.checking.check_files import check_tasks
from rapidsim.module_files import read_tasks

HERE = Path(__file__).parent
CORPUS = HERE / "corpus"


def found_in(
    *paths: Path, every_rule: bool = False, assumes: bool = False
) -> tuple[Diagnostic, ...]:
    """The findings in files or folders without those that need a robot, comments heeded."""
    rules = detectors_of(lambda rule: every_rule or rule.on_by_default)
    tasks = read_tasks([str(path) for path in paths])
    result = check_tasks(tasks, rules, cell=CellNames(assumes=assumes))
    return without_suppressed(result.diagnostics, result.trees)


def lines(diagnostics: tuple[Diagnostic, ...]) -> list[str]:
    """One short line a finding, for messages of failed tests."""
    return [
        f"{Path(one.span.file).name}:{one.span.line}" * bool(one.span)
        + f" {one.violation.code} {one.violation.message}"
        if one.span
        else one.violation.message
        for one in diagnostics
    ]
