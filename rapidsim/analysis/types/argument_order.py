"""Two exchanged arguments of a call: one mistake, with an evident fix.

`MoveL p10,fine,v300,gripper` passes a zone where the speed belongs and a speed where the zone
belongs. Only types decide: each argument has a type that its own parameter rejects and that the
parameter of the other accepts.
"""

from __future__ import annotations

from itertools import combinations

from rapidsim.analysis.context import Context
from rapidsim.analysis.parameters import Callee
from rapidsim.analysis.types.argument_binding import Bound, fits
from rapidsim.analysis.types.argument_violations import BadArguments
from rapidsim.diagnostics import Diagnostic, Edit, Fix
from rapidsim.syntax import tree

_LONGEST = 40
"""Maximum number of characters of an argument in a message."""


def without_exchange(bound: list[Bound], callee: Callee, context: Context) -> list[Bound]:
    """Report two exchanged arguments, and bind each to the parameter that it fits.

    Returns:
        The arguments with their parameters; unchanged if no two are exchanged.
    """
    misfits = [
        (index, argument.value)
        for index, (argument, formal) in enumerate(bound)
        if isinstance(argument, tree.RequiredArgument) and not fits(argument.value, formal, context)
    ]
    for (i, first), (j, second) in combinations(misfits, 2):
        formal_of_first, formal_of_second = bound[i][1], bound[j][1]
        if fits(first, formal_of_second, context) and fits(second, formal_of_first, context):
            _report(first, second, callee, context)
            exchanged = list(bound)
            exchanged[i], exchanged[j] = (
                (bound[i][0], formal_of_second),
                (bound[j][0], formal_of_first),
            )
            return exchanged
    return bound


def _report(
    first: tree.Expression, second: tree.Expression, callee: Callee, context: Context
) -> None:
    module = context.module
    spans = module.span(first), module.span(second)
    shown = [
        f"`{text}`" if len(text := " ".join(span.text.split())) <= _LONGEST else "an argument"
        for span in spans
    ]
    problem = f"{shown[0]} and {shown[1]} of `{callee.name}` are in each other's place"
    edits = (Edit(spans[0], spans[1].text), Edit(spans[1], spans[0].text))
    context.analysis.unit.diagnostics.append(
        Diagnostic(
            BadArguments(problem, "swapped", callee.order),
            spans[0],
            related=callee.declared,
            fix=Fix("exchange them", edits),
            routine=context.routine.name if context.routine else None,
        )
    )
