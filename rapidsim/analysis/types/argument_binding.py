"""Matching the arguments of a call to parameters.

Required arguments follow the order of their parameters. Optional ones are named and have their
place between the required ones; among themselves any order is accepted.
"""

from __future__ import annotations

from collections.abc import Sequence, Set
from itertools import combinations
from math import comb
from typing import TypeAlias

from rapidsim.analysis.context import Context
from rapidsim.analysis.names.names import DataLike, find
from rapidsim.analysis.parameters import Callee, Formal
from rapidsim.analysis.suggestions import closest
from rapidsim.analysis.types.argument_violations import BadArguments, BadOption, UnknownArgument
from rapidsim.analysis.types.assignability import agrees
from rapidsim.analysis.types.callees import callee_of
from rapidsim.analysis.types.data_paths import type_of_data
from rapidsim.language import types
from rapidsim.language.types import ArrayOf, Record, Type, resolved
from rapidsim.library.other_languages import option_for
from rapidsim.syntax import tree

Bound: TypeAlias = tuple[tree.Argument, Formal]
_MOST_WAYS = 200
"""Maximum number of combinations of omitted parameters that are compared."""
_NUMBERS = (types.NUM, types.DNUM, types.ANYTYPE)


def bind(
    call: tree.Node, arguments: Sequence[tree.Argument], callee: Callee, context: Context
) -> tuple[list[Bound], list[tree.Argument]]:
    """Match arguments to parameters; report superfluous and missing ones.

    Returns:
        The matched arguments with their parameters, and the unmatched ones.
    """
    formals = callee.parameters
    left_out = _likely_missing(arguments, formals, context)
    bound: list[Bound] = []
    filled: set[str] = set()
    next_required = 0
    extra: list[tree.Argument] = []
    for argument in arguments:
        if isinstance(argument, tree.RequiredArgument) and argument.name is None:
            while next_required < len(formals) and (
                formals[next_required].optional or next_required in left_out
            ):
                next_required += 1
            if next_required == len(formals):
                extra.append(argument)
                continue
            formal = formals[next_required]
            next_required += 1
        else:
            position = _named(argument, callee, context)
            if position is None:
                extra.append(argument)
                continue
            formal = formals[position]
            if formal.key in filled:
                problem = f"`{formal.spelled}` of `{callee.name}` is given twice"
                context.report(BadOption(problem, "twice", "leave one of them out"), argument)
                continue
            if _is_misplaced(position, next_required, formals):
                problem = f"`{formal.spelled}` of `{callee.name}` is in the wrong place"
                fault = f"{'optional' if formal.optional else 'required'} argument"
                violation = BadArguments(problem, fault, callee.order)
                context.report(violation, argument, *callee.declared)
            if not formal.optional:
                next_required = max(next_required, position + 1)
        filled.add(formal.key)
        bound.append((argument, formal))
    _report_superfluous(extra, callee, context)
    _report_missing(call, filled, callee, context)
    return bound, extra


def _report_superfluous(extra: Sequence[tree.Argument], callee: Callee, context: Context) -> None:
    positional = [a for a in extra if isinstance(a, tree.RequiredArgument) and a.name is None]
    if positional:
        count = sum(not formal.optional for formal in callee.parameters)
        problem = f"`{callee.name}` takes {_counted(count)}, {count + len(positional)} given"
        violation = BadArguments(problem, "too many", callee.order)
        context.report(violation, positional[0], *callee.declared)


def _report_missing(call: tree.Node, filled: Set[str], callee: Callee, context: Context) -> None:
    missing = [f for f in callee.parameters if not f.optional and f.key not in filled]
    if missing:
        names = " and ".join(f"`{formal.name}`" for formal in missing)
        problem = f"the call of `{callee.name}` lacks {names}"
        violation = BadArguments(problem, "too few", callee.order)
        context.report(violation, call, *callee.declared)


def _named(argument: tree.Argument, callee: Callee, context: Context) -> int | None:
    """Position of the parameter that a named argument names."""
    optional = not isinstance(argument, tree.RequiredArgument)
    name = argument.name
    assert name is not None
    for position, formal in enumerate(callee.parameters):
        if name.key in formal.keys and formal.optional == optional:
            return position
    if not callee.is_complete:
        return None
    known = tuple(f.spelled for f in callee.parameters if f.optional == optional)
    mark = "\\" if optional else ""
    nearest = closest(mark + name.text, known) or (optional and option_for(name.key, known)) or None
    kind = "option" if optional else "parameter"
    violation = UnknownArgument(callee.name, kind, mark + name.text, nearest, known)
    context.report(violation, name, *callee.declared)
    return None


def _is_misplaced(position: int, next_required: int, formals: Sequence[Formal]) -> bool:
    """Whether a named argument is on the wrong side of a required one.

    The required arguments up to `next_required` precede it, the others follow.
    """
    low, high = sorted((position, next_required))
    return any(not formal.optional for formal in formals[low:high])


def _likely_missing(
    arguments: Sequence[tree.Argument], formals: Sequence[Formal], context: Context
) -> frozenset[int]:
    """Positions of the required parameters that a call with too few arguments omits.

    They are chosen so that the types of the arguments fit best: for a call without its zone the
    message is that the zone is missing, not that the tool is no zone.
    """
    required = [k for k, formal in enumerate(formals) if not formal.optional]
    values = [part.value for part in arguments if isinstance(part, tree.RequiredArgument)]
    is_named = any(isinstance(part, tree.RequiredArgument) and part.name for part in arguments)
    too_few = len(values) < len(required)
    if is_named or not too_few or comb(len(required), len(values)) > _MOST_WAYS:
        return frozenset()
    kept = min(
        combinations(required, len(values)),
        key=lambda way: sum(
            not fits(value, formals[k], context) for value, k in zip(values, way, strict=True)
        ),
    )
    return frozenset(required) - frozenset(kept)


def fits(value: tree.Expression, formal: Formal, context: Context) -> bool:
    """Whether an argument may fit a parameter; True without evidence against it."""
    found = _evident_type(value, context)
    if found is not None:
        return any(agrees(found, of) for of in formal.types)
    if isinstance(value, tree.NumberLiteral):
        return any(resolved(of) in _NUMBERS for of in formal.types)
    if isinstance(value, tree.Aggregate | tree.LiteralAggregate):
        return any(isinstance(resolved(of), Record | ArrayOf) for of in formal.types)
    return True


def _evident_type(value: tree.Expression, context: Context) -> Type | None:
    match value:
        case tree.StringLiteral():
            return types.STRING
        case tree.BoolLiteral():
            return types.BOOL
        case tree.DataReference(name=name):
            symbol = find(name.key, context)
            if isinstance(symbol, DataLike):
                return type_of_data(symbol)
            return None
        case tree.FunctionCall(name=name):
            callee = callee_of(find(name.key, context), context)
            return callee.result if callee is not None else None
        case _:
            return None


def _counted(count: int) -> str:
    return {0: "no argument", 1: "1 argument"}.get(count, f"{count} arguments")
