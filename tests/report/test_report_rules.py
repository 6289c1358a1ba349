"""Every rule has a page, a code of its own, and is found."""

import re
from collections import Counter

import pytest

from rapidsim.diagnostics import Rule, all_rules
from rapidsim.report.pages.rules import rule_list, rule_page
from rapidsim.report.palette import COLOURED, PLAIN


def test_codes_and_names_are_not_used_twice() -> None:
    for names in ([rule.code for rule in all_rules()], [rule.name for rule in all_rules()]):
        assert [name for name, count in Counter(names).items() if count > 1] == []


@pytest.mark.parametrize("rule", all_rules(), ids=lambda rule: rule.code)
def test_every_rule_has_a_page(rule: Rule) -> None:
    assert re.fullmatch(r"[A-Z]\d{3}", rule.code)
    assert re.fullmatch(r"[a-z0-9]+(-[a-z0-9]+)*", rule.name)
    page = rule_page(rule, PLAIN, width=80)
    assert page.startswith(f"{rule.code} {rule.name} ({rule.severity.value})\n\n")
    assert "##" not in page
    first = page.split("\n\n")[1].replace("\n", " ")
    assert first.endswith((".", ":"))
    assert "\x1b" in rule_page(rule, COLOURED, width=80)


def test_the_list_names_every_rule_on_a_line() -> None:
    lines = rule_list(all_rules(), PLAIN).splitlines()
    assert [line.split()[0] for line in lines] == [rule.code for rule in all_rules()]
