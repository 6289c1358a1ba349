"""Names known to every controller: installed routines, predefined data and types."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache

from rapidsim.analysis.program import DataSymbol, LibrarySymbol, Scope, Storage, Symbol
from rapidsim.language.types import Type
from rapidsim.library.catalogue import ROUTINES
from rapidsim.library.predefined import DATA, TYPES


@cache
def installed_symbol(key: str) -> Symbol | None:
    """The symbol of a predefined name, by folded name; always the same object."""
    datum = DATA.get(key)
    if datum is not None:
        storage = (
            Storage.CONST if datum.constant else Storage.PERS if datum.persistent else Storage.VAR
        )
        return DataSymbol(datum.name, datum.type, storage, Scope.INSTALLED, None, None, datum.value)
    routine = ROUTINES.get(key)
    return None if routine is None else LibrarySymbol(routine.name, routine)


def installed_type(key: str) -> Type | None:
    """A predefined type by folded name."""
    return TYPES.get(key)


def has_installed(keys: frozenset[str]) -> bool:
    """Whether a folded name among others is predefined: one of data, a routine or a type."""
    return any(not keys.isdisjoint(names) for names in (DATA, ROUTINES, TYPES))


def installed_routine_names() -> Iterator[str]:
    """The names of installed instructions and functions."""
    for routine in ROUTINES.values():
        yield routine.name


def installed_data_names() -> Iterator[str]:
    """The names of predefined data."""
    for datum in DATA.values():
        yield datum.name


def installed_type_names() -> Iterator[str]:
    """The names of predefined types."""
    yield from TYPES
