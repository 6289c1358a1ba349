"""Control flow: RETURN on every path, GOTO targets, error clauses, late declarations."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import takewhile
from typing import TypeAlias

from rapidsim.analysis.context import Context
from rapidsim.analysis.error_clauses import depends_on_error
from rapidsim.analysis.names.name_violations import DuplicateName
from rapidsim.analysis.passes.flow_violations import (
    ContinueOutsideLoop,
    GotoTarget,
    MissingReturn,
    RaiseRetryPlacement,
    ReturnValue,
    UnreachableCode,
)
from rapidsim.analysis.program import Symbol, does
from rapidsim.analysis.syntax_violations import LateDataDeclaration
from rapidsim.analysis.tree_walk import blocks, clauses, statements
from rapidsim.diagnostics import Related
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree

_Symbols: TypeAlias = Mapping[tree.Node, Symbol]


def check_flow(routine: tree.Routine, context: Context) -> None:
    """Check one routine with all its clauses."""
    _check_declarations(routine, context)
    _check_answers(routine, context)
    _check_returns(routine, context)
    _check_labels(routine, context)
    for body in clauses(routine):
        _check_next_turns(body, context)
        _check_reached(body, context, is_resumed=body is routine.body and _resumes(routine))


def _check_declarations(routine: tree.Routine, context: Context) -> None:
    """Declarations stand before the first statement of the routine's body."""
    in_front = True
    for statement in routine.body:
        if isinstance(statement, tree.Data):
            if not in_front:
                where = "after the first statement of the routine"
                context.report(LateDataDeclaration(statement.name.text, where), statement)
        else:
            # What could not be read may have been a declaration.
            in_front = in_front and isinstance(statement, tree.InvalidStatement)
    nested = [part for statement in routine.body for part in blocks(statement)]
    handlers = [body for body in clauses(routine) if body is not routine.body]
    for node in statements(*nested, *handlers):
        if isinstance(node, tree.Data):
            context.report(LateDataDeclaration(node.name.text, "inside a block"), node)


def _check_answers(routine: tree.Routine, context: Context) -> None:
    """RETRY, TRYNEXT and RAISE alone answer an error; only an ERROR clause has one."""
    outside = [body for body in clauses(routine) if not _is_handler(body, routine)]
    for node in statements(*outside):
        match node:
            case tree.Retry():
                context.report(RaiseRetryPlacement("RETRY"), node)
            case tree.TryNext():
                context.report(RaiseRetryPlacement("TRYNEXT"), node)
            case tree.Call():
                symbol = context.analysis.symbol_of.get(node)
                if symbol is not None and Trait.RETRY in does(symbol):
                    context.report(RaiseRetryPlacement(symbol.name), node)
            case tree.Raise(number=None):
                context.report(RaiseRetryPlacement("RAISE without a number"), node)
            case _:
                pass


def _check_next_turns(body: tree.Body, context: Context) -> None:
    """CONTINUE has a loop around it."""
    for statement in body:
        if isinstance(statement, tree.For | tree.While):
            continue
        symbol = context.analysis.symbol_of.get(statement)
        if Trait.NEXT_TURN in does(symbol):
            assert symbol is not None
            context.report(ContinueOutsideLoop(symbol.name), statement)
        for block in blocks(statement):
            _check_next_turns(block, context)


def _is_handler(body: tree.Body, routine: tree.Routine) -> bool:
    return routine.error is not None and body is routine.error.body


def _check_returns(routine: tree.Routine, context: Context) -> None:
    for node in statements(*clauses(routine)):
        match node, routine:
            case tree.Return(value=None), tree.Func(name=name, type=of):
                problem = f"RETURN gives no value, and `{name.text}` is a function"
                cure = f"return a value of type {of.text}"
                context.report(ReturnValue(problem, cure, gives_value=False), node)
            case tree.Return(value=tree.Node()), tree.Proc() | tree.Trap():
                kind = "procedure" if isinstance(routine, tree.Proc) else "trap"
                problem = f"RETURN gives a value, and `{routine.name.text}` is a {kind}"
                cure = "leave out the value" + (", or make it a FUNC" if kind[0] == "p" else "")
                context.report(ReturnValue(problem, cure, gives_value=True), node)
            case _:
                pass
    if isinstance(routine, tree.Func) and _can_complete(routine.body, context.analysis.symbol_of):
        closing = tree.Node(max(routine.start, routine.end - len("ENDFUNC")), routine.end)
        context.report(
            MissingReturn(routine.name.text, routine.type.text),
            closing,
            Related(context.module.span(routine.name), "the function begins here"),
        )
    handler = routine.error if isinstance(routine, tree.Func) else None
    if handler is not None and not any(depends_on_error(one) for one in statements(handler.body)):
        # A clause that decides by ERRNO may be complete for the errors that occur.
        assert isinstance(routine, tree.Func)
        if _can_complete(handler.body, context.analysis.symbol_of):
            missing = MissingReturn(routine.name.text, routine.type.text, is_clause=True)
            context.report(missing, handler)


