"""Python syntax nodes at RAPID positions; the only module that sets positions.

An `AstBuilder` is a position on one line of a RAPID file and builds Python nodes there, so that
Python's
tracebacks, debuggers and coverage tools refer to RAPID lines. Python counts columns in UTF-8 bytes,
and moves an attribute that spans lines to its last line; so every position ends on the line it
begins on.
"""

from __future__ import annotations

import ast
from collections.abc import Sequence
from typing import Any

from rapidsim.diagnostics import Source
from rapidsim.syntax import tree

_LOAD = ast.Load()
_STORE = ast.Store()


class AstBuilder:
    """Builds Python nodes at one position of a RAPID file."""

    __slots__ = ("_where", "line")

    def __init__(self, line: int, column: int, end_column: int) -> None:
        """Set the position: line from 1, columns from 0 in UTF-8 bytes."""
        self.line = line
        self._where: dict[str, Any] = {
            "lineno": line,
            "col_offset": column,
            "end_lineno": line,
            "end_col_offset": end_column,
        }

    def name(self, name: str) -> ast.Name:
        """Read a variable."""
        return ast.Name(name, _LOAD, **self._where)

    def store(self, name: str) -> ast.Name:
        """A variable as the target of an assignment."""
        return ast.Name(name, _STORE, **self._where)

    def constant(self, value: float | str | bool | None) -> ast.Constant:
        """A Python constant."""
        return ast.Constant(value, None, **self._where)

    def attribute(self, value: ast.expr | str, name: str) -> ast.Attribute:
        """Read an attribute."""
        return ast.Attribute(self._expression(value), name, _LOAD, **self._where)

    def store_attribute(self, value: ast.expr | str, name: str) -> ast.Attribute:
        """An attribute as the target of an assignment."""
        return ast.Attribute(self._expression(value), name, _STORE, **self._where)

    def item(self, value: ast.expr | str, index: ast.expr) -> ast.Subscript:
        """Read an element."""
        return ast.Subscript(self._expression(value), index, _LOAD, **self._where)

    def store_item(self, value: ast.expr | str, index: ast.expr) -> ast.Subscript:
        """An element as the target of an assignment."""
        return ast.Subscript(self._expression(value), index, _STORE, **self._where)

    def call(
        self,
        function: ast.expr | str,
        arguments: Sequence[ast.expr] = (),
        options: Sequence[tuple[str, ast.expr]] = (),
    ) -> ast.Call:
        """Call a function with positional arguments and keyword options."""
        keywords = [ast.keyword(name, value, **self._where) for name, value in options]
        return ast.Call(self._expression(function), list(arguments), keywords, **self._where)

    def operation(self, left: ast.expr, operator: ast.operator, right: ast.expr) -> ast.BinOp:
        """Arithmetic on two operands."""
        return ast.BinOp(left, operator, right, **self._where)

    def unary(self, operator: ast.unaryop, operand: ast.expr) -> ast.UnaryOp:
        """`-x` or `not x`."""
        return ast.UnaryOp(operator, operand, **self._where)

    def compare(self, left: ast.expr, *rest: tuple[ast.cmpop, ast.expr]) -> ast.Compare:
        """A comparison, chained if there are several operators."""
        operators = [operator for operator, _ in rest]
        return ast.Compare(left, operators, [operand for _, operand in rest], **self._where)

    def both_or_either(self, operator: ast.boolop, *operands: ast.expr) -> ast.BoolOp:
        """Combine operands by `and` or `or`, with short-circuit evaluation."""
        return ast.BoolOp(operator, list(operands), **self._where)

    def choice(self, condition: ast.expr, value: ast.expr, else_value: ast.expr) -> ast.IfExp:
        """`value if condition else else_value`."""
        return ast.IfExp(condition, value, else_value, **self._where)

    def named(self, name: str, value: ast.expr) -> ast.NamedExpr:
        """`(name := value)`."""
        return ast.NamedExpr(self.store(name), value, **self._where)

    def tuple_of(self, elements: Sequence[ast.expr]) -> ast.Tuple:
        """A tuple."""
        return ast.Tuple(list(elements), _LOAD, **self._where)

    def list_of(self, elements: Sequence[ast.expr]) -> ast.List:
        """A list."""
        return ast.List(list(elements), _LOAD, **self._where)

    def deferred(self, body: ast.expr) -> ast.Lambda:
        """`lambda: body`."""
        return ast.Lambda(ast.arguments([], [], None, [], [], None, []), body, **self._where)

    def assign(self, target: ast.expr, value: ast.expr) -> ast.Assign:
        """`target = value`."""
        return ast.Assign([target], value, None, **self._where)

    def set(self, name: str, value: ast.expr) -> ast.Assign:
        """`name = value`."""
        return self.assign(self.store(name), value)

    def minus(self, name: str, value: ast.expr) -> ast.AugAssign:
        """`name -= value`."""
        return ast.AugAssign(self.store(name), ast.Sub(), value, **self._where)

    def decrement(self, target: ast.Attribute) -> ast.AugAssign:
        """`target -= 1`."""
        return ast.AugAssign(target, ast.Sub(), self.constant(1), **self._where)

    def do(self, value: ast.expr) -> ast.Expr:
        """An expression statement."""
        return ast.Expr(value, **self._where)

    def when(
        self, condition: ast.expr, body: Sequence[ast.stmt], else_body: Sequence[ast.stmt] = ()
    ) -> ast.If:
        """`if`; an empty body becomes `pass`."""
        return ast.If(condition, self._body(body), list(else_body), **self._where)

    def repeat(self, condition: ast.expr, body: Sequence[ast.stmt]) -> ast.While:
        """`while`."""
        return ast.While(condition, self._body(body), [], **self._where)

    def forever(self, body: Sequence[ast.stmt]) -> ast.While:
        """`while True`."""
        return self.repeat(self.constant(True), body)

    def each(self, target: ast.expr, values: ast.expr, body: Sequence[ast.stmt]) -> ast.For:
        """`for target in values`."""
        return ast.For(target, values, self._body(body), [], None, **self._where)

    def attempt(
        self,
        body: Sequence[ast.stmt],
        error: ast.expr,
        name: str | None,
        handler: Sequence[ast.stmt],
    ) -> ast.Try:
        """`try: body; except error as name: handler`."""
        clause = ast.ExceptHandler(error, name, self._body(handler), **self._where)
        return ast.Try(self._body(body), [clause], [], [], **self._where)

    def leave(self, value: ast.expr | None = None) -> ast.Return:
        """`return`."""
        return ast.Return(value, **self._where)

    def throw(self, error: ast.expr | None = None) -> ast.Raise:
        """`raise`."""
        return ast.Raise(error, None, **self._where)

    def go_on(self) -> ast.Continue:
        """`continue`."""
        return ast.Continue(**self._where)

    def stop(self) -> ast.Break:
        """`break`."""
        return ast.Break(**self._where)

    def nothing(self) -> ast.Pass:
        """`pass`: a line at which tools can stop although the RAPID statement has no effect."""
        return ast.Pass(**self._where)

    def outer(self, names: Sequence[str]) -> ast.Nonlocal:
        """`nonlocal names`."""
        return ast.Nonlocal(list(names), **self._where)

    def define(
        self,
        name: str,
        parameters: Sequence[str],
        defaults: Sequence[ast.expr],
        body: Sequence[ast.stmt],
    ) -> ast.FunctionDef:
        """`def`; the defaults belong to the last parameters."""
        arguments = ast.arguments(
            posonlyargs=[],
            args=[ast.arg(parameter, None, None, **self._where) for parameter in parameters],
            vararg=None,
            kwonlyargs=[],
            kw_defaults=[],
            kwarg=None,
            defaults=list(defaults),
        )
        # Python 3.12 added `type_params`, which 3.11 rejects; hence the mapping.
        fields: dict[str, Any] = {
            "name": name,
            "args": arguments,
            "body": self._body(body),
            "decorator_list": [],
            "returns": None,
            "type_comment": None,
        }
        if "type_params" in ast.FunctionDef._fields:
            fields["type_params"] = []
        return ast.FunctionDef(**fields, **self._where)

    def _expression(self, value: ast.expr | str) -> ast.expr:
        return self.name(value) if isinstance(value, str) else value

    def _body(self, body: Sequence[ast.stmt]) -> list[ast.stmt]:
        return list(body) or [self.nothing()]


