"""Every rule has a module that breaks it and one that comes near and does not."""

from __future__ import annotations

from pathlib import Path

import pytest
from check_helper import FIXTURES, found_in, lines

import rapidsim
from rapidsim.diagnostics import Severity, Violation
from rapidsim.report.rules import rules

ARM = "irb1600-6-1.2"
# What only a robot or a run decides is tested where it is found.
_FOUND_ELSEWHERE = ("rapidsim.motion", "rapidsim.simulation", "rapidsim.interpreter")
RULES = [rule for rule in rules() if not rule.__module__.startswith(_FOUND_ELSEWHERE)]


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.code)
def test_the_bad_module_breaks_the_rule(rule: type[Violation]) -> None:
    found = found_in(FIXTURES / f"{rule.code}.bad.mod", every_rule=True)
    assert rule in {type(one.violation) for one in found}, lines(found)
    assert all(one.severity is rule.severity for one in found if isinstance(one.violation, rule))


MARKED = [
    rule
    for rule in RULES
    if "! found" in (FIXTURES / f"{rule.code}.bad.mod").read_text("utf-8", "replace")
]


@pytest.mark.parametrize("rule", MARKED, ids=lambda rule: rule.code)
def test_the_marked_lines_are_found_and_no_others(rule: type[Violation]) -> None:
    file = FIXTURES / f"{rule.code}.bad.mod"
    text = file.read_text("utf-8").splitlines()
    marked = [number for number, line in enumerate(text, start=1) if "! found" in line]
    found = [one for one in found_in(file, every_rule=True) if isinstance(one.violation, rule)]
    assert sorted({one.span.line for one in found if one.span}) == marked, lines(tuple(found))
    assert not [one for one in found_in(file) if one.severity is Severity.ERROR]


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.code)
def test_the_good_module_keeps_it(rule: type[Violation]) -> None:
    found = found_in(FIXTURES / f"{rule.code}.good.mod", every_rule=True)
    broken = [one for one in found if type(one.violation) is rule or one.severity is Severity.ERROR]
    assert broken == [], lines(tuple(broken))


# These need more than a module: a station file, or bytes that no page shows; a run finds the rest.
_NEEDS_A_STATION = {"N208", "D701", "D702", "I803", "E190", "M520", "K615"}
_FOUND_BY_RUNS = {"K612", "M521"}
OF_MOVES = [
    rule
    for rule in rules()
    if rule.__module__.startswith(_FOUND_ELSEWHERE)
    and rule.code[0] != "R"
    and rule.code not in _NEEDS_A_STATION
]


@pytest.mark.parametrize("rule", OF_MOVES, ids=lambda rule: rule.code)
def test_what_an_arm_decides_is_found_on_that_arm(rule: type[Violation]) -> None:
    assert rule in found_with_arm(FIXTURES / f"{rule.code}.bad.mod", rule)
    assert rule not in found_with_arm(FIXTURES / f"{rule.code}.good.mod", rule)


def found_with_arm(file: Path, rule: type[Violation]) -> set[type[Violation]]:
    """Rules that a check with the default arm finds, or else a run does."""
    found = {type(one.violation) for one in rapidsim.check([file], robot=ARM).diagnostics}
    if rule.code in _FOUND_BY_RUNS:
        found |= {type(one.violation) for one in rapidsim.simulate([file], robot=ARM).diagnostics}
    return found


def test_no_fixture_is_left_of_a_rule_that_is_gone() -> None:
    codes = {rule.code for rule in rules()}
    assert {file.name.partition(".")[0] for file in FIXTURES.iterdir()} <= codes
