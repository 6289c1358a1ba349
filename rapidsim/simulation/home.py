"""The controller's home folder on our disk, which a program cannot leave.

RAPID names files "HOME:/log/today.txt" or just "today.txt". Both mean a place inside the folder the
run was given. Whatever would lie outside, through "..", an absolute path or a link, is refused, as
are devices: a program is untrusted input.
"""

from __future__ import annotations

import os
import stat
from pathlib import Path
from typing import BinaryIO

from rapidsim.language.controller import FileMode, OpenFile
from rapidsim.language.error_numbers import ERR_FILEACC, ERR_FILEOPEN
from rapidsim.language.errors import RapidError

# Never wait for a pipe, never follow a link that appeared after the check; Windows has neither.
_CAUTION = getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_BINARY", 0)
_MODES = {FileMode.READ: "rb", FileMode.WRITE: "wb", FileMode.APPEND: "ab"}


class HomeFile:
    """One open file of the home folder."""

    def __init__(self, stream: BinaryIO, name: str) -> None:
        """Take over an open stream; `name` is for messages."""
        self._stream = stream
        self._name = name

    def write(self, data: bytes) -> None:
        """Append bytes."""
        self._open().write(data)

    def read_line(self) -> bytes | None:
        """The next line without its end; None at the end of the file."""
        line = self._open().readline()
        return line.rstrip(b"\r\n") if line else None

    def read(self, count: int) -> bytes:
        """Up to `count` bytes; none at the end of the file."""
        return self._open().read(count)

    def rewind(self) -> None:
        """Go back to the first byte."""
        self._open().seek(0)

    def close(self) -> None:
        """Flush and close; closing twice does nothing."""
        self._stream.close()

    def _open(self) -> BinaryIO:
        if self._stream.closed:
            raise RapidError(ERR_FILEACC, f"{self._name} is closed")
        return self._stream


class HomeFolder:
    """The files a program may use, and a list of those it wrote."""

    def __init__(self, folder: Path | None) -> None:
        """Confine all paths to `folder`; None means that there is none."""
        self._folder = folder
        self._files: list[HomeFile] = []
        self._written: dict[Path, None] = {}

    def open_file(self, path: str, mode: FileMode) -> OpenFile:
        """Open a file named as RAPID names it.

        Raises:
            RapidError: ERR_FILEOPEN, with the reason.
        """
        place = self._place(path)
        try:
            if mode is not FileMode.READ:
                place.parent.mkdir(parents=True, exist_ok=True)
            descriptor = os.open(place, _flags(mode) | _CAUTION, 0o666)
            if not stat.S_ISREG(os.fstat(descriptor).st_mode):
                os.close(descriptor)
                raise RapidError(ERR_FILEOPEN, f"{path} is not a regular file")
            stream = os.fdopen(descriptor, _MODES[mode])
        except OSError as error:
            reason = (error.strerror or "cannot be opened").lower()
            raise RapidError(ERR_FILEOPEN, f"{path}: {reason}") from None
        if mode is not FileMode.READ:
            self._written[place] = None
        file = HomeFile(stream, path)  # type: ignore[arg-type]
        self._files.append(file)
        return file

    def close_all(self) -> None:
        """Close what the program left open."""
        for file in self._files:
            file.close()

    def written(self) -> tuple[tuple[str, int], ...]:
        """Path and size [bytes] of each file the program wrote, in order of opening."""
        return tuple((str(path), path.stat().st_size) for path in self._written if path.exists())

    def _place(self, path: str) -> Path:
        """The place of a RAPID path on our disk."""
        if self._folder is None:
            raise RapidError(ERR_FILEOPEN, f"{path}: the run has no home folder (use --home)")
        root = self._folder.resolve()
        device, colon, rest = path.replace("\\", "/").rpartition(":")
        if colon and device.lstrip("/").lower() != "home":
            raise RapidError(ERR_FILEOPEN, f"{path}: only HOME: is simulated")
        if "\0" in rest:
            raise RapidError(ERR_FILEOPEN, f"{path!r} is not a file name")
        place = (root / rest.lstrip("/")).resolve()
        if not place.is_relative_to(root) or place == root:
            raise RapidError(ERR_FILEOPEN, f"{path} lies outside the home folder")
        return place


def _flags(mode: FileMode) -> int:
    match mode:
        case FileMode.READ:
            return os.O_RDONLY
        case FileMode.WRITE:
            return os.O_WRONLY | os.O_CREAT | os.O_TRUNC
        case FileMode.APPEND:
            return os.O_WRONLY | os.O_CREAT | os.O_APPEND
