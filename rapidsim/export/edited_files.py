"""Edits of text spans in the program's files that keep every other byte.

Encoding, byte order mark and line endings are kept. All files are checked before the first is
written, and each is replaced as a whole.
"""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterable, Mapping
from pathlib import Path

from rapidsim.files import InputError, SourceFile, decode, input_bytes
from rapidsim.module_files import STANDARD_INPUT, packed_station
from rapidsim.output_files import whole_file
from rapidsim.text_edits import TextEdit, edited_text


def write_edits(
    edits: Mapping[str, Iterable[TextEdit]], files: Iterable[SourceFile], *, subject: str
) -> tuple[Path, ...]:
    """Edit files.

    Args:
        edits: Replacements, by file name; spans do not overlap.
        files: The program files as they were read.
        subject: Subject of the edits in messages, in the plural, such as "fixes".

    Returns:
        The files written.

    Raises:
        InputError: If a file is standard input, has changed since it was read, or cannot be
            written.
    """
    written = [
        (Path(file.name), edited_bytes(file, edits[file.name], subject=subject))
        for file in files
        if file.name in edits
    ]
    for path, data in written:
        target = path.resolve()
        with whole_file(target) as temporary:
            temporary.write_bytes(data)
            shutil.copymode(target, temporary)
    return tuple(path for path, _ in written)


def edited_bytes(file: SourceFile, edits: Iterable[TextEdit], *, subject: str) -> bytes:
    """Return the bytes of a file after replacing text.

    Raises:
        InputError: See `write_edits`.
    """
    if file.name == STANDARD_INPUT:
        raise InputError(f"{subject} cannot be written to standard input")
    if packed_station(file.name) is not None:
        raise InputError(
            f"{subject} cannot be written into a packed station, to {file.name}",
            "unpack it and name the folder of the backup",
        )
    data = input_bytes(Path(file.name))
    if decode(data) != (file.text, file.encoding):
        raise InputError(f"{file.name} has changed since it was read; {subject} were not written")
    if not os.access(file.name, os.W_OK):
        raise InputError(f"{file.name} cannot be written: it is read-only")
    body = file.text.encode(file.encoding, errors="replace")
    mark, was = data[: len(data) - len(body)], data[len(data) - len(body) :]
    if was != body:
        raise InputError(f"{file.name} holds bytes that are not text; it was not written")
    text = edited_text(file.text, edits)
    try:
        return mark + text.encode(file.encoding)
    except UnicodeEncodeError as error:
        raise InputError(
            f"{file.name} is {file.encoding}, which has no character {text[error.start]!r}"
        ) from error
