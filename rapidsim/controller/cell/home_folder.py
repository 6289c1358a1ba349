"""The controller's home folder on the user's disk, which a program cannot leave.

RAPID names files "HOME:/log/today.txt" or just "today.txt". Both mean a place inside the home
folder of the run. Other disks, TEMP: or the C: of a virtual controller's computer, are folders in
it that have their names; so is RAMDISK:, unless it has a folder of the user's disk. Paths that lead
outside, through "..", an absolute path or a link, are refused, as are devices: a program is
untrusted input.
"""

from __future__ import annotations

import os
import re
import shutil
import stat
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

from rapidsim.language.controller import DISK_BYTES, DISK_FILES
from rapidsim.language.error_numbers import (
    ERR_FILEACC,
    ERR_FILEEXIST,
    ERR_FILEOPEN,
    ERR_FILNOTFND,
    ERR_IOERROR,
    ERR_PRGMEMFULL,
    rapid_error,
)
from rapidsim.language.errors import RapidError
from rapidsim.language.files import FileMode, OpenFile

CAUTION = getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_BINARY", 0)
"""Flags: never wait for a pipe, never follow a link that appeared after the check; Windows has
neither."""
_MOST_OPEN = 100
"""The most files a program may have open; the system's limit is for rapidsim's files too."""
_LARGEST_SNAPSHOT = 20_000_000
"""[bytes] of all files."""
_LONGEST_LINE = 10_000_000
"""[bytes]; a home folder may contain a file that has no end."""
_DISK = re.compile(r"TEMP|RAMDISK|BACKUP|PC|REMOVABLEDISK\d*|USBDISK\d*|[A-Z]")
"""Disks other than HOME: those of a controller, its server, drives of a computer."""
_HOME_FOLDER = "HOME/"
"""A path that begins with it is relative to the parent of HOME:."""
_MODES = {FileMode.READ: "rb", FileMode.WRITE: "wb", FileMode.APPEND: "ab"}


class DiskLimit:
    """Limit of the data that a run and its clients may write: none must fill the user's disk."""

    def __init__(self) -> None:
        """Begin with an empty disk."""
        self._used = 0
        self._made = 0
        self.is_full = False
        """Whether nothing more may be written, whatever the limit."""

    @property
    def free(self) -> int:
        """Number of bytes that may still be written."""
        return 0 if self.is_full else DISK_BYTES - self._used

    def use(self, count: int) -> None:
        """Use more bytes.

        Raises:
            RapidError: ERR_FILEACC, if the limit is exceeded.
        """
        if self.is_full:
            raise rapid_error(ERR_FILEACC, "the disk is full")
        if self._used + count > DISK_BYTES:
            raise rapid_error(
                ERR_FILEACC, f"the disk is full: a run may write {DISK_BYTES:g} bytes"
            )
        self._used += count

    def release(self, count: int, files: int = 0) -> None:
        """Release the bytes of files that are gone; those of earlier runs were never used."""
        self._used = max(0, self._used - count)
        self._made = max(0, self._made - files)

    def make(self, place: Path) -> None:
        """Make a file or folder, and the folders above it, if missing.

        Raises:
            RapidError: ERR_FILEACC, if the run has made too many.
        """
        made = self._made
        for one in (place, *place.parents):
            if one.exists():
                break
            made += 1
        if self.is_full and made > self._made:
            raise rapid_error(ERR_FILEACC, "the disk is full")
        if made > DISK_FILES:
            raise rapid_error(
                ERR_FILEACC, f"the disk is full: a run may make {DISK_FILES} files and folders"
            )
        self._made = made


@dataclass(frozen=True, slots=True)
class HomeSnapshot:
    """The files below a home folder, and how far the open ones have been read or written."""

    content: Mapping[Path, bytes]
    positions: tuple[tuple[HomeFile, int], ...]


