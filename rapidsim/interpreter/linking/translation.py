"""Translation of a program to Python syntax trees, one per module, with bindings of their names.

The translation is independent of tasks; `loader` adds the bindings of one.
"""

from __future__ import annotations

import ast
import math
from collections.abc import Mapping, Sequence, Set

from rapidsim.analysis.program import DataSymbol, Program, RoutineSymbol, Storage
from rapidsim.analysis.tree_walk import data_of
from rapidsim.interpreter.codegen.ast_builder import Positions
from rapidsim.interpreter.codegen.call_ticks import ticking
from rapidsim.interpreter.codegen.expressions import Expressions
from rapidsim.interpreter.codegen.integer_inference import integers_of
from rapidsim.interpreter.codegen.intervals import Interval
from rapidsim.interpreter.codegen.local_ticks import count_locally
from rapidsim.interpreter.codegen.names import Binding, LocalNames, ModuleNames
from rapidsim.interpreter.codegen.persistent_parameters import persistent_parameters
from rapidsim.interpreter.codegen.routines import (
    ModuleContext,
    TranslatedRoutine,
    translate_routine,
)
from rapidsim.interpreter.limits import (
    MAX_ARRAY_BYTES,
    TRANSLATING_DEPTH,
    NotExecutableError,
    element_bytes,
    recursion_limit,
)
from rapidsim.interpreter.linking.constants import Constants
from rapidsim.interpreter.runtime.memory import initial_literal
from rapidsim.language.initial_values import initial_value
from rapidsim.language.types import ArrayOf, resolved
from rapidsim.syntax import tree
from rapidsim.values import value_class

INITIALISE = "_initialise"
"""The function that assigns initial values of module variables that are not literals."""


@value_class(frozen=True, slots=True)
class TranslatedModule:
    """The code of one module, and the bindings of its namespace."""

    module: tree.Module
    code: ast.Module
    bindings: Mapping[str, Binding]
    functions: Mapping[str, RoutineSymbol]
    """The module's routines by the name of their function."""
    shown_as: Mapping[str, str]
    """Displayed name, in call stack, debugger and profiler, of functions for a routine or a clause,
    by their name in the namespace.
    """
    computing: Set[str]
    """Names of installed functions that are quick and do not use the controller."""
    long_jumps: tuple[tuple[str, str], ...]
    """Pairs of function names: one with a long-jump ERROR clause, one returning its numbers."""


@value_class(frozen=True, slots=True)
class Translation:
    """A translated program."""

    modules: tuple[TranslatedModule, ...]
    constants: Constants
    integers: Mapping[tree.Node, Interval]
    """Inferred integers: functions and their callers must agree on them."""
    persistents: Set[tree.Node]
    """Parameters that may be bound to a persistent; functions and their callers must agree."""


def translate(
    program: Program, modules: Sequence[tree.Module] | None = None, *, shares: bool = False
) -> Translation:
    """Translate modules of a program.

    Args:
        program: The program, with everything that the modules refer to.
        modules: The modules to translate; None for all.
        shares: Whether other tasks, which read its clock, may share data with it.

    Raises:
        NotExecutableError: If the program needs something that cannot be simulated.
        RapidError: If the expression of a constant fails.
    """
    _refuse_huge_arrays(program)
    constants = Constants(program)
    with recursion_limit(TRANSLATING_DEPTH):
        routines: dict[RoutineSymbol, TranslatedRoutine] = {}
        integers = integers_of(program, constants.value_of)
        persistents = persistent_parameters(program)
        translated = [
            _translate_module(module, program, constants, integers, persistents, routines)
            for module in (program.modules if modules is None else modules)
        ]
    for symbol in ticking({symbol: one.callees for symbol, one in routines.items()}):
        routines[symbol].function.body[:0] = routines[symbol].tick
    if not shares:
        for module in translated:
            functions = [one for one in module.code.body if isinstance(one, ast.FunctionDef)]
            count_locally(functions, module.computing)
    return Translation(tuple(translated), constants, integers, persistents)


