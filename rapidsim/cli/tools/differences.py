"""`--diff`: the edits of fixes, or of the layout, as a unified difference."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Mapping

from rapidsim.files import SourceFile
from rapidsim.text_edits import TextEdit, edited_text


def difference(edits: Mapping[str, Iterable[TextEdit]], files: Iterable[SourceFile]) -> str:
    """Changes of the edits as a unified difference with LF at all line ends."""
    parts: list[str] = []
    for file in files:
        if file.name not in edits:
            continue
        before = file.text.splitlines()
        after = edited_text(file.text, edits[file.name]).splitlines()
        lines = list(difflib.unified_diff(before, after, file.name, file.name, lineterm=""))
        if not lines:
            lines = [f"--- {file.name}", f"+++ {file.name}", "(line ends alone change)"]
        parts += lines
    return "".join(f"{line}\n" for line in parts)
