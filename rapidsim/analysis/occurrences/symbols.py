"""Symbols of names that analysis resolves without a symbol of their own.

Modules, components, labels, predefined types and parameters of installed routines are compared by
value: each request builds them anew.
"""

from __future__ import annotations

from typing import TypeAlias

from rapidsim.analysis.installed import installed_type
from rapidsim.analysis.program import LibrarySymbol, Symbol, TypeSymbol
from rapidsim.language.types import Component, Record, Type, resolved
from rapidsim.library.table import Parameter
from rapidsim.syntax import tree
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class ModuleSymbol:
    """A module."""

    module: tree.Module

    @property
    def name(self) -> str:
        """Name as declared."""
        return self.module.name.text


@value_class(frozen=True, slots=True)
class InstalledTypeSymbol:
    """A predefined type."""

    name: str

    @property
    def type(self) -> Type:
        """The type."""
        found = installed_type(self.name.lower())
        assert found is not None
        return found


@value_class(frozen=True, slots=True)
class ComponentSymbol:
    """A component of a record, by its index."""

    record: TypeSymbol | InstalledTypeSymbol
    index: int

    @property
    def component(self) -> Component:
        """Name and type of the component."""
        of = resolved(self.record.type)
        assert isinstance(of, Record)
        return of.components[self.index]

    @property
    def name(self) -> str:
        """Name as declared."""
        return self.component.name


@value_class(frozen=True, slots=True)
class LabelSymbol:
    """A label of a routine."""

    label: tree.Label
    routine: tree.RoutineNode

    @property
    def name(self) -> str:
        """Name as declared."""
        return self.label.name.text


@value_class(frozen=True, slots=True)
class InstalledParameterSymbol:
    """A parameter of an installed routine."""

    routine: LibrarySymbol
    parameter: Parameter

    @property
    def name(self) -> str:
        """Name in RAPID."""
        return self.parameter.name


NamedSymbol: TypeAlias = (
    Symbol
    | ModuleSymbol
    | InstalledTypeSymbol
    | ComponentSymbol
    | LabelSymbol
    | InstalledParameterSymbol
)
