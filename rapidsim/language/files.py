"""Files of the home folder, as a program reads and writes them."""

from __future__ import annotations

from enum import Enum
from typing import Protocol

from rapidsim.diagnostics import Source


class FileMode(Enum):
    """The mode a file is opened in."""

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
        """Up to `count` bytes; none at the end of the file."""
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
        """Open a file named as RAPID names it, such as "HOME:/log/today.txt".

        Raises:
            RapidError: ERR_FILEOPEN when it is missing, outside the home folder, or not to be had.
        """
        ...

    def read_module(self, path: str, most: int) -> Source:
        """The text of a program file.

        Raises:
            RapidError: ERR_FILNOTFND if there is none, ERR_IOERROR if it cannot be read,
                ERR_PRGMEMFULL if it has more than `most` bytes.
        """
        ...

    def copy_file(self, old: str, new: str) -> None:
        """Copy a file.

        Raises:
            RapidError: ERR_FILEACC, or ERR_FILEEXIST if the new one is there already.
        """
        ...

    def rename_file(self, old: str, new: str) -> None:
        """Give a file another name or place; raises as `copy_file` does."""
        ...

    def remove_file(self, path: str) -> None:
        """Delete a file; ERR_FILEACC if there is none."""
        ...

    def make_folder(self, path: str) -> None:
        """Make a folder; ERR_FILEACC if it is there or cannot be made."""
        ...

    def remove_folder(self, path: str) -> None:
        """Delete an empty folder; ERR_FILEACC if it is not there or not empty."""
        ...

    def names_in(self, path: str) -> tuple[str, ...]:
        """The names in a folder, in order; ERR_FILEACC if there is none."""
        ...

    def is_folder(self, path: str) -> bool:
        """Whether a folder is there."""
        ...

    def file_size(self, path: str) -> int | None:
        """Size of a file [bytes]; None if there is no such file."""
        ...

    def written_s(self, path: str) -> float | None:
        """When a file was written [s], 0 if before the run; None if there is none."""
        ...

    def loaded_s(self, path: str) -> float:
        """When a program file had been written that was then loaded [s]; 0 where before."""
        ...

    def bytes_in(self, path: str) -> int:
        """Bytes of all files below a folder."""
        ...
