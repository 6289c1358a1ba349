"""The interface through which the translators of paths and calls translate their subexpressions.

Expressions contain paths and calls, which contain expressions. `expressions` depends on the other
two; they depend only on this protocol.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping
from typing import Protocol

from rapidsim.analysis.literals import Value
from rapidsim.analysis.program import DataSymbol, Program
from rapidsim.diagnostics import Span
from rapidsim.interpreter.codegen.ast_builder import AstBuilder
from rapidsim.interpreter.codegen.expression_code import Code
from rapidsim.interpreter.codegen.intervals import Interval
from rapidsim.interpreter.codegen.names import LocalNames
from rapidsim.language.types import Type
from rapidsim.syntax import tree


class Operands(Protocol):
    """Translates the expressions of one routine, statement by statement."""

    program: Program
    names: LocalNames
    module: tree.Module
    counters: dict[str, Interval]
    """FOR counters that are Python integers, by Python name."""
    integers: Mapping[tree.Node, Interval]
    """Variables and functions whose values are integers."""

    @property
    def constant_value(self) -> Callable[[DataSymbol], Value]:
        """Return the value of a CONST."""
        ...

    def at(self, node: tree.Node) -> AstBuilder:
        """The position of a part of the statement."""
        ...

    def span(self, node: tree.Node) -> Span:
        """The source span of a node, for messages."""
        ...

    def type_of(self, expression: tree.Expression) -> Type:
        """The type of an expression."""
        ...

    def code(self, expression: tree.Expression) -> Code:
        """An expression whose result may still need rounding."""
        ...

    def value(self, expression: tree.Expression) -> Code:
        """An expression as the value stored in a variable; arrays are not copied."""
        ...

    def copy(self, expression: tree.Expression, home: tree.Node | None = None) -> Code:
        """Like `value`, but copying arrays, and as an integer if its home is one."""
        ...

    def constant_data(self, symbol: DataSymbol, at: AstBuilder) -> ast.expr:
        """A CONST: plain values are inlined, records and arrays are referred to by name."""
        ...
