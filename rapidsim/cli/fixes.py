"""`--fix` and `--diff`: apply the edits that findings carry, or show them."""

from __future__ import annotations

import difflib
from bisect import bisect_left, insort
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from rapidsim.diagnostics import Diagnostic, Edit
from rapidsim.export.text_edits import TextEdit, edited_text
from rapidsim.files import TaskFiles


@dataclass(frozen=True, slots=True)
class ChosenFixes:
    """The fixes that can be applied together."""

    edits: dict[str, list[TextEdit]]
    """By file."""
    count: int
    """How many findings they cure."""


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


def difference(edits: dict[str, list[TextEdit]], tasks: Sequence[TaskFiles]) -> str:
    """What the edits change, as a unified difference with LF at all line ends."""
    parts: list[str] = []
    for task in tasks:
        for file in task.files:
            if file.name not in edits:
                continue
            before = file.text.splitlines()
            after = edited_text(file.text, edits[file.name]).splitlines()
            lines = list(difflib.unified_diff(before, after, file.name, file.name, lineterm=""))
            if not lines:
                lines = [f"--- {file.name}", f"+++ {file.name}", "(line ends alone change)"]
            parts += lines
    return "".join(f"{line}\n" for line in parts)


def _as_text_edit(edit: Edit) -> TextEdit:
    return edit.span.start, edit.span.end, edit.text


def _has(edit: TextEdit, others: list[TextEdit]) -> bool:
    """Whether the very same edit is among others, which are in order."""
    place = bisect_left(others, edit)
    return place < len(others) and others[place] == edit


def _is_touched(edit: TextEdit, others: list[TextEdit]) -> bool:
    """Whether an edit touches others, which are in order and do not touch each other."""
    place = bisect_left(others, edit)
    start, end, _ = edit
    before = place > 0 and others[place - 1][1] >= start
    return before or (place < len(others) and others[place][0] <= end)
