"""Arguments of a call, matched to the parameters of what it calls."""

from __future__ import annotations

from collections.abc import Sequence

from rapidsim.analysis.program import ParameterSymbol
from rapidsim.interpreter.runtime.late_binding import key_of
from rapidsim.library.table import Parameter
from rapidsim.syntax import tree
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class BoundArgument:
    """Argument that a call passes for one parameter; without a value for a switch."""

    value: tree.Expression | None = None
    caller_option: tree.Name | None = None
    """Option of the calling routine that a conditional argument depends on."""


def match_arguments(
    arguments: Sequence[tree.Argument], parameters: Sequence[ParameterSymbol | Parameter]
) -> dict[str, BoundArgument]:
    """Match the arguments of a call to parameters, by folded parameter name."""
    required = (p.name.lower() for p in parameters if not p.optional)
    given: dict[str, BoundArgument] = {}
    for argument in arguments:
        match argument:
            case tree.RequiredArgument(value=value, name=name):
                following = next(required, "")
                key = following if name is None else key_of(name.key, parameters)
                given[key] = BoundArgument(value)
            case tree.OptionalArgument(name=name, value=value):
                given[name.key] = BoundArgument(value)
            case tree.ConditionalArgument(name=name, present=present):
                given[name.key] = BoundArgument(None, present)
    return given