class HomeFile:
    """One open file of the home folder."""

    def __init__(self, stream: BinaryIO, name: str, disk: DiskLimit, owner: object) -> None:
        """Take over an open stream; `name` is for messages."""
        self.owner = owner
        self._stream = stream
        self._disk = disk
        self._name = name

    def write(self, data: bytes) -> None:
        """Append bytes.

        Raises:
            RapidError: ERR_FILEACC for a file to read, and once the run has filled its disk.
        """
        stream = self._open()
        if not stream.writable():
            raise RapidError(ERR_FILEACC, f"{self._name} is open to be read, not written")
        self._disk.use(len(data))
        stream.write(data)

    def read_line(self) -> bytes | None:
        """The next line without its end; None at the end of the file."""
        line = self._to_read().readline(_LONGEST_LINE)
        return line.rstrip(b"\r\n") if line else None

    def read(self, count: int) -> bytes:
        """Read up to `count` bytes; empty at the end of the file."""
        return self._to_read().read(count)

    def rewind(self) -> None:
        """Go back to the first byte."""
        self._open().seek(0)

    def flush(self) -> None:
        """Write what is buffered to the disk."""
        if not self._stream.closed:
            self._stream.flush()

    def position(self) -> int:
        """Position of the next byte, after all have been written to the disk."""
        self.flush()
        return self._stream.tell()

    def move_to(self, position: int) -> None:
        """Continue at a position."""
        self._stream.seek(position)

    def close(self) -> None:
        """Flush and close; closing twice does nothing."""
        self._stream.close()

    @property
    def is_closed(self) -> bool:
        """Whether the program has closed the file."""
        return self._stream.closed

    def _open(self) -> BinaryIO:
        if self._stream.closed:
            raise RapidError(ERR_FILEACC, f"{self._name} is closed")
        return self._stream

    def _to_read(self) -> BinaryIO:
        stream = self._open()
        if not stream.readable():
            raise RapidError(ERR_FILEACC, f"{self._name} is open to be written, not read")
        return stream


