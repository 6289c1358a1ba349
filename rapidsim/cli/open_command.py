"""The command that opens a recording, quoted for the probable shell."""

from __future__ import annotations

import os
import shlex
import shutil
import sys
from collections.abc import Mapping
from enum import Enum
from pathlib import Path

_BARE = "._-/\\:"
"""Characters, besides letters and digits, that need no quotes on a Windows command line."""


class Shell(Enum):
    """Shells that quote differently."""

    POSIX = "posix"
    POWERSHELL = "powershell"
    CMD = "cmd"


def open_command(recording: Path) -> str:
    """The command line that opens a recording."""
    return command_line(_viewer(), recording, shell_of(os.name, os.environ))


def shell_of(system: str, variables: Mapping[str, str]) -> Shell:
    """The shell that called us, by what it leaves in the environment."""
    if system != "nt" or "MSYSTEM" in variables:
        return Shell.POSIX
    return Shell.CMD if "PROMPT" in variables else Shell.POWERSHELL


def command_line(program: str, file: Path, shell: Shell) -> str:
    """Program and file, quoted as a shell wants it."""
    # Otherwise the viewer takes it for an option.
    name = f".{os.sep}{file}" if str(file).startswith("-") else str(file)
    match shell:
        case Shell.POSIX:
            return shlex.join([program, name])
        case Shell.CMD:
            return " ".join(word if _is_bare(word) else f'"{word}"' for word in (program, name))
        case Shell.POWERSHELL:
            called, named = (
                word if _is_bare(word) else "'{}'".format(word.replace("'", "''"))
                for word in (program, name)
            )
            # A string alone is a value; `&` calls it.
            return f"{'' if called == program else '& '}{called} {named}"


def _viewer() -> str:
    """The viewer as the shell finds it: by its name, else where this program was called."""
    if shutil.which("rerun"):
        return "rerun"
    beside = Path(sys.argv[0]).with_name("rerun.exe" if os.name == "nt" else "rerun")
    if not beside.is_file():
        beside = Path(sys.executable).with_name(beside.name)
    if not beside.is_file():
        return "rerun"
    return os.path.relpath(beside) if beside.is_relative_to(Path.cwd()) else str(beside)


def _is_bare(word: str) -> bool:
    return all(c.isalnum() or c in _BARE for c in word)
