"""The program memory of a task: modules that come and go while it runs."""

from __future__ import annotations

from typing import Protocol

from rapidsim.diagnostics import Source
from rapidsim.language.errors import RapidError
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class LoadSession:
    """A file that StartLoad has read; what a variable of type `loadsession` holds."""

    path: str
    """As the program named it."""
    source: Source | RapidError
    """What was read; or why nothing was, which WaitLoad raises."""


@value_class(frozen=True, slots=True)
class SavedModule:
    """A module as it would be saved now."""

    name: str
    text: str
    """With the values that its persistents have now."""
    loaded_text: str
    """As it came in."""
    loaded_from: str | None
    """The file it was loaded from; None for a module that the task began with."""


class Modules(Protocol):
    """The modules of a running task."""

    def has(self, name: str) -> bool:
        """Whether there is a module of a name, in any case."""
        ...

    def load(self, source: Source, path: str, *, check_references: bool) -> None:
        """Take the modules of a file into the program, with their initial values.

        Modules that use names which nothing declares yet wait until another module declares them.

        Args:
            source: The text of the file.
            path: Where it is from, as the program named it.
            check_references: Refuse the file if then anything is used that nothing declares.

        Raises:
            RapidError: ERR_SYNTAX, ERR_LOADED, ERR_PRGMEMFULL or ERR_LINKREF; the program is as
                before.
        """
        ...

    def unload(self, path: str) -> None:
        """Remove the modules that were loaded from a file.

        Raises:
            RapidError: ERR_UNLOAD if there are none, or they execute.
        """
        ...

    def erase(self, name: str) -> None:
        """Remove a module by its name, however it came in.

        Raises:
            RapidError: ERR_MODULE if there is none, or it executes.
        """
        ...

    def check_references(self) -> None:
        """Look whether anything is used that nothing declares.

        Raises:
            RapidError: ERR_LINKREF if so.
        """
        ...

    def loaded_from(self, path: str) -> tuple[SavedModule, ...]:
        """The modules that were loaded from a file; none if that was not loaded."""
        ...

    def saved(self, name: str) -> SavedModule:
        """A module by its name.

        Raises:
            RapidError: ERR_MODULE if there is none.
        """
        ...
