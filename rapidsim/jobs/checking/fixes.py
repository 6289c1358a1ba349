"""The edits that findings carry: the ones that apply together, and that leave no more errors."""

from __future__ import annotations

from bisect import bisect_left, insort
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace

from rapidsim.diagnostics import Diagnostic, Edit, Severity
from rapidsim.jobs.checking.check_files import check_tasks
from rapidsim.module_files import TaskFiles
from rapidsim.text_edits import TextEdit, edited_text
from rapidsim.values import value_class

_MOST_ROUNDS = 20
"""One fix may make room for another; so many are never needed."""


@value_class(frozen=True, slots=True)
class ChosenFixes:
    """The fixes that can be applied together."""

    edits: dict[str, list[TextEdit]]
    """By file."""
    count: int
    """Number of findings that they fix."""
    skipped: int = 0
    """Number of fixes skipped, as they would lead to more errors."""


@value_class(frozen=True, slots=True)
class FixResult:
    """The result of fixing."""

    tasks: tuple[TaskFiles, ...]
    count: int
    """Number of fixed findings."""
    skipped: int
    """Number of fixes skipped, as they would lead to more errors."""

    def edits_of(self, tasks: Sequence[TaskFiles]) -> dict[str, list[TextEdit]]:
        """The new text of each file that was another before."""
        before = {file.name: file.text for task in tasks for file in task.files}
        after = {file.name: file.text for task in self.tasks for file in task.files}
        return {
            name: [(0, len(before[name]), text)]
            for name, text in after.items()
            if text != before[name]
        }


def choose_fixes(diagnostics: Iterable[Diagnostic], *, unsafe: bool) -> ChosenFixes:
    """The fixes of findings, in order; one that touches what another changes waits for next time.

    Args:
        diagnostics: What was found.
        unsafe: Whether fixes that change what the program does are taken too.
    """
    edits: dict[str, list[TextEdit]] = {}
    count = 0
    for diagnostic in sorted(diagnostics, key=lambda one: one.order):
        fix = diagnostic.fix
        if fix is None or not (fix.safe or unsafe):
            continue
        wanted = [(edit.span.file, _as_text_edit(edit)) for edit in fix.edits]
        new = [(file, edit) for file, edit in wanted if not _has(edit, edits.get(file, []))]
        if any(_is_touched(edit, edits.get(file, [])) for file, edit in new):
            continue
        count += 1
        for file, edit in new:
            insort(edits.setdefault(file, []), edit)
    return ChosenFixes(edits, count)


def apply_fixes(
    tasks: Sequence[TaskFiles],
    findings: Sequence[Diagnostic],
    find: Callable[[Sequence[TaskFiles]], Sequence[Diagnostic]],
    *,
    unsafe: bool,
) -> FixResult:
    """Tasks with everything fixed that can be, so that fixing them again would change nothing.

    Args:
        tasks: Their files.
        findings: What was found in them.
        find: Returns the findings of changed programs.
        unsafe: Whether fixes that change what the program does are taken too.
    """
    count, left_out = 0, 0
    for _ in range(_MOST_ROUNDS):
        chosen = harmless_fixes(findings, tasks, unsafe=unsafe)
        left_out = chosen.skipped
        if not chosen.edits:
            break
        count += chosen.count
        tasks = _edited(tasks, chosen.edits)
        findings = find(tasks)
    return FixResult(tuple(tasks), count, left_out)


def harmless_fixes(
    diagnostics: Iterable[Diagnostic], tasks: Sequence[TaskFiles], *, unsafe: bool
) -> ChosenFixes:
    """The fixes of findings that leave no more errors than there are.

    A fix is made for a text that is understood; in a broken one it may do harm. Then halves are
    tried, and halves of those, until only harmful ones are excluded.
    """
    wanted = [d for d in diagnostics if d.fix is not None and (d.fix.safe or unsafe)]
    chosen = choose_fixes(wanted, unsafe=unsafe)
    if not chosen.edits:
        return chosen
    most = _errors(tasks)

    def harmless(before: Sequence[Diagnostic], more: Sequence[Diagnostic]) -> Sequence[Diagnostic]:
        both = (*before, *more)
        if _errors(_edited(tasks, choose_fixes(both, unsafe=unsafe).edits)) <= most:
            return both
        if len(more) == 1:
            return before
        half = len(more) // 2
        return harmless(harmless(before, more[:half]), more[half:])

    kept = harmless((), wanted)
    return replace(choose_fixes(kept, unsafe=unsafe), skipped=len(wanted) - len(kept))


def _errors(tasks: Sequence[TaskFiles]) -> int:
    """Number of errors, whichever are shown, without those of reach."""
    found = check_tasks(tasks).diagnostics
    return sum(one.severity is Severity.ERROR for one in found)


def _edited(
    tasks: Sequence[TaskFiles], edits: Mapping[str, Sequence[TextEdit]]
) -> tuple[TaskFiles, ...]:
    return tuple(
        replace(
            task,
            files=tuple(
                replace(file, text=edited_text(file.text, edits[file.name]))
                if file.name in edits
                else file
                for file in task.files
            ),
        )
        for task in tasks
    )


def _as_text_edit(edit: Edit) -> TextEdit:
    return edit.span.start, edit.span.end, edit.text


def _has(edit: TextEdit, other_edits: list[TextEdit]) -> bool:
    """Whether the very same edit is among others, which are in order."""
    place = bisect_left(other_edits, edit)
    return place < len(other_edits) and other_edits[place] == edit


def _is_touched(edit: TextEdit, other_edits: list[TextEdit]) -> bool:
    """Whether an edit touches others, which are in order and do not touch each other."""
    place = bisect_left(other_edits, edit)
    start, end, _ = edit
    before = place > 0 and other_edits[place - 1][1] >= start
    return before or (place < len(other_edits) and other_edits[place][0] <= end)
