"""Data in generated code: reading, writing and referring to `a{i}.trans.x`.

Storage: module variables live in cells, as do locals that are passed by reference; other locals
live in plain Python variables; arrays in lists, which every reference to them shares. By-reference
parameters hold the reference that the caller passes.
"""

from __future__ import annotations

import ast
from dataclasses import replace
from enum import Enum
from types import MappingProxyType

from rapidsim.analysis.cell_names import ConfiguredSymbol
from rapidsim.analysis.literals import element_type, is_signal, literal
from rapidsim.analysis.program import (
    CounterSymbol,
    DataSymbol,
    ParameterSymbol,
    Storage,
    Symbol,
    UnknownSymbol,
)
from rapidsim.interpreter.codegen.ast_builder import AstBuilder
from rapidsim.interpreter.codegen.constant_tables import bounds_of, constant_table
from rapidsim.interpreter.codegen.expression_code import Code, DeferredCheck, finished, within
from rapidsim.interpreter.codegen.intervals import MAX_EXACT, Interval
from rapidsim.interpreter.codegen.operands import Operands
from rapidsim.interpreter.codegen.written_paths import FlatPath, flat
from rapidsim.interpreter.limits import NotExecutableError
from rapidsim.interpreter.runtime.references import position_of
from rapidsim.language.annotations import ParameterMode
from rapidsim.language.types import NUM, SIGNAL_DI, ArrayOf, Record, Type, resolved
from rapidsim.library.arithmetic import MAX_INTEGER
from rapidsim.syntax import tree
from rapidsim.values import value_class

_KEPT_BY = MappingProxyType(
    {
        "errno": ("_error_numbers", "errno"),
        "intno": ("_interrupts", "intno"),
        "c_motset": ("_motion", "settings", "c_motset"),
        "c_progdisp": ("_motion", "settings", "c_progdisp"),
    }
)
"""Predefined data of the controller: the service and the attribute path in it."""


class StorageKind(Enum):
    """Kind of storage of a whole variable."""

    PLAIN = "plain"
    """In a Python variable."""
    REFERENCE = "reference"
    """Behind a reference: `name.value`."""
    ARRAY = "array"
    """In the list that the name holds."""
    ELEMENT = "element"
    """In an array in one Python variable, at an index in another."""
    CONTROLLER = "controller"
    """In the controller: ERRNO, INTNO and the motion settings."""
    SIGNAL = "signal"
    """Behind a reference to a signal, whose value is in the controller."""


@value_class(frozen=True, slots=True)
class RootVariable:
    """Data at the root of a path."""

    home: StorageKind
    node: ast.expr
    """The Python variable, or the value itself of a constant."""
    type: Type
    name: str = ""
    optional: bool = False
    """Whether it is a parameter that may be absent and whose absence needs a check."""
    may_raise: bool = False
    declared: tree.Node | None = None
    """Declaration of a local variable or parameter."""


def by_reference(mode: ParameterMode) -> bool:
    """Whether a parameter of this mode takes a reference."""
    return mode is not ParameterMode.IN


