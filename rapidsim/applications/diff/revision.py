"""A program in a git revision: its files, unpacked into a temporary folder.

The repository is not trusted. Objects are read as they are stored, by two commands that run no
hooks, filters or other programs and use no network; links and submodules are skipped.
"""

from __future__ import annotations

import os
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path, PurePosixPath
from tempfile import TemporaryDirectory

from rapidsim.files import InputError
from rapidsim.module_files import named_file
from rapidsim.station.station import FILE_NAME, find_station
from rapidsim.values import value_class

_FILE_MODES = ("100644", "100755")
_SETTINGS = (FILE_NAME, "pyproject.toml")
_MOST_BYTES = 200_000_000
_MOST_FILES = 20_000
_SECONDS = 60
_ABSENT = -1
_SHOWN_DIGITS = 10
"""Digits of a whole commit id that are shown."""
_OPTIONS = (
    "--no-pager",
    "--no-replace-objects",
    "-c",
    "core.hooksPath=/dev/null",
    "-c",
    "core.fsmonitor=false",
    "-c",
    "protocol.allow=never",
)
_ENVIRONMENT = {
    "GIT_ALLOW_PROTOCOL": "",
    "GIT_NO_LAZY_FETCH": "1",
    "GIT_OPTIONAL_LOCKS": "0",
    "GIT_TERMINAL_PROMPT": "0",
    "LC_ALL": "C",
}


@value_class(frozen=True, slots=True)
class Revision:
    """A path in a revision."""

    path: str
    """Path in the temporary folder."""
    folder: Path
    """The temporary folder."""
    name: str
    """Name of the revision."""
    station: str | None
    """Station file above the repository, which both sides use; None if there is no such file."""

    def display_path(self, path: str) -> str:
        """Return a path in the temporary folder in git's notation, `REV:path`; others unchanged."""
        for folder in (str(self.folder), os.path.realpath(self.folder)):
            if path == folder:
                return f"{self.name}:."
            if path.startswith(folder + os.sep):
                return f"{self.name}:{Path(path[len(folder) + 1 :]).as_posix()}"
        return path

    def in_words(self, message: str) -> str:
        """Return a message with paths as they are shown."""
        for folder in (str(self.folder), os.path.realpath(self.folder)):
            message = message.replace(folder + os.sep, f"{self.name}:")
        return message


@value_class(frozen=True, slots=True)
class _Entry:
    path: PurePosixPath
    object: str
    size: int
    """`_ABSENT` if git does not have the object."""


@contextmanager
def checked_out(revision: str, path: str) -> Iterator[Revision]:
    """Yield the path in a revision, which exists until the end of the context.

    Args:
        revision: Name in git: a commit, branch, tag, `HEAD~3`.
        path: Path in the working tree.

    Raises:
        InputError: If git is missing, the path is in no repository, or the revision lacks it.
    """
    place = Path(os.path.realpath(named_file(path)))
    if not place.exists():
        raise InputError(f"{path} does not exist")
    start = place if place.is_dir() else place.parent
    top = Path(os.path.realpath(_text(start, path, "rev-parse", "--show-toplevel")))
    wanted = ("rev-parse", "--verify", "--quiet", "--end-of-options", f"{revision}^{{commit}}")
    try:
        commit = _text(start, path, *wanted)
    except InputError:
        raise InputError(f"the repository of {path} has no revision {revision}") from None
    if not place.is_relative_to(top):
        raise InputError(f"{path} is not in the working tree of its repository, {top}")
    below = PurePosixPath(place.relative_to(top).as_posix())
    station = find_station([path])
    is_above = station is not None and top not in station.parents
    entries = _needed(list(_listed(top, path, commit)), below, is_folder=place.is_dir())
    if not any(entry.path == below or below in entry.path.parents for entry in entries):
        raise InputError(f"{path} is not in revision {revision}")
    with TemporaryDirectory(prefix="rapidsim-") as temporary:
        folder = Path(temporary)
        _write(top, path, entries, folder)
        # The search for a station file ends here, not in folders that others can write to.
        (folder / FILE_NAME).touch()
        named = str(folder.joinpath(*below.parts))
        suffix = path[len(str(named_file(path))) :] if str(named_file(path)) != path else ""
        name = commit[:_SHOWN_DIGITS] if revision.lower() == commit else revision
        yield Revision(named + suffix, folder, name, str(station) if is_above else None)


