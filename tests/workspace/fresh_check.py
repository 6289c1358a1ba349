"""The findings of a check that knows nothing of a workspace, as comparable values."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from rapidsim.analysis.cell_names import NO_CELL
from rapidsim.analysis.rules.table import detectors_of
from rapidsim.analysis.suppressions import without_suppressed
from rapidsim.diagnostics import Diagnostic, Span
from rapidsim.files import SourceFile, decode
from rapidsim.jobs.checking.checked_program import load_task
from rapidsim.module_files import MODULE_SUFFIXES, TaskFiles
from rapidsim.workspace.total_order import in_total_order
from rapidsim.workspace.workspace import Workspace, is_of_text

ROOT = Path(__file__).parents[2]


def task_of(texts: Mapping[str, str]) -> TaskFiles:
    return TaskFiles(None, tuple(SourceFile(path, text, "utf-8") for path, text in texts.items()))


def opened(texts: Mapping[str, str]) -> Workspace:
    return Workspace([task_of(texts)])


def fresh_findings(texts: Mapping[str, str]) -> dict[str, list[object]]:
    """Findings of a new check, by file."""
    loaded = load_task(task_of(texts), NO_CELL, detectors_of())
    shown = without_suppressed(loaded.diagnostics, loaded.files, is_looked_for=is_of_text)
    return {
        path: [contents(one) for one in in_total_order(shown) if one.span and one.file == path]
        for path in texts
    }


def contents(finding: Diagnostic) -> object:
    """Everything that a finding says."""
    fix = finding.fix
    return (
        *(finding.code, str(finding.severity), finding.message, finding.help, finding.routine),
        finding.span and place(finding.span),
        [(place(one.span), one.message) for one in finding.related],
        fix and (fix.title, fix.safe, [(place(one.span), one.text) for one in fix.edits]),
    )


def place(span: Span) -> tuple[str, int, int, int]:
    return span.file, span.start, span.end, span.line


def modules(*folders: str) -> list[Path]:
    """The RAPID files of folders of the repository, in order."""
    files = (file for folder in folders for file in (ROOT / folder).rglob("*"))
    return sorted(file for file in files if file.suffix.lower() in MODULE_SUFFIXES)


def text_of(file: Path) -> str:
    return decode(file.read_bytes())[0]