class DataPathTranslator:
    """Translates the paths of one statement after another."""

    def __init__(self, expressions: Operands) -> None:
        """Translate with the names and the position of `expressions`."""
        self._expressions = expressions
        self._names = expressions.names
        self._program = expressions.program

    def symbol(self, path: tree.DataPath) -> Symbol:
        """The symbol a path begins with."""
        return self._program.symbol_of[flat(path).reference]

    def type_of(self, path: tree.DataPath) -> Type:
        """The declared type of the data at a path."""
        parts = flat(path)
        symbol = self._program.symbol_of[parts.reference]
        if isinstance(symbol, UnknownSymbol):
            # A signal of the kind that the checker inferred.
            return self._program.type_of.get(parts.reference, SIGNAL_DI)
        of = _symbol_type(symbol)
        for _ in parts.indices:
            of = _element(of)
        for name in parts.names:
            _, of = _component(of, name)
        return of

    def read(self, path: tree.DataPath) -> Code:
        """The value at a path; for an array the list itself, not a copy."""
        at = self._expressions.at(path)
        parts = flat(path)
        whole = self._whole(parts.reference)
        if not parts.indices and not parts.names:
            return self._read_whole(whole, parts.reference, at)
        constant = self._table_of_integers(parts)
        if constant is not None:
            name, integer = constant
            code = self._element(replace(whole, node=at.name(name)), parts, at)
            return Code(code.node, may_raise=code.may_raise, calls=code.calls, integer=integer)
        code = self._element(whole, parts, at)
        node, of = code.node, whole.type
        for _ in parts.indices:
            of = _element(of)
        for name in parts.names:
            position, of = _component(of, name)
            node = at.item(node, at.constant(position))
        return Code(node, may_raise=code.may_raise, calls=code.calls)

    def _table_of_integers(self, parts: FlatPath) -> tuple[str, Interval] | None:
        """Name and bounds of an array that is a CONST with integer elements only."""
        symbol = self._program.symbol_of[parts.reference]
        if parts.names or not isinstance(symbol, DataSymbol):
            return None
        value = constant_table(symbol, len(parts.indices), self._expressions.constant_value)
        integer = None if value is None else bounds_of(value)
        if integer is None:
            return None
        return self._names.module.constant_integers(symbol, value), integer

    def write(self, path: tree.DataPath, value: Code, at: AstBuilder) -> list[ast.stmt]:
        """Statements that put a value at a path; the value is evaluated first."""
        parts = flat(path)
        whole = self._whole(parts.reference)
        if not parts.names:
            return self._write_element(whole, parts, value.node, at)
        before: list[ast.stmt] = []
        node = value.node
        if value.calls:
            # The call may change the same record, so it precedes the reads of the other components.
            before.append(at.set("_value", node))
            node = at.name("_value")
        if not parts.indices:
            record = self._value(whole, at)
            of = whole.type
            if whole.home is StorageKind.PLAIN:
                new = self._with_component(of, parts.names, whole.node, node, at)
                return [*before, *self._store_whole(whole, new, at)]
            before.append(at.set("_record", record))
            new = self._with_component(of, parts.names, at.name("_record"), node, at)
            return [*before, *self._store_whole(whole, new, at)]
        array, index, _ = self._array_and_index(whole, parts, at)
        of = whole.type
        for _ in parts.indices:
            of = _element(of)
        new = self._with_component(of, parts.names, at.name("_record"), node, at)
        return [
            *before,
            at.set("_array", array),
            at.set("_index", index),
            at.set("_record", at.item("_array", at.name("_index"))),
            at.assign(at.store_item("_array", at.name("_index")), new),
        ]

    def size(self, path: tree.DataPath, dimension: int) -> Code | None:
        """Return the size of one dimension if it is declared or in a variable; None otherwise.

        Args:
            path: The path to the array.
            dimension: The dimension, from 1.
        """
        of = resolved(self.type_of(path))
        if not isinstance(of, ArrayOf) or not 1 <= dimension <= len(of.dimensions):
            return None
        at = self._expressions.at(path)
        size = of.dimensions[dimension - 1]
        if size is not None:
            return number(float(size), at)
        whole = self._whole(flat(path).reference)
        if whole.optional or flat(path).indices:
            return None
        name = self._names.size(whole.name, dimension - 1)
        return Code(at.name(name), integer=Interval(1, MAX_INTEGER, name))

    def may_raise(self, path: tree.DataPath) -> bool:
        """Whether evaluating a path may raise."""
        parts = flat(path)
        whole = self._whole(parts.reference)
        if whole.may_raise or whole.optional:
            return True
        return (
            bool(parts.indices)
            and self._element(whole, parts, self._expressions.at(path)).may_raise
        )

    def reference(self, path: tree.DataPath) -> Code:
        """A reference to the data at a path: an object with a `value`, or the list of an array."""
        at = self._expressions.at(path)
        parts = flat(path)
        whole = self._whole(parts.reference)
        if not parts.indices:
            if whole.home in (StorageKind.REFERENCE, StorageKind.SIGNAL, StorageKind.ARRAY):
                node = whole.node
            elif whole.home is StorageKind.ELEMENT:
                node = at.call("_Element", [whole.node, at.name(position_of(whole.name))])
            else:
                # Installed routines also read constants and counters through references.
                value = finished(self._read_whole(whole, parts.reference, at), at)
                node = at.call("_Box", [value.node])
            may_raise = calls = False
        else:
            array, index, code = self._array_and_index(whole, parts, at)
            if len(parts.indices) < _dimensions(whole.type):
                node = at.item(array, index)
            else:
                node = at.call("_Element", [array, index])
            may_raise, calls = code.may_raise, code.calls
        if parts.names:
            of = whole.type
            for _ in parts.indices:
                of = _element(of)
            positions: list[ast.expr] = []
            for name in parts.names:
                position, of = _component(of, name)
                positions.append(at.constant(position))
            node = at.call("_Component", [node, at.tuple_of(positions)])
        return Code(node, may_raise=may_raise, calls=calls)

    def element(self, path: tree.DataPath) -> tuple[ast.expr, ast.expr] | None:
        """The array and index expression of a path to a whole element; None for other paths."""
        parts = flat(path)
        if not parts.indices or parts.names:
            return None
        whole = self._whole(parts.reference)
        if len(parts.indices) < _dimensions(whole.type):
            return None
        array, index, _ = self._array_and_index(whole, parts, self._expressions.at(path))
        return array, index

    def _whole(self, reference: tree.DataReference) -> RootVariable:
        at = self._expressions.at(reference)
        symbol = self._program.symbol_of[reference]
        name = self._names.get(symbol)
        match symbol:
            case DataSymbol(storage=Storage.CONST, type=of):
                return RootVariable(
                    StorageKind.PLAIN, self._expressions.constant_data(symbol, at), of
                )
            case DataSymbol(type=of) if symbol.node is None and symbol.name.lower() in _KEPT_BY:
                concern, *way = _KEPT_BY[symbol.name.lower()]
                node: ast.expr = at.name(concern)
                for name_of_part in way:
                    node = at.attribute(node, name_of_part)
                return RootVariable(StorageKind.CONTROLLER, node, of)
            case DataSymbol(type=of):
                in_reference = name is None or symbol in self._names.in_cell
                home = _home(of, in_reference)
                spelled = name or self._names.module.variable(symbol)
                return RootVariable(home, at.name(spelled), of, spelled, declared=symbol.node)
            case ParameterSymbol(type=of, mode=mode, optional=optional):
                assert name is not None
                in_reference = by_reference(mode) or symbol in self._names.in_cell
                home = _home(of, in_reference)
                # Absent references raise on use; other absent values need a check.
                if symbol in self._names.elements:
                    home = StorageKind.ELEMENT
                asks = (
                    optional
                    and home in (StorageKind.PLAIN, StorageKind.ARRAY)
                    and not symbol.is_switch
                )
                declared = symbol.node
                return RootVariable(home, at.name(name), of, name, asks, optional, declared)
            case CounterSymbol():
                assert name is not None
                return RootVariable(StorageKind.PLAIN, at.name(name), NUM, name)
            case ConfiguredSymbol() | UnknownSymbol():
                signal = at.name(self._names.module.signal(symbol))
                return RootVariable(StorageKind.SIGNAL, signal, SIGNAL_DI)
            case _:
                span = self._expressions.span(reference)
                raise NotExecutableError(f"`{reference.name.text}` used as data", span)

    def _read_whole(
        self, variable: RootVariable, reference: tree.DataReference, at: AstBuilder
    ) -> Code:
        integer = self._expressions.counters.get(variable.name)
        if integer is None and variable.declared is not None:
            integers = self._expressions.integers
            integer = integers.get(reference) or integers.get(variable.declared)
        if integer is not None:
            return Code(variable.node, integer=integer)
        node = self._value(variable, at)
        if variable.optional:
            present = at.compare(variable.node, (ast.IsNot(), at.name("_ABSENT")))
            node = at.choice(
                present, node, at.call("_not_present", [at.constant(reference.name.text)])
            )
        literal = node.value if isinstance(node, ast.Constant) else None
        if isinstance(literal, float) and not isinstance(literal, bool):
            return number(literal, at)
        return Code(node, may_raise=variable.may_raise)

    def _value(self, variable: RootVariable, at: AstBuilder) -> ast.expr:
        match variable.home:
            case StorageKind.REFERENCE:
                return at.attribute(variable.node, "value")
            case StorageKind.SIGNAL:
                name = at.attribute(at.attribute(variable.node, "value"), "name")
                return at.call(at.attribute("_signals", "read_signal"), [name])
            case StorageKind.ELEMENT:
                return at.item(variable.node, at.name(position_of(variable.name)))
            case _:
                return variable.node

    def _store_whole(
        self, variable: RootVariable, value: ast.expr, at: AstBuilder
    ) -> list[ast.stmt]:
        match variable.home:
            case StorageKind.PLAIN:
                self._names.assigned.add(variable.name)
                return [at.set(variable.name, value)]
            case StorageKind.ARRAY:
                return [at.do(at.call("_assign_array", [variable.node, value]))]
            case StorageKind.ELEMENT:
                place = at.store_item(variable.node, at.name(position_of(variable.name)))
                return [at.assign(place, value)]
            case _:
                return [at.assign(at.store_attribute(variable.node, "value"), value)]

    def _write_element(
        self, variable: RootVariable, parts: FlatPath, value: ast.expr, at: AstBuilder
    ) -> list[ast.stmt]:
        if not parts.indices:
            return self._store_whole(variable, value, at)
        array, index, _ = self._array_and_index(variable, parts, at)
        if len(parts.indices) < _dimensions(variable.type):
            return [at.do(at.call("_assign_array", [at.item(array, index), value]))]
        return [at.assign(at.store_item(array, index), value)]

    def _element(self, variable: RootVariable, parts: FlatPath, at: AstBuilder) -> Code:
        """The indexed element, or the whole variable without indices."""
        if not parts.indices:
            return Code(self._value(variable, at), may_raise=variable.may_raise)
        array, index, code = self._array_and_index(variable, parts, at)
        return Code(at.item(array, index), may_raise=code.may_raise, calls=code.calls)

    def _array_and_index(
        self, variable: RootVariable, parts: FlatPath, at: AstBuilder
    ) -> tuple[ast.expr, ast.expr, Code]:
        """The innermost list, the index in it, and the effects of evaluating both."""
        node = variable.node
        of = resolved(variable.type)
        assert isinstance(of, ArrayOf)
        may_raise, calls = variable.may_raise, False
        index = Code(node)
        for depth, expression in enumerate(parts.indices):
            if depth:
                node = at.item(node, index.node)
            index = self._index(variable, of.dimensions[depth], depth, expression)
            may_raise |= index.may_raise
            calls |= index.calls
        return node, index.node, Code(node, may_raise=may_raise, calls=calls)

    def _index(
        self, whole: RootVariable, size: int | None, depth: int, expression: tree.Expression
    ) -> Code:
        """One index as a Python position, its bounds and integrality checked."""
        at = self._expressions.at(expression)
        code = self._expressions.code(expression)
        literal = code.literal if code.integer is not None else None
        if size is not None and literal is not None and 1 <= literal <= size:
            return Code(at.constant(int(literal) - 1))
        if code.stays_integer and code.integer is not None and (size or not whole.optional):
            variable = "" if size else self._names.size(whole.name, depth)
            return self._integer_index(code, code.integer, size or variable, at)
        if size is None:
            table = self._names.index_table(whole.name, depth, optional=whole.optional)
        else:
            table = self._names.module.index_table(size)
        # The index table rounds numbers that are not integers.
        value = (
            code
            if code.deferred in (DeferredCheck.SINGLE, DeferredCheck.CHECKED_SINGLE)
            else finished(code, at)
        )
        return Code(at.item(table, value.node), may_raise=True, calls=code.calls)

    def _integer_index(
        self, code: Code, integer: Interval, size: int | str, at: AstBuilder
    ) -> Code:
        """Return the index expression of a known integer, with the checks it still needs.

        Args:
            code: The index as a Python integer.
            integer: Its interval.
            size: Size of the array; a string names the Python variable with the size.
            at: The position of the index.
        """
        fits = integer.high <= size if isinstance(size, int) else integer.size == size
        if integer.low >= 1 and fits:
            position = at.operation(code.node, ast.Sub(), at.constant(1))
            return Code(position, may_raise=integer.signed, calls=code.calls)
        limit = at.constant(size) if isinstance(size, int) else at.name(size)
        name = code.node if isinstance(code.node, ast.Name) else at.name("_i")
        first = name if name is code.node else at.named("_i", code.node)
        bounds = within(first, None if integer.low >= 1 else 1, limit, at)
        position = at.operation(name, ast.Sub(), at.constant(1))
        refused = at.call("_out_of_bounds", [name, limit])
        return Code(at.choice(bounds, position, refused), may_raise=True, calls=code.calls)

    def _with_component(
        self, of: Type, names: tuple[str, ...], record: ast.expr, value: ast.expr, at: AstBuilder
    ) -> ast.expr:
        """Build a copy of `record` with one component replaced; `record` is cheap to evaluate."""
        target = resolved(of)
        assert isinstance(target, Record)
        replaced, inner = _component(of, names[0])
        if len(names) > 1:
            old = at.item(record, at.constant(replaced))
            value = self._with_component(inner, names[1:], old, value, at)
        parts = [
            value if position == replaced else at.item(record, at.constant(position))
            for position in range(len(target.components))
        ]
        python = at.name(self._names.module.record_class(target.python))
        return at.call("_new", [python, at.tuple_of(parts)])


