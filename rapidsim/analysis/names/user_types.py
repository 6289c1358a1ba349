"""RECORD and ALIAS declarations, and the resolution of type names in a module.

An undeclared type that no controller without options has is not an error: its data are
kept as written. The first initial value determines the number of values it has.
"""

from __future__ import annotations

import keyword
from collections.abc import Mapping, Sequence
from itertools import chain

from rapidsim.analysis.context import Context
from rapidsim.analysis.installed import installed_type, installed_type_names
from rapidsim.analysis.names.declaration_violations import BadAlias, CircularDefinition
from rapidsim.analysis.names.name_violations import DuplicateName, UnknownType, UnseenName
from rapidsim.analysis.program import TypeSymbol
from rapidsim.analysis.tree_walk import data_of
from rapidsim.diagnostics import Related
from rapidsim.language import types
from rapidsim.language.record_values import new_record_class
from rapidsim.language.types import Alias, ArrayOf, Atomic, Component, Kind, Record, Type
from rapidsim.library.predefined import OF_OPTIONS
from rapidsim.syntax import tree

TypeNode = tree.RecordType | tree.AliasType


class UserTypes:
    """The types of a task, built on demand because records refer to each other."""

    def __init__(
        self, nodes: Mapping[tuple[tree.Module | None, str], TypeNode], homes: Sequence[Context]
    ) -> None:
        """Take the type declarations of a task.

        Args:
            nodes: Declarations by module and folded name; the module is None for global types.
            homes: A context for each module.
        """
        self._nodes = nodes
        self._homes = {context.module: context for context in homes}
        self._home_of = {
            node: context
            for context in homes
            for node in context.module.items
            if isinstance(node, TypeNode)
        }
        self._built: dict[TypeNode, Type] = {}
        self._building: list[TypeNode] = []
        self._unknown: dict[str, Type] = {}
        self._first_values = _first_values(homes)

    def declare(self) -> list[tuple[TypeSymbol, Context]]:
        """Build every type of the task, in order of declaration."""
        declared = []
        for node in self._nodes.values():
            home = self._home_of[node]
            symbol = TypeSymbol(node.name.text, self._type_of(node), node, home.module)
            declared.append((symbol, home))
        return declared

    def named(self, name: tree.Name, context: Context) -> Type:
        """Return the type that a name refers to in a module."""
        node = self._nodes.get((context.module, name.key)) or self._nodes.get((None, name.key))
        if node is not None:
            return self._type_of(node)
        return installed_type(name.key) or self._unknown_type(name, context)

    def resolves(self, key: str, module: tree.Module) -> bool:
        """Whether a folded name refers to a declared or a predefined type in a module."""
        is_declared = (module, key) in self._nodes or (None, key) in self._nodes
        return is_declared or installed_type(key) is not None

    def _type_of(self, node: TypeNode) -> Type:
        built = self._built.get(node)
        if built is not None:
            return built
        context = self._home_of[node]
        if node in self._building:
            circle = [*self._building[self._building.index(node) :], node]
            names = " -> ".join(part.name.text for part in circle)
            kind = "record" if isinstance(node, tree.RecordType) else "alias"
            context.report(CircularDefinition(node.name.text, names, kind), node.name)
            return Atomic(node.name.text)
        self._building.append(node)
        if isinstance(node, tree.RecordType):
            built = self._record(node, context)
        else:
            built = self._alias(node, context)
        self._building.pop()
        self._built[node] = built
        return built

    def _record(self, node: tree.RecordType, context: Context) -> Record:
        components: dict[str, Component] = {}
        places: dict[str, tree.Name] = {}
        for field in node.components:
            if isinstance(field, tree.Placeholder):
                continue
            key = field.name.key
            if key in components:
                first = Related(context.module.span(places[key]), "the first one is here")
                where = f" in `{node.name.text}`"
                violation = DuplicateName(field.name.text, where, kind="component")
                context.report(violation, field.name, first)
                continue
            of = self.named(field.type, context)
            components[key] = Component(field.name.text, of)
            places[key] = field.name
        return _record(node.name.text, list(components.values()))

    def _alias(self, node: tree.AliasType, context: Context) -> Type:
        of = self.named(node.type, context)
        if isinstance(of, Alias):
            kind = f"an alias of `{of.of.name}`"
            context.report(BadAlias(node.name.text, node.type.text, kind), node.type)
            of = of.of
        assert not isinstance(of, ArrayOf)
        return Alias(node.name.text, of)

    def _unknown_type(self, name: tree.Name, context: Context) -> Type:
        analysis = context.analysis
        if name.key not in OF_OPTIONS and not analysis.may_be_unread(name.key):
            self._report_unknown(name, context)
        analysis.shapeless.add(name.key)
        shape = self._unknown.get(name.key)
        if shape is None:
            value, dimensions = self._first_values.get(name.key, (None, 0))
            shape = _shape(name.text, value, dimensions)
            self._unknown[name.key] = shape
        return shape

    def _report_unknown(self, name: tree.Name, context: Context) -> None:
        own = (
            node.name.text
            for (module, _), node in self._nodes.items()
            if module in (None, context.module)
        )
        known = chain(own, installed_type_names())
        nearest = context.analysis.find_nearest(name, (context.module, UnknownType), known)
        cell = context.analysis.cell
        if cell.unseen:
            context.report(UnseenName(name.text, cell.unseen, nearest, "data type"), name)
            return
        allowed = cell.assumes or cell.refers_late
        fix = context.respelling(name, nearest)
        context.report(UnknownType(name.text, nearest, allowed), name, fix=fix)


