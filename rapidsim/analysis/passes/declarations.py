"""The declarations of a task: types, data and routines of all its modules, with their symbols.

Types come first, then scalar data, then arrays, because an array size may be a constant; parameters
of routines need only types. Local data are declared when the routine is checked, see
`declare_locals`.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import TypeAlias

from rapidsim.analysis.context import Analysis, Context, SymbolTable
from rapidsim.analysis.names.declaration_violations import BadArraySize, BadParameterType
from rapidsim.analysis.names.name_violations import DuplicateName, MisplacedScope
from rapidsim.analysis.names.names import find, report_undefined
from rapidsim.analysis.names.user_types import TypeNode, UserTypes
from rapidsim.analysis.program import (
    DataSymbol,
    ParameterSymbol,
    RoutineSymbol,
    Scope,
    Storage,
    Symbol,
)
from rapidsim.analysis.syntax_violations import UnfinishedDeclaration
from rapidsim.analysis.tree_walk import children, descendants
from rapidsim.analysis.types.constant_folding import constant_number
from rapidsim.analysis.types.operators import has_value
from rapidsim.diagnostics import Related
from rapidsim.language import types
from rapidsim.language.annotations import ParameterMode
from rapidsim.language.types import ArrayOf, Type
from rapidsim.syntax import tree

MAX_DIMENSIONS = 3
MAX_SIZE = 2**31 - 1
Declaration = tree.RecordType | tree.AliasType | tree.Data | tree.Proc | tree.Func | tree.Trap
Accepted: TypeAlias = list[tuple[Context, Declaration]]


def declare_task(
    modules: Sequence[tree.Module], analysis: Analysis
) -> tuple[list[Context], UserTypes]:
    """Declare everything outside routines.

    Returns:
        A context for each module, and the types by name.
    """
    homes = open_homes(modules, analysis)
    return homes, declare_accepted(without_duplicates(homes), homes)


def open_homes(modules: Sequence[tree.Module], analysis: Analysis) -> list[Context]:
    """Create a context for each module, whose scopes are empty."""
    shared = SymbolTable({})
    homes = [Context(analysis, module, SymbolTable({}, shared)) for module in modules]
    for home in homes:
        analysis.home_of[home.module] = home
    return homes


def declare_accepted(accepted: Accepted, homes: Sequence[Context]) -> UserTypes:
    """Declare what has no other declaration of its name before it."""
    user_types = UserTypes(
        {
            (home.module if node.scope == "LOCAL" else None, node.name.key): node
            for home, node in accepted
            if isinstance(node, TypeNode)
        },
        homes,
    )
    for symbol, home in user_types.declare():
        _enter(symbol, symbol.node.scope == "LOCAL", home)
    _declare_items(accepted, user_types, {})
    return user_types


def redeclare(accepted: Accepted, homes: Sequence[Context], user_types: UserTypes) -> set[str]:
    """Declare new data and routines; what has a symbol keeps it.

    Returns:
        The folded names that have another symbol than before in some scope.
    """
    tables = [home.scope for home in homes]
    tables += [table.outer for table in tables[:1] if table.outer is not None]
    before = [dict(table.names) for table in tables]
    for table in tables:
        table.names.clear()
    symbol_of = homes[0].analysis.symbol_of
    symbols = {node: symbol_of[node] for _, node in accepted if node in symbol_of}
    for home, node in accepted:
        if isinstance(node, TypeNode):
            _enter(symbols[node], node.scope == "LOCAL", home)
    _declare_items(accepted, user_types, symbols)
    return {
        key
        for names, table in zip(before, tables, strict=True)
        for key in names.keys() | table.names.keys()
        if names.get(key) is not table.names.get(key)
    }


def _declare_items(
    accepted: Accepted, user_types: UserTypes, symbols: Mapping[Declaration, Symbol]
) -> None:
    """Declare data, then routines, unless they have symbols."""
    data = [(home, node) for home, node in accepted if isinstance(node, tree.Data)]
    for arrays in (False, True):
        for home, node in data:
            if bool(node.dimensions) == arrays:
                symbol = symbols.get(node) or declare_data(node, home, user_types)
                _enter(symbol, node.scope == "LOCAL", home)
    for home, routine in accepted:
        if isinstance(routine, tree.Proc | tree.Func | tree.Trap):
            declared = symbols.get(routine) or _declare_routine(routine, home, user_types)
            _enter(declared, routine.scope == "LOCAL", home)


def show_local_names(visitors: Sequence[tree.Module], homes: Sequence[Context]) -> None:
    """Make LOCAL names visible to all modules, if only one module declares the name.

    A module's own names and the global ones take precedence.
    """
    by_name: dict[str, list[Symbol]] = {}
    for home in homes:
        if home.module not in visitors:
            for key, symbol in home.scope.names.items():
                by_name.setdefault(key, []).append(symbol)
    for home in homes:
        if home.module in visitors:
            for key, symbols in by_name.items():
                if len(symbols) == 1 and home.scope.find(key) is None:
                    home.scope.names[key] = symbols[0]


def declare_data(
    node: tree.Data, context: Context, user_types: UserTypes, *, local: bool = False
) -> DataSymbol:
    """Create the symbol of a data declaration."""
    of = user_types.named(node.type, context)
    sizes = tuple(_size(dimension, node, context) for dimension in node.dimensions)
    if len(sizes) > MAX_DIMENSIONS:
        problem = f"`{node.name.text}` has {len(sizes)} dimensions; an array has at most 3"
        context.report(BadArraySize(problem, "dimensions"), node.name)
    if of in (types.SWITCH, types.ANYTYPE):
        why = "it is a type of parameters only"
        context.report(BadParameterType(node.name.text, of.name, why), node.type)
    if local:
        scope = Scope.ROUTINE
        for word in (node.scope, node.storage if node.storage == "PERS" else None):
            if word is not None:
                context.report(MisplacedScope(word, node.name.text, node.storage), node)
    else:
        scope = {"LOCAL": Scope.LOCAL, "TASK": Scope.TASK}.get(node.scope or "", Scope.GLOBAL)
    complete = _array(of, sizes) if sizes else of
    symbol = DataSymbol(
        node.name.text, complete, Storage(node.storage), scope, context.module, node
    )
    _remember(symbol, node, context)
    return symbol


def declare_locals(routine: RoutineSymbol, home: Context, user_types: UserTypes) -> Context:
    """Create the scope inside a routine, with its parameters and data."""
    context = replace(home, scope=SymbolTable({}, home.scope), routine=routine)
    names = context.scope.names
    for parameter in routine.parameters:
        first = names.setdefault(parameter.name.lower(), parameter)
        if first is not parameter:
            _report_duplicate(parameter.node.name, first, context, "parameter")
    nodes = home.analysis.nodes_of(routine.node)
    for part in nodes.all(tree.Data):
        symbol = declare_data(part, context, user_types, local=True)
        first_symbol = names.setdefault(part.name.key, symbol)
        if first_symbol is not symbol:
            _report_duplicate(part.name, first_symbol, context, f"local {_kind(part)}")
    for label in nodes.all(tree.Label):
        if label.name.key in names:
            _report_duplicate(label.name, names[label.name.key], context, "label")
    return context


def without_duplicates(homes: Sequence[Context]) -> Accepted:
    """Return the declarations of a task in order, without duplicate names."""
    accepted: Accepted = []
    modules: dict[str, Context] = {}
    shared: dict[str, tuple[Context, Declaration]] = {}
    for home in homes:
        first_home = modules.setdefault(home.module.name.key, home)
        # Unreadable module names are reported elsewhere and are all empty.
        if first_home is not home and home.module.name.key:
            place = first_home.module.span(first_home.module.name)
            violation = DuplicateName(home.module.name.text, " as a module", kind="module")
            home.report(violation, home.module.name, Related(place, "the first one is here"))
        own: dict[str, Declaration] = {}
        for node in home.module.items:
            if not isinstance(node, Declaration):
                continue
            name = node.name
            if isinstance(node, tree.Routine) and name.key == home.module.name.key:
                place = home.module.span(home.module.name)
                where = ", as the module and as a routine in it"
                kind = "global routine"
                violation = DuplicateName(name.text, where, kind=kind, of_own_module=True)
                home.report(violation, name, Related(place, "the module is here"))
            if name.text.startswith("<"):
                home.report(UnfinishedDeclaration(name.text), name)
                continue
            here = own.setdefault(name.key, node)
            if here is not node:
                _report_redeclaration(node, here, home, home)
                continue
            if node.scope != "LOCAL":
                other, there = shared.setdefault(name.key, (home, node))
                if there is not node:
                    # In two copies of a module all names are equal; only the module is reported.
                    if other.module.name.key != home.module.name.key:
                        _report_redeclaration(node, there, other, home)
                    continue
            accepted.append((home, node))
    return accepted


def _report_redeclaration(
    node: Declaration, first: Declaration, first_home: Context, home: Context
) -> None:
    between = first_home is not home
    where = f", in `{first_home.module.name.text}` and in `{home.module.name.text}`"
    kind = f"{'local' if node.scope == 'LOCAL' else 'global'} {_kind(node)}"
    violation = DuplicateName(node.name.text, where if between else "", between, kind)
    place = first_home.module.span(first.name)
    home.report(violation, node.name, Related(place, "the first one is here"))


def _kind(node: Declaration) -> str:
    match node:
        case tree.Data(storage=storage):
            return {"CONST": "constant", "PERS": "persistent"}.get(storage, "variable")
        case tree.RecordType():
            return "record"
        case tree.AliasType():
            return "alias"
        case _:
            return "routine"


def _report_duplicate(name: tree.Name, first: Symbol, context: Context, kind: str) -> None:
    routine = context.routine
    where = f" in `{routine.name}`" if routine else ""
    violation = DuplicateName(name.text, where, kind=kind)
    context.report(violation, name, *context.declaration(first))


def _enter(symbol: Symbol, is_local: bool, home: Context) -> None:
    scope = home.scope if is_local else home.scope.outer
    assert scope is not None
    scope.names[symbol.name.lower()] = symbol
    node = getattr(symbol, "node", None)
    assert isinstance(node, tree.Node)
    _remember(symbol, node, home)


def _remember(symbol: Symbol, node: tree.Node, context: Context) -> None:
    context.analysis.symbol_of[node] = symbol
    context.analysis.module_of[symbol] = context.module


def _declare_routine(node: tree.Routine, context: Context, user_types: UserTypes) -> RoutineSymbol:
    parameters = []
    group = 0
    for part in node.parameters:
        if isinstance(part, tree.Placeholder):
            continue
        group += 1
        optional = isinstance(part, tree.OptionalGroup)
        # If an alternative is not filled in, a placeholder is among them.
        alternatives = children(part) if optional else (part,)
        parameters += [
            _declare_parameter(parameter, optional, group, context, user_types)
            for parameter in alternatives
            if isinstance(parameter, tree.ParameterDeclaration)
        ]
    result = user_types.named(node.type, context) if isinstance(node, tree.Func) else None
    if isinstance(node, tree.Func) and result is not None and not has_value(result):
        why = "a function returns a value, and this type has none"
        context.report(BadParameterType(node.name.text, result.name, why), node.type)
    scope = Scope.LOCAL if node.scope == "LOCAL" else Scope.GLOBAL
    return RoutineSymbol(node.name.text, node, context.module, scope, tuple(parameters), result)


def _declare_parameter(
    node: tree.ParameterDeclaration,
    optional: bool,
    group: int,
    context: Context,
    user_types: UserTypes,
) -> ParameterSymbol:
    of = user_types.named(node.type, context)
    mode = ParameterMode(node.mode)
    why = _type_problem(of, node, optional)
    if why:
        context.report(BadParameterType(node.name.text, of.name, why), node.type)
    if node.dimensions > MAX_DIMENSIONS:
        problem = f"`{node.name.text}` has {node.dimensions} dimensions; an array has at most 3"
        context.report(BadArraySize(problem, "dimensions"), node.name)
    complete = _array(of, (None,) * node.dimensions) if node.dimensions else of
    symbol = ParameterSymbol(
        node.name.text, complete, mode, optional, of == types.SWITCH, node, group
    )
    _remember(symbol, node, context)
    return symbol


def _type_problem(of: Type, node: tree.ParameterDeclaration, optional: bool) -> str:
    """Reason why a parameter cannot have a type; empty if it can."""
    if of == types.ANYTYPE:
        return "only installed routines have such parameters"
    if of == types.SWITCH:
        if not optional:
            return "only optional parameters are switches"
        if node.mode != "IN" or node.dimensions:
            return "a switch is passed by value and has no dimensions"
    elif node.mode == "IN" and not has_value(of):
        return "it has no value; pass it as VAR"
    return ""


def _array(element: Type, sizes: Iterable[int | None]) -> ArrayOf:
    assert not isinstance(element, ArrayOf)
    return ArrayOf(element, tuple(sizes))


def _size(dimension: tree.Expression, node: tree.Data, context: Context) -> int | None:
    """Size of one dimension; None, after a finding, if it is invalid."""
    if isinstance(dimension, tree.Placeholder):
        return None
    undeclared = [
        part.name
        for part in descendants(dimension)
        if isinstance(part, tree.DataReference) and find(part.name.key, context) is None
    ]
    if undeclared:
        for name in undeclared:
            report_undefined(name, context)
        return None
    number = constant_number(dimension, context)
    written = context.module.span(dimension).one_line
    fault = "size"
    if number is None:
        fault = "not constant"
        problem = f"the size `{written}` of `{node.name.text}` is not a constant number"
    elif not 1 <= number <= MAX_SIZE or number != int(number):
        problem = f"the size of `{node.name.text}` is {number:g}, not a whole number from 1 up"
    else:
        return int(number)
    context.report(BadArraySize(problem, fault), dimension)
    return None
