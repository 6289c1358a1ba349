"""Program memory of a task: modules that are loaded and unloaded while it runs."""

from __future__ import annotations

from typing import Protocol

from rapidsim.diagnostics import Source
from rapidsim.language.errors import RapidError
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class LoadSession:
    """A file that StartLoad has read: the value of a variable of type `loadsession`."""

    path: str
    """Path as in the program."""
    source: Source | RapidError
    """The text; or the error of the read, which WaitLoad raises."""


@value_class(frozen=True, slots=True)
class SavedModule:
    """A module as it would be saved now."""

    name: str
    text: str
    """Text with the current values of its persistents."""
    loaded_text: str
    """Text as it was loaded."""
    loaded_from: str | None
    """The file it was loaded from; None for a module that the task began with."""


class Modules(Protocol):
    """The modules of a running task."""

    def has(self, name: str) -> bool:
        """Whether there is a module of a name, ignoring case."""
        ...

    def is_unread(self, name: str) -> bool:
        """Whether there is a module of a name, in any case, whose text is not known."""
        ...

    def load(self, source: Source, path: str, *, check_references: bool) -> None:
        """Load the modules of a file into the program, with their initial values.

        Modules that use undeclared names wait until another module declares them.

        Args:
            source: The text of the file.
            path: Path of the file, as in the program.
            check_references: Refuse the file if the program then uses a name that nothing declares.

        Raises:
            RapidError: ERR_SYNTAX, ERR_LOADED, ERR_PRGMEMFULL or ERR_LINKREF; the program is
                unchanged.
        """
        ...

    def unload(self, path: str) -> None:
        """Remove the modules that were loaded from a file.

        Raises:
            RapidError: ERR_UNLOAD if the program has none of them, or they execute.
        """
        ...

    def erase(self, name: str) -> None:
        """Remove a module by its name, whatever its origin.

        Raises:
            RapidError: ERR_MODULE if it does not exist, or it executes.
        """
        ...

    def check_references(self) -> None:
        """Check that all names in use are declared.

        Raises:
            RapidError: ERR_LINKREF if one is not.
        """
        ...

    def loaded_from(self, path: str) -> tuple[SavedModule, ...]:
        """The modules that were loaded from a file; empty if it was not loaded."""
        ...

    def saved(self, name: str) -> SavedModule:
        """A module by its name.

        Raises:
            RapidError: ERR_MODULE if it does not exist.
        """
        ...
