"""Read files that the user names, as bytes or text; an `InputError` explains a failure.

Files come from controllers and from careless tools, so decoding never fails on their bytes.
"""

from __future__ import annotations

import difflib
import os
import stat
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import BinaryIO

from rapidsim.values import value_class

_STEERING = bytes({*range(32), 127} - set(b"\t\n\v\f\r\x1a\x1b"))
"""Control bytes that do not occur in text."""
_LOOKED_AT = 4096
_FEW_STRAY = 16
_STRAY_SHARE = 0.03
"""Share of such bytes beyond which a file is no text; text has a few, encoded modules an eighth."""

# Windows tools write code page 1252; its five unassigned bytes exist only in ISO 8859-1, which
# accepts every byte. Byte order marks are tested first: they are certain, the rest is a guess.
_BYTE_ORDER_MARKS = (
    (b"\xef\xbb\xbf", "utf-8"),
    (b"\xff\xfe", "utf-16-le"),
    (b"\xfe\xff", "utf-16-be"),
)
_ENCODINGS = ("utf-8", "cp1252")
_LAST_RESORT = "latin-1"

DESCRIPTIONS = (".urdf", ".xml", ".xacro")
"""Suffixes of files that describe an arm; any other name refers to the catalogue."""
MOST_BYTES = 200_000_000
"""Maximum size of an input file: a million moves with their targets have 140 MB."""

# Never block on a pipe; Windows has none.
_NEVER_WAIT = getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)

_LFS_POINTER = b"version https://git-lfs.github.com/spec/"
"""Beginning of the text that a checkout without Git LFS has in the place of a large file."""
_AS_NEAR = 0.1
"""Difference of similarity below which two names are considered equally near."""


class InputError(Exception):
    """Unusable input of the user: a path, a name, a value. Never a defect of rapidsim."""

    def __init__(self, message: str, help: str | None = None, similar: Sequence[str] = ()) -> None:
        """Set the message, and the help if there is any, in one line each.

        Args:
            message: Description of the problem.
            help: Suggestion for the user.
            similar: Known names near the unknown one; taken from a `Suggestion` by default.
        """
        super().__init__(message)
        self.message = message
        self.help = help
        self.similar = tuple(similar) or (help.names if isinstance(help, Suggestion) else ())


class Suggestion(str):
    """A help line with names that the user may have meant."""

    names: tuple[str, ...]

    def __new__(cls, names: Sequence[str]) -> Suggestion:
        """Build the help line from one or more names."""
        line = super().__new__(cls, f"did you mean {' or '.join(f'`{name}`' for name in names)}?")
        line.names = tuple(names)
        return line

    def __reduce__(self) -> tuple[type[Suggestion], tuple[tuple[str, ...]]]:
        """Return the constructor and its arguments, for copies and other processes."""
        return (Suggestion, (self.names,))


@value_class(frozen=True, slots=True)
class SourceFile:
    """The text of one file."""

    name: str
    """File name as the user specified it, or below the folder that the user specified."""
    text: str
    encoding: str
    """Detected encoding."""


def input_bytes(file: Path) -> bytes:
    """Return the contents of a file that the user names; the only function that opens such files.

    Raises:
        InputError: If it is missing, unreadable, too large, not fetched, or no file but a folder,
            pipe or device.
    """
    try:
        require_regular(file)
        with os.fdopen(os.open(file, os.O_RDONLY | _NEVER_WAIT), "rb") as stream:
            content = _bounded(stream, str(file))
        if content.startswith(_LFS_POINTER):
            raise InputError(f"{file} is a Git LFS pointer, without content", "run `git lfs pull`")
        return content
    except OSError as error:
        raise unreadable(file, error) from error
    except ValueError as error:
        raise InputError(f"{str(file)!r} is not a file name") from error


def require_regular(file: Path) -> None:
    """Require a regular file, which never keeps its reader waiting.

    Raises:
        InputError: If it is a folder, pipe or device.
        OSError: If it is missing, or may not be looked at.
    """
    mode = file.stat().st_mode
    if not stat.S_ISREG(mode):
        kind = "folder" if stat.S_ISDIR(mode) else "pipe" if stat.S_ISFIFO(mode) else "device"
        raise InputError(f"{file} is no file but a {kind}")


def standard_input() -> bytes:
    """Return the contents of standard input.

    Raises:
        InputError: If it is closed or too long.
    """
    if sys.stdin is None:
        raise InputError("standard input is closed")
    return _bounded(sys.stdin.buffer, "standard input")


