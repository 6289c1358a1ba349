"""Calls of procedures and functions: resolution of the callee and checks of every argument."""

from __future__ import annotations

from collections.abc import Sequence

from rapidsim.analysis.context import Context, TypeOf
from rapidsim.analysis.names.names import find, routine_named, take_for_unknown
from rapidsim.analysis.parameters import Callee, ExpectedType, Formal
from rapidsim.analysis.program import DataSymbol, ParameterSymbol
from rapidsim.analysis.types.argument_binding import Bound, bind
from rapidsim.analysis.types.argument_order import without_exchange
from rapidsim.analysis.types.argument_violations import BadOption
from rapidsim.analysis.types.arguments import check_argument
from rapidsim.analysis.types.callees import callee_of
from rapidsim.language import types
from rapidsim.language.types import Type, resolved
from rapidsim.syntax import tree


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
    call: tree.FunctionCall, context: Context, wanted: ExpectedType | None, type_of: TypeOf
) -> Type | None:
    """Check a function call; return its type, or None if the function is unknown.

    The value of an unknown function is assumed to have the type required by its context.
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


def check_unbound(
    arguments: Sequence[tree.Argument],
    context: Context,
    type_of: TypeOf,
    *,
    is_skipped: bool = True,
) -> None:
    """Check the arguments of a call whose parameters are unknown.

    If the call is skipped, an undeclared name in its arguments is no error.
    """
    for argument in arguments:
        match argument:
            case (
                tree.RequiredArgument(value=value)
                | tree.OptionalArgument(value=tree.Node() as value)
            ):
                if not is_skipped or not _take_for_unknown(value, context):
                    type_of(value, context, None)
            case tree.ConditionalArgument():
                _check_conditional(argument, context)
            case _:
                pass


def _take_for_unknown(value: tree.Expression, context: Context) -> bool:
    """Treat an undeclared name as unknown; return whether a value is one, or an aggregate."""
    if isinstance(value, tree.Aggregate | tree.LiteralAggregate):
        return True
    if not isinstance(value, tree.DataReference) or find(value.name.key, context) is not None:
        return False
    take_for_unknown(value, context)
    return True


def _check_arguments(
    call: tree.Node,
    arguments: Sequence[tree.Argument],
    callee: Callee,
    context: Context,
    type_of: TypeOf,
) -> None:
    if any(map(_lacks_its_end, (call, *arguments))):
        check_unbound(arguments, context, type_of)
        return
    bound, unbound = bind(call, arguments, callee, context)
    check_unbound(unbound, context, type_of)
    bound = without_exchange(bound, callee, context)
    given: dict[int, tree.Argument] = {}
    beside: Type | None = None
    for argument, formal in bound:
        if formal.group:
            other = given.setdefault(formal.group, argument)
            both_conditional = isinstance(argument, tree.ConditionalArgument) and isinstance(
                other, tree.ConditionalArgument
            )
            if other is not argument and not both_conditional:
                names = [f"`{f.spelled}`" for a, f in bound if f.group == formal.group]
                problem = f"{' and '.join(names)} of `{callee.name}` exclude each other"
                context.report(BadOption(problem, "exclusive", "give one of them"), argument)
        match argument:
            case tree.RequiredArgument(value=value):
                kind = (
                    _paired_signal_type(argument, bound, context)
                    if formal.accepts_any_signal
                    else None
                )
                found = check_argument(
                    value, formal, context, type_of, other_type=beside, same_type=kind
                )
                if types.DNUM in formal.types:
                    beside = found
            case tree.OptionalArgument(value=value):
                _check_option(argument, value, formal, context, type_of)
            case tree.ConditionalArgument():
                _check_conditional(argument, context)


def _lacks_its_end(node: tree.Node) -> bool:
    """Whether the bracket at the end of an argument, or of a call, is missing, which is reported.

    It may then contain arguments after it: a bracket that is not in the text has no width.
    """
    match node:
        case tree.RequiredArgument(value=tree.Aggregate() | tree.FunctionCall() as value):
            return _lacks_its_end(value)
        case tree.Aggregate(elements=(*_, last)) | tree.FunctionCall(arguments=(*_, last)):
            return node.end == last.end
        case _:
            return False


def _paired_signal_type(
    argument: tree.RequiredArgument, bound: Sequence[Bound], context: Context
) -> Type | None:
    """Kind of signal of another argument, if a call connects two signals of any kind.

    `AliasIO glue,alias` resolves `glue` to the declared type of `alias`.
    """
    takes_all = [
        one.value
        for one, formal in bound
        if isinstance(one, tree.RequiredArgument) and formal.accepts_any_signal
    ]
    for other in takes_all:
        match find(other.name.key, context) if isinstance(other, tree.DataReference) else None:
            case DataSymbol(type=of) | ParameterSymbol(type=of) if resolved(of) in types.SIGNALS:
                return resolved(of)
    return None


def _check_option(
    argument: tree.OptionalArgument,
    value: tree.Expression | None,
    formal: Formal,
    context: Context,
    type_of: TypeOf,
) -> None:
    if formal.is_switch:
        if value is not None:
            problem = f"`{formal.spelled}` is a switch and takes no value"
            cure = f"write `{formal.spelled}` alone"
            context.report(BadOption(problem, "switch", cure), argument)
            type_of(value, context, None)
    elif value is None:
        problem = f"`{formal.spelled}` lacks its value"
        cure = f"write `{formal.spelled}:=` and a value of type {formal.types[0].name}"
        context.report(BadOption(problem, "no value", cure), argument)
    else:
        check_argument(value, formal, context, type_of)


def _check_conditional(argument: tree.ConditionalArgument, context: Context) -> None:
    r"""Check `\Par?q`: q must be an optional parameter of the calling routine."""
    symbol = context.scope.find(argument.present.key)
    if isinstance(symbol, ParameterSymbol) and symbol.optional:
        context.analysis.symbol_of[argument] = symbol
        return
    name = argument.present.text
    problem = f"`{name}` is not an optional parameter of this routine"
    cure = f"give the value itself, `\\{argument.name.text}:={name}`"
    violation = BadOption(problem, "conditional", cure)
    context.report(violation, argument.present, *context.declaration(symbol))
