"""Check of one argument against its parameter: its type, and the data of a reference.

Source: RAPID Overview, "Routines", the table of parameter access modes.
"""

from __future__ import annotations

from rapidsim.analysis.context import Context, TypeOf
from rapidsim.analysis.names.default_data import OF_SYSTEM, is_assumed
from rapidsim.analysis.names.name_violations import UnknownUnit
from rapidsim.analysis.names.names import (
    find,
    is_undeclared,
    kind_of,
    report_undefined,
    take_for_signal,
)
from rapidsim.analysis.parameters import ExpectedType, Formal
from rapidsim.analysis.program import DataSymbol, ParameterSymbol, Storage, Symbol
from rapidsim.analysis.tree_walk import descendants
from rapidsim.analysis.types.argument_violations import BadArgumentMode, PersistentElement
from rapidsim.analysis.types.assignability import agrees, report_mismatch, require_value
from rapidsim.analysis.types.data_paths import is_read_only, root_of
from rapidsim.analysis.types.operators import is_literal_number, value_type
from rapidsim.language import types
from rapidsim.language.annotations import ParameterMode
from rapidsim.language.single_precision import LARGEST_EXACT_INTEGER
from rapidsim.language.types import Atomic, Type, resolved
from rapidsim.syntax import tree

_CONFIGURED = frozenset({"mecunit", "taskid", "cameradev"})
"""Types of data that a controller takes from its configuration."""
_WORDS = {
    ParameterMode.VAR: "a variable",
    ParameterMode.INOUT: "a variable or a persistent",
    ParameterMode.PERS: "a persistent",
    ParameterMode.REF: "data",
}


def check_argument(
    value: tree.Expression,
    formal: Formal,
    context: Context,
    type_of: TypeOf,
    *,
    other_type: Type | None = None,
    same_type: Type | None = None,
) -> Type | None:
    """Check the value of an argument.

    Args:
        value: The argument.
        formal: Its parameter.
        context: The scope of the call.
        type_of: Finds the types of expressions.
        other_type: Type of the preceding argument that may be num or dnum; literals follow it.
        same_type: Assumed type of an undeclared signal if the parameter accepts every kind.

    Returns:
        The type of the argument; None if it is not known.
    """
    plain = _without_parentheses(value)
    if isinstance(plain, tree.DataReference) and is_undeclared(plain.name, context):
        signal = same_type or formal.signal
        if signal is not None:
            take_for_signal(plain, signal, context)
            return None
        unit = next((of for of in formal.types if _is_configured(of)), None)
        if unit is not None:
            _take_for_unit(plain, unit, context)
            return None
        if is_assumed(plain, formal.wanted.type, context):
            return None
        if formal.mode is not ParameterMode.IN:
            taken = OF_SYSTEM.get(formal.wanted.type.name)
            report_undefined(plain.name, context, assumed=taken)
            return None
    wanted = _wanted(plain, formal, other_type)
    found = type_of(value, context, wanted)
    if found is not None and not _fits(found, formal):
        _report_types(value, found, formal, context)
        return found
    if formal.mode is not ParameterMode.IN and found is not None:
        _check_mode(value, formal, context)
    elif found is not None and formal.types == (types.ANYTYPE,):
        require_value(value, found, "passed by value", context)
    return found


def _wanted(value: tree.Expression, formal: Formal, other_type: Type | None) -> ExpectedType:
    """Return the expected type of literals and aggregates if the parameter accepts several.

    A literal follows the data it is used with, as in `Add d, 0.2`; without any it is a num unless
    only a dnum holds it exactly, as in `SetGO go, 4294967295`.
    """
    if isinstance(value, tree.DataReference):
        return formal.wanted
    is_open = types.DNUM in formal.types or formal.types == (types.ANYTYPE,)
    if not (is_open and is_literal_number(value)) or formal.types == (types.DNUM,):
        return formal.wanted
    is_dnum = other_type is not None and resolved(other_type) == types.DNUM
    if not is_dnum and other_type is None:
        is_dnum = any(
            abs(part.value) > LARGEST_EXACT_INTEGER
            for part in descendants(value)
            if isinstance(part, tree.NumberLiteral)
        )
    return ExpectedType(types.DNUM if is_dnum else types.NUM, formal.wanted.by)