class Positions:
    """Turns character offsets in one source into positions."""

    def __init__(self, source: Source) -> None:
        """Read positions of a source."""
        self._source = source
        self._ascii = source.text.isascii()
        # Offsets of the line of the last request; most requests are for the same line.
        self._line = 0
        self._start = self._end = 0
        # Offsets and position of the last request: a name, its path and the expression share them.
        self._asked = (-1, -1)
        self._at = AstBuilder(0, 0, 0)

    def at(self, node: tree.Node) -> AstBuilder:
        """The start of a node, up to the end of its first line."""
        return self.between(node.start, node.end)

    def between(self, start: int, end: int) -> AstBuilder:
        """The range from `start`, up to the end of its first line."""
        if (start, end) != self._asked:
            self._at, self._asked = self._between(start, end), (start, end)
        return self._at

    def _between(self, start: int, end: int) -> AstBuilder:
        if not self._start <= start < self._end:
            self._find(start)
        first, last = start - self._start, min(end, self._end) - self._start
        if self._ascii:
            return AstBuilder(self._line, first, last)
        text = self._source.text[self._start : self._end]
        return AstBuilder(self._line, len(text[:first].encode()), len(text[:last].encode()))

    def _find(self, offset: int) -> None:
        line, column = self._source.position(offset)
        self._line = line
        self._start = offset - column + 1
        self._end = self._start + len(self._source.line(line))

    def within(self, statement: AstBuilder, node: tree.Node) -> AstBuilder:
        """Return the position of a part of a statement.

        Parts on later lines get the position of the whole statement, so a statement is one line
        event to debuggers and coverage tools, however many lines it spans.
        """
        at = self.at(node)
        return at if at.line == statement.line else statement
