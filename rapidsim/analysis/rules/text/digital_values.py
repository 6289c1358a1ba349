"""Rule I805: numbers other than 0 and 1 where a digital signal has its value."""

from __future__ import annotations

from collections.abc import Iterator

from rapidsim.analysis.program_parts import Facts
from rapidsim.analysis.rules.facts.instruction_questions import arguments_of
from rapidsim.analysis.rules.facts.known_values import known_value
from rapidsim.diagnostics import Diagnostic, Violation
from rapidsim.library.predefined import TYPES

_VALUES = (0.0, 1.0)
_EDGES = (*_VALUES, 2.0)
"""Values for instructions that order interrupts: `edge` is both."""
_OF_INTERRUPTS = "triggvalue"


class DigitalValue(Violation, code="I805"):
    value: str
    parameter: str
    instruction: str


def find_digital_values(facts: Facts) -> Iterator[Diagnostic]:
    """Report known values that no digital signal has."""
    for part in facts.parts:
        for call in part.calls:
            if facts.installed(call) is None:
                continue
            for formal, value in arguments_of(call, facts):
                if formal is None or value is None or formal.types[0] != TYPES["dionum"]:
                    continue
                number = known_value(value, facts)
                allowed = _EDGES if formal.key == _OF_INTERRUPTS else _VALUES
                if isinstance(number, float) and number not in allowed:
                    found = DigitalValue(f"{number:g}", formal.spelled, call.name.text)
                    yield part.finding(found, value)
