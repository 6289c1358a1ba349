"""Names and types in statements."""

from __future__ import annotations

from rapidsim.analysis.context import Context, SymbolTable
from rapidsim.analysis.literals import is_signal
from rapidsim.analysis.names.names import find, kind_of, report_undefined
from rapidsim.analysis.parameters import ExpectedType
from rapidsim.analysis.passes.flow_violations import BadConnect
from rapidsim.analysis.program import (
    CounterSymbol,
    DataSymbol,
    ParameterSymbol,
    RoutineSymbol,
    Scope,
    Storage,
)
from rapidsim.analysis.tree_walk import clauses
from rapidsim.analysis.types.argument_violations import BadArgumentMode
from rapidsim.analysis.types.assignability import require, require_value
from rapidsim.analysis.types.calls import check_call, check_unbound
from rapidsim.analysis.types.data_paths import root_of, type_of_target
from rapidsim.analysis.types.error_numbers import check_error_number
from rapidsim.analysis.types.expressions import type_of_expression
from rapidsim.analysis.types.operators import value_type
from rapidsim.language import types
from rapidsim.language.types import Kind, resolved
from rapidsim.library.predefined import TYPES
from rapidsim.syntax import tree

_STRING = ExpectedType(types.STRING, "a call by name")
_ERROR_NUMBER = ExpectedType(types.NUM, "RAISE")
_HANDLED_NUMBER = ExpectedType(types.NUM, "the list of ERROR")


def check_routine_body(routine: tree.Routine, context: Context) -> None:
    """Check the body of a routine and its clauses."""
    for body in clauses(routine):
        check_body(body, context)
    numbers = None if routine.error is None else routine.error.numbers
    for number in numbers or ():
        require(number, _HANDLED_NUMBER, context, type_of_expression)


def check_body(body: tree.Body, context: Context) -> None:
    """Check a statement list and its nested blocks."""
    for statement in body:
        _check_statement(statement, context)


def _check_statement(statement: tree.Statement, context: Context) -> None:
    match statement:
        case tree.Assignment():
            _check_assignment(statement, context)
        case tree.Call():
            check_call(statement, context, type_of_expression)
        case tree.LateCall(routine=routine, arguments=arguments):
            require(routine, _STRING, context, type_of_expression)
            check_unbound(arguments, context, type_of_expression, is_skipped=False)
        case tree.If(branches=branches, otherwise=otherwise):
            for branch in branches:
                _check_condition(branch.condition, "IF", context)
                check_body(branch.body, context)
            check_body(otherwise or (), context)
        case tree.CompactIf(condition=condition, statement=inner):
            _check_condition(condition, "IF", context)
            _check_statement(inner, context)
        case tree.While(condition=condition, body=body):
            _check_condition(condition, "WHILE", context)
            check_body(body, context)
        case tree.For():
            _check_for(statement, context)
        case tree.Test():
            _check_test(statement, context)
        case tree.Return(value=value):
            _check_return(value, context)
        case tree.Raise(number=tree.Node() as number):
            require(number, _ERROR_NUMBER, context, type_of_expression)
        case tree.Connect():
            _check_connect(statement, context)
        case _:
            # The rest has no names: declarations are checked elsewhere.
            pass


def _check_condition(condition: tree.Expression, word: str, context: Context) -> None:
    wanted = ExpectedType(types.BOOL, f"the condition of {word}")
    require(condition, wanted, context, type_of_expression)


def _check_assignment(statement: tree.Assignment, context: Context) -> None:
    target = statement.target
    if isinstance(target, tree.Placeholder):
        type_of_expression(statement.value, context, None)
        return
    of = type_of_target(target, context, type_of_expression)
    if of is None:
        if isinstance(statement.value, tree.Aggregate | tree.LiteralAggregate):
            # The types of its elements depend on the unknown type of the target.
            context.analysis.runs = False
        else:
            type_of_expression(statement.value, context, None)
        return
    if is_signal(of):
        # A signal can be read as a number, but only instructions set it.
        require_value(target, types.Atomic(of.name, Kind.NON_VALUE), "assigned", context)
    elif require_value(target, of, "assigned", context):
        declared = context.declaration(find(root_of(target).name.key, context))
        wanted = ExpectedType(of, f"`{context.module.span(target).one_line}`", declared)
        require(statement.value, wanted, context, type_of_expression)