def input_text(file: Path) -> str:
    """Return the text of a file that must be UTF-8, without its byte order mark.

    Raises:
        InputError: If it is not; see also `input_bytes`.
    """
    try:
        return input_bytes(file).decode("utf-8-sig")
    except UnicodeDecodeError as error:
        reason = f"{error.reason} at byte {error.start}"
        raise InputError(f"{file} is not UTF-8 text: {reason}") from error


def require_inside(files: Sequence[Path], rooms: Iterable[Path]) -> Sequence[Path]:
    """Return the files if each is inside one of the folders, despite `..`, links and full paths.

    Checking a repository must not read and show other files of the computer.

    Raises:
        InputError: If a file is outside.
    """
    rooms = tuple(rooms)
    held = [os.path.realpath(room) for room in rooms]
    for file in files:
        place = Path(os.path.realpath(file))
        if not any(place.is_relative_to(room) for room in held):
            raise InputError(
                f"{file} leads out of {rooms[0]}, to {place}",
                "what may be read from elsewhere is named on the command line itself",
            )
    return files


def decode(data: bytes) -> tuple[str, str]:
    """Return the text of a file's bytes and their detected encoding; accepts any bytes."""
    for mark, encoding in _BYTE_ORDER_MARKS:
        if data.startswith(mark):
            return data[len(mark) :].decode(encoding, errors="replace"), encoding
    for encoding in _ENCODINGS:
        try:
            return data.decode(encoding), encoding
        except UnicodeDecodeError:
            continue
    return data.decode(_LAST_RESORT), _LAST_RESORT


def did_you_mean(name: str, candidates: Iterable[str]) -> Suggestion | None:
    """Return the help line for an unknown name, if a known name is similar."""
    folded = {candidate.lower(): candidate for candidate in candidates}
    near = difflib.get_close_matches(name.lower(), folded, n=3, cutoff=0.6)
    if not near:
        return None
    likeness = difflib.SequenceMatcher(b=name.lower())
    ratios = []
    for candidate in near:
        likeness.set_seq1(candidate)
        ratios.append(likeness.ratio())
    # A typing error is nearer to the intended name than to any other.
    meant = [one for one, ratio in zip(near, ratios, strict=True) if ratio > ratios[0] - _AS_NEAR]
    return Suggestion([folded[candidate] for candidate in meant])


def is_encoded(data: bytes) -> bool:
    """Whether bytes are no text: controllers write encoded modules to keep them confidential."""
    if any(data.startswith(mark) for mark, _ in _BYTE_ORDER_MARKS):
        return False
    head = data[:_LOOKED_AT]
    steering = len(head) - len(head.translate(None, _STEERING))
    return steering > _FEW_STRAY and steering > _STRAY_SHARE * len(head)


def entries_of(folder: Path) -> list[Path]:
    """Return the entries of a folder, sorted without case to be independent of the file system.

    Raises:
        InputError: If it cannot be read.
    """
    try:
        return sorted(folder.iterdir(), key=lambda entry: (entry.name.lower(), entry.name))
    except OSError as error:
        raise unreadable(folder, error) from error


def unreadable(path: Path, error: OSError) -> InputError:
    """Error for an unreadable file, with a similar file name if there is one."""
    if isinstance(error, FileNotFoundError):
        return InputError(f"{path} does not exist", _near_file(path))
    return InputError(f"{path} cannot be read: {error.strerror or error}")


def _bounded(stream: BinaryIO, name: str) -> bytes:
    """Return all bytes of a stream; raise if it is too long."""
    data = stream.read(MOST_BYTES + 1)
    if len(data) > MOST_BYTES:
        raise InputError(f"{name} has more than {MOST_BYTES // 10**6} MB, which is not read")
    return data


def _near_file(path: Path) -> Suggestion | None:
    """Return the help line with a similar file of the same folder, if there is one.

    Names are compared without the suffix, which all modules share.
    """
    try:
        names = sorted(entry.name for entry in path.parent.iterdir())
    except OSError:
        return None
    alike = {Path(one).stem: one for one in names if one.lower().endswith(path.suffix.lower())}
    near = did_you_mean(path.stem, alike)
    return near and Suggestion([alike[stem] for stem in near.names])


def relative_to_cwd(path: Path) -> Path:
    """Return a path below the working directory in relative form; others unchanged."""
    here = Path.cwd().resolve()
    return path.relative_to(here) if path.is_relative_to(here) else path
