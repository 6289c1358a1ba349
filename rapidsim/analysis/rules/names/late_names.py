"""Rule N207: calls by a name computed at run time, such as `%"part"+ValToStr(n)%;`."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from rapidsim.analysis.installed import installed_symbol
from rapidsim.analysis.program_parts import Facts, ProgramPart
from rapidsim.analysis.rules.facts.instruction_questions import may_do
from rapidsim.analysis.rules.facts.known_values import known_value
from rapidsim.diagnostics import Diagnostic, Violation
from rapidsim.library.traits import Trait
from rapidsim.syntax import tree


class AmbiguousLateBinding(Violation, code="N207"):
    shape: str


def find_late_names(facts: Facts) -> Iterator[Diagnostic]:
    """Report calls by name that match no procedure of the task."""
    if not facts.is_read or facts.analysis.loads_modules:
        return
    procedures = [
        part.routine.name.key for part in facts.routine_parts if isinstance(part.routine, tree.Proc)
    ]
    for part, calls in facts.in_parts(_late_calls):
        for call in calls:
            pieces = _pieces(call.routine, facts)
            if not any(piece for piece in pieces if piece is not None):
                continue
            pattern = _pattern(pieces)
            if any(pattern.fullmatch(name) for name in procedures):
                continue
            if len(pieces) == 1 and pieces[0] and installed_symbol(pieces[0].lower()):
                continue
            shape = "".join("..." if piece is None else piece for piece in pieces)
            yield part.finding(AmbiguousLateBinding(f"`{shape}`"), call.routine)


def late_patterns(facts: Facts) -> list[re.Pattern[str]]:
    """Patterns of the possible names in calls by name, one per call."""
    return [pattern for _, patterns in facts.in_parts(_patterns) for pattern in patterns]


def _late_calls(part: ProgramPart, facts: Facts) -> Sequence[tree.LateCall]:
    del facts
    return part.all(tree.LateCall)


def _patterns(part: ProgramPart, facts: Facts) -> list[re.Pattern[str]]:
    found = [_pattern(_pieces(call.routine, facts)) for call in part.all(tree.LateCall)]
    for call in part.all(tree.Call):
        if Trait.CALL_BY_NAME in may_do(call, facts) and call.arguments:
            first = call.arguments[0]
            value = first.value if isinstance(first, tree.RequiredArgument) else None
            # A number is appended to the name.
            found.append(_pattern([*_pieces(value, facts), None]))
    return found


def _pieces(expression: tree.Expression | None, facts: Facts) -> list[str | None]:
    """Parts of a name in order; None for a part known only at run time."""
    match expression:
        case tree.Parenthesised(inner=inner):
            return _pieces(inner, facts)
        case tree.Binary(operator="+", left=left, right=right):
            return [*_pieces(left, facts), *_pieces(right, facts)]
        case _:
            value = known_value(expression, facts, persistents=False)
            # A module may precede the name: "module:procedure".
            return [value.rpartition(":")[2]] if isinstance(value, str) else [None]


def _pattern(pieces: list[str | None]) -> re.Pattern[str]:
    return re.compile("".join(".*" if p is None else re.escape(p.lower()) for p in pieces))
