"""Write the values that a run left in persistents into the declarations in the program's files.

As a controller does when a module is saved: only the text of the values changes, and of a record or
array only the parts that are different. Encoding, line ends and every other byte stay.
"""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Iterable, Sequence
from pathlib import Path

from rapidsim.files import STANDARD_INPUT, InputError, SourceFile, decode
from rapidsim.output_files import whole_file
from rapidsim.simulation.persistents import PersistentChange, literal_places, parts_of

_NOT_ASCII = re.compile("[\x80-\xff]")
_Edit = tuple[int, int, str]
"""Start and end of what is replaced, and by what."""


def write_persistents(
    changes: Sequence[PersistentChange], files: Iterable[SourceFile]
) -> tuple[Path, ...]:
    """Write new initial values; all files are looked at before the first is written.

    Args:
        changes: What the run left.
        files: The program as it was read.

    Returns:
        The files written, none if nothing changed.

    Raises:
        InputError: If a file is standard input, has changed since it was read, or cannot be
            written.
    """
    written = [
        (Path(file.name), _edited(file, edits))
        for file in files
        if (edits := [e for one in changes if one.declared.file == file.name for e in _edits(one)])
    ]
    for path, data in written:
        target = path.resolve()
        with whole_file(target) as temporary:
            temporary.write_bytes(data)
            shutil.copymode(target, temporary)
    return tuple(path for path, _ in written)


def _edits(change: PersistentChange) -> list[_Edit]:
    """What a change replaces in the text of its file."""
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


def _edited(file: SourceFile, edits: Iterable[_Edit]) -> bytes:
    """The bytes of a file with new values in them."""
    if file.name == STANDARD_INPUT:
        raise InputError("values of persistents cannot be written to standard input")
    try:
        data = Path(file.name).read_bytes()
    except OSError as error:
        raise InputError(f"{file.name} cannot be read again: {error.strerror or error}") from error
    if decode(data) != (file.text, file.encoding):
        raise InputError(
            f"{file.name} has changed since it was read; values of persistents were not written"
        )
    if not os.access(file.name, os.W_OK):
        raise InputError(f"{file.name} cannot be written: it is read-only")
    body = file.text.encode(file.encoding, errors="replace")
    mark, was = data[: len(data) - len(body)], data[len(data) - len(body) :]
    if was != body:
        raise InputError(f"{file.name} holds bytes that are no text; it was not written")
    text = file.text
    for start, end, new in sorted(edits, reverse=True):
        # A file of plain ASCII stays one, so that nobody has to guess its encoding afterwards.
        value = _NOT_ASCII.sub(_code, new) if file.text.isascii() else new
        text = text[:start] + value + text[end:]
    try:
        return mark + text.encode(file.encoding)
    except UnicodeEncodeError as error:
        raise InputError(
            f"{file.name} is {file.encoding}, which has no character {text[error.start]!r}"
        ) from error


def _code(character: re.Match[str]) -> str:
    """A character as RAPID writes it by its code."""
    return f"\\{ord(character[0]):02X}"
