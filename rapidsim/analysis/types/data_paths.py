"""Data by name, element and component: `count`, `heights{2}`, `home.trans.x`."""

from __future__ import annotations

from rapidsim.analysis.context import Context, TypeOf
from rapidsim.analysis.names.name_violations import ComponentOfUnknownType, UnknownComponent
from rapidsim.analysis.names.names import (
    DataLike,
    as_data,
    data_named,
    find,
    kind_of,
    report_undefined,
    type_of_undeclared,
)
from rapidsim.analysis.parameters import ExpectedType
from rapidsim.analysis.program import CounterSymbol, DataSymbol, Storage, Symbol
from rapidsim.analysis.suggestions import closest
from rapidsim.analysis.types.assignability import is_unknown, require
from rapidsim.analysis.types.constant_folding import constant_number
from rapidsim.analysis.types.operators import value_type
from rapidsim.analysis.types.type_violations import (
    ArrayIndexOutOfBounds,
    NotAnArray,
    WriteToReadOnly,
)
from rapidsim.language import types
from rapidsim.language.types import ArrayOf, Record, Type, resolved
from rapidsim.library.predefined import SET_BY_CONTROLLER
from rapidsim.syntax import tree


def type_of_path(path: tree.DataPath, context: Context, type_of: TypeOf) -> Type | None:
    """Return the type of the data at a path; None, after a finding, if there are no data.

    Also None if the type is undeclared: its valid uses are unknown.
    """
    found = _written_type(path, context, type_of)
    return None if found is None or is_unknown(found) else found


def type_of_target(path: tree.DataPath, context: Context, type_of: TypeOf) -> Type | None:
    """Return the type of data that are assigned to; report data that cannot be."""
    root = root_of(path)
    symbol = find(root.name.key, context)
    if symbol is None:
        report_undefined(root.name, context)
        return None
    data = as_data(symbol, root, context)
    if data is None:
        return None
    if is_read_only(data):
        name = root.name.text
        violation = WriteToReadOnly(name, kind_of(data))
        context.report(violation, path, *context.declaration(data))
    return type_of_path(path, context, type_of)


def is_read_only(symbol: Symbol | None) -> bool:
    """Whether the program cannot write data: constants, counters, data set by the controller."""
    match symbol:
        case CounterSymbol() | DataSymbol(storage=Storage.CONST):
            return True
        case DataSymbol(module=None, name=name):
            return name in SET_BY_CONTROLLER
        case _:
            return False


def root_of(path: tree.DataPath) -> tree.DataReference:
    """Return the name at the root of a path."""
    while not isinstance(path, tree.DataReference):
        path = path.array if isinstance(path, tree.Index) else path.record
    return path


def type_of_data(symbol: DataLike) -> Type:
    """Return the declared type of data."""
    return types.NUM if isinstance(symbol, CounterSymbol) else symbol.type


def _written_type(path: tree.DataPath, context: Context, type_of: TypeOf) -> Type | None:
    if isinstance(path, tree.DataReference):
        symbol = data_named(path, context)
        found = type_of_undeclared(path, context) if symbol is None else type_of_data(symbol)
    elif isinstance(path, tree.Index):
        found = _element_type(path, context, type_of)
    else:
        found = _component_type(path, context, type_of)
    if found is not None:
        context.analysis.type_of[path] = found
    return found


def _element_type(path: tree.Index, context: Context, type_of: TypeOf) -> Type | None:
    array = _written_type(path.array, context, type_of)
    written = context.module.span(path.array).one_line
    wanted = ExpectedType(types.NUM, f"an index of `{written}`")
    for index in path.indices:
        require(index, wanted, context, type_of)
    if array is None:
        return None
    target = resolved(array)
    given = len(path.indices)
    if not isinstance(target, ArrayOf):
        context.report(NotAnArray(written, array.name, "no indices", given), path)
        return None
    dimensions = target.dimensions
    if len(dimensions) != given:
        count = "1 index" if len(dimensions) == 1 else f"{len(dimensions)} indices"
        context.report(NotAnArray(written, array.name, count, given), path)
        return None
    for index, size in zip(path.indices, dimensions, strict=True):
        number = None if size is None else constant_number(index, context)
        if number is not None and size is not None and not 1 <= number <= size:
            context.report(ArrayIndexOutOfBounds(f"{number:g}", written, size), index)
    return array.element if isinstance(array, ArrayOf) else target.element


def _component_type(path: tree.ComponentAccess, context: Context, type_of: TypeOf) -> Type | None:
    record = _written_type(path.record, context, type_of)
    if record is None:
        return None
    target = value_type(record)
    components = target.components if isinstance(target, Record) else ()
    for component in components:
        if component.name.lower() == path.name.key:
            return component.type
    if target.name.lower() in context.analysis.shapeless:
        written = context.module.span(path.record).one_line
        context.report(ComponentOfUnknownType(written, record.name, path.name.text), path.name)
        context.analysis.runs = False
        return None
    known = tuple(component.name for component in components)
    if known:
        described = f"`{record.name}`"
    else:
        described = f"`{context.module.span(path.record).one_line}` is {record.name}, which"
    nearest = closest(path.name.text, known)
    context.report(UnknownComponent(described, path.name.text, known, nearest), path.name)
    return None
