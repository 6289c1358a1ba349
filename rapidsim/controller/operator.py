"""What one task says and asks: the FlexPendant, files and texts; what it does not simulate."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from datetime import datetime, timedelta

from rapidsim.controller.clock import TaskTime
from rapidsim.controller.journal.events import EventKind
from rapidsim.diagnostics import Source
from rapidsim.files import decode
from rapidsim.language.controller import FileMode, OpenFile


class TaskOperator(TaskTime):
    """Implements `language.controller.Operator`, `Files`, `Texts` and `Honesty`."""

    def show(self, text: str) -> None:
        """Write a line on the FlexPendant."""
        self._event(EventKind.TEXT, text)

    def clear_screen(self) -> None:
        """Remove all lines from the FlexPendant."""
        self._event(EventKind.TEXT, "", cleared=True)

    def ask_number(self, prompt: str) -> float:
        """The operator's answer to a question."""
        self._observe()
        answer = self._cell.operator.number(prompt)
        for violation in answer.findings:
            self._journal.finding(violation, self.place)
        self._event(
            EventKind.TEXT, f"{prompt} {answer.value:g}", prompt=prompt, answer=answer.value
        )
        return answer.value

    def ask_choice(self, prompt: str, choices: Sequence[str]) -> int:
        """Index of the key the operator presses; the first that is there, where nobody sits."""
        self._observe()
        answer = self._cell.operator.choice(prompt, choices)
        for violation in answer.findings:
            self._journal.finding(violation, self.place)
        pressed = choices[answer.value]
        self._event(EventKind.TEXT, f"{prompt} {pressed}", prompt=prompt, answer=pressed)
        return answer.value

    def ask_text(self, prompt: str, proposal: str) -> str:
        """A text the operator types; the proposal, where nobody sits."""
        self._observe()
        answer = self._cell.operator.text(prompt, proposal)
        for violation in answer.findings:
            self._journal.finding(violation, self.place)
        self._event(EventKind.TEXT, f"{prompt} {answer.value}", prompt=prompt, answer=answer.value)
        return answer.value

    def open_file(self, path: str, mode: FileMode) -> OpenFile:
        """Open a file of the home folder.

        Raises:
            RapidError: See `HomeFolder.open_file`.
        """
        file = self._cell.home.open_file(path, mode)
        self._event(EventKind.FILE, f"opened {path} to {mode.value}", path=path, mode=mode.value)
        return file

    def read_module(self, path: str, most: int) -> Source:
        """The text of a program file of the home folder.

        Raises:
            RapidError: See `HomeFolder.read`.
        """
        place, data = self._cell.home.read(path, most)
        self._event(EventKind.FILE, f"opened {path} to load", path=path, mode="load")
        return Source(str(place), decode(data)[0])

    def copy_file(self, old: str, new: str) -> None:
        """Copy a file of the home folder."""
        self._cell.home.copy(old, new)
        self._event(EventKind.FILE, f"copied {old} to {new}", path=new)

    def rename_file(self, old: str, new: str) -> None:
        """Give a file of the home folder another name."""
        self._cell.home.rename(old, new)
        self._event(EventKind.FILE, f"renamed {old} to {new}", path=new)

    def remove_file(self, path: str) -> None:
        """Delete a file of the home folder."""
        self._cell.home.remove(path)
        self._event(EventKind.FILE, f"removed {path}", path=path)

    def make_folder(self, path: str) -> None:
        """Make a folder in the home folder."""
        self._cell.home.make_folder(path)
        self._event(EventKind.FILE, f"made the folder {path}", path=path)

    def remove_folder(self, path: str) -> None:
        """Delete an empty folder in the home folder."""
        self._cell.home.remove_folder(path)
        self._event(EventKind.FILE, f"removed the folder {path}", path=path)

    def names_in(self, path: str) -> tuple[str, ...]:
        """The names in a folder."""
        return self._cell.home.names_in(path)

    def is_folder(self, path: str) -> bool:
        """Whether a folder is there."""
        return self._cell.home.is_folder(path)

    def file_size(self, path: str) -> int | None:
        """Size of a file [bytes]; None if there is none."""
        return self._cell.home.size(path)

    def bytes_in(self, path: str) -> int:
        """Bytes of all files below a folder."""
        return self._cell.home.bytes_in(path)

    def install_texts(self, name: str, texts: Mapping[int, str]) -> None:
        """Keep a table of texts."""
        self._see_others()
        self._cell.texts.install(name, texts)

    def text_table(self, name: str) -> int | None:
        """The number of a table of texts; None if there is none of that name."""
        self._see_others()
        return self._cell.texts.number(name)

    def table_text(self, table: float, index: float) -> str | None:
        """A text of a table; None if there is none of those numbers."""
        return self._cell.texts.text(table, index)

    def _see_others(self) -> None:
        """Let what other tasks have installed by now be there."""
        if self._cell.is_shared:
            self.come_up()

    def date_and_time(self) -> datetime:
        """What the controller's clock shows."""
        return self._cell.starts_at + timedelta(seconds=math.floor(self.now()))

    def not_simulated(self, routine: str, treated_as: str) -> None:
        """Report that a routine was not simulated and what was done instead."""
        self._journal.unsimulated(routine, treated_as, self.place)