def show_python(program: Program) -> str:
    """The Python code generated for a program, for defect reports and tests."""
    parts = []
    for module in translate(program).modules:
        parts.append(f"# {module.module.name.text}: {module.module.source.file}")
        parts.append(ast.unparse(module.code))
    return "\n\n".join(parts) + "\n"


def _translate_module(
    module: tree.Module,
    program: Program,
    constants: Constants,
    integers: Mapping[tree.Node, Interval],
    persistents: Set[tree.Node],
    routines: dict[RoutineSymbol, TranslatedRoutine],
) -> TranslatedModule:
    """Translate a module; its routines are added to `routines`."""
    names = ModuleNames(module)
    positions = Positions(module.source)
    context = ModuleContext(program, names, positions, constants.value_of, integers, persistents)
    functions: dict[str, RoutineSymbol] = {}
    body: list[ast.stmt] = []
    long_jumps = []
    shown_as: dict[str, str] = {}
    for routine in module.routines:
        symbol = program.symbol_of[routine]
        assert isinstance(symbol, RoutineSymbol)
        translated = routines[symbol] = translate_routine(symbol, context)
        functions[translated.function.name] = symbol
        body.append(translated.function)
        if translated.handler is not None:
            body.append(translated.handler)
            shown_as[translated.handler.name] = f"{translated.function.name}.ERROR"
        if translated.numbers is not None:
            body.append(translated.numbers)
            long_jumps.append((translated.function.name, translated.numbers.name))
    # These routines call no others, so the loop adds no elements.
    for (symbol, parameters), name in names.for_elements.items():
        body.append(translate_routine(symbol, context, parameters).function)
        shown_as[name] = names.routine(symbol)
    initialise = _initialise(module, context)
    if initialise is not None:
        body.append(initialise)
    code = ast.Module(body, [])
    return TranslatedModule(
        module,
        code,
        names.bindings,
        functions,
        shown_as,
        names.computing,
        tuple(long_jumps),
    )


def _refuse_huge_arrays(program: Program) -> None:
    declared_bytes = 0
    for module in program.modules:
        for data in data_of(module):
            symbol = program.symbol_of[data]
            of = resolved(symbol.type) if isinstance(symbol, DataSymbol) else None
            if not isinstance(of, ArrayOf):
                continue
            elements = math.prod(size or 0 for size in of.dimensions)
            declared_bytes += elements * element_bytes(initial_value(of.element))
            if declared_bytes > MAX_ARRAY_BYTES:
                raise NotExecutableError(
                    f"the array `{data.name.text}` of {elements} elements, with more than "
                    f"{MAX_ARRAY_BYTES // 1_000_000} MB in all arrays together,",
                    module.span(data.name),
                )


def _initialise(module: tree.Module, context: ModuleContext) -> ast.FunctionDef | None:
    names = LocalNames(context.names, "")
    expressions = Expressions(
        context.program,
        names,
        context.positions,
        module,
        context.constant_value,
        context.integers,
    )
    statements: list[ast.stmt] = []
    for item in module.items:
        if not isinstance(item, tree.Data) or item.storage == "CONST" or item.value is None:
            continue
        symbol = context.program.symbol_of[item]
        assert isinstance(symbol, DataSymbol)
        if symbol.storage is Storage.CONST or initial_literal(symbol) is not None:
            continue
        at = expressions.statement = context.positions.at(item)
        value = expressions.value(item.value).node
        variable = at.name(context.names.variable(symbol))
        if isinstance(resolved(symbol.type), ArrayOf):
            statements.append(at.do(at.call("_assign_array", [variable, value])))
        else:
            statements.append(at.assign(at.store_attribute(variable, "value"), value))
    if not statements:
        return None
    return context.positions.at(module.name).define(INITIALISE, [], [], statements)
