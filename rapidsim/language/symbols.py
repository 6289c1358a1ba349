"""Data of a running program found by their names: what GetDataVal and its like ask for."""

from __future__ import annotations

from typing import Protocol

from rapidsim.language.types import Type
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class DataName:
    """Data that a module declares; what a variable of type `datapos` holds."""

    name: str
    module: str


@value_class(frozen=True, slots=True)
class DataSearch:
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

    def read(self, name: str, of: Type, data_name: DataName | None) -> object:
        """A copy of a value.

        Args:
            name: As in the program, in any case; with an element or component behind it.
            of: The type it must have.
            data_name: The data of that name that are meant, where several modules have some.

        Raises:
            RapidError: ERR_SYM_ACCESS if there are no such data, ERR_SYMBOL_TYPE or ERR_INVDIM if
                they are of another type or size.
        """
        ...

    def write(self, name: str, of: Type, data_name: DataName | None, value: object) -> None:
        """Change a value; raises as `read` does, and ERR_SYM_ACCESS for constants."""
        ...

    def search(self, search: DataSearch) -> tuple[DataName, ...]:
        """All matching data, in the order they are written."""
        ...

    def begin_search(self, search: DataSearch | None) -> None:
        """Look for data; `next_match` gives them one by one. None finds nothing."""
        ...

    def next_match(self) -> DataName | None:
        """The next data of the search; None when there are no more."""
        ...
