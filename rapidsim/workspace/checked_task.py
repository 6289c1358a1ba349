"""One task of a workspace: its files, and the findings in them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import groupby

from rapidsim.analysis.cell_names import CellNames
from rapidsim.analysis.passes.checker import Find, check
from rapidsim.analysis.program_parts import Facts
from rapidsim.analysis.suppressions import without_suppressed
from rapidsim.diagnostics import Diagnostic, Source
from rapidsim.files import SourceFile
from rapidsim.module_files import TaskFiles
from rapidsim.syntax import tree
from rapidsim.syntax.parser import parse
from rapidsim.workspace.changes import Changed
from rapidsim.workspace.guesses import without_guesses


class CheckedTask:
    """The files of a task with their trees, symbols and findings."""

    def __init__(
        self,
        task: TaskFiles,
        rules: Sequence[Find],
        cell: CellNames,
        is_looked_for: Callable[[str], bool],
    ) -> None:
        """Read and check a task; see `Workspace` for the arguments."""
        self.task = task
        self._rules = tuple(rules)
        self._cell = replace(cell, unseen=task.unseen, refers_late=task.refers_late)
        self._is_looked_for = is_looked_for
        self._check()

    @property
    def files(self) -> tuple[SourceFile, ...]:
        """The files with their present texts."""
        return self.task.files

    def file(self, path: str) -> tree.File:
        """The tree of a file."""
        return self._trees[path]

    def findings(self, path: str) -> tuple[Diagnostic, ...]:
        """Findings in a file."""
        return self._findings[path]

    def replace(self, path: str, text: str) -> Changed:
        """Replace the text of a file, and check the task again."""
        files = (
            SourceFile(path, text, "utf-8") if one.name == path else one for one in self.task.files
        )
        before = self._findings
        self.task = replace(self.task, files=tuple(files))
        self._check()
        others = {one for one in before if before[one] != self._findings[one]}
        return Changed(frozenset({path, *others}))

    def _check(self) -> None:
        parsed = [parse(Source(file.name, file.text)) for file in self.task.files]
        files = tuple(one.file for one in parsed)
        self._trees = {file.source.file: file for file in files}
        taken: list[Facts] = []

        def take(facts: Facts) -> tuple[Diagnostic, ...]:
            taken.append(facts)
            return ()

        checked = check(files, (*self._rules, take), cell=self._cell)
        (self.facts,) = taken
        of_syntax = [found for one in parsed for found in one.diagnostics]
        found = (*of_syntax, *without_guesses(checked.diagnostics, of_syntax, files))
        shown = without_suppressed(found, files, is_looked_for=self._is_looked_for)
        by_file: dict[str, list[Diagnostic]] = {path: [] for path in self._trees}
        for one in shown:
            by_file[one.span.file if one.span else files[0].source.file].append(one)
        self._findings = {path: in_total_order(listed) for path, listed in by_file.items()}


def in_total_order(findings: Sequence[Diagnostic]) -> tuple[Diagnostic, ...]:
    """Findings by file, offset, code and message."""
    coarse = sorted(findings, key=_place_and_code)
    # A message is composed only where the other keys are equal.
    groups = [list(group) for _, group in groupby(coarse, key=_place_and_code)]
    return tuple(
        one
        for group in groups
        for one in (group if len(group) == 1 else sorted(group, key=_message))
    )


def _place_and_code(finding: Diagnostic) -> tuple[tuple[str, int], str]:
    return finding.order, finding.code


def _message(finding: Diagnostic) -> str:
    return finding.message
