"""Instructions translated as statements: `Incr x` becomes `x := x + 1`.

As calls they would take their variable by reference, which moves a local variable into a cell.
For an element or a component they remain calls. StartMoveRetry is a call and a RETRY.

Source: Technical reference manual RAPID Instructions, Functions and Data types: Clear, Decr, Incr.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping
from types import MappingProxyType

from rapidsim.analysis.program import LibrarySymbol, Program, does
from rapidsim.interpreter.codegen.ast_builder import AstBuilder
from rapidsim.interpreter.codegen.data_access import DataPathTranslator, number
from rapidsim.interpreter.codegen.expression_code import (
    Code,
    DeferredCheck,
    finished,
    finished_integer,
)
from rapidsim.interpreter.codegen.intervals import ONE, combined
from rapidsim.interpreter.codegen.operands import Operands
from rapidsim.interpreter.codegen.written_paths import bare, declaration
from rapidsim.language.types import DNUM, resolved
from rapidsim.library.mathematics import clear, decr, incr
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree

_STEPS: Mapping[Callable[..., object], str | None] = MappingProxyType(
    {clear: None, decr: "-", incr: "+"}
)
"""Operator that combines the variable with 1, by function; None sets it to 0."""


def assigned_in_place(call: tree.Call, program: Program) -> tree.DataReference | None:
    """The variable that such an instruction assigns; None for other calls and other data."""
    symbol = program.symbol_of[call]
    if not isinstance(symbol, LibrarySymbol) or symbol.routine.function not in _STEPS:
        return None
    first = call.arguments[0]
    value = bare(first.value) if isinstance(first, tree.RequiredArgument) else None
    return value if isinstance(value, tree.DataReference) else None


def step_in_place(call: tree.Call, program: Program) -> str | None:
    """The operator that combines the variable of such a call with 1; None if it is set to 0."""
    symbol = program.symbol_of[call]
    assert isinstance(symbol, LibrarySymbol)
    return _STEPS[symbol.routine.function]


def is_start_move_retry(call: tree.Call, program: Program) -> bool:
    """Whether a call is StartMoveRetry, which ends an ERROR clause as RETRY does."""
    return Trait.RETRY in does(program.symbol_of[call])


def value_in_place(
    call: tree.Call,
    variable: tree.DataReference,
    expressions: Operands,
    paths: DataPathTranslator,
    at: AstBuilder,
) -> Code:
    """The value that it assigns."""
    step = step_in_place(call, expressions.program)
    declared = declaration(variable, expressions.program)
    kept = None if declared is None else expressions.integers.get(declared)
    if step is None:
        zero = number(0.0, at)
        return zero if kept is None else finished_integer(zero, at)
    old = paths.read(variable)
    operator = ast.Add() if step == "+" else ast.Sub()
    if kept is not None:
        node = at.operation(old.node, operator, at.constant(1))
        integer = combined(step, kept, ONE)
        return finished_integer(Code(node, DeferredCheck.SINGLE, integer=integer), at)
    node = at.operation(old.node, operator, at.constant(1.0))
    # Adding or subtracting 1 cannot leave the range of either type.
    is_dnum = resolved(paths.type_of(variable)) == DNUM
    owed = DeferredCheck.NOTHING if is_dnum else DeferredCheck.SINGLE
    return finished(Code(node, owed, old.may_raise), at)
