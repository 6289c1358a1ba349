"""The zero-based index of a FOR counter, computed once per iteration.

RAPID counts elements from 1 and Python from 0, so `i - 1` occurs repeatedly in loops over arrays.
Nothing can assign to a counter, so each iteration stores the result: `_i_0 = i - 1`.
"""

from __future__ import annotations

import ast
from collections.abc import Sequence
from typing import TypeGuard

from rapidsim.interpreter.codegen.ast_builder import AstBuilder


def position_once(body: list[ast.stmt], counter: str, at: AstBuilder) -> list[ast.stmt]:
    """Rewrite the body of a loop with an integer counter; unchanged if that saves nothing."""
    if not _pays(body, counter):
        return body
    position = f"_{counter}_0"
    kept = at.set(position, at.operation(at.name(counter), ast.Sub(), at.constant(1)))
    names = _Positions(counter, position)
    return [kept, *(names.visit(statement) for statement in body)]


def _pays(body: Sequence[ast.stmt], counter: str) -> bool:
    """Whether the index is used twice, or in a nested loop."""
    uses = 0
    for statement in body:
        for node in ast.walk(statement):
            if isinstance(node, ast.For | ast.While) and any(
                _is_position(part, counter) for part in ast.walk(node)
            ):
                return True
            uses += _is_position(node, counter)
    return uses > 1


def _is_position(node: ast.AST, counter: str) -> TypeGuard[ast.BinOp]:
    match node:
        case ast.BinOp(ast.Name(id=name), ast.Sub(), ast.Constant(value=int(one))):
            return name == counter and one == 1
        case _:
            return False


class _Positions(ast.NodeTransformer):
    def __init__(self, counter: str, position: str) -> None:
        self._counter = counter
        self._position = position

    def visit_BinOp(self, node: ast.BinOp) -> ast.expr:
        """Replace the difference by the variable."""
        if _is_position(node, self._counter):
            return ast.copy_location(ast.Name(self._position, ast.Load()), node)
        self.generic_visit(node)
        return node