def _check_for(statement: tree.For, context: Context) -> None:
    wanted = ExpectedType(types.NUM, "FOR")
    for part in (statement.first, statement.last, statement.step):
        if part is not None:
            require(part, wanted, context, type_of_expression)
    symbol = CounterSymbol(statement.counter.text, statement)
    context.analysis.symbol_of[statement] = symbol
    context.analysis.module_of[symbol] = context.module
    scope = SymbolTable({statement.counter.key: symbol}, context.scope)
    check_body(statement.body, context.inside(scope))


def _check_test(statement: tree.Test, context: Context) -> None:
    subject = type_of_expression(statement.subject, context, None)
    if subject is not None and not require_value(statement.subject, subject, "tested", context):
        subject = None
    wanted = None if subject is None else ExpectedType(value_type(subject), "a CASE of this TEST")
    for case in statement.cases:
        ends = (case.range_to,) if case.range_to is not None else ()
        for value in (*case.values, *ends):
            check_error_number(statement.subject, value, context)
            if wanted is not None:
                require(value, wanted, context, type_of_expression)
            elif not isinstance(value, tree.Aggregate | tree.LiteralAggregate):
                type_of_expression(value, context, None)
        check_body(case.body, context)
    check_body(statement.default or (), context)


def _check_return(value: tree.Expression | None, context: Context) -> None:
    routine = context.routine
    if value is None or routine is None:
        return
    if routine.result is None:
        # The flow check reports procedures that return a value.
        if not isinstance(value, tree.Aggregate | tree.LiteralAggregate):
            type_of_expression(value, context, None)
        return
    declared = context.declaration(routine)
    wanted = ExpectedType(routine.result, f"RETURN in `{routine.name}`", declared)
    require(value, wanted, context, type_of_expression)


def _check_connect(statement: tree.Connect, context: Context) -> None:
    interrupt = statement.interrupt
    if not isinstance(interrupt, tree.Placeholder):
        of = type_of_target(interrupt, context, type_of_expression)
        symbol = find(root_of(interrupt).name.key, context)
        by = "CONNECT"
        if of is not None and resolved(of) != resolved(TYPES["intnum"]):
            written = context.module.span(interrupt).one_line
            violation = BadConnect("a variable of type intnum", written, of.name)
            context.report(violation, interrupt, *context.declaration(symbol))
        elif isinstance(symbol, DataSymbol) and symbol.scope is Scope.ROUTINE:
            wanted = "an interrupt variable of a module, which outlives the routine"
            violation = BadConnect(wanted, symbol.name, "declared in the routine")
            context.report(violation, interrupt, *context.declaration(symbol))
        elif isinstance(symbol, DataSymbol) and symbol.storage is Storage.PERS:
            mode = BadArgumentMode(by, "a variable", f"`{symbol.name}` is {kind_of(symbol)}")
            context.report(mode, interrupt, *context.declaration(symbol))
    trap = statement.trap
    if not isinstance(trap, tree.Name):
        require(trap, ExpectedType(types.STRING, "a trap by name"), context, type_of_expression)
        return
    routine = find(trap.key, context)
    if routine is None:
        report_undefined(trap, context, kind="trap")
    elif isinstance(routine, RoutineSymbol) and isinstance(routine.node, tree.Trap):
        context.analysis.symbol_of[statement] = routine
    elif not isinstance(routine, ParameterSymbol):
        violation = BadConnect("the name of a TRAP", trap.text, kind_of(routine))
        context.report(violation, trap, *context.declaration(routine))
