"""Aggregates, `[a,b,c]`: typed by the record or array that they are assigned to.

An aggregate of literals is one value without nodes; errors are found in the value, and only then is
the source position looked up.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from rapidsim.analysis.context import Context, TypeOf
from rapidsim.analysis.installed import installed_type
from rapidsim.analysis.parameters import ExpectedType
from rapidsim.analysis.types.assignability import is_unknown, require
from rapidsim.analysis.types.type_violations import (
    NumberOutOfRange,
    RecordShape,
    TypeMismatch,
    UntypedAggregate,
)
from rapidsim.diagnostics import Violation
from rapidsim.language import types
from rapidsim.language.single_precision import LARGEST_SINGLE
from rapidsim.language.types import ArrayOf, Record, Type, resolved
from rapidsim.syntax import tree

_MARK = re.compile(r'"(?:[^"\r\n]|"")*"|![^\r\n]*|[\[\],]')
_LONGEST_LIST = 8
"""Maximum number of components that a message lists."""


def type_of_aggregate(
    node: tree.Aggregate | tree.LiteralAggregate,
    context: Context,
    wanted: ExpectedType | None,
    type_of: TypeOf,
) -> Type | None:
    """Check an aggregate against the type that its context requires.

    Returns:
        The required type; None without one, or if it is not a record or array.
    """
    target = None if wanted is None else resolved(wanted.type)
    if wanted is None or not isinstance(target, Record | ArrayOf):
        _report_untyped(node, context, wanted)
        for element in node.elements if isinstance(node, tree.Aggregate) else ():
            if not isinstance(element, tree.Aggregate | tree.LiteralAggregate):
                type_of(element, context, None)
        return None
    if isinstance(node, tree.LiteralAggregate):
        for violation, place in _literal_mistakes(node.value, wanted.type, wanted.by, ()):
            context.report(violation, _element(node, place, context), *wanted.declared)
    else:
        _check_elements(node, target, context, wanted, type_of)
    context.analysis.type_of[node] = wanted.type
    return wanted.type


def _report_untyped(
    node: tree.Aggregate | tree.LiteralAggregate, context: Context, wanted: ExpectedType | None
) -> None:
    if wanted is not None and is_unknown(wanted.type):
        # The types of its elements depend on the missing declaration.
        context.analysis.runs = False
        return
    is_open = wanted is None or wanted.type is types.ANYTYPE
    if wanted is None or is_open or installed_type(wanted.type.name.lower()) is None:
        context.report(UntypedAggregate(context.module.span(node).one_line), node)
    else:
        violation = TypeMismatch(wanted.by, wanted.type.name, "an aggregate")
        context.report(violation, node, *wanted.declared)


def _check_elements(
    node: tree.Aggregate,
    target: Record | ArrayOf,
    context: Context,
    wanted: ExpectedType,
    type_of: TypeOf,
) -> None:
    parts = _parts(target, len(node.elements), wanted.by)
    if isinstance(parts, Violation):
        context.report(parts, node, *wanted.declared)
        return
    for k, (element, of) in enumerate(zip(node.elements, parts, strict=True)):
        require(element, ExpectedType(of, _called(target, k), wanted.declared), context, type_of)


def _literal_mistakes(
    value: tree.LiteralValue, of: Type, by: str, place: tuple[int, ...]
) -> list[tuple[Violation, tuple[int, ...]]]:
    """Errors in a literal of a type, each with the indices of the nested element."""
    target = resolved(of)
    if isinstance(value, tuple):
        if not isinstance(target, Record | ArrayOf):
            return [(TypeMismatch(by, of.name, "an aggregate"), place)]
        parts = _parts(target, len(value), by)
        if isinstance(parts, Violation):
            return [(parts, place)]
        mistakes = []
        for k, (part, part_type) in enumerate(zip(value, parts, strict=True)):
            # Most parts are numbers that fit; they must be checked cheaply.
            if part_type is types.NUM and type(part) is float and abs(part) <= LARGEST_SINGLE:
                continue
            mistakes += _literal_mistakes(part, part_type, _called(target, k), (*place, k))
        return mistakes
    if isinstance(value, bool):
        found = "bool"
    elif isinstance(value, str):
        found = "string"
    elif target == types.DNUM:
        found = "dnum"
    else:
        found = "num"
        if target == types.NUM and abs(value) > LARGEST_SINGLE:
            return [(NumberOutOfRange(f"{value:g}", of.name), place)]
    if found == target.name.lower():
        return []
    return [(TypeMismatch(by, of.name, found), place)]


def _called(target: Record | ArrayOf, index: int) -> str:
    """Description of the place of one value of a record or array."""
    if isinstance(target, Record):
        return f"component `{target.components[index].name}` of {target.name}"
    return f"an element of {target.name}"


def _parts(target: Record | ArrayOf, count: int, by: str) -> Sequence[Type] | RecordShape:
    """Types of the values of a record or array."""
    if isinstance(target, Record):
        wanted = len(target.components)
        if count != wanted:
            names = [component.name for component in target.components]
            listed = names if wanted <= _LONGEST_LIST else [*names[:_LONGEST_LIST], "..."]
            return RecordShape(f"{by}, a {target.name},", wanted, count, ", ".join(listed))
        return [component.type for component in target.components]
    size, *inner = target.dimensions
    if size is not None and count != size:
        return RecordShape(by, size, count, f"elements of {target.name}", is_array=True)
    of: Type = ArrayOf(target.element, tuple(inner)) if inner else target.element
    return [of] * count


def _element(node: tree.LiteralAggregate, place: tuple[int, ...], context: Context) -> tree.Node:
    """Text of a nested element of a literal aggregate, by its indices."""
    start, end = node.start, node.end
    text = context.module.source.text
    for wanted in place:
        depth, index = 0, 0
        element_start = start
        for mark in _MARK.finditer(text, start, end):
            symbol = mark.group()
            depth += (symbol == "[") - (symbol == "]")
            opens = symbol == "[" and depth == 1
            if opens:
                element_start = mark.end()
            elif (symbol == "," and depth == 1) or (symbol == "]" and depth == 0):
                if index == wanted:
                    start, end = element_start, mark.start()
                    break
                index += 1
                element_start = mark.end()
        written = text[start:end]
        start += len(written) - len(written.lstrip())
        end -= len(written) - len(written.rstrip())
    return tree.Node(start, max(start, end))
