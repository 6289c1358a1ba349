"""One RAPID routine as one Python function.

With all its clauses:

    def weld(b):
        def ERROR(_e): ...
        def _undo(): ...
        try:
            try:
                <statements>
            except BaseException as _u:
                _leave_routine(_u, _undo)
                raise
        except _Leave as _l:
            return _l.value

The ERROR clause keeps its RAPID keyword as name: program names are folded to lower case, so none
clashes. `HandlerReturn` is a RETURN in it. A clause that uses no local names is a separate
function, created once and not per call; the routine then begins with `ERROR = _ERROR_weld`.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping, Set

from rapidsim.analysis.error_clauses import Answers, answers
from rapidsim.analysis.program import (
    DataSymbol,
    LibrarySymbol,
    ParameterSymbol,
    Program,
    RoutineSymbol,
    Scope,
    Storage,
    Symbol,
    does,
)
from rapidsim.analysis.tree_walk import descendants
from rapidsim.interpreter.codegen.ast_builder import AstBuilder, Positions
from rapidsim.interpreter.codegen.call_ticks import Callees, callees, tick
from rapidsim.interpreter.codegen.escape_analysis import lent_symbols
from rapidsim.interpreter.codegen.expressions import ConstantValue, Expressions
from rapidsim.interpreter.codegen.goto import Jumps, goto_targets
from rapidsim.interpreter.codegen.intervals import Interval
from rapidsim.interpreter.codegen.names import ArrayDimension, LocalNames, ModuleNames
from rapidsim.interpreter.codegen.statements import ANSWERED, Statements
from rapidsim.interpreter.limits import NotExecutableError
from rapidsim.interpreter.runtime.references import position_of
from rapidsim.language.controller import STUB
from rapidsim.language.moves import Place
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class TranslatedRoutine:
    """The Python functions of one routine."""

    function: ast.FunctionDef
    handler: ast.FunctionDef | None
    """Its ERROR clause, if that is a separate function."""
    numbers: ast.FunctionDef | None
    """Function that returns the error numbers of a long-jump ERROR clause."""
    callees: Callees
    tick: list[ast.stmt]
    """Statements to insert at the start of the function if its calls take a tick."""


@value_class(frozen=True, slots=True)
class ModuleContext:
    """Context shared by the translations of all routines of a module."""

    program: Program
    names: ModuleNames
    positions: Positions
    constant_value: ConstantValue
    integers: Mapping[tree.Node, Interval]
    persistents: Set[tree.Node]


def translate_routine(
    symbol: RoutineSymbol,
    context: ModuleContext,
    elements: frozenset[ParameterSymbol] = frozenset(),
) -> TranslatedRoutine:
    """Translate a routine with its ERROR and UNDO clauses; BACKWARD is never executed.

    Args:
        symbol: The routine.
        context: Context shared by the routines of its module.
        elements: Parameters to pass as an array and an index in it.
    """
    return _RoutineTranslation(symbol, context, elements).translate()


class _RoutineTranslation:
    def __init__(
        self,
        symbol: RoutineSymbol,
        context: ModuleContext,
        elements: frozenset[ParameterSymbol],
    ) -> None:
        self._symbol = symbol
        self._node = symbol.node
        self._context = context
        self._nodes = list(descendants(symbol.node))
        self._names = LocalNames(
            context.names,
            symbol.name,
            symbol.parameters,
            in_cell=frozenset(lent_symbols(symbol, self._nodes, context.program)),
            elements=elements,
        )
        self._expressions = Expressions(
            context.program,
            self._names,
            context.positions,
            symbol.module,
            context.constant_value,
            context.integers,
        )
        self._header = context.positions.between(self._node.start, self._node.header_end)

    def translate(self) -> TranslatedRoutine:
        parameters = self._declare()
        at = self._header
        self._expressions.statement = at
        handler = self._handler()
        undo = self._undo()
        body = self._statements(self._node.body, is_protected=handler is not None)
        if self._symbol.result is not None and not _ends_in_return(body):
            body.append(self._without_value())
        if undo is not None:
            leave = at.do(at.call("_leave_routine", [at.name("_u"), at.name("_undo")]))
            body = [at.attempt(body, at.name("_BaseException"), "_u", [leave, at.throw()])]
        names = self._context.names
        name = names.routine(self._symbol)
        clauses: list[ast.stmt] = [clause for clause in (handler, undo) if clause is not None]
        beside = handler if handler is not None and not self._sees_locals(handler) else None
        if beside is not None:
            beside.name = f"_ERROR_{name}"
            clauses[0] = at.set("ERROR", at.name(beside.name))
        if handler is not None:
            value = at.leave(at.attribute("_l", "value"))
            body = [at.attempt(body, at.name("_Leave"), "_l", [value])]
        if self._names.elements:
            name = names.routine_for_elements(self._symbol, self._names.elements)
        function = at.define(name, parameters, [], [*self._prologue(), *clauses, *body])
        called = callees(self._nodes, self._context.program)
        return TranslatedRoutine(function, beside, self._numbers(name), called, tick(at))

    def _declare(self) -> list[str]:
        """Assign names to the variables, distinct from the module names that the routine uses."""
        nodes = self._nodes
        used = {id(s): s for s in map(self._context.program.symbol_of.get, nodes) if s is not None}
        self._names.reserved = frozenset(
            name for symbol in used.values() if (name := self._module_name(symbol)) is not None
        )
        parameters = []
        for parameter in self._symbol.parameters:
            name = self._names.declare(parameter, parameter.name)
            both = parameter in self._names.elements
            parameters += [name, position_of(name)] if both else [name]
        for node in nodes:
            if isinstance(node, tree.Data) and node.storage == "VAR":
                self._names.declare(self._context.program.symbol_of[node], node.name.text)
        return parameters

    def _module_name(self, symbol: Symbol) -> str | None:
        """Name in the module's namespace of a symbol that is not local to the routine."""
        names = self._context.names
        match symbol:
            case RoutineSymbol():
                return names.routine(symbol)
            case LibrarySymbol(routine=routine):
                return names.library(routine)
            case DataSymbol(storage=Storage.CONST):
                value = self._context.constant_value(symbol)
                plain = isinstance(value, float | str | bool)
                return None if plain else names.constant_data(symbol, value)
            case DataSymbol(scope=scope) if scope is not Scope.ROUTINE:
                return names.variable(symbol)
            case _:
                return None

    def _prologue(self) -> Iterator[ast.stmt]:
        """Create cells for parameters passed by reference, and tables for arrays of the caller."""
        at = self._header
        if self._symbol.module.source.file in self._context.program.cell.stubs:
            yield self._stub(at)
        for symbol in self._symbol.parameters:
            name = self._names.get(symbol)
            if symbol in self._names.in_cell and name is not None:
                node: ast.expr = at.call("_Box", [at.name(name)])
                if symbol.optional:
                    present = at.compare(at.name(name), (ast.IsNot(), at.name("_ABSENT")))
                    node = at.choice(present, node, at.name("_ABSENT"))
                yield at.set(name, node)
        for name, dimension in self._names.sizes.items():
            yield at.set(name, _size(dimension, at))
        for name, dimension in self._names.tables.items():
            if dimension.optional:
                arguments = [at.name(dimension.array), at.constant(dimension.depth)]
                yield at.set(name, at.call("_index_table_of", arguments))
            else:
                yield at.set(name, at.item("_index_tables", _size(dimension, at)))

    def _stub(self, at: AstBuilder) -> ast.stmt:
        """Report that the routine is a stub."""
        span = self._symbol.module.span(self._node.name)
        place = self._context.names.place(Place(span, self._symbol.name))
        said = [at.constant(self._symbol.name), at.constant(STUB), at.constant(None)]
        return at.do(at.call("_stand_in", [at.name(place), *said]))

    def _statements(
        self,
        body: tree.Body,
        *,
        is_protected: bool = False,
        in_handler: bool = False,
        answers: Answers | None = None,
    ) -> list[ast.stmt]:
        jumps = Jumps(goto_targets([body]))
        statements = Statements(
            self._expressions,
            jumps,
            self._context.persistents,
            is_protected,
            in_handler,
            routine=self._node,
            answering=answers.statements if answers and self._may_fall_through(answers) else (),
        )
        return statements.body(body)

    def _handler(self) -> ast.FunctionDef | None:
        clause = self._node.error
        if clause is None:
            return None
        return self._clause("ERROR", ["_e"], clause.body, in_handler=True)

    def _undo(self) -> ast.FunctionDef | None:
        if self._node.undo is None:
            return None
        return self._clause("_undo", [], self._node.undo, in_handler=False)

    def _clause(
        self, name: str, parameters: list[str], body: tree.Body, *, in_handler: bool
    ) -> ast.FunctionDef:
        """Translate a clause to a function inside the routine's, with access to its variables.

        It has the line of the header: on its own line it would look executed in each call.
        """
        at = self._header
        self._names.assigned.clear()
        ends = answers(body, self._effects) if in_handler else None
        statements = self._statements(body, in_handler=in_handler, answers=ends)
        if ends is not None and not _ends_in_return(statements):
            statements.append(self._fall_off(at, ends))
            if self._may_fall_through(ends):
                statements.insert(0, at.set(ANSWERED, at.constant(False)))
        if self._names.assigned:
            statements.insert(0, at.outer(sorted(self._names.assigned)))
        return at.define(name, parameters, [], statements)

    def _effects(self, call: tree.Node) -> Trait:
        return does(self._context.program.symbol_of.get(call))

    def _may_fall_through(self, ends: Answers) -> bool:
        """Whether some errors fall through a clause and others do not."""
        return self._symbol.result is None and not ends.every and bool(ends.statements)

    def _sees_locals(self, clause: ast.FunctionDef) -> bool:
        """Whether a clause uses any variable of the routine's function."""
        used = {node.id for node in ast.walk(clause) if isinstance(node, ast.Name)}
        return not used.isdisjoint(self._names.data_variables())

    def _without_value(self) -> ast.stmt:
        """Raise for a function that ends without a value, or for its ERROR clause."""
        end = self._context.positions.between(self._node.end - 1, self._node.end)
        return end.throw(end.call("_no_return", [end.constant(self._symbol.name)]))

    def _fall_off(self, at: AstBuilder, ends: Answers) -> ast.stmt:
        """End the routine at the end of its ERROR clause; a function lacks its value then."""
        if self._symbol.result is not None:
            return self._without_value()
        answered = at.call("_Leave", [at.constant(None)])
        dropped = at.call("_FellThrough", [at.constant(None)])
        if self._may_fall_through(ends):
            return at.throw(at.choice(at.name(ANSWERED), answered, dropped))
        return at.throw(answered if ends.every else dropped)

    def _numbers(self, name: str) -> ast.FunctionDef | None:
        clause = self._node.error
        if clause is None or not clause.numbers:
            return None
        for number in clause.numbers:
            for node in descendants(number):
                symbol = self._context.program.symbol_of.get(node)
                if symbol is not None and self._names.get(symbol) is not None:
                    raise NotExecutableError(
                        "an ERROR clause with the number in a local variable",
                        self._expressions.span(number),
                    )
        at = self._header
        nodes = [self._expressions.value(number).node for number in clause.numbers]
        return at.define(f"_numbers_{name}", [], [], [at.leave(at.tuple_of(nodes))])


def _size(dimension: ArrayDimension, at: AstBuilder) -> ast.expr:
    rows: ast.expr = at.name(dimension.array)
    for _ in range(dimension.depth):
        rows = at.item(rows, at.constant(0))
    return at.call("_len", [rows])


def _ends_in_return(body: list[ast.stmt]) -> bool:
    return bool(body) and isinstance(body[-1], ast.Return | ast.Raise)
