"""Every rule has a page, a code of its own, and is found."""

import re
from collections import Counter
from pathlib import Path

import pytest

import rapidsim
from rapidsim.diagnostics import Violation
from rapidsim.report.palette import COLOURED, PLAIN
from rapidsim.report.rules import rule_list, rule_page, rules

PACKAGE = Path(rapidsim.__file__).parent


def test_no_rule_is_declared_where_it_is_not_looked_for() -> None:
    declared = {
        code
        for file in PACKAGE.rglob("*.py")
        for code in re.findall(
            r'^    code: ClassVar\[str\] = "(\w+)"', file.read_text(), re.MULTILINE
        )
    }
    assert declared == {rule.code for rule in rules()}


def test_codes_and_names_are_not_used_twice() -> None:
    for names in ([rule.code for rule in rules()], [rule.name for rule in rules()]):
        assert [name for name, count in Counter(names).items() if count > 1] == []


@pytest.mark.parametrize("rule", rules(), ids=lambda rule: rule.code)
def test_every_rule_has_a_page(rule: type[Violation]) -> None:
    assert re.fullmatch(r"[A-Z]\d{3}", rule.code)
    assert re.fullmatch(r"[a-z0-9]+(-[a-z0-9]+)*", rule.name)
    page = rule_page(rule, PLAIN, width=80)
    assert page.startswith(f"{rule.code} {rule.name} ({rule.severity.value})\n\n")
    assert "##" not in page
    first = page.split("\n\n")[1].replace("\n", " ")
    assert first.endswith((".", ":"))
    assert "\x1b" in rule_page(rule, COLOURED, width=80)


def test_the_list_names_every_rule_on_a_line() -> None:
    lines = rule_list(rules(), PLAIN).splitlines()
    assert [line.split()[0] for line in lines] == [rule.code for rule in rules()]
