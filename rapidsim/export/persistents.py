"""Writer of the final values of persistents into their declarations in the program's files.

As on a controller when a module is saved: only the text of the values changes, and in a record or
array only the components that differ. Encoding, line endings and every other byte are kept.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from pathlib import Path

from rapidsim.export.edited_files import write_edits
from rapidsim.files import SourceFile
from rapidsim.simulation.results.persistents import PersistentChange, literal_places, parts_of
from rapidsim.text_edits import TextEdit

_NOT_ASCII = re.compile("[\x80-\xff]")


def write_persistents(
    changes: Sequence[PersistentChange], files: Iterable[SourceFile]
) -> tuple[Path, ...]:
    """Write new initial values; all files are checked before the first is written.

    Args:
        changes: Values at the end of the run.
        files: The program files as they were read.

    Returns:
        The files written, none if nothing changed.

    Raises:
        InputError: If a file is standard input, has changed since it was read, or cannot be
            written.
    """
    files = tuple(files)
    edits = {
        file.name: [_in_encoding(edit, file) for edit in found]
        for file in files
        if (found := [e for one in changes if one.declared.file == file.name for e in _edits(one)])
    }
    return write_edits(edits, files, subject="values of persistents")


def _in_encoding(edit: TextEdit, file: SourceFile) -> TextEdit:
    """Return an edit that keeps an ASCII file ASCII, so that its encoding stays unambiguous."""
    start, end, new = edit
    return start, end, _NOT_ASCII.sub(_code, new) if file.text.isascii() else new


def _edits(change: PersistentChange) -> list[TextEdit]:
    """Return the replacements of a change in the text of its file."""
    start, end = change.declared.start, change.declared.end
    if start == end:
        return [(start, end, f":={change.new}")]
    places = literal_places(change.declared.text)
    old, new = parts_of(change.old), parts_of(change.new)
    if places is None or not len(places) == len(old) == len(new):
        return [(start, end, change.new)]
    return [
        (start + first, start + last, after)
        for (first, last), before, after in zip(places, old, new, strict=True)
        if before != after
    ]


def _code(character: re.Match[str]) -> str:
    """Return a character as its code in RAPID syntax."""
    return f"\\{ord(character[0]):02X}"
