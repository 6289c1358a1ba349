"""Names in generated code, and the objects that they are bound to.

One Python namespace belongs to one RAPID module; a RAPID name keeps its folded spelling there
unless it is taken. RAPID names never begin with an underscore, so internal names do. A namespace is
first described by bindings and filled for each task by `loader`.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import field
from typing import Any, TypeAlias

from rapidsim.analysis.cell_names import ConfiguredSymbol
from rapidsim.analysis.program import (
    DataSymbol,
    ParameterSymbol,
    RoutineSymbol,
    Symbol,
    UnknownSymbol,
)
from rapidsim.interpreter.runtime.arrays import INDEX_TABLES
from rapidsim.language.data import Signal
from rapidsim.language.moves import Place
from rapidsim.language.reference import Box
from rapidsim.library.table import LibraryRoutine
from rapidsim.syntax import tree
from rapidsim.values import value_class


@value_class(frozen=True, eq=False, slots=True)
class TaskIndependent:
    """An object that is the same for every task: a constant, a position, a library function."""

    value: object


Binding: TypeAlias = DataSymbol | RoutineSymbol | TaskIndependent
"""Binding of a name in a namespace: a variable, a routine, or an object."""


@value_class(slots=True)
class ModuleNames:
    """The names of one module's namespace."""

    module: tree.Module
    bindings: dict[str, Binding] = field(default_factory=dict)
    computing: set[str] = field(default_factory=set)
    """Names of installed functions that are quick and do not use the controller."""
    for_elements: dict[tuple[RoutineSymbol, frozenset[ParameterSymbol]], str] = field(
        default_factory=dict
    )
    """Function variants that take elements of arrays, by routine and their parameters."""
    runs: dict[tree.Node, tree.BulkStatements] = field(init=False)
    """Bulk moves, by the statement before each that they repeat."""
    _name_of: dict[object, str] = field(default_factory=dict)
    _counts: dict[str, int] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Find the bulk moves of the module."""
        self.runs = {run.like: run for run in self.module.runs}

    def variable(self, symbol: DataSymbol) -> str:
        """The name of module data, which holds its cell or its list."""
        return self._bound(symbol, symbol.name, symbol)

    def routine(self, symbol: RoutineSymbol) -> str:
        """The name of a user routine's function."""
        return self._bound(symbol, symbol.name, symbol)

    def routine_for_elements(
        self, symbol: RoutineSymbol, parameters: frozenset[ParameterSymbol]
    ) -> str:
        """The name of a routine's variant that takes array and position for some parameters."""
        name = f"_{self.routine(symbol)}_{len(self.for_elements) + 1}"
        return self.for_elements.setdefault((symbol, parameters), name)

    def library(self, routine: LibraryRoutine) -> str:
        """The name of an installed routine's function."""
        return self._bound(routine, routine.name, TaskIndependent(routine.body))

    def signal(self, symbol: ConfiguredSymbol | UnknownSymbol) -> str:
        """The name of a reference to an undeclared name, normally a signal."""
        key = symbol.name.lower()
        return self._bound(
            ("signal", key), key, TaskIndependent(Box(Signal(symbol.name, is_configured=True)))
        )

    def constant_data(self, symbol: DataSymbol, value: object) -> str:
        """The name of a constant with its value."""
        return self._bound(symbol, symbol.name, TaskIndependent(value))

    def constant_integers(self, symbol: DataSymbol, value: object) -> str:
        """The name of a constant all-integer array as Python integers."""
        table = TaskIndependent(_as_integers(value))
        return self._bound(("integers", symbol), f"_{symbol.name}_integers", table)

    def record_class(self, python: type[tuple[object, ...]]) -> str:
        """The name of a record's class."""
        return self._bound(python, f"_record_{python.__name__.lower()}", TaskIndependent(python))

    def index_table(self, size: int) -> str:
        """The name of the index table for arrays of one size."""
        return self._bound(("index", size), f"_at{size}", TaskIndependent(INDEX_TABLES[size]))

    def place(self, place: Place) -> str:
        """A name for the position of a statement."""
        return self.numbered("_place", place)

    def constant(self, value: object) -> str:
        """A name for an anonymous constant."""
        return self.numbered("_constant", value)

    def numbered(self, stem: str, value: object) -> str:
        """A new name for an object."""
        number = self._counts[stem] = self._counts.get(stem, 0) + 1
        name = f"{stem}{number}"
        self.bindings[name] = TaskIndependent(value)
        return name

    def _bound(self, key: object, wanted: str, binding: Binding) -> str:
        name = self._name_of.get(key)
        if name is None:
            name = free_name(wanted.lower(), self.bindings)
            self._name_of[key] = name
            self.bindings[name] = binding
        return name


