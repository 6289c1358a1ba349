"""How the translators of paths and calls have the expressions in them translated.

Expressions hold paths and calls, which hold expressions; `expressions` knows the other two, and
they know it only as this.
"""

from __future__ import annotations

import ast
from collections.abc import Callable, Mapping
from typing import Protocol

from rapidsim.analysis.program import DataSymbol, Program
from rapidsim.diagnostics import Span
from rapidsim.interpreter.codegen.ast_builder import At
from rapidsim.interpreter.codegen.expression_code import Code
from rapidsim.interpreter.codegen.intervals import Interval
from rapidsim.interpreter.codegen.names import LocalNames
from rapidsim.interpreter.runtime.values import Value
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
        """Gives the value of a CONST."""
        ...

    def at(self, node: tree.Node) -> At:
        """The place of a part of the statement."""
        ...

    def span(self, node: tree.Node) -> Span:
        """The place of a node, for messages."""
        ...

    def type_of(self, expression: tree.Expression) -> Type:
        """The type of an expression."""
        ...

    def code(self, expression: tree.Expression) -> Code:
        """An expression, possibly with something still owed."""
        ...

    def value(self, expression: tree.Expression) -> Code:
        """An expression as the value that a variable would get; of arrays not a copy."""
        ...

    def copy(self, expression: tree.Expression, home: tree.Node | None = None) -> Code:
        """As `value`, but of arrays a list that nobody else has; as an integer for such a home."""
        ...

    def constant_data(self, symbol: DataSymbol, at: At) -> ast.expr:
        """A CONST: plain values are written out, records and arrays have a name."""
        ...
