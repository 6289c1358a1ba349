r"""Calls: which argument goes to which parameter, and whether it may.

Arguments stand in the order of the parameters. Optional arguments are named and keep their place
between the required ones; among themselves any order is accepted.
"""

from __future__ import annotations

from collections.abc import Sequence

from rapidsim.analysis.argument_violations import BadArguments, BadOption, UnknownArgument
from rapidsim.analysis.arguments import check_argument
from rapidsim.analysis.callees import callee_of
from rapidsim.analysis.context import Context, TypeOf
from rapidsim.analysis.names import find, routine_named
from rapidsim.analysis.parameters import Callee, Formal, Wanted
from rapidsim.analysis.program import ParameterSymbol
from rapidsim.analysis.suggestions import closest
from rapidsim.language import types
from rapidsim.language.types import Type
from rapidsim.syntax import tree

Bound = list[tuple[tree.Argument, Formal]]


def check_call(call: tree.Call, context: Context, type_of: TypeOf) -> None:
    """Check a procedure call."""
    symbol = routine_named(call.name, context, function=False)
    if symbol is not None:
        context.analysis.symbol_of[call] = symbol
    callee = callee_of(symbol, context)
    if callee is None:
        check_unbound(call.arguments, context, type_of)
    else:
        _check_arguments(call, call.arguments, callee, context, type_of)


def type_of_call(
    call: tree.FunctionCall, context: Context, wanted: Wanted | None, type_of: TypeOf
) -> Type | None:
    """Check a function call; its type is None if the function is not known.

    The value of an unknown function is taken to have the type that its place wants.
    """
    symbol = routine_named(call.name, context, function=True)
    if symbol is not None:
        context.analysis.symbol_of[call] = symbol
    callee = callee_of(symbol, context)
    if callee is None:
        check_unbound(call.arguments, context, type_of)
        is_open = wanted is None or wanted.type is types.ANYTYPE
        context.analysis.type_of[call] = types.NUM if wanted is None or is_open else wanted.type
        return None
    _check_arguments(call, call.arguments, callee, context, type_of)
    if callee.result is not None:
        context.analysis.type_of[call] = callee.result
    return callee.result


def check_unbound(arguments: Sequence[tree.Argument], context: Context, type_of: TypeOf) -> None:
    """Check the arguments of a call whose parameters are not known.

    The call is skipped, so names that nothing declares are no mistake in its arguments.
    """
    for argument in arguments:
        match argument:
            case tree.Required(value=value) | tree.Optional(value=tree.Node() as value):
                if isinstance(value, tree.Aggregate | tree.LiteralAggregate):
                    continue
                if isinstance(value, tree.Reference) and find(value.name.key, context) is None:
                    symbol = context.analysis.unknown_symbol(value.name.text)
                    context.analysis.symbol_of[value] = symbol
                    continue
                type_of(value, context, None)
            case tree.Conditional():
                _check_conditional(argument, context)
            case _:
                pass


def _check_arguments(
    call: tree.Node,
    arguments: Sequence[tree.Argument],
    callee: Callee,
    context: Context,
    type_of: TypeOf,
) -> None:
    bound = _bind(call, arguments, callee, context, type_of)
    given: dict[int, tree.Argument] = {}
    for argument, formal in bound:
        if formal.group:
            other = given.setdefault(formal.group, argument)
            both_conditional = isinstance(argument, tree.Conditional) and isinstance(
                other, tree.Conditional
            )
            if other is not argument and not both_conditional:
                names = [f"`{f.spelled}`" for a, f in bound if f.group == formal.group]
                problem = f"{' and '.join(names)} of `{callee.name}` exclude each other"
                context.report(BadOption(problem, "give one of them"), argument)
        match argument:
            case tree.Required(value=value):
                check_argument(value, formal, context, type_of)
            case tree.Optional(value=value):
                _check_option(argument, value, formal, context, type_of)
            case tree.Conditional():
                _check_conditional(argument, context)


