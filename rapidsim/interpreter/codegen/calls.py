"""Calls in generated code: matching arguments to parameters, reporting positions, special forms.

User routines take all their parameters by position, `ABSENT` for absent options.
Library functions take required parameters by position and options by keyword. A call that reports
to the controller first sets the position of the statement.
"""

from __future__ import annotations

import ast
from collections.abc import Sequence
from itertools import islice

from rapidsim.analysis.literals import is_signal
from rapidsim.analysis.program import (
    LibrarySymbol,
    ParameterSymbol,
    Program,
    RoutineSymbol,
    Symbol,
    UnknownSymbol,
)
from rapidsim.analysis.tree_walk import descendants
from rapidsim.interpreter.codegen.ast_builder import AstBuilder
from rapidsim.interpreter.codegen.bound_arguments import BoundArgument, match_arguments
from rapidsim.interpreter.codegen.data_access import DataPathTranslator, by_reference
from rapidsim.interpreter.codegen.expression_code import Code
from rapidsim.interpreter.codegen.inlined_functions import function_in_place
from rapidsim.interpreter.codegen.operands import Operands
from rapidsim.interpreter.codegen.special_forms import SPECIAL_FORMS
from rapidsim.interpreter.codegen.written_paths import bare
from rapidsim.interpreter.limits import NotExecutableError
from rapidsim.interpreter.runtime.bulk_execution import ROW, BulkExecution
from rapidsim.interpreter.runtime.late_binding import DeferredArgument
from rapidsim.interpreter.runtime.loaded_calls import may_be_loaded
from rapidsim.language.annotations import ParameterMode
from rapidsim.language.initial_values import initial_value
from rapidsim.language.moves import Place
from rapidsim.language.types import NUM, ArrayOf, Type, resolved
from rapidsim.library.table import LibraryRoutine, Parameter, Signature
from rapidsim.library.text import value_text
from rapidsim.library.traits import ONLY_LOOKS, Trait
from rapidsim.syntax import tree

_SMALL = 60
"""Maximum number of nodes of a small routine."""


def takes_elements(routine: RoutineSymbol, program: Program) -> bool:
    """Whether a routine is small enough for a variant that takes array elements to pay off."""
    if routine.node.error is not None or routine.node.undo is not None:
        return False
    nodes = list(islice(descendants(routine.node), _SMALL + 1))
    calls = (node for node in nodes if isinstance(node, tree.Call | tree.FunctionCall))
    return (
        len(nodes) <= _SMALL
        and not any(isinstance(node, tree.LateCall) for node in nodes)
        and all(_only_takes_values(program.symbol_of[call]) for call in calls)
    )


def _only_takes_values(callee: Symbol) -> bool:
    """Whether a callee takes all its arguments by value."""
    return isinstance(callee, LibrarySymbol) and all(
        parameter.mode is ParameterMode.IN for parameter in callee.routine.signature.parameters
    )