def _check_reached(body: tree.Body, context: Context, *, is_resumed: bool) -> None:
    """Report what stands behind a statement that never passes, once up to the next label.

    Args:
        body: A statement list.
        context: Takes the reports.
        is_resumed: TRYNEXT may go on behind a statement of the list that failed.
    """
    last: tree.Statement | None = None
    is_reported = False
    for position, statement in enumerate(body):
        if isinstance(statement, tree.Label):
            last, is_reported = None, False
        if last is not None:
            if not is_reported and not _is_for_safety(body[position:]):
                place = Related(context.module.span(last), "this never goes on to the next one")
                context.report(UnreachableCode(), statement, place)
            is_reported = True
            continue
        for block in blocks(statement):
            _check_reached(block, context, is_resumed=is_resumed)
        if _leads_elsewhere(statement, context.analysis.symbol_of, is_resumed=is_resumed):
            last = statement


def _resumes(routine: tree.Routine) -> bool:
    handler = routine.error.body if routine.error is not None else ()
    return any(isinstance(statement, tree.TryNext) for statement in statements(handler))


def _leads_elsewhere(statement: tree.Statement, symbol_of: _Symbols, *, is_resumed: bool) -> bool:
    """Whether execution surely never goes on behind a statement."""
    if is_resumed:
        match statement:
            case tree.Exit() | tree.Goto() | tree.Return(value=None):
                return True
            case _:
                return False
    # Of what could not be read nobody knows where it leads.
    if any(
        isinstance(node, tree.InvalidStatement | tree.Placeholder)
        for node in statements((statement,))
    ):
        return False
    return not _passes(statement, symbol_of)


def _is_for_safety(rest: tree.Body) -> bool:
    """Whether nothing but a RETURN stands there up to the next label."""
    before_label = takewhile(lambda statement: not isinstance(statement, tree.Label), rest)
    return all(isinstance(statement, tree.Return | tree.Empty) for statement in before_label)


def _can_complete(body: Sequence[tree.Statement], symbol_of: _Symbols) -> bool:
    """Whether execution can run past the last statement of a list."""
    goes_on = True
    for statement in body:
        if isinstance(statement, tree.Label):
            goes_on = True
        elif goes_on:
            goes_on = _passes(statement, symbol_of)
    return goes_on


def _passes(statement: tree.Statement, symbol_of: _Symbols) -> bool:
    match statement:
        case tree.Return() | tree.Raise() | tree.Exit() | tree.Goto():
            return False
        case tree.Retry() | tree.TryNext() | tree.InvalidStatement() | tree.Placeholder():
            return False
        case tree.Call():
            return Trait.LEAVE not in does(symbol_of.get(statement))
        case tree.If(branches=branches, otherwise=otherwise):
            return otherwise is None or any(
                _can_complete(body, symbol_of)
                for body in (*(branch.body for branch in branches), otherwise)
            )
        case tree.Test(cases=cases, default=default):
            return default is None or any(
                _can_complete(body, symbol_of) for body in (*(case.body for case in cases), default)
            )
        case tree.While(condition=tree.BoolLiteral(value=True), body=body):
            # RAPID has no statement that leaves a loop but a jump.
            return any(isinstance(node, tree.Goto) for node in statements(body))
        case _:
            return True


def _check_labels(routine: tree.Routine, context: Context) -> None:
    """A jump may leave blocks and never enter one."""
    seen: dict[str, tree.Label] = {}
    for node in statements(*clauses(routine)):
        if isinstance(node, tree.Label):
            first = seen.setdefault(node.name.key, node)
            if first is not node:
                place = Related(context.module.span(first.name), "the first one is here")
                context.report(DuplicateName(node.name.text, " as a label"), node.name, place)
    for body in clauses(routine):
        _check_jumps(body, (), seen, context)


def _check_jumps(
    body: tree.Body,
    around: tuple[str, ...],
    all_labels: dict[str, tree.Label],
    context: Context,
) -> None:
    here = tuple(part.name.key for part in body if isinstance(part, tree.Label))
    within_reach = (*around, *here)
    for statement in body:
        if isinstance(statement, tree.Goto) and statement.name.key not in within_reach:
            name = statement.name
            label = all_labels.get(name.key)
            if label is not None:
                problem = f"GOTO cannot jump to `{name.text}`, which is inside another block"
                place = Related(context.module.span(label.name), "the label is here")
                context.report(GotoTarget(problem, is_unknown=False), name, place)
            else:
                known = (one.name.text for one in all_labels.values())
                nearest = context.analysis.find_nearest(name, (context.routine, "label"), known)
                problem = f"this routine has no label `{name.text}`"
                context.report(GotoTarget(problem, nearest), name)
        for block in blocks(statement):
            _check_jumps(block, within_reach, all_labels, context)