@value_class(frozen=True, slots=True)
class ArrayDimension:
    """One dimension of an array parameter that is sized by the caller."""

    array: str
    """Its Python variable."""
    depth: int
    """Index of the dimension, from 0."""
    optional: bool
    """Whether the array may be absent."""


@value_class(slots=True)
class LocalNames:
    """The names of one routine's variables, which hide the module's."""

    module: ModuleNames
    routine: str
    """The routine as RAPID spells it; "" for the initial values of a module."""
    parameters: tuple[ParameterSymbol, ...] = ()
    reserved: frozenset[str] = frozenset()
    """Names of the module's namespace that the routine uses."""
    in_cell: frozenset[Symbol] = frozenset()
    """Local scalars that are passed by reference and so live in a cell."""
    elements: frozenset[ParameterSymbol] = frozenset()
    """Parameters that are passed as an array and an index in it."""
    assigned: set[str] = field(default_factory=set)
    """Plain locals that the function being written assigns."""
    tables: dict[str, ArrayDimension] = field(default_factory=dict)
    """Index tables of arrays sized by the caller, by name."""
    sizes: dict[str, ArrayDimension] = field(default_factory=dict)
    """Python variables with the sizes of such arrays, by name."""
    _name_of: dict[Symbol, str] = field(default_factory=dict)
    _used: set[str] = field(default_factory=set)

    def declare(self, symbol: Symbol, wanted: str) -> str:
        """Assign a Python name to a parameter or a local."""
        name = free_name(wanted.lower(), self._used | self.reserved)
        self._used.add(name)
        self._name_of[symbol] = name
        return name

    def get(self, symbol: Symbol) -> str | None:
        """The Python name of a local; None for anything else."""
        return self._name_of.get(symbol)

    def data_variables(self) -> set[str]:
        """The Python variables of the routine's data, and of the sizes of its arrays."""
        return {*self._name_of.values(), *self.tables, *self.sizes}

    @contextmanager
    def counter(self, symbol: Symbol, wanted: str) -> Iterator[str]:
        """Name a FOR counter for the duration of its loop."""
        name = self.declare(symbol, wanted)
        yield name
        self._used.discard(name)

    def index_table(self, array: str, depth: int, *, optional: bool) -> str:
        """The name of the index table for one dimension of an array sized by the caller."""
        name = f"_{array}_at{depth + 1}"
        self.tables[name] = ArrayDimension(array, depth, optional)
        return name

    def size(self, array: str, depth: int) -> str:
        """The name of the size of one dimension of an array that the caller always passes."""
        name = f"_{array}_size{depth + 1}"
        self.sizes[name] = ArrayDimension(array, depth, optional=False)
        return name


def _as_integers(value: Any) -> Any:
    return [_as_integers(one) for one in value] if isinstance(value, list) else int(value)


def free_name(wanted: str, used: dict[str, Binding] | frozenset[str] | set[str]) -> str:
    """The wanted name, or the first of `wanted_2`, `wanted_3` ... that is free."""
    if wanted not in used:
        return wanted
    number = 2
    while f"{wanted}_{number}" in used:
        number += 1
    return f"{wanted}_{number}"
