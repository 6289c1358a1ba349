"""Functions whose calls need a special translation.

Most need their argument's name or location rather than its value: they take a REF parameter, which
no Python function can have. StrLen is included because a length is an integer, which makes loops
and indices fast.

Source: Technical reference manual RAPID Instructions, Functions and Data types: ArgName, Dim,
IsPers, IsVar, Present, StrLen, Type.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping
from types import MappingProxyType

from rapidsim.analysis.program import DataSymbol, ParameterSymbol, Storage
from rapidsim.interpreter.codegen.ast_builder import AstBuilder
from rapidsim.interpreter.codegen.data_access import DataPathTranslator, by_reference
from rapidsim.interpreter.codegen.expression_code import Code
from rapidsim.interpreter.codegen.intervals import Interval
from rapidsim.interpreter.codegen.operands import Operands
from rapidsim.interpreter.codegen.written_paths import bare
from rapidsim.interpreter.limits import NotExecutableError
from rapidsim.language.moves import Place
from rapidsim.language.types import ArrayOf, Type, resolved
from rapidsim.library.arithmetic import MAX_INTEGER
from rapidsim.syntax import tree

SpecialForm = Callable[[Operands, DataPathTranslator, tree.FunctionCall, AstBuilder], Code]


def _argument(expressions: Operands, call: tree.FunctionCall) -> tree.DataPath:
    """The first argument, which must be data."""
    first = call.arguments[0] if call.arguments else None
    if isinstance(first, tree.RequiredArgument):
        value = bare(first.value)
        if isinstance(value, tree.DataReference | tree.Index | tree.ComponentAccess):
            return value
    raise NotExecutableError(
        f"`{call.name.text}` of something that is not data", expressions.span(call)
    )


def _present(
    expressions: Operands, paths: DataPathTranslator, call: tree.FunctionCall, at: AstBuilder
) -> Code:
    symbol = paths.symbol(_argument(expressions, call))
    name = expressions.names.get(symbol)
    if not isinstance(symbol, ParameterSymbol) or not symbol.optional or name is None:
        return Code(at.constant(True))
    if symbol.is_switch:
        return Code(at.name(name))
    return Code(at.compare(at.name(name), (ast.IsNot(), at.name("_ABSENT"))))


def _dim(
    expressions: Operands, paths: DataPathTranslator, call: tree.FunctionCall, at: AstBuilder
) -> Code:
    path = _argument(expressions, call)
    which = call.arguments[1]
    assert isinstance(which, tree.RequiredArgument)
    code = expressions.value(which.value)
    size = paths.size(path, int(code.literal)) if code.literal is not None else None
    if size is not None:
        return size
    array = paths.reference(path)
    return Code(at.call("_dimension", [array.node, code.node]), may_raise=True)


def _is_pers(
    expressions: Operands, paths: DataPathTranslator, call: tree.FunctionCall, at: AstBuilder
) -> Code:
    return _is_storage(expressions, paths, call, at, Storage.PERS)


def _is_var(
    expressions: Operands, paths: DataPathTranslator, call: tree.FunctionCall, at: AstBuilder
) -> Code:
    return _is_storage(expressions, paths, call, at, Storage.VAR)


def _is_storage(
    expressions: Operands,
    paths: DataPathTranslator,
    call: tree.FunctionCall,
    at: AstBuilder,
    storage: Storage,
) -> Code:
    """IsPers and IsVar: from the declaration, or for a by-reference parameter from the argument."""
    path = _argument(expressions, call)
    symbol = paths.symbol(path)
    if isinstance(symbol, DataSymbol):
        return Code(at.constant(symbol.storage is storage))
    if not isinstance(symbol, ParameterSymbol) or not by_reference(symbol.mode):
        return Code(at.constant(False))
    name = expressions.names.get(symbol)
    assert name is not None
    code: ast.expr = at.call("_is_persistent", [at.name(name)])
    if storage is Storage.VAR:
        code = at.unary(ast.Not(), code)
    return Code(code, may_raise=symbol.optional)


def _str_len(
    expressions: Operands, paths: DataPathTranslator, call: tree.FunctionCall, at: AstBuilder
) -> Code:
    argument = call.arguments[0]
    assert isinstance(argument, tree.RequiredArgument)
    text = expressions.value(argument.value)
    node = at.call("_len", [text.node])
    return Code(node, text.deferred, text.may_raise, text.calls, Interval(0, MAX_INTEGER))


def _type(
    expressions: Operands, paths: DataPathTranslator, call: tree.FunctionCall, at: AstBuilder
) -> Code:
    of = paths.type_of(_argument(expressions, call))
    element: Type = of.element if isinstance(of, ArrayOf) else of
    if len(call.arguments) > 1:  # \BaseName
        element = resolved(element)
    return Code(at.constant(element.name))


def _arg_name(
    expressions: Operands, paths: DataPathTranslator, call: tree.FunctionCall, at: AstBuilder
) -> Code:
    """ArgName: for a parameter the name of its argument, determined at the call of ArgName."""
    symbol = paths.symbol(_argument(expressions, call))
    if not isinstance(symbol, ParameterSymbol):
        return Code(at.constant(symbol.name))
    place = expressions.names.module.place(Place(expressions.span(call), expressions.names.routine))
    arguments: list[ast.expr] = [at.name(place), at.constant(symbol.name)]
    for argument in call.arguments[1:]:  # \ErrorNumber
        number = None if isinstance(argument, tree.ConditionalArgument) else argument.value
        path = None if number is None else bare(number)
        if not isinstance(path, tree.DataReference | tree.Index | tree.ComponentAccess):
            raise NotExecutableError(r"ArgName with such an \ErrorNumber", expressions.span(call))
        arguments.append(paths.reference(path).node)
    return Code(at.call("_argument_name", arguments), may_raise=True, calls=True)


SPECIAL_FORMS: Mapping[str, SpecialForm] = MappingProxyType(
    {
        "argname": _arg_name,
        "dim": _dim,
        "ispers": _is_pers,
        "isvar": _is_var,
        "present": _present,
        "strlen": _str_len,
        "type": _type,
    }
)
"""Translation by folded name."""
