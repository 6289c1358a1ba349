"""Access of one task to the home folder and to the text tables, which all tasks share."""

from __future__ import annotations

from collections.abc import Mapping

from rapidsim.controller.cell.cell import Cell
from rapidsim.controller.clock import TaskClock
from rapidsim.controller.journal.events import EventKind
from rapidsim.diagnostics import Source
from rapidsim.files import decode
from rapidsim.language.files import FileMode, OpenFile
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class FileAccess:
    """Implements `language.files.Files`."""

    clock: TaskClock
    cell: Cell

    def open_file(self, path: str, mode: FileMode) -> OpenFile:
        """Open a file of the home folder.

        Raises:
            RapidError: See `HomeFolder.open_file`.
        """
        file = self.cell.home.open_file(path, mode, self.clock.now(), owner=self)
        self.clock.event(
            EventKind.FILE, f"opened {path} to {mode.value}", path=path, mode=mode.value
        )
        return file

    def close_all(self) -> None:
        """Close the files that the task has open."""
        self.cell.home.close_all(owner=self)

    def read_module(self, path: str, most: int) -> Source:
        """The text of a program file of the home folder.

        Raises:
            RapidError: See `HomeFolder.read`.
        """
        place, data = self.cell.home.read(path, most)
        self.clock.event(EventKind.FILE, f"opened {path} to load", path=path, mode="load")
        return Source(str(place), decode(data)[0])

    def copy_file(self, old: str, new: str) -> None:
        """Copy a file of the home folder."""
        self.cell.home.copy(old, new, self.clock.now())
        self.clock.event(EventKind.FILE, f"copied {old} to {new}", path=new)

    def rename_file(self, old: str, new: str) -> None:
        """Rename a file of the home folder."""
        self.cell.home.rename(old, new)
        self.clock.event(EventKind.FILE, f"renamed {old} to {new}", path=new)

    def remove_file(self, path: str) -> None:
        """Delete a file of the home folder."""
        self.cell.home.remove(path)
        self.clock.event(EventKind.FILE, f"removed {path}", path=path)

    def make_folder(self, path: str) -> None:
        """Make a folder in the home folder."""
        self.cell.home.make_folder(path)
        self.clock.event(EventKind.FILE, f"made the folder {path}", path=path)

    def remove_folder(self, path: str) -> None:
        """Delete an empty folder in the home folder."""
        self.cell.home.remove_folder(path)
        self.clock.event(EventKind.FILE, f"removed the folder {path}", path=path)

    def names_in(self, path: str) -> tuple[str, ...]:
        """The names in a folder."""
        return self.cell.home.names_in(path)

    def is_folder(self, path: str) -> bool:
        """Whether a folder exists."""
        return self.cell.home.is_folder(path)

    def file_size(self, path: str) -> int | None:
        """Size of a file [bytes]; None if it does not exist."""
        return self.cell.home.size(path)

    def written_s(self, path: str) -> float | None:
        """Time [s] at which the run wrote a file, 0 if it did not; None if it does not exist."""
        return self.cell.home.written_s(path)

    def loaded_s(self, path: str) -> float:
        """Time [s] at which the run wrote a program file before loading it, 0 if it did not."""
        return self.cell.home.loaded_s(path)

    def bytes_in(self, path: str) -> int:
        """Bytes of all files below a folder."""
        return self.cell.home.bytes_in(path)


@value_class(frozen=True, slots=True)
class TaskTexts:
    """Implements `language.texts.Texts`."""

    clock: TaskClock
    cell: Cell

    def install_texts(self, name: str, texts: Mapping[int, str]) -> None:
        """Install a table of texts."""
        self._see_others()
        self.cell.texts.install(name, texts)

    def text_table(self, name: str) -> int | None:
        """Number of a text table; None if no table has that name."""
        self._see_others()
        return self.cell.texts.number(name)

    def table_text(self, table: float, index: float) -> str | None:
        """Text of a table; None if it does not exist."""
        return self.cell.texts.text(table, index)

    def _see_others(self) -> None:
        """Synchronise with other tasks, which may have installed texts."""
        if self.cell.is_shared:
            self.clock.synchronise()
