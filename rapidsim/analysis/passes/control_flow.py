"""Control flow: RETURN on every path, GOTO targets, error clauses, late declarations."""

from __future__ import annotations

from collections.abc import Container
from functools import reduce
from itertools import takewhile
from operator import or_

from rapidsim.analysis.context import Context
from rapidsim.analysis.error_clauses import depends_on_error
from rapidsim.analysis.flow.graph import ENTRY, EXIT, NORMAL, ControlFlowGraph, EdgeKind
from rapidsim.analysis.names.name_violations import DuplicateName
from rapidsim.analysis.passes.flow_violations import (
    ContinueOutsideLoop,
    GotoTarget,
    MissingReturn,
    RaiseRetryPlacement,
    ReturnValue,
    UnreachableCode,
)
from rapidsim.analysis.program import control_flow, does
from rapidsim.analysis.syntax_violations import LateDataDeclaration
from rapidsim.analysis.tree_walk import blocks, clauses, statements
from rapidsim.diagnostics import Related
from rapidsim.library.traits import NO_TRAITS, Trait
from rapidsim.syntax import tree

_MAY_FOLLOW = NORMAL | EdgeKind.TRYNEXT | EdgeKind.UNREAD
"""Edges that make a statement reachable."""
_TRANSFERRING = Trait.LEAVE | Trait.NEXT_TURN


_TRANSFERS = frozenset(
    {
        *(tree.Return, tree.Raise, tree.Exit, tree.Goto, tree.Label, tree.While),
        *(tree.Retry, tree.TryNext, tree.InvalidStatement, tree.Placeholder),
    }
)
"""Kinds of statements without which control simply continues."""


def check_flow(routine: tree.Routine, context: Context) -> None:
    """Check one routine with all its clauses."""
    # Most routines have few kinds of statements, and need few of the checks.
    nodes = context.analysis.nodes_of(routine)
    kinds = nodes.keys()
    called = set(map(context.analysis.symbol_of.get, nodes.all(tree.Call)))
    traits = reduce(or_, map(does, called), NO_TRAITS)
    is_function = isinstance(routine, tree.Func)
    if tree.Data in kinds:
        _check_declarations(routine, context)
    if Trait.RETRY in traits or not kinds.isdisjoint({tree.Retry, tree.TryNext, tree.Raise}):
        _check_answers(routine, context)
    if is_function or tree.Return in kinds:
        _check_returns(routine, context)
    if not kinds.isdisjoint({tree.Label, tree.Goto}):
        _check_labels(routine, context)
    if Trait.NEXT_TURN in traits:
        for body in clauses(routine):
            _check_next_turns(body, context)
    if traits & _TRANSFERRING or not kinds.isdisjoint(_TRANSFERS):
        graph = _flow(routine, context)
        reached = graph.reached(_MAY_FOLLOW, graph.entries)
        for body in clauses(routine):
            _check_reached(body, graph, reached, context)


def _flow(routine: tree.Routine, context: Context) -> ControlFlowGraph:
    functions = context.analysis.nodes_of(routine).all(tree.FunctionCall)
    return control_flow(context.analysis, routine, functions)


def _check_declarations(routine: tree.Routine, context: Context) -> None:
    """Report declarations after the first statement of the routine's body."""
    in_front = True
    for statement in routine.body:
        if isinstance(statement, tree.Data):
            if not in_front:
                where = "after the first statement of the routine"
                context.report(LateDataDeclaration(statement.name.text, where), statement)
        else:
            # The unread text may have been a declaration.
            in_front = in_front and isinstance(statement, tree.InvalidStatement)
    nested = [part for statement in routine.body for part in blocks(statement)]
    handlers = [body for body in clauses(routine) if body is not routine.body]
    for node in statements(*nested, *handlers):
        if isinstance(node, tree.Data):
            context.report(LateDataDeclaration(node.name.text, "inside a block"), node)


def _check_answers(routine: tree.Routine, context: Context) -> None:
    """Report RETRY, TRYNEXT and RAISE outside of ERROR clauses."""
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
    """Report a CONTINUE outside loops."""
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
    if isinstance(routine, tree.Func) and _can_complete(_flow(routine, context)):
        closing = tree.Node(max(routine.start, routine.end - len("ENDFUNC")), routine.end)
        context.report(
            MissingReturn(routine.name.text, routine.type.text),
            closing,
            Related(context.module.span(routine.name), "the function begins here"),
        )
    handler = routine.error if isinstance(routine, tree.Func) else None
    if handler is not None and not any(depends_on_error(one) for one in statements(handler.body)):
        # A clause that selects by ERRNO may be complete for the errors that occur.
        assert isinstance(routine, tree.Func)
        graph = _flow(routine, context)
        if graph.handler is not None and _can_complete(graph, graph.handler):
            missing = MissingReturn(routine.name.text, routine.type.text, is_clause=True)
            context.report(missing, handler)


def _check_reached(
    body: tree.Body, graph: ControlFlowGraph, reached: Container[int], context: Context
) -> None:
    """Report the first of consecutive unreachable statements of a list.

    Args:
        body: A statement list that control enters.
        graph: The control flow of its routine.
        reached: The blocks that control enters.
        context: Receives the findings.
    """
    last: tree.Statement | None = None
    for position, statement in enumerate(body):
        if graph.block_of[statement] in reached:
            last = statement
            for block in blocks(statement):
                _check_reached(block, graph, reached, context)
        elif last is not None:
            unreached = takewhile(lambda one: graph.block_of[one] not in reached, body[position:])
            # A RETURN after an endless loop is a precaution.
            if not all(isinstance(one, tree.Return | tree.Empty) for one in unreached):
                place = Related(context.module.span(last), "control never continues past this")
                context.report(UnreachableCode(), statement, place)
            last = None


def _can_complete(graph: ControlFlowGraph, start: int = ENTRY) -> bool:
    """Whether control can reach the end of a clause's text from a block without a RETURN."""
    return any(
        edge.to == EXIT and edge.by is None
        for index in graph.reached(NORMAL, (start,))
        for edge in graph.blocks[index].edges
    )


def _check_labels(routine: tree.Routine, context: Context) -> None:
    """Report jumps into a block; jumps out of one are valid."""
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
