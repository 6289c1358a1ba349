"""Data of a running program by their names, for GetDataVal and its like."""

from __future__ import annotations

from typing import Protocol

from rapidsim.language.types import Type
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class DataName:
    """Data that a module declares: the value of a variable of type `datapos`."""

    name: str
    module: str


@value_class(frozen=True, slots=True)
class DataSearch:
    """Criteria of a search for data."""

    type: str
    """Name of the type; "" for any."""
    pattern: str | None
    """Pattern for the whole name; None for any."""
    storages: tuple[str, ...]
    """Any of VAR, PERS, CONST."""
    module: str | None = None
    only_global: bool = False
    only_local: bool = False


class Symbols(Protocol):
    """The data that the modules of a task declare."""

    def read(self, name: str, of: Type, data_name: DataName | None) -> object:
        """A copy of a value.

        Args:
            name: Name as in the program, ignoring case; may end in an element or component.
            of: The type it must have.
            data_name: The data to use if several modules have data of that name.

        Raises:
            RapidError: ERR_SYM_ACCESS if there are no such data, ERR_SYMBOL_TYPE or ERR_INVDIM if
                they are of another type or size.
        """
        ...

    def write(self, name: str, of: Type, data_name: DataName | None, value: object) -> None:
        """Change a value; raises as `read` does, and ERR_SYM_ACCESS for constants."""
        ...

    def search(self, search: DataSearch) -> tuple[DataName, ...]:
        """All matching data, in the order of their declarations."""
        ...

    def begin_search(self, search: DataSearch | None) -> None:
        """Begin a search; `next_match` returns its results one by one. None ends in no results."""
        ...

    def next_match(self) -> DataName | None:
        """The next data of the search; None at its end."""
        ...
