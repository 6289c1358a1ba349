"""Files of the home folder, as a program reads and writes them."""

from __future__ import annotations

from enum import Enum
from typing import Protocol

from rapidsim.diagnostics import Source


class FileMode(Enum):
    """The mode in which a file is opened."""

    READ = "read"
    WRITE = "write"
    APPEND = "append"


class OpenFile(Protocol):
    """An open file of the controller's home folder; bytes are text in ISO 8859-1."""

    def write(self, data: bytes) -> None:
        """Append bytes."""
        ...

    def read_line(self) -> bytes | None:
        """The next line without its end; None at the end of the file."""
        ...

    def read(self, count: int) -> bytes:
        """Read up to `count` bytes; empty at the end of the file."""
        ...

    def rewind(self) -> None:
        """Go back to the first byte."""
        ...

    def close(self) -> None:
        """Flush and close; closing twice does nothing."""
        ...


class Files(Protocol):
    """The controller's disk, confined to the home folder of the run."""

    def open_file(self, path: str, mode: FileMode) -> OpenFile:
        """Open a file by its RAPID name, such as "HOME:/log/today.txt".

        Raises:
            RapidError: ERR_FILEOPEN when it is missing, outside the home folder, or unavailable.
        """
        ...

    def read_module(self, path: str, most: int) -> Source:
        """The text of a program file.

        Raises:
            RapidError: ERR_FILNOTFND if it does not exist, ERR_IOERROR if it cannot be read,
                ERR_PRGMEMFULL if it has more than `most` bytes.
        """
        ...

    def copy_file(self, old: str, new: str) -> None:
        """Copy a file.

        Raises:
            RapidError: ERR_FILEACC, or ERR_FILEEXIST if the new one exists already.
        """
        ...

    def rename_file(self, old: str, new: str) -> None:
        """Rename or move a file; raises as `copy_file` does."""
        ...

    def remove_file(self, path: str) -> None:
        """Delete a file; ERR_FILEACC if it does not exist."""
        ...

    def make_folder(self, path: str) -> None:
        """Make a folder; ERR_FILEACC if it exists or cannot be made."""
        ...

    def remove_folder(self, path: str) -> None:
        """Delete an empty folder; ERR_FILEACC if it does not exist or is not empty."""
        ...

    def names_in(self, path: str) -> tuple[str, ...]:
        """The names in a folder, in order; ERR_FILEACC if it does not exist."""
        ...

    def is_folder(self, path: str) -> bool:
        """Whether a folder exists."""
        ...

    def file_size(self, path: str) -> int | None:
        """Size of a file [bytes]; None if it does not exist."""
        ...

    def written_s(self, path: str) -> float | None:
        """Time [s] at which the run wrote a file, 0 if it did not; None if it does not exist."""
        ...

    def loaded_s(self, path: str) -> float:
        """Time [s] at which the run wrote a program file before loading it, 0 if it did not."""
        ...

    def bytes_in(self, path: str) -> int:
        """Bytes of all files below a folder."""
        ...