class Calls:
    """Translates the calls of one routine."""

    def __init__(self, expressions: Operands, paths: DataPathTranslator) -> None:
        """Translate with the names and the position of `expressions`."""
        self._expressions = expressions
        self._paths = paths
        self._names = expressions.names
        self._program = expressions.program

    def function(self, call: tree.FunctionCall) -> Code:
        """A function call as a value."""
        at = self._expressions.at(call)
        match self._program.symbol_of[call]:
            case RoutineSymbol() as symbol:
                return self._user(symbol, call.arguments, at)
            case LibrarySymbol(routine=routine):
                form = SPECIAL_FORMS.get(routine.name.lower())
                if form is not None:
                    return form(self._expressions, self._paths, call, at)
                return self._library_function(routine, call, at)
            case UnknownSymbol(name=name):
                value = self._initial_value(call)
                place = at.name(self._place(call, {}))
                instead = at.constant(self._taken_for(call, value))
                constant = at.name(self._names.module.constant(value))
                node: ast.expr = at.call("_stand_in", [place, at.constant(name), instead, constant])
                fails = self._program.cell.stops_at_unresolved
                if fails:
                    node = at.call("_unresolved_function", [at.constant(name)])
                if name.lower() in self._program.missing_data:
                    node, fails = self._missing_data(name, at), True
                elif may_be_loaded(call, self._program):
                    of = at.name(self._names.module.numbered("_type", self._program.type_of[call]))
                    late = self._late_arguments(call, at.constant(name), at)
                    node, fails = at.call("_loaded_function", [*late, of, at.deferred(node)]), True
                return Code(node, may_raise=fails, calls=True)
            case _:
                raise NotExecutableError(
                    f"a call of `{call.name.text}`, which is not a function,",
                    self._expressions.span(call),
                )

    def procedure(self, call: tree.Call, at: AstBuilder) -> list[ast.stmt]:
        """A procedure or instruction call as statements."""
        match self._program.symbol_of[call]:
            case RoutineSymbol() as symbol:
                return [at.do(self._user(symbol, call.arguments, at).node)]
            case LibrarySymbol(routine=routine) if Trait.CALL_BY_NAME in routine.traits:
                return self._call_by_var(routine, call, at)
            case LibrarySymbol(routine=routine):
                return self._instruction(routine, call, at)
            case UnknownSymbol(name=name):
                if name.lower() in self._program.missing_data:
                    return [at.do(self._missing_data(name, at))]
                if may_be_loaded(call, self._program):
                    late = self._late_arguments(call, at.constant(name), at)
                    form = "_late" if self._program.cell.stops_at_unresolved else "_loaded"
                    return [at.do(at.call(form, late))]
                if self._program.cell.stops_at_unresolved:
                    return [at.do(at.call("_unresolved_procedure", [at.constant(name)]))]
                place = at.name(self._place(call, {}))
                return [at.do(at.call("_skip", [place, at.constant(name)]))]
            case _:
                raise NotExecutableError(
                    f"a call of `{call.name.text}`, which is not a procedure,",
                    self._expressions.span(call),
                )

    def _missing_data(self, name: str, at: AstBuilder) -> ast.expr:
        why = self._program.missing_data[name.lower()]
        return at.call("_unresolved_data", [at.constant(name), at.constant(why)])

    def late(self, call: tree.LateCall, at: AstBuilder) -> list[ast.stmt]:
        """A call of a procedure whose name is a string known at run time."""
        name = self._expressions.value(call.routine).node
        return [at.do(at.call("_late", self._late_arguments(call, name, at)))]

    def _late_arguments(
        self, call: tree.LateCall | tree.Call | tree.FunctionCall, name: ast.expr, at: AstBuilder
    ) -> list[ast.expr]:
        """Position, name, shapes and values of a call whose routine is resolved at run time."""
        shapes: list[DeferredArgument] = []
        values: list[ast.expr] = []
        for argument in call.arguments:
            shape, value = self._late_argument(argument, at)
            shapes.append(shape)
            values.append(value)
        form = at.name(self._names.module.numbered("_arguments", tuple(shapes)))
        place = at.name(self._place(call, {}))
        return [place, name, form, at.tuple_of(values)]

    def _call_by_var(
        self, routine: LibraryRoutine, call: tree.Call, at: AstBuilder
    ) -> list[ast.stmt]:
        """CallByVar: late binding to a name that ends in a number."""
        given = match_arguments(call.arguments, routine.signature.parameters)
        parts = [value for key in ("name", "number") if (value := given[key].value) is not None]
        name = at.call("_numbered_name", [self._expressions.value(part).node for part in parts])
        form = at.name(self._names.module.numbered("_arguments", ()))
        place = at.name(self._place(call, {}))
        return [at.do(at.call("_late", [place, name, form, at.tuple_of([])]))]

    def _user(
        self, symbol: RoutineSymbol, arguments: Sequence[tree.Argument], at: AstBuilder
    ) -> Code:
        given = match_arguments(arguments, symbol.parameters)
        elements = self._elements(symbol, given)
        nodes = {
            parameter.name.lower(): elements[parameter][0]
            if parameter in elements
            else self._argument(parameter, given.get(parameter.name.lower()), at)
            for parameter in symbol.parameters
        }
        self._refuse_two_alternatives(symbol.parameters, given, nodes, at)
        module = self._names.module
        if elements:
            name = module.routine_for_elements(symbol, frozenset(elements))
            values = [
                part
                for parameter in symbol.parameters
                for part in elements.get(parameter, (nodes[parameter.name.lower()],))
            ]
        else:
            name, values = module.routine(symbol), [*nodes.values()]
        integer = self._expressions.integers.get(symbol.node)
        node = at.call(at.name(name), values)
        return Code(node, may_raise=True, calls=True, integer=integer)

    def _elements(
        self, symbol: RoutineSymbol, arguments: dict[str, BoundArgument]
    ) -> dict[ParameterSymbol, tuple[ast.expr, ast.expr]]:
        """Array and index of the elements that a call passes to a small routine.

        Creating a reference to each would cost more than the routine itself.
        """
        found: dict[ParameterSymbol, tuple[ast.expr, ast.expr]] = {}
        if symbol.module is not self._names.module.module:
            return found
        for parameter in symbol.parameters:
            one = arguments.get(parameter.name.lower())
            value = None if one is None or one.value is None else bare(one.value)
            lends = parameter.mode is ParameterMode.INOUT and not parameter.optional
            if lends and isinstance(value, tree.Index) and takes_elements(symbol, self._program):
                element = self._paths.element(value)
                if element is not None:
                    found[parameter] = element
        return found

    def _argument(
        self, parameter: ParameterSymbol, given: BoundArgument | None, at: AstBuilder
    ) -> ast.expr:
        """The argument of a user routine's parameter."""
        if given is None:
            return at.constant(False) if parameter.is_switch else at.name("_ABSENT")
        if given.caller_option is not None:
            return self._forwarded(given.caller_option, parameter.mode, at)
        if given.value is None:
            return at.constant(True)
        value = bare(given.value)
        is_path = isinstance(value, tree.DataReference | tree.Index | tree.ComponentAccess)
        if is_path and (by_reference(parameter.mode) or is_signal(parameter.type)):
            assert isinstance(value, tree.DataReference | tree.Index | tree.ComponentAccess)
            return self._paths.reference(value).node
        return self._expressions.copy(given.value, parameter.node).node

    def _forwarded(self, option: tree.Name, mode: ParameterMode, at: AstBuilder) -> ast.expr:
        r"""The value for `\X?y`: the caller's own option, present or not."""
        symbol = self._caller_option(option)
        name = self._names.get(symbol)
        assert name is not None
        if symbol.is_switch or by_reference(mode) or not self._is_reference(symbol):
            return at.name(name)
        present = at.compare(at.name(name), (ast.IsNot(), at.name("_ABSENT")))
        return at.choice(present, at.attribute(name, "value"), at.name("_ABSENT"))

    def _is_reference(self, symbol: ParameterSymbol) -> bool:
        """Whether a parameter's variable holds a reference other than a list."""
        if isinstance(resolved(symbol.type), ArrayOf):
            return False
        return by_reference(symbol.mode) or symbol in self._names.in_cell

    def _caller_option(self, option: tree.Name) -> ParameterSymbol:
        for symbol in self._names.parameters:
            if symbol.name.lower() == option.key:
                return symbol
        raise NotExecutableError(
            f"a conditional argument of `{option.text}`, which is not an option of this routine,",
            self._expressions.span(option),
        )

    def _refuse_two_alternatives(
        self,
        parameters: Sequence[ParameterSymbol] | Sequence[Parameter],
        arguments: dict[str, BoundArgument],
        nodes: dict[str, ast.expr],
        at: AstBuilder,
    ) -> None:
        """Add a run-time check for options that exclude each other and are present conditionally.

        The last of them is wrapped, so that the others are evaluated before.

        Args:
            parameters: Parameters of the routine.
            arguments: Arguments of the call, by folded parameter name.
            nodes: Nodes of the arguments, by folded parameter name; changed if a check is needed.
            at: Position of the call.
        """
        if not any(one.caller_option for one in arguments.values()):
            return
        groups: dict[int, list[str]] = {}
        for parameter in parameters:
            if parameter.optional and parameter.group and parameter.name.lower() in arguments:
                groups.setdefault(parameter.group, []).append(parameter.name.lower())
        for names in groups.values():
            if len(names) > 1 and any(arguments[name].caller_option for name in names):
                flags = [self._presence(arguments[name], at) for name in names]
                nodes[names[-1]] = at.call("_at_most_one", [nodes[names[-1]], *flags])

    def _presence(self, argument: BoundArgument, at: AstBuilder) -> ast.expr:
        """Whether an argument is present: a conditional one only if the caller's option is."""
        if argument.caller_option is None:
            return at.constant(True)
        symbol = self._caller_option(argument.caller_option)
        name = self._names.get(symbol)
        assert name is not None
        if symbol.is_switch:
            return at.name(name)
        return at.compare(at.name(name), (ast.IsNot(), at.name("_ABSENT")))

    def _library_function(
        self, routine: LibraryRoutine, call: tree.FunctionCall, at: AstBuilder
    ) -> Code:
        signature = routine.signature
        given = match_arguments(call.arguments, signature.parameters)
        function = at.name(self._names.module.library(routine))
        in_place = function_in_place(routine, call, self._expressions, function, at)
        if in_place is not None:
            return in_place
        values, options, calls = self._library_arguments(signature, given, at)
        if not signature.takes_controller:
            return Code(at.call(function, values, options), may_raise=True, calls=calls)
        place, asked = at.name(self._place(call, given)), at.name(f"_{signature.concern}")
        how = "_look_at" if ONLY_LOOKS & routine.traits else "_call_at"
        node = at.call(how, [place, function, asked, *values], options)
        return Code(node, may_raise=True, calls=True)

    def _instruction(
        self,
        routine: LibraryRoutine,
        call: tree.Call,
        at: AstBuilder,
        place: ast.expr | None = None,
    ) -> list[ast.stmt]:
        """A call of an instruction, reported at a place; None: at its own."""
        signature = routine.signature
        arguments = () if signature.is_open else call.arguments
        given = match_arguments(arguments, signature.parameters)
        function = at.name(self._names.module.library(routine))
        values, options, calls = self._library_arguments(signature, given, at)
        if not signature.takes_controller:
            return [at.do(at.call(function, values, options))]
        place = place or at.name(self._place(call, given))
        asked = at.name(f"_{signature.concern}")
        if Trait.OUTPUT in routine.traits and Trait.MOVE not in routine.traits:
            return [at.do(at.call("_set_at", [place, function, asked, *values], options))]
        if calls:
            # A call among the arguments sets positions of its own, so this one is set afterwards.
            return [at.do(at.call("_call_at", [place, function, asked, *values], options))]
        return _reported(place, at.call(function, [asked, *values], options), at)

    def rows(self, run: tree.BulkStatements, at: AstBuilder) -> tuple[ast.expr, list[ast.stmt]]:
        """Return the rows of bulk moves, and the statements that execute a move."""
        call = run.like
        assert isinstance(call, tree.Call)
        symbol, given = self._bulk_call(call)
        target = call.arguments[0]
        assert isinstance(target, tree.RequiredArgument)
        signature = symbol.routine.signature
        taken = next(name for name, one in given.items() if one.value is target.value)
        like = self._written(call, given)
        between = [self._written(one.like, self._bulk_call(one.like)[1]) for one in run.between]
        execution = BulkExecution(run, like, taken, tuple(between))
        named = self._names.module.numbered("_rows", execution)
        function = at.name(self._names.module.library(symbol.routine))
        values, options, _ = self._library_arguments(signature, given, at, taken)
        asked = at.name(f"_{signature.concern}")
        made = at.call(function, [asked, *values], options)
        rows = at.call(at.attribute(named, "rows"), [at.name("_motion")])
        return rows, _reported(at.attribute(ROW, "place"), made, at)

    def repeated(self, call: tree.Call, at: AstBuilder) -> list[ast.stmt]:
        """Return the statements that execute a repetition of a call between bulk moves."""
        return self._instruction(
            self._bulk_call(call)[0].routine, call, at, at.attribute(ROW, "place")
        )

    def _bulk_call(self, call: tree.Call) -> tuple[LibrarySymbol, dict[str, BoundArgument]]:
        """Instruction that bulk statements repeat, and its arguments."""
        symbol = self._program.symbol_of[call]
        assert isinstance(symbol, LibrarySymbol)
        return symbol, match_arguments(call.arguments, symbol.routine.signature.parameters)

    def _library_arguments(
        self,
        signature: Signature,
        arguments: dict[str, BoundArgument],
        at: AstBuilder,
        of_row: str = "",
    ) -> tuple[list[ast.expr], list[tuple[str, ast.expr]], bool]:
        """Positional arguments, keyword options, and whether calls are among them.

        Args:
            signature: Signature of the callee.
            arguments: Arguments of the call.
            at: Position of the call.
            of_row: Folded name of the parameter that takes the target of the current row.
        """
        there = [(p, key) for p in signature.parameters if (key := p.name.lower()) in arguments]
        nodes: dict[str, ast.expr] = {}
        calls = False
        for parameter, key in there:
            if key == of_row:
                nodes[key] = at.attribute(ROW, "target")
                continue
            code = self._library_argument(parameter, arguments[key], at)
            calls |= code.calls
            nodes[key] = code.node
        self._refuse_two_alternatives(signature.parameters, arguments, nodes, at)
        values = [nodes[key] for parameter, key in there if not parameter.by_keyword]
        options = [(p.python, nodes[key]) for p, key in there if p.by_keyword]
        for keyword, parameter in signature.types_of:
            of = self._given_type(parameter, arguments)
            options.append((keyword, at.name(self._names.module.numbered("_type", of))))
        return values, options, calls

    def _library_argument(
        self, parameter: Parameter, argument: BoundArgument, at: AstBuilder
    ) -> Code:
        if argument.caller_option is not None:
            node = self._forwarded(argument.caller_option, parameter.mode, at)
            if parameter.is_switch:
                return Code(node)
            # Python functions do not know ABSENT; an absent option is None there.
            present = at.compare(at.named("_given", node), (ast.IsNot(), at.name("_ABSENT")))
            return Code(at.choice(present, at.name("_given"), at.constant(None)))
        if argument.value is None:
            return Code(at.constant(True))
        value = bare(argument.value)
        if isinstance(value, tree.DataReference | tree.Index | tree.ComponentAccess) and (
            by_reference(parameter.mode) or any(map(is_signal, parameter.types))
        ):
            return self._paths.reference(value)
        code = self._expressions.value(argument.value)
        if by_reference(parameter.mode):
            return Code(at.call("_Box", [code.node]), code.deferred, code.may_raise, code.calls)
        return Code(at.deferred(code.node)) if parameter.deferred else code

    def _given_type(self, parameter: Parameter, arguments: dict[str, BoundArgument]) -> Type:
        one = arguments.get(parameter.name.lower())
        if one is not None and one.value is not None:
            return self._expressions.type_of(one.value)
        return NUM

    def _late_argument(
        self, argument: tree.Argument, at: AstBuilder
    ) -> tuple[DeferredArgument, ast.expr]:
        match argument:
            case tree.ConditionalArgument(name=name, present=present):
                symbol = self._caller_option(present)
                spelled = self._names.get(symbol)
                assert spelled is not None
                shape = DeferredArgument(name.key, self._is_reference(symbol), symbol.type)
                return shape, at.name(spelled)
            case tree.OptionalArgument(name=name, value=None):
                return DeferredArgument(name.key, False, None), at.constant(True)
            case (
                tree.OptionalArgument(name=name, value=value)
                | tree.RequiredArgument(name=name, value=value)
            ):
                assert value is not None
                inner = bare(value)
                key = name.key if name is not None else None
                of = self._expressions.type_of(value)
                if isinstance(inner, tree.DataReference | tree.Index | tree.ComponentAccess):
                    refers = not isinstance(resolved(of), ArrayOf)
                    node = self._paths.reference(inner).node
                    return DeferredArgument(key, refers, of), node
                return DeferredArgument(key, False, of), self._expressions.copy(value).node

    def _place(self, node: tree.Node, arguments: dict[str, BoundArgument]) -> str:
        return self._names.module.place(self._written(node, arguments))

    def _written(self, node: tree.Node, arguments: dict[str, BoundArgument]) -> Place:
        source = self._expressions.module.source.text
        texts = {}
        for name, one in arguments.items():
            written = one.value or one.caller_option
            texts[name] = source[written.start : written.end] if written is not None else ""
        return Place(self._expressions.span(node), self._names.routine, texts)

    def _initial_value(self, call: tree.FunctionCall) -> object:
        of = self._program.type_of.get(call)
        return initial_value(of) if of is not None else 0.0

    def _taken_for(self, call: tree.FunctionCall, value: object) -> str:
        """Description of the effect of a call of an undeclared function."""
        of = self._program.type_of.get(call, NUM)
        if value is None:
            return "skipped"
        return f"skipped, {value_text(value, of)} taken for its value"


def _reported(place: ast.expr, call: ast.expr, at: AstBuilder) -> list[ast.stmt]:
    """A call, preceded by setting the position that its reports refer to."""
    return [at.assign(at.store_attribute("_clock", "place"), place), at.do(call)]