def _bind(
    call: tree.Node,
    arguments: Sequence[tree.Argument],
    callee: Callee,
    context: Context,
    type_of: TypeOf,
) -> Bound:
    """Give each argument its parameter; a finding for what has none and for what is missing."""
    formals = callee.parameters
    bound: Bound = []
    filled: set[str] = set()
    next_required = 0
    extra: list[tree.Argument] = []
    for argument in arguments:
        if isinstance(argument, tree.Required) and argument.name is None:
            while next_required < len(formals) and formals[next_required].optional:
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
                context.report(BadOption(problem, "leave one of them out"), argument)
                continue
            if _is_misplaced(position, next_required, formals):
                problem = f"`{formal.spelled}` of `{callee.name}` stands in the wrong place"
                context.report(BadArguments(problem, callee.order), argument, *callee.declared)
            if not formal.optional:
                next_required = max(next_required, position + 1)
        filled.add(formal.key)
        bound.append((argument, formal))
    positional = [a for a in extra if isinstance(a, tree.Required) and a.name is None]
    if positional:
        count = sum(not formal.optional for formal in formals)
        problem = f"`{callee.name}` takes {_counted(count)}, {count + len(positional)} given"
        context.report(BadArguments(problem, callee.order), positional[0], *callee.declared)
    missing = [f for f in formals if not f.optional and f.key not in filled]
    if missing:
        names = " and ".join(f"`{formal.name}`" for formal in missing)
        problem = f"the call of `{callee.name}` lacks {names}"
        context.report(BadArguments(problem, callee.order), call, *callee.declared)
    check_unbound(extra, context, type_of)
    return bound


def _named(argument: tree.Argument, callee: Callee, context: Context) -> int | None:
    """The position of the parameter a named argument names."""
    optional = not isinstance(argument, tree.Required)
    name = argument.name
    assert name is not None
    for position, formal in enumerate(callee.parameters):
        if formal.key == name.key and formal.optional == optional:
            return position
    if not callee.is_complete:
        return None
    known = tuple(f.spelled for f in callee.parameters if f.optional == optional)
    mark = "\\" if optional else ""
    nearest = closest(mark + name.text, known)
    kind = "option" if optional else "parameter"
    violation = UnknownArgument(callee.name, kind, mark + name.text, nearest, known)
    context.report(violation, name, *callee.declared)
    return None


def _is_misplaced(position: int, next_required: int, formals: Sequence[Formal]) -> bool:
    """Whether a named argument stands on the wrong side of a required one.

    The required arguments up to `next_required` have been given, the others follow.
    """
    low, high = sorted((position, next_required))
    return any(not formal.optional for formal in formals[low:high])


def _check_option(
    argument: tree.Optional,
    value: tree.Expression | None,
    formal: Formal,
    context: Context,
    type_of: TypeOf,
) -> None:
    if formal.is_switch:
        if value is not None:
            problem = f"`{formal.spelled}` is a switch and takes no value"
            context.report(BadOption(problem, f"write `{formal.spelled}` alone"), argument)
            type_of(value, context, None)
    elif value is None:
        problem = f"`{formal.spelled}` lacks its value"
        cure = f"write `{formal.spelled}:=` and a value of type {formal.types[0].name}"
        context.report(BadOption(problem, cure), argument)
    else:
        check_argument(value, formal, context, type_of)


def _check_conditional(argument: tree.Conditional, context: Context) -> None:
    r"""`\Par?q`: q is an optional parameter of the routine that the call stands in."""
    symbol = context.scope.find(argument.present.key)
    if isinstance(symbol, ParameterSymbol) and symbol.optional:
        context.analysis.symbol_of[argument] = symbol
        return
    name = argument.present.text
    problem = f"`{name}` is no optional parameter of the routine it stands in"
    cure = f"give the value itself, `\\{argument.name.text}:={name}`"
    context.report(BadOption(problem, cure), argument.present, *context.declaration(symbol))


def _counted(count: int) -> str:
    return {0: "no argument", 1: "1 argument"}.get(count, f"{count} arguments")
