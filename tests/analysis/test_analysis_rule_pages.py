"""Pages of the rules of `rapidsim check`: the example breaks the rule, the fix does not."""

from __future__ import annotations

import inspect
import re
import textwrap

import pytest

from rapidsim.analysis.checker import check
from rapidsim.analysis.rules.table import DETECTORS
from rapidsim.diagnostics import Diagnostic, Severity, Source, Violation
from rapidsim.report.rules import rules
from rapidsim.syntax.parser import parse

IN_TABLE = {rule for detector in DETECTORS for rule in detector.rules}
_PART = re.compile(r"^## (Example|Fix)\n(.*?)(?=^## |\Z)", re.MULTILINE | re.DOTALL)


def programs(rule: type[Violation]) -> dict[str, str]:
    page = inspect.cleandoc(rule.__doc__ or "")
    return {head: textwrap.dedent(body).strip() for head, body in _PART.findall(page)}


def found_in(text: str) -> tuple[Diagnostic, ...]:
    parsed = parse(Source("page.mod", text))
    assert not parsed.diagnostics
    return check([parsed.file], [detector.find for detector in DETECTORS]).diagnostics


# Bytes at line ends and very long texts do not fit a page; the fixtures of `tests/check` have them.
SHOWN = sorted((rule for rule in IN_TABLE if programs(rule)), key=lambda rule: rule.code)


def test_every_rule_declared_beside_a_detector_is_looked_for() -> None:
    declared = {rule for rule in rules() if rule.__module__.startswith("rapidsim.analysis.rules.")}
    assert declared <= IN_TABLE


@pytest.mark.parametrize("rule", SHOWN, ids=lambda rule: rule.code)
def test_the_example_breaks_the_rule_and_the_fix_does_not(rule: type[Violation]) -> None:
    shown = programs(rule)
    example, fix = found_in(shown["Example"]), found_in(shown["Fix"])
    assert rule.code in {finding.violation.code for finding in example}
    assert rule.code not in {finding.violation.code for finding in fix}
    for finding in (*example, *fix):
        assert finding.severity is not Severity.ERROR, finding.violation.message
        assert "\n" not in finding.violation.message
        assert not finding.violation.message.endswith(".")
