"""The pages of rules that only a run knows: their examples break the rule, their fixes do not."""

from __future__ import annotations

import inspect
import re
import textwrap

import pytest
from simulation_program import ran

from rapidsim.diagnostics import Violation
from rapidsim.report.rules import rules

_PART = re.compile(r"^## (Example|Fix)\n(.*?)(?=^## |\Z)", re.MULTILINE | re.DOTALL)


def programs(rule: type[Violation]) -> dict[str, str]:
    """The programs on a rule's page, by their heading."""
    page = inspect.cleandoc(rule.__doc__ or "")
    return {head: textwrap.dedent(body).strip() for head, body in _PART.findall(page)}


# What `rapidsim check` finds in the text has its tests where it is found.
ELSEWHERE = ("rapidsim.analysis", "rapidsim.motion.reach_violations")
RULES = [
    rule
    for rule in rules()
    if rule.code[0] in "RKM" and programs(rule) and not rule.__module__.startswith(ELSEWHERE)
]


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.code)
def test_the_example_breaks_the_rule_and_the_fix_does_not(rule: type[Violation]) -> None:
    shown = programs(rule)
    assert rule.code in {code for code, _ in ran(shown["Example"]).findings}
    assert ran(shown["Fix"]).findings == []
