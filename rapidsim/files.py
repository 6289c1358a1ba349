"""Open and read what the user named: it becomes bytes or text, or an `InputError` says why.

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
"""What no text holds."""
_LOOKED_AT = 4096
_FEW_STRAY = 16
_STRAY_SHARE = 0.03
"""Text has a few such bytes at most; in a code every eighth is one."""

# Windows tools write code page 1252; its five unassigned bytes exist in ISO 8859-1 only, which
# takes every byte. Byte order marks come first: they are proof, the rest is a guess.
_BYTE_ORDER_MARKS = (
    (b"\xef\xbb\xbf", "utf-8"),
    (b"\xff\xfe", "utf-16-le"),
    (b"\xfe\xff", "utf-16-be"),
)
_ENCODINGS = ("utf-8", "cp1252")
_LAST_RESORT = "latin-1"

DESCRIPTIONS = (".urdf", ".xml", ".xacro")
"""How the name of a file ends that describes an arm; any other name is one of the catalogue."""
MOST_BYTES = 200_000_000
"""No file that is read is larger: a million moves with their targets have 140 MB."""

# Never wait for a pipe; Windows has none.
_NEVER_WAIT = getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)

_AS_NEAR = 0.1
"""Names whose likeness to a given one differs by less are equally near."""


class InputError(Exception):
    """Unusable input of the user: a path, a name, a value. Never a defect of rapidsim."""

    def __init__(self, message: str, help: str | None = None, similar: Sequence[str] = ()) -> None:
        """Say what is wrong, and the cure if it is known, in one line each.

        Args:
            message: What is wrong.
            help: The cure.
            similar: Known names near the one that is not; those of a `Suggestion` are known.
        """
        super().__init__(message)
        self.message = message
        self.help = help
        self.similar = tuple(similar) or (help.names if isinstance(help, Suggestion) else ())


class Suggestion(str):
    """A help line that names what was meant."""

    names: tuple[str, ...]

    def __new__(cls, names: Sequence[str]) -> Suggestion:
        """Ask for names, of one at least."""
        line = super().__new__(cls, f"did you mean {' or '.join(f'`{name}`' for name in names)}?")
        line.names = tuple(names)
        return line


@value_class(frozen=True, slots=True)
class SourceFile:
    """The text of one file."""

    name: str
    """As the user named it, or below the folder the user named."""
    text: str
    encoding: str
    """What the bytes were taken for."""


def input_bytes(file: Path) -> bytes:
    """All of a file that the user named; the one place where such a file is opened.

    Raises:
        InputError: If it is missing, unreadable, too large, or no file but a folder, pipe or
            device.
    """
    try:
        mode = file.stat().st_mode
        if not stat.S_ISREG(mode):
            kind = "folder" if stat.S_ISDIR(mode) else "pipe" if stat.S_ISFIFO(mode) else "device"
            raise InputError(f"{file} is no file but a {kind}")
        with os.fdopen(os.open(file, os.O_RDONLY | _NEVER_WAIT), "rb") as stream:
            return _bounded(stream, str(file))
    except OSError as error:
        raise unreadable(file, error) from error
    except ValueError as error:
        raise InputError(f"{str(file)!r} is not a file name") from error


def standard_input() -> bytes:
    """All of standard input.

    Raises:
        InputError: If it is closed or too long.
    """
    if sys.stdin is None:
        raise InputError("standard input is closed")
    return _bounded(sys.stdin.buffer, "standard input")


def input_text(file: Path) -> str:
    """The text of a file that must be UTF-8; a byte order mark is taken off.

    Raises:
        InputError: If it is something else; see `input_bytes`.
    """
    try:
        return input_bytes(file).decode("utf-8-sig")
    except UnicodeDecodeError as error:
        reason = f"{error.reason} at byte {error.start}"
        raise InputError(f"{file} is not UTF-8 text: {reason}") from error


def require_inside(files: Sequence[Path], rooms: Iterable[Path]) -> Sequence[Path]:
    """The files, if none of them leads out of all rooms, through `..`, a link or a full path.

    A repository that is checked must not have other files of the computer read and shown.

    Raises:
        InputError: If one does.
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
    """Text of a file's bytes and the encoding they were taken for; takes any bytes."""
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
    """The help line for a name that is not known, if something known is near."""
    folded = {candidate.lower(): candidate for candidate in candidates}
    near = difflib.get_close_matches(name.lower(), folded, n=3, cutoff=0.6)
    if not near:
        return None
    likeness = difflib.SequenceMatcher(b=name.lower())
    ratios = []
    for candidate in near:
        likeness.set_seq1(candidate)
        ratios.append(likeness.ratio())
    # A slip of the finger is nearer to what was meant than to anything else.
    meant = [one for one, ratio in zip(near, ratios, strict=True) if ratio > ratios[0] - _AS_NEAR]
    return Suggestion([folded[candidate] for candidate in meant])


def is_encoded(data: bytes) -> bool:
    """Whether bytes are no text: controllers write modules that nobody may see in a code."""
    if any(data.startswith(mark) for mark, _ in _BYTE_ORDER_MARKS):
        return False
    head = data[:_LOOKED_AT]
    steering = len(head) - len(head.translate(None, _STEERING))
    return steering > _FEW_STRAY and steering > _STRAY_SHARE * len(head)


def entries_of(folder: Path) -> list[Path]:
    """What a folder holds; sorted without case, so that the order is that of any file system.

    Raises:
        InputError: If it cannot be read.
    """
    try:
        return sorted(folder.iterdir(), key=lambda entry: (entry.name.lower(), entry.name))
    except OSError as error:
        raise unreadable(folder, error) from error


def unreadable(path: Path, error: OSError) -> InputError:
    """The mistake that a file could not be read, with the file that was meant if it is known."""
    if isinstance(error, FileNotFoundError):
        return InputError(f"{path} does not exist", _near_file(path))
    return InputError(f"{path} cannot be read: {error.strerror or error}")


def _bounded(stream: BinaryIO, name: str) -> bytes:
    """All bytes of a stream, refused if there is no end of them."""
    data = stream.read(MOST_BYTES + 1)
    if len(data) > MOST_BYTES:
        raise InputError(f"{name} has more than {MOST_BYTES // 10**6} MB, which is not read")
    return data


def _near_file(path: Path) -> Suggestion | None:
    """The help line with the file beside it that was meant, if one is near.

    Compared without the suffix, which makes all modules alike.
    """
    try:
        names = sorted(entry.name for entry in path.parent.iterdir())
    except OSError:
        return None
    alike = {Path(one).stem: one for one in names if one.lower().endswith(path.suffix.lower())}
    near = did_you_mean(path.stem, alike)
    return near and Suggestion([alike[stem] for stem in near.names])


def relative_to_cwd(path: Path) -> Path:
    """A path below the working directory as the user would write it; others unchanged."""
    here = Path.cwd().resolve()
    return path.relative_to(here) if path.is_relative_to(here) else path
