"""Targets taught into the modules of a program: one declaration, by an explicit request."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from typing import Final

from rapidsim.analysis.occurrences.rename import LONGEST_NAME
from rapidsim.analysis.suggestions import reserved_words
from rapidsim.diagnostics import Source
from rapidsim.export.edited_files import write_edits
from rapidsim.files import InputError, SourceFile
from rapidsim.language.data import RobTarget
from rapidsim.library.predefined import DATA, TYPES
from rapidsim.library.text import source_text
from rapidsim.syntax import tree
from rapidsim.syntax.parser import parse
from rapidsim.text_edits import edited_text
from rapidsim.values import value_class

_NAME: Final = re.compile(r"[A-Za-z]\w*", re.ASCII)
_TYPE: Final = "robtarget"


@value_class(frozen=True, slots=True)
class WrittenTarget:
    """Place of a new declaration."""

    file: str
    line: int
    """From 1."""


class TaughtModules:
    """The files of a task as they were read, or written last."""

    def __init__(self, files: tuple[SourceFile, ...]) -> None:
        """Begin with the files as they were read."""
        self._files = {one.name: one for one in files}

    def write(self, file: str, name: str, target: RobTarget) -> WrittenTarget:
        """Declare a target behind the last one of a file.

        Raises:
            InputError: If the name is none or is taken, or the file is unknown, has errors, or has
                changed on the disk.
        """
        source = self._files.get(file)
        if source is None:
            raise InputError(f"there is no module {file}")
        self._require_name(name)
        text = source.text
        parsed = parse(Source(file, text))
        if parsed.diagnostics or not parsed.file.modules:
            raise InputError(f"{file} has syntax errors")
        at, indent = _place(parsed.file.modules[0], text)
        newline = "\r\n" if "\r\n" in text else "\n"
        declared = f"{indent}CONST {_TYPE} {name} := {source_text(target, TYPES[_TYPE])};{newline}"
        edit = (at, at, declared)
        written = edited_text(text, [edit])
        if parse(Source(file, written)).diagnostics:
            raise InputError(f"{file} has no line for a declaration")
        write_edits({file: [edit]}, [source], subject="targets")
        self._files[file] = replace(source, text=written)
        return WrittenTarget(file, text.count("\n", 0, at) + 1)

    def _require_name(self, name: str) -> None:
        if not _NAME.fullmatch(name) or len(name) > LONGEST_NAME:
            raise InputError(f"`{name}` is no name: letters, digits and _, at most {LONGEST_NAME}")
        folded = name.lower()
        if folded in {one.lower() for one in reserved_words()}:
            raise InputError(f"`{name}` is a reserved word")
        if folded in DATA or folded in TYPES or folded in set(self._names()):
            raise InputError(f"`{name}` exists already")

    def _names(self) -> Iterator[str]:
        """Yield the folded names that the modules of the task declare."""
        for one in self._files.values():
            for module in parse(Source(one.name, one.text)).file.modules:
                yield module.name.text.lower()
                for item in module.items:
                    if not isinstance(item, tree.InvalidStatement | tree.Placeholder):
                        yield item.name.text.lower()


def _place(module: tree.Module, text: str) -> tuple[int, str]:
    """Return where a declaration is inserted, the beginning of a line, and its indentation.

    It is behind the last target, else behind the last data, else behind the head of the module.
    """
    data = [item for item in module.items if isinstance(item, tree.Data)]
    alike = [one for one in data if one.type.text.lower() == _TYPE] or data
    if alike:
        last = alike[-1]
        start = text.rfind("\n", 0, last.start) + 1
        indent = text[start : last.start]
        return _next_line(text, last.end), indent if not indent.strip() else "  "
    return _next_line(text, (module.name, *module.attributes)[-1].end), "  "


def _next_line(text: str, at: int) -> int:
    found = text.find("\n", at)
    return len(text) if found < 0 else found + 1
