"""The files of a program as a client knows them, and the lines at which it can stop."""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

from rapidsim.interpreter.tools.executable_lines import places_to_stop
from rapidsim.syntax import tree


@dataclass(eq=False)
class ProgramFiles:
    """The files of the programs of all tasks."""

    tasks: tuple[str, ...]
    """Names of the tasks."""
    lines: dict[str, frozenset[int]] = field(default_factory=dict)
    """Lines at which a program can stop, by file as the user named it."""
    paths: dict[str, str] = field(default_factory=dict)
    """Absolute path of each file."""
    modules: list[tree.Module] = field(default_factory=list)
    """Modules of the program, and those that it has loaded."""

    def take_all(self, modules: Iterable[tree.Module]) -> None:
        """Take the modules of a program."""
        for module in modules:
            self.take(module)

    def take(self, module: tree.Module) -> bool:
        """Take a module, which the program may have loaded; return whether it is new."""
        if module in self.modules:
            return False
        self.modules.append(module)
        file = module.source.file
        self.lines[file] = self.lines.get(file, frozenset()) | places_to_stop(module).keys()
        self.paths[file] = str(Path(file).absolute())
        return True

    def file_of(self, path: str) -> str | None:
        """The file of a path of the client; None if the program has none there."""
        wanted = os.path.normcase(os.path.realpath(path))
        for file, place in self.paths.items():
            if os.path.normcase(os.path.realpath(place)) == wanted:
                return file
        return None

    def statement_line(self, file: str, line: int) -> int | None:
        """The first line with a statement, from a line on; None without one."""
        return min((one for one in self.lines[file] if one >= line), default=None)
