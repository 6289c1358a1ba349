"""Each detector that declares the scope of a routine finds the same part by part."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from typing import NoReturn

import pytest
from fresh_check import contents, modules, text_of

from rapidsim.analysis.passes.checker import check
from rapidsim.analysis.program_parts import Facts, ProgramPart
from rapidsim.analysis.rules.table import DETECTORS, Detector, RuleScope
from rapidsim.diagnostics import Diagnostic, Source
from rapidsim.syntax.parser import parse

OF_TASK = (
    *("files", "part_of", "call_graph", "components", "bit_of", "reached_from", "returning"),
    *("moving", "names", "strings", "entry", "is_whole", "is_read", "can_return", "callee_of"),
)


def refused(name: str) -> property:
    def refuse(_: Facts) -> NoReturn:
        raise AssertionError(f"a detector of routines looks at `{name}` of the task")

    return property(refuse)


class FactsOfPart(Facts):
    """One part of a task, without anything that depends on the others."""

    for _name in OF_TASK:
        vars()[_name] = refused(_name)


def alone(facts: Facts, part: ProgramPart) -> Facts:
    only = object.__new__(FactsOfPart)
    vars(only).update(analysis=facts.analysis, memo={}, parts=(part,))
    return only


@cache
def programs() -> tuple[Facts, ...]:
    """Facts of a sample of files with several parts."""
    found: list[Facts] = []

    def take(facts: Facts) -> Iterator[Diagnostic]:
        found.append(facts)
        return iter(())

    files = modules("rapidsim/rules")[::2] + modules("tests/rapid", "programs")[::3]
    for file in files:
        check([parse(Source(file.name, text_of(file))).file], [take])
    return tuple(facts for facts in found if len(facts.parts) > 2)


@pytest.mark.parametrize(
    "detector",
    [one for one in DETECTORS if one.scope is RuleScope.ROUTINE],
    ids=lambda detector: detector.find.__name__,
)
def test_a_detector_of_routines_needs_one_at_a_time(detector: Detector) -> None:
    for facts in programs():
        whole = [contents(one) for one in detector.find(facts)]
        parts = [contents(one) for part in facts.parts for one in detector.find(alone(facts, part))]
        assert sorted(map(repr, parts)) == sorted(map(repr, whole))
