"""The variables of a task: one cell for each scalar or record, one list for each array.

A persistent has a separate class, so that references to it remain recognisable. Sharing a
cell or list means sharing the variable.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import field
from typing import Any

from rapidsim.analysis.literals import Value, literal
from rapidsim.analysis.program import DataSymbol, Program, Storage
from rapidsim.interpreter.runtime.arrays import copied, copy_array
from rapidsim.language.initial_values import initial_value
from rapidsim.language.reference import Box
from rapidsim.syntax import tree
from rapidsim.values import value_class


class PersistentBox(Box[Any]):
    """A PERS that is not an array."""

    __slots__ = ()


class PersistentArray(list[Any]):
    """A PERS array."""


@value_class(frozen=True, slots=True)
class ChangedPersistent:
    """A PERS whose value differs from that in the program text."""

    name: str
    module: str
    symbol: DataSymbol
    old: Value
    new: Value


@value_class(slots=True)
class Memory:
    """All module variables of a task, and the predefined data that it uses."""

    program: Program
    shared: Callable[[DataSymbol], Any] = lambda symbol: None
    """Returns the cell or array of data that other tasks share; None for others."""
    _homes: dict[object, Any] = field(default_factory=dict)
    _loaded: dict[DataSymbol, Value] = field(default_factory=dict)

    def home(self, symbol: DataSymbol) -> Any:
        """Return the cell or list of a variable, initialised on first use.

        Generated code assigns the initial values that are not literals.
        """
        # By declaration: loading modules creates a program with new symbols.
        key: object = symbol.node if symbol.node is not None else symbol.name.lower()
        if key not in self._homes:
            shared = self.shared(symbol)
            self._homes[key] = _new_home(symbol) if shared is None else shared
        return self._homes[key]

    def homes(self) -> Iterable[Any]:
        """The cells and lists of all variables used so far."""
        return self._homes.values()

    def value(self, symbol: DataSymbol) -> Value:
        """A copy of the current value of a variable."""
        return _value(self.home(symbol))

    def predefined(self, key: str, initial: Value) -> Value:
        """Return the value of predefined data by folded name; the initial one if unused."""
        return _value(self._homes[key]) if key in self._homes else copied(initial)

    def forget(self, module: tree.Module) -> None:
        """Drop the variables of a removed module."""
        for item in module.items:
            self._homes.pop(item, None)

    def persistents(self) -> Iterator[DataSymbol]:
        """The PERS data of all modules, in source order."""
        for symbol in module_data(self.program):
            if symbol.storage is Storage.PERS:
                yield symbol

    def remember(self) -> None:
        """Treat the current values of the persistents as those in the program text."""
        self._loaded = {symbol: self.value(symbol) for symbol in self.persistents()}

    def changed(self) -> tuple[ChangedPersistent, ...]:
        """The persistents whose values differ from those in the program text."""
        changes = []
        for symbol, old in self._loaded.items():
            new = self.value(symbol)
            if new != old and symbol.module is not None:
                module = symbol.module.name.text
                changes.append(ChangedPersistent(symbol.name, module, symbol, old, new))
        return tuple(changes)


def module_data(program: Program) -> Iterator[DataSymbol]:
    """The data that modules declare, in source order."""
    for module in program.modules:
        for item in module.items:
            if isinstance(item, tree.Data):
                symbol = program.symbol_of[item]
                assert isinstance(symbol, DataSymbol)
                yield symbol


def is_persistent(reference: object) -> bool:
    """Whether a reference is to a whole persistent.

    Raises:
        RapidError: ERR_NOTPRES for an absent one.
    """
    if isinstance(reference, PersistentBox | PersistentArray):
        return True
    if isinstance(reference, list):
        return False
    # Reading an absent reference raises, which this test must do as well.
    reference.value  # type: ignore[attr-defined]  # noqa: B018
    return False


def initial_literal(symbol: DataSymbol) -> Value | None:
    """The initial value of declared data; None if code must compute it."""
    assert symbol.node is not None
    if symbol.node.value is None:
        return initial_value(symbol.type)
    return literal(symbol.node.value, symbol.type)


def _value(home: Any) -> Value:
    return copy_array(home) if isinstance(home, list) else home.value


def _new_home(symbol: DataSymbol) -> Any:
    value: Value = symbol.value
    if symbol.node is not None:
        value = initial_literal(symbol)
        if value is None:
            value = initial_value(symbol.type)
    persistent = symbol.storage is Storage.PERS
    if isinstance(value, list):
        fresh = copied(value)
        return PersistentArray(fresh) if persistent else fresh
    return PersistentBox(value) if persistent else Box(value)
