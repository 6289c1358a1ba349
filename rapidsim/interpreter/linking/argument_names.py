"""Names of the data passed for a parameter, as ArgName returns them.

Calls carry no extra information for the few programs that use ArgName. The call is found in the
tree of the calling routine, at the position where Python is executing that routine; if the argument
is a parameter of the caller, the search continues with the caller's own caller.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import FrameType

from rapidsim.analysis.program import ParameterSymbol, RoutineSymbol, Symbol, UnknownSymbol
from rapidsim.analysis.tree_walk import descendants
from rapidsim.interpreter.codegen.bound_arguments import match_arguments
from rapidsim.interpreter.codegen.written_paths import bare, flat
from rapidsim.interpreter.runtime.call_stack import Origin, offsets_of
from rapidsim.interpreter.runtime.error_recovery import GENERATED, is_generated
from rapidsim.language.error_numbers import ERR_ARGNAME, rapid_error
from rapidsim.language.errors import RapidError
from rapidsim.syntax import tree

_Call = tree.Call | tree.FunctionCall | tree.LateCall


def argument_name(frame: FrameType, parameter: str) -> str | None:
    """Return the name of the data passed for a parameter.

    Args:
        frame: The frame of the routine that calls ArgName, or of one of its clauses.
        parameter: Its folded name.

    Returns:
        The name as declared; None if several calls of the routine are so close together that the
        running one is ambiguous.

    Raises:
        RapidError: ERR_ARGNAME if the argument is absent, or is an expression or a switch.
    """
    while True:
        frame = _routine_frame(frame)
        routine = _routine(frame)
        caller = _outer(frame)
        if routine is None or caller is None:
            raise _no_name(parameter, "was not given by a call in the program")
        calls = _calls_at(caller, routine)
        if len(calls) != 1:
            return None
        given = match_arguments(calls[0].arguments, routine.parameters).get(parameter)
        if given is None:
            raise _no_name(parameter, "was not given")
        if given.caller_option is not None:
            parameter = given.caller_option.key
        else:
            value = None if given.value is None else bare(given.value)
            if not isinstance(value, tree.DataReference | tree.Index | tree.ComponentAccess):
                raise _no_name(parameter, "is an expression or a switch")
            origin: Origin = caller.f_globals[GENERATED]
            symbol = origin.program().symbol_of[flat(value).reference]
            if not isinstance(symbol, ParameterSymbol):
                return symbol.name
            parameter = symbol.name.lower()
        frame = caller


def _routine_frame(frame: FrameType) -> FrameType:
    """Frame of the routine that a clause, or a deferred expression, belongs to."""
    name = frame.f_code.co_qualname.partition(".")[0]
    while frame.f_code.co_qualname != name or not is_generated(frame):
        assert frame.f_back is not None
        frame = frame.f_back
    return frame


def _routine(frame: FrameType) -> RoutineSymbol | None:
    origin: Origin = frame.f_globals[GENERATED]
    return origin.routines.get(frame.f_code.co_qualname)


def _outer(frame: FrameType) -> FrameType | None:
    """Frame of the program that called a routine."""
    outer = frame.f_back
    while outer is not None and not is_generated(outer):
        outer = outer.f_back
    return outer


def _calls_at(caller: FrameType, routine: RoutineSymbol) -> list[_Call]:
    """Return the calls of a routine at which its caller may be.

    For Python, the parts of a statement on its later lines are at the start of the statement.
    """
    origin: Origin = caller.f_globals[GENERATED]
    symbol_of = origin.program().symbol_of
    start, _ = offsets_of(origin.source, caller.f_code, caller.f_lasti, caller.f_lineno)
    nodes = [
        node
        for item in origin.module.routines
        if item.start <= start < item.end
        for node in descendants(item)
    ]
    end = max((node.end for node in nodes if node.start == start), default=start)
    found = [
        node
        for node in nodes
        if isinstance(node, _Call)
        and start <= node.start <= end
        and _may_call(node, routine, symbol_of)
    ]
    return [node for node in found if node.start == start] or found


def _may_call(node: _Call, routine: RoutineSymbol, symbol_of: Mapping[tree.Node, Symbol]) -> bool:
    """Whether a call may be one of a routine: by its name, or by a name computed at run time."""
    callee = symbol_of.get(node)
    if isinstance(callee, RoutineSymbol):
        return callee.node is routine.node
    return callee is None or isinstance(callee, UnknownSymbol)


def _no_name(parameter: str, reason: str) -> RapidError:
    return rapid_error(ERR_ARGNAME, f"the argument `{parameter}` has no name: it {reason}")