def number(value: float, at: AstBuilder) -> Code:
    """A number as a constant that records whether it is an integer."""
    # A negative zero is no integer.
    whole = value.is_integer() and abs(value) < MAX_EXACT and str(value) != "-0.0"
    integer = Interval(int(value), int(value)) if whole else None
    return Code(at.constant(value), integer=integer, literal=value)


def whole_number(expression: tree.Expression | None) -> int | None:
    """Return the value of an integer literal that a single holds exactly; None otherwise."""
    value = literal(expression, NUM) if expression is not None else None
    if isinstance(value, float) and value.is_integer() and abs(value) <= MAX_INTEGER:
        return int(value)
    return None


def _home(of: Type, in_reference: bool) -> StorageKind:
    if isinstance(resolved(of), ArrayOf):
        return StorageKind.ARRAY
    if is_signal(of):
        return StorageKind.SIGNAL
    return StorageKind.REFERENCE if in_reference else StorageKind.PLAIN


def _symbol_type(symbol: Symbol) -> Type:
    match symbol:
        case DataSymbol(type=of) | ParameterSymbol(type=of) | ConfiguredSymbol(type=of):
            return of
        case _:
            return NUM


def _element(of: Type) -> Type:
    target = resolved(of)
    assert isinstance(target, ArrayOf)
    return element_type(target)


def _dimensions(of: Type) -> int:
    target = resolved(of)
    return len(target.dimensions) if isinstance(target, ArrayOf) else 0


def _component(of: Type, name: str) -> tuple[int, Type]:
    """Position and type of a component, by folded name."""
    target = resolved(of)
    assert isinstance(target, Record)
    for position, component in enumerate(target.components):
        if component.name.lower() == name:
            return position, component.type
    raise KeyError(name)
