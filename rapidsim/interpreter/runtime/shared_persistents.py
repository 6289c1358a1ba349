"""Persistents that several tasks share: one variable per name, changes visible to all.

A PERS that is neither LOCAL nor TASK and has the same name in several tasks is one variable. Its
initial value is the first that a task declares. Before a task reads or writes it, the other tasks
must be synchronised to its time; a `SharedAccessObserver` does that.

Source: RAPID Overview, "Declarations", persistent declarations.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import field
from typing import Any, Protocol, SupportsIndex

from rapidsim.analysis.program import DataSymbol, Program, Scope, Storage
from rapidsim.interpreter.runtime.arrays import copied
from rapidsim.interpreter.runtime.memory import (
    PersistentArray,
    PersistentBox,
    initial_literal,
    module_data,
)
from rapidsim.language.error_numbers import ERR_LINKREF, rapid_error
from rapidsim.language.initial_values import initial_value
from rapidsim.language.reference import Box
from rapidsim.language.types import same
from rapidsim.syntax import tree
from rapidsim.values import value_class

_CONTENT = Box.__dict__["value"]
"""Slot of a cell's value, which `SharedBox` hides behind a property."""


class SharedAccessObserver(Protocol):
    """Notified when shared data are read and changed."""

    def synchronise(self) -> None:
        """Synchronise every other task to the time of the current statement."""
        ...

    def notify(self) -> None:
        """Notify that shared data have changed."""
        ...


class SharedBox(PersistentBox):
    """A shared PERS that is not an array."""

    __slots__ = ("_board",)

    def __init__(self, value: Any, board: SharedAccessObserver) -> None:
        """Set the initial value."""
        self._board = board
        _CONTENT.__set__(self, value)

    @property
    def value(self) -> Any:
        """The current value."""
        self._board.synchronise()
        return _CONTENT.__get__(self)

    @value.setter
    def value(self, value: Any) -> None:
        self._board.synchronise()
        _CONTENT.__set__(self, value)
        self._board.notify()


class SharedArray(PersistentArray):
    """A shared PERS array, or a row of one."""

    __slots__ = ("_board",)

    def __init__(self, values: Sequence[Any], board: SharedAccessObserver) -> None:
        """Set the initial values; rows are shared too."""
        super().__init__(
            SharedArray(one, board) if isinstance(one, list) else one for one in values
        )
        self._board = board

    def __getitem__(self, index: SupportsIndex | slice) -> Any:
        """Return the current elements."""
        self._board.synchronise()
        return super().__getitem__(index)

    def __setitem__(self, index: SupportsIndex | slice, value: Any) -> None:
        """Change elements."""
        self._board.synchronise()
        super().__setitem__(index, value)
        self._board.notify()


@value_class(frozen=True, slots=True)
class TypeConflict:
    """A PERS that two tasks declare with different types."""

    first: DataSymbol
    symbol: DataSymbol


@value_class(slots=True)
class SharedPersistents:
    """The persistents shared by some tasks, by folded name."""

    board: SharedAccessObserver
    declared: dict[str, DataSymbol]
    """The declaration with the initial value of each."""
    changing: frozenset[str]
    """Persistents that some task may write. The others, mostly tools, need no observer."""
    may_grow: bool = False
    """Whether tasks may load modules that declare more: then all candidates are shared."""
    _homes: dict[str, Any] = field(default_factory=dict)
    _users: dict[str, set[object]] = field(default_factory=dict)
    """The current declarations of each."""

    def home(self, symbol: DataSymbol) -> Any:
        """The cell or array of a variable; None if it is not shared."""
        key = symbol.name.lower()
        if not may_be_shared(symbol) or not (self.may_grow or key in self.declared):
            return None
        declaration = self.declared.setdefault(key, symbol)
        if not same(declaration.type, symbol.type):
            raise rapid_error(
                ERR_LINKREF,
                f"PERS {symbol.name} is {symbol.type.name} here and {declaration.type.name} in "
                "another task, and tasks share it",
            )
        self._users.setdefault(key, set()).add(symbol.node)
        if key not in self._homes:
            value = initial_literal(declaration)
            value = copied(initial_value(symbol.type) if value is None else value)
            self._homes[key] = self._new_home(value, changes=self.may_grow or key in self.changing)
        return self._homes[key]

    def release(self, node: tree.Data) -> None:
        """Drop a declaration whose module was removed; data without another one start afresh."""
        key = node.name.key
        users = self._users.get(key, set())
        if node not in users:
            return
        users.remove(node)
        if not users:
            self._homes.pop(key, None)
            self.declared.pop(key, None)

    def _new_home(self, value: Any, *, changes: bool) -> Any:
        if isinstance(value, list):
            return SharedArray(value, self.board) if changes else PersistentArray(value)
        return SharedBox(value, self.board) if changes else PersistentBox(value)


def shared_persistents(
    programs: Sequence[Program],
    board: SharedAccessObserver,
    written: Sequence[frozenset[str] | None],
) -> SharedPersistents:
    """Determine the persistents that the programs of several tasks share.

    Args:
        programs: One per task.
        board: Receives accesses and changes.
        written: Folded names of the persistents that each program may write; None for all of them.
    """
    may_grow = any(program.loads_modules for program in programs)
    common = dict(_by_name(programs, least=1 if may_grow else 2))
    known = [names for names in written if names is not None]
    changing = frozenset(common) if len(known) < len(written) else frozenset().union(*known)
    declared = {
        key: next((one for one in symbols if _has_value(one)), symbols[0])
        for key, symbols in common.items()
    }
    return SharedPersistents(board, declared, changing, may_grow)


def disagreements(programs: Sequence[Program]) -> tuple[TypeConflict, ...]:
    """The persistents that tasks would share if they agreed on their type."""
    return tuple(
        TypeConflict(symbols[0], other)
        for _, symbols in _by_name(programs)
        for other in symbols[1:]
        if not same(symbols[0].type, other.type)
    )


def may_be_shared(symbol: DataSymbol) -> bool:
    """Whether tasks that declare data of this name share them."""
    return symbol.storage is Storage.PERS and symbol.scope is Scope.GLOBAL


def _by_name(programs: Sequence[Program], least: int = 2) -> Iterator[tuple[str, list[DataSymbol]]]:
    """Yield the persistents that at least `least` programs declare, in source order."""
    found: dict[str, list[DataSymbol]] = {}
    for program in programs:
        for symbol in module_data(program):
            if may_be_shared(symbol):
                found.setdefault(symbol.name.lower(), []).append(symbol)
    return ((key, symbols) for key, symbols in found.items() if len(symbols) >= least)


def _has_value(symbol: DataSymbol) -> bool:
    return symbol.node is not None and symbol.node.value is not None
