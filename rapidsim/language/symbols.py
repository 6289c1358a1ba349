"""Data of a running program found by their names: what GetDataVal and its like ask for."""

from __future__ import annotations

from typing import Protocol

from rapidsim.language.types import Type
from rapidsim.values import dataclass


@dataclass(frozen=True, slots=True)
class DataName:
    """Data that a module declares; what a variable of type `datapos` holds."""

    name: str
    module: str


@dataclass(frozen=True, slots=True)
class Search:
    """Which data to look for."""

    type: str
    """Name of the type; "" for any."""
    pattern: str | None
    """What the whole name must match; None for any."""
    storages: tuple[str, ...]
    """Of VAR, PERS, CONST."""
    module: str | None = None
    only_global: bool = False
    only_local: bool = False


class Symbols(Protocol):
    """The data that the modules of a task declare."""

    def read(self, name: str, of: Type, where: DataName | None) -> object:
        """A copy of a value.

        Args:
            name: As in the program, in any case; with an element or component behind it.
            of: The type it must have.
            where: The data of that name that are meant, where several modules have some.

        Raises:
            RapidError: ERR_SYM_ACCESS if there are no such data, ERR_SYMBOL_TYPE or ERR_INVDIM if
                they are of another type or size.
        """
        ...

    def write(self, name: str, of: Type, where: DataName | None, value: object) -> None:
        """Change a value; raises as `read` does, and ERR_SYM_ACCESS for constants."""
        ...

    def search(self, search: Search) -> tuple[DataName, ...]:
        """All matching data, in the order they are written."""
        ...

    def begin_search(self, search: Search | None) -> None:
        """Look for data; `next_found` gives them one by one. None finds nothing."""
        ...

    def next_found(self) -> DataName | None:
        """The next data of the search; None when there are no more."""
        ...
