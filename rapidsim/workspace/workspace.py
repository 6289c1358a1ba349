"""The texts of the tasks of a cell, and their findings, which follow every change.

A text that was opened takes precedence over the one on the disk until it is closed. Findings are
those that need no run: of the text, names, types, flow and rules.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from rapidsim.analysis.cell_names import NO_CELL, CellNames
from rapidsim.analysis.passes.checker import Find
from rapidsim.analysis.program_parts import Facts
from rapidsim.analysis.rules.table import detectors_of
from rapidsim.diagnostics import Diagnostic
from rapidsim.files import SourceFile
from rapidsim.module_files import TaskFiles
from rapidsim.syntax import tree
from rapidsim.workspace.changes import Changed, TextChange, changed_text
from rapidsim.workspace.checked_task import CheckedTask

_CODES_OF_MOVES_AND_RUNS = ("D", "K", "R")
"""Families of rules that need a robot or a run, so that a comment may suppress them unseen."""


def is_of_text(selector: str) -> bool:
    """Whether the rules that a selector covers need neither a robot nor a run."""
    return not selector.upper().startswith(_CODES_OF_MOVES_AND_RUNS)


class Workspace:
    """Texts by path, over those on the disk, with the findings in them."""

    def __init__(
        self,
        tasks: Sequence[TaskFiles] = (),
        rules: Sequence[Find] | None = None,
        cell: CellNames = NO_CELL,
        *,
        is_looked_for: Callable[[str], bool] = is_of_text,
    ) -> None:
        """Take the tasks of a cell as they are on the disk.

        Args:
            tasks: The tasks; a file that is opened and belongs to none is a task of its own.
            rules: Detectors of further findings; None for those on by default.
            cell: Names that the configuration declares in addition to the modules.
            is_looked_for: Whether the rules of a code in a suppressing comment are checked here;
                a comment for others is not reported as useless.
        """
        self._rules = detectors_of() if rules is None else tuple(rules)
        self._cell = cell
        self._is_looked_for = is_looked_for
        self._disk = {file.name: file for task in tasks for file in task.files}
        self._versions = dict.fromkeys(self._disk, 0)
        self._tasks = [CheckedTask(task, self._rules, cell, is_looked_for) for task in tasks]
        self._task_of = {path: task for task in self._tasks for path in task.paths}

    @property
    def paths(self) -> tuple[str, ...]:
        """Paths of all files, task by task."""
        return tuple(path for task in self._tasks for path in task.paths)

    def open(self, path: str, text: str) -> Changed:
        """Take a text in place of the one on the disk."""
        return self._replaced(path, text)

    def close(self, path: str) -> Changed:
        """Return to the text on the disk; a file that is only open leaves the workspace.

        Raises:
            KeyError: If there is no such file.
        """
        if path in self._disk:
            return self._replaced(path, self._disk[path].text)
        self._tasks.remove(self._task_of.pop(path))
        del self._versions[path]
        return Changed(frozenset({path}))

    def change(self, path: str, changes: Sequence[TextChange]) -> Changed:
        """Change a text.

        Args:
            path: The file.
            changes: Changes in the order in which they were made: the offsets of each refer to
                the text that the previous ones left.

        Raises:
            KeyError: If there is no such file.
            ValueError: If a change refers to characters that the text does not have.
        """
        # All changes are valid, or none is made.
        changed_text(self.text(path), changes)
        self._versions[path] += 1
        made = [self._task_of[path].change(path, one) for one in changes]
        paths = frozenset({path}).union(*(one.paths for one in made))
        return Changed(paths, is_local=all(one.is_local for one in made))

    def findings(self, path: str) -> tuple[Diagnostic, ...]:
        """Findings in a file, in total order: by offset, code and message.

        Raises:
            KeyError: If there is no such file.
        """
        return self._task_of[path].findings(path)

    def as_checked(self, path: str) -> tuple[tuple[tree.File, ...], tuple[Diagnostic, ...]]:
        """Return the task of a file as a check has it; see `CheckedTask.as_checked`.

        Raises:
            KeyError: If there is no such file.
        """
        return self._task_of[path].as_checked()

    def text(self, path: str) -> str:
        """The text of a file.

        Raises:
            KeyError: If there is no such file.
        """
        return self._task_of[path].text(path)

    def version(self, path: str) -> int:
        """Number of changes of a file since it joined the workspace."""
        return self._versions[path]

    def file(self, path: str) -> tree.File:
        """The tree of a file; of an unreadable text, as much as could be read.

        Its nodes have positions in `source.text` of the file, which has room between items:
        `source.offsets` converts them to offsets in the text, `source.address` back. Lines and
        columns are those of the text.
        """
        return self._task_of[path].file(path)

    def facts(self, path: str) -> Facts:
        """Symbols, types and scopes of the task that a file belongs to, errors or not."""
        return self._task_of[path].facts

    def task_of(self, path: str) -> TaskFiles:
        """The task that a file belongs to, with its present texts."""
        return self._task_of[path].task

    def _replaced(self, path: str, text: str) -> Changed:
        task = self._task_of.get(path)
        if task is None:
            alone = TaskFiles(None, (SourceFile(path, text, "utf-8"),))
            task = CheckedTask(alone, self._rules, self._cell, self._is_looked_for)
            self._tasks.append(task)
            self._task_of[path] = task
            self._versions[path] = 0
            return Changed(frozenset({path}))
        self._versions[path] += 1
        if text == task.text(path):
            return Changed(frozenset())
        return task.replace(path, text)
