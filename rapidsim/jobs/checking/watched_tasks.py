"""Tasks that are checked whenever their files change: their texts stay in workspaces."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from rapidsim.analysis.cell_names import CellNames
from rapidsim.analysis.passes.checker import Find
from rapidsim.diagnostics import Severity, Source, Span
from rapidsim.jobs.checking.checked_program import LoadedProgram, load_task
from rapidsim.module_files import TaskFiles
from rapidsim.values import value_class
from rapidsim.workspace.changes import text_difference
from rapidsim.workspace.placing import moved
from rapidsim.workspace.workspace import Workspace


@value_class(frozen=True, slots=True, eq=False)
class _Watched:
    """A task with all that its findings depend on, beside the texts."""

    files: tuple[str, ...]
    facts: tuple[object, ...]
    workspace: Workspace


class WatchedTasks:
    """The workspaces of tasks, from one check to the next."""

    def __init__(self) -> None:
        """Begin without tasks."""
        self._tasks: dict[str | None, _Watched] = {}

    def load(
        self, task: TaskFiles, rules: Sequence[Find], cell: CellNames, *, has_program: bool
    ) -> LoadedProgram:
        """Return a task as `load_task` does, but check only what changed since the last call.

        Args:
            task: The task as it is on the disk.
            rules: Rules in addition to the errors that prevent a run.
            cell: Names that the configuration declares in addition to the modules.
            has_program: Whether the program is wanted, which is loaded from the texts as they are.
        """
        # Symbols are compared by identity, and each reading of a station makes others.
        symbols = {key: (one.name, one.type) for key, one in cell.symbols.items()}
        others = replace(cell, symbols={})
        facts = (tuple(rules), symbols, others, task.unseen, task.refers_late)
        files = tuple(file.name for file in task.files)
        watched = self._tasks.get(task.name)
        if watched is None or (watched.files, watched.facts) != (files, facts):
            workspace = Workspace([task], rules, cell)
            watched = self._tasks[task.name] = _Watched(files, facts, workspace)
        for file in task.files:
            change = text_difference(watched.workspace.text(file.name), file.text)
            if change is not None:
                watched.workspace.change(file.name, [change])
        trees, found = watched.workspace.as_checked(files[0])
        if not has_program:
            return LoadedProgram(trees, None, found)
        loaded = load_task(task, cell)
        sources = {file.source.file: file.source for file in loaded.files}
        found = tuple(moved(one, lambda span: _in_source(span, sources)) for one in found)
        is_broken = any(one.severity is Severity.ERROR for one in found)
        return LoadedProgram(loaded.files, None if is_broken else loaded.program, found)


def _in_source(span: Span, sources: Mapping[str, Source]) -> Span:
    """Return a span of a workspace in the text of the same file."""
    written = span.written
    return Span(sources[span.file], written.start, written.end)
