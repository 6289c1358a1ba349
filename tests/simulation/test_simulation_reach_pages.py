"""The pages of rules that only checking knows: examples break the rule, fixes do not."""

from __future__ import annotations

import inspect
import re
import textwrap

import pytest
from simulation_reach import checked

from rapidsim.diagnostics import Violation
from rapidsim.report.rules import rules

_PART = re.compile(r"^## (Example|Fix)\n(.*?)(?=^## |\Z)", re.MULTILINE | re.DOTALL)
_MODULES = ("rapidsim.motion.reach_violations", "rapidsim.motion.duration_violations")
_ALSO = ("K601", "K602", "M506")
"""Pages of rules that a run knows too."""

RULES = [rule for rule in rules() if rule.__module__ in _MODULES or rule.code in _ALSO]


def programs(rule: type[Violation]) -> dict[str, str]:
    """The programs on a rule's page, by their heading."""
    page = inspect.cleandoc(rule.__doc__ or "")
    return {head: textwrap.dedent(body).strip() for head, body in _PART.findall(page)}


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.code)
def test_the_example_breaks_the_rule_and_the_fix_does_not(rule: type[Violation]) -> None:
    shown = programs(rule)
    budget_s = 2.5 if rule.code[0] == "D" else None
    example = checked(shown["Example"], budget_s=budget_s)
    assert rule.code in {found.code for found in example.findings}
    assert checked(shown["Fix"], budget_s=budget_s).findings == []