def _needed(entries: list[_Entry], below: PurePosixPath, *, is_folder: bool) -> list[_Entry]:
    """Return the files of a folder and its settings, or of the folder above with a station file."""
    folder = below if is_folder else below.parent
    above = (folder, *folder.parents)
    stations = [entry.path.parent for entry in entries if entry.path.name == FILE_NAME]
    root = next((one for one in above if one in stations), folder)
    return [
        entry
        for entry in entries
        if root in entry.path.parents
        or (entry.path.name in _SETTINGS and entry.path.parent in above)
    ]


def _listed(top: Path, path: str, commit: str) -> Iterator[_Entry]:
    """Yield the regular files of a commit."""
    listed = _git(top, path, "ls-tree", "-r", "-l", "-z", "--full-tree", commit)
    for line in listed.split(b"\0"):
        facts, _, name = line.partition(b"\t")
        words = facts.decode("ascii", "replace").split()
        if len(words) != 4 or words[0] not in _FILE_MODES:
            continue
        file = PurePosixPath(os.fsdecode(name))
        if not file.is_absolute() and not {"..", ".git"} & set(file.parts):
            yield _Entry(file, words[2], int(words[3]) if words[3].isdecimal() else _ABSENT)


def _write(top: Path, path: str, entries: list[_Entry], folder: Path) -> None:
    if len(entries) > _MOST_FILES or sum(entry.size for entry in entries) > _MOST_BYTES:
        raise InputError(f"{path} has too many or too large files in git", "name a folder in it")
    if any(entry.size == _ABSENT for entry in entries):
        raise InputError(f"git does not have all files of {path}", "fetch the revision first")
    asked = "".join(f"{entry.object}\n" for entry in entries).encode()
    data = _git(top, path, "cat-file", "--batch", stdin=asked)
    at = 0
    for entry in entries:
        end = data.find(b"\n", at)
        words = data[at:end].split()
        if end < 0 or len(words) != 3 or words[1] != b"blob" or int(words[2]) != entry.size:
            raise InputError(f"git cannot read {entry.path} of {path}")
        at = end + 1
        file = folder.joinpath(*entry.path.parts)
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(data[at : at + entry.size])
        at += entry.size + 1


def _text(folder: Path, path: str, *arguments: str) -> str:
    return os.fsdecode(_git(folder, path, *arguments)).removesuffix("\n")


def _git(folder: Path, path: str, *arguments: str, stdin: bytes = b"") -> bytes:
    """Return the output of a git command.

    Raises:
        InputError: If git is missing, or the command fails.
    """
    kept = {key: value for key, value in os.environ.items() if not key.startswith("GIT_")}
    try:
        ended = subprocess.run(
            ["git", *_OPTIONS, "-C", str(folder), *arguments],
            input=stdin,
            capture_output=True,
            check=False,
            env={**kept, **_ENVIRONMENT},
            timeout=_SECONDS,
        )
    except FileNotFoundError:
        raise InputError("git is not installed, which --git needs") from None
    except (OSError, ValueError, subprocess.TimeoutExpired) as error:
        raise InputError(f"git cannot read the repository of {path}: {error}") from None
    if ended.returncode:
        said = ended.stderr.decode("utf-8", "replace").strip().removeprefix("fatal: ")
        raise InputError(f"git cannot read the repository of {path}: {said or 'no reason given'}")
    return ended.stdout