def _first_values(homes: Sequence[Context]) -> dict[str, tuple[tree.LiteralValue | None, int]]:
    """Return, by type name, the first initial value of such data, and their dimensions."""
    found: dict[str, tuple[tree.LiteralValue | None, int]] = {}
    for context in homes:
        for node in data_of(context.module):
            value = None if node.value is None else literal_value(node.value)
            if value is not None:
                found.setdefault(node.type.key, (value, len(node.dimensions)))
    return found


def literal_value(expression: tree.Expression) -> tree.LiteralValue | None:
    """Return the value of a literal expression; None for any other."""
    match expression:
        case (
            tree.NumberLiteral(value=value)
            | tree.StringLiteral(value=value)
            | tree.BoolLiteral(value=value)
        ):
            return value
        case tree.LiteralAggregate(value=values):
            return values
        case tree.Unary(operator="-" | "+" as sign, operand=tree.NumberLiteral(value=number)):
            return -number if sign == "-" else number
        case tree.Aggregate(elements=elements):
            parts = [literal_value(element) for element in elements]
            known = tuple(part for part in parts if part is not None)
            return known if len(known) == len(parts) else None
        case _:
            return None


def _shape(name: str, value: tree.LiteralValue | None, dimensions: int) -> Type:
    """Build a type for data of which only a value is known."""
    for _ in range(dimensions):
        value = value[0] if isinstance(value, tuple) and value else None
    match value:
        case None:
            return Atomic(name, Kind.UNKNOWN)
        case bool():
            return Alias(name, types.BOOL)
        case str():
            return Alias(name, types.STRING)
        case tuple():
            parts = [
                Component(f"component {k}", _shape(f"component {k} of {name}", part, 0))
                for k, part in enumerate(value, 1)
            ]
            return _record(name, parts)
        case _:
            return Alias(name, types.NUM)


def _record(name: str, components: Sequence[Component]) -> Record:
    """Create a record type with its own class for its values."""
    spelled = name if name.isidentifier() and not keyword.iskeyword(name) else "record"
    python = new_record_class(spelled, [part.name.lower() for part in components])
    return Record(name, tuple(components), python)
