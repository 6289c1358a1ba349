"""Every rule's manual page: its example breaks the rule, its fix does not."""

import inspect
import re
import textwrap
from types import ModuleType

import pytest

from rapidsim.analysis import (
    argument_violations,
    declaration_violations,
    error_violations,
    flow_violations,
    name_violations,
    signal_violations,
    syntax_violations,
    type_violations,
)
from rapidsim.analysis.checker import check
from rapidsim.diagnostics import Diagnostic, Severity, Source, Violation
from rapidsim.syntax.parser import parse

MODULES = (
    argument_violations,
    declaration_violations,
    error_violations,
    flow_violations,
    name_violations,
    signal_violations,
    syntax_violations,
    type_violations,
)


def rules_of(module: ModuleType) -> list[type[Violation]]:
    return [
        value
        for value in vars(module).values()
        if isinstance(value, type)
        and issubclass(value, Violation)
        and value.__module__ == module.__name__
    ]


RULES = [rule for module in MODULES for rule in rules_of(module)]


def section(rule: type[Violation], heading: str) -> str:
    page = inspect.cleandoc(rule.__doc__ or "")
    match = re.search(rf"^## {heading}\n(.*?)(?=^## |\Z)", page, re.MULTILINE | re.DOTALL)
    assert match, f"{rule.code} has no section {heading}"
    return textwrap.dedent(match.group(1).strip("\n"))


def findings(text: str) -> tuple[Diagnostic, ...]:
    parsed = parse(Source("page.mod", text))
    return (*parsed.diagnostics, *check([parsed.file]).diagnostics)


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.code)
def test_example_breaks_the_rule_and_nothing_else(rule: type[Violation]) -> None:
    found = findings(section(rule, "Example"))
    assert rule.code in {finding.violation.code for finding in found}
    others = [
        finding.violation.message
        for finding in found
        if finding.violation.code != rule.code and finding.severity is Severity.ERROR
    ]
    assert not others


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.code)
def test_fix_keeps_the_rule(rule: type[Violation]) -> None:
    found = findings(section(rule, "Fix"))
    assert rule.code not in {finding.violation.code for finding in found}
    assert not [f.violation.message for f in found if f.severity is Severity.ERROR]


def test_codes_and_names_are_unique() -> None:
    assert len({rule.code for rule in RULES}) == len(RULES)
    assert len({rule.name for rule in RULES}) == len(RULES)


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.code)
def test_message_is_one_line_without_full_stop(rule: type[Violation]) -> None:
    for finding in findings(section(rule, "Example")):
        message = finding.violation.message
        assert "\n" not in message
        assert not message.endswith(".")
