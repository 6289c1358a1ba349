"""The values of CONST data, computed before anything runs.

Literals are read from the tree; other constant expressions are translated like any expression and
evaluated once. Constants are evaluated on demand, so their order in the text does not matter.
"""

from __future__ import annotations

import ast
from dataclasses import dataclass, field

from rapidsim.analysis.literals import Value, literal
from rapidsim.analysis.program import DataSymbol, Program
from rapidsim.interpreter.codegen.ast_builder import Positions
from rapidsim.interpreter.codegen.expressions import Expressions
from rapidsim.interpreter.codegen.names import LocalNames, ModuleNames, TaskIndependent
from rapidsim.interpreter.limits import NotExecutableError
from rapidsim.interpreter.linking.namespace import FUNCTIONS
from rapidsim.interpreter.runtime.call_stack import Origin
from rapidsim.interpreter.runtime.error_recovery import GENERATED
from rapidsim.language.initial_values import initial_value


@dataclass(slots=True)
class Constants:
    """Values of constants by symbol, computed when first needed."""

    program: Program
    _values: dict[DataSymbol, Value] = field(default_factory=dict)

    def value_of(self, symbol: DataSymbol) -> Value:
        """The value of a CONST; analysis has ruled out circular definitions.

        Raises:
            RapidError: If its expression fails, as a division by zero does.
            NotExecutableError: If its expression needs more than constants.
        """
        if symbol.node is None:
            return symbol.value
        if symbol not in self._values:
            self._values[symbol] = self._evaluated(symbol)
        return self._values[symbol]

    def _evaluated(self, symbol: DataSymbol) -> Value:
        node, module = symbol.node, symbol.module
        assert node is not None
        assert module is not None
        if node.value is None:
            return initial_value(symbol.type)
        value = literal(node.value, symbol.type)
        if value is not None:
            return value
        names = ModuleNames(module)
        positions = Positions(module.source)
        expressions = Expressions(
            self.program, LocalNames(names, ""), positions, module, self.value_of, {}
        )
        expressions.statement = positions.at(node)
        code = compile(
            ast.Expression(expressions.copy(node.value).node), module.source.file, "eval"
        )
        namespace = {
            name: bound.value
            for name, bound in names.bindings.items()
            if isinstance(bound, TaskIndependent)
        }
        if len(namespace) < len(names.bindings):
            raise NotExecutableError("a constant that depends on variables", module.span(node))
        origin = Origin(module, {}, self.value_of, lambda: self.program)
        return eval(code, {**FUNCTIONS, GENERATED: origin, **namespace})