class HomeFolder:
    """The files a program may use, and a list of those it wrote."""

    def __init__(self, folder: Path | None, ramdisk: Path | None = None) -> None:
        """Confine all paths to `folder`, or None for no home folder, and to `ramdisk`."""
        self._folder = folder
        self._ramdisk = ramdisk
        self._files: list[HomeFile] = []
        """The files that were open when the last one was opened."""
        self._written: dict[Path, float] = {}
        """The written files, and the virtual time [s] at which each was last opened to write."""
        self._loaded: dict[Path, float] = {}
        """For each program file that was written and read, the time [s] of the last writing."""
        self.disk = DiskLimit()
        self.lacks = False
        """Whether the program has requested a file or folder that does not exist."""

    def open_file(
        self, path: str, mode: FileMode, now_s: float = 0.0, owner: object = None
    ) -> OpenFile:
        """Open a file by its RAPID name for an owner, whose files `close_all` can close.

        Raises:
            RapidError: ERR_FILEOPEN, with the reason; ERR_FILEACC if the disk is full.
        """
        place = self._place(path)
        self._files = [one for one in self._files if not one.is_closed]
        if len(self._files) >= _MOST_OPEN:
            raise RapidError(ERR_FILEOPEN, f"{path}: {_MOST_OPEN} files are open already")
        if mode is not FileMode.READ:
            self.disk.make(place)
        try:
            if mode is not FileMode.READ:
                place.parent.mkdir(parents=True, exist_ok=True)
            descriptor = os.open(place, _flags(mode) | CAUTION, 0o666)
            if not stat.S_ISREG(os.fstat(descriptor).st_mode):
                os.close(descriptor)
                raise RapidError(ERR_FILEOPEN, f"{path} is not a regular file")
            stream = os.fdopen(descriptor, _MODES[mode])
        except OSError as error:
            self._note_missing(place)
            reason = (error.strerror or "cannot be opened").lower()
            raise RapidError(ERR_FILEOPEN, f"{path}: {reason}") from None
        if mode is not FileMode.READ:
            self._written[place] = now_s
        file = HomeFile(stream, path, self.disk, owner)  # type: ignore[arg-type]
        self._files = [one for one in self._files if not one.is_closed] + [file]
        return file

    def read(self, path: str, most: int) -> tuple[Path, bytes]:
        """Content of a program file, and its path as the user named the folder.

        Raises:
            RapidError: ERR_FILNOTFND if it does not exist, ERR_IOERROR if it cannot be read,
                ERR_PRGMEMFULL if it has more than `most` bytes.
        """
        try:
            place = self._place(path)
        except RapidError as error:
            raise rapid_error(ERR_FILNOTFND, error.message) from None
        for file in self._files:
            file.flush()
        self._note_missing(place)
        if not place.is_file():
            raise rapid_error(ERR_FILNOTFND, f"there is no file {path} in {self._folder}")
        try:
            with os.fdopen(os.open(place, os.O_RDONLY | CAUTION), "rb") as stream:
                data = stream.read(most + 1)
        except OSError as error:
            reason = (error.strerror or "cannot be read").lower()
            raise rapid_error(ERR_IOERROR, f"{path}: {reason}") from None
        if len(data) > most:
            raise rapid_error(ERR_PRGMEMFULL, f"{path} has more than {most:g} bytes")
        self._loaded.pop(place, None)
        if place in self._written:
            self._loaded[place] = self._written[place]
        for folder in (self._folder, self._ramdisk):
            root = _real(folder)
            if folder is not None and root is not None and place.is_relative_to(root):
                return folder / place.relative_to(root), data
        return place, data

    def copy(self, old: str, new: str, now_s: float = 0.0) -> None:
        """Copy a file.

        Raises:
            RapidError: ERR_FILEACC, ERR_FILEEXIST, or ERR_FILEOPEN outside the home folder.
        """
        source, target = self._regular(old), self._free(new)
        with _refusals(new):
            self.disk.make(target)
            target.parent.mkdir(parents=True, exist_ok=True)
            self.disk.use(source.stat().st_size)
            shutil.copyfile(source, target, follow_symlinks=False)
        self._written[target] = now_s

    def rename(self, old: str, new: str) -> None:
        """Rename or move a file; raises as `copy` does."""
        source, target = self._regular(old), self._free(new)
        with _refusals(new):
            self.disk.make(target)
            target.parent.mkdir(parents=True, exist_ok=True)
            source.rename(target)
        self._written[target] = self._written.pop(source, 0.0)

    def remove(self, path: str) -> None:
        """Delete a file."""
        place = self._regular(path)
        with _refusals(path):
            place.unlink()
        self._written.pop(place, None)

    def make_folder(self, path: str) -> None:
        """Make a folder that does not exist yet."""
        place = self._place(path)
        with _refusals(path):
            self.disk.make(place)
            place.parent.mkdir(parents=True, exist_ok=True)
            place.mkdir()

    def remove_folder(self, path: str) -> None:
        """Delete an empty folder."""
        place = self._place(path)
        self._note_missing(place)
        with _refusals(path):
            place.rmdir()

    def names_in(self, path: str) -> tuple[str, ...]:
        """The names of the entries of a folder, sorted."""
        place = self._place(path, or_root=True)
        self.lacks = self.lacks or self._is_disk(place) or not place.exists()
        if not place.exists() and self._is_disk(place):
            return ()
        with _refusals(path):
            return tuple(sorted(one.name for one in place.iterdir()))

    def is_folder(self, path: str) -> bool:
        """Whether a folder exists; a disk always does."""
        place = self._place(path, or_root=True)
        if self._is_disk(place):
            return True
        self._note_missing(place)
        return place.is_dir()

    def size(self, path: str) -> int | None:
        """Size of a file [bytes]; None if there is no such file."""
        place = self._place(path, or_root=True)
        self._note_missing(place)
        for file in self._files:
            file.flush()
        return place.stat().st_size if place.is_file() else None

    def written_s(self, path: str) -> float | None:
        """Time [s] at which the run wrote a file, 0 if it did not; None if it does not exist."""
        place = self._place(path, or_root=True)
        self._note_missing(place)
        return self._written.get(place, 0.0) if place.exists() else None

    def loaded_s(self, path: str) -> float:
        """Time [s] at which the run wrote a program file before reading it, 0 if it did not."""
        return self._loaded.get(self._place(path), 0.0)

    def bytes_in(self, path: str) -> int:
        """Bytes of all files below a folder."""
        place = self._place(path, or_root=True)
        return sum(one.lstat().st_size for one in place.rglob("*") if one.is_file())

    def close_all(self, owner: object = None) -> None:
        """Close the files that an owner has open; None closes all."""
        for file in self._files:
            if owner is None or file.owner is owner:
                file.close()

    def snapshot(self) -> HomeSnapshot | None:
        """Return the state of the files; None if the run has none, or they are too large."""
        positions = tuple((one, one.position()) for one in self._files if not one.is_closed)
        root = _real(self._folder)
        if root is None or not root.is_dir():
            return HomeSnapshot({}, positions)
        files = [one for one in root.rglob("*") if one.is_file() and not one.is_symlink()]
        if sum(one.stat().st_size for one in files) > _LARGEST_SNAPSHOT:
            return None
        return HomeSnapshot({one: one.read_bytes() for one in files}, positions)

    def restore(self, snapshot: HomeSnapshot) -> None:
        """Put the files back to an earlier state; files in it that are open stay open."""
        root = _real(self._folder)
        if root is not None and root.is_dir():
            for one in root.rglob("*"):
                if one.is_file() and one not in snapshot.content:
                    one.unlink()
        for place, data in snapshot.content.items():
            if not place.is_file() or place.read_bytes() != data:
                place.parent.mkdir(parents=True, exist_ok=True)
                # Not replaced as a whole: it may be open.
                place.write_bytes(data)
        for file, position in snapshot.positions:
            file.move_to(position)

    def written(self) -> tuple[tuple[str, int], ...]:
        """Path and size [bytes] of each file the program wrote, in order of opening."""
        return tuple((str(path), path.stat().st_size) for path in self._written if path.exists())

    def _regular(self, path: str) -> Path:
        """Path of an existing file."""
        for file in self._files:
            file.flush()
        place = self._place(path)
        self._note_missing(place)
        if not place.is_file():
            raise rapid_error(ERR_FILEACC, f"there is no file {path}")
        return place

    def _note_missing(self, place: Path) -> None:
        """Record a request of a file or folder that does not exist."""
        self.lacks = self.lacks or not place.exists()

    def _free(self, path: str) -> Path:
        """Path of a file that does not exist yet."""
        place = self._place(path)
        if place.exists():
            raise rapid_error(ERR_FILEEXIST, f"{path} is there already")
        return place

    def _is_disk(self, place: Path) -> bool:
        root = _real(self._folder)
        named_so = place.parent == root and _DISK.fullmatch(place.name) is not None
        return place in (root, _real(self._ramdisk)) or (named_so and not place.exists())

    def _place(self, path: str, *, or_root: bool = False) -> Path:
        """Path on the user's disk of a RAPID path; the home folder itself only if allowed."""
        root = _real(self._folder)
        if root is None:
            raise RapidError(ERR_FILEOPEN, f"{path}: the run has no home folder (use --home)")
        device, colon, rest = path.replace("\\", "/").rpartition(":")
        disk = device.lstrip("/").upper()
        if not colon and rest.upper().startswith(_HOME_FOLDER):
            rest = rest[len(_HOME_FOLDER) :]
        elif disk == "RAMDISK" and self._ramdisk is not None:
            root, disk = Path(os.path.realpath(self._ramdisk)), ""
        elif colon and disk != "HOME":
            if not _DISK.fullmatch(disk):
                raise RapidError(ERR_FILEOPEN, f"{path}: only disks are simulated, as HOME:")
            rest = f"{disk}/{rest.lstrip('/')}"
        if "\0" in rest:
            raise RapidError(ERR_FILEOPEN, f"{path!r} is not a file name")
        place = Path(os.path.realpath(root / rest.lstrip("/")))
        if place.is_symlink() or os.path.realpath(place) != str(place):
            # The target of a link to itself is not resolved, and could hide a link that leads
            # outside.
            raise RapidError(ERR_FILEOPEN, f"{path} is a link to itself")
        is_whole_disk = place in (root, root / disk.removesuffix("HOME"))
        if not place.is_relative_to(root) or (is_whole_disk and not or_root):
            raise RapidError(ERR_FILEOPEN, f"{path} lies outside the home folder")
        return place


def _real(folder: Path | None) -> Path | None:
    return None if folder is None else Path(os.path.realpath(folder))


@contextmanager
def _refusals(path: str) -> Iterator[None]:
    """Convert errors of the disk to the error that a program can catch."""
    try:
        yield
    except OSError as error:
        reason = (error.strerror or "cannot be done").lower()
        raise rapid_error(ERR_FILEACC, f"{path}: {reason}") from None


def _flags(mode: FileMode) -> int:
    match mode:
        case FileMode.READ:
            return os.O_RDONLY
        case FileMode.WRITE:
            return os.O_WRONLY | os.O_CREAT | os.O_TRUNC
        case FileMode.APPEND:
            return os.O_WRONLY | os.O_CREAT | os.O_APPEND