def _fits(actual: Type, formal: Formal) -> bool:
    if formal.mode is not ParameterMode.IN and value_type(actual) != resolved(actual):
        # The reference is to the signal itself, not to the number that it reads as.
        wanted = formal.types if formal.only is None else formal.only.types
        return types.ANYTYPE in wanted or resolved(actual) in map(resolved, wanted)
    fits = any(agrees(actual, of) for of in formal.types)
    return fits and (formal.only is None or any(agrees(actual, of) for of in formal.only.types))


def _report_types(value: tree.Expression, actual: Type, formal: Formal, context: Context) -> None:
    wanted = formal.wanted
    if formal.only is not None:
        wanted = ExpectedType(Atomic(formal.only.words), wanted.by, wanted.declared)
    elif len(formal.types) > 1:
        names = " or ".join(dict.fromkeys(of.name for of in formal.types))
        wanted = ExpectedType(Atomic(names), wanted.by, wanted.declared)
    report_mismatch(value, actual, wanted, context)


def _check_mode(value: tree.Expression, formal: Formal, context: Context) -> None:
    words = _WORDS[formal.mode]
    if (
        isinstance(value, tree.StringLiteral)
        and formal.mode is ParameterMode.REF
        and formal.signal is not None
    ):
        # A signal may be named by a string if the routine only looks it up.
        return
    if not isinstance(value, tree.DataPath):
        found = (
            "not an expression" if formal.mode is not ParameterMode.REF else "not a computed value"
        )
        context.report(
            BadArgumentMode(formal.wanted.by, words, found), value, *formal.wanted.declared
        )
        return
    root = root_of(value)
    symbol = find(root.name.key, context)
    if symbol is None or _may_refer(symbol, formal.mode):
        is_part = not isinstance(value, tree.DataReference)
        if (
            is_part
            and formal.mode in (ParameterMode.PERS, ParameterMode.INOUT)
            and _is_persistent(symbol)
        ):
            context.report(PersistentElement(formal.wanted.by), value)
        return
    found = f"`{root.name.text}` is {kind_of(symbol)}"
    violation = BadArgumentMode(formal.wanted.by, words, found)
    context.report(violation, value, *context.declaration(symbol), *formal.wanted.declared)


def _may_refer(symbol: Symbol, mode: ParameterMode) -> bool:
    """Whether a parameter of a mode may be bound to data."""
    match symbol:
        case _ if is_read_only(symbol):
            return mode is ParameterMode.REF
        case ParameterSymbol(mode=ParameterMode.INOUT):
            # The data that it is bound to are unknown here.
            return True
        case _ if mode is ParameterMode.PERS:
            return _is_persistent(symbol)
        case _:
            return mode is not ParameterMode.VAR or not _is_persistent(symbol)


def _is_persistent(symbol: Symbol | None) -> bool:
    match symbol:
        case DataSymbol(storage=Storage.PERS) | ParameterSymbol(mode=ParameterMode.PERS):
            return True
        case _:
            return False


def _is_configured(of: Type) -> bool:
    return resolved(of).name.lower() in _CONFIGURED


def _take_for_unit(reference: tree.DataReference, of: Type, context: Context) -> None:
    analysis = context.analysis
    name = reference.name
    if name.key not in analysis.unit.unknown:
        context.report(UnknownUnit(name.text, of.name), name)
    analysis.symbol_of[reference] = analysis.unknown_symbol(name.text)
    analysis.type_of[reference] = of


def _without_parentheses(expression: tree.Expression) -> tree.Expression:
    while isinstance(expression, tree.Parenthesised):
        expression = expression.inner
    return expression
