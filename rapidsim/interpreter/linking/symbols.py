"""Access to the task's data by name at run time: implements `language.symbols.Symbols`."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from typing import Any

from rapidsim.analysis.program import DataSymbol, Scope, Storage
from rapidsim.interpreter.linking.linker import LinkedProgram
from rapidsim.interpreter.runtime.arrays import assign_array
from rapidsim.interpreter.runtime.memory import module_data
from rapidsim.language.error_numbers import (
    ERR_ARGVALERR,
    ERR_INVDIM,
    ERR_SYM_ACCESS,
    ERR_SYMBOL_TYPE,
    rapid_error,
)
from rapidsim.language.name_pattern import NamePattern, PatternError
from rapidsim.language.symbols import DataName, DataSearch
from rapidsim.language.types import ArrayOf, Type, same


class TaskSymbols:
    """The data that a task's modules declare."""

    def __init__(self, linked: LinkedProgram) -> None:
        """Provide access to a program and its memory."""
        self.linked = linked
        self._found: deque[DataName] = deque()

    def read(self, name: str, of: Type, data_name: DataName | None) -> object:
        """A copy of a value."""
        symbol = self._symbol(name, data_name)
        _check_type(symbol, of)
        return self.linked.value_of(symbol)

    def write(self, name: str, of: Type, data_name: DataName | None, value: object) -> None:
        """Change a value."""
        symbol = self._symbol(name, data_name)
        _check_type(symbol, of)
        if symbol.storage is Storage.CONST:
            raise rapid_error(ERR_SYM_ACCESS, f"{symbol.name} is a constant")
        home: Any = self.linked.memory.home(symbol)
        if isinstance(home, list):
            assert isinstance(value, list)
            if _sizes(home) != _sizes(value):
                raise rapid_error(
                    ERR_INVDIM,
                    f"{symbol.name} has {_size_text(home)} elements, the value {_size_text(value)}",
                )
            assign_array(home, value)
        else:
            home.value = value

    def search(self, search: DataSearch) -> tuple[DataName, ...]:
        """All data that match."""
        try:
            return tuple(self._matching(search, NamePattern(search.pattern or ".*")))
        except PatternError as error:
            raise rapid_error(
                ERR_ARGVALERR, f'"{search.pattern}" is no regular expression: {error}'
            ) from None

    def begin_search(self, search: DataSearch | None) -> None:
        """Begin a search for data."""
        self._found = deque(() if search is None else self.search(search))

    def next_match(self) -> DataName | None:
        """The next match of the search."""
        return self._found.popleft() if self._found else None

    def _matching(self, search: DataSearch, pattern: NamePattern) -> Iterator[DataName]:
        for symbol in module_data(self.linked.program):
            assert symbol.module is not None
            element = symbol.type.element if isinstance(symbol.type, ArrayOf) else symbol.type
            is_local = symbol.scope is Scope.LOCAL
            if (
                (not search.type or element.name.lower() == search.type.lower())
                and symbol.storage.value in search.storages
                and search.module in (None, symbol.module.name.text)
                and not (is_local and search.only_global)
                and not (search.only_local and not is_local)
                and pattern.matches(symbol.name)
            ):
                yield DataName(symbol.name, symbol.module.name.text)

    def _symbol(self, name: str, data_name: DataName | None) -> DataSymbol:
        """Find data by name: the match of a search, otherwise global before local data."""
        key = name.strip().lower()
        named = [one for one in module_data(self.linked.program) if one.name.lower() == key]
        if data_name is not None:
            named = [
                one for one in named if one.module and one.module.name.text == data_name.module
            ]
        named.sort(key=lambda one: one.scope is Scope.LOCAL)
        if not named:
            place = f" in module {data_name.module}" if data_name else ""
            raise rapid_error(ERR_SYM_ACCESS, f"no module has data named `{name}`{place}")
        return named[0]


def _check_type(symbol: DataSymbol, of: Type) -> None:
    """Reject data of another type, or of another number of dimensions."""
    have, want = symbol.type, of
    dimensions = [len(one.dimensions) if isinstance(one, ArrayOf) else 0 for one in (have, want)]
    elements = [one.element if isinstance(one, ArrayOf) else one for one in (have, want)]
    if not same(*elements):
        raise rapid_error(
            ERR_SYMBOL_TYPE, f"{symbol.name} is {elements[0].name}, not {elements[1].name}"
        )
    if dimensions[0] != dimensions[1]:
        raise rapid_error(
            ERR_INVDIM, f"{symbol.name} has {dimensions[0]} dimensions, the value {dimensions[1]}"
        )


def _sizes(array: Any) -> tuple[int, ...]:
    sizes = []
    while isinstance(array, list):
        sizes.append(len(array))
        array = array[0]
    return tuple(sizes)


def _size_text(array: Any) -> str:
    return " x ".join(map(str, _sizes(array)))
