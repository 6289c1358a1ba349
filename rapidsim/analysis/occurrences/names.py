"""The names of a node with their symbols.

Derived on request from the tables that a check leaves, so that a check pays nothing for it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property

from rapidsim.analysis.installed import installed_type
from rapidsim.analysis.occurrences.symbols import (
    ComponentSymbol,
    InstalledParameterSymbol,
    InstalledTypeSymbol,
    LabelSymbol,
    ModuleSymbol,
    NamedSymbol,
)
from rapidsim.analysis.program import LibrarySymbol, RoutineSymbol, TypeSymbol
from rapidsim.analysis.program_parts import Facts
from rapidsim.analysis.tree_walk import clauses, statements
from rapidsim.language.types import Record, Type, resolved
from rapidsim.syntax import tree
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class Occurrence:
    """A name in a module; its symbol is None if the name is not declared or not understood."""

    module: tree.Module
    name: tree.Name
    symbol: NamedSymbol | None
    is_declaration: bool = False


class NamesOfNodes:
    """Names of nodes of one task."""

    def __init__(self, facts: Facts) -> None:
        """Take the facts of a task, which may have errors."""
        self.facts = facts
        self._symbol_of = facts.analysis.symbol_of

    def of(
        self, node: tree.Node, parents: Sequence[tree.Node], module: tree.Module
    ) -> Iterator[Occurrence]:
        """Yield the names that belong to a node itself, not to its children.

        Args:
            node: A node.
            parents: Its ancestors, from the module to the nearest.
            module: Its module.
        """
        match node:
            # The commonest come first.
            case (
                tree.DataReference(name=name) | tree.Call(name=name) | tree.FunctionCall(name=name)
            ):
                yield Occurrence(module, name, self._symbol_of.get(node))
            case tree.Module(name=name):
                yield Occurrence(module, name, ModuleSymbol(node), True)
            case tree.Data(type=of, name=name) | tree.ParameterDeclaration(type=of, name=name):
                yield self._type_name(of, module)
                yield Occurrence(module, name, self._symbol_of.get(node), True)
            case tree.Func(type=of, name=name):
                yield self._type_name(of, module)
                yield Occurrence(module, name, self._symbol_of.get(node), True)
            case tree.Proc(name=name) | tree.Trap(name=name) | tree.RecordType(name=name):
                yield Occurrence(module, name, self._symbol_of.get(node), True)
            case tree.AliasType(type=of, name=name):
                yield self._type_name(of, module)
                yield Occurrence(module, name, self._symbol_of.get(node), True)
            case tree.ComponentDeclaration(type=of, name=name):
                yield self._type_name(of, module)
                component = self._declared_component(node, parents)
                yield Occurrence(module, name, component, component is not None)
            case tree.For(counter=name):
                yield Occurrence(module, name, self._symbol_of.get(node), True)
            case tree.Label(name=name):
                yield Occurrence(module, name, _label(name, parents), True)
            case tree.Goto(name=name):
                yield Occurrence(module, name, _label(name, parents))
            case tree.Connect(trap=tree.Name() as name):
                yield Occurrence(module, name, self._symbol_of.get(node))
            case tree.ComponentAccess(record=record, name=name):
                of_record = self.facts.analysis.type_of.get(record)
                yield Occurrence(module, name, self.component(of_record, name.key))
            case tree.RequiredArgument(name=tree.Name() as name):
                yield Occurrence(module, name, self._parameter(name, parents, optional=False))
            case tree.OptionalArgument(name=name):
                yield Occurrence(module, name, self._parameter(name, parents, optional=True))
            case tree.ConditionalArgument(name=name, present=present):
                yield Occurrence(module, name, self._parameter(name, parents, optional=True))
                yield Occurrence(module, present, self._symbol_of.get(node))
            case _:
                pass

    def type_symbol(self, key: str, module: tree.Module) -> TypeSymbol | InstalledTypeSymbol | None:
        """Return the symbol of a type, by folded name, as a module sees it."""
        home = self.facts.analysis.home_of.get(module)
        scope = None if home is None else home.scope
        while scope is not None:
            found = scope.names.get(key)
            if isinstance(found, TypeSymbol):
                return found
            scope = scope.outer
        of = installed_type(key)
        return None if of is None else InstalledTypeSymbol(of.name)

    def symbol_of_type(self, of: Type) -> TypeSymbol | InstalledTypeSymbol | None:
        """Return the symbol of a type of data; None for an array or an undeclared type."""
        if isinstance(target := resolved(of), Record) and target.python in self._records:
            return self._records[target.python]
        found = installed_type(of.name.lower())
        return None if found is None else InstalledTypeSymbol(found.name)

    def component(self, of: Type | None, key: str) -> ComponentSymbol | None:
        """Return a component of a record, by folded name; None if the type has none."""
        target = None if of is None else resolved(of)
        if not isinstance(target, Record):
            return None
        record = self.symbol_of_type(target)
        for index, component in enumerate(target.components):
            if component.name.lower() == key and record is not None:
                return ComponentSymbol(record, index)
        return None

    @cached_property
    def _records(self) -> dict[type, TypeSymbol]:
        """Records of the user by the class of their values, which each has for itself."""
        found: dict[type, TypeSymbol] = {}
        for home in self.facts.analysis.home_of.values():
            for symbol in home.scope.symbols():
                if isinstance(symbol, TypeSymbol) and isinstance(symbol.node, tree.RecordType):
                    of = resolved(symbol.type)
                    assert isinstance(of, Record)
                    found[of.python] = symbol
        return found

    def _type_name(self, name: tree.Name, module: tree.Module) -> Occurrence:
        return Occurrence(module, name, self.type_symbol(name.key, module))

    def _declared_component(
        self, node: tree.ComponentDeclaration, parents: Sequence[tree.Node]
    ) -> ComponentSymbol | None:
        record = self._symbol_of.get(parents[-1])
        if not isinstance(record, TypeSymbol):
            return None
        return self.component(record.type, node.name.key)

    def _parameter(
        self, name: tree.Name, parents: Sequence[tree.Node], *, optional: bool
    ) -> NamedSymbol | None:
        """Return the parameter that an argument names."""
        match self._symbol_of.get(parents[-1]):
            case RoutineSymbol(parameters=parameters):
                for parameter in parameters:
                    if parameter.name.lower() == name.key and parameter.optional == optional:
                        return parameter
            case LibrarySymbol(routine=routine) as symbol:
                for formal in routine.signature.parameters:
                    keys = (formal.name.lower(), formal.also.lower())
                    if name.key in keys and formal.optional == optional:
                        return InstalledParameterSymbol(symbol, formal)
            case _:
                pass
        return None


def _label(name: tree.Name, parents: Sequence[tree.Node]) -> LabelSymbol | None:
    routine = next((one for one in parents if isinstance(one, tree.RoutineNode)), None)
    if routine is None:
        return None
    labels = (one for one in statements(*clauses(routine)) if isinstance(one, tree.Label))
    found = next((one for one in labels if one.name.key == name.key), None)
    return None if found is None else LabelSymbol(found, routine)


def declared_name(symbol: NamedSymbol, facts: Facts) -> tuple[tree.Module, tree.Name] | None:
    """Return the name in the declaration of a symbol, with its module; None if predefined."""
    match symbol:
        case ModuleSymbol(module=module):
            return module, module.name
        case LabelSymbol(label=label, routine=routine):
            home = _module_of(routine, facts)
            return None if home is None else (home, label.name)
        case ComponentSymbol(record=TypeSymbol(node=tree.RecordType() as record, module=module)):
            for part in record.components:
                if not isinstance(part, tree.ComponentDeclaration):
                    continue
                if part.name.key == symbol.name.lower():
                    return module, part.name
            return None
        case ComponentSymbol() | InstalledTypeSymbol() | InstalledParameterSymbol():
            return None
        case _:
            home, node = facts.analysis.module_of.get(symbol), getattr(symbol, "node", None)
            name = node.counter if isinstance(node, tree.For) else getattr(node, "name", None)
            return (home, name) if home is not None and isinstance(name, tree.Name) else None


def _module_of(routine: tree.RoutineNode, facts: Facts) -> tree.Module | None:
    for home in facts.analysis.home_of:
        if home.start <= routine.start < home.end and routine in home.items:
            return home
    return None
